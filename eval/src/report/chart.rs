//! Panels with axes, as SVG: a plot is a list of marks in the units of its data.
//!
//! What cannot be placed, that is, what is not finite, or not positive on a logarithmic axis, is left out, and the panel
//! says how many points that are.

use super::colours::{GRID, INK, SOFT};
use super::numbers::{power_of_ten, significant};
use maud::{PreEscaped, html};
use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind, IntoDrawingArea};
use plotters::element::{Circle, DashedPathElement, EmptyElement, PathElement, Polygon, Rectangle, Text};
use plotters::prelude::{Cartesian2d, SVGBackend};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, IntoFont, RGBColor, ShapeStyle, TextStyle, WHITE};

/// The backend knows whole units only: this many make a pixel of the page.
const UNITS: i32 = 4;

/// Of text, in pixels of the page.
const LETTERS: f64 = 12.0;

/// Beyond this a number is not placed, so that differences stay finite.
const MOST: f64 = 1e100;

/// From one end to the other, with places that are named.
#[derive(Debug, Clone)]
pub(super) struct Axis {
    /// What stands below it.
    name: String,
    /// The ends, as logarithms on a logarithmic axis.
    ends: [f64; 2],
    is_logarithmic: bool,
    ticks: Vec<(f64, String)>,
}

impl Axis {
    /// Holds all values, with about so many ticks.
    pub(super) fn linear(name: &str, values: impl IntoIterator<Item = f64>, ticks: usize) -> Axis {
        let [low, high] = ends(values.into_iter(), 1.0);
        let step = round_step((high - low) / ticks.max(1) as f64);
        let [first, last] = [(low / step).ceil() as i64, (high / step).floor() as i64];
        let digits = (-step.log10().floor()).clamp(0.0, 12.0) as usize;
        let label = |value: f64| match value.abs() {
            size if size >= 1e6 || digits > 5 => significant(value),
            _ => super::numbers::fixed(value, digits),
        };
        let ticks = (first..=last).map(|i| i as f64 * step).map(|value| (value, label(value))).collect();
        Axis { name: name.to_owned(), ends: [low, high], is_logarithmic: false, ticks }
    }

    /// Holds all positive values, with about so many ticks.
    pub(super) fn logarithmic(name: &str, values: impl IntoIterator<Item = f64>, ticks: usize) -> Axis {
        let logarithms = values.into_iter().filter(|&value| value > 0.0).map(f64::log10);
        let [low, high] = ends(logarithms, 0.15);
        let step = ((high - low) / ticks.max(1) as f64).ceil().max(1.0) as i32;
        let steps: &[f64] = match (high - low) / ticks.max(1) as f64 {
            share if share < 0.35 => &[1.0, 2.0, 5.0],
            share if share < 0.55 => &[1.0, 3.0],
            _ => &[1.0],
        };
        let powers = (low.floor() as i32..=high.ceil() as i32).filter(|power| power.rem_euclid(step) == 0);
        let places = powers.flat_map(|power| steps.iter().map(move |&digit| (digit, power)));
        let ticks = places.map(|(digit, power)| (f64::from(power) + digit.log10(), logarithmic_label(digit, power)));
        let ticks = ticks.filter(|&(at, _)| (low..=high).contains(&at)).collect();
        Axis { name: name.to_owned(), ends: [low, high], is_logarithmic: true, ticks }
    }

    /// A row for each name, of at most 25 letters: row i is at -i, so that the first is at the top.
    pub(super) fn rows<'a>(names: impl Iterator<Item = &'a str>) -> Axis {
        let ticks: Vec<(f64, String)> =
            names.enumerate().map(|(row, name)| (-(row as f64), shortened(name, 25))).collect();
        let last = ticks.len().max(1) as f64 - 1.0;
        Axis { name: String::new(), ends: [-last - 0.5, 0.5], is_logarithmic: false, ticks }
    }

    /// The same without the names of the places, for what stands beside another panel.
    pub(super) fn unnamed(mut self) -> Axis {
        self.ticks.iter_mut().for_each(|(_, label)| label.clear());
        self
    }

    /// Where a value is; `None` where it has no place.
    fn place(&self, value: f64) -> Option<f64> {
        let place = if self.is_logarithmic { value.log10() } else { value };
        (place.is_finite() && place.abs() <= MOST).then_some(place)
    }

    /// The values at the ends.
    pub(super) fn range(&self) -> [f64; 2] {
        self.ends.map(|end| if self.is_logarithmic { 10f64.powf(end) } else { end })
    }
}

