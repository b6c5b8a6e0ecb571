//! Lines as files: polylines in space (OBJ), and a flat drawing (SVG).
//!
//! The drawing sees the lines as a picture of the surface would, in perspective and without what the surface hides, which
//! is looked up once a pixel. Linear in the length of the lines in pixels.

use crate::isolines::{Lines, Polyline};
use crate::picture::{Encoder, Picture, PictureArgs, Sight};
use std::fmt::Write as _;

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

/// SVG: a group a level, in the colours of pictures; the palest of these would not show on white.
pub(crate) fn svg(lines: &Lines, picture: &Picture, args: &PictureArgs) -> String {
    const PALEST: f32 = 0.25;
    let [width, height] = args.size();
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" fill=\"none\" \
         stroke-width=\"1.2\" stroke-linejoin=\"round\">\n"
    );
    let (map, encoder) = (picture.quantity.map(), Encoder::new());
    let last = lines.levels.len().saturating_sub(1).max(1) as f32;
    let sight = Sight::new(picture, args);
    for (level, polylines) in lines.by_level() {
        let place = lines.levels.partition_point(|&other| other < level) as f32 / last;
        let [red, green, blue] = encoder.bytes(map.at(PALEST + (1.0 - PALEST) * place));
        let _ = writeln!(text, "<g stroke=\"rgb({red},{green},{blue})\"><title>{level}</title>");
        for part in polylines.iter().zip(sight.iter().cycle()).flat_map(|(line, sight)| sight.visible(line.path())) {
            let points = part.iter().map(|[x, y]| format!("{x:.2},{y:.2}"));
            let _ = writeln!(text, "<polyline points=\"{}\"/>", points.collect::<Vec<_>>().join(" "));
        }
        text.push_str("</g>\n");
    }
    text + "</svg>\n"
}
