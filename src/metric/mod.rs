//! Lengths on a mesh, in units that make them about 1: everything after this needs only edge lengths.
//!
//! [`Metric`] holds triangles and their edge lengths, [`mollify`] makes every triangle proper, [`delaunay`] flips edges
//! until the triangulation is intrinsically Delaunay, on both sides of the surface where need be ([`glue`], [`tufted`]),
//! [`stats`] describes the edges of the input.

pub(crate) mod delaunay;
mod glue;
pub(crate) mod mollify;
pub(crate) mod stats;
mod tufted;

use crate::mesh::Mesh;

/// Triangles and the lengths of their edges, in units: no positions.
///
/// Half-edge 3f + k runs from corner k of triangle f to its next corner and is `lengths[f][k]` long. Corners name
/// vertices of the mesh; after edge flips a triangle may name one vertex twice, and two vertices may have several edges.
#[derive(Debug, Clone)]
pub(crate) struct Metric {
    /// Vertices of each triangle; the mesh's ignored triangles are left out.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// Lengths of its three half-edges.
    pub(crate) lengths: Vec<[f64; 3]>,
    /// How many triangles count in full. Those after them count half: they lie on one side of the surface only.
    pub(crate) single: usize,
}

impl Metric {
    /// The mesh as it lies in space.
    pub(crate) fn of(mesh: &Mesh, scale: Scale) -> Metric {
        let mut ignored = mesh.ignored_triangles().iter().peekable();
        let kept = (0..).zip(mesh.triangles()).filter(|(f, _)| ignored.next_if_eq(&f).is_none());
        let triangles: Vec<[u32; 3]> = kept.map(|(_, triangle)| *triangle).collect();
        let positions = scale.unit_positions(mesh);
        let length = |a: u32, b: u32| distance(positions[a as usize], positions[b as usize]);
        let lengths = triangles.iter().map(|&[a, b, c]| [length(a, b), length(b, c), length(c, a)]).collect();
        Metric { single: triangles.len(), triangles, lengths }
    }

    /// The vertices and edge lengths of each triangle, and how much it counts: 1, or ½ on one side of the surface.
    pub(crate) fn weighted(&self) -> impl Iterator<Item = ([u32; 3], [f64; 3], f64)> {
        let weights = std::iter::repeat_n(1.0, self.single).chain(std::iter::repeat(0.5));
        self.triangles.iter().zip(&self.lengths).zip(weights).map(|((&v, &l), weight)| (v, l, weight))
    }
}

/// The distance of two points in units.
pub(crate) fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    let between = minus(a, b);
    dot(between, between).sqrt()
}

/// a - b.
pub(crate) fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] - b[k])
}

/// a · b.
pub(crate) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// a × b.
pub(crate) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The area of a triangle with these edge lengths, by Kahan's arrangement of Heron's formula, which is accurate for
/// needles too: 4A = √((a + (b + c)) (c - (a - b)) (c + (a - b)) (a + (b - c))) with a ≥ b ≥ c.
///
/// NaN where the lengths break the triangle inequality.
///
/// W. Kahan: Miscalculating Area and Angles of a Needle-like Triangle. Lecture notes, 2014.
pub(crate) fn area(lengths: [f64; 3]) -> f64 {
    let [x, y, z] = lengths;
    let (a, c) = (x.max(y).max(z), x.min(y).min(z));
    let b = x.min(y).max(x.max(y).min(z));
    ((a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c))).sqrt() / 4.0
}

/// The cotangent of the angle opposite each edge, for a triangle of this area: (p² + q² - r²) / 4A for the angle between p
/// and q, opposite r.
pub(crate) fn cotangents(lengths: [f64; 3], area: f64) -> [f64; 3] {
    [0, 1, 2].map(|k| acuteness(lengths, k) / (4.0 * area))
}

/// p² + q² - r² for edge `k` of length r: 4 A cot θ for the angle θ opposite it, below 0 if θ is obtuse.
pub(crate) fn acuteness(lengths: [f64; 3], k: usize) -> f64 {
    let (r, p, q) = (lengths[k], lengths[(k + 1) % 3], lengths[(k + 2) % 3]);
    let (longer, shorter) = (p.max(q), p.min(q));
    // The difference of squares as a product: at a needle's tip it is the small difference of two large numbers.
    shorter * shorter + (longer - r) * (longer + r)
}

/// The power of two that brings a mesh to about unit size.
///
/// Multiplying by it is exact, so results do not depend on the mesh's units, and squares of lengths neither overflow nor
/// vanish: no absolute tolerance is needed anywhere.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Scale {
    /// One unit is 2^exponent mesh units.
    exponent: i32,
}

impl Scale {
    /// Brings the longest side of the bounding box over the referenced vertices into (1/2, 1]; a mesh without extent
    /// keeps its own units.
    pub(crate) fn of(mesh: &Mesh) -> Scale {
        let referenced = |&(v, _): &(u32, _)| !mesh.topology().corners.row(v).is_empty();
        Scale::over((0..).zip(mesh.positions()).filter(referenced).map(|(_, position)| position))
    }

    /// Brings the longest side of the bounding box of some positions into (1/2, 1], if it has one.
    pub(crate) fn over<'a>(positions: impl IntoIterator<Item = &'a [f64; 3]>) -> Scale {
        let mut low = [f64::INFINITY; 3];
        let mut high = [f64::NEG_INFINITY; 3];
        for position in positions {
            for k in 0..3 {
                low[k] = low[k].min(position[k]);
                high[k] = high[k].max(position[k]);
            }
        }
        // Halves, so that a box from -1e308 to 1e308 does not overflow.
        let half_extent = (0..3).map(|k| high[k] / 2.0 - low[k] / 2.0).fold(0.0, f64::max);
        Scale { exponent: if half_extent > 0.0 { exponent_above(half_extent) + 1 } else { 0 } }
    }

    /// A length or coordinate of the mesh in units.
    pub(crate) fn to_unit(self, length: f64) -> f64 {
        times_power_of_two(length, -self.exponent)
    }

    /// A position of the mesh in units.
    pub(crate) fn unit_position(self, position: [f64; 3]) -> [f64; 3] {
        // A coordinate that overflows is too far out for its neighbours to differ from it: all are clamped to the same.
        position.map(|x| self.to_unit(x).clamp(-f64::MAX, f64::MAX))
    }

    /// The position of each vertex in units.
    pub(crate) fn unit_positions(self, mesh: &Mesh) -> Vec<[f64; 3]> {
        mesh.positions().iter().map(|&position| self.unit_position(position)).collect()
    }

    /// A length in units as a length of the mesh.
    pub(crate) fn to_mesh(self, length: f64) -> f64 {
        times_power_of_two(length, self.exponent)
    }
}

/// The least e with x <= 2^e, for a positive finite x.
fn exponent_above(x: f64) -> i32 {
    let mut exponent = x.log2().ceil() as i32; // off by one at most, near powers of two
    while times_power_of_two(1.0, exponent) < x {
        exponent += 1;
    }
    while times_power_of_two(1.0, exponent - 1) >= x {
        exponent -= 1;
    }
    exponent
}

/// x * 2^exponent for |exponent| < 2044, in two steps so that the factor itself stays finite.
fn times_power_of_two(x: f64, exponent: i32) -> f64 {
    let half = exponent / 2;
    x * f64::powi(2.0, half) * f64::powi(2.0, exponent - half)
}