/// The least and the largest with some room around; `room` where there is one value only.
fn ends(values: impl Iterator<Item = f64>, room: f64) -> [f64; 2] {
    let placed = values.filter(|value| value.is_finite() && value.abs() <= MOST);
    let Some([low, high]) = placed.map(|value| [value; 2]).reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]) else {
        return [0.0, 1.0];
    };
    let share = 0.04 * (high - low);
    let margin = if share > 1e-9 * low.abs().max(high.abs()) { share } else { room * low.abs().max(1.0) };
    [low - margin, high + margin]
}

/// The nearest of 1, 2, 5 times a power of ten.
fn round_step(step: f64) -> f64 {
    let power = 10f64.powf(step.log10().floor());
    let digit = match step / power {
        share if share < 1.5 => 1.0,
        share if share < 3.5 => 2.0,
        share if share < 7.5 => 5.0,
        _ => 10.0,
    };
    digit * power
}

fn logarithmic_label(digit: f64, power: i32) -> String {
    match power {
        -3..=4 => format!("{:.*}", (-power).max(0) as usize, digit * 10f64.powi(power)),
        _ if digit == 1.0 => power_of_ten(power),
        _ => format!("{digit}·{}", power_of_ten(power)),
    }
}

/// Longer names end in dots.
pub(super) fn shortened(name: &str, letters: usize) -> String {
    match name.char_indices().nth(letters) {
        Some((end, _)) => format!("{}…", &name[..end]),
        None => name.to_owned(),
    }
}

/// What a point looks like.
#[derive(Debug, Clone, Copy)]
pub(super) enum Shape {
    Dot,
    Ring,
    Diamond,
    /// A short vertical line.
    Tick,
    /// Points to the left: there is more beyond the axis.
    Left,
}

/// Something in a panel, at places in the units of its data.
#[derive(Clone)]
pub(super) enum Mark {
    Line { points: Vec<[f64; 2]>, colour: RGBColor, width: f64 },
    Dashed { points: Vec<[f64; 2]>, colour: RGBColor },
    Point { at: [f64; 2], shape: Shape, colour: RGBColor },
    Label { at: [f64; 2], text: String, side: HPos, colour: RGBColor },
}

/// A frame with two axes and marks; pixels of the page, from the upper left corner of the picture.
#[derive(Clone)]
pub(super) struct Panel {
    pub(super) head: String,
    pub(super) left: i32,
    pub(super) top: i32,
    pub(super) width: i32,
    pub(super) height: i32,
    pub(super) x: Axis,
    pub(super) y: Axis,
    pub(super) marks: Vec<Mark>,
}

type Drawn = Result<(), DrawingAreaErrorKind<std::io::Error>>;
type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Plane<'a> = DrawingArea<SVGBackend<'a>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// A picture of panels. `title` is what is read out instead of it.
pub(super) fn svg(title: &str, [width, height]: [i32; 2], panels: &[Panel]) -> String {
    let [width, height] = [width, height].map(|pixels| pixels.max(1) * UNITS);
    let mut drawing = String::new();
    let drawn = {
        let area = SVGBackend::with_string(&mut drawing, (width as u32, height as u32)).into_drawing_area();
        panels.iter().try_for_each(|panel| panel.draw(&area)).and_then(|()| area.present())
    };
    // What the backend opens is replaced, to be read out and to be of the page's size.
    let inside =
        drawing.split_once('>').and_then(|(_, rest)| rest.rsplit_once("</svg>")).map_or("", |(inside, _)| inside);
    let inside = if drawn.is_ok() { inside } else { "" };
    html! {
        svg xmlns="http://www.w3.org/2000/svg" role="img" viewBox={ "0 0 " (width) " " (height) }
            width=(width / UNITS) height=(height / UNITS) {
            title { (title) }
            (PreEscaped(inside))
        }
    }
    .into_string()
}

