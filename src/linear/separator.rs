//! A short separator: few vertices of a graph without which the others fall into two sides, neither of them small.
//!
//! ```text
//! cost = (|S| + 1) / (|A| |B|)      for the sides A and B, and S between them; |.| adds up weights
//! ```
//!
//! A is grown from a few seeds at the coarsest of a row of ever coarser graphs, whose vertices are clusters of those of the
//! one before; then S goes back from graph to graph, and is refined at each: a vertex of S moves to one side and draws its
//! neighbours on the other side into S, at each step the one that makes S lightest, even where S grows for a while; what
//! was cheapest is kept. Sparse graphs of surfaces have separators of about √V vertices.
//!
//! Cost: a few passes over the edges.
//!
//! References: C. M. Fiduccia, R. M. Mattheyses: A Linear-Time Heuristic for Improving Network Partitions. Design
//! Automation Conference, 1982. C. Ashcraft, J. W. H. Liu: Using Domain Decomposition to Find Graph Bisectors. BIT, 1997.
//! B. Hendrickson, E. Rothberg: Improving the Run Time and Quality of Nested Dissection Ordering. SIAM Journal on
//! Scientific Computing, 1998. G. Karypis, V. Kumar: A Fast and High Quality Multilevel Scheme for Partitioning Irregular
//! Graphs. SIAM Journal on Scientific Computing, 1998.

use super::graph::Graph;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Where a vertex is: on side 0 or 1, or in the separator.
pub(super) type Place = u8;
/// The place between the sides.
pub(super) const BETWEEN: Place = 2;

/// Graphs of no more vertices are not made coarser.
const COARSEST: usize = 100;
/// From how many seeds a side is grown.
const SEEDS: usize = 6;
/// How many passes refine the separator of one graph at most.
const PASSES: usize = 3;
/// How many moves in a row may fail to lower the cost before a pass ends.
const PATIENCE: usize = 200;

/// The place of each vertex; all of them may be in one where the graph has no short separator.
pub(super) fn separate(graph: &Graph) -> Vec<Place> {
    let mut coarser = Vec::new();
    let mut coarsest = graph;
    while coarsest.size() > COARSEST {
        let clusters = coarsest.clusters();
        if clusters.count > coarsest.size() / 10 * 9 {
            break;
        }
        let contracted = coarsest.contract(&clusters);
        coarser.push((clusters, contracted));
        coarsest = coarser.last().map_or(graph, |(_, graph)| graph);
    }
    let mut places = grown(coarsest);
    while let Some((clusters, _)) = coarser.pop() {
        let finer = coarser.last().map_or(graph, |(_, graph)| graph);
        let of_clusters = clusters.of.iter().map(|&cluster| places[cluster as usize]).collect();
        places = Separation::new(finer, of_clusters).refined().places;
    }
    places
}

/// The cheapest of the separations grown from several seeds.
fn grown(graph: &Graph) -> Vec<Place> {
    let seeds = (0..SEEDS).map(|k| k * graph.size() / SEEDS);
    let separations = seeds.map(|seed| Separation::grown(graph, seed as u32).refined()); // fits: a vertex
    let cheapest = separations.min_by(|a, b| a.cost().total_cmp(&b.cost()));
    cheapest.map_or_else(Vec::new, |separation| separation.places)
}

/// A vertex that left the separator, and how many had been drawn into it before.
struct Move {
    v: u32,
    drawn: usize,
}

struct Separation<'a> {
    graph: &'a Graph,
    places: Vec<Place>,
    /// The weight of each place.
    weights: [u32; 3],
    /// The weight of the neighbours on each side, for the vertices of the separator.
    beside: Vec<[u32; 2]>,
    /// For each side, the vertices of the separator by what the separator loses when they move there; an entry counts while
    /// this is what its vertex is worth.
    queues: [BinaryHeap<(i64, Reverse<u32>)>; 2],
    /// The vertices that moved since the pass began, which move only once.
    has_moved: Vec<bool>,
    moves: Vec<Move>,
    /// The vertices that were drawn into the separator.
    drawn: Vec<u32>,
}

