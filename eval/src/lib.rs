//! How good is a time step? The evaluation of the heat method's t on any set of meshes: what the paper did, for everyone.
//!
//! A [`Model`] has [`ModelProperties`]; a [`Probe`] tells the errors of the heat method at any t; a [`Sweep`] finds the best
//! t; [`FormulaGain`] is what a formula gains over Eq. 1; a [`Study`] is all of it.
//!
//! References: "Wave propagation time optimization for geodesic distances calculation using the Heat Method", Open
//! Physics 17 (2019); here "the paper".

mod accuracy;
mod error;
mod gain;
mod model;
mod names;
pub mod paper;
mod probe;
mod properties;
pub mod report;
mod study;
mod sweep;

pub use accuracy::{Errors, percents};
pub use error::{Error, Result};
pub use gain::{FormulaGain, Interval, Outcome, Ratios, Verdict};
pub use model::Model;
pub use names::{FORMULAS, LAPLACIANS, SCALES, equation};
pub use probe::{Probe, exact};
pub use properties::{ModelProperties, Property};
pub use study::{LaplacianStudy, Study};
pub use sweep::{Best, Measure, Point, Sweep};