impl Panel {
    fn draw(&self, area: &Area) -> Drawn {
        let [left, top, width, height] = [self.left, self.top, self.width, self.height].map(|pixels| pixels * UNITS);
        let pixels = (left..left + width, top + height..top);
        let x: RangedCoordf64 = (self.x.ends[0]..self.x.ends[1]).into();
        let y: RangedCoordf64 = (self.y.ends[0]..self.y.ends[1]).into();
        let plane = area.apply_coord_spec(Cartesian2d::new(x, y, pixels));
        self.draw_axes(&plane)?;
        let mut left_out = 0;
        for mark in &self.marks {
            left_out += self.draw_mark(&plane, mark)?;
        }
        let [[left, right], [below, above]] = [self.x.ends, self.y.ends];
        let up = if self.is_tall() { -30 } else { -10 };
        label(&plane, [left, above], [0, up], HPos::Left, &self.head, INK)?;
        if left_out > 0 {
            // Beside the head of a tall panel there is room; in a small one the head may be as wide as the panel.
            let (y, down) = if self.is_tall() { (above, up) } else { (below, -9) };
            label(&plane, [right, y], [-3, down], HPos::Right, &format!("{left_out} not shown"), SOFT)?;
        }
        Ok(())
    }

    /// Whether its lower end is out of sight from its upper one, so that both get names for the ticks.
    fn is_tall(&self) -> bool {
        self.height > 600
    }

    fn draw_axes(&self, plane: &Plane) -> Drawn {
        let [[left, right], [below, above]] = [self.x.ends, self.y.ends];
        let grid = ShapeStyle::from(GRID).stroke_width(UNITS as u32);
        for (at, name) in &self.x.ticks {
            plane.draw(&PathElement::new([(*at, below), (*at, above)], grid))?;
            label(plane, [*at, below], [0, 13], HPos::Center, name, SOFT)?;
            if self.is_tall() {
                label(plane, [*at, above], [0, -10], HPos::Center, name, SOFT)?;
            }
        }
        for (at, name) in &self.y.ticks {
            plane.draw(&PathElement::new([(left, *at), (right, *at)], grid))?;
            label(plane, [left, *at], [-7, 0], HPos::Right, name, INK)?;
        }
        label(plane, [left, below], [self.width / 2, 32], HPos::Center, &self.x.name, INK)
    }

    /// Draws what has a place; how many points have none.
    fn draw_mark(&self, plane: &Plane, mark: &Mark) -> Result<usize, DrawingAreaErrorKind<std::io::Error>> {
        let placed = |points: &[[f64; 2]]| -> Vec<(f64, f64)> {
            points.iter().filter_map(|&[x, y]| Some((self.x.place(x)?, self.y.place(y)?))).collect()
        };
        match mark {
            Mark::Line { points, colour, width } => {
                let line = placed(points);
                let left_out = points.len() - line.len();
                let style = ShapeStyle::from(colour).stroke_width((width * f64::from(UNITS)) as u32);
                plane.draw(&PathElement::new(line, style))?;
                Ok(left_out)
            }
            Mark::Dashed { points, colour } => {
                let line = placed(points);
                let left_out = points.len() - line.len();
                let style = ShapeStyle::from(colour).stroke_width(3 * UNITS as u32 / 2);
                if line.len() > 1 {
                    plane.draw(&DashedPathElement::new(line, 6 * UNITS, 4 * UNITS, style))?;
                }
                Ok(left_out)
            }
            Mark::Point { at, shape, colour } => match placed(&[*at])[..] {
                [place] => point(plane, place, *shape, *colour).map(|()| 0),
                _ => Ok(1),
            },
            Mark::Label { at, text, side, colour } => {
                let beside = match side {
                    HPos::Left => 7,
                    HPos::Center => 0,
                    HPos::Right => -7,
                };
                let places = placed(&[*at]);
                places
                    .iter()
                    .try_for_each(|&(x, y)| label(plane, [x, y], [beside, 0], *side, text, *colour))
                    .map(|()| 0)
            }
        }
    }
}

