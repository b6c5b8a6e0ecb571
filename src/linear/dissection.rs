//! A fill-reducing ordering: nested dissection, and approximate minimum degree inside parts of some thousand vertices.
//!
//! Without the vertices of a short separator S a graph falls into two sides A and B. No entry of the factor joins these when
//! S comes after both,
//!
//! ```text
//! order(A ∪ S ∪ B) = order(A), order(B), S
//! ```
//!
//! and so on inside A and B. The last columns, which cost most, are then as few as the separators are short; minimum degree,
//! which looks at one vertex at a time, finds longer ones by and by. Below a hundred thousand vertices it loses too little
//! to pay for the search. The same pattern has the same ordering on any machine.
//!
//! Cost: a few passes over the edges for each doubling of the size.
//!
//! References: A. George: Nested Dissection of a Regular Finite Element Mesh. SIAM Journal on Numerical Analysis, 1973.
//! P. R. Amestoy, T. A. Davis, I. S. Duff: An Approximate Minimum Degree Ordering Algorithm. SIAM Journal on Matrix Analysis
//! and Applications, 1996. B. Hendrickson, E. Rothberg: Improving the Run Time and Quality of Nested Dissection Ordering.
//! SIAM Journal on Scientific Computing, 1998.

use super::faer::minimum_degree;
use super::graph::Graph;
use super::ordering::Ordering;
use super::separator::{BETWEEN, separate};
use crate::error::Result;
use nalgebra_sparse::pattern::SparsityPattern;

/// Patterns of no more rows are ordered by minimum degree alone: about where the search costs as much as it saves.
const LARGE: usize = 100_000;
/// Parts of no more vertices are ordered by minimum degree.
const SMALL: usize = 2000;

/// The ordering of the lower triangle `pattern`.
pub(super) fn order(pattern: &SparsityPattern) -> Result<Ordering> {
    let graph = Graph::new(pattern)?;
    let small = if graph.size() > LARGE { SMALL } else { LARGE };
    Ok(Ordering::new(dissected(graph, small)?))
}

/// A part of the graph, and which vertices of the whole its vertices are.
struct Part {
    graph: Graph,
    vertices: Vec<u32>,
}

/// The vertices in order; parts of no more than `small` vertices are not dissected.
fn dissected(graph: Graph, small: usize) -> Result<Vec<u32>> {
    // Built from its end: of two sides and a separator the separator is written first.
    let mut reversed = Vec::with_capacity(graph.size());
    let vertices = (0..graph.size() as u32).collect(); // fits: a graph counts by u32
    let mut parts = vec![Part { graph, vertices }];
    while let Some(part) = parts.pop() {
        match if part.graph.size() > small { part.split() } else { None } {
            Some((sides, separator)) => {
                reversed.extend(separator);
                parts.extend(sides);
            }
            None => {
                let order = minimum_degree(&part.graph)?;
                reversed.extend(order.iter().rev().map(|&v| part.vertices[v as usize]));
            }
        }
    }
    reversed.reverse();
    Ok(reversed)
}

