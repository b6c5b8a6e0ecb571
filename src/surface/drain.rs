//! Draining a field: minima are filled up until they flow over, so that from everywhere an edge leads down, to an outlet.
//!
//! The vertices are flooded from the outlets, always from the lowest one at the water's edge on, so that each is reached
//! over its lowest pass; one that is not higher than where it was reached from is raised above that, by one unit in the
//! last place. A field whose minima are all outlets stays as it is.
//!
//! O(V) time where it stays, else O(V log V).
//!
//! References: R. Barnes, C. Lehman, D. Mulla: Priority-Flood: An Optimal Depression-Filling and Watershed-Labeling
//! Algorithm for Digital Elevation Models. Computers & Geosciences, 2014 (with an increment).

use crate::mesh::Mesh;
use crate::mesh::topology::{next, prev, start};
use std::borrow::Cow;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// The field with a way down along edges from each vertex to an outlet, but where none is joined to it by edges between
/// finite values: there nothing changes. The outlets stay as high as they are.
pub(super) fn drained<'a>(mesh: &Mesh, values: &'a [f64], outlets: &[u32]) -> Cow<'a, [f64]> {
    let mut is_outlet = vec![false; values.len()];
    outlets.iter().for_each(|&v| is_outlet[v as usize] = true);
    let runs_off = |v: u32, u: f64| {
        let mut lower = neighbours(mesh, v).map(|w| values[w as usize]).filter(|w| w.is_finite() && *w < u);
        is_outlet[v as usize] || !u.is_finite() || lower.next().is_some()
    };
    if (0..).zip(values).all(|(v, &u)| runs_off(v, u)) {
        return Cow::Borrowed(values);
    }
    let mut drained = values.to_vec();
    for (v, from) in flood(mesh, values, outlets) {
        let above = drained[from as usize].next_up().min(f64::MAX);
        drained[v as usize] = drained[v as usize].max(above);
    }
    Cow::Owned(drained)
}

/// The vertices in the order in which they are flooded, and from which neighbour each is.
fn flood(mesh: &Mesh, values: &[f64], outlets: &[u32]) -> Vec<(u32, u32)> {
    let mut upwards: Vec<u32> = (0..).zip(values).filter(|(_, u)| u.is_finite()).map(|(v, _)| v).collect();
    upwards.sort_by(|&v, &w| values[v as usize].total_cmp(&values[w as usize]));
    // Its place in this order, for each vertex that is dry.
    let mut rank: Vec<Option<usize>> = vec![None; values.len()];
    upwards.iter().enumerate().for_each(|(i, &v)| rank[v as usize] = Some(i));
    let mut edge: BinaryHeap<Reverse<usize>> =
        outlets.iter().filter_map(|&v| rank[v as usize].take()).map(Reverse).collect();
    let mut order = Vec::new();
    while let Some(Reverse(i)) = edge.pop() {
        for w in neighbours(mesh, upwards[i]) {
            if let Some(j) = rank[w as usize].take() {
                order.push((w, upwards[i]));
                edge.push(Reverse(j));
            }
        }
    }
    order
}

/// The other corners of the triangles at a vertex, some of them twice.
fn neighbours(mesh: &Mesh, v: u32) -> impl Iterator<Item = u32> {
    let corners = mesh.topology().corners.row(v).iter();
    corners.flat_map(|&h| [next(h), prev(h)]).map(|h| start(mesh.triangles(), h))
}

#[cfg(test)]
mod tests {
    use super::{drained, neighbours};
    use crate::mesh::{Mesh, shapes};
    use std::borrow::Cow;

    fn row(heights: &[f64]) -> Mesh {
        shapes::grid(heights.len() as u32 - 1, 1).mesh().unwrap()
    }

    #[test]
    fn a_field_without_other_minima_stays_as_it_is() {
        let heights = [0.0, 1.0, 2.0, 1.5, 0.0, f64::NAN, -f64::INFINITY];
        let values = [heights, heights.map(|u| u + 0.5)].concat();
        assert!(matches!(drained(&row(&heights), &values, &[0, 4]), Cow::Borrowed(_)));
    }

    #[test]
    fn a_minimum_is_filled_up_to_its_lowest_pass() {
        let heights = [0.0, 3.0, 1.0, 2.0, 5.0, 4.0];
        let values = [heights, heights].concat();
        let mesh = row(&heights);
        let found = drained(&mesh, &values, &[0, 6]);
        let above = |u: f64| u..u + 1e-14;
        for (k, &u) in found.iter().enumerate() {
            let raised = match k % 6 {
                2 | 3 => above(3.0),
                5 => above(5.0),
                k => heights[k]..heights[k].next_up(),
            };
            assert!(raised.contains(&u), "vertex {k}: {u}");
        }
        for v in (0..12).filter(|v| v % 6 != 0) {
            assert!(neighbours(&mesh, v).any(|w| found[w as usize] < found[v as usize]), "vertex {v}");
        }
    }
}
