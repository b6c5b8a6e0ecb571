//! Propagation: how windows travel over the mesh.
//!
//! Every half-edge h keeps one list of the windows that wait to enter its triangle. When windows arrive, the triangle's
//! apex is labelled with the shortest path over them. A heap hands out labelled vertices, nearest first: a vertex that
//! is handed out is *settled*, the lists that wait for it as their apex cross their triangles as a whole, and a
//! pseudo-source among the vertices throws new windows, over those of its triangles that hold a direction into which the
//! path that came can bend (all of them at a source). Windows that arrive where the apex is settled cross at once. Order
//! decides speed, never exactness: a label can still fall after its vertex was settled, and then the vertex is handed out
//! again.
//!
//! Before a list crosses (A, B the ends of its edge, C the apex)
//! - a window is dropped if a path over A or over B is shorter at each of its points (Xin, Wang 2009). Such windows lie at
//!   the ends of a list, and there they are looked for; where windows come late, behind the front, all are tested: rays
//!   that wind around a vertex would else go on for ever;
//! - the windows are trimmed against each other, [`envelope`](super::envelope), where they came over more than one edge.
//!
//! Each list of n windows throws n + 1 at most, but where two overlap.
//!
//! Around *slivers* a straight line may cross triangles for ever without growing longer, and rounding decides on which
//! side of a vertex it passes. There every vertex is a pseudo-source, ties are dropped, triangles remember what crossed
//! them ([`Memory`]), and a pseudo-source that lies on an edge throws its windows beyond that edge.
//!
//! References: Xin, Wang, "Improving Chen and Han's algorithm on the discrete geodesic problem", ACM TOG 28 (2009);
//! Qin, Han, Yu, Yu, Zhang, "Fast and exact discrete geodesic computation based on triangle-oriented wavefront
//! propagation", ACM TOG 35 (2016).

use super::Prepared;
use super::bends::Bend;
use super::charts::SEVERAL;
use super::envelope::{Limits, Memory, Scratch, trim};
use super::kept::Kept;
use super::stop::{Open, Stop, Watch, rho};
use super::window::{Entry, Rays, Turn, Window};
use crate::control::Piece;
use crate::error::Result;
use crate::mesh::topology::{NONE, next, prev};
use crate::surface::curve::Segment;
use crate::surface::point::others;
use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap, VecDeque};

/// The windows that wait on one half-edge.
#[derive(Debug, Default)]
struct List<R> {
    windows: Vec<Window<R>>,
    is_queued: bool,
    /// How often windows arrived.
    runs: u32,
    /// Whether some arrived after the apex was settled.
    is_late: bool,
}

/// The last straight piece of a path to a vertex: it comes over the opposite half-edge h of one of its triangles, at the
/// place `at`, from what lies unfolded at (sx, -sy) in the chart of h: a pseudo-source, or a place of a source that is no
/// vertex. One in the triangle itself has sy < 0. For a vertex of a source h is NONE.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Arrival {
    pub(crate) h: u32,
    pub(crate) emission: u32,
    pub(crate) at: f64,
    pub(crate) sx: f64,
    pub(crate) sy: f64,
}

impl Arrival {
    /// Over a window on half-edge h.
    pub(crate) fn over<R: Rays>(h: u32, entry: &Entry<R>, emissions: &[Emission]) -> Arrival {
        let Entry { at, emission, .. } = *entry;
        let [sx, sy] = entry.start(|| emissions[emission as usize].sigma);
        Arrival { h, emission, at, sx, sy }
    }
}

/// A throw of windows.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Emission {
    /// The pseudo-source that threw them, or NONE: a point or curve that is a source.
    pub(crate) vertex: u32,
    /// The source from which the shortest path to it comes, counted as the caller does.
    pub(crate) source: u32,
    /// Its distance.
    pub(crate) sigma: f64,
}

/// What a propagation found.
#[derive(Debug)]
pub(crate) struct Found {
    /// Distance of each vertex, in units above the least start distance.
    pub(crate) label: Vec<f64>,
    pub(crate) arrival: Vec<Arrival>,
    pub(crate) emissions: Vec<Emission>,
    pub(crate) kept: Option<Kept>,
    /// The sources that are no vertices, by triangle.
    inner: Vec<Inner>,
    /// How many windows crossed a triangle.
    pub(crate) crossed: u64,
}

/// A source that is no vertex, or a segment of it, in one of the triangles that it lies in.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Inner {
    /// A point is a segment whose ends are one.
    pub(crate) segment: Segment,
    pub(crate) emission: u32,
}

