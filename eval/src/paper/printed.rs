//! A number as it stands in a table.

use std::fmt;

/// A number as it stands in a table, and how many decimals its column has: the tables drop zeros at the end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Printed {
    digits: &'static str,
    decimals: u8,
}

impl Printed {
    pub(super) const fn new(digits: &'static str, decimals: u8) -> Printed {
        Printed { digits, decimals }
    }

    /// The number.
    #[must_use]
    pub fn value(self) -> f64 {
        self.digits.parse().unwrap_or(f64::NAN)
    }

    /// How many decimals its column has.
    #[must_use]
    pub fn decimals(self) -> usize {
        self.decimals.into()
    }

    /// One unit of the last digit of its column; 0 for a count, which is exact.
    #[must_use]
    pub fn unit(self) -> f64 {
        match self.decimals {
            0 => 0.0,
            decimals => 10f64.powi(-i32::from(decimals)),
        }
    }

    /// Whether a number of ours is the printed one to within a unit: the tables cut off digits more often than they round.
    #[must_use]
    pub fn agrees(self, ours: f64) -> bool {
        self.agrees_within(ours, self.unit())
    }

    /// Whether it is to within `tolerance`.
    pub(super) fn agrees_within(self, ours: f64, tolerance: f64) -> bool {
        (ours - self.value()).abs() <= tolerance
    }
}

impl fmt::Display for Printed {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.pad(self.digits)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_is_one_of_the_columns_last_digit() {
        let trimmed = Printed::new("0.22", 3);
        assert_eq!((trimmed.value(), trimmed.unit(), trimmed.to_string().as_str()), (0.22, 0.001, "0.22"));
        assert!([0.2195, 0.2205].iter().all(|&ours| trimmed.agrees(ours)));
        assert!([0.2185, 0.2215, f64::NAN].iter().all(|&ours| !trimmed.agrees(ours)));
        let count = Printed::new("14290", 0);
        assert!(count.agrees(14290.0) && !count.agrees(14291.0));
    }

    #[test]
    fn it_is_aligned_as_asked() {
        assert_eq!(format!("{:>6}|{:<6}", Printed::new("-0.7", 4), Printed::new("1", 0)), "  -0.7|1     ");
    }
}
