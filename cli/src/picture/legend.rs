//! What the colours mean, at the right of the picture: a bar of colours, or a title alone.

use super::canvas::Canvas;
use super::colour::{ColourMap, srgb};
use super::range::Range;
use super::surface::{INK, NEUTRAL};
use super::text;

const TICKS: f64 = 6.0;

pub(super) struct Legend<'a> {
    pub(super) title: &'a str,
    pub(super) unit: &'a str,
    /// `None` where the colours only tell neighbours apart.
    pub(super) scale: Option<(Range, &'a ColourMap)>,
    /// What is drawn in the neutral colour, if anything is.
    pub(super) neutral: Option<&'a str>,
}

/// How the legend is laid out, in pixels.
struct Layout {
    em: f32,
    left: f32,
    top: f32,
    bottom: f32,
}

const GREY: u32 = 0x6b_70_7a;

impl Legend<'_> {
    /// How wide it is where a text is `em` pixels high.
    pub(super) fn width(em: f32) -> f32 {
        8.0 * em
    }

    /// Draws it; the bar is half as high as the picture.
    pub(super) fn draw(&self, canvas: &mut Canvas, em: f32) {
        let left = (canvas.width as f32 - Legend::width(em)).round();
        let middle = 0.5 * canvas.height as f32;
        let half = 0.25 * canvas.height as f32;
        let layout = Layout { em, left, top: (middle - half + em).round(), bottom: (middle + half + em).round() };
        text::write(canvas, self.title, [left, layout.top - 2.9 * em], 1.25 * em, srgb(INK));
        text::write(canvas, self.unit, [left, layout.top - 1.6 * em], em, srgb(GREY));
        if let Some((range, map)) = self.scale {
            layout.bar(canvas, range, map);
            layout.ticks(canvas, range);
        }
        if let Some(neutral) = self.neutral {
            layout.neutral(canvas, neutral);
        }
    }
}

impl Layout {
    /// The sides of the bar.
    fn sides(&self) -> [f32; 2] {
        [self.left, self.left + self.em.round()]
    }

    /// The map from bottom to top, with a pointed end where larger values share the last colour.
    fn bar(&self, canvas: &mut Canvas, range: Range, map: &ColourMap) {
        let ([left, right], top, bottom) = (self.sides(), self.top, self.bottom);
        let colour = |y: f32| map.at((bottom - y) / (bottom - top));
        canvas.fill([left, top, right, bottom], colour, rounded([left, top, right, bottom], 0.2 * (right - left)));
        if range.is_cut() {
            let half = 0.5 * (right - left);
            let tip = top - half;
            let cover = |x: f32, y: f32| half - (x - left - half).abs() - (tip + half - y).max(0.0) + 0.5;
            canvas.fill([left, tip, right, top + half], colour, cover);
        }
    }

    /// Round values beside the bar.
    fn ticks(&self, canvas: &mut Canvas, range: Range) {
        let (&Layout { em, top, bottom, .. }, [_, right]) = (self, self.sides());
        let label = |canvas: &mut Canvas, value: f64, label: &str| {
            let y = bottom + (top - bottom) * range.place(value);
            let tick = |_: f32, at: f32| 1.0 - (at - y).abs().clamp(0.0, 1.0);
            let x = right + 0.25 * em;
            canvas.fill([x, y - 2.0, x + 0.4 * em, y + 2.0], |_| srgb(GREY), tick);
            text::write(canvas, label, [right + em, y + 0.36 * em], em, srgb(INK));
        };
        let ticks = range.ticks(TICKS);
        for &tick in &ticks {
            label(canvas, tick, &range.label(tick, TICKS));
        }
        if ticks.is_empty() {
            label(canvas, range.low, &format!("{}", range.low));
        }
        if range.is_cut() {
            let most = Range { high: range.most, ..range }.label(range.most, 100.0);
            text::write(canvas, &format!("to {most}"), [right + em, top - 0.3 * em], em, srgb(GREY));
        }
    }

    /// What the neutral colour means, below the bar.
    fn neutral(&self, canvas: &mut Canvas, text: &str) {
        let (&Layout { em, bottom, .. }, [left, right]) = (self, self.sides());
        let y = (bottom + 1.4 * em).round();
        let square = [left, y, right, y + em.round()];
        canvas.fill(square, |_| srgb(NEUTRAL), rounded(square, 0.2 * em));
        text::write(canvas, text, [right + em, y + 0.86 * em], em, srgb(INK));
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
