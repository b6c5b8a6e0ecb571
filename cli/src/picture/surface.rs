//! What each pixel shows: pieces of triangles with their place, normal and colour.
//!
//! All samples of a pixel that one triangle covers are one piece; it is painted once, at their middle. The value there is
//! interpolated in perspective, v = N / D with N and D affine on the screen, so its gradient on the screen is known and an
//! isoline is |v - level| / |∇v| pixels away: lines have one width everywhere. They fade where they would crowd.

use super::body::Body;
use super::camera::Camera;
use super::colour::{ColourMap, srgb};
use super::raster::{self, Affine, EIGHT, Window};
use glam::Vec3;

pub(super) const INK: u32 = 0x1c_1f_2b;
/// Where there is no value.
pub(super) const NEUTRAL: u32 = 0xc4_c6_ca;
const BALL: u32 = 0x26_29_36;

/// Rows that are drawn at a time: memory for samples stays small.
const STRIP: u32 = 64;
const NOTHING: u32 = u32::MAX;

/// A part of a pixel.
pub(super) struct Piece {
    pub(super) pixel: u32,
    /// Which of the pixel's samples it covers.
    pub(super) samples: u8,
    pub(super) position: Vec3,
    /// Of length 1, towards the viewer.
    pub(super) normal: Vec3,
    pub(super) colour: Vec3,
    pub(super) finish: Finish,
}

pub(super) enum Finish {
    Surface { gloss: f32 },
    Ground,
}

/// What the surface is painted with.
pub(super) struct Paint<'a> {
    /// One for each vertex, in [0, 1] over the range of the map, or NaN.
    pub(super) values: &'a [f32],
    pub(super) map: &'a ColourMap,
    /// Where isolines are, ascending, as values.
    pub(super) levels: &'a [f32],
    /// Width of an isoline in pixels.
    pub(super) line: f32,
}

/// The pieces of all pixels, by rows.
pub(super) fn pieces(body: &Body, camera: &Camera, paint: &Paint, [width, height]: [u32; 2]) -> Vec<Piece> {
    let projected: Vec<Vec3> = body.positions.iter().map(|&p| camera.project(p)).collect();
    let painter = Painter { body, camera, paint, projected: &projected };
    let mut pieces = Vec::new();
    let mut samples = vec![[(0.0, NOTHING); 8]; (width * STRIP.min(height)) as usize];
    for first in (0..height).step_by(STRIP as usize) {
        let rows = [first, (first + STRIP).min(height)];
        samples.fill([(0.0, NOTHING); 8]);
        for (f, t) in (0..).zip(&body.triangles) {
            let corners = t.map(|v| projected[v as usize]);
            raster::scan(corners, Window { width, rows }, &EIGHT, |x, y, sample, nearness| {
                let at = &mut samples[((y - first) * width + x) as usize][sample];
                if nearness > at.0 {
                    *at = (nearness, f);
                }
            });
        }
        for (pixel, samples) in (first * width..rows[1] * width).zip(&samples) {
            painter.pixel(pixel, [pixel % width, pixel / width], &samples.map(|(_, f)| f), &mut pieces);
        }
    }
    pieces
}

struct Painter<'a> {
    body: &'a Body,
    camera: &'a Camera,
    paint: &'a Paint<'a>,
    projected: &'a [Vec3],
}

impl Painter<'_> {
    /// Adds a piece for each triangle that the pixel's samples see.
    fn pixel(&self, pixel: u32, [x, y]: [u32; 2], seen: &[u32; 8], pieces: &mut Vec<Piece>) {
        let mut left = (0..8).filter(|&s| seen[s] != NOTHING).fold(0u8, |left, s| left | 1 << s);
        while left != 0 {
            let f = seen[left.trailing_zeros() as usize];
            let own = (0..8).filter(|&s| seen[s] == f).fold(0u8, |own, s| own | 1 << s);
            left &= !own;
            let places = (0..8).filter(|s| own >> s & 1 == 1).map(|s| EIGHT.places[s]);
            let sum = places.fold([0.0; 2], |sum, place| [sum[0] + place[0], sum[1] + place[1]]);
            let count = f64::from(own.count_ones());
            let at = [f64::from(x) + sum[0] / count, f64::from(y) + sum[1] / count];
            pieces.extend(self.piece(pixel, at, f as usize, own));
        }
    }

    /// What triangle `f` shows at a place on the screen.
    fn piece(&self, pixel: u32, at: [f64; 2], f: usize, samples: u8) -> Option<Piece> {
        let corners = self.body.triangles[f].map(|v| self.projected[v as usize]);
        let nearness = corners.map(|corner| f64::from(corner.z));
        let edges = raster::edges(corners)?;
        let below = raster::combined(&edges, nearness).at(at);
        let weights = [0, 1, 2].map(|i| (nearness[i] * edges[i].at(at) / below) as f32);
        let mix = |of: [Vec3; 3]| weights[0] * of[0] + weights[1] * of[1] + weights[2] * of[2];

        let position = mix(self.body.corners(f));
        // Corner normals lean to the side of the face; the viewer sees the other side where the face turns away.
        let side = if self.body.face_normal(f).dot(self.camera.eye - position) < 0.0 { -1.0 } else { 1.0 };
        let normal = side * mix(self.body.normals[f]).normalize_or_zero();
        let (colour, gloss) = match f < self.body.balls_from {
            true => (self.colour(f, &edges, at), 0.05),
            false => (srgb(BALL), 0.6),
        };
        Some(Piece { pixel, samples, position, normal, colour, finish: Finish::Surface { gloss } })
    }

    /// The colour of triangle `f` at a place on the screen.
    fn colour(&self, f: usize, edges: &[Affine; 3], at: [f64; 2]) -> Vec3 {
        let t = self.body.triangles[f];
        let nearness = t.map(|v| f64::from(self.projected[v as usize].z));
        let above = [0, 1, 2].map(|i| nearness[i] * f64::from(self.paint.values[t[i] as usize]));
        let [above, below] = [above, nearness].map(|of| raster::combined(edges, of));
        let [n, d] = [above.at(at), below.at(at)];
        let [x, y] = [above.a * d - n * below.a, above.b * d - n * below.b];
        self.paint.colour((n / d) as f32, ((x * x + y * y).sqrt() / (d * d)) as f32)
    }
}

impl Paint<'_> {
    /// The colour of a value where it changes by `slope` a pixel.
    fn colour(&self, value: f32, slope: f32) -> Vec3 {
        if value.is_nan() {
            return srgb(NEUTRAL);
        }
        let colour = self.map.at(value);
        let levels = self.levels;
        let next = levels.partition_point(|&level| level < value);
        let near = &levels[next.saturating_sub(1)..(next + 1).min(levels.len())];
        let off = near.iter().map(|level| (level - value).abs()).fold(f32::INFINITY, f32::min) / slope;
        let apart = if let [low, high] = near { (high - low) / slope } else { f32::INFINITY };
        let cover = (0.5 * self.line + 0.5 - off).clamp(0.0, 1.0);
        let fade = ((apart - 2.0 * self.line) / (4.0 * self.line)).clamp(0.0, 1.0);
        if cover > 0.0 { colour.lerp(0.16 * colour, cover * fade) } else { colour }
    }
}
