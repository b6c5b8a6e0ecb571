//! Triangle meshes: any soup of triangles or polygons, checked once and then immutable.
//!
//! [`input`] reads the caller's buffers of any stride and type, [`io`] reads files, [`validate`] checks the result,
//! [`topology`] connects it. Nothing is welded, dropped or reordered: vertex `v` of a mesh is vertex `v` of its input
//! (of the formats without a vertex list of their own, STL and glTF, see [`io`]).
//!
//! A polygon becomes a fan of triangles from its first corner. A triangle that repeats a vertex index is kept, so that
//! numbers do not shift, but it is *ignored*: nothing travels over it. Such triangles are listed by
//! [`Mesh::ignored_triangles`].

pub(crate) mod fan;
pub(crate) mod input;
pub(crate) mod io;
pub mod shapes;
pub(crate) mod topology;
pub(crate) mod validate;

use crate::error::{Error, Reason, Result};
use input::{Faces, Rows, ScalarType};
use std::sync::Arc;
use topology::Topology;

/// An immutable mesh; clones share one copy of the data.
#[derive(Debug, Clone)]
pub struct Mesh {
    positions: Arc<Vec<[f64; 3]>>,
    faces: Arc<MeshFaces>,
}

#[derive(Debug)]
struct MeshFaces {
    triangles: Vec<[u32; 3]>,
    ignored: Vec<u32>,
    topology: Topology,
}

impl Mesh {
    /// A mesh of vertex positions (mesh units) and triangles (vertex indices from 0).
    ///
    /// O(V + F) time and memory.
    ///
    /// # Errors
    /// [`Reason::IndexOutOfRange`](crate::Reason) and [`Reason::NonFiniteCoordinate`](crate::Reason) name the face or
    /// vertex; the latter is raised only for a vertex that a face uses. [`Reason::TooManyElements`](crate::Reason)
    /// where 3·F or V does not fit in 32 bits.
    pub fn from_triangles(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<Mesh> {
        Mesh::from_parts(positions.to_vec(), triangles.to_vec())
    }

    /// A mesh of polygons: face `f` has the corners `corners[offsets[f]..offsets[f + 1]]`, so `offsets` has one entry
    /// more than there are faces (or none at all). Each polygon becomes a fan of triangles from its first corner.
    ///
    /// # Errors
    /// As [`Mesh::from_triangles`], and [`Reason::BadOffsets`](crate::Reason) or
    /// [`Reason::FaceTooSmall`](crate::Reason) naming the face.
    pub fn from_polygons(positions: &[[f64; 3]], offsets: &[u32], corners: &[u32]) -> Result<Mesh> {
        Mesh::from_parts(positions.to_vec(), input::fans(offsets, corners)?)
    }

    /// A mesh of the caller's raw buffers, in any stride and type. They are read once; nothing of them is kept.
    ///
    /// # Errors
    /// As [`Mesh::from_polygons`]. A negative index counts as out of range.
    pub fn from_buffers(positions: Rows<'_, ScalarType>, faces: Faces<'_>) -> Result<Mesh> {
        Mesh::from_parts(positions.positions(), faces.triangles()?)
    }

    /// The same triangles with their vertices in other places, as many as before; what connects them is not computed again.
    ///
    /// O(V + F) time, O(V) memory.
    ///
    /// # Errors
    /// [`Reason::BadArgument`](crate::Reason) if there are more or fewer positions than vertices;
    /// [`Reason::NonFiniteCoordinate`](crate::Reason) names the vertex.
    pub fn with_positions(&self, positions: &[[f64; 3]]) -> Result<Mesh> {
        let (count, given) = (self.vertex_count(), positions.len());
        if given != count {
            let message = format!("there are {given} positions for {count} vertices");
            return Err(Error::new(Reason::BadArgument, message));
        }
        validate::elements(positions, self.triangles())?;
        Ok(Mesh { positions: Arc::new(positions.to_vec()), faces: Arc::clone(&self.faces) })
    }

    fn from_parts(positions: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>) -> Result<Mesh> {
        validate::sizes(positions.len(), triangles.len())?;
        validate::elements(&positions, &triangles)?;
        let ignored = validate::repeated_index(&triangles);
        let topology = Topology::new(positions.len(), &triangles);
        Ok(Mesh { positions: Arc::new(positions), faces: Arc::new(MeshFaces { triangles, ignored, topology }) })
    }

    /// How many vertices the mesh has, unreferenced ones included.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    /// How many triangles the mesh has, ignored ones included; a polygon of n corners counts n - 2.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        self.faces.triangles.len()
    }

    /// Position of each vertex, in mesh units. An unreferenced vertex may hold anything, NaN included.
    #[must_use]
    pub fn positions(&self) -> &[[f64; 3]] {
        &self.positions
    }

    /// The three vertex indices of each triangle.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.faces.triangles
    }

    /// The triangles that repeat a vertex index, ascending; nothing travels over them.
    #[must_use]
    pub fn ignored_triangles(&self) -> &[u32] {
        &self.faces.ignored
    }

    /// How the triangles hang together.
    pub(crate) fn topology(&self) -> &Topology {
        &self.faces.topology
    }
}