impl Found {
    /// The sources in a triangle that are no vertices.
    pub(crate) fn inner_of(&self, face: u32) -> &[Inner] {
        let first = self.inner.partition_point(|inner| inner.segment.face < face);
        let count = self.inner[first..].partition_point(|inner| inner.segment.face == face);
        &self.inner[first..first + count]
    }
}

/// The state of one propagation; all lengths in units.
pub(crate) struct Front<'a, R> {
    pub(super) solver: &'a Prepared,
    /// Least distance known of each vertex.
    label: Vec<f64>,
    /// How the shortest path known comes to each vertex.
    arrival: Vec<Arrival>,
    emissions: Vec<Emission>,
    /// Which vertices are sources, or next to one: they throw windows into all directions.
    pub(super) is_source: Vec<bool>,
    /// The vertices with a label.
    reached: Vec<u32>,
    /// Label of each vertex when it was last settled; +inf before.
    settled: Vec<f64>,
    /// Labelled vertices, nearest first.
    heap: BinaryHeap<Reverse<(u64, u32)>>,
    /// The list of each half-edge, or NONE.
    waiting: Vec<u32>,
    lists: Vec<List<R>>,
    free: Vec<u32>,
    /// Half-edges whose lists are to cross.
    queue: VecDeque<u32>,
    /// What crossed each half-edge of the triangles that remember.
    memory: HashMap<u32, Memory<R>>,
    /// The windows that crossed, if they are wanted.
    kept: Option<Kept>,
    pub(super) inner: Vec<Inner>,
    scratch: Scratch<R>,
    crossed: u64,
}

/// Around slivers, paths that differ by this share are equal: more than the rounding of a few crossings.
const TIE: f64 = 1e-14;

