//! The place on the surface that is nearest to a point in space.
//!
//! A tree of boxes around the triangles is searched nearest box first, so that few triangles are looked at. In a triangle
//! with the longest side e from a to b and the third corner c, a point q is split into a part along e and a rest:
//!
//! q - a = x e + y,   c - a = s e + g,   w_c = y·g / g·g,   w_b = x - s w_c,   w_a = (1 - x) - (1 - s) w_c.
//!
//! Where all three weights are positive by more than their rounding, they are those of the nearest place. Else it is on a
//! side opposite to one that is not. A side is seen from the same end in each of its triangles, so what is nearest to an
//! edge or a vertex is so in all of them, to the bit. Because e is the longest side, and y and g have lost their part
//! along it, a needle's place keeps its digits; of a triangle without area only the sides are left.
//!
//! Squared distances are of the place that is returned, which lies in its box; rounding is monotonic, so a box is never
//! farther than what is in it, and the answer does not depend on the tree.
//!
//! O(F log F) time to build, 0.1 kB for each triangle; about O(log F) time for a point. A point with many equally near
//! triangles, such as the centre of a sphere, has to look at all of these: O(F log F).
//!
//! References: T. Lee, S. Lee: OMT: Overlap Minimizing Top-down Bulk Loading Algorithm for R-tree. CAiSE Short Paper
//! Proceedings, 2003. G. R. Hjaltason, H. Samet: Distance Browsing in Spatial Databases. ACM Transactions on Database
//! Systems 24(2), 1999.

use super::point::SurfacePoint;
use crate::control::Control;
use crate::error::{Element, Error, Reason, Result};
use crate::mesh::Mesh;
use crate::metric::{Scale, dot, minus};
use rstar::{AABB, PointDistance, RTree, RTreeObject};
use std::sync::Arc;

/// A mesh prepared for questions of what is nearest to a point; clones share one copy of the data.
#[derive(Debug, Clone)]
pub struct Closest(Arc<Data>);

#[derive(Debug)]
struct Data {
    mesh: Mesh,
    units: Units,
    tree: RTree<Facet>,
}

/// The place on the surface that is nearest to a point in space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClosestPoint {
    /// The place.
    pub point: SurfacePoint,
    /// Its straight distance to the point in space, in mesh units; +inf where that exceeds the largest `f64`.
    pub distance: f64,
}

impl Closest {
    /// Prepares a mesh.
    ///
    /// O(F log F) time, 0.1 kB for each triangle.
    ///
    /// # Errors
    /// [`Reason::BadArgument`] where the mesh has no triangles, or only ignored ones.
    pub fn new(mesh: &Mesh) -> Result<Closest> {
        let units = Units(Scale::of(mesh));
        let mut ignored = mesh.ignored_triangles().iter().peekable();
        let kept = (0..).zip(mesh.triangles()).filter(|(f, _)| ignored.next_if_eq(&f).is_none());
        let corner = |v: u32| units.place(mesh.positions()[v as usize]);
        let facets: Vec<Facet> = kept.map(|(face, t)| Facet { face, corners: t.map(corner) }).collect();
        if facets.is_empty() {
            return Err(no_triangles());
        }
        Ok(Closest(Arc::new(Data { mesh: mesh.clone(), units, tree: RTree::bulk_load(facets) })))
    }

    /// The place on the surface that is nearest to `position`, which is in mesh units.
    ///
    /// Of places that are equally near, one inside a triangle goes before one on an edge, that before a vertex; then the
    /// least triangle counts. So a point nearest to an edge or a vertex gets the least of its triangles.
    ///
    /// ```
    /// # fn main() -> taut::Result<()> {
    /// let mesh = taut::Mesh::from_triangles(&[[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]], &[[0, 1, 2]])?;
    /// let closest = taut::Closest::new(&mesh)?;
    /// let click = closest.point([1.0, 2.0, 5.0])?;
    /// assert_eq!((click.point.barycentric, click.distance), ([0.25, 0.25, 0.5], 5.0));
    /// assert_eq!(closest.point([-3.0, -4.0, 0.0])?.point.barycentric, [1.0, 0.0, 0.0]);
    /// # Ok(()) }
    /// ```
    ///
    /// # Errors
    /// [`Reason::BadArgument`] where a coordinate is not finite.
    pub fn point(&self, position: [f64; 3]) -> Result<ClosestPoint> {
        if !is_finite(&position) {
            return Err(Error::new(Reason::BadArgument, "the point has a coordinate that is not finite"));
        }
        let Data { mesh, units, tree } = &*self.0;
        let point = nearest(tree, units.place(position)).ok_or_else(no_triangles)?;
        let [x, y, z] = minus(point.position(mesh)?, position);
        Ok(ClosestPoint { point, distance: x.hypot(y).hypot(z) })
    }

