//! Geodesic distances and shortest paths on triangle meshes.
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
mod surface;

pub use control::Control;
pub use error::{Element, Error, Reason, Result, Status};
pub use exact::{ExactField, ExactOptions, ExactSolver};
pub use heat::{HeatOptions, HeatReport, HeatSolver, Laplacian, Shift, Solver, TimeFormula, TimeScale, TimeStep};
pub use mesh::Mesh;
pub use mesh::input::{ElementType, Faces, IndexType, Rows, ScalarType};
pub use mesh::io::MeshFormat;
pub use mesh::shapes;
pub use surface::point::Source;
