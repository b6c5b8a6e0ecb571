//! Meshes of known geometry, for tests, benchmarks and examples.
//!
//! Each is a [`Shape`]: plain arrays of positions and triangles. The counts are the caller's to keep sensible: the
//! vertices must fit into 32 bits. Linear in the number of triangles.

use super::Mesh;
use crate::error::Result;
use std::collections::HashMap;
use std::f64::consts::TAU;

/// Positions and triangles of a made-up mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Shape {
    /// Position of each vertex.
    pub positions: Vec<[f64; 3]>,
    /// The three vertex indices of each triangle, counter-clockwise seen from outside or above.
    pub triangles: Vec<[u32; 3]>,
}

impl Shape {
    /// The shape as a [`Mesh`].
    ///
    /// # Errors
    /// As [`Mesh::from_triangles`]; never for a shape of finite dimensions as its function returned it.
    pub fn mesh(&self) -> Result<Mesh> {
        Mesh::from_triangles(&self.positions, &self.triangles)
    }

    /// `columns` × `rows` squares, each cut in two; vertex (i, j) stands at `position(i, j)` and has the index
    /// j · width + i. A direction that `wraps` joins its last squares to its first vertices (give it three at least).
    fn lattice([columns, rows]: [u32; 2], wraps: [bool; 2], position: impl Fn(f64, f64) -> [f64; 3]) -> Shape {
        let width = columns + u32::from(!wraps[0]);
        let height = rows + u32::from(!wraps[1]);
        let each = |width, height| (0..height).flat_map(move |j| (0..width).map(move |i| (i, j)));
        let vertex = |i, j| (j % height) * width + i % width;
        let triangles = each(columns, rows).flat_map(|(i, j)| {
            let [a, b, c, d] = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
            [[a, b, c], [a, c, d]]
        });
        Shape {
            positions: each(width, height).map(|(i, j)| position(f64::from(i), f64::from(j))).collect(),
            triangles: triangles.collect(),
        }
    }
}

/// A flat open rectangle in the plane z = 0: `columns` × `rows` unit squares, vertex j · (columns + 1) + i at (i, j, 0).
#[must_use]
pub fn grid(columns: u32, rows: u32) -> Shape {
    Shape::lattice([columns, rows], [false, false], |i, j| [i, j, 0.0])
}

/// Open hills over [-1, 1]², `squares` on a side: waves of several lengths, the highest about `height`.
#[must_use]
pub fn terrain(squares: u32, height: f64) -> Shape {
    graph(squares, |x, y| {
        let waves = (3.0 * x).sin() * (4.0 * y).cos() + 0.5 * (9.0 * x + 5.0 * y).sin() + 0.25 * (17.0 * (x - y)).cos();
        height * waves / 1.75
    })
}

/// The saddle z = x² - y² over [-1, 1]², open, `squares` on a side.
#[must_use]
pub fn saddle(squares: u32) -> Shape {
    graph(squares, |x, y| x * x - y * y)
}

/// The graph z = f(x, y) over [-1, 1]².
fn graph(squares: u32, z: impl Fn(f64, f64) -> f64) -> Shape {
    let coordinate = |i: f64| 2.0 * i / f64::from(squares) - 1.0;
    Shape::lattice([squares, squares], [false, false], |i, j| {
        let [x, y] = [coordinate(i), coordinate(j)];
        [x, y, z(x, y)]
    })
}

/// An open upright prism over a regular polygon of `sides` corners on the unit circle, from z = 0 to z = `height` in
/// `rows` rows. Laid flat it is a rectangle of the width 2 · sides · sin(π / sides).
#[must_use]
pub fn cylinder(sides: u32, rows: u32, height: f64) -> Shape {
    Shape::lattice([sides, rows], [true, false], |i, j| {
        let (sin, cos) = (TAU * i / f64::from(sides)).sin_cos();
        [cos, sin, height * j / f64::from(rows)]
    })
}

/// A torus about the z axis: a circle of the radius `major`, thickened to a tube of the radius `minor`.
#[must_use]
pub fn torus(columns: u32, rows: u32, major: f64, minor: f64) -> Shape {
    Shape::lattice([columns, rows], [true, true], |i, j| {
        let (sin_u, cos_u) = (TAU * i / f64::from(columns)).sin_cos();
        let (sin_v, cos_v) = (TAU * j / f64::from(rows)).sin_cos();
        let distance = major + minor * cos_v;
        [distance * cos_u, distance * sin_u, minor * sin_v]
    })
}

