//! The line through points: how t follows from a property.
//!
//! y = a x + b by least squares: a = cov(x, y) / σ_x², b = ȳ - a x̄, R² = 1 - S / Σ(y - ȳ)², where S = Σ(y - a x - b)².
//! With s² = S / (n - 2) the standard errors are s / √Q for a and s √(1/n + x̄² / Q) for b, where Q = Σ(x - x̄)²; the 95 %
//! confidence intervals are that many of them to both sides as Student's distribution of n - 2 degrees of freedom says. O(n).
//!
//! References: N. R. Draper, H. Smith, "Applied Regression Analysis", 3rd edition, Wiley 1998, chapter 1.

use crate::correlate::{Moments, Undefined};
use crate::properties::{ModelProperties, Property};
use serde::{Deserialize, Serialize};
use statrs::distribution::{ContinuousCDF, StudentsT};

/// A line y = a x + b.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Fit {
    /// a.
    pub slope: Coefficient,
    /// b.
    pub intercept: Coefficient,
    /// R², which share of the variance of y the line explains.
    pub r_squared: f64,
}

/// A coefficient of a line and how certain it is, if what is left is normally distributed and the same everywhere.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Coefficient {
    /// Its value.
    pub value: f64,
    /// Its standard error.
    pub standard_error: f64,
    /// Its 95 % confidence interval.
    pub interval: [f64; 2],
}

impl Fit {
    /// Through points (x, y).
    ///
    /// # Errors
    /// Why there is none; also where all y are the same, as no share of a variance of 0 can be explained.
    pub fn of(points: &[[f64; 2]]) -> Result<Fit, Undefined> {
        let Moments { means: [x, y], variances: [xx, yy], covariance } = Moments::of(points)?;
        let count = points.len() as f64;
        let slope = covariance / xx;
        let intercept = y - slope * x;
        let left = points.iter().map(|[x, y]| (y - slope * x - intercept).powi(2)).sum::<f64>();

        let freedom = count - 2.0;
        let quantile = StudentsT::new(0.0, 1.0, freedom).map_or(f64::NAN, |student| student.inverse_cdf(0.975));
        let coefficient = |value: f64, variance: f64| {
            let standard_error = (left / freedom * variance).sqrt();
            let interval = [-1.0, 1.0].map(|side| value + side * quantile * standard_error);
            Coefficient { value, standard_error, interval }
        };
        let squares = xx * (count - 1.0);
        let fit = Fit {
            slope: coefficient(slope, 1.0 / squares),
            intercept: coefficient(intercept, 1.0 / count + x * x / squares),
            r_squared: (1.0 - left / (yy * (count - 1.0))).max(0.0),
        };
        let errors = [fit.slope, fit.intercept].map(|coefficient| coefficient.standard_error);
        errors.iter().all(|error| error.is_finite()).then_some(fit).ok_or(Undefined::NotFinite)
    }

    /// t = a · property + b over models; with the standard deviation of the edges it is the paper's way to Eq. 4.
    ///
    /// # Errors
    /// As [`Fit::of`].
    pub fn of_property(property: Property, rows: &[(&ModelProperties, f64)]) -> Result<Fit, Undefined> {
        let points: Vec<[f64; 2]> = rows.iter().map(|(p, t)| [p.value(property), *t]).collect();
        Fit::of(&points)
    }

