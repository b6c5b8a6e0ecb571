//! Pictures of a surface coloured by a value at each vertex, drawn in software: a PNG file, the same bytes every time.
//!
//! [`body`] brings the mesh to unit size, [`view`] and [`camera`] look at it, [`raster`] finds what is in front in each
//! eighth of a pixel, [`surface`] paints it, [`light`] lights it, [`shade`] adds it up, [`lines`] draws on it, [`legend`]
//! says what the colours mean. Time O(lights · (triangles + pixels)), memory O(triangles + pixels).

mod body;
mod camera;
mod canvas;
mod colour;
mod legend;
mod light;
mod lines;
mod range;
mod raster;
mod shade;
mod surface;
mod text;
mod view;

use crate::output::Output;
use crate::{Cli, Result};
use body::Body;
use camera::{Camera, Frame};
use canvas::Canvas;
use clap::error::ErrorKind;
use clap::{Args, CommandFactory as _};
pub(crate) use colour::Encoder;
use colour::{ColourMap, srgb};
use glam::Vec3;
use legend::Legend;
use lines::Front;
use range::Range;
use std::path::PathBuf;
use surface::Paint;
use taut::Mesh;
use view::Axes;
pub(crate) use view::View;

const HEADING: &str = "Options of the picture";

/// Options of the commands that draw.
#[derive(Debug, Args)]
pub(crate) struct PictureArgs {
    /// Draw the surface and its values to this PNG file
    #[arg(help_heading = HEADING, long, value_name = "FILE")]
    pub(crate) picture: Option<PathBuf>,

    /// Look from the front, back, left, right, top or bottom, or from the direction x,y,z;
    /// by default from where most is seen
    #[arg(verbatim_doc_comment, help_heading = HEADING, long, allow_hyphen_values = true)]
    view: Option<View>,

    /// Width and height in pixels [default: 1200x900]
    #[arg(help_heading = HEADING, long, value_name = "WxH", value_parser = size)]
    size: Option<[u32; 2]>,
}

fn size(text: &str) -> std::result::Result<[u32; 2], String> {
    let range = 64..=4096;
    let side = |text: &str| text.parse().ok().filter(|side| range.contains(side));
    let sides = text.split_once('x').and_then(|(width, height)| Some([side(width)?, side(height)?]));
    sides.ok_or_else(|| format!("not WIDTHxHEIGHT, each from {} to {}", range.start(), range.end()))
}

/// What the values are: it decides the colours, the title and, by itself, whether there are isolines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Quantity {
    Distance,
    /// Anything.
    Value,
    /// In percent; what is beyond `top` shares its colour.
    Error {
        /// By default the largest, unless a few are far above the rest.
        top: Option<f64>,
    },
    /// Which of the [`CELL_COLOURS`] a cell has.
    Cell,
}

/// How many colours cells have.
pub(crate) const CELL_COLOURS: usize = CELLS.len();
const CELLS: [u32; 8] =
    [0x8f_b8_de, 0xf4_b1_83, 0xa8_d0_8d, 0xe7_9a_a8, 0xc3_a6_dc, 0xf2_d4_79, 0x7f_ca_c3, 0xc9_b2_9b];

/// What is drawn.
pub(crate) struct Picture<'a> {
    pub(crate) mesh: &'a Mesh,
    pub(crate) quantity: Quantity,
    /// One for each vertex; grey where it is not finite.
    pub(crate) values: &'a [f64],
    /// Marked by a small ball, where they are on the surface.
    pub(crate) sources: &'a [[f64; 3]],
    /// The values of isolines; `None` for round ones where the values are distances, and none where they are errors or cells.
    pub(crate) levels: Option<&'a [f64]>,
    /// Lines on the surface, in mesh units.
    pub(crate) lines: &'a [Vec<[f64; 3]>],
}

