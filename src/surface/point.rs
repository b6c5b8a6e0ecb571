//! Places on the surface: points, curves, and the sources that distances are measured from.

use crate::error::{Element, Error, Reason, Result};
use crate::mesh::Mesh;

/// A place on the surface: a triangle, and weights of its corners that are not negative and sum to 1.
///
/// On an edge the weight of the opposite corner is exactly 0, at a vertex those of both other corners are. Several
/// triangles can name such a place; with the same weights they give the same position to the last bit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePoint {
    /// The triangle.
    pub face: u32,
    /// The weight of each of its corners, in their order.
    pub barycentric: [f64; 3],
}

/// A polyline over the surface.
///
/// The segment from a point to the next one lies in the triangle that the point names. A closed curve has one more, from
/// its last point to its first, which is not repeated; an open one ends in a point that names the last segment's triangle.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Two points at least, no two that follow each other at the same position.
    pub points: Vec<SurfacePoint>,
    /// Whether the last point is joined to the first.
    pub is_closed: bool,
}

impl SurfacePoint {
    /// Where the point lies, in mesh units.
    ///
    /// Each coordinate is between those of the corners with a weight, so it does not overflow, and where the corners
    /// agree it is exactly theirs.
    ///
    /// # Errors
    /// [`Reason::BadArgument`] naming the face where the mesh has no such triangle.
    pub fn position(&self, mesh: &Mesh) -> Result<[f64; 3]> {
        let Some(triangle) = mesh.triangles().get(self.face as usize) else {
            let message = format!("is where a point lies, but the mesh has {} triangles", mesh.triangle_count());
            return Err(Error::at(Reason::BadArgument, Element::Face(u64::from(self.face)), message));
        };
        Ok(self.place(triangle.map(|v| mesh.positions()[v as usize])))
    }

    /// Where it lies in a triangle with these corners.
    pub(super) fn place(&self, corners: [[f64; 3]; 3]) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.between(corners.map(|corner| corner[axis])))
    }

    /// Σ wᵢ xᵢ over the corners with a weight, kept between the least and the greatest of their xᵢ.
    fn between(&self, x: [f64; 3]) -> f64 {
        let [mut sum, mut low, mut high] = [0.0, f64::INFINITY, f64::NEG_INFINITY];
        for (&w, &x) in self.barycentric.iter().zip(&x) {
            if w != 0.0 {
                sum += w * x;
                low = x.min(low);
                high = x.max(high);
            }
        }
        // f64::clamp would panic for weights that are all 0, f64::min and max leave the sign of a zero open.
        if sum < low {
            low
        } else if sum > high {
            high
        } else {
            sum
        }
    }
}

impl Curve {
    /// Where its points lie, in mesh units.
    ///
    /// # Errors
    /// As [`SurfacePoint::position`].
    pub fn positions(&self, mesh: &Mesh) -> Result<Vec<[f64; 3]>> {
        self.points.iter().map(|point| point.position(mesh)).collect()
    }
}

/// A place that distances are measured from, and the distance that it starts with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Source {
    vertex: u32,
    offset: f64,
}

impl Source {
    /// A vertex, at distance 0.
    #[must_use]
    pub fn vertex(vertex: u32) -> Source {
        Source { vertex, offset: 0.0 }
    }

    /// The same place with start distance `offset`, in mesh units: any finite number.
    #[must_use]
    pub fn with_offset(self, offset: f64) -> Source {
        Source { offset, ..self }
    }

    /// The vertex.
    #[must_use]
    pub fn vertex_index(self) -> u32 {
        self.vertex
    }

    /// The start distance, in mesh units.
    pub(crate) fn offset(self) -> f64 {
        self.offset
    }

    /// Sources as the engines use them: checked, sorted by vertex, and of several at one vertex only the nearest.
    pub(crate) fn checked(sources: &[Source], mesh_vertices: usize) -> Result<Vec<Source>> {
        if sources.is_empty() {
            return Err(Error::new(Reason::NoSource, "at least one source is needed"));
        }
        for (i, source) in (0..).zip(sources) {
            if source.vertex as usize >= mesh_vertices {
                let message = format!("is vertex {}, but the mesh has {mesh_vertices} vertices", source.vertex);
                return Err(Error::at(Reason::VertexOutOfRange, Element::Source(i), message));
            }
            if !source.offset.is_finite() {
                let message = format!("has the start distance {}, which is not finite", source.offset);
                return Err(Error::at(Reason::BadArgument, Element::Source(i), message));
            }
        }
        let mut checked = sources.to_vec();
        checked.sort_by(|a, b| a.vertex.cmp(&b.vertex).then(a.offset.total_cmp(&b.offset)));
        checked.dedup_by_key(|source| source.vertex);
        Ok(checked)
    }
}
