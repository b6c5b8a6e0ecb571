//! The direction to look from: the one asked for, or the best of some.
//!
//! Which way is up is a guess: across a flat surface; else away from a flat base, if there is one; else the y axis. Then
//! directions all around, a little above the horizon (well above it for flat things), are tried at low resolution; the
//! best shows much of the surface, much of the range of values, and of the marked points, sources and lines.

use super::body::Body;
use super::camera::{Camera, Frame};
use super::raster::{self, CENTRE, Window};
use crate::numbers;
use glam::{DVec3, Vec3};
use std::str::FromStr;

/// Where to look from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum View {
    Front,
    Back,
    Left,
    Right,
    Top,
    Bottom,
    From(Vec3),
}

impl FromStr for View {
    type Err = String;

    fn from_str(text: &str) -> Result<View, String> {
        Ok(match text {
            "front" => View::Front,
            "back" => View::Back,
            "left" => View::Left,
            "right" => View::Right,
            "top" => View::Top,
            "bottom" => View::Bottom,
            _ => return direction(text).map(View::From).ok_or_else(|| NO_VIEW.to_owned()),
        })
    }
}

const NO_VIEW: &str = "neither front, back, left, right, top or bottom nor a direction x,y,z other than 0,0,0";

/// The unit vector of "x,y,z".
fn direction(text: &str) -> Option<Vec3> {
    let from = DVec3::from(numbers::triple(text)?);
    let most = from.abs().max_element();
    (from.is_finite() && most > 0.0).then(|| (from / most).normalize().as_vec3())
}

/// The axes of the body, as a viewer in front of it names them.
pub(super) struct Axes {
    front: Vec3,
    right: Vec3,
    pub(super) up: Vec3,
    is_flat: bool,
    is_plane: bool,
}

impl Axes {
    pub(super) fn guess(body: &Body) -> Axes {
        let low = body.surface().iter().copied().fold(Vec3::INFINITY, Vec3::min);
        let high = body.surface().iter().copied().fold(Vec3::NEG_INFINITY, Vec3::max);
        let mut extents = [(high.x - low.x, Vec3::X), (high.y - low.y, Vec3::Y), (high.z - low.z, Vec3::Z)];
        extents.sort_by(|a, b| a.0.total_cmp(&b.0));
        let is_flat = extents[0].0 < 0.3 * extents[1].0;
        let up = if is_flat { extents[0].1 } else { away_from_base(body, low, high).unwrap_or(Vec3::Y) };
        let right = if up.x == 0.0 { Vec3::X } else { Vec3::Y };
        Axes { front: right.cross(up), right, up, is_flat, is_plane: extents[0].0 < 1e-3 * extents[1].0 }
    }

    /// From which direction, and what is up there.
    pub(super) fn named(&self, view: View) -> [Vec3; 2] {
        match view {
            View::Front => [self.front, self.up],
            View::Back => [-self.front, self.up],
            View::Left => [-self.right, self.up],
            View::Right => [self.right, self.up],
            View::Top => [self.up, -self.front],
            View::Bottom => [-self.up, self.front],
            View::From(from) if from.cross(self.up).length() < 1e-3 => [from, -self.front * from.dot(self.up).signum()],
            View::From(from) => [from, self.up],
        }
    }

    /// The best direction and what is up there. `values` are in [0, 1] or NaN.
    pub(super) fn best(&self, body: &Body, values: &[f32], marked: &[Vec3]) -> [Vec3; 2] {
        if self.is_plane {
            return self.named(View::Top);
        }
        let elevations: &[f32] = if self.is_flat { &[0.7, 1.0] } else { &[0.2, 0.5] };
        let candidates = elevations.iter().flat_map(|&elevation| {
            (0..AZIMUTHS).map(move |i| (elevation, i as f32 / AZIMUTHS as f32 * std::f32::consts::TAU))
        });
        let mut best = (f32::NEG_INFINITY, self.front);
        for (elevation, azimuth) in candidates {
            let level = azimuth.cos() * self.front + azimuth.sin() * self.right;
            let from = elevation.cos() * level + elevation.sin() * self.up;
            // Of equals the one nearer to the front.
            let score = Trial::new(body, from, self.up).score(values, marked) + 0.06 * azimuth.cos();
            if score > best.0 {
                best = (score, from);
            }
        }
        [best.1, self.up]
    }
}

