//! What follows from the paper's own tables, beside what it prints.

use super::{BASIC, CORRELATIONS, EQUATION_4, Printed};
use crate::correlate::{Correlation, Undefined};
use crate::fit::Fit;
use crate::properties::{ModelProperties, Property};
use crate::sweep::Measure;

/// A number that the paper prints, computed again from other numbers that it prints.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Check {
    /// What the paper has.
    pub printed: Printed,
    /// What its tables give.
    pub recomputed: f64,
    /// How far that may move when each property moves by one unit of its last digit.
    pub slack: f64,
}

impl Check {
    /// Whether the two are one number, as far as the printed digits tell.
    #[must_use]
    pub fn agrees(&self) -> bool {
        self.printed.agrees_within(self.recomputed, self.slack + self.printed.unit())
    }

    /// `statistic` of the points (property, best t) of the basic set.
    fn new(printed: Printed, measure: Measure, property: Property, statistic: fn(&[[f64; 2]]) -> f64) -> Check {
        let mut points = BASIC.map(|mesh| [mesh.printed(property).value(), mesh.best(measure).t.value()]);
        let recomputed = statistic(&points);
        let mut slack = 0.0;
        for (k, mesh) in BASIC.iter().enumerate() {
            let x = points[k][0];
            points[k][0] += mesh.printed(property).unit();
            slack += (statistic(&points) - recomputed).abs();
            points[k][0] = x;
        }
        Check { printed, recomputed, slack }
    }
}

/// The five meshes as the paper prints them with their best t, for [`correlations`](crate::correlations) and [`Fit`].
#[must_use]
pub fn basic_rows(measure: Measure) -> [(ModelProperties, f64); 5] {
    BASIC.map(|mesh| (mesh.properties(), mesh.best(measure).t.value()))
}

/// Table 7 (mean error) or 9 (median error), in the paper's order, from Tables 1 to 4 and 6 or 8.
#[must_use]
pub fn recomputed_correlations(measure: Measure) -> [(Property, Check); 17] {
    let r = |points: &[[f64; 2]]| Correlation::of(points).map_or(f64::NAN, |correlation| correlation.r);
    CORRELATIONS[measure as usize].map(|(property, printed)| (property, Check::new(printed, measure, property, r)))
}

/// The factor and the constant of Eq. 4, from Tables 2 and 8.
#[must_use]
pub fn recomputed_equation_4() -> [Check; 2] {
    let slope = |points: &[[f64; 2]]| Fit::of(points).map_or(f64::NAN, |fit| fit.slope.value);
    let intercept = |points: &[[f64; 2]]| Fit::of(points).map_or(f64::NAN, |fit| fit.intercept.value);
    let [factor, constant] = EQUATION_4;
    let check = |printed, statistic| Check::new(printed, Measure::Median, Property::Sigma, statistic);
    [check(factor, slope), check(constant, intercept)]
}

/// The straight line through a property of 1.obj to 5.obj over 1 to 5: Figure 5 has those of the anisotropy and of the
/// standard deviation.
///
/// # Errors
/// Why there is none: the shortest edge is the same in all.
pub fn trend(property: Property) -> Result<Fit, Undefined> {
    let mut number = 0.0;
    Fit::of(&BASIC.map(|mesh| {
        number += 1.0;
        [number, mesh.printed(property).value()]
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn disagreeing(measure: Measure) -> Vec<(Property, Check)> {
        recomputed_correlations(measure).into_iter().filter(|(_, check)| !check.agrees()).collect()
    }

    #[test]
    fn table_7_follows_from_tables_1_to_4_and_6() {
        assert_eq!(disagreeing(Measure::Mean), []);
        // Where the counts leave no doubt the digits come out: cut off, not rounded.
        let digits = |property| {
            let (_, check) = recomputed_correlations(Measure::Mean).into_iter().find(|(p, _)| *p == property).unwrap();
            (check.printed.to_string(), format!("{:.6}", check.recomputed), check.slack)
        };
        assert_eq!(digits(Property::Faces), ("-0.9281".to_owned(), "-0.928161".to_owned(), 0.0));
        assert_eq!(digits(Property::Vertices), ("-0.9279".to_owned(), "-0.927956".to_owned(), 0.0));
    }

    #[test]
    fn table_9_has_two_numbers_that_do_not_follow() {
        let wrong = disagreeing(Measure::Median);
        let found: Vec<_> =
            wrong.iter().map(|(p, c)| (*p, c.printed.to_string(), format!("{:.4}", c.recomputed))).collect();
        let expected = [(Property::MaxEdge, "0.8956", "0.9267"), (Property::MeanEdge, "0.86", "0.8610")];
        assert_eq!(found, expected.map(|(p, printed, ours)| (p, printed.to_owned(), ours.to_owned())));
        // Then it is not the standard deviation that goes with t most closely.
        let sigma = recomputed_correlations(Measure::Median)[0].1;
        assert!(wrong[0].1.recomputed - wrong[0].1.slack > sigma.recomputed + sigma.slack);
    }

    #[test]
    fn equation_4_follows_from_tables_2_and_8() {
        let [slope, intercept] = recomputed_equation_4();
        assert!(slope.agrees() && intercept.agrees());
        assert_eq!(format!("{:.5} {:.6}", slope.recomputed, intercept.recomputed), "1.01214 -0.000111");
    }

    #[test]
    fn the_trends_of_figure_5_are_lines() {
        let r_squared = |property| trend(property).map(|fit| (fit.r_squared * 1e4).round());
        assert_eq!(r_squared(Property::Anisotropy), Ok(9943.0));
        assert_eq!(r_squared(Property::Sigma), Ok(9797.0));
        assert_eq!(r_squared(Property::MinEdge), Err(Undefined::Constant));
    }
}
