//! Propagation: how windows travel over the mesh.
//!
//! Every half-edge h keeps one list of the windows that wait to enter its triangle. When windows arrive, the triangle's
//! apex is labelled with the shortest path over them. A heap hands out labelled vertices, nearest first: a vertex that
//! is handed out is *settled*, the lists that wait for it as their apex cross their triangles as a whole, and a
//! pseudo-source among the vertices throws new windows over all its triangles. Windows that arrive where the apex is
//! settled cross at once. Order decides speed, never exactness: a label can still fall after its vertex was settled, and
//! then the vertex is handed out again.
//!
//! Before a list crosses (A, B the ends of its edge, C the apex)
//! - a window is dropped if a path over A or over B is shorter at each of its points (Xin, Wang 2009);
//! - the windows are trimmed against each other, [`envelope`](super::envelope);
//! - p*, the point of AB on the shortest known path to C over this edge, splits the rest: a path that crosses AB left of
//!   p* and goes to BC meets the segment from p* to C, and from there on is no shorter than the path over p*; so what
//!   lies left of p* goes to AC only, what lies right of it to CB only. Each list of n windows throws n + 1 at most.
//!
//! References: Xin, Wang, "Improving Chen and Han's algorithm on the discrete geodesic problem", ACM TOG 28 (2009);
//! Qin, Han, Yu, Yu, Zhang, "Fast and exact discrete geodesic computation based on triangle-oriented wavefront
//! propagation", ACM TOG 35 (2016).

use super::Prepared;
use super::envelope::{Memory, trim};
use super::window::{Entry, Window};
use crate::control::Control;
use crate::error::Result;
use crate::mesh::topology::{NONE, next, prev, start};
use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap, VecDeque};

/// The windows that wait on one half-edge.
#[derive(Debug, Default)]
struct List {
    windows: Vec<Window>,
    entry: Option<Entry>,
    queued: bool,
}

/// The state of one propagation; all lengths in units.
pub(crate) struct Front<'a> {
    solver: &'a Prepared,
    /// Least distance known of each vertex.
    label: Vec<f64>,
    settled: Vec<bool>,
    /// Labelled vertices, nearest first; an entry that no longer equals its label is stale.
    heap: BinaryHeap<Reverse<(u64, u32)>>,
    /// The list of each half-edge, or NONE.
    waiting: Vec<u32>,
    lists: Vec<List>,
    free: Vec<u32>,
    /// Half-edges whose lists are to cross.
    queue: VecDeque<u32>,
    /// What crossed each half-edge of the triangles that remember.
    memory: HashMap<u32, Memory>,
    scratch: Vec<Window>,
    crossed: u64,
}

/// In slivers, paths that differ by this share are equal: more than the rounding of a few crossings.
const TIE: f64 = 1e-14;

/// How often the control is consulted: every so many settled vertices.
const CHECK_EVERY: usize = 256;