    /// [`Closest::point`] for each of several positions. The control is consulted every 64 of them.
    ///
    /// # Errors
    /// [`Reason::BadArgument`] naming the first position with a coordinate that is not finite; [`Reason::Cancelled`],
    /// [`Reason::TimeLimit`].
    pub fn points(&self, positions: &[[f64; 3]], control: &Control) -> Result<Vec<ClosestPoint>> {
        if let Some(i) = positions.iter().position(|position| !is_finite(position)) {
            let message = "has a coordinate that is not finite";
            return Err(Error::at(Reason::BadArgument, Element::Point(i as u64), message));
        }
        let mut found = Vec::with_capacity(positions.len());
        for some in positions.chunks(64) {
            control.checkpoint(found.len() as f64 / positions.len() as f64)?;
            for &position in some {
                found.push(self.point(position)?);
            }
        }
        control.report(1.0);
        Ok(found)
    }
}

fn is_finite(position: &[f64; 3]) -> bool {
    position.iter().all(|x| x.is_finite())
}

fn no_triangles() -> Error {
    Error::new(Reason::BadArgument, "the mesh has no triangles that a point could be near to")
}

/// Coordinates in which a mesh is about 1 large.
#[derive(Debug, Clone, Copy)]
struct Units(Scale);

impl Units {
    /// A position in units, no farther out than 2^500, whose square is finite.
    ///
    /// All vertices of a mesh so far out have the same coordinate there, so it tells none from another; and to a point so
    /// far out all are equally near.
    fn place(self, position: [f64; 3]) -> [f64; 3] {
        let farthest = f64::powi(2.0, 500);
        position.map(|x| self.0.to_unit(x).clamp(-farthest, farthest))
    }
}

/// A triangle of the tree.
#[derive(Debug)]
struct Facet {
    face: u32,
    /// In units.
    corners: [[f64; 3]; 3],
}

impl RTreeObject for Facet {
    type Envelope = AABB<[f64; 3]>;

    fn envelope(&self) -> Self::Envelope {
        AABB::from_points(&self.corners)
    }
}

impl PointDistance for Facet {
    fn distance_2(&self, query: &[f64; 3]) -> f64 {
        self.nearest(*query).squared
    }
}

/// The place of a triangle that is nearest to a point.
struct Candidate {
    point: SurfacePoint,
    /// Its squared distance in units.
    squared: f64,
}

impl Candidate {
    /// By distance; then inside before edge before vertex.
    fn rank(&self) -> (f64, usize) {
        (self.squared, self.point.barycentric.into_iter().filter(|&w| w == 0.0).count())
    }
}

impl Facet {
    fn nearest(&self, query: [f64; 3]) -> Candidate {
        let weights = plane_weights(self.corners, query);
        let sides = (0..3).filter(|&k| weights[k] == 0.0).map(|k| {
            let [from, to] = [(k + 1) % 3, (k + 2) % 3];
            let mut barycentric = [0.0; 3];
            [barycentric[from], barycentric[to]] = side_weights([self.corners[from], self.corners[to]], query);
            self.candidate(barycentric, query)
        });
        let on_side = sides.reduce(|best, next| if next.rank() < best.rank() { next } else { best });
        on_side.unwrap_or_else(|| self.candidate(weights, query))
    }

    fn candidate(&self, barycentric: [f64; 3], query: [f64; 3]) -> Candidate {
        let point = SurfacePoint { face: self.face, barycentric };
        Candidate { point, squared: square(minus(point.place(self.corners), query)) }
    }
}

