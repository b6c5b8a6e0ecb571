//! Things on the surface: sources, targets, points, the closest place, curves, isolines, paths of steepest descent.

pub(crate) mod basin;
pub(crate) mod closest;
pub(crate) mod curve;
pub(crate) mod descent;
mod drain;
pub(crate) mod isoline;
pub(crate) mod point;
pub(crate) mod source;
pub(crate) mod target;

use crate::error::{Error, Reason, Result};
use crate::mesh::Mesh;

/// Checks that a field has a value for each vertex.
fn check_values(mesh: &Mesh, values: &[f64]) -> Result<()> {
    let [given, needed] = [values.len(), mesh.vertex_count()];
    if given == needed {
        return Ok(());
    }
    Err(Error::new(Reason::BadArgument, format!("there are {given} values, but the mesh has {needed} vertices")))
}