impl<'a, R: Rays> Front<'a, R> {
    pub(crate) fn new(solver: &'a Prepared) -> Front<'a, R> {
        let vertices = solver.mesh.vertex_count();
        Front {
            solver,
            label: vec![f64::INFINITY; vertices],
            arrival: vec![Arrival { h: NONE, emission: NONE, at: 0.0, sx: 0.0, sy: 0.0 }; vertices],
            emissions: Vec::new(),
            is_source: vec![false; vertices],
            reached: Vec::new(),
            kept: None,
            inner: Vec::new(),
            settled: vec![f64::INFINITY; vertices],
            heap: BinaryHeap::new(),
            waiting: vec![NONE; solver.charts.len()],
            lists: Vec::new(),
            free: Vec::new(),
            queue: VecDeque::new(),
            memory: HashMap::new(),
            scratch: Scratch::default(),
            crossed: 0,
        }
    }

    /// Lets a window leave a triangle by its half-edge h.
    pub(super) fn throw(&mut self, h: u32, window: Window<R>) {
        let chart = &self.solver.charts[h as usize];
        self.pass(h, chart.start, std::iter::once(window));
        if window.starts_on_edge(chart.length) {
            self.pass_on(h, chart.start, window);
        }
    }

    pub(super) fn add_emission(&mut self, vertex: u32, source: u32, sigma: f64) -> u32 {
        self.emissions.push(Emission { vertex, source, sigma });
        (self.emissions.len() - 1) as u32
    }

    /// Propagates until nothing is left, the stopping rule is met, or the control interrupts it, which is the error. The
    /// number is ρ: labels below it are final.
    pub(crate) fn run(&mut self, stop: &mut Stop, control: Piece) -> (f64, Result<()>) {
        let vertices = self.label.len() as f64;
        let mut watch = Watch::new(control);
        let (mut settled, mut steps) = (0u64, 0u64);
        while let Some(Reverse((key, v))) = self.heap.pop() {
            if !self.is_open(v) {
                continue;
            }
            let nearest = (f64::from_bits(key), v);
            if stop.is_met(nearest.0, &self.label, || self.all_open(nearest)) {
                control.report(1.0);
                return (rho(self.all_open(nearest)), Ok(()));
            }
            settled += u64::from(!self.is_settled(v));
            self.settle(v);
            loop {
                steps += 1;
                let work = steps + self.crossed;
                let parts = self.lists.len() + self.memory.len();
                if watch.is_due(work)
                    && let Err(error) = watch.check(work, settled as f64 / vertices, parts, || self.bytes())
                {
                    return (rho(self.all_open(nearest)), Err(error));
                }
                let Some(h) = self.queue.pop_front() else { break };
                self.cross(h);
            }
        }
        control.report(1.0);
        (f64::INFINITY, Ok(()))
    }

    /// Whether a vertex of the heap is to be settled. A label that fell by rounding only since its vertex was settled
    /// changes nothing: around triangles without area labels could else fall by one bit at a time, for ever.
    fn is_open(&self, v: u32) -> bool {
        self.label[v as usize] < self.settled[v as usize] * (1.0 - TIE)
    }

    /// The vertices of the heap, and the one that was last taken from it, each with its distance.
    fn all_open(&self, nearest: (f64, u32)) -> impl Iterator<Item = Open> {
        let heap = self.heap.iter().map(|&Reverse((key, v))| (f64::from_bits(key), v));
        heap.filter(|&(_, v)| self.is_open(v)).chain([nearest]).map(|(distance, v)| {
            let charts = &self.solver.charts;
            let edges = self.solver.mesh.topology().corners.row(v).iter().flat_map(|&h| [h, prev(h)]);
            Open { distance, reach: edges.map(|h| charts[h as usize].length).fold(0.0, f64::max) }
        })
    }

    /// The memory in use, beyond what the solver has.
    fn bytes(&self) -> usize {
        let of_vertex = 2 * size_of::<f64>() + size_of::<Arrival>() + size_of::<bool>();
        let windows = self.lists.iter().map(|list| list.windows.capacity()).sum::<usize>()
            + self.memory.values().map(Memory::capacity).sum::<usize>()
            + self.scratch.capacity();
        self.label.len() * of_vertex
            + self.waiting.len() * size_of::<u32>()
            + self.heap.capacity() * size_of::<Reverse<(u64, u32)>>()
            + self.lists.capacity() * size_of::<List<R>>()
            + (self.free.capacity() + self.queue.capacity() + self.reached.capacity()) * size_of::<u32>()
            + self.emissions.capacity() * size_of::<Emission>()
            + self.inner.capacity() * size_of::<Inner>()
            + self.kept.as_ref().map_or(0, Kept::bytes)
            + self.memory.capacity() * size_of::<(u32, Memory<R>)>()
            + windows * size_of::<Window<R>>()
    }

    /// Keeps every window from now on.
    pub(crate) fn keep_windows(&mut self) {
        self.kept = Some(Kept::default());
    }

    /// The vertices that have a label, in no order.
    pub(crate) fn reached(&self) -> &[u32] {
        &self.reached
    }

    /// The label of a vertex.
    pub(crate) fn label(&self, v: u32) -> f64 {
        self.label[v as usize]
    }

    /// Forgets all but the memory that was taken; costs as much as what was reached.
    pub(crate) fn clear(&mut self) {
        for v in std::mem::take(&mut self.reached) {
            self.label[v as usize] = f64::INFINITY;
            self.settled[v as usize] = f64::INFINITY;
            self.is_source[v as usize] = false;
            // Work that ended early leaves lists that wait for v.
            for &h in self.solver.mesh.topology().corners.row(v) {
                let id = std::mem::replace(&mut self.waiting[next(h) as usize], NONE);
                if let Some(list) = self.lists.get_mut(id as usize) {
                    let mut windows = std::mem::take(&mut list.windows);
                    windows.clear();
                    *list = List { windows, ..List::default() };
                    self.free.push(id);
                }
            }
        }
        self.heap.clear();
        self.queue.clear();
        self.emissions.clear();
        self.inner.clear();
        self.memory.clear();
        self.crossed = 0;
    }

    /// What it found.
    pub(crate) fn finish(mut self) -> Found {
        if let Some(kept) = &mut self.kept {
            // Work that ended early leaves windows waiting.
            for (h, &list) in (0..).zip(&self.waiting).filter(|&(_, &list)| list != NONE) {
                kept.push(h, &self.lists[list as usize].windows);
            }
            kept.sort();
        }
        let Front { label, arrival, emissions, kept, mut inner, crossed, .. } = self;
        inner.sort_by_key(|inner| inner.segment.face);
        Found { label, arrival, emissions, kept, inner, crossed }
    }

    fn settle(&mut self, v: u32) {
        let is_source = self.is_source[v as usize];
        self.settled[v as usize] = self.label[v as usize];
        let solver = self.solver;
        for &h in solver.mesh.topology().corners.row(v) {
            self.enqueue(next(h));
        }
        match solver.bends.at(v) {
            Bend::Wedge { is_closed } if !is_source => self.emit(v, self.wedge(v, is_closed)),
            Bend::Nowhere if !is_source => {}
            _ => self.emit(v, solver.mesh.topology().corners.row(v).iter().copied()),
        }
    }

    /// Lets the list of half-edge h cross, if there is one and it is not about to anyway.
    fn enqueue(&mut self, h: u32) {
        if let Some(list) = self.lists.get_mut(self.waiting[h as usize] as usize)
            && !list.is_queued
        {
            list.is_queued = true;
            self.queue.push_back(h);
        }
    }

    /// Goes along the sides of some of the corners at v, and throws windows from v through their triangles.
    fn emit(&mut self, v: u32, corners: impl Iterator<Item = u32>) {
        let solver = self.solver;
        let sigma = self.label[v as usize];
        let came = self.arrival[v as usize].emission;
        let emission = self.add_emission(v, self.emissions[came as usize].source, sigma);
        for h in corners {
            let (opposite, back) = (next(h), prev(h));
            let back_length = solver.charts[back as usize].length;
            let from_end = Arrival { h: back, emission, at: back_length, sx: back_length, sy: 0.0 };
            let from_start = Arrival { h, emission, at: 0.0, sx: 0.0, sy: 0.0 };
            self.relax(solver.start(opposite), sigma + solver.charts[h as usize].length, from_end);
            self.relax(solver.start(back), sigma + back_length, from_start);
            let chart = solver.charts[opposite as usize];
            let rays = R::default();
            let window = Window { b0: 0.0, b1: chart.length, sx: chart.tx, sy: chart.ty, sigma, emission, rays };
            self.throw(opposite, window);
        }
    }

    /// Where a pseudo-source lies on the edge of half-edge h, opposite to it in a triangle without area, a window on that
    /// edge cannot hold all the directions from it: the triangles beyond the edge pass them on at once.
    fn pass_on(&mut self, h: u32, origin: u32, window: Window<R>) {
        let solver = self.solver;
        let mut thrown = vec![(h, origin, window)];
        let mut passed = Vec::new();
        while let Some((h, origin, window)) = thrown.pop() {
            for g in solver.others(h) {
                let length = solver.charts[g as usize].length;
                let window = if solver.start(g) == origin { window } else { window.mirrored(length) };
                if window.starts_on_edge(length) && !passed.contains(&g) {
                    passed.push(g);
                    let [left, right] = solver.sides(g);
                    let to_left = window.left_child(&left.turn);
                    let to_right = window.right_child(&right.turn, length);
                    for (side, child) in [(left, to_left), (right, to_right)] {
                        self.pass(side.h, side.origin, child.into_iter());
                        thrown.extend(child.map(|child| (side.h, side.origin, child)));
                    }
                }
            }
        }
    }

    /// The corners at v, a fan, with directions into which the path that came can bend.
    fn wedge(&self, v: u32, is_closed: bool) -> impl Iterator<Item = u32> + use<'a, R> {
        let solver = self.solver;
        let Arrival { h, at, .. } = self.arrival[v as usize];
        let chart = solver.charts[h as usize];
        // The angle at the apex from the half-edge that starts there to the way the path came.
        let came = (at * chart.ty).atan2(chart.tx * (chart.tx - at) + chart.ty * chart.ty);
        let range = solver.mesh.topology().corners.range(v);
        solver.bends.wedge(&solver.charts, range, is_closed, prev(h), came)
    }

