//! From where the surface is seen.
//!
//! A perspective camera with a long lens. Its distance is the least from which every vertex is in the frame: with a the
//! tangent of half the angle of view, a point (x, y, z) is inside the left and right planes when x - a z ≤ c_x - a c_z and
//! -x - a z ≤ -c_x - a c_z, which is linear in the camera's place c; so are top and bottom.

use super::body::Body;
use glam::Vec3;

/// Tangent of half the angle of view, across the smaller side of the frame: about 26 degrees in all.
const HALF_VIEW: f32 = 0.23;

/// A rectangle of the picture, in pixels.
#[derive(Clone, Copy)]
pub(super) struct Frame {
    pub(super) left: f32,
    pub(super) top: f32,
    pub(super) width: f32,
    pub(super) height: f32,
}

pub(super) struct Camera {
    pub(super) eye: Vec3,
    pub(super) right: Vec3,
    pub(super) up: Vec3,
    pub(super) forward: Vec3,
    /// Pixels on the screen for each unit of length at distance 1.
    focal: f32,
    centre: [f32; 2],
}

impl Camera {
    /// Looks from the direction `from` (of length 1) with `up` upwards, and fits the surface into `frame`.
    pub(super) fn new(body: &Body, from: Vec3, up: Vec3, frame: Frame) -> Camera {
        let forward = -from;
        let right = forward.cross(up).normalize_or(forward.any_orthonormal_vector());
        let up = right.cross(forward);
        let side = frame.width.min(frame.height);
        let [across, down] = [frame.width / side * HALF_VIEW, frame.height / side * HALF_VIEW];
        let mut most = [f32::NEG_INFINITY; 4];
        for p in &body.positions {
            let [x, y, z] = [p.dot(right), p.dot(up), p.dot(forward)];
            let planes = [x - across * z, -x - across * z, y - down * z, -y - down * z];
            most = [0, 1, 2, 3].map(|i| most[i].max(planes[i]));
        }
        let depth = -((most[0] + most[1]) / (2.0 * across)).max((most[2] + most[3]) / (2.0 * down));
        // Something without extent is looked at from a small distance.
        let eye = 0.5 * (most[0] - most[1]) * right + 0.5 * (most[2] - most[3]) * up + (depth - 0.01) * forward;
        let centre = [frame.left + 0.5 * frame.width, frame.top + 0.5 * frame.height];
        Camera { eye, right, up, forward, focal: 0.5 * side / HALF_VIEW, centre }
    }

    /// Where a point is on the screen, in pixels, and its nearness 1/depth.
    pub(super) fn project(&self, point: Vec3) -> Vec3 {
        let way = point - self.eye;
        let nearness = 1.0 / way.dot(self.forward);
        let scale = self.focal * nearness;
        Vec3::new(self.centre[0] + scale * way.dot(self.right), self.centre[1] - scale * way.dot(self.up), nearness)
    }

    /// The way from the eye through a place on the screen, 1 long along `forward`.
    pub(super) fn ray(&self, [x, y]: [f32; 2]) -> Vec3 {
        let [x, y] = [(x - self.centre[0]) / self.focal, (self.centre[1] - y) / self.focal];
        self.forward + x * self.right + y * self.up
    }

    /// How long a pixel is at this nearness.
    pub(super) fn pixel(&self, nearness: f32) -> f32 {
        1.0 / (nearness * self.focal)
    }
}