/// The best of the nearest triangles; `None` if there are no triangles.
fn nearest(tree: &RTree<Facet>, query: [f64; 3]) -> Option<SurfacePoint> {
    let mut by_distance = tree.nearest_neighbor_iter_with_distance_2(query);
    let (first, squared) = by_distance.next()?;
    let mut best = first.nearest(query);
    for (facet, _) in by_distance.take_while(|&(_, next)| next == squared) {
        let candidate = facet.nearest(query);
        let key = |c: &Candidate| (c.rank(), c.point.face);
        if key(&candidate) < key(&best) {
            best = candidate;
        }
    }
    Some(best.point)
}

/// The place in a triangle where a position is but for rounding; `None` if it is elsewhere.
pub(super) fn within_rounding(mesh: &Mesh, face: u32, position: [f64; 3]) -> Option<SurfacePoint> {
    let corners = mesh.triangles()[face as usize].map(|v| mesh.positions()[v as usize]);
    let units = Units(Scale::over(&corners));
    let facet = Facet { face, corners: corners.map(|corner| units.place(corner)) };
    let point = facet.nearest(units.place(position)).point;
    let place = point.place(corners);
    let largest = corners.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
    let is_there = (0..3).all(|k| (place[k] - position[k]).abs() <= ROUNDING * largest);
    is_there.then_some(point)
}

/// A share of the lengths in a formula that its rounding does not exceed.
const ROUNDING: f64 = 1.0 / (1u64 << 49) as f64;

/// The weights of the projection of `query` onto the triangle's plane; 0 where one is not above 0 by more than rounding.
///
/// The nearest place is the projection, or on a side that is opposite to a 0.
fn plane_weights(corners: [[f64; 3]; 3], query: [f64; 3]) -> [f64; 3] {
    let squares = [0, 1, 2].map(|k| square(minus(corners[(k + 1) % 3], corners[k])));
    let longest = if squares[0] >= squares[1].max(squares[2]) { 0 } else { 1 + usize::from(squares[2] > squares[1]) };
    let [a, b, c] = [0, 1, 2].map(|k| corners[(longest + k) % 3]);
    let side = minus(b, a);
    let split = |v: [f64; 3]| {
        let share = dot(v, side) / squares[longest];
        (share, minus(v, side.map(|x| share * x)))
    };
    let (s, height) = split(minus(c, a));
    let (x, rest) = split(minus(query, a));
    let w = dot(rest, height) / square(height);
    let weights = [(1.0 - x) - (1.0 - s) * w, x - s * w, w];

    let [length, height, rest] = [side, height, rest].map(|v| square(v).sqrt());
    let reach = length.max(square(minus(query, a)).sqrt());
    // The direction of the height is off by the rounding of the side over the height, and tilts the rest.
    let across = ROUNDING * (reach + rest * length / height) / height;
    let along = ROUNDING * reach / length;
    let errors = [along + (1.0 - s) * across, along + s * across, across];
    // Without area the weights are not numbers, and above nothing.
    [0, 1, 2].map(|k| (k + 3 - longest) % 3).map(|k| if weights[k] > errors[k] { weights[k] } else { 0.0 })
}

/// The weights of the ends of a side at its place nearest to `query`; the same in every triangle, whichever end is first.
pub(super) fn side_weights([a, b]: [[f64; 3]; 2], query: [f64; 3]) -> [f64; 2] {
    if a > b {
        let [to_b, to_a] = side_weights([b, a], query);
        return [to_a, to_b];
    }
    let side = minus(b, a);
    let from_a = minus(query, a);
    let x = dot(from_a, side) / square(side);
    let error = || ROUNDING * (square(from_a).max(square(side)) / square(side)).sqrt();
    match x.min(1.0 - x) {
        to_end if to_end > 0.0 && to_end > error() => [1.0 - x, x],
        _ if x > 0.5 => [0.0, 1.0],
        _ => [1.0, 0.0], // also where both ends are one place, and x is not a number
    }
}

/// v · v.
fn square(v: [f64; 3]) -> f64 {
    dot(v, v)
}
