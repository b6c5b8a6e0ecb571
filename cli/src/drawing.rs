//! Lines as files: polylines in space (OBJ), and a flat drawing (SVG).
//!
//! The drawing is a parallel projection along an axis of the mesh, without perspective; it has lines only, so what is
//! behind shows through. Linear in the number of points.

use crate::isolines::{Lines, Polyline};
use clap::ValueEnum;
use std::fmt::Write as _;

/// The axis along which a drawing looks at the mesh, from its positive end.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub(crate) enum Axis {
    /// From +x: y to the right, z up
    X,
    /// From +y: x to the right, z down
    Y,
    /// From +z: x to the right, y up
    Z,
}

/// OBJ: an object a level, a polyline a line; a closed one comes back to its first vertex.
pub(crate) fn obj(lines: &Lines) -> String {
    let mut text = String::from("# Isolines: one object a level, named by its value\n");
    let mut first = 1;
    // Here and below: writing to a string cannot fail.
    for (level, polylines) in lines.by_level() {
        let _ = writeln!(text, "o level_{level}");
        for Polyline { points, is_closed, .. } in polylines {
            for [x, y, z] in points {
                let _ = writeln!(text, "v {x} {y} {z}");
            }
            let end = first + points.len();
            let back = is_closed.then_some(first);
            let indices: Vec<String> = (first..end).chain(back).map(|index| index.to_string()).collect();
            let _ = writeln!(text, "l {}", indices.join(" "));
            first = end;
        }
    }
    text
}

/// SVG: a group a level, coloured from blue for the lowest to orange for the highest.
pub(crate) fn svg(lines: &Lines, view: Option<Axis>) -> String {
    const MARGIN: f64 = 10.0;
    let paper = Paper::of(lines, view);
    let [width, height] = paper.size().map(|side| side + 2.0 * MARGIN);
    let mut text = String::new();
    let _ = writeln!(
        text,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{0} {0} {width:.2} {height:.2}\" fill=\"none\" \
         stroke-width=\"1\" stroke-linejoin=\"round\">",
        -MARGIN
    );
    for (level, polylines) in lines.by_level() {
        let [red, green, blue] = colour(lines, level);
        let _ = writeln!(text, "<g stroke=\"rgb({red},{green},{blue})\"><title>{level}</title>");
        for Polyline { points, is_closed, .. } in polylines {
            let shape = if *is_closed { "polygon" } else { "polyline" };
            let points = points.iter().map(|&point| paper.place(point)).map(|[x, y]| format!("{x:.2},{y:.2}"));
            let _ = writeln!(text, "<{shape} points=\"{}\"/>", points.collect::<Vec<_>>().join(" "));
        }
        text.push_str("</g>\n");
    }
    text + "</svg>\n"
}

/// Between the colours of the lowest and the highest level.
fn colour(lines: &Lines, level: f64) -> [u8; 3] {
    let below = lines.levels.partition_point(|&other| other < level);
    let share = below as f64 / (lines.levels.len() - 1).max(1) as f64;
    let mix = |low: f64, high: f64| (low + share * (high - low)).round() as u8; // both are bytes
    [mix(40.0, 235.0), mix(60.0, 140.0), mix(140.0, 30.0)]
}

/// Where points in space lie on a drawing, whose longer side is 1000.
struct Paper {
    /// The coordinates that go to the right and down.
    axes: [usize; 2],
    /// Whether the second one goes up instead.
    is_upright: bool,
    /// Of the lines' bounding box; halves, so that a box from -1e308 to 1e308 does not overflow.
    half_low: [f64; 3],
    half_extent: [f64; 3],
}

impl Paper {
    /// Seen along `view`, or else along the shortest side of the lines' bounding box.
    fn of(lines: &Lines, view: Option<Axis>) -> Paper {
        let points = || lines.polylines.iter().flat_map(|line| &line.points);
        let half_low = [0, 1, 2].map(|k| points().map(|p| p[k] / 2.0).reduce(f64::min).unwrap_or(0.0));
        let half_high = [0, 1, 2].map(|k| points().map(|p| p[k] / 2.0).reduce(f64::max).unwrap_or(0.0));
        let half_extent = [0, 1, 2].map(|k| half_high[k] - half_low[k]);
        let [x, y, z] = half_extent;
        let shortest = match () {
            () if z <= x && z <= y => Axis::Z,
            () if y <= x => Axis::Y,
            () => Axis::X,
        };
        let (axes, is_upright) = match view.unwrap_or(shortest) {
            Axis::X => ([1, 2], true),
            Axis::Y => ([0, 2], false),
            Axis::Z => ([0, 1], true),
        };
        Paper { axes, is_upright, half_low, half_extent }
    }

    /// From a half length to the drawing.
    fn scaled(&self, half: f64) -> f64 {
        let longer = self.axes.map(|k| self.half_extent[k]).into_iter().fold(0.0, f64::max);
        if longer > 0.0 { 1000.0 * (half / longer) } else { 0.0 }
    }

    fn size(&self) -> [f64; 2] {
        self.axes.map(|k| self.scaled(self.half_extent[k]))
    }

    fn place(&self, point: [f64; 3]) -> [f64; 2] {
        let [x, y] = self.axes.map(|k| self.scaled(point[k] / 2.0 - self.half_low[k]));
        [x, if self.is_upright { self.size()[1] - y } else { y }]
    }
}
