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
//! The rays that leave a segment of a curve are parallel: they come from infinitely far, in the direction (sx, -sy) of
//! length 1, and with σ the distance at the start of h
//!
//!   d(x) = σ - sx x.
//!
//! Both kinds are places (sx, -sy, w) of the projective plane, w being 1 and 0: where rays go is one formula for both.
//!
//! References: Mitchell, Mount, Papadimitriou, "The discrete geodesic problem", SIAM J. Comput. 16 (1987);
//! Surazhsky, Surazhsky, Kirsanov, Gortler, Hoppe, "Fast exact and approximate geodesics on meshes", ACM TOG 24 (2005);
//! Bommes, Kobbelt, "Accurate computation of geodesic distance fields for polygonal curves on triangle meshes", VMV 2007
//! (linear windows).

use super::charts::Chart;
use super::envelope::larger;
use crate::mesh::topology::NONE;
use std::fmt::Debug;

/// How the rays of a window run. A propagation without curves knows one kind only, and no code of the other is left in
/// it.
pub(crate) trait Rays: Copy + Default + Debug + PartialEq {
    /// Rays that come from a segment; None where there are no segments.
    const PARALLEL: Option<Self>;

    fn are_parallel(self) -> bool;

    /// The weight w of the place that they come from.
    fn weight(self) -> f64 {
        if self.are_parallel() { 0.0 } else { 1.0 }
    }
}

/// Rays of a propagation from points: all spread from a pseudo-source.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Spreading;

/// Rays of a propagation from curves.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) enum Mixed {
    #[default]
    Spreading,
    Parallel,
}

impl Rays for Spreading {
    const PARALLEL: Option<Spreading> = None;

    fn are_parallel(self) -> bool {
        false
    }
}

impl Rays for Mixed {
    const PARALLEL: Option<Mixed> = Some(Mixed::Parallel);

    fn are_parallel(self) -> bool {
        self == Mixed::Parallel
    }
}

/// A stretch of an edge and where the rays through it come from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Window<R> {
    pub(crate) b0: f64,
    pub(crate) b1: f64,
    pub(crate) sx: f64,
    pub(crate) sy: f64,
    pub(crate) sigma: f64,
    /// Of which throw of windows it is a part: what its rays come from.
    pub(crate) emission: u32,
    pub(crate) rays: R,
}

/// A pseudo-source nearer to an edge than this share of its length lies on it.
const ON_EDGE: f64 = 1e-13;

/// Places that differ by this share of their distance are the same, up to the rounding of many crossings.
const SAME: f64 = 1e-13;

/// The least distance of a point over a window, the place of the edge where its path crosses, and from where it comes
/// there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Entry<R> {
    pub(crate) distance: f64,
    pub(crate) at: f64,
    /// As in the window; of parallel rays where the one through `at` would have the distance 0.
    pub(crate) sx: f64,
    pub(crate) sy: f64,
    pub(crate) emission: u32,
    pub(crate) rays: R,
}

/// No path yet.
impl<R: Rays> Default for Entry<R> {
    fn default() -> Entry<R> {
        Entry { distance: f64::INFINITY, at: 0.0, sx: 0.0, sy: 0.0, emission: NONE, rays: R::default() }
    }
}

impl<R: Rays> Entry<R> {
    /// Where the path begins: at (sx, -sy), a pseudo-source or, with parallel rays, a place of a curve at this start
    /// distance.
    pub(crate) fn start(&self, start_distance: impl FnOnce() -> f64) -> [f64; 2] {
        let Entry { at, sx, sy, .. } = *self;
        if !self.rays.are_parallel() {
            return [sx, sy];
        }
        let distance = (sx - at).hypot(sy);
        let way = larger(0.0, distance - start_distance());
        let share = if way > 0.0 { way / distance } else { 0.0 };
        [at + share * (sx - at), share * sy]
    }
}

impl<R: Rays> Window<R> {
    /// Distance at point x of the edge.
    pub(crate) fn distance(&self, x: f64) -> f64 {
        if self.rays.are_parallel() {
            return self.sigma - self.sx * x;
        }
        let dx = x - self.sx;
        self.sigma + (dx * dx + self.sy * self.sy).sqrt()
    }

