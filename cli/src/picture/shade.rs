//! Adds up the light of all pieces, and the shadow on the ground.

use super::body::Body;
use super::camera::Camera;
use super::canvas::Canvas;
use super::colour::srgb;
use super::light::Lights;
use super::surface::{Finish, Piece};
use glam::Vec3;

pub(super) const BACKGROUND: u32 = 0xf6_f7_f9;

/// How much of its light a shadow takes from the ground.
const GROUND_SHADOW: f32 = 0.55;
/// Where the ground ends: no shadow is seen farther from the middle.
const GROUND_REACH: f32 = 2.5;
/// Light that comes from everywhere, so that nothing is black.
const FILL: f32 = 0.2;
const EXPOSURE: f32 = 1.12;

/// The ground in those samples of each pixel that the surface leaves free; nothing where the viewer is below it.
pub(super) fn ground(
    body: &Body,
    camera: &Camera,
    up: Vec3,
    pieces: &[Piece],
    [width, height]: [u32; 2],
) -> Vec<Piece> {
    let level = body.surface().iter().map(|p| p.dot(up)).fold(f32::INFINITY, f32::min) - 0.004;
    if camera.eye.dot(up) - level < 0.05 {
        return Vec::new();
    }
    let mut free = vec![0xffu8; (width * height) as usize];
    for piece in pieces {
        free[piece.pixel as usize] &= !piece.samples;
    }
    let piece = |(pixel, &samples): (u32, &u8)| {
        let ray = camera.ray([(pixel % width) as f32 + 0.5, (pixel / width) as f32 + 0.5]);
        let fall = ray.dot(up);
        let position = camera.eye + (level - camera.eye.dot(up)) / fall * ray;
        let is_seen = samples != 0 && fall < 0.0 && position.length_squared() < GROUND_REACH * GROUND_REACH;
        is_seen.then(|| Piece {
            pixel,
            position,
            normal: up,
            samples,
            colour: srgb(BACKGROUND),
            finish: Finish::Ground,
        })
    };
    (0..).zip(&free).filter_map(piece).collect()
}

/// Adds the pieces to a canvas that shows the background.
pub(super) fn add(canvas: &mut Canvas, body: &Body, camera: &Camera, pieces: &[Piece]) {
    let above = (camera.up - camera.forward).normalize();
    let lamp = (0.9 * camera.up - 0.7 * camera.right - 0.9 * camera.forward).normalize();
    let lights = Lights::new(above, lamp);
    for (piece, light) in pieces.iter().zip(lights.reaching(body, pieces)) {
        let colour = match piece.finish {
            Finish::Ground => {
                let lost = 1.0 - light / lights.open(piece.normal, piece.samples);
                let near = 1.0 - piece.position.length_squared() / (GROUND_REACH * GROUND_REACH);
                piece.colour * (1.0 - GROUND_SHADOW * lost * near * near)
            }
            Finish::Surface { gloss } => {
                let to_eye = (camera.eye - piece.position).normalize_or_zero();
                let half = (lamp + to_eye).normalize_or_zero();
                let shine = gloss * light * piece.normal.dot(half).max(0.0).powi(40);
                EXPOSURE * (piece.colour * (FILL + (1.0 - FILL) * light) + shine)
            }
        };
        let share = piece.samples.count_ones() as f32 / 8.0;
        canvas.pixels[piece.pixel as usize] += share * (colour - srgb(BACKGROUND));
    }
}
