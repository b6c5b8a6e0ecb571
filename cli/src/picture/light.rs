//! Light: a bright sky with a large lamp in it, and the shadows of both.
//!
//! The sky is many small lights evenly over a half-sphere, the lamp a cluster of them. Each has a shadow map: the nearest
//! depths as seen from it. A piece of surface gets Σ brightness · cos(angle) · visibility over the lights, so that corners
//! are dark and shadows soft. O(lights · (triangles + pieces)).

use super::body::Body;
use super::raster::{self, CENTRE, Window};
use super::surface::Piece;
use glam::Vec3;

const SKY: u32 = 32;
const LAMP: u32 = 16;
/// How much of all light is the lamp's.
const LAMP_SHARE: f32 = 0.45;
/// Sine of half the angle that the lamp fills.
const LAMP_SIZE: f32 = 0.3;

/// Pixels across a shadow map.
const SIZE: u32 = 256;
/// Half of what a shadow map spans; all of the surface is within √3 of the origin.
const REACH: f32 = 1.75;

struct Light {
    direction: Vec3,
    brightness: f32,
}

pub(super) struct Lights(Vec<Light>);

impl Lights {
    /// Around the direction `above`, with the lamp at `lamp`; both of length 1.
    pub(super) fn new(above: Vec3, lamp: Vec3) -> Lights {
        let sky = (0..SKY).map(|i| {
            let height = 1.0 - (i as f32 + 0.5) / SKY as f32;
            Light { direction: on_spiral(above, height, i), brightness: 0.55 + 0.45 * height }
        });
        let mut lights: Vec<Light> = sky.collect();
        scale(&mut lights, above, 1.0 - LAMP_SHARE);
        let around = |i: u32| {
            let sine = LAMP_SIZE * ((i as f32 + 0.5) / LAMP as f32).sqrt();
            Light { direction: on_spiral(lamp, (1.0 - sine * sine).sqrt(), i), brightness: 1.0 }
        };
        let mut lamp_lights: Vec<Light> = (0..LAMP).map(around).collect();
        scale(&mut lamp_lights, lamp, LAMP_SHARE);
        lights.extend(lamp_lights);
        Lights(lights)
    }

    /// What reaches a piece of this normal where nothing is in the way.
    pub(super) fn open(&self, normal: Vec3, samples: u8) -> f32 {
        let shining = self.0.iter().enumerate().filter(|(i, _)| sees(samples, *i));
        let sum: f32 = shining.map(|(_, light)| light.brightness * normal.dot(light.direction).max(0.0)).sum();
        sum * share(samples)
    }

    /// What reaches each piece. Of each eight lights one shines on each sample, so that a pixel sees them all.
    pub(super) fn reaching(&self, body: &Body, pieces: &[Piece]) -> Vec<f32> {
        let mut sums = vec![0.0; pieces.len()];
        let mut map = ShadowMap::new();
        for (i, light) in self.0.iter().enumerate() {
            map.draw(body, light.direction);
            for (sum, piece) in sums.iter_mut().zip(pieces).filter(|(_, piece)| sees(piece.samples, i)) {
                let cosine = piece.normal.dot(light.direction);
                if cosine > 0.0 {
                    *sum += light.brightness * cosine * map.visibility(piece, cosine);
                }
            }
        }
        sums.iter_mut().zip(pieces).for_each(|(sum, piece)| *sum *= share(piece.samples));
        sums
    }
}

/// Whether light `i` shines on one of the samples.
fn sees(samples: u8, i: usize) -> bool {
    samples >> (i % 8) & 1 == 1
}

/// What the light on some samples counts, so that it stands for all eight.
fn share(samples: u8) -> f32 {
    8.0 / samples.count_ones() as f32
}

/// Makes the lights give `share` to a surface across `towards`.
fn scale(lights: &mut [Light], towards: Vec3, share: f32) {
    let sum: f32 = lights.iter().map(|light| light.brightness * light.direction.dot(towards).max(0.0)).sum();
    lights.iter_mut().for_each(|light| light.brightness *= share / sum);
}

/// Number `i` of directions that wind around an axis by the golden angle, at a given height along it.
fn on_spiral(axis: Vec3, height: f32, i: u32) -> Vec3 {
    const GOLDEN_ANGLE: f32 = 2.399_963_2;
    let (side, other) = axis.any_orthonormal_pair();
    let (sine, cosine) = (i as f32 * GOLDEN_ANGLE).sin_cos();
    let radius = (1.0 - height * height).max(0.0).sqrt();
    radius * (cosine * side + sine * other) + height * axis
}

/// Nearness to a light, on a square across its direction.
struct ShadowMap {
    nearness: Vec<f32>,
    axes: [Vec3; 3],
}

impl ShadowMap {
    fn new() -> ShadowMap {
        ShadowMap { nearness: vec![0.0; (SIZE * SIZE) as usize], axes: [Vec3::ZERO; 3] }
    }

    fn project(&self, point: Vec3) -> Vec3 {
        let half = 0.5 * SIZE as f32;
        let scale = half / REACH;
        let [x, y, z] = self.axes.map(|axis| axis.dot(point));
        Vec3::new(half + scale * x, half + scale * y, z)
    }

    fn draw(&mut self, body: &Body, direction: Vec3) {
        let (x, y) = direction.any_orthonormal_pair();
        self.axes = [x, y, direction];
        self.nearness.fill(f32::NEG_INFINITY);
        let projected: Vec<Vec3> = body.positions.iter().map(|&p| self.project(p)).collect();
        let window = Window { width: SIZE, rows: [0, SIZE] };
        for t in &body.triangles {
            raster::scan(t.map(|v| projected[v as usize]), window, &CENTRE, |x, y, _, nearness| {
                let at = &mut self.nearness[(y * SIZE + x) as usize];
                *at = at.max(nearness);
            });
        }
    }

    /// How much of the light passes, by the four nearest pixels of the map.
    fn visibility(&self, piece: &Piece, cosine: f32) -> f32 {
        // Steps off the surface by about a pixel of the map, more where light grazes it: no surface shades itself.
        let texel = 2.0 * REACH / SIZE as f32;
        let p = self.project(piece.position + (1.2 * texel) * piece.normal);
        let needed = p.z + texel * (0.3 + 0.7 * (1.0 - cosine * cosine).sqrt());
        let [x, y] = [p.x - 0.5, p.y - 0.5];
        let limit = (SIZE - 2) as f32;
        if !(x >= 0.0 && y >= 0.0 && x < limit && y < limit) {
            return 1.0;
        }
        let [column, row] = [x as usize, y as usize]; // cut off the fraction
        let [fx, fy] = [x - column as f32, y - row as f32];
        let first = row * SIZE as usize + column;
        let open = |at: usize| if self.nearness[at] > needed { 0.0 } else { 1.0 };
        let upper = open(first) * (1.0 - fx) + open(first + 1) * fx;
        let lower = open(first + SIZE as usize) * (1.0 - fx) + open(first + SIZE as usize + 1) * fx;
        upper * (1.0 - fy) + lower * fy
    }
}
