//! How windows leave a source: a vertex, a point inside a triangle or on an edge, or a curve.
//!
//! A curve is all of its points at once. The nearest of these is an end of a segment or lies inside of it, and then the
//! path leaves at a right angle. So each point of the curve throws windows as a source of its own, and each segment PQ
//! throws windows of parallel rays to both sides, through the stretch of each side of its triangle that lies between the
//! perpendiculars at P and Q. A segment along an edge does so in every triangle on the edge.
//!
//! Reference: Bommes, Kobbelt, "Accurate computation of geodesic distance fields for polygonal curves on triangle meshes",
//! VMV 2007.

use super::envelope::{larger, smaller};
use super::propagate::{Arrival, Front, Inner};
use super::segment::Flat;
use super::window::{Rays, Window};
use crate::mesh::topology::{NONE, prev};
use crate::surface::curve::{Route, Segment};
use crate::surface::point::{Place, SurfacePoint};
use crate::surface::source::Origin;

/// A vertex is next to a source that is nearer than this share of their triangle's size.
const NEXT_TO: f64 = 1e-6;

impl<R: Rays> Front<'_, R> {
    /// Starts from a source at the distance `sigma`, which must not be negative.
    pub(crate) fn start(&mut self, origin: &Origin, sigma: f64, source: u32) {
        let vertex = if let Origin::Place(Place::Vertex(v)) = *origin { v } else { NONE };
        let emission = self.add_emission(vertex, source, sigma);
        match origin {
            Origin::Place(place) => self.start_at(*place, sigma, emission),
            Origin::Curve(route) => self.start_along(route, sigma, emission),
        }
    }

    fn start_at(&mut self, place: Place, sigma: f64, emission: u32) {
        match place {
            Place::Vertex(v) => {
                self.is_source[v as usize] = true;
                self.relax(v, sigma, Arrival { h: NONE, emission, at: 0.0, sx: 0.0, sy: 0.0 });
            }
            Place::Face(point) => self.start_inside(&point, sigma, emission),
        }
    }

    /// Starts from a point that is no vertex: labels the corners of its triangles and throws windows through all their
    /// sides but the one that it lies on.
    fn start_inside(&mut self, point: &SurfacePoint, sigma: f64, emission: u32) {
        let solver = self.solver;
        for SurfacePoint { face, barycentric } in point.in_triangles(&solver.mesh) {
            self.inner.push(Inner { segment: Segment { face, ends: [barycentric; 2] }, emission });
            for h in 3 * face..3 * face + 3 {
                let chart = solver.charts[h as usize];
                let [sx, sy] = chart.place(h, barycentric);
                self.reach_apex(h, [sx, sy], sigma, emission);
                if barycentric[(prev(h) % 3) as usize] > 0.0 {
                    let rays = R::default();
                    self.throw(h, Window { b0: 0.0, b1: chart.length, sx, sy, sigma, emission, rays });
                }
            }
        }
    }

    /// Labels the apex of half-edge h from a place in its triangle.
    fn reach_apex(&mut self, h: u32, [sx, sy]: [f64; 2], sigma: f64, emission: u32) {
        let chart = self.solver.charts[h as usize];
        let far = (chart.tx - sx).hypot(chart.ty - sy);
        let apex = self.solver.start(prev(h));
        // Rounding tells no more where the path to it comes from.
        self.is_source[apex as usize] |= far <= NEXT_TO * (chart.length + chart.ty);
        // Where the line from the apex over the source leaves the triangle.
        let at = chart.tx + (sx - chart.tx) * (chart.ty / (chart.ty - sy));
        let at = larger(0.0, smaller(at, chart.length));
        self.relax(apex, sigma + far, Arrival { h, emission, at, sx, sy: -sy });
    }

    fn start_along(&mut self, route: &Route, sigma: f64, emission: u32) {
        let mesh = &self.solver.mesh;
        for point in &route.points {
            self.start_at(point.as_place(mesh), sigma, emission);
        }
        for segment in route.segments.iter().flat_map(|segment| segment.in_triangles(mesh)) {
            self.start_across(segment, sigma, emission);
        }
    }

    /// Starts at right angles from a segment in its triangle.
    fn start_across(&mut self, segment: Segment, sigma: f64, emission: u32) {
        let Some(rays) = R::PARALLEL else { return };
        self.inner.push(Inner { segment, emission });
        for h in 3 * segment.face..3 * segment.face + 3 {
            let chart = self.solver.charts[h as usize];
            let flat = Flat::new(&chart, h, &segment);
            let nearest = flat.nearest([chart.tx, chart.ty]);
            if 0.0 < nearest && nearest < 1.0 {
                self.reach_apex(h, flat.place(nearest), sigma, emission);
            }
            let is_on_edge = segment.ends.iter().all(|weights| weights[(prev(h) % 3) as usize] == 0.0);
            if let Some([b0, b1]) = flat.shadow(chart.length).filter(|_| !is_on_edge) {
                let [sx, sy] = flat.normal();
                let sigma = sigma + flat.distance_at_start();
                self.throw(h, Window { b0, b1, sx, sy, sigma, emission, rays });
            }
        }
    }
}
