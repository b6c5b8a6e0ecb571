//! Polylines over the surface.

use super::closest::within_rounding;
use super::point::SurfacePoint;
use crate::error::Result;
use crate::mesh::Mesh;
use crate::mesh::topology::next;

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

/// A straight piece of a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Segment {
    /// The triangle that it lies in.
    pub(crate) face: u32,
    /// The weights of its two ends there, which differ but for a curve of one point.
    pub(crate) ends: [[f64; 3]; 2],
}

/// A curve that was checked.
#[derive(Debug, Clone)]
pub(crate) struct Route {
    pub(crate) points: Vec<SurfacePoint>,
    /// Those with a length.
    pub(crate) segments: Vec<Segment>,
}

impl Curve {
    /// Where its points lie, in mesh units.
    ///
    /// # Errors
    /// As [`SurfacePoint::position`].
    pub fn positions(&self, mesh: &Mesh) -> Result<Vec<[f64; 3]>> {
        self.points.iter().map(|point| point.position(mesh)).collect()
    }

    /// Its points and segments, or what is wrong with one of them. Points may follow each other at one place, and on an
    /// edge or at a vertex they may name any triangle there, if some triangle holds the segment, up to rounding.
    pub(crate) fn checked(&self, mesh: &Mesh) -> std::result::Result<Route, String> {
        let check = |(i, point): (usize, &SurfacePoint)| {
            point.checked(mesh).map_err(|message| format!("is a curve whose point {i} {message}"))
        };
        let points: Vec<SurfacePoint> =
            self.points.iter().enumerate().map(check).collect::<std::result::Result<_, _>>()?;
        let Some(first) = points.first() else { return Err("is a curve without points".to_owned()) };
        let back = if self.is_closed { Some(first) } else { None };
        let mut segments = Vec::with_capacity(points.len());
        for (i, (from, to)) in points.iter().zip(points[1..].iter().chain(back)).enumerate() {
            match Segment::between(from, to, mesh).or_else(|| Segment::within_rounding(from, to, mesh)) {
                _ if from == to => {}
                Some(segment) if segment.ends[0] == segment.ends[1] => {}
                Some(segment) => segments.push(segment),
                None => return Err(format!("is a curve whose segment from point {i} to the next lies in no triangle")),
            }
        }
        Ok(Route { points, segments })
    }
}

impl Segment {
    /// From one checked point to another, in the triangle that the first one names or, if that does not hold both, in
    /// another that does.
    pub(crate) fn between(from: &SurfacePoint, to: &SurfacePoint, mesh: &Mesh) -> Option<Segment> {
        let in_triangle = |from: &SurfacePoint| {
            let to = to.in_triangle(mesh, from.face)?;
            Some(Segment { face: from.face, ends: [from.barycentric, to.barycentric] })
        };
        in_triangle(from).or_else(|| from.in_triangles(mesh).iter().find_map(in_triangle))
    }

    /// As [`Segment::between`], to the position of `to`. Of several points that rounding puts at one place, such as an
    /// isoline has beside a vertex, a curve keeps only one, which the triangle before it need not hold.
    fn within_rounding(from: &SurfacePoint, to: &SurfacePoint, mesh: &Mesh) -> Option<Segment> {
        let position = to.position(mesh).ok()?;
        from.in_triangles(mesh).iter().find_map(|from| {
            let to = within_rounding(mesh, from.face, position)?;
            Some(Segment { face: from.face, ends: [from.barycentric, to.barycentric] })
        })
    }

    /// The point with this share of the segment before it. Where the weights of both ends agree it has just these.
    pub(crate) fn at(&self, share: f64) -> SurfacePoint {
        let [from, to] = self.ends;
        let weight = |k: usize| (1.0 - share) * from[k] + share * to[k];
        SurfacePoint { face: self.face, barycentric: [0, 1, 2].map(weight) }
    }

    /// In each of the triangles that it lies in: in its own, or in all on the edge that it runs along.
    pub(crate) fn in_triangles(&self, mesh: &Mesh) -> Vec<Segment> {
        let Segment { face, ends: [from, to] } = *self;
        let on_edge = (0..3).find(|&k| from[k as usize] == 0.0 && to[k as usize] == 0.0);
        let beyond = on_edge.map(|k| {
            let h = next(3 * face + k);
            let [from, to] = [from, to].map(|barycentric| SurfacePoint { face, barycentric }.beyond(mesh, h));
            from.zip(to).map(|(from, to)| Segment { face: from.face, ends: [from.barycentric, to.barycentric] })
        });
        [*self].into_iter().chain(beyond.into_iter().flatten()).collect()
    }
}
