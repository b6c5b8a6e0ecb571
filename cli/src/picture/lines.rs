//! Lines that lie on the surface: of one width in pixels, anti-aliased, hidden where the surface is in front of them.

use super::camera::Camera;
use super::canvas::Canvas;
use super::colour::srgb;
use super::shade::BACKGROUND;
use super::surface::{INK, Piece};
use glam::{Vec2, Vec3};

/// What of the surface is in front in each pixel.
pub(super) struct Front {
    width: u32,
    /// Depth, infinite where nothing is, and how much it changes in a pixel.
    depths: Vec<[f32; 2]>,
}

impl Front {
    pub(super) fn new(pieces: &[Piece], camera: &Camera, [width, height]: [u32; 2]) -> Front {
        let mut depths = vec![[f32::INFINITY, 0.0]; (width * height) as usize];
        for piece in pieces {
            let way = piece.position - camera.eye;
            let depth = way.dot(camera.forward);
            let cosine = piece.normal.dot(-way.normalize_or_zero()).max(0.25);
            let at = &mut depths[piece.pixel as usize];
            if depth < at[0] {
                *at = [depth, camera.pixel(1.0 / depth) * (1.0 - cosine * cosine).max(0.0).sqrt() / cosine];
            }
        }
        Front { width, depths }
    }

    /// Draws dark lines with light borders, which show on any colour; the dark part is `line` pixels wide.
    pub(super) fn draw(&self, canvas: &mut Canvas, camera: &Camera, lines: &[Vec<Vec3>], line: f32) {
        for (colour, width) in [(BACKGROUND, 2.2 * line), (INK, line)] {
            let cover = self.cover(camera, lines, width);
            for (at, cover) in canvas.pixels.iter_mut().zip(cover) {
                *at = at.lerp(srgb(colour), cover);
            }
        }
    }

    /// How much of each pixel the lines cover; where several segments meet, they cover it only once.
    fn cover(&self, camera: &Camera, lines: &[Vec<Vec3>], line: f32) -> Vec<f32> {
        let mut cover = vec![0.0; self.depths.len()];
        for points in lines {
            let points: Vec<Vec3> = points.iter().map(|&point| camera.project(point)).collect();
            points.windows(2).for_each(|ends| self.segment([ends[0], ends[1]], 0.5 * line, &mut cover));
        }
        cover
    }

    /// The parts of a line that nothing hides, on the screen; looked at once a pixel. A line is closed where its last
    /// point is its first.
    pub(super) fn visible(&self, camera: &Camera, line: &[Vec3]) -> Vec<Vec<Vec2>> {
        let spots: Vec<Vec3> = line.iter().map(|&point| camera.project(point)).collect();
        let mut parts = Vec::new();
        let mut part: Vec<Vec2> = Vec::new();
        for ends in spots.windows(2) {
            let steps = ends[0].truncate().distance(ends[1].truncate()).ceil().clamp(1.0, 1e4) as u32; // not NaN: 1
            let at = |share: f32| ends[0].lerp(ends[1], share / steps as f32);
            let mut is_begun = false;
            for i in (0..steps).map(|i| i as f32) {
                if self.hides(at(i + 0.5)) {
                    parts.push(std::mem::take(&mut part));
                    is_begun = false;
                    continue;
                }
                if part.is_empty() {
                    part.push(at(i).truncate());
                }
                // Within a segment one straight line.
                if std::mem::replace(&mut is_begun, true) {
                    part.pop();
                }
                part.push(at(i + 1.0).truncate());
            }
        }
        parts.push(part);
        if parts.len() > 1 && line.first() == line.last() {
            // What is visible at both ends of a closed line is one part.
            let first = parts.swap_remove(0);
            parts[0].extend(first.into_iter().skip(1));
        }
        // At the rim of the surface a line may show through for a pixel.
        let length = |part: &[Vec2]| part.windows(2).map(|ends| ends[0].distance(ends[1])).sum::<f32>();
        parts.retain(|part| length(part) > 3.0);
        parts
    }

    /// Whether the surface is in front of a spot (x, y, nearness) in its pixel and all pixels around: at the rim, where
    /// depths are steep, its own pixel cannot tell.
    fn hides(&self, spot: Vec3) -> bool {
        let [x, y] = [spot.x, spot.y].map(|at| at as usize); // saturates
        let row = self.width as usize;
        let rows = y.saturating_sub(1)..=y.saturating_add(1);
        let columns = x.saturating_sub(1)..=x.saturating_add(1);
        let around = rows.flat_map(|y| columns.clone().map(move |x| [x, y]));
        let mut fronts = around.filter_map(|[x, y]| self.depths.get(y.checked_mul(row)?.checked_add(x)?));
        fronts.all(|front| is_behind(1.0 / spot.z, front, 0.5))
    }

    /// `ends` are on the screen: x, y, nearness.
    fn segment(&self, ends: [Vec3; 2], half: f32, cover: &mut [f32]) {
        if ends.iter().any(|end| !end.is_finite() || end.z <= 0.0) {
            return; // behind the viewer
        }
        let [from, to] = ends.map(Vec3::truncate);
        let height = self.depths.len() as f32 / self.width as f32;
        let limit = Vec2::new(self.width as f32, height) - 1.0;
        let low = (from.min(to) - half - 1.0).max(Vec2::ZERO);
        let high = (from.max(to) + half + 1.0).min(limit);
        // The casts cut off fractions; an empty range of floats is an empty range of pixels.
        for y in low.y as u32..(high.y + 1.0) as u32 {
            for x in low.x as u32..(high.x + 1.0) as u32 {
                let way = to - from;
                let off = Vec2::new(x as f32 + 0.5, y as f32 + 0.5) - from;
                let along = (off.dot(way) / way.length_squared().max(1e-12)).clamp(0.0, 1.0);
                let covered = (half + 0.5 - off.distance(along * way)).clamp(0.0, 1.0);
                let pixel = (y * self.width + x) as usize;
                let own = 1.0 / (ends[0].z + along * (ends[1].z - ends[0].z));
                if covered > cover[pixel] && !is_behind(own, &self.depths[pixel], half) {
                    cover[pixel] = covered;
                }
            }
        }
    }
}

/// Whether a depth is behind what is in front in a pixel, by more than a line of this half width on the surface can be.
fn is_behind(depth: f32, &[front, slope]: &[f32; 2], half: f32) -> bool {
    depth - front >= 0.004 + (2.0 + half) * slope
}
