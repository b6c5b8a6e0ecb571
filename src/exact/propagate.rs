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
//! Around *slivers* a straight line may cross triangles for ever without growing longer, and rounding decides on which
//! side of a vertex it passes. There every vertex is a pseudo-source, ties are dropped, triangles remember what crossed
//! them ([`Memory`]), and a pseudo-source that lies on an edge throws its windows beyond that edge.
//!
//! References: Xin, Wang, "Improving Chen and Han's algorithm on the discrete geodesic problem", ACM TOG 28 (2009);
//! Qin, Han, Yu, Yu, Zhang, "Fast and exact discrete geodesic computation based on triangle-oriented wavefront
//! propagation", ACM TOG 35 (2016).

use super::Prepared;
use super::charts::Chart;
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
    /// The shortest path to the apex over any window that arrived.
    entry: Entry,
    queued: bool,
}

/// The state of one propagation; all lengths in units.
pub(crate) struct Front<'a> {
    solver: &'a Prepared,
    /// Least distance known of each vertex.
    label: Vec<f64>,
    /// Label of each vertex when it was last settled; +inf before.
    settled: Vec<f64>,
    /// Labelled vertices, nearest first.
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

/// Around slivers, paths that differ by this share are equal: more than the rounding of a few crossings.
const TIE: f64 = 1e-14;

/// How often the control is consulted: every so many settled vertices.
const CHECK_EVERY: usize = 256;

