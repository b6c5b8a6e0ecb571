//! Lengths on a mesh, in units that make them about 1.

use crate::mesh::Mesh;

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
        let mut low = [f64::INFINITY; 3];
        let mut high = [f64::NEG_INFINITY; 3];
        for (v, position) in (0..).zip(mesh.positions()) {
            if !mesh.topology().corners.row(v).is_empty() {
                for k in 0..3 {
                    low[k] = low[k].min(position[k]);
                    high[k] = high[k].max(position[k]);
                }
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