impl PictureArgs {
    /// The file of the picture, if one was asked for.
    pub(crate) fn draw(&self, picture: &Picture) -> Result<Option<Output<'_>>> {
        let Some(path) = &self.picture else { return Ok(None) };
        let bytes = picture.png(self.view, self.size()).map_err(|error| format!("{}: {error}", path.display()))?;
        Ok(Some((path, bytes)))
    }

    /// Refuses options that mean nothing where no picture is asked for.
    pub(crate) fn check(&self) -> std::result::Result<(), clap::Error> {
        self.refuse("belongs to a picture and means nothing without --picture")
    }

    /// The same beside a drawing of lines, which obeys these options too.
    pub(crate) fn check_beside(&self, is_drawn: bool) -> std::result::Result<(), clap::Error> {
        if is_drawn { Ok(()) } else { self.refuse("belongs to a drawing or picture, and none is asked for") }
    }

    fn refuse(&self, reason: &str) -> std::result::Result<(), clap::Error> {
        let given = [("--view", self.view.is_some()), ("--size", self.size.is_some())];
        match given.into_iter().find(|&(_, is_given)| is_given && self.picture.is_none()) {
            None => Ok(()),
            Some((option, _)) => Err(Cli::command().error(ErrorKind::ArgumentConflict, format!("{option} {reason}"))),
        }
    }

    pub(crate) fn size(&self) -> [u32; 2] {
        self.size.unwrap_or([1200, 900])
    }
}

/// What can be seen of lines on a surface, for drawings of lines alone; the view is that of the picture.
pub(crate) struct Sight {
    body: Body,
    camera: Camera,
    front: Front,
}

impl Sight {
    /// None where there is no surface.
    pub(crate) fn new(picture: &Picture, args: &PictureArgs) -> Option<Sight> {
        let size = args.size();
        let range = picture.quantity.range(picture.values);
        let values: Vec<f32> = picture.values.iter().map(|&value| range.place(value)).collect();
        let body = Body::new(picture.mesh, &[])?;
        let (camera, _) = picture.camera(&body, &values, args.view, size, 0.0);
        let paint = Paint { values: &values, map: &picture.quantity.map(), levels: &[], line: 1.0 };
        let front = Front::new(&surface::pieces(&body, &camera, &paint, size), &camera, size);
        Some(Sight { body, camera, front })
    }

    /// The visible parts of a line on the surface, in pixels from the top left.
    pub(crate) fn visible(&self, line: impl Iterator<Item = [f64; 3]>) -> Vec<Vec<[f32; 2]>> {
        let line: Vec<Vec3> = line.map(|point| self.body.place(point)).collect();
        let parts = self.front.visible(&self.camera, &line);
        parts.into_iter().map(|part| part.into_iter().map(|spot| spot.to_array()).collect()).collect()
    }
}

impl Quantity {
    pub(crate) fn map(self) -> ColourMap {
        match self {
            Quantity::Distance | Quantity::Value => {
                ColourMap::through(&[0xff_f1_d6, 0xff_c8_8a, 0xf8_8a_68, 0xd3_55_80, 0x8a_3f_9b, 0x3b_32_80])
            }
            Quantity::Error { .. } => {
                ColourMap::through(&[0xf4_f4_f0, 0xf7_d8_a8, 0xf0_9a_5e, 0xd6_4a_3f, 0x8e_17_36, 0x4a_0c_2c])
            }
            Quantity::Cell => ColourMap::steps(&CELLS),
        }
    }

    /// Where the map begins and ends.
    fn range(self, values: &[f64]) -> Range {
        match self {
            Quantity::Distance | Quantity::Value => Range::new(values),
            Quantity::Error { top } => Range::of_errors(values, top),
            Quantity::Cell => {
                let last = CELL_COLOURS as f64 - 1.0;
                Range { low: 0.0, high: last, most: last }
            }
        }
    }

    fn words(self) -> [&'static str; 2] {
        match self {
            Quantity::Distance => ["Distance", "mesh units"],
            Quantity::Value => ["Value", ""],
            Quantity::Error { .. } => ["Error", "%"],
            Quantity::Cell => ["Nearest", "source"],
        }
    }
}

/// Letters of fewer pixels cannot be read.
const LEAST_EM: f32 = 11.0;

