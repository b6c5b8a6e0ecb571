//! Distances, paths and nearest sources of any point of the surface.

#[path = "common/bad.rs"]
mod bad;
mod common;
#[path = "common/places.rs"]
mod places;
#[path = "common/segments.rs"]
mod segments;

use bad::bad_meshes;
use places::{Random, field};
use segments::{is_in, length};
use taut::{Curve, ExactField, Mesh, Source, SurfacePoint, Target, shapes};

/// Each segment lies in the triangle that its first point names, the last point names the last one's, no two points
/// coincide, and the length is the distance.
fn check_path(mesh: &Mesh, path: &Curve, distance: f64, what: &str) {
    let positions = path.positions(mesh).unwrap();
    assert!(!path.is_closed && !positions.is_empty());
    for (i, pair) in path.points.windows(2).enumerate() {
        assert!(is_in(mesh, &pair[1], pair[0].face), "{what}: segment {i} leaves its triangle");
        assert_ne!(positions[i], positions[i + 1], "{what}: point {i} twice");
    }
    if let [.., before, last] = &path.points[..] {
        assert_eq!(before.face, last.face, "{what}: the last point names another triangle");
    }
    let length = length(mesh, path);
    assert!((length - distance).abs() <= 1e-12 * distance, "{what}: path of {length:e} for a distance of {distance:e}");
}

fn check_vertex_paths(mesh: &Mesh, field: &ExactField, step: usize, what: &str) {
    for v in (0..mesh.vertex_count()).step_by(step) {
        let path = field.path(Target::Vertex(v as u32)).unwrap();
        let distance = field.distances()[v];
        assert_eq!(path.is_some(), distance < f64::INFINITY, "{what}: vertex {v} at {distance}");
        if let Some(path) = path {
            let what = format!("{what}, vertex {v}");
            check_path(mesh, &path, distance, &what);
            assert_eq!(path.positions(mesh).unwrap()[0], mesh.positions()[v], "{what}");
        }
    }
}

fn made() -> Vec<(&'static str, Mesh)> {
    let shapes = [
        ("grid", shapes::grid(20, 17)),
        ("terrain", shapes::terrain(20, 0.5)),
        ("saddle", shapes::saddle(20)),
        ("sphere", shapes::icosphere(3)),
        ("torus", shapes::torus(30, 20, 2.0, 0.7)),
        ("cylinder", shapes::cylinder(17, 12, 3.0)),
        ("cone", shapes::cone(7.5, 12, 9)),
        ("knot", shapes::knot(80, 9, 0.4)),
    ];
    shapes.map(|(name, shape)| (name, shape.mesh().unwrap())).into()
}

#[test]
fn paths_are_as_long_as_distances() {
    for (name, mesh) in &made() {
        for source in [0, mesh.vertex_count() as u32 / 2] {
            check_vertex_paths(mesh, &field(mesh, &[Source::vertex(source)]), 1, name);
        }
    }
}

#[test]
fn paths_on_the_corpus_are_as_long_as_distances() {
    for (name, mesh) in bad_meshes() {
        let source = mesh.triangles()[mesh.triangle_count() / 2][0];
        check_vertex_paths(&mesh, &field(&mesh, &[Source::vertex(source)]), 1 + mesh.vertex_count() / 5000, name);
    }
}

/// The mesh with a triangle split at a point of it, whose number is returned too.
fn split_at(mesh: &Mesh, point: &SurfacePoint) -> (Mesh, u32) {
    let mut positions = mesh.positions().to_vec();
    let mut triangles = mesh.triangles().to_vec();
    let new = positions.len() as u32;
    positions.push(point.position(mesh).unwrap());
    let [a, b, c] = triangles[point.face as usize];
    triangles[point.face as usize] = [a, b, new];
    triangles.extend([[b, c, new], [c, a, new]]);
    (Mesh::from_triangles(&positions, &triangles).unwrap(), new)
}

#[track_caller]
fn assert_near(ours: &[f64], expected: &[f64], tolerance: f64, what: &str) {
    let largest = expected.iter().copied().filter(|d| d.is_finite()).fold(0.0, f64::max);
    for (v, (&d, &e)) in ours.iter().zip(expected).enumerate() {
        let same = d == e || (d - e).abs() <= tolerance * largest;
        assert!(same, "{what}: vertex {v}: {d}, expected {e}, off by {:e} of the largest", (d - e).abs() / largest);
    }
}

#[test]
fn a_point_is_what_a_vertex_there_would_be() {
    let mut random = Random(1);
    for (name, mesh) in &made() {
        for case in 0..6 {
            let point = random.point(mesh);
            let (split, new) = split_at(mesh, &point);
            let expected = field(&split, &[Source::vertex(new)]);
            let from_inside = field(mesh, &[Source::point(point)]);
            let vertices = mesh.vertex_count();
            assert_near(from_inside.distances(), &expected.distances()[..vertices], 1e-13, name);
            check_vertex_paths(mesh, &from_inside, 1, name);

            let from_vertex = field(mesh, &[Source::vertex(case)]);
            let there = field(&split, &[Source::vertex(case)]).distances()[new as usize];
            let distance = from_vertex.distance(Target::Point(point)).unwrap();
            assert!((distance - there).abs() <= 1e-13 * there, "{name}: {distance}, as a vertex {there}");
            check_path(mesh, &from_vertex.path(Target::Point(point)).unwrap().unwrap(), distance, name);
        }
    }
}

