//! What is drawn: the surface at unit size, with a normal at each corner, and a small ball at each source.
//!
//! Normals are the sum of the areas' normals around a vertex, of those faces only that meet at less than the crease angle:
//! so round things look round, and the edges of a machine part stay sharp. Faces may be wound either way. Vertices of
//! bit-equal position count as one here, for soups that are not stitched. O(V + F).

use glam::{DVec3, Vec3};
use std::collections::HashMap;
use taut::{Mesh, shapes};

/// Faces that meet at more than 48 degrees make a crease.
const CREASE_COSINE: f32 = 0.669;

/// Around a vertex of more faces than this only some are looked at, evenly: a fan of a million faces costs no square.
const NEIGHBOURS: usize = 64;

/// Radius of a ball, where the largest extent of the mesh is 2; many balls are smaller.
const BALL: f32 = 0.028;

/// More sources than this are not marked: balls would cover the surface.
const MOST_BALLS: usize = 10_000;

pub(super) struct Body {
    /// In [-1, 1]; that of a vertex that no face uses is some other vertex's.
    pub(super) positions: Vec<Vec3>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// One for each corner, of length 1, or 0 where a face has no area.
    pub(super) normals: Vec<[Vec3; 3]>,
    /// Triangles from here on are balls.
    pub(super) balls_from: usize,
    vertices: usize,
    frame: Frame,
}

/// Brings mesh coordinates into [-1, 1], whatever finite numbers they are.
#[derive(Clone, Copy)]
struct Frame {
    middle: DVec3,
    half: f64,
}

impl Frame {
    fn new(points: impl Iterator<Item = DVec3> + Clone) -> Option<Frame> {
        let low = points.clone().reduce(DVec3::min)?;
        let high = points.reduce(DVec3::max)?;
        let half = (0.5 * high - 0.5 * low).max_element(); // halves first: no overflow
        Some(Frame { middle: 0.5 * low + 0.5 * high, half: if half > 0.0 { half } else { 1.0 } })
    }

    fn place(self, point: DVec3) -> Vec3 {
        // Divided, not multiplied by the inverse: that of 1e-310 is infinite.
        ((point - self.middle) / self.half).as_vec3()
    }
}

impl Body {
    /// `None` where no face is.
    pub(super) fn new(mesh: &Mesh, sources: &[[f64; 3]]) -> Option<Body> {
        let is_face = |t: &&[u32; 3]| t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
        let triangles: Vec<[u32; 3]> = mesh.triangles().iter().filter(is_face).copied().collect();
        let at = |v: u32| DVec3::from(mesh.positions()[v as usize]);
        let frame = Frame::new(triangles.iter().flatten().map(|&v| at(v)))?;
        let mut positions = vec![frame.place(at(triangles[0][0])); mesh.vertex_count()];
        for &v in triangles.iter().flatten() {
            positions[v as usize] = frame.place(at(v));
        }
        let normals = corner_normals(&positions, &triangles);
        let balls_from = triangles.len();
        let mut body = Body { positions, triangles, normals, balls_from, vertices: mesh.vertex_count(), frame };
        body.add_balls(sources);
        Some(body)
    }

    /// Where a point of the mesh's space is in the picture's.
    pub(super) fn place(&self, point: [f64; 3]) -> Vec3 {
        self.frame.place(point.into())
    }

    /// The vertices of the surface, without those of balls.
    pub(super) fn surface(&self) -> &[Vec3] {
        &self.positions[..self.vertices]
    }

    /// The corners of a triangle.
    pub(super) fn corners(&self, f: usize) -> [Vec3; 3] {
        self.triangles[f].map(|v| self.positions[v as usize])
    }

    /// Of length 1, or 0 where the triangle has no area.
    pub(super) fn face_normal(&self, f: usize) -> Vec3 {
        area_normal(self.corners(f)).normalize_or_zero()
    }

    /// Balls where `sources` are, unless that is off the surface or nowhere, as an unreferenced vertex may be.
    fn add_balls(&mut self, sources: &[[f64; 3]]) {
        let centres = sources.iter().map(|&source| self.place(source));
        let centres: Vec<Vec3> = centres.filter(|c| c.is_finite() && c.abs().max_element() < 1.01).collect();
        if centres.len() > MOST_BALLS {
            return;
        }
        let radius = BALL / (centres.len() as f32 / 20.0).max(1.0).cbrt();
        let sphere = shapes::icosphere(if centres.len() > 100 { 1 } else { 3 });
        let directions: Vec<Vec3> = sphere.positions.iter().map(|&p| DVec3::from(p).as_vec3().normalize()).collect();
        for centre in centres {
            let first = self.positions.len() as u32; // fits, for any mesh that fits into memory
            self.positions.extend(directions.iter().map(|&direction| centre + radius * direction));
            self.triangles.extend(sphere.triangles.iter().map(|t| t.map(|v| first + v)));
            self.normals.extend(sphere.triangles.iter().map(|t| t.map(|v| directions[v as usize])));
        }
    }
}

/// Twice the area times the unit normal.
fn area_normal([a, b, c]: [Vec3; 3]) -> Vec3 {
    // In double precision, so that slivers have a direction too.
    let [a, b, c] = [a, b, c].map(Vec3::as_dvec3);
    (b - a).cross(c - a).as_vec3()
}

fn corner_normals(positions: &[Vec3], triangles: &[[u32; 3]]) -> Vec<[Vec3; 3]> {
    let areas: Vec<Vec3> = triangles.iter().map(|t| area_normal(t.map(|v| positions[v as usize]))).collect();
    let units: Vec<Vec3> = areas.iter().map(|area| area.normalize_or_zero()).collect();
    let welded = welded(positions);
    let (start, faces) = faces_at(&welded, triangles);
    let corner = |v: u32, f: usize| {
        let v = welded[v as usize] as usize;
        let around = &faces[start[v] as usize..start[v + 1] as usize];
        let mut sum = areas[f];
        for &g in around.iter().step_by(around.len().div_ceil(NEIGHBOURS)).filter(|&&g| g as usize != f) {
            let cosine = units[f].dot(units[g as usize]);
            if cosine.abs() > CREASE_COSINE {
                sum += areas[g as usize] * cosine.signum();
            }
        }
        sum.normalize_or(units[f])
    };
    triangles.iter().enumerate().map(|(f, t)| t.map(|v| corner(v, f))).collect()
}

/// For each vertex the first one of bit-equal position.
fn welded(positions: &[Vec3]) -> Vec<u32> {
    let mut first = HashMap::with_capacity(positions.len());
    let mut name = |(v, p): (u32, &Vec3)| *first.entry(p.to_array().map(f32::to_bits)).or_insert(v);
    (0..).zip(positions).map(&mut name).collect()
}

/// The faces at each vertex: those of `v` are `faces[start[v]..start[v + 1]]`.
fn faces_at(welded: &[u32], triangles: &[[u32; 3]]) -> (Vec<u32>, Vec<u32>) {
    let corners = || triangles.iter().flatten().map(|&v| welded[v as usize] as usize);
    let mut start = vec![0u32; welded.len() + 2];
    for v in corners() {
        start[v + 2] += 1;
    }
    for v in 2..start.len() {
        start[v] += start[v - 1];
    }
    // start[v + 1] is where the next face of v goes; when all are placed, it is where those of v end.
    let mut faces = vec![0; 3 * triangles.len()];
    for (corner, v) in corners().enumerate() {
        faces[start[v + 1] as usize] = (corner / 3) as u32; // fits: faces are numbered by u32
        start[v + 1] += 1;
    }
    (start, faces)
}