    fn is_settled(&self, v: u32) -> bool {
        self.settled[v as usize] < f64::INFINITY
    }

    pub(super) fn relax(&mut self, v: u32, distance: f64, arrival: Arrival) {
        let label = &mut self.label[v as usize];
        if distance < *label {
            if *label == f64::INFINITY {
                self.reached.push(v);
            }
            // Two vertices at one place could else be told to come from each other.
            if distance < *label * (1.0 - TIE) {
                self.arrival[v as usize] = arrival;
            }
            *label = distance;
            // Not negative, so its bits order as it does.
            self.heap.push(Reverse((distance.to_bits(), v)));
        }
    }

    /// Puts windows, measured from the end `origin` of its edge, on the list of half-edge h and labels the apex. One that
    /// starts on the edge itself is not put there: it has come back to its own pseudo-source, which has thrown it beyond
    /// the edge already.
    fn arrive(&mut self, h: u32, origin: u32, windows: impl Iterator<Item = Window<R>>) {
        let chart = self.solver.charts[h as usize];
        let apex = self.solver.start(prev(h));
        let is_mirrored = chart.start != origin;
        let mut entry = Entry { distance: self.label[apex as usize], ..Entry::default() };
        let is_late = self.is_settled(apex);
        let list = self.list_of(h);
        let before = list.windows.len();
        let mut has_arrived = false;
        for window in windows {
            let window = if is_mirrored { window.mirrored(chart.length) } else { window };
            entry = window.entry(&chart, entry);
            has_arrived = true;
            if !window.starts_on_edge(chart.length) {
                list.windows.push(window);
            }
        }
        if is_mirrored {
            list.windows[before..].reverse();
        }
        if !has_arrived {
            return self.release(h);
        }
        list.runs += 1;
        list.is_late |= is_late;
        self.relax(apex, entry.distance, Arrival::over(h, &entry, &self.emissions));
        if is_late {
            self.enqueue(h);
        }
    }

