//! Points of the surface, and the triangles that they lie in.

use crate::error::{Element, Error, Reason, Result};
use crate::mesh::Mesh;
use crate::mesh::topology::{next, start};
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

impl SurfacePoint {
    /// Where the point lies, in mesh units.
    ///
    /// Each coordinate is between those of the corners with a weight, so it does not overflow, and where the corners
    /// agree it is exactly theirs.
    ///
    /// # Errors
    /// [`Reason::BadArgument`] naming the face where the mesh has no such triangle, or where the weights are not numbers
    /// from 0 that sum to 1 up to 1e-6.
    pub fn position(&self, mesh: &Mesh) -> Result<[f64; 3]> {
        let Some(triangle) = mesh.triangles().get(self.face as usize) else {
            let message = format!("is where a point lies, but the mesh has {} triangles", mesh.triangle_count());
            return Err(Error::at(Reason::BadArgument, Element::Face(u64::from(self.face)), message));
        };
        self.check_weights().map_err(|message| Error::new(Reason::BadArgument, format!("the point {message}")))?;
        Ok(self.place(triangle.map(|v| mesh.positions()[v as usize])))
    }

    /// Where it lies in a triangle with these corners.
    pub(super) fn place(&self, corners: [[f64; 3]; 3]) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.between(corners.map(|corner| corner[axis])))
    }

    /// Σ wᵢ xᵢ over the corners with a weight, kept between the least and the greatest of their xᵢ.
    pub(super) fn between(&self, x: [f64; 3]) -> f64 {
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

/// A place as the engines use it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Place {
    /// A vertex.
    Vertex(u32),
    /// Inside a triangle or on one of its edges: two of its weights at least are not 0.
    Face(SurfacePoint),
}

impl Place {
    /// The place in each of the triangles that it lies in; in none for a vertex of no triangle.
    pub(crate) fn in_triangles(&self, mesh: &Mesh) -> Vec<SurfacePoint> {
        match self {
            Place::Vertex(v) => {
                let corners = mesh.topology().corners.row(*v);
                corners.iter().map(|&h| SurfacePoint::at_start(h)).collect()
            }
            Place::Face(point) => {
                let on_edge = (0..3).find(|&k| point.barycentric[k as usize] == 0.0);
                let beyond = on_edge.map(|k| point.beyond(mesh, next(3 * point.face + k))).into_iter().flatten();
                [*point].into_iter().chain(beyond).collect()
            }
        }
    }
}

/// The weights of a point may sum to 1 up to this.
const WEIGHTS_OFF: f64 = 1e-6;

impl SurfacePoint {
    /// The point with its weights made to sum to 1, or what is wrong with it.
    pub(crate) fn checked(&self, mesh: &Mesh) -> std::result::Result<SurfacePoint, String> {
        let SurfacePoint { face, barycentric } = *self;
        let Some(triangle) = mesh.triangles().get(face as usize) else {
            return Err(format!("lies in triangle {face}, but the mesh has {} triangles", mesh.triangle_count()));
        };
        let sum = self.check_weights()?;
        let point = SurfacePoint { face, barycentric: barycentric.map(|w| w / sum) };
        if matches!(point.as_place(mesh), Place::Face(_)) && repeats_index(triangle) {
            return Err(format!("lies in triangle {face}, which repeats a vertex"));
        }
        Ok(point)
    }

    /// The sum of the weights, or what is wrong with them.
    fn check_weights(&self) -> std::result::Result<f64, String> {
        let weights = self.barycentric;
        let sum: f64 = weights.iter().sum();
        if weights.iter().all(|&w| w >= 0.0) && (sum - 1.0).abs() <= WEIGHTS_OFF {
            return Ok(sum);
        }
        Err(format!("has the weights {weights:?}, which are not three numbers from 0 that sum to 1"))
    }

    /// A checked point as the engines use it.
    pub(crate) fn as_place(&self, mesh: &Mesh) -> Place {
        let mut others = (0..3).filter(|&k| self.barycentric[k as usize] != 0.0);
        match (others.next(), others.next()) {
            (Some(k), None) => Place::Vertex(start(mesh.triangles(), 3 * self.face + k)),
            _ => Place::Face(*self),
        }
    }

    /// A corner of a triangle as a point in it; None for any other vertex, and in an ignored triangle.
    pub(crate) fn corner(mesh: &Mesh, face: u32, v: u32) -> Option<SurfacePoint> {
        let triangle = &mesh.triangles()[face as usize];
        let k = triangle.iter().position(|&corner| corner == v).filter(|_| !repeats_index(triangle))?;
        Some(SurfacePoint::at_start(3 * face + k as u32)) // fits: k < 3
    }

    /// The corner where half-edge h starts.
    pub(super) fn at_start(h: u32) -> SurfacePoint {
        let mut barycentric = [0.0; 3];
        barycentric[(h % 3) as usize] = 1.0;
        SurfacePoint { face: h / 3, barycentric }
    }

    /// A checked point in each of the triangles that it lies in: in its own, in all on its edge, in all at its vertex.
    pub(crate) fn in_triangles(&self, mesh: &Mesh) -> Vec<SurfacePoint> {
        self.as_place(mesh).in_triangles(mesh)
    }

    /// A checked point as a point of this triangle, if it lies in it.
    pub(crate) fn in_triangle(&self, mesh: &Mesh, face: u32) -> Option<SurfacePoint> {
        match self.as_place(mesh) {
            Place::Vertex(v) => SurfacePoint::corner(mesh, face, v),
            Place::Face(_) => self.in_triangles(mesh).into_iter().find(|point| point.face == face),
        }
    }

    /// A point on half-edge h of its triangle as a point of each other triangle on that edge.
    pub(crate) fn beyond(self, mesh: &Mesh, h: u32) -> impl Iterator<Item = SurfacePoint> {
        let [at_start, at_end] = [h, next(h)].map(|h| self.barycentric[(h % 3) as usize]);
        others(mesh, h).map(move |g| {
            let is_along = start(mesh.triangles(), g) == start(mesh.triangles(), h);
            let ends = if is_along { [at_start, at_end] } else { [at_end, at_start] };
            let mut barycentric = [0.0; 3];
            [barycentric[(g % 3) as usize], barycentric[(next(g) % 3) as usize]] = ends;
            SurfacePoint { face: g / 3, barycentric }
        })
    }
}

/// The half-edges on the edge of h besides h.
pub(crate) fn others(mesh: &Mesh, h: u32) -> impl Iterator<Item = u32> {
    let topology = mesh.topology();
    topology.halfedges.row(topology.edge_of[h as usize]).iter().copied().filter(move |&g| g != h)
}
