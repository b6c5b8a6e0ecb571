//! The graph of a symmetric pattern: a vertex for each row, an edge for each entry off the diagonal; and what is made of
//! it: the part that some vertices span, and the graph of clusters of vertices.
//!
//! Cost: each takes time linear in the edges.

use super::too_large;
use crate::error::Result;
use nalgebra_sparse::pattern::SparsityPattern;

/// In place of a number that is not known yet.
const NONE: u32 = u32::MAX;

/// A graph with weighted vertices.
#[derive(Debug)]
pub(super) struct Graph {
    /// Where the neighbours of each vertex begin, and at last where they end.
    starts: Vec<u32>,
    neighbours: Vec<u32>,
    weights: Vec<u32>,
}

/// The number of the cluster that each vertex of a graph is in, and how many clusters there are.
pub(super) struct Clusters {
    pub(super) of: Vec<u32>,
    pub(super) count: usize,
}

impl Graph {
    /// The graph of the lower triangle `pattern`, with weights of 1, and neighbours in ascending order.
    ///
    /// # Errors
    /// [`Reason::TooManyElements`](crate::Reason) where 32-bit indices do not suffice.
    pub(super) fn new(pattern: &SparsityPattern) -> Result<Graph> {
        let size = pattern.major_dim();
        if size >= i32::MAX as usize || pattern.nnz() > i32::MAX as usize / 2 {
            return Err(too_large());
        }
        let edges = || pattern.entries().filter(|(j, i)| i != j);
        let mut starts = vec![0; size + 1];
        edges().for_each(|(j, i)| [i, j].into_iter().for_each(|v| starts[v + 1] += 1));
        (0..size).for_each(|v| starts[v + 1] += starts[v]);
        let mut next = starts.clone();
        let mut neighbours = vec![0; starts[size] as usize];
        for (j, i) in edges() {
            for (v, u) in [(i, j), (j, i)] {
                neighbours[next[v] as usize] = u as u32; // fits, as just checked
                next[v] += 1;
            }
        }
        Ok(Graph { starts, neighbours, weights: vec![1; size] })
    }

    pub(super) fn size(&self) -> usize {
        self.weights.len()
    }

    /// Where the neighbours of each vertex begin in the second array, and at last where they end.
    pub(super) fn adjacency(&self) -> (&[u32], &[u32]) {
        (&self.starts, &self.neighbours)
    }

    pub(super) fn neighbours(&self, v: u32) -> &[u32] {
        &self.neighbours[self.starts[v as usize] as usize..self.starts[v as usize + 1] as usize]
    }

    pub(super) fn weight(&self, v: u32) -> u32 {
        self.weights[v as usize]
    }

    fn vertices(&self) -> std::ops::Range<u32> {
        0..self.size() as u32 // fits: `new` counts by u32, and the others make no more
    }

    /// The graph that the given vertices span.
    pub(super) fn part(&self, vertices: &[u32]) -> Graph {
        let mut number = vec![NONE; self.size()];
        (0..).zip(vertices).for_each(|(i, &v)| number[v as usize] = i);
        let mut starts = vec![0];
        let mut neighbours = Vec::with_capacity(vertices.iter().map(|&v| self.neighbours(v).len()).sum());
        for &v in vertices {
            neighbours.extend(self.neighbours(v).iter().map(|&u| number[u as usize]).filter(|&u| u != NONE));
            starts.push(neighbours.len() as u32); // fits: no more than in this graph
        }
        Graph { starts, neighbours, weights: vertices.iter().map(|&v| self.weight(v)).collect() }
    }

    /// Clusters of a vertex and its neighbours, one after the other as long as all of these are free; the rest join the
    /// lightest cluster beside them. Vertices without neighbours make pairs.
    pub(super) fn clusters(&self) -> Clusters {
        let mut of = vec![NONE; self.size()];
        let mut weights: Vec<u32> = Vec::new();
        let mut single = None;
        for v in self.vertices() {
            let neighbours = self.neighbours(v);
            if of[v as usize] != NONE || neighbours.iter().any(|&u| of[u as usize] != NONE) {
                continue;
            }
            let pair = if neighbours.is_empty() { single.take() } else { None };
            let cluster = pair.unwrap_or(weights.len() as u32);
            if pair.is_none() {
                weights.push(0);
                single = if neighbours.is_empty() { Some(cluster) } else { single };
            }
            for &u in neighbours.iter().chain([&v]) {
                of[u as usize] = cluster;
                weights[cluster as usize] += self.weight(u);
            }
        }
        for v in self.vertices() {
            if of[v as usize] != NONE {
                continue;
            }
            let beside = self.neighbours(v).iter().map(|&u| of[u as usize]).filter(|&cluster| cluster != NONE);
            if let Some(cluster) = beside.min_by_key(|&cluster| (weights[cluster as usize], cluster)) {
                of[v as usize] = cluster;
                weights[cluster as usize] += self.weight(v);
            }
        }
        Clusters { of, count: weights.len() }
    }

    /// The graph of the clusters: as heavy as their vertices, and neighbours where any of these are.
    pub(super) fn contract(&self, clusters: &Clusters) -> Graph {
        let (begin, members) = members(clusters);
        let mut last_seen_by = vec![NONE; clusters.count];
        let mut starts = vec![0];
        let mut neighbours = Vec::with_capacity(self.neighbours.len() / 4);
        let mut weights = vec![0; clusters.count];
        for (k, cluster) in (0..clusters.count as u32).zip(begin.windows(2)) {
            last_seen_by[k as usize] = k;
            for &v in &members[cluster[0] as usize..cluster[1] as usize] {
                weights[k as usize] += self.weight(v);
                for &u in self.neighbours(v) {
                    let other = clusters.of[u as usize];
                    if std::mem::replace(&mut last_seen_by[other as usize], k) != k {
                        neighbours.push(other);
                    }
                }
            }
            starts.push(neighbours.len() as u32); // fits: no more than in this graph
        }
        Graph { starts, neighbours, weights }
    }
}

/// Where the vertices of each cluster begin in the second array, and at last where they end.
fn members(clusters: &Clusters) -> (Vec<u32>, Vec<u32>) {
    let mut begin = vec![0; clusters.count + 1];
    clusters.of.iter().for_each(|&cluster| begin[cluster as usize + 1] += 1);
    (0..clusters.count).for_each(|k| begin[k + 1] += begin[k]);
    let mut next = begin.clone();
    let mut members = vec![0; clusters.of.len()];
    for (v, &cluster) in (0..).zip(&clusters.of) {
        members[next[cluster as usize] as usize] = v;
        next[cluster as usize] += 1;
    }
    (begin, members)
}