fn point(plane: &Plane, place: (f64, f64), shape: Shape, colour: RGBColor) -> Drawn {
    let polygon = |corners: &[(i32, i32)]| {
        let corners: Vec<(i32, i32)> = corners.iter().map(|&(x, y)| (x * UNITS, y * UNITS)).collect();
        plane.draw(&(EmptyElement::at(place) + Polygon::new(corners, colour.filled())))
    };
    match shape {
        Shape::Dot => plane.draw(&Circle::new(place, 4 * UNITS, colour.filled())),
        Shape::Ring => {
            plane.draw(&Circle::new(place, 4 * UNITS, WHITE.filled()))?;
            plane.draw(&Circle::new(place, 4 * UNITS, ShapeStyle::from(colour).stroke_width(3 * UNITS as u32 / 2)))
        }
        Shape::Diamond => polygon(&[(0, -6), (5, 0), (0, 6), (-5, 0)]),
        Shape::Tick => {
            let bar = Rectangle::new([(-UNITS, -5 * UNITS), (UNITS, 5 * UNITS)], colour.filled());
            plane.draw(&(EmptyElement::at(place) + bar))
        }
        Shape::Left => polygon(&[(0, 0), (8, -4), (8, 4)]),
    }
}

/// Text at a place and so many pixels from it.
fn label(plane: &Plane, [x, y]: [f64; 2], [right, down]: [i32; 2], side: HPos, text: &str, colour: RGBColor) -> Drawn {
    if text.is_empty() {
        return Ok(());
    }
    // The backend divides by 1.24.
    let size = LETTERS * f64::from(UNITS) * 1.24;
    let style = TextStyle::from(("sans-serif", size).into_font()).color(&colour).pos(Pos::new(side, VPos::Center));
    plane.draw(&(EmptyElement::at((x, y)) + Text::new(text.to_owned(), (right * UNITS, down * UNITS), style)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(axis: &Axis) -> Vec<&str> {
        axis.ticks.iter().map(|(_, name)| name.as_str()).collect()
    }

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(names(&Axis::linear("", [-58.0, 41.0], 5)), ["−60", "−40", "−20", "0", "20", "40"]);
        assert_eq!(names(&Axis::linear("", [0.5, 0.9], 4)), ["0.5", "0.6", "0.7", "0.8", "0.9"]);
        assert_eq!(names(&Axis::logarithmic("", [0.01, 100.0], 5)), ["0.01", "0.1", "1", "10", "100"]);
        assert_eq!(names(&Axis::logarithmic("", [0.6, 7.0], 4)), ["1", "2", "5"]);
        assert_eq!(names(&Axis::logarithmic("", [1e-9, 1e9], 4)), ["10⁻⁵", "1", "10⁵"]);
    }

    #[test]
    fn an_axis_of_nothing_or_of_one_value_has_room() {
        for values in [vec![], vec![f64::NAN], vec![3.0, 3.0], vec![0.0], vec![-1e300, f64::INFINITY], vec![1e99]] {
            for axis in [Axis::linear("", values.clone(), 5), Axis::logarithmic("", values, 5)] {
                assert!(axis.ends[0] < axis.ends[1], "{axis:?}");
                assert!(axis.ticks.len() <= 12, "{axis:?}");
            }
        }
        assert_eq!(Axis::logarithmic("", [0.0, -1.0], 3).place(0.0), None);
    }
}
