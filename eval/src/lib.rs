//! How good is a time step? The evaluation of the heat method's t on any set of meshes: what the paper did, for everyone.
//!
//! A [`Model`] has [`ModelProperties`]; a [`Probe`] tells the errors of the heat method at any t; a [`Sweep`] finds the best
//! t; [`FormulaGain`] is what a formula gains over Eq. 1; a [`Study`] is all of it. [`reproduce()`] studies all meshes of a
//! folder and writes a [`report`].
//!
//! References: "Wave propagation time optimization for geodesic distances calculation using the Heat Method", Open
//! Physics 17 (2019); here "the paper".

mod ablation;
mod accuracy;
mod basic_set;
mod claims;
mod correlate;
mod draws;
mod error;
mod fit;
mod gain;
mod model;
mod names;
pub mod paper;
mod probe;
mod properties;
pub mod report;
mod reproduce;
mod study;
mod sweep;
pub mod tables;

pub use ablation::{Ablation, Choice, ErrorPair, Figures, Row, ablation};
pub use accuracy::{Errors, percents};
pub use basic_set::{BasicMesh, basic_set};
pub use claims::{Claim, Evidence, Finding, Judgement, claims};
pub use correlate::{Correlation, Undefined, correlations};
pub use draws::Drawn;
pub use error::{Error, Result};
pub use fit::{Coefficient, Fit};
pub use gain::{Bootstrap, Counts, FormulaGain, Interval, Outcome, Ratios, Sources, Verdict, gains};
pub use model::Model;
pub use names::{FORMULAS, LAPLACIANS, SCALES, equation};
pub use probe::{Probe, exact, setting};
pub use properties::{ModelProperties, Property};
pub use report::Table;
pub use reproduce::{Draw, Observer, Options, Reproduction, Summary, mesh_files, reproduce};
pub use study::{LEAST_REACHED, LaplacianStudy, Study};
pub use sweep::{Best, ErrorCurve, Measure, Point, Range, Sweep};
