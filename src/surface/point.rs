//! Places on the surface: points, curves, and the sources that distances are measured from.

use crate::error::{Element, Error, Reason, Result};
use crate::mesh::Mesh;
use crate::mesh::validate::repeats_index;

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
    /// No two that follow each other at the same position; two at least, but for a path of length 0.
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

/// A place as the engines use it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Place {
    /// A vertex.
    Vertex(u32),
    /// Inside a triangle or on one of its edges: two of its weights at least are not 0.
    Face(SurfacePoint),
}

/// The weights of a point may sum to 1 up to this.
const WEIGHTS_OFF: f64 = 1e-6;

impl SurfacePoint {
    /// The point with its weights made to sum to 1, or what is wrong with it.
    pub(crate) fn checked(&self, mesh: &Mesh) -> std::result::Result<Place, String> {
        let SurfacePoint { face, barycentric } = *self;
        let Some(triangle) = mesh.triangles().get(face as usize) else {
            return Err(format!("lies in triangle {face}, but the mesh has {} triangles", mesh.triangle_count()));
        };
        let sum: f64 = barycentric.iter().sum();
        let is_sane = barycentric.iter().all(|&w| w >= 0.0) && (sum - 1.0).abs() <= WEIGHTS_OFF;
        if !is_sane {
            return Err(format!("has the weights {barycentric:?}, which are not three numbers from 0 that sum to 1"));
        }
        let weights = barycentric.map(|w| w / sum);
        let mut others = (0..3).filter(|&k| weights[k] != 0.0);
        match (others.next(), others.next()) {
            (Some(k), None) => Ok(Place::Vertex(triangle[k])),
            _ if repeats_index(triangle) => Err(format!("lies in triangle {face}, which repeats a vertex")),
            _ => Ok(Place::Face(SurfacePoint { face, barycentric: weights })),
        }
    }
}

/// A place that distances are measured from, and the distance that it starts with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Source {
    place: Place,
    offset: f64,
}

/// A source that was checked.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Seed {
    /// Its number in the caller's list.
    pub(crate) source: u32,
    pub(crate) place: Place,
    /// In mesh units.
    pub(crate) offset: f64,
}

impl Source {
    /// A vertex, at distance 0.
    #[must_use]
    pub fn vertex(vertex: u32) -> Source {
        Source { place: Place::Vertex(vertex), offset: 0.0 }
    }

    /// Any point of the surface, at distance 0. Its weights may sum to 1 up to 1e-6.
    #[must_use]
    pub fn point(point: SurfacePoint) -> Source {
        Source { place: Place::Face(point), offset: 0.0 }
    }

    /// The same place with start distance `offset`, in mesh units: any finite number.
    #[must_use]
    pub fn with_offset(self, offset: f64) -> Source {
        Source { offset, ..self }
    }

    /// Where it lies, in mesh units.
    ///
    /// # Errors
    /// [`Reason::VertexOutOfRange`], or [`Reason::BadArgument`] as [`SurfacePoint::position`].
    pub fn position(&self, mesh: &Mesh) -> Result<[f64; 3]> {
        match self.place {
            Place::Face(point) => point.position(mesh),
            Place::Vertex(v) => match mesh.positions().get(v as usize) {
                Some(&position) => Ok(position),
                None => Err(Error::new(Reason::VertexOutOfRange, out_of_range(v, mesh))),
            },
        }
    }

    /// Checks sources: one or more, each on the mesh and with a finite start distance.
    pub(crate) fn checked(sources: &[Source], mesh: &Mesh) -> Result<Vec<Seed>> {
        if sources.is_empty() {
            return Err(Error::new(Reason::NoSource, "at least one source is needed"));
        }
        let seed = |(i, source): (u32, &Source)| {
            let error = |reason, message| Err(Error::at(reason, Element::Source(u64::from(i)), message));
            let place = match source.place {
                Place::Vertex(v) if v as usize >= mesh.vertex_count() => {
                    return error(Reason::VertexOutOfRange, out_of_range(v, mesh));
                }
                Place::Vertex(v) => Place::Vertex(v),
                Place::Face(point) => match point.checked(mesh) {
                    Ok(place) => place,
                    Err(message) => return error(Reason::BadArgument, message),
                },
            };
            if !source.offset.is_finite() {
                let message = format!("has the start distance {}, which is not finite", source.offset);
                return error(Reason::BadArgument, message);
            }
            Ok(Seed { source: i, place, offset: source.offset })
        };
        (0..).zip(sources).map(seed).collect()
    }
}

fn out_of_range(v: u32, mesh: &Mesh) -> String {
    format!("is vertex {v}, but the mesh has {} vertices", mesh.vertex_count())
}
