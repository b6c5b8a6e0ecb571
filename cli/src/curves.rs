//! Curves in files: lists of points, with a blank line between curves, as `taut path` prints them, and the polylines of OBJ
//! files, as `taut path` and `taut isolines` write them.

use crate::{Result, input, numbers::number};
use std::path::Path;
use taut::{Control, Curve, ExactSolver, Mesh, SurfacePoint};

/// A point of a curve as a file tells it.
#[derive(Debug, Clone, Copy)]
enum Given {
    Vertex(u32),
    Point(SurfacePoint),
    /// Nearest to this place in space.
    Near([f64; 3]),
}

/// The curves of a file.
pub(crate) fn read(path: &Path, mesh: &Mesh) -> Result<Vec<Curve>> {
    let error = |message: String| format!("{}: {message}", path.display());
    let text = std::fs::read_to_string(path).map_err(|reason| error(reason.to_string()))?;
    let is_obj = path.extension().is_some_and(|suffix| suffix.eq_ignore_ascii_case("obj"));
    let curves = if is_obj { obj(&text) } else { lists(&text) }.map_err(error)?;
    if curves.is_empty() {
        return Err(error("has no curves".to_owned()));
    }
    let mut points = surface_points(curves.iter().flatten(), mesh).map_err(error)?.into_iter();
    let solver = ExactSolver::new(mesh).map_err(|reason| reason.to_string())?;
    let through = |(i, given): (usize, &Vec<Given>)| {
        let points: Vec<SurfacePoint> = points.by_ref().take(given.len()).collect();
        solver.curve_through(&points, &Control::new()).map_err(|reason| error(format!("curve {i}: {reason}")))
    };
    curves.iter().enumerate().map(through).collect()
}

/// One point a line.
fn lists(text: &str) -> Result<Vec<Vec<Given>>> {
    let mut curves = vec![Vec::new()];
    for (line, text) in (1..).zip(text.lines()) {
        let content = text.split('#').next().unwrap_or_default().trim();
        let words: Vec<&str> = content.split_whitespace().collect();
        if text.trim().is_empty() {
            curves.push(Vec::new());
        } else if !words.is_empty() {
            let expected = "a vertex, a triangle and three weights, or three coordinates";
            let given = given(&words).ok_or_else(|| format!("line {line}: expected {expected}, found {content:?}"))?;
            if let Some(curve) = curves.last_mut() {
                curve.push(given);
            }
        }
    }
    curves.retain(|curve| !curve.is_empty());
    Ok(curves)
}

fn given(words: &[&str]) -> Option<Given> {
    Some(match *words {
        [vertex] => Given::Vertex(number(vertex)?),
        [x, y, z] => Given::Near([number(x)?, number(y)?, number(z)?]),
        [face, a, b, c] => {
            let barycentric = [number(a)?, number(b)?, number(c)?];
            Given::Point(SurfacePoint { face: number(face)?, barycentric })
        }
        _ => return None,
    })
}

/// The line and point elements of an OBJ file; all others mean nothing here.
fn obj(text: &str) -> Result<Vec<Vec<Given>>> {
    let (mut positions, mut curves) = (Vec::new(), Vec::new());
    for (line, text) in (1..).zip(text.lines()) {
        let content = text.split('#').next().unwrap_or_default();
        let words: Vec<&str> = content.split_whitespace().collect();
        let expected = |what: &str| format!("line {line}: expected {what}, found {:?}", content.trim());
        match words[..] {
            ["v", ..] => {
                let position: Option<Vec<f64>> = words[1..].iter().take(3).map(|word| number(word)).collect();
                let position: Option<[f64; 3]> = position.and_then(|position| position.try_into().ok());
                positions.push(position.ok_or_else(|| expected("three coordinates"))?);
            }
            ["l" | "p", ..] => {
                let vertex = |word: &&str| {
                    let index: i64 = number(word.split('/').next()?)?;
                    let count = positions.len() as i64; // fits: they are in memory
                    let place = if index < 0 { count + index } else { index - 1 };
                    positions.get(usize::try_from(place).ok()?).map(|&position| Given::Near(position))
                };
                let curve: Option<Vec<Given>> = words[1..].iter().map(vertex).collect();
                let curve = curve.filter(|curve| !curve.is_empty());
                let curve = curve.ok_or_else(|| expected("the numbers of vertices above"))?;
                let length = if words[0] == "p" { 1 } else { curve.len() };
                curves.extend(curve.chunks(length).map(<[Given]>::to_vec));
            }
            _ => {}
        }
    }
    Ok(curves)
}

/// A place in space whose nearest point is this close to an edge, as a share of the triangle, is on the edge: files round.
const ON_EDGE: f64 = 1e-9;

/// The point without the weights that rounding made.
fn snapped(point: SurfacePoint) -> SurfacePoint {
    let barycentric = point.barycentric.map(|w| if w < ON_EDGE { 0.0 } else { w });
    let sum: f64 = barycentric.iter().sum();
    SurfacePoint { barycentric: barycentric.map(|w| w / sum), ..point }
}

/// The points on the surface.
fn surface_points<'a>(given: impl Iterator<Item = &'a Given> + Clone, mesh: &Mesh) -> Result<Vec<SurfacePoint>> {
    let place = |given: &Given| if let Given::Near(place) = *given { Some(place) } else { None };
    let places: Vec<[f64; 3]> = given.clone().filter_map(place).collect();
    let mut near = input::nearest(&places, mesh)?.into_iter().map(snapped);
    let mut corners: Vec<Option<SurfacePoint>> = vec![None; mesh.vertex_count()];
    for (face, triangle) in (0..).zip(mesh.triangles()) {
        for (k, &v) in triangle.iter().enumerate() {
            let mut barycentric = [0.0; 3];
            barycentric[k] = 1.0;
            corners[v as usize] = Some(SurfacePoint { face, barycentric });
        }
    }
    let point = |given: &Given| match *given {
        Given::Vertex(v) => {
            let corner = corners.get(v as usize).copied().flatten();
            corner.ok_or_else(|| format!("the mesh has no triangle at a vertex {v}"))
        }
        Given::Point(point) => Ok(point),
        Given::Near(_) => near.next().ok_or_else(|| "a point is near nothing".to_owned()),
    };
    given.map(point).collect()
}