/// An open cone of flat sectors whose apex, vertex 0, has exactly the angle `angle` around it, in radians; the edges
/// from apex to rim have length 1. Vertex 1 + ring · sides + side stands (ring + 1) / rings from the apex.
///
/// Below 2π it is a pyramid of `sides` sides, above 2π (up to π · sides, for an even number of sides) a saddle whose rays
/// go up and down by turns: with the elevation α, cos(angle / sides) = cos²α · cos(2π / sides) ± sin²α.
#[must_use]
pub fn cone(angle: f64, sides: u32, rings: u32) -> Shape {
    let is_saddle = angle > TAU;
    let [turn, sector] = [(TAU / f64::from(sides)).cos(), (angle / f64::from(sides)).cos()];
    let sin_elevation = ((sector - turn) / if is_saddle { -1.0 - turn } else { 1.0 - turn }).sqrt();
    let ray = |side: u32| {
        let (sin, cos) = (TAU * f64::from(side) / f64::from(sides)).sin_cos();
        let level = (1.0 - sin_elevation * sin_elevation).sqrt();
        let down = if is_saddle && side.is_multiple_of(2) { 1.0 } else { -1.0 };
        [level * cos, level * sin, down * sin_elevation]
    };
    let mut positions = vec![[0.0; 3]];
    for ring in 1..=rings {
        let radius = f64::from(ring) / f64::from(rings);
        positions.extend((0..sides).map(|side| ray(side).map(|x| radius * x)));
    }
    let below = Shape::lattice([sides, rings.saturating_sub(1)], [true, false], |_, _| [0.0; 3]);
    let top = (0..sides).map(|side| [0, 1 + side, 1 + (side + 1) % sides]);
    // The lattice's rows run outward, so its triangles face the other way.
    let triangles = top.chain(below.triangles.iter().map(|&[a, b, c]| [1 + a, 1 + c, 1 + b])).collect();
    Shape { positions, triangles }
}

/// The unit sphere: an icosahedron, each triangle cut in four `subdivisions` times and its vertices pushed outward.
#[must_use]
pub fn icosphere(subdivisions: u32) -> Shape {
    let mut shape = icosahedron();
    for _ in 0..subdivisions {
        shape = subdivided(&shape);
        shape.positions.iter_mut().for_each(|position| *position = unit(*position));
    }
    shape
}

/// Two poles and two rings of five.
fn icosahedron() -> Shape {
    let z = 0.2_f64.sqrt();
    let ring = |turn: f64, z: f64| {
        (0..5).map(move |k| {
            let (sin, cos) = ((f64::from(k) + turn) * TAU / 5.0).sin_cos();
            [2.0 * 0.2_f64.sqrt() * cos, 2.0 * 0.2_f64.sqrt() * sin, z]
        })
    };
    let positions = [[0.0, 0.0, 1.0]].into_iter().chain(ring(0.0, z)).chain(ring(0.5, -z)).chain([[0.0, 0.0, -1.0]]);
    let triangles = (0..5).flat_map(|k| {
        let [upper, lower] = [1 + k, 6 + k];
        let [next_upper, next_lower] = [1 + (k + 1) % 5, 6 + (k + 1) % 5];
        [[0, upper, next_upper], [upper, lower, next_upper], [lower, next_lower, next_upper], [lower, 11, next_lower]]
    });
    Shape { positions: positions.collect(), triangles: triangles.collect() }
}

/// Each triangle cut in four at the midpoints of its edges: the same surface. The old vertices keep their indices. Triangles
/// that repeat a vertex become four that do.
#[must_use]
pub fn subdivided(shape: &Shape) -> Shape {
    let mut positions = shape.positions.clone();
    let mut midpoints = HashMap::new();
    let mut midpoint = |a: u32, b: u32| {
        if a == b {
            return a;
        }
        *midpoints.entry((a.min(b), a.max(b))).or_insert_with(|| {
            let [p, q] = [shape.positions[a as usize], shape.positions[b as usize]];
            positions.push(std::array::from_fn(|axis| p[axis].midpoint(q[axis])));
            positions.len() as u32 - 1
        })
    };
    let cut = |&[a, b, c]: &[u32; 3]| {
        let [ab, bc, ca] = [midpoint(a, b), midpoint(b, c), midpoint(c, a)];
        [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
    };
    let triangles = shape.triangles.iter().flat_map(cut).collect();
    Shape { positions, triangles }
}

/// A trefoil knot: a closed tube of the radius `radius` around the curve (sin t + 2 sin 2t, cos t - 2 cos 2t, -sin 3t);
/// up to about 0.6 the tube does not meet itself.
#[must_use]
pub fn knot(columns: u32, rows: u32, radius: f64) -> Shape {
    Shape::lattice([columns, rows], [true, true], |i, j| {
        let t = TAU * i / f64::from(columns);
        let [(s1, c1), (s2, c2), (s3, c3)] = [t.sin_cos(), (2.0 * t).sin_cos(), (3.0 * t).sin_cos()];
        let center = [s1 + 2.0 * s2, c1 - 2.0 * c2, -s3];
        let velocity = [c1 + 4.0 * c2, -s1 + 4.0 * s2, -3.0 * c3];
        let acceleration = [-s1 - 8.0 * s2, -c1 + 8.0 * c2, 9.0 * s3];
        // The curve is never straight, so its Frenet frame closes: normal N and -B, the binormal turned round.
        let side = unit(cross(acceleration, velocity));
        let normal = cross(unit(velocity), side);
        let (sin, cos) = (TAU * j / f64::from(rows)).sin_cos();
        std::array::from_fn(|axis| center[axis] + radius * (cos * normal[axis] + sin * side[axis]))
    })
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(a: [f64; 3]) -> [f64; 3] {
    let length = a[0].hypot(a[1]).hypot(a[2]);
    a.map(|x| x / length)
}
