//! How strongly properties and best t go together: Pearson's correlation.
//!
//! r = cov(x, y) / (σ_x σ_y). Its 95 % confidence interval is tanh(artanh r ± 1.96 / √(n - 3)), Fisher's. O(n).
//!
//! References: K. Pearson, "Notes on regression and inheritance in the case of two parents", Proceedings of the Royal
//! Society of London 58 (1895); R. A. Fisher, "On the 'probable error' of a coefficient of correlation deduced from a small
//! sample", Metron 1 (1921).

use crate::properties::{ModelProperties, Property};
use serde::{Deserialize, Serialize};
use statrs::distribution::{ContinuousCDF, Normal};
use statrs::statistics::Statistics;
use std::fmt;

/// A correlation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Correlation {
    /// Pearson's r, from -1 to 1.
    pub r: f64,
    /// Its 95 % confidence interval, if both are normally distributed; `None` for three points, which leave it open.
    pub interval: Option<[f64; 2]>,
}

/// Why there is no correlation, and no line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Undefined {
    /// There are fewer than three points.
    TooFew,
    /// A number is not finite, or too large to be squared.
    NotFinite,
    /// One of the two is the same for all points, to within rounding.
    Constant,
}

impl fmt::Display for Undefined {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Undefined::TooFew => "fewer than three points",
            Undefined::NotFinite => "not finite",
            Undefined::Constant => "does not vary",
        })
    }
}

impl std::error::Error for Undefined {}

impl Correlation {
    /// Of points (x, y).
    ///
    /// # Errors
    /// Why it is not defined.
    pub fn of(points: &[[f64; 2]]) -> Result<Correlation, Undefined> {
        let Moments { variances: [xx, yy], covariance, .. } = Moments::of(points)?;
        let r = (covariance / (xx.sqrt() * yy.sqrt())).clamp(-1.0, 1.0);
        let interval = (points.len() > 3).then(|| {
            let spread = Normal::standard().inverse_cdf(0.975) / (points.len() as f64 - 3.0).sqrt();
            [-spread, spread].map(|off| (r.atanh() + off).tanh())
        });
        Ok(Correlation { r, interval })
    }
}

/// How each property goes together with t over the models: the largest r first, at the end those that have none.
#[must_use]
pub fn correlations(rows: &[(&ModelProperties, f64)]) -> Vec<(Property, Result<Correlation, Undefined>)> {
    let correlation = |property| {
        let points: Vec<[f64; 2]> = rows.iter().map(|(p, t)| [p.value(property), *t]).collect();
        (property, Correlation::of(&points))
    };
    let mut table = Property::ALL.map(correlation).to_vec();
    let order = |result: &Result<Correlation, Undefined>| result.map_or(f64::NEG_INFINITY, |c| c.r);
    table.sort_by(|(_, a), (_, b)| order(b).total_cmp(&order(a)));
    table
}

/// Means, and variances and covariance per n - 1.
pub(crate) struct Moments {
    pub(crate) means: [f64; 2],
    pub(crate) variances: [f64; 2],
    pub(crate) covariance: f64,
}