/// A small picture, which tells how much there is to see from a direction.
struct Trial<'a> {
    body: &'a Body,
    camera: Camera,
    from: Vec3,
    /// Nearness and triangle of each pixel.
    front: Vec<(f32, usize)>,
}

impl Trial<'_> {
    fn new(body: &Body, from: Vec3, up: Vec3) -> Trial<'_> {
        let side = TRIAL as f32;
        let camera = Camera::new(body, from, up, Frame { left: 0.0, top: 0.0, width: side, height: side });
        let projected: Vec<Vec3> = body.positions.iter().map(|&p| camera.project(p)).collect();
        let mut front = vec![(0.0, NOTHING); (TRIAL * TRIAL) as usize];
        let window = Window { width: TRIAL, rows: [0, TRIAL] };
        for (f, t) in body.triangles[..body.balls_from].iter().enumerate() {
            raster::scan(t.map(|v| projected[v as usize]), window, &CENTRE, |x, y, _, nearness| {
                let at = &mut front[(y * TRIAL + x) as usize];
                if nearness > at.0 {
                    *at = (nearness, f);
                }
            });
        }
        Trial { body, camera, from, front }
    }

    fn score(&self, values: &[f32], marked: &[Vec3]) -> f32 {
        let seen = marked.iter().map(|&point| self.seen(point)).sum::<f32>() / marked.len().max(1) as f32;
        0.2 * self.area() + self.range(values) + seen
    }

    /// How much of the view the surface covers, where the largest extent of the mesh is 2.
    fn area(&self) -> f32 {
        let covered = self.front.iter().filter(|at| at.1 != NOTHING);
        covered.map(|&(nearness, _)| self.camera.pixel(nearness).powi(2)).sum()
    }

    /// How much of the values' range can be seen.
    fn range(&self, values: &[f32]) -> f32 {
        let mut bins = [0; BINS];
        for &(_, f) in self.front.iter().filter(|at| at.1 != NOTHING) {
            let value = values[self.body.triangles[f][0] as usize];
            if !value.is_nan() {
                bins[((value * BINS as f32) as usize).min(BINS - 1)] += 1;
            }
        }
        bins.iter().filter(|&&count| count > 2).count() as f32 / BINS as f32
    }

    /// Whether nothing is in front of a point; most where the surface around it faces the viewer.
    fn seen(&self, point: Vec3) -> f32 {
        let spot = self.camera.project(point);
        let [x, y] = [spot.x, spot.y].map(|at| (at as u32).min(TRIAL - 1)); // the cast saturates
        match self.front[(y * TRIAL + x) as usize] {
            (_, NOTHING) => 0.3,
            (nearness, _) if 1.0 / spot.z - 1.0 / nearness > 0.04 => 0.0,
            (_, f) => 0.3 + 0.7 * self.body.face_normal(f).dot(self.from).abs(),
        }
    }
}

const AZIMUTHS: u32 = 12;
/// Pixels across a trial picture.
const TRIAL: u32 = 96;
const NOTHING: usize = usize::MAX;
const BINS: usize = 24;

/// The direction away from a flat base: where more than a fiftieth of the area lies at one end of an axis, across it, and
/// not at the other end.
fn away_from_base(body: &Body, low: Vec3, high: Vec3) -> Option<Vec3> {
    let mut total = 0.0;
    // Area at the low and at the high end of each axis.
    let mut ends = [[0.0; 2]; 3];
    for f in 0..body.balls_from {
        let [a, b, c] = body.corners(f);
        let area = (b - a).cross(c - a).length();
        let normal = body.face_normal(f);
        total += area;
        for axis in (0..3).filter(|&axis| normal[axis].abs() > 0.97) {
            let middle = (a[axis] + b[axis] + c[axis]) / 3.0;
            let height = (middle - low[axis]) / (high[axis] - low[axis]);
            if height < 0.02 {
                ends[axis][0] += area;
            } else if height > 0.98 {
                ends[axis][1] += area;
            }
        }
    }
    let mut best = (0.02 * total, None);
    for (axis, [low, high]) in ends.into_iter().enumerate() {
        if (low - high).abs() > best.0 {
            best = ((low - high).abs(), Some(Vec3::AXES[axis] * (low - high).signum()));
        }
    }
    best.1
}