impl<'a> Front<'a> {
    pub(crate) fn new(solver: &'a Prepared) -> Front<'a> {
        let vertices = solver.mesh.vertex_count();
        Front {
            solver,
            label: vec![f64::INFINITY; vertices],
            settled: vec![f64::INFINITY; vertices],
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
            // A label that fell by rounding only since its vertex was settled changes nothing: around triangles without
            // area labels could else fall by one bit at a time, for ever.
            if self.label[v as usize] >= self.settled[v as usize] * (1.0 - TIE) {
                continue;
            }
            // A list waits for an apex that is not nearer than this one, so its windows start at most one edge before.
            let radius = f64::from_bits(key) - self.solver.longest_edge;
            if !targets.is_empty() && targets.iter().all(|&t| self.label[t as usize] <= radius) {
                return Ok(radius);
            }
            if settled % CHECK_EVERY == 0 {
                control.checkpoint(settled as f64 / vertices as f64)?;
            }
            settled += usize::from(!self.is_settled(v));
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
        self.settled[v as usize] = self.label[v as usize];
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
    ///
    /// Where v lies on the opposite edge of a triangle, which then has no area, a window on that edge could not hold all
    /// the directions from v: the triangles beyond the edge pass them on at once.
    fn emit(&mut self, v: u32) {
        let solver = self.solver;
        let sigma = self.label[v as usize];
        let mut thrown = Vec::new();
        for &h in solver.mesh.topology().corners.row(v) {
            let (opposite, back) = (next(h), prev(h));
            self.relax(solver.start(opposite), sigma + solver.charts[h as usize].length);
            self.relax(solver.start(back), sigma + solver.charts[back as usize].length);
            let chart = solver.charts[opposite as usize];
            let window = Window { b0: 0.0, b1: chart.length, sx: chart.tx, sy: chart.ty, sigma };
            thrown.push((opposite, solver.start(opposite), window));
        }
        let mut passed = Vec::new();
        while let Some((h, origin, window)) = thrown.pop() {
            for (g, window) in solver.beyond(h, origin, window) {
                self.arrive(g, window);
                if window.starts_on_edge(solver.charts[g as usize].length) && !passed.contains(&g) {
                    passed.push(g);
                    thrown.extend(solver.children(g, &window, None).into_iter().flatten());
                }
            }
        }
    }

    fn is_settled(&self, v: u32) -> bool {
        self.settled[v as usize] < f64::INFINITY
    }

    fn relax(&mut self, v: u32, distance: f64) {
        if distance < self.label[v as usize] {
            self.label[v as usize] = distance;
            // Not negative, so its bits order as it does.
            self.heap.push(Reverse((distance.to_bits(), v)));
        }
    }

    /// Puts a window on the list of half-edge h and labels the apex. One that starts on the edge itself is not put there:
    /// it has come back to its own pseudo-source, which has thrown it beyond the edge already.
    fn arrive(&mut self, h: u32, window: Window) {
        let entry = window.entry(&self.solver.charts[h as usize]);
        let apex = self.solver.start(prev(h));
        self.relax(apex, entry.distance);
        if window.starts_on_edge(self.solver.charts[h as usize].length) {
            return;
        }
        let list = self.list_of(h);
        list.windows.push(window);
        list.entry = list.entry.min(entry);
        if self.is_settled(apex) {
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
        let entry = std::mem::take(&mut list.entry);
        self.drop_dominated(h, &mut windows);
        trim(&mut windows, &mut self.scratch);
        if self.solver.remembers[(h / 3) as usize] {
            let length = self.solver.charts[h as usize].length;
            let memory = self.memory.entry(h).or_insert_with(|| Memory::new(length, TIE));
            memory.keep_news(&mut windows, &mut self.scratch);
        }
        self.crossed += windows.len() as u64;
        let split = self.split_point(h, entry);
        for window in &windows {
            for (side, origin, child) in self.solver.children(h, window, Some(split)).into_iter().flatten() {
                for (g, child) in self.solver.beyond(side, origin, child) {
                    self.arrive(g, child);
                }
            }
        }
        windows.clear();
        self.lists[id as usize].windows = windows;
        self.free.push(id);
    }

    /// Drops windows that a path over an end of the edge beats at each of their points: by the triangle inequality it
    /// does if it does at the far end of the window. In a sliver, whose corners are pseudo-sources and throw such rays
    /// themselves, a tie is enough: rays that graze the edge would wind around the sliver for ever.
    fn drop_dominated(&self, h: u32, windows: &mut Vec<Window>) {
        let solver = self.solver;
        let [at_a, at_b] = [h, next(h)].map(|h| self.label[solver.start(h) as usize]);
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
            let label = self.label[solver.start(end) as usize];
            Entry { distance: label + solver.charts[side as usize].length, at }
        };
        let length = solver.charts[h as usize].length;
        entry.min(over_end(h, prev(h), 0.0)).min(over_end(next(h), next(h), length)).at
    }
}

/// A window that leaves a triangle: by which half-edge, from which vertex it is measured, and the window.
type Leaving = (u32, u32, Window);

impl Prepared {
    /// The vertex where half-edge h starts.
    fn start(&self, h: u32) -> u32 {
        start(self.mesh.triangles(), h)
    }

    /// The half-edges by which a window enters the other triangles on the edge of h, each with the window as it lies
    /// there. It is measured from the edge's end `origin`.
    fn beyond(&self, h: u32, origin: u32, window: Window) -> impl Iterator<Item = (u32, Window)> {
        let topology = self.mesh.topology();
        let length = self.charts[h as usize].length;
        topology.halfedges.row(topology.edge_of[h as usize]).iter().filter(move |&&g| g != h).map(move |&g| {
            let starts_here = self.start(g) == origin;
            (g, if starts_here { window } else { window.mirrored(length) })
        })
    }

    /// What a window on half-edge h throws on the two other sides of its triangle; left of `split` to the side at the
    /// edge's start only, right of it to the other, if there is a split.
    fn children(&self, h: u32, window: &Window, split: Option<f64>) -> [Option<Leaving>; 2] {
        let (to_start, to_end) = (prev(h), next(h));
        let chart = self.charts[h as usize];
        let length = chart.length;
        let child = |window: &Window, chart: &Chart, side: u32, limit: Option<f64>, origin: u32| {
            let side_length = self.charts[side as usize].length;
            let child = window.left_child(chart, side_length, limit.unwrap_or(length))?;
            Some((side, origin, child))
        };
        let left = child(window, &chart, to_start, split, self.start(h));
        let from_end = split.map(|split| length - split);
        let right = child(&window.mirrored(length), &chart.mirrored(), to_end, from_end, self.start(to_end));
        [left, right]
    }
}