impl Moments {
    pub(crate) fn of(points: &[[f64; 2]]) -> Result<Moments, Undefined> {
        let axis = |k: usize| points.iter().map(move |point| point[k]);
        let moments = Moments {
            means: [0, 1].map(|k| axis(k).mean()),
            variances: [0, 1].map(|k| axis(k).variance()),
            covariance: axis(0).covariance(axis(1)),
        };
        if points.len() < 3 {
            return Err(Undefined::TooFew);
        }
        // What is not finite, or its square, leaves no finite variance.
        if !moments.variances.iter().all(|variance| variance.is_finite()) {
            return Err(Undefined::NotFinite);
        }
        // The same edge in another mesh has been scaled by another factor, so it may differ in its last digits.
        let is_constant = |k: usize| moments.variances[k].sqrt() <= 1e-12 * axis(k).abs_max();
        if [0, 1].into_iter().any(is_constant) {
            return Err(Undefined::Constant);
        }
        Ok(moments)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::paper::{CORRELATIONS, basic_rows};
    use crate::sweep::Measure;

    #[test]
    fn a_line_correlates_fully_and_a_parabola_not_at_all() {
        let of = |f: fn(f64) -> f64| Correlation::of(&[-2.0, -1.0, 0.0, 1.0, 2.0].map(|x| [x, f(x)])).unwrap();
        for (f, r) in [((|x| 3.0 * x - 7.0) as fn(f64) -> f64, 1.0), (|x| -x, -1.0)] {
            let Correlation { r: ours, interval } = of(f);
            assert!((ours - r).abs() < 1e-15);
            assert!(interval.unwrap().iter().all(|end| (end - r).abs() < 1e-6));
        }
        assert_eq!(of(|x| x * x).r, 0.0);
    }

    #[test]
    fn fishers_interval_has_its_closed_form() {
        // Three of four points on one diagonal, one on the other: r = 1/2, whose artanh is ln(3) / 2.
        let points = [1.0, 1.0, 1.0, -1.0].map(|side| [[1.0, side], [-1.0, -side]]);
        let points: Vec<[f64; 2]> = points.as_flattened().repeat(4);
        let Correlation { r, interval } = Correlation::of(&points).unwrap();
        assert!((r - 0.5).abs() < 1e-15);
        let spread = 1.959_963_984_540_054 / 29f64.sqrt();
        for (end, off) in interval.unwrap().into_iter().zip([-spread, spread]) {
            assert!((end - (0.5 * 3f64.ln() + off).tanh()).abs() < 1e-9, "{end}");
        }
    }

    #[test]
    fn what_has_no_correlation_says_why() {
        let of = |points: &[[f64; 2]]| Correlation::of(points).map(|c| c.interval).unwrap_err();
        assert_eq!(of(&[]), Undefined::TooFew);
        assert_eq!(of(&[[0.0, 1.0], [1.0, 2.0]]), Undefined::TooFew);
        assert_eq!(of(&[[0.0, 1.0], [1.0, 2.0], [f64::NAN, 3.0]]), Undefined::NotFinite);
        assert_eq!(of(&[[0.0, 1.0], [1.0, 2.0], [2.0, f64::INFINITY]]), Undefined::NotFinite);
        assert_eq!(of(&[[0.0, 1.0], [1.0, 2.0], [1e300, 3.0]]), Undefined::NotFinite);
        assert_eq!(of(&[[0.1262, 1.0], [0.1262, 2.0], [0.1262 * (1.0 + 1e-15), 3.0]]), Undefined::Constant);
        assert_eq!(of(&[[0.0, 5.0], [1.0, 5.0], [2.0, 5.0]]), Undefined::Constant);
        assert_eq!(of(&[[0.0, 5.0], [0.0, 1.0], [0.0, 2.0]]), Undefined::Constant);
        assert_eq!(of(&[[0.0, 5.0], [1e-200, 1.0], [0.0, 2.0]]), Undefined::Constant);
        assert_eq!(Correlation::of(&[[0.0, 5.0], [1.0, 1.0], [2.0, 2.0]]).unwrap().interval, None);
    }

    #[test]
    fn the_table_begins_with_the_largest_and_ends_with_what_does_not_vary() {
        let rows = basic_rows(Measure::Mean);
        let rows: Vec<_> = rows.iter().map(|(properties, t)| (properties, *t)).collect();
        let table = correlations(&rows);
        let printed = CORRELATIONS[Measure::Mean as usize].map(|(property, _)| property);
        assert_eq!(table[..17].iter().map(|(property, _)| *property).collect::<Vec<_>>(), printed);
        assert_eq!(table[17], (Property::MinEdge, Err(Undefined::Constant)));
        // Five meshes do not tell the strongest from the tenth.
        let interval = |k: usize| table[k].1.unwrap().interval.unwrap().map(|end| (end * 1e3).round() / 1e3);
        assert_eq!(interval(0), [0.502, 0.997]);
        assert_eq!(interval(9), [-0.027, 0.992]);
        assert!(correlations(&[]).iter().all(|(_, result)| *result == Err(Undefined::TooFew)));
    }
}
