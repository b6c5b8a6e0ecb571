//! Mollification: makes every triangle proper by adding one length ε to all edges.
//!
//! ε = max(0, max over corners of (δ + c - a - b)), so that afterwards a + b ≥ c + δ for any sides a, b, c of a triangle.
//! A triangle without area, and an edge without length, then conduct heat along their edges like any other; where no
//! triangle needs it, nothing changes, bit for bit.
//!
//! O(F) time.
//!
//! References: N. Sharp, K. Crane: A Laplacian for Nonmanifold Triangle Meshes. Computer Graphics Forum (SGP), 2020.

use super::Metric;

/// δ over the mean length: the least slack of the triangle inequality. Cotangents then stay below about 1e5.
const LEAST_SLACK: f64 = 1e-10;

/// Adds the ε above to every length; says whether it had to.
pub(crate) fn mollify(metric: &mut Metric) -> bool {
    let sum: f64 = metric.lengths.iter().flatten().sum();
    let mean = sum / (3 * metric.lengths.len()) as f64;
    let slack = LEAST_SLACK * if mean > 0.0 { mean } else { 1.0 };
    let excess = |[a, b, c]: [f64; 3]| {
        let longest = a.max(b).max(c);
        let shortest = a.min(b).min(c);
        let middle = a.min(b).max(a.max(b).min(c));
        (longest - middle) - shortest
    };
    let epsilon = metric.lengths.iter().map(|&lengths| slack + excess(lengths)).fold(0.0, f64::max);
    if epsilon > 0.0 {
        metric.lengths.iter_mut().flatten().for_each(|length| *length += epsilon);
    }
    epsilon > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metric::area;

    #[test]
    fn proper_triangles_keep_their_bits() {
        let lengths = vec![[3.0, 4.0, 5.0], [0.1, 0.1, 0.19999]];
        let mut metric = Metric { triangles: vec![[0, 1, 2], [2, 1, 3]], lengths: lengths.clone(), single: 2 };
        assert!(!mollify(&mut metric));
        assert_eq!(metric.lengths, lengths);
    }

    #[test]
    fn degenerate_triangles_get_area() {
        for lengths in [[1.0, 1.0, 2.0], [0.0, 1.0, 1.0], [0.0, 0.0, 0.0], [1.0, 1.0, 2.0 + 1e-15]] {
            let mut metric = Metric { triangles: vec![[0, 1, 2]], lengths: vec![lengths], single: 1 };
            assert!(mollify(&mut metric));
            assert!(area(metric.lengths[0]) > 0.0, "{lengths:?}");
        }
    }
}
