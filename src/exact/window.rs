//! Windows: the stretch of an edge that one bundle of straight rays crosses.
//!
//! A window on half-edge h covers [b0, b1] of it, measured from its start, and knows where its rays come from: the
//! pseudo-source unfolded into the chart of h, at (sx, -sy) with sy >= 0, behind the edge. The rays go on into the
//! triangle of h. Along the window the distance is
//!
//!   d(x) = σ + √((x - sx)² + sy²),
//!
//! σ being the distance of the pseudo-source itself. Keeping the pseudo-source's place rather than the distances of the
//! window's ends saves the digits that cancel in their differences.
//!
//! References: Mitchell, Mount, Papadimitriou, "The discrete geodesic problem", SIAM J. Comput. 16 (1987);
//! Surazhsky, Surazhsky, Kirsanov, Gortler, Hoppe, "Fast exact and approximate geodesics on meshes", ACM TOG 24 (2005).

use super::charts::Chart;

/// A stretch of an edge and where the rays through it come from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Window {
    pub(crate) b0: f64,
    pub(crate) b1: f64,
    pub(crate) sx: f64,
    pub(crate) sy: f64,
    pub(crate) sigma: f64,
}

/// A pseudo-source nearer to an edge than this share of its length lies on it.
const ON_EDGE: f64 = 1e-10;

/// Places that differ by this share of their distance are the same, up to the rounding of many crossings.
const SAME: f64 = 1e-13;

/// The least distance of an apex over a window, and the point of the edge that its path crosses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Entry {
    pub(crate) distance: f64,
    pub(crate) at: f64,
}

/// No path yet.
impl Default for Entry {
    fn default() -> Entry {
        Entry { distance: f64::INFINITY, at: 0.0 }
    }
}

impl Entry {
    /// The shorter of two paths.
    pub(crate) fn min(self, other: Entry) -> Entry {
        if other.distance < self.distance { other } else { self }
    }
}

impl Window {
    /// Distance at point x of the edge.
    pub(crate) fn distance(&self, x: f64) -> f64 {
        let dx = x - self.sx;
        self.sigma + (dx * dx + self.sy * self.sy).sqrt()
    }

    /// The same window measured from the other end of its edge.
    pub(crate) fn mirrored(&self, length: f64) -> Window {
        Window { b0: length - self.b1, b1: length - self.b0, sx: length - self.sx, ..*self }
    }

    /// Whether another window that begins no earlier has the same pseudo-source and no gap between: around a vertex where
    /// the surface is flat two parts of one bundle of rays go apart and come together again.
    pub(crate) fn continues_in(&self, next: &Window) -> bool {
        let near = SAME * (self.sx.abs() + self.sy + self.b1);
        let is_near = |a: f64, b: f64| (a - b).abs() <= near;
        self.sigma == next.sigma && next.b0 <= self.b1 + near && is_near(self.sx, next.sx) && is_near(self.sy, next.sy)
    }

    /// Whether the pseudo-source lies on the edge itself, where rounding decides which way it looks.
    pub(crate) fn starts_on_edge(&self, length: f64) -> bool {
        let near = ON_EDGE * length;
        self.sy <= near && -near <= self.sx && self.sx <= length + near
    }

    /// Where the straight line from the pseudo-source to the apex meets the line of the edge.
    pub(crate) fn aim(&self, chart: &Chart) -> f64 {
        (self.sy * chart.tx + self.sx * chart.ty) / (self.sy + chart.ty)
    }

    /// The shortest path to the apex that crosses the window. Where the straight ray misses the window the path bends
    /// at its nearer end: that is a real path all the same, and it closes the gaps that rounding leaves between windows.
    pub(crate) fn entry(&self, chart: &Chart) -> Entry {
        let aim = self.aim(chart);
        let at = aim.max(self.b0).min(self.b1);
        let beyond = if at == aim {
            let (dx, dy) = (chart.tx - self.sx, chart.ty + self.sy);
            self.sigma + (dx * dx + dy * dy).sqrt()
        } else {
            let dx = chart.tx - at;
            self.distance(at) + (dx * dx + chart.ty * chart.ty).sqrt()
        };
        Entry { distance: beyond, at }
    }

    /// The window that this one throws, through the part of it before `limit`, on the side from the chart's start to
    /// its apex; measured from the start. None where no ray arrives there.
    ///
    /// The ray through b meets the side at s = side·b·sy / (sy·tx - (b - sx)·ty). A ray through the apex ends at
    /// exactly `side`, so that the windows to its left and right meet there in the same bits.
    pub(crate) fn left_child(&self, turn: &Turn, limit: f64) -> Option<Window> {
        let Turn { tx, ty, side, ux, uy } = *turn;
        let cross = self.sy * tx + self.sx * ty;
        // Through b < aim, where the straight line to the apex is: b (sy + ty) < cross.
        let height = self.sy + ty;
        let last = self.b1.min(limit);
        if self.b0 >= last || self.b0 * height >= cross {
            return None;
        }
        let hit = |b: f64| if b * height >= cross { side } else { (side * b * self.sy / (cross - b * ty)).min(side) };
        let (b0, b1) = (hit(self.b0), hit(last));
        let sx = self.sx * ux - self.sy * uy;
        let sy = (self.sy * ux + self.sx * uy).max(0.0);
        (b0 < b1).then_some(Window { b0, b1, sx, sy, sigma: self.sigma })
    }
}

/// From a chart to its side between start and apex.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Turn {
    /// The apex.
    tx: f64,
    ty: f64,
    /// Length of the side, and its direction.
    side: f64,
    ux: f64,
    uy: f64,
}

impl Turn {
    /// `side` is its length.
    pub(crate) fn new(chart: &Chart, side: f64) -> Turn {
        Turn { tx: chart.tx, ty: chart.ty, side, ux: chart.tx / side, uy: chart.ty / side }
    }

    /// From the chart as it lies from its other end.
    pub(crate) fn mirrored(chart: &Chart, side: f64) -> Turn {
        Turn::new(&Chart { tx: chart.length - chart.tx, ..*chart }, side)
    }
}
