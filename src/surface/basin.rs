//! Basins: to which of several seeds the steepest descent from each vertex leads.
//!
//! The vertices are visited from the lowest one up. From each a path of steepest descent is followed to a vertex, or to an
//! edge whose ends are lower than where it began and have the same label: mostly one piece or two, more along the border
//! of two basins. Minima that are no seeds are [drained](super::drain) first.
//!
//! O(V log V) time.

use super::descent::Field;
use super::drain::drained;
use super::point::Place;
use crate::mesh::Mesh;
use crate::metric::Scale;
use std::collections::HashSet;

/// The label of the seed to which steepest descent leads from each vertex; None where the value is not finite, and where
/// no seed can be reached. A seed is a vertex and its label; of several at one vertex the first counts.
pub(crate) fn basins(mesh: &Mesh, values: &[f64], seeds: &[(u32, u32)]) -> Vec<Option<u32>> {
    let positions = Scale::of(mesh).unit_positions(mesh);
    let outlets: Vec<u32> = seeds.iter().map(|&(v, _)| v).collect();
    let values = &drained(mesh, values, &outlets)[..];
    let field = Field { mesh, values, positions: &positions };
    let mut labels = vec![None; mesh.vertex_count()];
    for &(v, label) in seeds {
        labels[v as usize].get_or_insert(label);
    }
    let mut upwards: Vec<u32> = (0..).zip(values).filter(|(_, u)| u.is_finite()).map(|(v, _)| v).collect();
    upwards.sort_by(|&v, &w| values[v as usize].total_cmp(&values[w as usize]));
    for &v in &upwards {
        if labels[v as usize].is_none() {
            labels[v as usize] = downstream(&field, v, &labels);
        }
    }
    labels
}

/// A path along a border is followed for so many pieces; then the label of the nearer end of its edge must do.
const FARTHEST: usize = 100;

/// The label to which steepest descent leads from a vertex above which none has a label but seeds; None where that is a
/// minimum, and from a minimum.
fn downstream(field: &Field, v: u32, labels: &[Option<u32>]) -> Option<u32> {
    let mut at = *Place::Vertex(v).in_triangles(field.mesh).first()?;
    let mut crossed = HashSet::new();
    let mut nearer = v;
    for _ in 0..FARTHEST {
        at = field.steepest(&at, &crossed)?.to;
        let mut ends = [0, 1, 2].map(|k| (at.barycentric[k], field.mesh.triangles()[at.face as usize][k]));
        ends.sort_by(|(a, _), (b, _)| b.total_cmp(a));
        let [(_, near), (share, far), _] = ends; // the third corner is opposite the edge
        let is_lower = |w: u32| field.values[w as usize] < field.values[v as usize];
        let agree = is_lower(near) && is_lower(far) && labels[near as usize] == labels[far as usize];
        if share == 0.0 || agree {
            return labels[near as usize];
        }
        crossed.insert(at.face);
        nearer = near;
    }
    labels[nearer as usize]
}

#[cfg(test)]
mod tests {
    use super::basins;
    use crate::mesh::{Mesh, shapes};

    fn euclid(p: [f64; 3], q: [f64; 3]) -> f64 {
        (0..3).map(|k| (p[k] - q[k]).powi(2)).sum::<f64>().sqrt()
    }

    /// The label of each vertex by its distance `d(place, seed)` from all seeds is right, but next to where it changes.
    #[track_caller]
    fn assert_nearest(mesh: &Mesh, seeds: &[u32], d: impl Fn([f64; 3], [f64; 3]) -> f64) {
        let at = |v: u32| mesh.positions()[v as usize];
        let nearest = |p: [f64; 3]| {
            let all = (0..).zip(seeds).map(|(label, &seed)| (d(p, at(seed)), label));
            all.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap()
        };
        let (values, expected): (Vec<f64>, Vec<u32>) = mesh.positions().iter().map(|&p| nearest(p)).unzip();
        let labels = basins(mesh, &values, &(0..).zip(seeds).map(|(label, &v)| (v, label)).collect::<Vec<_>>());
        let mut is_inner = vec![true; expected.len()];
        for triangle in mesh.triangles() {
            let label = expected[triangle[0] as usize];
            if triangle.iter().any(|&v| expected[v as usize] != label) {
                triangle.iter().for_each(|&v| is_inner[v as usize] = false);
            }
        }
        let wrong: Vec<usize> = (0..expected.len()).filter(|&v| labels[v] != Some(expected[v])).collect();
        assert!(wrong.iter().all(|&v| !is_inner[v]), "wrong inside a cell: {wrong:?}");
        assert!(wrong.len() * 50 <= expected.len(), "{} of {} wrong", wrong.len(), expected.len());
    }

    #[test]
    fn on_true_distances_labels_are_right_but_next_to_the_borders() {
        let mesh = shapes::grid(60, 60).mesh().unwrap();
        assert_nearest(&mesh, &[0, 200, 1400, 1950, 2600, 3700], euclid);
        let mesh = shapes::icosphere(4).mesh().unwrap();
        let arc = |p, q| 2.0 * (euclid(p, q) / 2.0).min(1.0).asin();
        assert_nearest(&mesh, &[0, 11, 300, 555, 1200, 2000, 2500], arc);
    }

    /// A row of vertices from left to right, above and below, as high as told.
    fn strip(heights: &[f64]) -> (Mesh, Vec<f64>) {
        let mesh = shapes::grid(heights.len() as u32 - 1, 1).mesh().unwrap();
        (mesh, [heights, heights].concat())
    }

    #[test]
    fn a_minimum_that_is_no_seed_flows_over_where_its_rim_is_lowest() {
        let (mesh, values) = strip(&[0.0, 2.0, 1.0, 1.5, 3.0, 0.5]);
        let labels = basins(&mesh, &values, &[(0, 7), (6, 7), (5, 8), (11, 8)]);
        let [left, right] = [Some(7), Some(8)];
        let row = [left, left, left, left, right, right];
        assert_eq!(labels, [row, row].concat());
    }

    #[test]
    fn what_no_seed_reaches_has_no_label() {
        let (mesh, mut values) = strip(&[0.0, 1.0, f64::INFINITY, 2.0, 1.0, 3.0]);
        values[7] = f64::NAN;
        let labels = basins(&mesh, &values, &[(0, 7), (0, 9)]);
        let label = |v: usize| [0, 1, 6].contains(&v).then_some(7);
        assert_eq!(labels, (0..12).map(label).collect::<Vec<_>>());
        assert_eq!(basins(&mesh, &values, &[]), [None; 12]);
    }
}
