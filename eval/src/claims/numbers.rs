//! Lines, correlations and averages.

use statrs::distribution::{ContinuousCDF, StudentsT};

/// The regression line y = slope · x + constant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Line {
    pub(super) slope: f64,
    pub(super) constant: f64,
    /// The share of the variance of y that the line explains.
    pub(super) r_squared: f64,
    /// How far the slope may be off, with 95 % confidence; +inf with two points.
    pub(super) slope_error: f64,
}

/// The line through points (x, y); `None` where x or y does not vary, or there are fewer than two points.
pub(super) fn line(points: &[(f64, f64)]) -> Option<Line> {
    let n = points.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / n;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let sum = |of: &dyn Fn(f64, f64) -> f64| points.iter().map(|p| of(p.0 - x, p.1 - y)).sum::<f64>();
    let (xx, xy, yy) = (sum(&|x, _| x * x), sum(&|x, y| x * y), sum(&|_, y| y * y));
    let varies = |square: f64, mean: f64| square > n * (1e-12 * mean) * (1e-12 * mean);
    if points.len() < 2 || !varies(xx, x) || !varies(yy, y) {
        return None;
    }
    let slope = xy / xx;
    let r_squared = xy * xy / (xx * yy);
    let freedom = n - 2.0;
    let slope_error = match StudentsT::new(0.0, 1.0, freedom) {
        Ok(distribution) => distribution.inverse_cdf(0.975) * (yy * (1.0 - r_squared).max(0.0) / freedom / xx).sqrt(),
        Err(_) => f64::INFINITY,
    };
    Some(Line { slope, constant: y - slope * x, r_squared, slope_error })
}

/// Pearson's coefficient; `None` where x or y does not vary.
pub(super) fn pearson(points: &[(f64, f64)]) -> Option<f64> {
    line(points).map(|line| line.r_squared.sqrt().min(1.0).copysign(line.slope))
}

/// Fisher's 95 % confidence interval of a coefficient from n > 3 points.
pub(super) fn fisher(r: f64, n: usize) -> [f64; 2] {
    let width = 1.96 / (n as f64 - 3.0).sqrt();
    [r.atanh() - width, r.atanh() + width].map(f64::tanh)
}

/// The geometric mean; `None` of nothing.
pub(super) fn geometric_mean(values: &[f64]) -> Option<f64> {
    let logarithms = values.iter().map(|value| value.ln()).sum::<f64>();
    if values.is_empty() { None } else { Some((logarithms / values.len() as f64).exp()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_and_how_far_it_may_be_off() {
        // By hand: x̄ = 2, ȳ = 3, Sxx = 2, Sxy = 2, Syy = 8/3; residual sum 2/3, one degree of freedom.
        let Line { slope, constant, r_squared, slope_error } =
            line(&[(1.0, 7.0 / 3.0), (2.0, 7.0 / 3.0), (3.0, 13.0 / 3.0)]).unwrap();
        assert!((slope - 1.0).abs() < 1e-12 && (constant - 1.0).abs() < 1e-12);
        assert!((r_squared - 0.75).abs() < 1e-12);
        assert!((slope_error - 12.7062047 * (1.0f64 / 3.0).sqrt()).abs() < 1e-6, "{slope_error}");
        assert_eq!(line(&[(1.0, 2.0), (1.0, 3.0)]), None);
        assert_eq!(line(&[(1.0, 0.1), (2.0, 0.1), (7.0, 0.1)]), None);
        assert_eq!(line(&[(1.0, 2.0)]), None);
        assert_eq!(line(&[(1.0, 2.0), (2.0, 1.0)]).unwrap().slope_error, f64::INFINITY);
    }

    #[test]
    fn a_coefficient_and_its_interval() {
        assert!((pearson(&[(1.0, 3.0), (2.0, 2.0), (3.0, 1.0)]).unwrap() + 1.0).abs() < 1e-12);
        let [low, high] = fisher(0.9593, 5);
        assert!((low - 0.5014).abs() < 1e-4 && (high - 0.9974).abs() < 1e-4, "{low} {high}");
        assert_eq!(fisher(1.0, 5), [1.0, 1.0]);
    }

    #[test]
    fn ratios_are_averaged_as_ratios() {
        assert!((geometric_mean(&[0.5, 2.0]).unwrap() - 1.0).abs() < 1e-12);
        assert_eq!(geometric_mean(&[]), None);
    }
}