impl<'a> Separation<'a> {
    fn new(graph: &'a Graph, places: Vec<Place>) -> Separation<'a> {
        let mut weights = [0; 3];
        (0..).zip(&places).for_each(|(v, &place)| weights[place as usize] += graph.weight(v));
        Separation {
            graph,
            weights,
            beside: vec![[0; 2]; places.len()],
            queues: [BinaryHeap::new(), BinaryHeap::new()],
            has_moved: vec![false; places.len()],
            places,
            moves: Vec::new(),
            drawn: Vec::new(),
        }
    }

    /// Side 0 grown from a seed until it is about as heavy as side 1; where nothing is left beside it, from one more seed.
    fn grown(graph: &'a Graph, seed: u32) -> Separation<'a> {
        let mut separation = Separation::new(graph, vec![1; graph.size()]);
        let mut seeds = (seed..graph.size() as u32).chain(0..seed); // fits: a graph counts by u32
        while separation.weights[0] < separation.weights[1] {
            if separation.best(0).is_none() {
                let Some(seed) = seeds.find(|&v| separation.places[v as usize] == 1) else { break };
                separation.draw(seed);
            }
            separation.advance(0);
        }
        separation
    }

    fn refined(mut self) -> Separation<'a> {
        for _ in 0..PASSES {
            if !self.improve() {
                break;
            }
        }
        self
    }

    /// Makes moves for as long as that may help, and takes back those after the least cost; tells whether it fell.
    fn improve(&mut self) -> bool {
        self.begin();
        let first = self.cost();
        let (mut least, mut kept) = (first, 0);
        while self.moves.len() - kept < PATIENCE {
            let Some(side) = self.better_side() else { break };
            self.advance(side);
            let cost = self.cost();
            if cost < least {
                (least, kept) = (cost, self.moves.len());
            }
        }
        self.take_back(kept);
        least < first
    }

    fn begin(&mut self) {
        self.queues.iter_mut().for_each(BinaryHeap::clear);
        self.drawn.clear();
        for moved in self.moves.drain(..) {
            self.has_moved[moved.v as usize] = false;
        }
        for v in 0..self.places.len() as u32 {
            if self.places[v as usize] == BETWEEN {
                self.enter(v);
            }
        }
    }

    fn cost(&self) -> f64 {
        let [a, b, separator] = self.weights.map(f64::from);
        (separator + 1.0) / (a * b)
    }

    /// What the separator loses when `v` moves to a side; none where it may not.
    fn gain(&self, v: u32, side: Place) -> Option<i64> {
        let may_move = self.places[v as usize] == BETWEEN && !self.has_moved[v as usize];
        may_move.then(|| i64::from(self.graph.weight(v)) - i64::from(self.beside[v as usize][1 - side as usize]))
    }

    fn enqueue(&mut self, v: u32, side: Place) {
        if let Some(gain) = self.gain(v, side) {
            self.queues[side as usize].push((gain, Reverse(v)));
        }
    }

    /// The vertex that is best moved to a side, and what is gained.
    fn best(&mut self, side: Place) -> Option<(i64, u32)> {
        while let Some(&(gain, Reverse(v))) = self.queues[side as usize].peek() {
            let now = self.gain(v, side);
            if now == Some(gain) {
                return Some((gain, v));
            }
            self.queues[side as usize].pop();
            // One that has become worth more was queued again then.
            if now.is_some_and(|now| now < gain) {
                self.enqueue(v, side);
            }
        }
        None
    }

    /// The side that the next move should go to: the one with more to gain, the lighter one of equals; but none that would
    /// hold more than three quarters of all.
    fn better_side(&mut self) -> Option<Place> {
        let lighter = Place::from(self.weights[1] < self.weights[0]);
        let most = self.weights.iter().map(|&weight| u64::from(weight)).sum::<u64>() / 4 * 3;
        let to_lighter = self.best(lighter).map(|(gain, _)| gain);
        let weight = u64::from(self.weights[1 - lighter as usize]);
        let to_heavier = self.best(1 - lighter).filter(|&(_, v)| weight + u64::from(self.graph.weight(v)) <= most);
        match (to_lighter, to_heavier.map(|(gain, _)| gain)) {
            (None, None) => None,
            (to_lighter, to_heavier) => Some(if to_lighter >= to_heavier { lighter } else { 1 - lighter }),
        }
    }

    /// Moves the best vertex to a side, and draws its neighbours on the other side into the separator.
    fn advance(&mut self, side: Place) {
        let Some((_, v)) = self.best(side) else { return };
        self.moves.push(Move { v, drawn: self.drawn.len() });
        self.has_moved[v as usize] = true;
        self.set(v, side);
        let graph = self.graph;
        for &u in graph.neighbours(v) {
            if self.places[u as usize] == 1 - side {
                self.draw(u);
            }
        }
    }

    /// Draws a vertex into the separator. Its neighbours there have less to draw from its side then.
    fn draw(&mut self, v: u32) {
        let side = self.places[v as usize];
        self.drawn.push(v);
        self.set(v, BETWEEN);
        self.enter(v);
        let graph = self.graph;
        graph.neighbours(v).iter().for_each(|&u| self.enqueue(u, 1 - side));
    }

    /// Counts and queues a vertex that is in the separator.
    fn enter(&mut self, v: u32) {
        let mut beside = [0; 3];
        for &u in self.graph.neighbours(v) {
            beside[self.places[u as usize] as usize] += self.graph.weight(u);
        }
        self.beside[v as usize] = [beside[0], beside[1]];
        [0, 1].into_iter().for_each(|side| self.enqueue(v, side));
    }

    /// Puts a vertex elsewhere, and tells its neighbours in the separator.
    fn set(&mut self, v: u32, place: Place) {
        let (before, graph, weight) = (self.put(v, place), self.graph, self.graph.weight(v));
        for &u in graph.neighbours(v).iter().filter(|&&u| self.places[u as usize] == BETWEEN) {
            let beside = &mut self.beside[u as usize];
            if before != BETWEEN {
                beside[before as usize] -= weight;
            }
            if place != BETWEEN {
                beside[place as usize] += weight;
            }
        }
    }

    fn put(&mut self, v: u32, place: Place) -> Place {
        let before = std::mem::replace(&mut self.places[v as usize], place);
        self.weights[before as usize] -= self.graph.weight(v);
        self.weights[place as usize] += self.graph.weight(v);
        before
    }

    /// Takes back all moves but the first `kept`. What is counted for the separator counts no more.
    fn take_back(&mut self, kept: usize) {
        for k in (kept..self.moves.len()).rev() {
            let Move { v, drawn } = self.moves[k];
            let side = self.put(v, BETWEEN);
            while self.drawn.len() > drawn {
                let u = self.drawn.swap_remove(drawn);
                self.put(u, 1 - side);
            }
        }
    }
}
