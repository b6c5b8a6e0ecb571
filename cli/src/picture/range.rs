//! The values that a picture shows, and round numbers among them.

/// From the least to the largest value that has a colour of its own.
#[derive(Debug, Clone, Copy)]
pub(super) struct Range {
    pub(super) low: f64,
    pub(super) high: f64,
    /// The largest value; where it is above `high`, it shares its colour.
    pub(super) most: f64,
}

impl Range {
    /// Of the finite values.
    pub(super) fn new(values: &[f64]) -> Range {
        let finite = || values.iter().copied().filter(|value| value.is_finite());
        let (least, most) = (finite().reduce(f64::min), finite().reduce(f64::max));
        let most = most.unwrap_or(0.0);
        Range { low: least.unwrap_or(0.0), high: most, most }
    }

    /// Of the finite errors up to `top`. By default the largest hundredth is cut off where it is far above the others, or
    /// a few bad triangles would leave nothing but the lowest colour.
    pub(super) fn of_errors(errors: &[f64], top: Option<f64>) -> Range {
        let mut finite: Vec<f64> = errors.iter().copied().filter(|error| error.is_finite()).collect();
        finite.sort_by(f64::total_cmp);
        let most = finite.last().copied().unwrap_or(0.0);
        let high = top.unwrap_or_else(|| {
            let usual = finite.get(finite.len() * 99 / 100).copied().unwrap_or(0.0);
            if usual > 0.0 && most > 1.5 * usual { usual } else { most }
        });
        Range { low: 0.0, high, most }
    }

    pub(super) fn is_cut(self) -> bool {
        self.most > self.high
    }

    /// Where a value is between the ends, 0 to 1; NaN where it is not finite. Above the end it is above 1.
    pub(super) fn place(self, value: f64) -> f32 {
        if !value.is_finite() {
            return f32::NAN;
        }
        // Halves first: the range of finite numbers need not be one.
        let length = 0.5 * self.high - 0.5 * self.low;
        if length > 0.0 { ((0.5 * value - 0.5 * self.low) / length) as f32 } else { 0.0 }
    }

    /// Round numbers from `low` to `high`, at most `most` (and more than a third of that) of them; none where the range
    /// has no length.
    pub(super) fn ticks(self, most: f64) -> Vec<f64> {
        let step = self.step(most);
        if !(step > 0.0 && step.is_finite()) {
            return Vec::new();
        }
        let first = (self.low / step - 1e-6).ceil();
        let count = (self.high / step + 1e-6).floor() - first;
        (0..=count as u32).map(|i| (first + f64::from(i)) * step).collect() // the cast saturates at 0; count < most
    }

    /// The least of 1, 2, 5, 10, ... that gives at most `most` steps.
    fn step(self, most: f64) -> f64 {
        let least = self.high / most - self.low / most;
        let power = 10f64.powf(least.log10().floor());
        let factor = [1.0, 2.0, 5.0].into_iter().find(|factor| factor * power >= least * (1.0 - 1e-9));
        factor.unwrap_or(10.0) * power
    }

    /// How `ticks(most)` are written: as few digits as tell them apart.
    pub(super) fn label(self, tick: f64, most: f64) -> String {
        let step = self.step(most);
        if tick.abs() < 1e-3 * step {
            return "0".to_owned();
        }
        let largest = self.low.abs().max(self.high.abs());
        if !(1e-4..1e6).contains(&largest) {
            let digits = (largest.log10().floor() - step.log10().floor()).clamp(0.0, 15.0);
            return format!("{tick:.0$e}", digits as usize);
        }
        let digits = (-(step * (1.0 + 1e-9)).log10().floor()).clamp(0.0, 15.0);
        format!("{tick:.0$}", digits as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(low: f64, high: f64) -> Vec<String> {
        let range = Range { low, high, most: high };
        range.ticks(6.0).into_iter().map(|tick| range.label(tick, 6.0)).collect()
    }

    #[test]
    fn ticks_are_round_and_written_short() {
        assert_eq!(labels(0.0, 3.1), ["0", "1", "2", "3"]);
        assert_eq!(labels(0.0, 0.25), ["0", "0.05", "0.10", "0.15", "0.20", "0.25"]);
        assert_eq!(labels(-1.0, 1.0), ["-1.0", "-0.5", "0", "0.5", "1.0"]);
        assert_eq!(labels(990.0, 1012.0), ["990", "995", "1000", "1005", "1010"]);
        assert_eq!(
            labels(0.0, 1.2e-300),
            ["0", "2.0e-301", "4.0e-301", "6.0e-301", "8.0e-301", "1.0e-300", "1.2e-300"]
        );
        assert!(labels(1.0, 1.0).is_empty());
    }

    #[test]
    fn errors_are_cut_only_where_a_few_are_far_above_the_rest() {
        let mut errors: Vec<f64> = (0..1000).map(|i| f64::from(i) / 1000.0).collect();
        assert!(!Range::of_errors(&errors, None).is_cut());
        errors.extend([50.0, f64::INFINITY, f64::NAN]);
        let range = Range::of_errors(&errors, None);
        assert_eq!((range.low, range.high, range.most), (0.0, 0.99, 50.0));
        assert!(range.place(50.0) > 1.0 && range.place(f64::INFINITY).is_nan());
        let range = Range::of_errors(&errors, Some(2.0));
        assert_eq!((range.low, range.high, range.most), (0.0, 2.0, 50.0));
    }

    #[test]
    fn the_whole_range_of_numbers_has_places() {
        let range = Range::new(&[-f64::MAX, 0.0, f64::MAX]);
        assert_eq!([-f64::MAX, 0.0, f64::MAX].map(|value| range.place(value)), [0.0, 0.5, 1.0]);
    }
}