impl<'a> Front<'a> {
    pub(crate) fn new(solver: &'a Prepared) -> Front<'a> {
        let vertices = solver.mesh.vertex_count();
        Front {
            solver,
            label: vec![f64::INFINITY; vertices],
            settled: vec![false; vertices],
            heap: BinaryHeap::new(),
            waiting: vec![NONE; solver.charts.len()],
            lists: Vec::new(),
            free: Vec::new(),
            queue: VecDeque::new(),
            memory: HashMap::new(),
            scratch: Vec::new(),
            crossed: 0,
        }
    }

    /// Starts from vertex `v` at `distance`, which must not be negative.
    pub(crate) fn start(&mut self, v: u32, distance: f64) {
        self.relax(v, distance);
    }

    /// Propagates until nothing is left or every target's distance is final; returns the radius up to which all labels
    /// are final.
    pub(crate) fn run(&mut self, sources: &[bool], targets: &[u32], control: &Control) -> Result<f64> {
        let vertices = self.label.len();
        let mut settled = 0;
        while let Some(Reverse((key, v))) = self.heap.pop() {
            let distance = f64::from_bits(key);
            if distance > self.label[v as usize] {
                continue;
            }
            // A list waits for an apex that is not nearer than `distance`, so its windows start at most one edge before.
            let radius = distance - self.solver.longest_edge;
            if !targets.is_empty() && targets.iter().all(|&t| self.label[t as usize] <= radius) {
                return Ok(radius);
            }
            if settled % CHECK_EVERY == 0 {
                control.checkpoint(settled as f64 / vertices as f64)?;
            }
            settled += usize::from(!self.settled[v as usize]);
            self.settle(v, sources[v as usize]);
            while let Some(h) = self.queue.pop_front() {
                self.cross(h);
            }
        }
        control.checkpoint(1.0)?;
        Ok(f64::INFINITY)
    }

    /// Distance of each vertex.
    pub(crate) fn into_labels(self) -> Vec<f64> {
        self.label
    }

    /// How many windows have crossed a triangle.
    pub(crate) fn crossed(&self) -> u64 {
        self.crossed
    }

    fn settle(&mut self, v: u32, is_source: bool) {
        self.settled[v as usize] = true;
        let solver = self.solver;
        for &h in solver.mesh.topology().corners.row(v) {
            self.enqueue(next(h));
        }
        if is_source || solver.pseudo_source[v as usize] {
            self.emit(v);
        }
    }

    /// Lets the list of half-edge h cross, if there is one and it is not about to anyway.
    fn enqueue(&mut self, h: u32) {
        if let Some(list) = self.lists.get_mut(self.waiting[h as usize] as usize)
            && !list.queued
        {
            list.queued = true;
            self.queue.push_back(h);
        }
    }

    /// Throws windows from vertex v through all its triangles, and walks its edges.
    fn emit(&mut self, v: u32) {
        let solver = self.solver;
        let triangles = solver.mesh.triangles();
        let sigma = self.label[v as usize];
        for &h in solver.mesh.topology().corners.row(v) {
            let (opposite, back) = (next(h), prev(h));
            self.relax(start(triangles, opposite), sigma + solver.charts[h as usize].length);
            self.relax(start(triangles, back), sigma + solver.charts[back as usize].length);
            let chart = solver.charts[opposite as usize];
            let window = Window { b0: 0.0, b1: chart.length, sx: chart.tx, sy: chart.ty, sigma };
            self.deliver(opposite, start(triangles, opposite), window);
        }
    }

    fn relax(&mut self, v: u32, distance: f64) {
        if distance < self.label[v as usize] {
            self.label[v as usize] = distance;
            // Not negative, so its bits order as it does.
            self.heap.push(Reverse((distance.to_bits(), v)));
        }
    }

    /// Hands a window that leaves a triangle by half-edge h to every other triangle on that edge. It is measured from
    /// the edge's end `origin`.
    fn deliver(&mut self, h: u32, origin: u32, window: Window) {
        if window.b0 >= window.b1 {
            return;
        }
        let solver = self.solver;
        let topology = solver.mesh.topology();
        for &g in topology.halfedges.row(topology.edge_of[h as usize]) {
            if g != h {
                let starts_here = start(solver.mesh.triangles(), g) == origin;
                let length = solver.charts[h as usize].length;
                self.arrive(g, if starts_here { window } else { window.mirrored(length) });
            }
        }
    }

    /// Puts a window on the list of half-edge h and labels the apex.
    fn arrive(&mut self, h: u32, window: Window) {
        let entry = window.entry(&self.solver.charts[h as usize]);
        let apex = start(self.solver.mesh.triangles(), prev(h));
        self.relax(apex, entry.distance);
        let list = self.list_of(h);
        list.windows.push(window);
        list.entry = Some(list.entry.unwrap_or(Entry::NONE).min(entry));
        if self.settled[apex as usize] {
            self.enqueue(h);
        }
    }

    fn list_of(&mut self, h: u32) -> &mut List {
        let slot = &mut self.waiting[h as usize];
        if *slot == NONE {
            *slot = self.free.pop().unwrap_or_else(|| {
                self.lists.push(List::default());
                (self.lists.len() - 1) as u32 // fits: there are no more lists than half-edges
            });
        }
        &mut self.lists[*slot as usize]
    }

    /// Moves the list of half-edge h over its triangle.
    fn cross(&mut self, h: u32) {
        let id = std::mem::replace(&mut self.waiting[h as usize], NONE);
        let list = &mut self.lists[id as usize];
        list.queued = false;
        let mut windows = std::mem::take(&mut list.windows);
        let entry = list.entry.take().unwrap_or(Entry::NONE);
        self.drop_dominated(h, &mut windows);
        trim(&mut windows, &mut self.scratch);
        if self.solver.remembers[(h / 3) as usize] {
            let length = self.solver.charts[h as usize].length;
            let memory = self.memory.entry(h).or_insert_with(|| Memory::new(length, TIE));
            memory.keep_news(&mut windows, &mut self.scratch);
        }
        self.crossed += windows.len() as u64;
        self.throw(h, &windows, self.split_point(h, entry));
        windows.clear();
        self.lists[id as usize].windows = windows;
        self.free.push(id);
    }

    /// Drops windows that a path over an end of the edge beats at each of their points: by the triangle inequality it
    /// does if it does at the far end of the window. In a sliver, whose corners are pseudo-sources and throw such rays
    /// themselves, a tie is enough: rays that graze the edge would wind around the sliver for ever.
    fn drop_dominated(&self, h: u32, windows: &mut Vec<Window>) {
        let solver = self.solver;
        let [at_a, at_b] = [h, next(h)].map(|h| self.label[start(solver.mesh.triangles(), h) as usize]);
        let length = solver.charts[h as usize].length;
        let share = if solver.sliver[(h / 3) as usize] { 1.0 - TIE } else { 1.0 };
        windows.retain(|w| {
            let (over_a, over_b) = (at_a + w.b1, at_b + (length - w.b0));
            over_a * share >= w.distance(w.b1) && over_b * share >= w.distance(w.b0)
        });
    }

    /// p*: where the shortest known path over this edge to the apex crosses it. The ends of the edge count too.
    fn split_point(&self, h: u32, entry: Entry) -> f64 {
        let solver = self.solver;
        let over_end = |end: u32, side: u32, at: f64| {
            let label = self.label[start(solver.mesh.triangles(), end) as usize];
            Entry { distance: label + solver.charts[side as usize].length, at }
        };
        let length = solver.charts[h as usize].length;
        entry.min(over_end(h, prev(h), 0.0)).min(over_end(next(h), next(h), length)).at
    }

    /// Throws the children of disjoint sorted windows: left of `split` to the side at the edge's start, right of it to
    /// the other.
    fn throw(&mut self, h: u32, windows: &[Window], split: f64) {
        let solver = self.solver;
        let (to_start, to_end) = (prev(h), next(h));
        let triangles = solver.mesh.triangles();
        let (a, b) = (start(triangles, h), start(triangles, to_end));
        let chart = solver.charts[h as usize];
        let mirrored = chart.mirrored();
        let (left_side, right_side) = (solver.charts[to_start as usize].length, solver.charts[to_end as usize].length);
        for window in windows.iter().take_while(|window| window.b0 < split) {
            if let Some(child) = window.left_child(&chart, left_side, split) {
                self.deliver(to_start, a, child);
            }
        }
        for window in windows.iter().skip_while(|window| window.b1 <= split) {
            let seen_from_end = window.mirrored(chart.length);
            if let Some(child) = seen_from_end.left_child(&mirrored, right_side, chart.length - split) {
                self.deliver(to_end, b, child);
            }
        }
    }
}
