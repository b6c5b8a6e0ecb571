//! How far distances φ are from a reference, in percent.
//!
//! The error of a vertex is |φ - ref| / |ref|; where ref = 0, at the sources, it counts as 0. Its mean
//! 100/n · Σ |φ - ref| / |ref|, its median and its maximum are over all vertices but those that are unreachable in both;
//! where only one of the two is infinite, so is the error. O(n).
//!
//! References: the mean is that of libgeodesic 0.1 (K. Crane), by which "Wave propagation time optimization for geodesic
//! distances calculation using the Heat Method", Open Physics 17 (2019), has its figures.

use serde::Serialize;

/// Errors over the vertices, in percent.
#[derive(Debug, Clone, Copy, Serialize)]
pub(crate) struct Errors {
    pub(crate) mean_percent: f64,
    pub(crate) median_percent: f64,
    pub(crate) max_percent: f64,
}

impl Errors {
    /// Of two lists of the same length.
    pub(crate) fn new(distances: &[f64], reference: &[f64]) -> Errors {
        let mut errors: Vec<f64> =
            distances.iter().zip(reference).filter_map(|(&phi, &exact)| error(phi, exact)).collect();
        errors.sort_by(f64::total_cmp);
        let percent = |error: Option<f64>| 100.0 * error.unwrap_or(0.0);
        let middle = |shift: usize| errors.get(errors.len().saturating_sub(shift) / 2).copied();
        Errors {
            mean_percent: percent(Some(errors.iter().sum::<f64>() / errors.len().max(1) as f64)),
            median_percent: 0.5 * (percent(middle(0)) + percent(middle(1))),
            max_percent: percent(errors.last().copied()),
        }
    }
}

/// The error of each vertex in percent; none, so NaN, where neither reaches it.
pub(crate) fn percents(distances: &[f64], reference: &[f64]) -> Vec<f64> {
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
        let Errors { mean_percent, median_percent, max_percent } = Errors::new(distances, reference);
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
}
