//! A segment of a curve, laid flat with its triangle.

use super::charts::Chart;
use crate::surface::curve::Segment;

/// A segment in the chart of one of its triangle's half-edges.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Flat {
    /// Where it begins.
    from: [f64; 2],
    /// From there to its other end.
    way: [f64; 2],
    length: f64,
}

impl Flat {
    /// As half-edge h sees it, whose chart this is. Nearby ends keep the digits of their difference.
    pub(crate) fn new(chart: &Chart, h: u32, segment: &Segment) -> Flat {
        let [from, to] = segment.ends;
        let [x, y] = chart.place(h, [0, 1, 2].map(|k| to[k] - from[k]));
        Flat { from: chart.place(h, from), way: [x, y], length: x.hypot(y) }
    }

    /// What share of the segment lies before the place of it that is nearest to (x, y).
    pub(crate) fn nearest(&self, [x, y]: [f64; 2]) -> f64 {
        let along = (x - self.from[0]) * self.way[0] / self.length + (y - self.from[1]) * self.way[1] / self.length;
        // Not so where the segment has no length.
        if along > 0.0 { (along / self.length).min(1.0) } else { 0.0 }
    }

    /// The place that has this share of the segment before it.
    pub(crate) fn place(&self, share: f64) -> [f64; 2] {
        [self.from[0] + share * self.way[0], self.from[1] + share * self.way[1]]
    }

    /// The unit vector from the edge to the segment, at right angles to it.
    pub(crate) fn normal(&self) -> [f64; 2] {
        let [x, y] = self.way.map(|x| x / self.length);
        if x < 0.0 { [y, -x] } else { [-y, x] }
    }

    /// How far the line through the segment is from the start of the edge.
    pub(crate) fn distance_at_start(&self) -> f64 {
        let [x, y] = self.normal();
        self.from[0] * x + self.from[1] * y
    }

    /// The stretch of the edge, `length` long, between the perpendiculars at the ends of the segment; None if it is empty.
    pub(crate) fn shadow(&self, length: f64) -> Option<[f64; 2]> {
        let [x, y] = self.way;
        let hit = |[px, py]: [f64; 2]| (px + py * y / x).clamp(0.0, length);
        let (from, to) = (hit(self.from), hit(self.place(1.0)));
        let [b0, b1] = if from < to { [from, to] } else { [to, from] };
        (x != 0.0 && b0 < b1).then_some([b0, b1])
    }
}
