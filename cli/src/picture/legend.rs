//! The colour bar: what the colours mean, at the right of the picture.

use super::canvas::Canvas;
use super::colour::{ColourMap, srgb};
use super::range::Range;
use super::surface::{INK, NEUTRAL};
use super::text;

const TICKS: f64 = 6.0;

pub(super) struct Legend<'a> {
    pub(super) title: &'a str,
    pub(super) unit: &'a str,
    pub(super) range: Range,
    pub(super) map: &'a ColourMap,
    /// What is drawn in the neutral colour, if anything is.
    pub(super) neutral: Option<&'a str>,
}

impl Legend<'_> {
    /// How wide it is where a text is `em` pixels high.
    pub(super) fn width(em: f32) -> f32 {
        8.0 * em
    }

    /// Draws it; the bar is half as high as the picture.
    pub(super) fn draw(&self, canvas: &mut Canvas, em: f32) {
        let left = (canvas.width as f32 - Legend::width(em)).round();
        let bar = [left, left + em.round()];
        let middle = 0.5 * canvas.height as f32;
        let half = 0.25 * canvas.height as f32;
        let [top, bottom] = [(middle - half + em).round(), (middle + half + em).round()];
        let [ink, grey] = [srgb(INK), srgb(0x6b_70_7a)];

        text::write(canvas, self.title, [left, top - 2.9 * em], 1.25 * em, ink);
        text::write(canvas, self.unit, [left, top - 1.6 * em], em, grey);
        self.bar(canvas, bar, [top, bottom]);
        let label = |canvas: &mut Canvas, value: f64, label: &str| {
            let y = bottom + (top - bottom) * self.range.place(value);
            let tick = |_: f32, at: f32| 1.0 - (at - y).abs().clamp(0.0, 1.0);
            let x = bar[1] + 0.25 * em;
            canvas.fill([x, y - 2.0, x + 0.4 * em, y + 2.0], |_| grey, tick);
            text::write(canvas, label, [bar[1] + em, y + 0.36 * em], em, ink);
        };
        let ticks = self.range.ticks(TICKS);
        for &tick in &ticks {
            label(canvas, tick, &self.range.label(tick, TICKS));
        }
        if ticks.is_empty() {
            label(canvas, self.range.low, &format!("{}", self.range.low));
        }
        if self.range.is_cut() {
            let most = Range { high: self.range.most, ..self.range }.label(self.range.most, 100.0);
            text::write(canvas, &format!("to {most}"), [bar[1] + em, top - 0.3 * em], em, grey);
        }
        if let Some(neutral) = self.neutral {
            let y = (bottom + 1.4 * em).round();
            let square = [bar[0], y, bar[1], y + em.round()];
            canvas.fill(square, |_| srgb(NEUTRAL), rounded(square, 0.2 * em));
            text::write(canvas, neutral, [bar[1] + em, y + 0.86 * em], em, ink);
        }
    }

    /// The map from bottom to top, with a pointed end where larger values share the last colour.
    fn bar(&self, canvas: &mut Canvas, [left, right]: [f32; 2], [top, bottom]: [f32; 2]) {
        let colour = |y: f32| self.map.at((bottom - y) / (bottom - top));
        canvas.fill([left, top, right, bottom], colour, rounded([left, top, right, bottom], 0.2 * (right - left)));
        if self.range.is_cut() {
            let half = 0.5 * (right - left);
            let tip = top - half;
            let cover = |x: f32, y: f32| half - (x - left - half).abs() - (tip + half - y).max(0.0) + 0.5;
            canvas.fill([left, tip, right, top + half], colour, cover);
        }
    }
}

/// How much of a pixel a rectangle with round corners covers.
fn rounded([left, top, right, bottom]: [f32; 4], radius: f32) -> impl Fn(f32, f32) -> f32 {
    move |x, y| {
        let dx = (left + radius - x).max(x - right + radius).max(0.0);
        let dy = (top + radius - y).max(y - bottom + radius).max(0.0);
        radius - dx.hypot(dy) + 0.5
    }
}
