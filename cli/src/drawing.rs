//! Lines as files: polylines in space (OBJ), and a flat drawing (SVG).
//!
//! The drawing sees the lines as a picture of the surface would, in perspective and without what the surface hides, which
//! is looked up once a pixel. Linear in the length of the lines in pixels.

use crate::picture::{Encoder, Picture, PictureArgs, Sight};
use clap::builder::{PathBufValueParser, TypedValueParser};
use std::fmt::Write as _;
use std::path::PathBuf;
use taut::{Curve, Mesh};

/// Lines that belong together: an object of an OBJ file, a group of an SVG.
pub(crate) struct Group {
    /// What they have in common, as "level 0.5".
    pub(crate) name: String,
    /// Where their colour is in the map of pictures, from 0 to 1.
    pub(crate) shade: f32,
    pub(crate) lines: Vec<Polyline>,
}

/// A line in space.
pub(crate) struct Polyline {
    pub(crate) points: Vec<[f64; 3]>,
    /// Whether the last point is joined to the first.
    pub(crate) is_closed: bool,
}

impl Polyline {
    pub(crate) fn new(curve: &Curve, mesh: &Mesh) -> taut::Result<Polyline> {
        Ok(Polyline { points: curve.positions(mesh)?, is_closed: curve.is_closed })
    }

    /// Its points, the first again at the end of a closed one.
    fn path(&self) -> impl Iterator<Item = [f64; 3]> {
        let back = self.is_closed.then(|| self.points[0]);
        self.points.iter().copied().chain(back)
    }
}

/// A file of lines to write, and what its name says that it is.
#[derive(Debug, Clone)]
pub(crate) struct LinesOut {
    pub(crate) path: PathBuf,
    format: Format,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Format {
    Obj,
    Svg,
}

impl LinesOut {
    /// Reads the option's value; the suffix of the file tells the format.
    pub(crate) fn parser() -> impl TypedValueParser<Value = LinesOut> {
        PathBufValueParser::new().try_map(|path| {
            let suffix = path.extension().unwrap_or_default().to_ascii_lowercase();
            match suffix.to_str() {
                Some("obj") => Ok(LinesOut { path, format: Format::Obj }),
                Some("svg") => Ok(LinesOut { path, format: Format::Svg }),
                _ => Err("the name must end in .obj or .svg"),
            }
        })
    }

    /// Whether it shows the lines from somewhere.
    pub(crate) fn is_drawn(&self) -> bool {
        self.format == Format::Svg
    }

    /// The content of the file; the picture is that of the surface below the lines.
    pub(crate) fn content(&self, groups: &[Group], picture: &Picture, args: &PictureArgs) -> Vec<u8> {
        let text = match self.format {
            Format::Obj => obj(groups),
            Format::Svg => svg(groups, picture, args),
        };
        text.into_bytes()
    }
}

/// A closed line comes back to its first vertex; what is no longer than a point is a point element.
fn obj(groups: &[Group]) -> String {
    let mut text = String::from("# Lines on a surface: each object is named by what its lines have in common\n");
    let mut first = 1;
    // Here and below: writing to a string cannot fail.
    for Group { name, lines, .. } in groups {
        let _ = writeln!(text, "o {}", name.replace(' ', "_"));
        for Polyline { points, is_closed } in lines {
            for [x, y, z] in points {
                let _ = writeln!(text, "v {x} {y} {z}");
            }
            let end = first + points.len();
            let back = is_closed.then_some(first);
            let indices: Vec<String> = (first..end).chain(back).map(|index| index.to_string()).collect();
            let _ = writeln!(text, "{} {}", if indices.len() > 1 { 'l' } else { 'p' }, indices.join(" "));
            first = end;
        }
    }
    text
}

/// In the colours of pictures; the palest of these would not show on white.
fn svg(groups: &[Group], picture: &Picture, args: &PictureArgs) -> String {
    const PALEST: f32 = 0.25;
    let [width, height] = args.size();
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" fill=\"none\" \
         stroke-width=\"1.2\" stroke-linejoin=\"round\">\n"
    );
    let (map, encoder) = (picture.quantity.map(), Encoder::new());
    let sight = Sight::new(picture, args);
    for Group { name, shade, lines } in groups {
        let [red, green, blue] = encoder.bytes(map.at(PALEST + (1.0 - PALEST) * shade));
        let _ = writeln!(text, "<g stroke=\"rgb({red},{green},{blue})\"><title>{name}</title>");
        for part in lines.iter().zip(sight.iter().cycle()).flat_map(|(line, sight)| sight.visible(line.path())) {
            let points = part.iter().map(|[x, y]| format!("{x:.2},{y:.2}"));
            let _ = writeln!(text, "<polyline points=\"{}\"/>", points.collect::<Vec<_>>().join(" "));
        }
        text.push_str("</g>\n");
    }
    text + "</svg>\n"
}