    /// Takes the list from half-edge h if nothing waits there.
    fn release(&mut self, h: u32) {
        let id = self.waiting[h as usize];
        if self.lists[id as usize].runs == 0 {
            self.waiting[h as usize] = NONE;
            self.free.push(id);
        }
    }

    fn list_of(&mut self, h: u32) -> &mut List<R> {
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
        let List { mut windows, runs, is_late, .. } = std::mem::take(&mut self.lists[id as usize]);
        let solver = self.solver;
        let chart = solver.charts[h as usize];
        let limits = self.limits(h);
        if is_late {
            windows.retain(|window| limits.let_pass(window));
        } else {
            windows.truncate(windows.iter().rposition(|window| limits.let_pass(window)).map_or(0, |last| last + 1));
            windows.drain(..windows.iter().position(|window| limits.let_pass(window)).unwrap_or(0));
        }
        // What arrived at once came over one edge and was trimmed there, or before.
        if runs > 1 {
            trim(&mut windows, runs, chart.ty, &mut self.scratch);
        }
        if solver.remembers[(h / 3) as usize] {
            let longest = chart.length.max(solver.charts[next(h) as usize].length);
            let longest = longest.max(solver.charts[prev(h) as usize].length);
            self.memory.entry(h).or_default().keep_news(&mut windows, &limits, longest, &mut self.scratch);
        }
        self.crossed += windows.len() as u64;
        if let Some(kept) = &mut self.kept {
            kept.push(h, &windows);
        }
        let [left, right] = solver.sides(h);
        self.pass(left.h, left.origin, windows.iter().filter_map(|w| w.left_child(&left.turn)));
        self.pass(right.h, right.origin, windows.iter().filter_map(|w| w.right_child(&right.turn, chart.length)));
        windows.clear();
        self.lists[id as usize].windows = windows;
        self.free.push(id);
    }

    /// Lets windows that leave a triangle by half-edge h, measured from `origin`, arrive in the others on its edge.
    fn pass(&mut self, h: u32, origin: u32, windows: impl Iterator<Item = Window<R>> + Clone) {
        match self.solver.charts[h as usize].twin {
            NONE => {}
            SEVERAL => self.solver.others(h).for_each(|g| self.arrive(g, origin, windows.clone())),
            g => self.arrive(g, origin, windows),
        }
    }

    fn limits(&self, h: u32) -> Limits {
        let [at_a, at_b] = [h, next(h)].map(|h| self.label[self.solver.start(h) as usize]);
        Limits { at_a, at_b, length: self.solver.charts[h as usize].length }
    }
}

impl Prepared {
    /// The vertex where half-edge h starts.
    pub(crate) fn start(&self, h: u32) -> u32 {
        self.charts[h as usize].start
    }

    /// The half-edges on the edge of h besides h.
    pub(crate) fn others(&self, h: u32) -> impl Iterator<Item = u32> {
        others(&self.mesh, h)
    }

    /// The two sides by which windows on half-edge h leave its triangle.
    fn sides(&self, h: u32) -> [Side; 2] {
        let (to_start, to_end) = (prev(h), next(h));
        let [chart, left, right] = [h, to_start, to_end].map(|h| &self.charts[h as usize]);
        [
            Side { h: to_start, origin: chart.start, turn: Turn::left(chart, left.length) },
            Side { h: to_end, origin: left.start, turn: Turn::right(chart, right) },
        ]
    }
}

/// A side by which windows leave a triangle.
struct Side {
    h: u32,
    /// The end of it from which they are measured there.
    origin: u32,
    turn: Turn,
}