impl Picture<'_> {
    /// The file of the picture, seen from `view` or else from where most is seen.
    pub(crate) fn png(&self, view: Option<View>, size: [u32; 2]) -> Result<Vec<u8>> {
        self.draw(view, size).png().map_err(|error| error.to_string())
    }

    /// From where most is seen, for other pictures of the same surface; `None` where there is no surface.
    pub(crate) fn best_view(&self) -> Option<View> {
        let body = Body::new(self.mesh, self.sources)?;
        let range = self.quantity.range(self.values);
        let values: Vec<f32> = self.values.iter().map(|&value| range.place(value)).collect();
        let [from, _] = Axes::guess(&body).best(&body, &values, &self.marked(&body));
        Some(View::From(from))
    }

    /// Sources and lines.
    fn marked(&self, body: &Body) -> Vec<Vec3> {
        self.sources.iter().chain(self.lines.iter().flatten()).map(|&point| body.place(point)).collect()
    }

    fn draw(&self, view: Option<View>, [width, height]: [u32; 2]) -> Canvas {
        let em = (0.022 * width.min(height) as f32).max(LEAST_EM);
        let range = self.quantity.range(self.values);
        let map = self.quantity.map();
        let mut canvas = Canvas::new(width, height, srgb(shade::BACKGROUND));
        if let Some(body) = Body::new(self.mesh, self.sources) {
            self.draw_body(&mut canvas, &body, view, range, &map, Legend::width(em));
        }
        let [title, unit] = self.quantity.words();
        let mut drawn = self.mesh.triangles().iter().flatten();
        let neutral = drawn.any(|&v| !self.values[v as usize].is_finite()).then_some("unreachable");
        let scale = (self.quantity != Quantity::Cell).then_some((range, &map));
        Legend { title, unit, scale, neutral }.draw(&mut canvas, em);
        canvas
    }

    /// Draws the surface beside the legend.
    fn draw_body(
        &self,
        canvas: &mut Canvas,
        body: &Body,
        view: Option<View>,
        range: Range,
        map: &ColourMap,
        legend: f32,
    ) {
        let size = [canvas.width, canvas.height];
        let side = canvas.width.min(canvas.height) as f32;
        let values: Vec<f32> = self.values.iter().map(|&value| range.place(value)).collect();
        let (camera, axes) = self.camera(body, &values, view, size, legend);

        let levels = self.levels(range);
        let paint = Paint { values: &values, map, levels: &levels, line: (side / 750.0).max(1.0) };
        let mut pieces = surface::pieces(body, &camera, &paint, size);
        let ground = shade::ground(body, &camera, axes.up, &pieces, size);
        pieces.extend(ground);
        shade::add(canvas, body, &camera, &pieces);
        if !self.lines.is_empty() {
            let place = |line: &Vec<[f64; 3]>| line.iter().map(|&point| body.place(point)).collect();
            let lines: Vec<Vec<Vec3>> = self.lines.iter().map(place).collect();
            Front::new(&pieces, &camera, size).draw(canvas, &camera, &lines, side / 300.0);
        }
    }

    /// Looks at the surface, with room for a legend at the right.
    fn camera(&self, body: &Body, values: &[f32], view: Option<View>, size: [u32; 2], legend: f32) -> (Camera, Axes) {
        let [width, height] = size.map(|side| side as f32);
        let axes = Axes::guess(body);
        let [from, up] = view.map_or_else(|| axes.best(body, values, &self.marked(body)), |view| axes.named(view));
        let margin = 0.06 * width.min(height);
        let [free, down] = [width - 2.0 * margin - legend, height - 2.0 * margin];
        let frame = Frame { left: margin, top: margin, width: free, height: down };
        (Camera::new(body, from, up, frame), axes)
    }

    /// Where isolines are between the ends of the range, ascending.
    fn levels(&self, range: Range) -> Vec<f32> {
        let levels = match (self.levels, self.quantity) {
            (Some(levels), _) => levels.to_vec(),
            (None, Quantity::Distance | Quantity::Value) => range.ticks(30.0),
            (None, Quantity::Error { .. } | Quantity::Cell) => Vec::new(),
        };
        let mut levels: Vec<f32> = levels.into_iter().map(|level| range.place(level)).collect();
        levels.sort_by(f32::total_cmp);
        levels
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use taut::shapes;

    /// A flat square of 4 × 4 units from above, with lines.
    fn square(lines: &[Vec<[f64; 3]>]) -> Canvas {
        let mesh = shapes::grid(4, 4).mesh().unwrap();
        let values = vec![f64::INFINITY; mesh.vertex_count()];
        let picture =
            Picture { mesh: &mesh, quantity: Quantity::Distance, values: &values, sources: &[], levels: None, lines };
        picture.draw(Some(View::Top), [400, 400])
    }

    #[test]
    fn lines_are_hidden_behind_the_surface_only() {
        let plain = square(&[]);
        let drawn = |z: f64| {
            let lined = square(&[vec![[1.0, 2.0, z], [3.0, 2.0, z]]]);
            lined.pixels.iter().zip(&plain.pixels).filter(|(a, b)| a.distance(**b) > 0.05).count()
        };
        // Half as long as the square is wide, and some pixels thick.
        let width = plain.pixels[200 * 400..][..320].iter().filter(|p| p.x < 0.7).count();
        let half = width / 2;
        assert!((2 * half - 4..5 * half).contains(&drawn(0.0)), "{} {width}", drawn(0.0));
        assert!((2 * half - 4..6 * half).contains(&drawn(0.5)), "{} {width}", drawn(0.5));
        assert_eq!(drawn(-0.5), 0);
    }

    #[test]
    fn the_viewer_goes_where_lines_are_seen() {
        let mesh = shapes::icosphere(3).mesh().unwrap();
        let values = vec![f64::INFINITY; mesh.vertex_count()];
        for side in [[0.0, 1.0], [1.0, 0.0], [0.0, -1.0], [-1.0, 0.0]] {
            // Half way round the equator, above its triangles.
            let at = |angle: f64| {
                let (sin, cos) = angle.sin_cos();
                [side[0] * cos - side[1] * sin, 0.0, side[1] * cos + side[0] * sin]
            };
            let line = vec![(-15..=15).map(|i| at(0.1 * f64::from(i))).collect()];
            let (mesh, quantity) = (&mesh, Quantity::Distance);
            let picture = Picture { mesh, quantity, values: &values, sources: &[], levels: None, lines: &line };
            let lined = picture.draw(None, [400, 400]);
            let dark = lined.pixels[..].chunks(400).flat_map(|row| &row[..280]).filter(|p| p.x < 0.03).count();
            assert!(dark > 80, "{side:?}: {dark}");
        }
    }

    #[test]
    fn isolines_are_where_they_are_wanted() {
        let mesh = shapes::grid(4, 4).mesh().unwrap();
        let values: Vec<f64> = mesh.positions().iter().map(|p| p[0]).collect();
        let draw = |levels| {
            let quantity = Quantity::Distance;
            let picture = Picture { mesh: &mesh, quantity, values: &values, sources: &[], levels, lines: &[] };
            picture.draw(Some(View::Top), [400, 400])
        };
        let plain = draw(Some(&[]));
        let darker = |levels| {
            let lined: Canvas = draw(levels);
            let row = 200 * 400..201 * 400;
            row.filter(|&at| lined.pixels[at].x < 0.9 * plain.pixels[at].x).count()
        };
        assert_eq!(darker(Some(&[])), 0);
        assert!((1..=2).contains(&darker(Some(&[1.3]))));
        assert!((2..=4).contains(&darker(Some(&[3.1, 0.7, f64::NAN, 99.0]))));
        assert!(darker(None) > 10);
    }

    #[test]
    fn lines_that_are_nowhere_are_not_drawn() {
        let plain = square(&[]);
        for point in [[f64::NAN; 3], [f64::INFINITY; 3], [f64::MAX; 3], [0.0, 0.0, 1e9]] {
            let lined = square(&[vec![point, point], vec![], vec![[0.0; 3]]]);
            assert_eq!(lined.pixels, plain.pixels, "{point:?}");
        }
    }
}
