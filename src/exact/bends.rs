//! Where shortest paths bend.
//!
//! A vertex is a *pseudo-source* where a shortest path can bend: its angles sum to more than 2π (π at a boundary), or
//! its triangles do not form one closed or one open fan, or one of them is a sliver: there rounding decides on which side
//! of the vertex a straight line passes, and neither side may be left out. A pseudo-source too many costs time only.
//!
//! At a fan a path that bends leaves at least π to either side of where it came, as far as there is surface, or it would
//! have a shortcut: into a *wedge* of directions that is as wide as the angles' sum is above 2π.
//!
//! O(V + F) time; 8 bytes per half-edge and 1 per vertex.

use super::charts::Chart;
use crate::mesh::Mesh;
use crate::mesh::fan::{Fan, fan};
use crate::mesh::topology::{NONE, prev};
use std::f64::consts::PI;
use std::ops::Range;

/// Where paths can bend at a vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Bend {
    /// Nowhere: it is no pseudo-source.
    Nowhere,
    /// Into the wedge of directions that straight lines over the vertex cannot reach.
    Wedge { is_closed: bool },
    /// In any direction.
    Anywhere,
}

/// A corner of a triangle at a vertex.
#[derive(Debug, Clone, Copy)]
struct Corner {
    /// The half-edge of the triangle that starts at the vertex.
    h: u32,
    angle: f32,
}

/// How paths bend at each vertex.
#[derive(Debug)]
pub(crate) struct Bends {
    bends: Vec<Bend>,
    /// The corners at each vertex, in the rows of the topology's: in order around the vertex where that is a fan.
    corners: Vec<Corner>,
}

/// Angles are summed to about this accuracy; a vertex that is flat up to it is not a pseudo-source.
const ANGLE_TOLERANCE: f64 = 1e-9;

/// A direction this close to the wedge of directions that a path can bend into counts as in it, in radians.
const WEDGE_PAD: f64 = 1e-3;

impl Bends {
    pub(crate) fn new(mesh: &Mesh, charts: &[Chart], sliver: &[bool]) -> Bends {
        let rows = &mesh.topology().corners;
        let mut corners = Vec::with_capacity(charts.len());
        let mut order = Vec::new();
        let bend = |v: u32| {
            let fan = fan(mesh, v, &mut order);
            let row = if fan == Fan::Other { rows.row(v) } else { &order };
            let mut sum = 0.0;
            corners.extend(row.iter().map(|&h| {
                let angle = charts[h as usize].ty.atan2(charts[h as usize].tx);
                sum += angle;
                Corner { h, angle: angle as f32 }
            }));
            let is_pointed = |flat: f64| sum <= flat + ANGLE_TOLERANCE;
            match fan {
                _ if row.iter().any(|&h| sliver[(h / 3) as usize]) => Bend::Anywhere,
                Fan::Other => Bend::Anywhere,
                Fan::Closed if is_pointed(2.0 * PI) => Bend::Nowhere,
                Fan::Open if is_pointed(PI) => Bend::Nowhere,
                Fan::Closed | Fan::Open => Bend::Wedge { is_closed: fan == Fan::Closed },
            }
        };
        let bends = (0..rows.rows()).map(bend).collect();
        Bends { bends, corners }
    }

    /// How paths bend at a vertex.
    pub(crate) fn at(&self, v: u32) -> Bend {
        self.bends[v as usize]
    }

    /// The corners of a fan, which are those in this range, with directions into which the path that came can bend. It
    /// came through the corner of half-edge `first`, turned by `came` from it.
    pub(crate) fn wedge(
        &self,
        charts: &[Chart],
        range: Range<usize>,
        is_closed: bool,
        first: u32,
        came: f64,
    ) -> impl Iterator<Item = u32> {
        let row = &self.corners[range];
        let place = row.iter().position(|corner| corner.h == first).unwrap_or(0); // it is one of them
        let (before, behind) = (&row[..place], &row[place + 1..]);
        let rest = f64::from(row[place].angle) - came;
        // The corner beyond the side of the first that is not its half-edge.
        let ahead = charts[prev(first) as usize].twin;
        let turned = |neighbour: Option<&Corner>| match neighbour {
            Some(corner) if ahead != NONE && (corner.h == ahead || prev(corner.h) == ahead) => rest,
            _ => came,
        };
        let least = PI - WEDGE_PAD;
        let (around, back, most) = match is_closed {
            true => (before, &before[..0], row.iter().map(|corner| f64::from(corner.angle)).sum::<f64>() - least),
            false => (&before[..0], before, f64::INFINITY),
        };
        let onward = bent(behind.iter().chain(around), turned(behind.first().or(around.first())), [least, most]);
        onward.chain(bent(back.iter().rev(), turned(back.last()), [least, most]))
    }
}

/// The corners that come to lie between two angles, if the first begins at the angle `turned`.
fn bent<'a>(
    corners: impl Iterator<Item = &'a Corner>,
    turned: f64,
    [least, most]: [f64; 2],
) -> impl Iterator<Item = u32> {
    let mut turned = turned;
    corners.filter_map(move |corner| {
        let from = turned;
        turned += f64::from(corner.angle);
        (turned >= least && from <= most).then_some(corner.h)
    })
}
