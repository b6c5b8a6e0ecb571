//! Targets: places that are asked about.

use super::point::{Place, SurfacePoint};
use crate::error::{Error, Reason, Result};
use crate::mesh::Mesh;

/// A place that is asked about: how far it is, from which source, along which path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Target {
    /// A vertex.
    Vertex(u32),
    /// Any point of the surface. Its weights may sum to 1 up to 1e-6.
    Point(SurfacePoint),
}

impl Target {
    /// The place, if the mesh has it.
    pub(crate) fn checked(&self, mesh: &Mesh) -> Result<Place> {
        match *self {
            Target::Vertex(v) if v as usize >= mesh.vertex_count() => {
                let message = format!("is vertex {v}, but the mesh has {} vertices", mesh.vertex_count());
                Err(Error::new(Reason::VertexOutOfRange, message))
            }
            Target::Vertex(v) => Ok(Place::Vertex(v)),
            Target::Point(point) => match point.checked(mesh) {
                Ok(point) => Ok(point.as_place(mesh)),
                Err(message) => Err(Error::new(Reason::BadArgument, message)),
            },
        }
    }
}