#[test]
fn points_are_as_far_there_as_back() {
    let mut random = Random(2);
    for (name, mesh) in &made() {
        let points: Vec<SurfacePoint> = (0..8).map(|_| random.point(mesh)).collect();
        let fields: Vec<ExactField> = points.iter().map(|&point| field(mesh, &[Source::point(point)])).collect();
        for (p, from_p) in points.iter().zip(&fields) {
            for (q, from_q) in points.iter().zip(&fields) {
                let [there, back] =
                    [from_p.distance(Target::Point(*q)).unwrap(), from_q.distance(Target::Point(*p)).unwrap()];
                assert!((there - back).abs() <= 1e-13 * (1.0 + there), "{name}: {there} there, {back} back");
                check_path(mesh, &from_p.path(Target::Point(*q)).unwrap().unwrap(), there, name);
            }
        }
    }
}

/// Points on an edge, named by either triangle on it.
#[test]
fn points_on_edges_belong_to_every_triangle_there() {
    let mesh = shapes::torus(12, 9, 2.0, 0.7).mesh().unwrap();
    let mut random = Random(3);
    for _ in 0..20 {
        let face = random.below(mesh.triangle_count()) as u32;
        let share = random.next();
        let [a, b, _] = mesh.triangles()[face as usize];
        let one = SurfacePoint { face, barycentric: [1.0 - share, share, 0.0] };
        let (other, corners) =
            (0..).zip(mesh.triangles()).find(|(f, t)| *f != face && t.contains(&a) && t.contains(&b)).unwrap();
        let weight = |v: &u32| {
            if *v == a {
                1.0 - share
            } else if *v == b {
                share
            } else {
                0.0
            }
        };
        let two =
            SurfacePoint { face: other, barycentric: [weight(&corners[0]), weight(&corners[1]), weight(&corners[2])] };
        let [from_one, from_two] = [one, two].map(|point| field(&mesh, &[Source::point(point)]));
        assert_near(from_one.distances(), from_two.distances(), 1e-15, "either name");
        assert_eq!(from_one.distance(Target::Point(two)).unwrap(), 0.0);
        for from in [&from_one, &from_two] {
            check_vertex_paths(&mesh, from, 1, "from an edge");
            let far = random.point(&mesh);
            check_path(
                &mesh,
                &from.path(Target::Point(far)).unwrap().unwrap(),
                from.distance(Target::Point(far)).unwrap(),
                "from an edge",
            );
        }
        let from_vertex = field(&mesh, &[Source::vertex(0)]);
        let [d1, d2] = [one, two].map(|point| from_vertex.distance(Target::Point(point)).unwrap());
        assert!((d1 - d2).abs() <= 1e-15 * d1);
    }
}

/// A source on an edge of one triangle only.
#[test]
fn paths_lead_to_the_boundary() {
    let mesh = shapes::grid(3, 2).mesh().unwrap();
    let middle = SurfacePoint { face: 0, barycentric: [0.6, 0.4, 0.0] };
    assert_eq!(middle.position(&mesh).unwrap()[1], 0.0);
    let from_middle = field(&mesh, &[Source::point(middle)]);
    check_vertex_paths(&mesh, &from_middle, 1, "from the boundary");
    let inside = SurfacePoint { face: 0, barycentric: [0.2, 0.3, 0.5] };
    let path = from_middle.path(Target::Point(inside)).unwrap().unwrap();
    check_path(&mesh, &path, from_middle.distance(Target::Point(inside)).unwrap(), "from the boundary");
}

#[test]
fn each_place_knows_its_nearest_source() {
    let mut random = Random(4);
    for (name, mesh) in &made() {
        let mut sources: Vec<Source> =
            (0..4).map(|_| Source::vertex(random.below(mesh.vertex_count()) as u32)).collect();
        sources.extend((0..4).map(|_| Source::point(random.point(mesh)).with_offset(0.3 * random.next() - 0.1)));
        let alone: Vec<ExactField> = sources.iter().map(|source| field(mesh, std::slice::from_ref(source))).collect();
        let together = field(mesh, &sources);
        let nearest: Vec<f64> = (0..mesh.vertex_count())
            .map(|v| alone.iter().map(|field| field.distances()[v]).fold(f64::INFINITY, f64::min))
            .collect();
        assert_near(together.distances(), &nearest, 1e-14, name);
        for (v, source) in together.nearest_sources().enumerate() {
            let distance = alone[source.unwrap() as usize].distances()[v];
            assert!((distance - nearest[v]).abs() <= 1e-13, "{name}: vertex {v}: source {source:?} is {distance} away");
        }
        for _ in 0..20 {
            let point = random.point(mesh);
            let source = together.nearest_source(Target::Point(point)).unwrap().unwrap();
            let [all, one] =
                [&together, &alone[source as usize]].map(|field| field.distance(Target::Point(point)).unwrap());
            assert!((all - one).abs() <= 1e-13, "{name}: source {source} is {one} away, not {all}");
        }
    }
}