impl Part {
    /// Its two sides, and the vertices that separate them; nothing where a side has less than an eighth of the vertices, or
    /// the separator more than a sixteenth: what has no short separator gains nothing.
    fn split(&self) -> Option<([Part; 2], Vec<u32>)> {
        let places = separate(&self.graph);
        let at = |place| (0..).zip(&places).filter(move |&(_, &at)| at == place).map(|(v, _)| v).collect::<Vec<u32>>();
        let (sides, separator) = ([at(0), at(1)], at(BETWEEN));
        let size = self.graph.size();
        let is_short = separator.len() <= size / 16 && sides.iter().all(|side| side.len() >= size / 8);
        let of_whole = |vertices: &[u32]| vertices.iter().map(|&v| self.vertices[v as usize]).collect();
        is_short.then(|| {
            let part = |side: Vec<u32>| Part { graph: self.graph.part(&side), vertices: of_whole(&side) };
            (sides.map(part), of_whole(&separator))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::faer;
    use proptest::prelude::*;
    use std::sync::Arc;

    type Edge = (usize, usize);

    fn pattern(size: usize, edges: &[Edge]) -> SparsityPattern {
        let off_diagonal = edges.iter().filter(|(u, v)| u != v).map(|&(u, v)| (u.min(v), u.max(v)));
        let mut entries: Vec<Edge> = (0..size).map(|v| (v, v)).chain(off_diagonal).collect();
        entries.sort_unstable();
        entries.dedup();
        let mut offsets = vec![0; size + 1];
        entries.iter().for_each(|&(column, _)| offsets[column + 1] += 1);
        (0..size).for_each(|column| offsets[column + 1] += offsets[column]);
        let rows = entries.into_iter().map(|(_, row)| row).collect();
        SparsityPattern::try_from_offsets_and_indices(size, size, offsets, rows).unwrap()
    }

    fn order_in_parts(pattern: &SparsityPattern, small: usize) -> Vec<u32> {
        dissected(Graph::new(pattern).unwrap(), small).unwrap()
    }

    fn is_permutation(order: &[u32], size: usize) -> bool {
        let mut sorted = order.to_vec();
        sorted.sort_unstable();
        sorted.into_iter().eq(0..size as u32)
    }

    /// `n` x `n` vertices with the diagonals of a triangle mesh.
    fn grid(n: usize) -> SparsityPattern {
        let at = |x: usize, y: usize| y * n + x;
        let beside = |x, y| [(x + 1, y), (x, y + 1), (x + 1, y + 1)].map(move |other| ((x, y), other));
        let edges = (0..n).flat_map(|y| (0..n).flat_map(move |x| beside(x, y)));
        let inside = edges.filter(|&(_, (x, y))| x < n && y < n);
        pattern(n * n, &inside.map(|((x, y), (u, v))| (at(x, y), at(u, v))).collect::<Vec<_>>())
    }

    /// The squares of the column counts of the factor: how many operations it takes.
    fn work(pattern: &SparsityPattern, order: Vec<u32>) -> f64 {
        let structure = faer::structure(pattern, Arc::new(Ordering::new(order))).unwrap();
        structure.column_counts().map(|count| (count as f64).powi(2)).sum()
    }

    const N: usize = 3000;

    fn path(v: usize) -> Edge {
        (v, v.saturating_sub(1))
    }

    fn star(v: usize) -> Edge {
        (N / 2, v)
    }

    #[test]
    fn the_order_is_a_permutation_on_any_graph() {
        let broom = |v| if v < N / 2 { path(v) } else { star(v) };
        let triangles = |v| (v, v / 3 * 3 + (v + 1) % 3);
        let graphs: [fn(usize) -> Edge; 5] = [path, star, broom, triangles, |v| (v, v)];
        for (i, edge) in graphs.into_iter().enumerate() {
            let order = order_in_parts(&pattern(N, &(0..N).map(edge).collect::<Vec<_>>()), 100);
            assert!(is_permutation(&order, N), "graph {i}");
        }
        let complete: Vec<Edge> = (0..300).flat_map(|v| (0..v).map(move |u| (u, v))).collect();
        for (size, edges) in [(0, &complete[..0]), (1, &complete[..0]), (300, &complete), (600, &complete)] {
            assert!(is_permutation(&order_in_parts(&pattern(size, edges), 100), size), "{size}");
        }
    }

    proptest! {
        #[test]
        fn the_order_of_a_random_graph_is_a_permutation_and_always_the_same(
            size in 2usize..800,
            edges in prop::collection::vec((any::<prop::sample::Index>(), any::<prop::sample::Index>()), 0..2000),
            small in 1usize..50,
        ) {
            let edges: Vec<Edge> = edges.iter().map(|(u, v)| (u.index(size), v.index(size))).collect();
            let order = order_in_parts(&pattern(size, &edges), small);
            prop_assert!(is_permutation(&order, size));
            prop_assert_eq!(order, order_in_parts(&pattern(size, &edges), small));
        }
    }

    #[test]
    fn dissection_beats_minimum_degree_on_large_grids() {
        let share = |grid: &SparsityPattern, order| work(grid, order) / work(grid, order_in_parts(grid, usize::MAX));
        let grids = [300, 600].map(grid);
        let small = share(&grids[0], order_in_parts(&grids[0], SMALL));
        assert!(small < 1.1, "{small}");
        let large = share(&grids[1], order(&grids[1]).unwrap().rows().to_vec());
        assert!(large < 0.9, "{large}");
    }
}