    /// t / ē² = a · σ/ē + b over models: both sides are the same in every unit of length.
    ///
    /// # Errors
    /// As [`Fit::of`].
    pub fn invariant(rows: &[(&ModelProperties, f64)]) -> Result<Fit, Undefined> {
        let point = |(p, t): &(&ModelProperties, f64)| [p.sigma / p.mean_edge, t / (p.mean_edge * p.mean_edge)];
        let points: Vec<[f64; 2]> = rows.iter().map(point).collect();
        Fit::of(&points)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::correlate::Correlation;
    use crate::paper::basic_rows;
    use crate::sweep::Measure;
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64Mcg;
    use statrs::distribution::Normal;

    const ANSCOMBE_1: [[f64; 2]; 11] = [
        [10.0, 8.04],
        [8.0, 6.95],
        [13.0, 7.58],
        [9.0, 8.81],
        [11.0, 8.33],
        [14.0, 9.96],
        [6.0, 7.24],
        [4.0, 4.26],
        [12.0, 10.84],
        [7.0, 4.82],
        [5.0, 5.68],
    ];

    fn close(ours: f64, expected: f64, tolerance: f64) -> bool {
        (ours - expected).abs() <= tolerance
    }

    #[test]
    fn a_line_is_found_exactly() {
        let fit = Fit::of(&[-2.0, 0.0, 1.0, 5.0].map(|x| [x, 3.0 * x - 7.0])).unwrap();
        assert!(close(fit.slope.value, 3.0, 1e-14) && close(fit.intercept.value, -7.0, 1e-14));
        assert!(close(fit.r_squared, 1.0, 1e-14));
        assert!(fit.slope.standard_error < 1e-14 && fit.intercept.standard_error < 1e-14);
    }

    /// F. J. Anscombe, "Graphs in statistical analysis", The American Statistician 27 (1973), whose regressions are printed
    /// in many places, and Student's quantile for 9 degrees of freedom.
    #[test]
    fn anscombes_first_set_has_its_known_line() {
        let fit = Fit::of(&ANSCOMBE_1).unwrap();
        for (ours, [value, standard_error]) in
            [(fit.slope, [0.500_090_9, 0.117_905_5]), (fit.intercept, [3.000_090_9, 1.124_746_8])]
        {
            assert!(close(ours.value, value, 1e-7) && close(ours.standard_error, standard_error, 1e-7), "{ours:?}");
            let half = 2.262_157_163 * ours.standard_error;
            assert!(
                close(ours.interval[0], ours.value - half, 1e-8) && close(ours.interval[1], ours.value + half, 1e-8)
            );
        }
        assert!(close(fit.r_squared, 0.666_542_5, 1e-7));
    }

    #[test]
    fn r_squared_is_the_square_of_r() {
        let [fit, r] = [Fit::of(&ANSCOMBE_1).unwrap().r_squared, Correlation::of(&ANSCOMBE_1).unwrap().r];
        assert!(close(fit, r * r, 1e-14));
    }

    #[test]
    fn three_points_do() {
        // S = 1/6, Q = 2: a = 1/2 ± √(1/6 / 2) · tan(0.475 π), since Student's distribution of one degree is Cauchy's.
        let fit = Fit::of(&[[0.0, 0.0], [1.0, 1.0], [2.0, 1.0]]).unwrap();
        let half = (1.0 / 12.0f64).sqrt() * (0.475 * std::f64::consts::PI).tan();
        assert!(close(fit.slope.interval[0], 0.5 - half, 1e-9) && close(fit.slope.interval[1], 0.5 + half, 1e-9));
        assert!(close(fit.intercept.standard_error, (1.0 / 6.0 * (1.0 / 3.0 + 0.5f64)).sqrt(), 1e-12));
        assert!(close(fit.r_squared, 0.75, 1e-12));
    }

    #[test]
    fn what_has_no_line_says_why() {
        assert_eq!(Fit::of(&[[0.0, 1.0], [1.0, 2.0]]), Err(Undefined::TooFew));
        assert_eq!(Fit::of(&[[3.0, 1.0], [3.0, 2.0], [3.0, 4.0]]), Err(Undefined::Constant));
        assert_eq!(Fit::of(&[[0.0, 1.0], [f64::NAN, 2.0], [3.0, 4.0]]), Err(Undefined::NotFinite));
        // Their squares have no reciprocal, or the slope is beyond all numbers.
        assert_eq!(Fit::of(&[[0.0, 1.0], [1e-157, 3.0], [3e-157, 4.0]]), Err(Undefined::NotFinite));
        assert_eq!(Fit::of(&[[0.0, 1e150], [1e-150, 3e152], [3e-150, -4e153]]), Err(Undefined::NotFinite));
    }

    /// Of 2,000 samples of 8 points 95 % hold the truth, give or take three times √(0.95 · 0.05 / 2000) = 0.0049; Fisher's
    /// interval, an approximation, too.
    #[test]
    fn intervals_hold_the_truth_as_often_as_they_say() {
        let mut random = Pcg64Mcg::seed_from_u64(7);
        let mut normal = || Normal::standard().inverse_cdf(random.random_range(1e-12..1.0));
        let mut held = [0; 3];
        for _ in 0..2000 {
            let points: [[f64; 2]; 8] = std::array::from_fn(|_| {
                let x = normal();
                [x, 0.75 * x - 2.0 + normal()]
            });
            let fit = Fit::of(&points).unwrap();
            let r = Correlation::of(&points).unwrap().interval.unwrap();
            let intervals = [(fit.slope.interval, 0.75), (fit.intercept.interval, -2.0), (r, 0.6)];
            for (held, ([low, high], truth)) in held.iter_mut().zip(intervals) {
                *held += u32::from(low <= truth && truth <= high);
            }
        }
        assert!(held.iter().all(|&count| close(f64::from(count) / 2000.0, 0.95, 0.015)), "{held:?}");
    }

    /// scipy.stats.linregress 1.17 on the same numbers: five points leave the factor of Eq. 4 anywhere from 0.17 to 1.85.
    #[test]
    fn the_papers_best_t_leave_much_open() {
        let fits = |measure| {
            let rows = basic_rows(measure);
            let rows: Vec<_> = rows.iter().map(|(properties, t)| (properties, *t)).collect();
            [Fit::of_property(Property::Sigma, &rows), Fit::invariant(&rows)].map(Result::unwrap)
        };
        let [mean, median] = Measure::ALL.map(fits);
        for (fit, slope, intercept, r_squared) in [
            (mean[0], [0.444_839_24, 1.490_859_34], [-0.028_294_84, 0.028_539_31], 0.920_388_66),
            (mean[1], [1.321_984_31, 6.334_860_83], [-0.497_731_31, 0.676_319_11], 0.887_341_45),
            (median[0], [0.172_255_83, 1.852_015_73], [-0.045_744_70, 0.045_522_89], 0.830_588_83),
            (median[1], [0.063_679_55, 8.100_061_93], [-0.869_436_68, 1.012_739_75], 0.776_976_88),
        ] {
            for (ours, expected) in [(fit.slope, slope), (fit.intercept, intercept)] {
                assert!((0..2).all(|end| close(ours.interval[end], expected[end], 1e-7)), "{ours:?} {expected:?}");
            }
            assert!(close(fit.r_squared, r_squared, 1e-8));
        }
    }
}
