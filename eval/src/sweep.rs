//! The best t: where the mean and where the median error are least, and how large t may be at most.
//!
//! Every t is a number of three significant digits at the paper's size, as the paper gives it. The sweep takes steps of a
//! third over the whole range, of 3 % around the best of these, and then each number of three digits.
//!
//! The *maximum t*, of the paper: the least t beyond the best at which at least half of the vertices have three times the
//! least error, that is, at which the median error is three times the least.
//!
//! The *search* goes up from the lowest t in steps of a half and stops where t is beyond the maximum that belongs to the
//! least error so far; then it refines as the sweep does.
//!
//! References: "Wave propagation time optimization for geodesic distances calculation using the Heat Method", Open
//! Physics 17 (2019), sections 4 and 5.

use serde::{Deserialize, Serialize};

/// The errors at one t.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// At the paper's size.
    pub t: f64,
    /// The mean error, in percent.
    pub mean: f64,
    /// The median error, in percent.
    pub median: f64,
}

/// Which error is to be least.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Measure {
    /// The mean over the vertices.
    Mean,
    /// The median over the vertices.
    Median,
}

impl Measure {
    /// Both, the paper's order.
    pub const ALL: [Measure; 2] = [Measure::Mean, Measure::Median];
}

impl Point {
    /// The error that is asked for.
    #[must_use]
    pub fn error(&self, measure: Measure) -> f64 {
        match measure {
            Measure::Mean => self.mean,
            Measure::Median => self.median,
        }
    }
}

/// The least error and where it is.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Best {
    /// At the paper's size.
    pub t: f64,
    /// In percent.
    pub error: f64,
    /// Whether it is at an end of the range, so that there may be a lesser one beyond.
    pub at_end: bool,
    /// The maximum t; `None` where it is beyond the range.
    pub maximum_t: Option<f64>,
    /// How many t were tried, those of the other measure left out.
    pub probes: usize,
}

/// A sweep over all t.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Sweep {
    /// All that were tried, t ascending.
    pub points: Vec<Point>,
    /// For the mean error.
    pub mean: Best,
    /// For the median error.
    pub median: Best,
}

impl Sweep {
    /// The best t for one of the errors.
    #[must_use]
    pub fn best(&self, measure: Measure) -> Best {
        match measure {
            Measure::Mean => self.mean,
            Measure::Median => self.median,
        }
    }
}
