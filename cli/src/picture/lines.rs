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
                let [depth, slope] = self.depths[pixel];
                let own = 1.0 / (ends[0].z + along * (ends[1].z - ends[0].z));
                if covered > cover[pixel] && own - depth < 0.004 + (2.0 + half) * slope {
                    cover[pixel] = covered;
                }
            }
        }
    }
}