    /// The same among windows of both kinds.
    pub(crate) fn mixed(&self) -> Window<Mixed> {
        let Window { b0, b1, sx, sy, sigma, emission, rays } = *self;
        let rays = if rays.are_parallel() { Mixed::Parallel } else { Mixed::Spreading };
        Window { b0, b1, sx, sy, sigma, emission, rays }
    }

    /// How fast the distance grows along the edge, at point x of it.
    pub(crate) fn slope(&self, x: f64) -> f64 {
        if self.rays.are_parallel() {
            return -self.sx;
        }
        let dx = x - self.sx;
        dx / (dx * dx + self.sy * self.sy).sqrt()
    }

    /// The same window measured from the other end of its edge.
    pub(crate) fn mirrored(&self, length: f64) -> Window<R> {
        let sigma = if self.rays.are_parallel() { self.distance(length) } else { self.sigma };
        let sx = self.rays.weight() * length - self.sx;
        Window { b0: length - self.b1, b1: length - self.b0, sx, sigma, ..*self }
    }

    /// Whether another window that begins no earlier has the same pseudo-source and no gap between: around a vertex where
    /// the surface is flat two parts of one bundle of rays go apart and come together again.
    pub(crate) fn continues_in(&self, next: &Window<R>) -> bool {
        if self.rays.are_parallel() || next.rays.are_parallel() {
            return self.continues_parallel(next);
        }
        let near = SAME * (self.sx.abs() + self.sy + self.b1);
        let is_near = |a: f64, b: f64| (a - b).abs() <= near;
        // The place first: that most have another is easily predicted.
        is_near(self.sx, next.sx)
            && is_near(self.sy, next.sy)
            && self.emission == next.emission
            && next.b0 <= self.b1 + near
    }

    /// The same where rays are parallel: they come from one line, the same segment or one behind it.
    fn continues_parallel(&self, next: &Window<R>) -> bool {
        let is_near = |a: f64, b: f64, size: f64| (a - b).abs() <= SAME * size;
        self.rays == next.rays
            && self.emission == next.emission
            && next.b0 <= self.b1 * (1.0 + SAME)
            && is_near(self.sx, next.sx, 1.0)
            && is_near(self.sy, next.sy, 1.0)
            && is_near(self.distance(self.b1), next.distance(self.b1), self.b1)
    }

    /// Whether the pseudo-source lies on the edge itself, where rounding decides which way it looks.
    pub(crate) fn starts_on_edge(&self, length: f64) -> bool {
        if self.rays.are_parallel() {
            return false;
        }
        let near = ON_EDGE * length;
        self.sy <= near && -near <= self.sx && self.sx <= length + near
    }

    /// The shortest path to the apex that crosses the window, if it is shorter than `best`. Where the straight ray misses
    /// the window the path bends at its nearer end: that is a real path all the same, and it closes the gaps that
    /// rounding leaves between windows.
    pub(crate) fn entry(&self, chart: &Chart, best: Entry<R>) -> Entry<R> {
        let height = self.sy + self.rays.weight() * chart.ty;
        // The straight line to the apex meets the line of the edge at cross / height.
        let cross = self.sy * chart.tx + self.sx * chart.ty;
        let entry = |distance: f64, at: f64| {
            let Window { emission, rays, .. } = *self;
            let [sx, sy] = self.start_behind(at);
            let is_shorter = distance < best.distance;
            if is_shorter { Entry { distance, at, sx, sy, emission, rays } } else { best }
        };
        let is_left = cross < self.b0 * height;
        if is_left || cross > self.b1 * height {
            let at = if is_left { self.b0 } else { self.b1 };
            let (before, behind) = (at - self.sx, chart.tx - at);
            let behind = behind * behind + chart.ty * chart.ty;
            if self.rays.are_parallel() {
                return entry(self.distance(at) + behind.sqrt(), at);
            }
            let before = before * before + self.sy * self.sy;
            // Most windows are no better, which takes no root to see: √u + √v > r where r² < u + v or (r² - u - v)² < 4uv.
            let left = best.distance - self.sigma;
            let twice = left * left.abs() - before - behind;
            if twice < 0.0 || twice * twice < 4.0 * before * behind {
                return best;
            }
            entry(self.sigma + before.sqrt() + behind.sqrt(), at)
        } else if self.rays.are_parallel() {
            entry(self.distance(chart.tx) + self.sy * chart.ty, cross / height)
        } else {
            let dx = chart.tx - self.sx;
            entry(self.sigma + (dx * dx + height * height).sqrt(), cross / height)
        }
    }

