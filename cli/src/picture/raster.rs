//! Which triangle is in front, at several places in each pixel.
//!
//! A sample belongs to a triangle when its three edge functions e(x, y) = a x + b y + c are not negative there. Corners are
//! rounded to 1/256 pixel first; then every product and sum is exact in double precision, so that no sample falls between
//! two triangles that share an edge. Nearness (larger is nearer) is affine on the screen: in perspective it is 1/depth.

use glam::Vec3;

/// Where samples lie in a pixel, and the range of their coordinates.
pub(super) struct Pattern {
    pub(super) places: &'static [[f64; 2]],
    pub(super) range: [f32; 2],
}

pub(super) const CENTRE: Pattern = Pattern { places: &[[0.5, 0.5]], range: [0.5, 0.5] };

/// No two in one row or column: edges of any direction have eight steps.
pub(super) const EIGHT: Pattern = Pattern {
    places: &[
        [1.0 / 16.0, 5.0 / 16.0],
        [3.0 / 16.0, 13.0 / 16.0],
        [5.0 / 16.0, 1.0 / 16.0],
        [7.0 / 16.0, 9.0 / 16.0],
        [9.0 / 16.0, 15.0 / 16.0],
        [11.0 / 16.0, 3.0 / 16.0],
        [13.0 / 16.0, 11.0 / 16.0],
        [15.0 / 16.0, 7.0 / 16.0],
    ],
    range: [1.0 / 16.0, 15.0 / 16.0],
};

/// Part of a screen: columns from 0, and rows from the first to before the last.
#[derive(Clone, Copy)]
pub(super) struct Window {
    pub(super) width: u32,
    pub(super) rows: [u32; 2],
}

/// a x + b y + c.
#[derive(Clone, Copy)]
pub(super) struct Affine {
    pub(super) a: f64,
    pub(super) b: f64,
    c: f64,
}

impl Affine {
    pub(super) fn at(self, [x, y]: [f64; 2]) -> f64 {
        self.a * x + self.b * y + self.c
    }
}

/// The last place of numbers of this size is 1/256: adding it and taking it away rounds to that.
const ROUNDER: f64 = 1.5 * (1u64 << 44) as f64;

/// The edge functions of a triangle on the screen, each 0 on the edge opposite a corner and positive inside; `None` where
/// it has no area.
pub(super) fn edges(corners: [Vec3; 3]) -> Option<[Affine; 3]> {
    let snapped = |coordinate: f32| (f64::from(coordinate) + ROUNDER) - ROUNDER;
    let [p, q, r] = corners.map(|corner| [snapped(corner.x), snapped(corner.y)]);
    let area = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    let edge = |[from, to]: [[f64; 2]; 2]| {
        let [a, b] = [area.signum() * (from[1] - to[1]), area.signum() * (to[0] - from[0])];
        Affine { a, b, c: -(a * from[0] + b * from[1]) }
    };
    (area != 0.0).then(|| [[q, r], [r, p], [p, q]].map(edge))
}

/// The affine function that is Σ values[i] · edges[i]; divided by the sum for all ones it interpolates `values`.
pub(super) fn combined(edges: &[Affine; 3], values: [f64; 3]) -> Affine {
    let sum = |part: fn(&Affine) -> f64| (0..3).map(|i| values[i] * part(&edges[i])).sum();
    Affine { a: sum(|e| e.a), b: sum(|e| e.b), c: sum(|e| e.c) }
}

/// Calls `plot(column, row, sample, nearness)` for each sample in the window that the triangle covers; a corner is
/// (x, y, nearness) with pixels as units.
pub(super) fn scan(corners: [Vec3; 3], window: Window, pattern: &Pattern, mut plot: impl FnMut(u32, u32, usize, f32)) {
    let columns = touched(corners.map(|p| p.x), pattern, [0, window.width]);
    let rows = touched(corners.map(|p| p.y), pattern, window.rows);
    if columns[0] > columns[1] || rows[0] > rows[1] {
        return;
    }
    let Some(edges) = edges(corners) else { return };
    // The edge functions add up to twice the area everywhere.
    let whole = edges.iter().map(|edge| edge.c).sum::<f64>();
    let nearness = combined(&edges, corners.map(|p| f64::from(p.z) / whole));
    for row in rows[0]..=rows[1] {
        for column in columns[0]..=columns[1] {
            for (sample, [x, y]) in pattern.places.iter().enumerate() {
                let place = [f64::from(column) + x, f64::from(row) + y];
                if edges.iter().all(|edge| edge.at(place) >= 0.0) {
                    plot(column as u32, row as u32, sample, nearness.at(place) as f32); // not negative: in the window
                }
            }
        }
    }
}

/// The first and last pixel with a sample between the least and the largest coordinate, within `limits`.
fn touched(c: [f32; 3], pattern: &Pattern, limits: [u32; 2]) -> [i32; 2] {
    const SNAP: f32 = 1.0 / 256.0;
    let low = c[0].min(c[1]).min(c[2]) - pattern.range[1] - SNAP;
    let high = c[0].max(c[1]).max(c[2]) - pattern.range[0] + SNAP;
    // Casts cut off the fraction and saturate. That of a negative `high` gives one pixel too many, which does no harm.
    let first = low as i32 + i32::from(low > (low as i32) as f32);
    [first.max(limits[0] as i32), (high as i32).min(limits[1] as i32 - 1)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// How often each sample of a screen of 40 × 40 pixels is covered by triangles of these corners.
    fn covers(points: &[[f32; 2]], triangles: &[[usize; 3]]) -> Vec<u32> {
        let mut counts = vec![0; 40 * 40 * 8];
        for t in triangles {
            let corners = t.map(|v| Vec3::new(points[v][0], points[v][1], 1.0));
            scan(corners, Window { width: 40, rows: [0, 40] }, &EIGHT, |x, y, sample, nearness| {
                assert!((nearness - 1.0).abs() < 1e-6);
                counts[((y * 40 + x) * 8) as usize + sample] += 1;
            });
        }
        counts
    }

    #[test]
    fn triangles_that_share_edges_leave_no_gap() {
        // A fan around an odd place fills the screen; the outer corners lie beyond it.
        let points: Vec<[f32; 2]> = (0..37)
            .map(|i| (i as f32 * 0.169_816).sin_cos())
            .map(|(s, c)| [20.3 + 90.0 * c, 19.7 + 90.0 * s])
            .collect();
        let points = [&[[17.123_457, 23.987_654]], &points[..]].concat();
        let fan: Vec<[usize; 3]> = (1..=37).map(|i| [0, i, i % 37 + 1]).collect();
        let counts = covers(&points, &fan);
        let twice = counts.iter().filter(|&&count| count > 1).count();
        assert!(counts.iter().all(|&count| count > 0) && twice < 40, "{twice}");
    }

    #[test]
    fn only_what_is_inside_is_covered() {
        let counts = covers(&[[10.0, 10.0], [30.0, 10.0], [30.0, 20.0], [10.0, 20.0]], &[[0, 1, 2], [2, 0, 3]]);
        let covered = counts.iter().filter(|&&count| count > 0).count();
        assert_eq!(covered, 20 * 10 * 8);
        // Degenerate, off the screen, and nowhere.
        for points in
            [[[5.0, 5.0], [9.0, 9.0], [7.0, 7.0]], [[-9.0, 5.0], [-3.0, 9.0], [-8.0, 1.0]], [[f32::NAN; 2]; 3]]
        {
            assert!(covers(&points, &[[0, 1, 2]]).iter().all(|&count| count == 0), "{points:?}");
        }
    }
}
