//! Geodesic distances on triangle meshes, in two independent ways.
//!
//! - [`HeatSolver`]: the heat method. Factorises two sparse matrices once, then answers each set of sources in
//!   milliseconds, within a percent or two on good meshes.
//! - [`ExactSolver`]: shortest paths over the polyhedral surface, exact up to rounding.
//!
//! [`isolines`] draws the lines of equal value of such a field, or of any other; [`descent_paths`] follows it down, back to
//! the sources.
//!
//! A [`Mesh`] is any soup of triangles, from buffers of any type and stride or from a file; it is checked once. Indices
//! count from 0 and are those of the input; distances are in the mesh's units; a vertex that no source reaches has +inf.
//! Long calls take a [`Control`], which tells their progress, cancels them and limits their time and memory.
//!
//! ```
//! # fn main() -> taut::Result<()> {
//! use taut::{Control, ExactOptions, ExactSolver, HeatOptions, HeatSolver, Source, shapes};
//!
//! let mesh = shapes::icosphere(4).mesh()?;
//! let sources = [Source::vertex(0)];
//! let control = Control::new();
//!
//! let exact = ExactSolver::new(&mesh)?.field(&sources, &ExactOptions::default(), &control)?;
//! let heat = HeatSolver::new(&mesh, &HeatOptions::default(), &control)?.field(&sources, &control)?;
//!
//! // Half way round the unit sphere; the polyhedron inside it is a little smaller.
//! let farthest = exact.distances().iter().copied().fold(0.0, f64::max);
//! assert!((farthest / std::f64::consts::PI - 1.0).abs() < 0.01);
//! let off = heat.distances().iter().zip(exact.distances()).map(|(h, d)| (h - d).abs()).fold(0.0, f64::max);
//! assert!(off < 0.02 * farthest);
//!
//! // As a renderer wants them.
//! let single: Vec<f32> = heat.distances().iter().map(|&d| d as f32).collect();
//! assert_eq!(single[0], 0.0);
//! # Ok(()) }
//! ```
#![cfg_attr(not(feature = "capi"), forbid(unsafe_code))]

mod control;
mod error;
mod exact;
#[cfg(feature = "capi")]
mod ffi;
mod heat;
mod linear;
mod mesh;
mod metric;
mod operators;
mod parallel;
mod report;
mod surface;

pub use control::Control;
pub use error::{Element, Error, Reason, Result, Status};
pub use exact::{ExactField, ExactOptions, ExactSolver, SparseDistances};
pub use heat::{
    HeatField, HeatOptions, HeatReport, HeatResiduals, HeatSolver, HeatTimes, Laplacian, Shift, Solver, TimeFormula,
    TimeScale, TimeStep,
};
pub use mesh::Mesh;
pub use mesh::input::{ElementType, Faces, IndexType, Rows, ScalarType};
pub use mesh::io::MeshFormat;
pub use mesh::shapes;
pub use report::{Angle, BoundaryLoop, Component, MeshReport, Properties};
pub use surface::closest::{Closest, ClosestPoint};
pub use surface::curve::Curve;
pub use surface::descent::{DescentPath, descent_paths};
pub use surface::isoline::{Isoline, MAX_LEVELS, even_levels, isolines, spaced_levels};
pub use surface::point::SurfacePoint;
pub use surface::source::Source;
pub use surface::target::Target;

/// Keeps the README's program running.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
