//! How far distances φ are from a reference, in percent.
//!
//! The error of a vertex is |φ - ref| / |ref|; where ref = 0, at the sources, it counts as 0. Its mean
//! 100/n · Σ |φ - ref| / |ref|, its median and its maximum are over all vertices but those that are unreachable in both;
//! where only one of the two is infinite, so is the error. The largest difference |φ - ref|, in units of the mesh, is over
//! the vertices that both reach. O(n).
//!
//! References: the mean is that of libgeodesic 0.1 (K. Crane), by which "Wave propagation time optimization for geodesic
//! distances calculation using the Heat Method", Open Physics 17 (2019), has its figures.

use serde::Serialize;

/// Errors over the vertices; of several vertices with the same error the first is named.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Errors {
    /// 100/n · Σ |φ - ref| / |ref|.
    pub mean_percent: f64,
    /// The median of the same.
    pub median_percent: f64,
    /// The largest.
    pub max_percent: f64,
    /// The vertex of the largest error; `None` where no vertex is reached.
    pub max_vertex: Option<usize>,
    /// The largest |φ - ref|, in units of the mesh.
    pub largest_difference: f64,
    /// Its vertex; `None` where both reach no vertex in common.
    pub largest_difference_vertex: Option<usize>,
}

impl Errors {
    /// Of two lists of the same length.
    #[must_use]
    pub fn new(distances: &[f64], reference: &[f64]) -> Errors {
        let pairs = || distances.iter().copied().zip(reference.iter().copied()).enumerate();
        let worst = first_largest(pairs().filter_map(|(v, (phi, exact))| Some((v, error(phi, exact)?))));
        let differences = pairs().map(|(v, (phi, exact))| (v, (phi - exact).abs()));
        let farthest = first_largest(differences.filter(|(_, difference)| difference.is_finite()));

        let errors: Vec<f64> = pairs().filter_map(|(_, (phi, exact))| error(phi, exact)).collect();
        Errors {
            mean_percent: 100.0 * errors.iter().sum::<f64>() / errors.len().max(1) as f64,
            median_percent: 100.0 * median(errors),
            max_percent: 100.0 * worst.map_or(0.0, |(_, error)| error),
            max_vertex: worst.map(|(v, _)| v),
            largest_difference: farthest.map_or(0.0, |(_, difference)| difference),
            largest_difference_vertex: farthest.map(|(v, _)| v),
        }
    }
}

/// The middle value, or the mean of the two in the middle; 0 where there is none. Linear time.
pub(crate) fn median(mut values: Vec<f64>) -> f64 {
    let half = values.len() / 2;
    if values.is_empty() {
        return 0.0;
    }
    let is_even = values.len().is_multiple_of(2);
    let (lower, &mut middle, _) = values.select_nth_unstable_by(half, f64::total_cmp);
    match lower.iter().copied().reduce(f64::max) {
        Some(below) if is_even => 0.5 * (below + middle),
        _ => middle,
    }
}

/// The first of the largest values, and its number.
fn first_largest(values: impl Iterator<Item = (usize, f64)>) -> Option<(usize, f64)> {
    values.reduce(|largest, value| if value.1 > largest.1 { value } else { largest })
}

/// The error of each vertex in percent; none, so NaN, where neither reaches it.
#[must_use]
pub fn percents(distances: &[f64], reference: &[f64]) -> Vec<f64> {
    distances.iter().zip(reference).map(|(&phi, &exact)| 100.0 * error(phi, exact).unwrap_or(f64::NAN)).collect()
}

/// The relative error of one vertex; `None` where neither reaches it.
fn error(phi: f64, exact: f64) -> Option<f64> {
    match (phi.is_finite(), exact.is_finite()) {
        (false, false) => None,
        (true, true) if exact == 0.0 => Some(0.0),
        (true, true) => Some((phi - exact).abs() / exact.abs()),
        _ => Some(f64::INFINITY),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn errors(distances: &[f64], reference: &[f64]) -> [f64; 3] {
        let Errors { mean_percent, median_percent, max_percent, .. } = Errors::new(distances, reference);
        [mean_percent, median_percent, max_percent]
    }

    const INF: f64 = f64::INFINITY;

    #[test]
    fn the_source_counts_as_no_error() {
        assert_eq!(errors(&[0.5, 1.5, 2.0, 3.0], &[0.0, 1.0, 2.0, 4.0]), [75.0 / 4.0, 12.5, 50.0]);
        assert_eq!(errors(&[0.0, 1.5, 3.0], &[0.0, 1.0, 4.0]), [25.0, 25.0, 50.0]);
    }

    #[test]
    fn unreachable_in_both_is_left_out_and_in_one_is_infinite() {
        assert_eq!(errors(&[0.0, 3.0, INF], &[0.0, 2.0, INF]), [25.0, 25.0, 50.0]);
        assert_eq!(errors(&[0.0, INF, 1.0], &[0.0, 2.0, 1.0]), [INF, 0.0, INF]);
        assert_eq!(errors(&[0.0, 2.0, 1.0], &[0.0, INF, 1.0]), [INF, 0.0, INF]);
    }

    #[test]
    fn the_first_vertex_of_the_largest_error_is_named() {
        let of = |distances: &[f64], reference: &[f64]| {
            let Errors { max_vertex, largest_difference, largest_difference_vertex, .. } =
                Errors::new(distances, reference);
            (max_vertex, largest_difference, largest_difference_vertex)
        };
        assert_eq!(of(&[1.0, 3.0, 3.0, 11.0], &[0.0, 2.0, 2.0, 9.0]), (Some(1), 2.0, Some(3)));
        assert_eq!(of(&[INF, 1.0, INF], &[INF, 1.5, 2.0]), (Some(2), 0.5, Some(1)));
        assert_eq!(of(&[INF], &[INF]), (None, 0.0, None));
        assert_eq!(of(&[], &[]), (None, 0.0, None));
    }
}
