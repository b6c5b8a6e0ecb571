//! What the commands read.

use crate::Result;
use crate::args::SourceArgs;
use crate::curves;
use crate::measured::{Seconds, measured};
use crate::numbers;
use std::path::Path;
use taut::{Closest, Control, Element, Error, Mesh, Reason, Source, SurfacePoint};

/// The mesh of a file.
pub(crate) fn read(path: &Path) -> Result<(Mesh, Seconds)> {
    let (mesh, seconds) = measured("read", |_| Mesh::read(path));
    Ok((mesh.map_err(|error| format!("{}: {error}", path.display()))?, seconds))
}

/// The mesh of a file to measure on; warns of triangles that are ignored.
pub(crate) fn mesh(path: &Path) -> Result<(Mesh, Seconds)> {
    let (mesh, seconds) = read(path)?;
    if let [first, ..] = mesh.ignored_triangles() {
        let count = mesh.ignored_triangles().len();
        eprintln!("taut: warning: {count} triangles repeat a vertex and are ignored, the first is triangle {first}");
    }
    Ok((mesh, seconds))
}

/// The sources of a command line: vertices first, then points, then curves.
pub(crate) fn sources(args: &SourceArgs, mesh: &Mesh) -> Result<Vec<Source>> {
    let mut sources: Vec<Source> = match &args.sources {
        Some(path) => numbers::sources(path)?,
        None => {
            let vertices = args.source.iter().map(|&vertex| Source::vertex(vertex));
            let points = nearest(&args.source_at, mesh)?.into_iter().map(Source::point);
            vertices.chain(points).collect()
        }
    };
    for path in &args.source_curve {
        sources.extend(curves::read(path, mesh)?.into_iter().map(Source::curve));
    }
    Ok(sources)
}

/// The places of the surface that are nearest to points in space.
pub(crate) fn nearest(points: &[[f64; 3]], mesh: &Mesh) -> Result<Vec<SurfacePoint>> {
    if points.is_empty() {
        return Ok(Vec::new()); // needs no tree, nor triangles
    }
    let places = Closest::new(mesh).and_then(|closest| closest.points(points, &Control::new()));
    Ok(places.map_err(|error| error.to_string())?.iter().map(|place| place.point).collect())
}

/// Refuses target vertices that the mesh does not have.
pub(crate) fn check_targets(targets: &[u32], mesh: &Mesh) -> Result<()> {
    let vertices = mesh.vertex_count();
    match (0..).zip(targets).find(|&(_, &target)| target as usize >= vertices) {
        None => Ok(()),
        Some((i, target)) => {
            let message = format!("is vertex {target}, but the mesh has {vertices} vertices");
            Err(Error::at(Reason::VertexOutOfRange, Element::Target(i), message).to_string())
        }
    }
}

/// Where the sources lie: points, and the lines of those that are longer than a point.
pub(crate) struct Places {
    pub(crate) points: Vec<[f64; 3]>,
    pub(crate) lines: Vec<Vec<[f64; 3]>>,
}

impl Places {
    pub(crate) fn new(sources: &[Source], mesh: &Mesh) -> Result<Places> {
        let mut places = Places { points: Vec::new(), lines: Vec::new() };
        for source in sources {
            let positions = source.positions(mesh).map_err(|error| error.to_string())?;
            match positions[..] {
                [point] => places.points.push(point),
                _ => places.lines.push(positions),
            }
        }
        Ok(places)
    }
}

/// The numbers of a file that must have one for each vertex of the mesh; `what` each is called in messages.
pub(crate) fn numbers(path: &Path, what: &str, mesh: &Mesh) -> Result<Vec<f64>> {
    let numbers = numbers::numbers(path, what)?;
    let [given, needed] = [numbers.len(), mesh.vertex_count()];
    if given == needed {
        return Ok(numbers);
    }
    Err(format!("{}: has {given} numbers, but the mesh has {needed} vertices", path.display()))
}

#[cfg(test)]
mod tests {
    use super::Places;
    use taut::{Curve, Source, SurfacePoint, shapes};

    #[test]
    fn lines_are_what_is_longer_than_a_point() {
        let mesh = shapes::grid(1, 1).mesh().unwrap();
        let corner = |k: usize| SurfacePoint { face: 0, barycentric: [0, 1, 2].map(|l| f64::from(u8::from(k == l))) };
        let curve = |points: Vec<SurfacePoint>| Source::curve(Curve { points, is_closed: false });
        let sources = [curve(vec![corner(0), corner(1)]), Source::vertex(3), curve(vec![corner(1)])];
        let Places { points, lines } = Places::new(&sources, &mesh).unwrap();
        let at = |k: usize| mesh.positions()[mesh.triangles()[0][k] as usize];
        assert_eq!(points, [mesh.positions()[3], at(1)]);
        assert_eq!(lines, [vec![at(0), at(1)]]);
    }
}