    /// Where the ray through `at` comes from, as an entry tells it.
    fn start_behind(&self, at: f64) -> [f64; 2] {
        if self.rays.are_parallel() {
            let distance = larger(0.0, self.distance(at));
            [at + distance * self.sx, distance * self.sy]
        } else {
            [self.sx, self.sy]
        }
    }

    /// The window that this one throws on the side from the chart's start to its apex, measured from the start. None where
    /// no ray arrives there.
    ///
    /// The ray through b meets the side at the share b·sy / (b·sy + c - b·(sy + w·ty)) of it, with c = sy·tx + sx·ty: the
    /// twice-areas that the ray leaves to either side. A ray through the apex ends at exactly `side`, so that the windows
    /// to its left and right meet there in the same bits.
    pub(crate) fn left_child(&self, turn: &Turn) -> Option<Window<R>> {
        let cross = self.sy * turn.tx + self.sx * turn.ty;
        let height = self.sy + self.rays.weight() * turn.ty;
        if self.b0 >= self.b1 || self.b0 * height >= cross {
            return None;
        }
        let hit = |b: f64| {
            let (near, far) = (b * self.sy, cross - b * height);
            if far > 0.0 { turn.side * (near / (near + far)) } else { turn.side }
        };
        let (b0, b1) = (hit(self.b0), hit(self.b1));
        let [sx, sy] = turn.source(self.sx, self.sy);
        (b0 < b1).then_some(Window { b0, b1, sx, sy, ..*self })
    }

    /// The window that this one throws on the side from the chart's apex to its end, measured from the apex. `turn` is the
    /// mirrored one, of an edge of this length.
    pub(crate) fn right_child(&self, turn: &Turn, length: f64) -> Option<Window<R>> {
        let weight = self.rays.weight();
        let sx = weight * length - self.sx;
        let cross = self.sy * turn.tx + sx * turn.ty;
        let height = self.sy + weight * turn.ty;
        if self.b0 >= self.b1 || (length - self.b1) * height >= cross {
            return None;
        }
        let hit = |b: f64| {
            let b = length - b;
            let (near, far) = (b * self.sy, cross - b * height);
            if far > 0.0 { turn.side * (far / (near + far)) } else { 0.0 }
        };
        let (b0, b1) = (hit(self.b0), hit(self.b1));
        let sigma = match self.rays.are_parallel() {
            true => self.distance(length) - sx * turn.tx + self.sy * turn.ty, // at the apex
            false => self.sigma,
        };
        let [sx, sy] = turn.source(sx, self.sy);
        (b0 < b1).then_some(Window { b0, b1, sx: weight * turn.side - sx, sy, sigma, ..*self })
    }
}

/// From a chart to its side between start and apex, or mirrored to that between end and apex.
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
    /// `left` is the length of the side between start and apex.
    pub(crate) fn left(chart: &Chart, left: f64) -> Turn {
        Turn { tx: chart.tx, ty: chart.ty, side: left, ux: chart.tx / left, uy: chart.ty / left }
    }

    /// `right` is the chart of the half-edge from end to apex: its own tx keeps the digits that length - tx loses.
    pub(crate) fn right(chart: &Chart, right: &Chart) -> Turn {
        let (ux, uy) = (right.tx / chart.length, right.ty / chart.length);
        Turn { tx: ux * right.length, ty: chart.ty, side: right.length, ux, uy }
    }

    /// Where a place on the triangle's side of its edge lies along the side, and how far beyond it.
    pub(crate) fn ahead(&self, x: f64, y: f64) -> [f64; 2] {
        [x * self.ux + y * self.uy, y * self.ux - x * self.uy]
    }

    /// Where a source lies along the side, and how far behind it.
    fn source(&self, sx: f64, sy: f64) -> [f64; 2] {
        let behind = sy * self.ux + sx * self.uy;
        [sx * self.ux - sy * self.uy, if behind > 0.0 { behind } else { 0.0 }]
    }
}
