//! Curves as sources: closed forms, invariants, and the field of many points on the curve.

mod common;
#[path = "common/places.rs"]
mod places;
#[path = "common/segments.rs"]
mod segments;

use common::corpus;
use places::{Random, euclid, field};
use segments::{is_in, length};
use taut::shapes::Shape;
use taut::{Control, Curve, Element, Error, ExactField, ExactOptions, ExactSolver};
use taut::{Mesh, Reason, Source, SurfacePoint, Target, isolines, shapes};

fn from_curve(mesh: &Mesh, curve: &Curve) -> ExactField {
    field(mesh, &[Source::curve(curve.clone())])
}

fn open(points: Vec<SurfacePoint>) -> Curve {
    Curve { points, is_closed: false }
}

fn corner(mesh: &Mesh, v: u32) -> SurfacePoint {
    let (face, triangle) = (0..).zip(mesh.triangles()).find(|(_, triangle)| triangle.contains(&v)).unwrap();
    SurfacePoint { face, barycentric: triangle.map(|corner| f64::from(u8::from(corner == v))) }
}

/// The shortest ways from point to point, and back to the first of a closed curve.
fn through(mesh: &Mesh, points: &[SurfacePoint], is_closed: bool) -> Curve {
    let stops: Vec<SurfacePoint> = points.iter().chain(is_closed.then_some(&points[0])).copied().collect();
    let mut curve = ExactSolver::new(mesh).unwrap().curve_through(&stops, &Control::new()).unwrap();
    if is_closed {
        curve.points.pop();
    }
    Curve { is_closed, ..curve }
}

/// The pieces of a curve in space.
fn pieces(mesh: &Mesh, curve: &Curve) -> Vec<[[f64; 3]; 2]> {
    let mut positions = curve.positions(mesh).unwrap();
    positions.extend(curve.is_closed.then(|| positions[0]));
    positions.windows(2).map(|pair| [pair[0], pair[1]]).collect()
}

/// The distance in space.
fn to_segment(p: [f64; 3], [a, b]: [[f64; 3]; 2]) -> f64 {
    let dot = |u: [f64; 3], v: [f64; 3]| (0..3).map(|k| u[k] * v[k]).sum::<f64>();
    let minus = |u: [f64; 3], v: [f64; 3]| [0, 1, 2].map(|k| u[k] - v[k]);
    let (way, to) = (minus(b, a), minus(p, a));
    let share = if dot(way, way) > 0.0 { (dot(to, way) / dot(way, way)).clamp(0.0, 1.0) } else { 0.0 };
    euclid(p, [0, 1, 2].map(|k| a[k] + share * way[k]))
}

#[track_caller]
fn assert_near(ours: &[f64], expected: &[f64], tolerance: f64, what: &str) {
    assert_eq!(ours.len(), expected.len());
    let largest = expected.iter().copied().filter(|d| d.is_finite()).fold(0.0, f64::max);
    for (v, (&d, &e)) in ours.iter().zip(expected).enumerate() {
        let same = d == e || (d - e).abs() <= tolerance * largest;
        assert!(same, "{what}: vertex {v}: {d}, expected {e}, off by {:e} of the largest", (d - e).abs() / largest);
    }
}

fn rotated(positions: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let (s, c) = 0.7f64.sin_cos();
    let turn = |&[x, y, z]: &[f64; 3]| [c * x - s * y, c * (s * x + c * y) - s * z, s * (s * x + c * y) + c * z];
    positions.iter().map(turn).collect()
}

#[test]
fn in_the_plane_the_nearest_segment_counts() {
    let mut random = Random(1);
    let flat = shapes::grid(17, 13);
    let turned = Shape { positions: rotated(&flat.positions), ..flat.clone() };
    let scale = |s: f64| flat.positions.iter().map(|p| p.map(|x| x * s)).collect();
    let [tiny, huge] = [1e-12, 1e12].map(|s| Shape { positions: scale(s), ..flat.clone() });
    let third = flat.positions.iter().map(|p| p.map(|x| f64::from((x / 3.0) as f32))).collect();
    let rounded = Shape { positions: third, ..flat.clone() };
    for (name, shape) in [("flat", flat), ("turned", turned), ("rounded", rounded), ("tiny", tiny), ("huge", huge)] {
        let mesh = shape.mesh().unwrap();
        for case in 0..8 {
            let mut points: Vec<SurfacePoint> = (0..2 + case / 2).map(|_| random.point(&mesh)).collect();
            points.push(corner(&mesh, random.below(mesh.vertex_count()) as u32));
            let curve = through(&mesh, &points, case % 2 == 1);
            let pieces = pieces(&mesh, &curve);
            let expected = |p: [f64; 3]| pieces.iter().map(|&piece| to_segment(p, piece)).fold(f64::INFINITY, f64::min);
            let from_curve = from_curve(&mesh, &curve);
            let all: Vec<f64> = mesh.positions().iter().map(|&p| expected(p)).collect();
            assert_near(from_curve.distances(), &all, 1e-14, name);
            let largest = all.iter().copied().fold(0.0, f64::max);
            for _ in 0..30 {
                let point = random.point(&mesh);
                let [ours, right] =
                    [from_curve.distance(Target::Point(point)).unwrap(), expected(point.position(&mesh).unwrap())];
                assert!((ours - right).abs() <= 1e-14 * largest, "{name}: {point:?}: {ours}, expected {right}");
            }
        }
    }
}

fn cube() -> Mesh {
    let corners: Vec<[f64; 3]> = (0..8).map(|v| [v & 1, v >> 1 & 1, v >> 2].map(f64::from)).collect();
    let squares = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let triangles: Vec<[u32; 3]> = squares.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    Mesh::from_triangles(&corners, &triangles).unwrap()
}

#[test]
fn around_and_along_a_cube() {
    let mesh = cube();
    let heights: Vec<f64> = mesh.positions().iter().map(|p| p[2]).collect();
    let belt = isolines(&mesh, &heights, &[0.25]).unwrap().remove(0).curve;
    assert!(belt.is_closed);
    let expected: Vec<f64> = heights.iter().map(|z| (z - 0.25).abs()).collect();
    assert_near(from_curve(&mesh, &belt).distances(), &expected, 1e-15, "belt");
    // From the edge between 0 and 1 to those parallel to it, and around the two squares at its ends.
    let edge = from_curve(&mesh, &open(vec![corner(&mesh, 0), corner(&mesh, 1)]));
    assert_near(edge.distances(), &[0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 2f64.sqrt(), 2f64.sqrt()], 1e-15, "edge");
}

/// The chain of edges around one end of a cylinder; the boundary has triangles on one side only.
#[test]
fn from_a_boundary_loop() {
    let (sides, rows, height) = (17, 12, 3.0);
    let mesh = shapes::cylinder(sides, rows, height).mesh().unwrap();
    let rim = Curve { points: (0..sides).map(|v| corner(&mesh, v)).collect(), is_closed: true };
    let field = from_curve(&mesh, &rim);
    let expected: Vec<f64> = mesh.positions().iter().map(|p| p[2]).collect();
    assert_near(field.distances(), &expected, 1e-14, "rim");
    for v in 0..mesh.vertex_count() as u32 {
        check_path(&mesh, &field.path(Target::Vertex(v)).unwrap().unwrap(), expected[v as usize], "rim");
    }
    // A part of an edge, and an inner point of the mesh above it.
    let [a, b] = [0.25, 0.75].map(|w| along(&mesh, [0, 1], w));
    let part = from_curve(&mesh, &open(vec![a, b]));
    let middle = SurfacePoint { face: a.face, barycentric: [1.0 / 3.0; 3] };
    let distance = part.distance(Target::Point(middle)).unwrap();
    assert!((distance - middle.position(&mesh).unwrap()[2]).abs() < 1e-15);
    check_path(&mesh, &part.path(Target::Point(middle)).unwrap().unwrap(), distance, "part of an edge");
}

/// The point on an edge of the mesh that has this share of it behind.
fn along(mesh: &Mesh, [from, to]: [u32; 2], share: f64) -> SurfacePoint {
    let is_on = |triangle: &[u32; 3]| triangle.contains(&from) && triangle.contains(&to);
    let (face, triangle) = (0..).zip(mesh.triangles()).find(|(_, triangle)| is_on(triangle)).unwrap();
    let weight = |v: u32| match v {
        v if v == from => 1.0 - share,
        v if v == to => share,
        _ => 0.0,
    };
    SurfacePoint { face, barycentric: triangle.map(weight) }
}

/// Each segment lies in the triangle that its first point names, no two points coincide, the length is the distance.
#[track_caller]
fn check_path(mesh: &Mesh, path: &Curve, distance: f64, what: &str) {
    let positions = path.positions(mesh).unwrap();
    assert!(!path.is_closed && !positions.is_empty());
    for (i, pair) in path.points.windows(2).enumerate() {
        assert!(is_in(mesh, &pair[1], pair[0].face), "{what}: segment {i} leaves its triangle");
        assert_ne!(positions[i], positions[i + 1], "{what}: point {i} twice");
    }
    let length = length(mesh, path);
    assert!((length - distance).abs() <= 1e-12 * distance, "{what}: path of {length:e} for a distance of {distance:e}");
}

/// How far the end of a path is from a curve, in space.
fn off_curve(mesh: &Mesh, path: &Curve, curve: &Curve) -> f64 {
    let end = path.points.last().unwrap().position(mesh).unwrap();
    pieces(mesh, curve).iter().map(|&piece| to_segment(end, piece)).fold(f64::INFINITY, f64::min)
}

fn made() -> Vec<(&'static str, Mesh)> {
    let shapes = [
        ("terrain", shapes::terrain(12, 0.5)),
        ("saddle", shapes::saddle(10)),
        ("sphere", shapes::icosphere(2)),
        ("torus", shapes::torus(20, 14, 2.0, 0.7)),
        ("cylinder", shapes::cylinder(9, 6, 3.0)),
        ("cone", shapes::cone(7.5, 12, 5)),
        ("sharp cone", shapes::cone(2.5, 7, 4)),
        ("knot", shapes::knot(30, 7, 0.4)),
    ];
    shapes.map(|(name, shape)| (name, shape.mesh().unwrap())).into()
}

/// Curves of several kinds: closed and open ones, along edges, within one triangle, that go twice over the same points.
fn curves(mesh: &Mesh, random: &mut Random) -> Vec<Curve> {
    let mut curves = Vec::new();
    for is_closed in [false, true] {
        let points: Vec<SurfacePoint> = (0..3).map(|_| random.point(mesh)).collect();
        curves.push(through(mesh, &points, is_closed));
    }
    let vertices: Vec<SurfacePoint> = (0..2).map(|_| corner(mesh, random.below(mesh.vertex_count()) as u32)).collect();
    curves.push(through(mesh, &vertices, false));
    let face = random.below(mesh.triangle_count()) as u32;
    let within = (0..6).map(|_| SurfacePoint { face, ..random.point(mesh) }).collect();
    curves.push(Curve { points: within, is_closed: true });
    let corners = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let rim = corners.map(|barycentric| SurfacePoint { face, barycentric });
    curves.push(Curve { points: rim.into(), is_closed: true });
    let edge = [mesh.triangles()[face as usize][0], mesh.triangles()[face as usize][2]];
    curves.push(open([0.2, 0.9, 0.9, 0.1].map(|share| along(mesh, edge, share)).into()));
    curves
}

/// The segments of a curve, the weights of both ends in the triangle that the first one names.
fn segments(mesh: &Mesh, curve: &Curve) -> Vec<(u32, [[f64; 3]; 2])> {
    let next = curve.points[1..].iter().chain(curve.is_closed.then_some(&curve.points[0]));
    let segment = |(from, to): (&SurfacePoint, &SurfacePoint)| {
        let [corners, others] = [from, to].map(|point| mesh.triangles()[point.face as usize]);
        let weight = |v: u32| (0..3).filter(|&k| others[k] == v).map(|k| to.barycentric[k]).sum();
        (from.face, [from.barycentric, corners.map(weight)])
    };
    curve.points.iter().zip(next).map(segment).collect()
}

/// A curve with each segment cut in so many.
fn finer(mesh: &Mesh, curve: &Curve, pieces: u32) -> Curve {
    let cut = |(face, [from, to]): (u32, [[f64; 3]; 2])| {
        (0..pieces).map(move |i| {
            let share = f64::from(i) / f64::from(pieces);
            SurfacePoint { face, barycentric: [0, 1, 2].map(|k| (1.0 - share) * from[k] + share * to[k]) }
        })
    };
    let last = (!curve.is_closed).then(|| curve.points[curve.points.len() - 1]);
    Curve { points: segments(mesh, curve).into_iter().flat_map(cut).chain(last).collect(), ..*curve }
}

/// The other way round.
fn reversed(mesh: &Mesh, curve: &Curve) -> Curve {
    let segments = segments(mesh, curve);
    let first = segments[0];
    let turned = segments.into_iter().rev().map(|(face, [_, to])| SurfacePoint { face, barycentric: to });
    let end = (!curve.is_closed).then_some(SurfacePoint { face: first.0, barycentric: first.1[0] });
    Curve { points: turned.chain(end).collect(), ..*curve }
}

fn check_against_samples(mesh: &Mesh, curve: &Curve, count: u32, what: &str) {
    let finer = finer(mesh, curve, count);
    let gap = pieces(mesh, &finer).iter().map(|&[a, b]| 0.5 * euclid(a, b)).fold(0.0, f64::max);
    let points: Vec<Source> = finer.points.iter().map(|&point| Source::point(point)).collect();
    let sampled = field(mesh, &points);
    let ours = from_curve(mesh, curve);
    let largest = sampled.distances().iter().copied().filter(|d| d.is_finite()).fold(0.0, f64::max);
    for (v, (&d, &s)) in ours.distances().iter().zip(sampled.distances()).enumerate() {
        assert_eq!(d.is_finite(), s.is_finite(), "{what}: vertex {v}: {d}, {s} from samples");
        let is_right = d == s || d <= s + 1e-13 * largest && s - d <= gap + 1e-13 * largest;
        assert!(is_right, "{what}: vertex {v}: {d}, but {s} from samples {gap} apart");
    }
}

#[test]
fn as_near_as_the_nearest_of_many_points() {
    let mut random = Random(2);
    for (name, mesh) in &made() {
        for (i, curve) in curves(mesh, &mut random).iter().enumerate() {
            check_against_samples(mesh, curve, 20, &format!("{name}, curve {i}"));
        }
    }
}

#[test]
fn paths_end_on_the_curve() {
    let mut random = Random(3);
    for (name, mesh) in &made() {
        for (i, curve) in curves(mesh, &mut random).iter().enumerate() {
            let what = format!("{name}, curve {i}");
            let field = from_curve(mesh, curve);
            for v in 0..mesh.vertex_count() as u32 {
                let path = field.path(Target::Vertex(v)).unwrap().unwrap();
                check_path(mesh, &path, field.distances()[v as usize], &format!("{what}, vertex {v}"));
                assert!(off_curve(mesh, &path, curve) < 1e-12, "{what}: the path of vertex {v} ends beside it");
            }
            for _ in 0..20 {
                let point = random.point(mesh);
                let distance = field.distance(Target::Point(point)).unwrap();
                let path = field.path(Target::Point(point)).unwrap().unwrap();
                check_path(mesh, &path, distance, &what);
                assert!(off_curve(mesh, &path, curve) < 1e-12, "{what}: the path of {point:?} ends beside it");
            }
        }
    }
}

#[test]
fn what_changes_nothing() {
    let mut random = Random(4);
    for (name, mesh) in &made() {
        for (i, curve) in curves(mesh, &mut random).iter().enumerate() {
            let what = format!("{name}, curve {i}");
            let plain = from_curve(mesh, curve).distances().to_vec();
            let [back, cut] = [reversed(mesh, curve), finer(mesh, curve, 3)].map(|curve| from_curve(mesh, &curve));
            assert_near(back.distances(), &plain, 1e-14, &format!("{what}, reversed"));
            assert_near(cut.distances(), &plain, 1e-13, &format!("{what}, cut"));
            let curve = Source::curve(curve.clone());
            let twice = field(mesh, &[curve.clone(), curve.clone().with_offset(0.1), curve.clone()]);
            assert_near(twice.distances(), &plain, 1e-14, &format!("{what}, twice"));
            assert!(twice.nearest_sources().all(|source| source == Some(0) || source == Some(2)));
            let later = field(mesh, &[curve.with_offset(-0.3)]);
            let shifted: Vec<f64> = plain.iter().map(|d| d - 0.3).collect();
            assert_near(later.distances(), &shifted, 1e-14, &format!("{what}, with offset"));
        }
    }
}

#[test]
fn a_curve_of_one_point_is_that_point() {
    let mut random = Random(5);
    for (name, mesh) in &made() {
        let vertex = corner(mesh, random.below(mesh.vertex_count()) as u32);
        let triangle = mesh.triangles()[vertex.face as usize];
        for point in [vertex, random.point(mesh), along(mesh, [triangle[2], triangle[0]], 0.3)] {
            let right = field(mesh, &[Source::point(point)]);
            for curve in [open(vec![point]), Curve { points: vec![point], is_closed: true }, open(vec![point; 3])] {
                let ours = from_curve(mesh, &curve);
                assert_eq!(ours.distances(), right.distances(), "{name}");
            }
        }
    }
}

/// Each triangle on an edge may be named for a segment along it.
#[test]
fn any_triangle_on_an_edge_may_hold_a_segment() {
    let page = |z: f64| [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.3, 1.0, z]];
    let mut positions = page(0.0).to_vec();
    positions.extend([page(0.4)[2], [0.6, -1.0, 0.5]]);
    let mesh = Mesh::from_triangles(&positions, &[[0, 1, 2], [3, 1, 0], [1, 4, 0]]).unwrap();
    let point = |face: u32, share: f64| {
        let at = |v: u32| {
            if v == 0 {
                1.0 - share
            } else if v == 1 {
                share
            } else {
                0.0
            }
        };
        SurfacePoint { face, barycentric: mesh.triangles()[face as usize].map(at) }
    };
    let of = |faces: [u32; 2]| from_curve(&mesh, &open(vec![point(faces[0], 0.2), point(faces[1], 0.7)]));
    let plain = of([0, 0]);
    let height = |v: usize| (mesh.positions()[v][1].powi(2) + mesh.positions()[v][2].powi(2)).sqrt();
    assert_near(plain.distances(), &[0.2, 0.3, height(2), height(3), height(4)], 1e-15, "three pages");
    for faces in [[0, 1], [1, 0], [1, 1], [1, 2], [2, 0], [2, 2]] {
        assert_near(of(faces).distances(), plain.distances(), 1e-15, &format!("{faces:?}"));
    }
    for face in 0..3 {
        let path = plain.path(Target::Vertex(2 + face)).unwrap().unwrap();
        check_path(&mesh, &path, plain.distances()[2 + face as usize], "three pages");
        assert_eq!(path.points.len(), 2);
    }
}

#[test]
fn curves_among_other_sources() {
    let mut random = Random(6);
    for (name, mesh) in &made() {
        let mut sources: Vec<Source> = curves(mesh, &mut random).into_iter().map(Source::curve).collect();
        sources.push(Source::vertex(random.below(mesh.vertex_count()) as u32));
        sources.push(Source::point(random.point(mesh)));
        sources.rotate_right(1);
        let offsets: Vec<f64> = sources.iter().map(|_| 0.4 * random.next() - 0.1).collect();
        let sources: Vec<Source> =
            sources.into_iter().zip(&offsets).map(|(source, d)| source.with_offset(*d)).collect();
        let alone: Vec<ExactField> = sources.iter().map(|source| field(mesh, std::slice::from_ref(source))).collect();
        let together = field(mesh, &sources);
        let least = |v: usize| alone.iter().map(|field| field.distances()[v]).fold(f64::INFINITY, f64::min);
        let nearest: Vec<f64> = (0..mesh.vertex_count()).map(least).collect();
        assert_near(together.distances(), &nearest, 1e-14, name);
        for (v, source) in together.nearest_sources().enumerate() {
            let source = source.unwrap() as usize;
            let distance = alone[source].distances()[v];
            assert!((distance - nearest[v]).abs() <= 1e-13, "{name}: vertex {v}: source {source} is {distance} away");
            let path = together.path(Target::Vertex(v as u32)).unwrap().unwrap();
            let length: f64 = pieces(mesh, &path).iter().map(|&[a, b]| euclid(a, b)).sum();
            let right = distance - offsets[source];
            assert!((length - right).abs() <= 1e-12, "{name}: vertex {v}: path of {length}, not {right}");
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

#[test]
fn batches_radii_and_targets_know_curves() {
    let mut random = Random(7);
    for (name, mesh) in &made() {
        let solver = ExactSolver::new(mesh).unwrap();
        let sources: Vec<Source> = curves(mesh, &mut random).into_iter().map(Source::curve).collect();
        let sets: Vec<Vec<Source>> = sources
            .iter()
            .map(|source| vec![source.clone()])
            .chain([vec![Source::vertex(0)], sources.clone()])
            .collect();
        let alone: Vec<Vec<f64>> = sets.iter().map(|set| field(mesh, set).distances().to_vec()).collect();
        for threads in [1, 3] {
            let rows = solver.distance_rows(&sets, threads, &Control::new()).unwrap();
            assert!(rows == alone, "{name}: {threads} threads");
        }
        let largest = alone[0].iter().copied().fold(0.0, f64::max);
        let radius = 0.3 * largest;
        let near = solver.distances_within(&sources, radius, 2, &Control::new()).unwrap();
        for i in 0..sources.len() {
            let row = near.row_start()[i]..near.row_start()[i + 1];
            let given: Vec<(u32, f64)> =
                near.vertices()[row.clone()].iter().copied().zip(near.distances()[row].iter().copied()).collect();
            let right: Vec<(u32, f64)> = (0..).zip(alone[i].iter().copied()).filter(|&(_, d)| d <= radius).collect();
            assert_eq!(given, right, "{name}: within {radius} of curve {i}");
            let v = (0..).zip(&alone[i]).max_by(|a, b| a.1.total_cmp(b.1)).unwrap().0;
            let options = ExactOptions { targets: vec![Target::Vertex(v / 2)], ..ExactOptions::default() };
            let early = solver.field(&[sources[i].clone()], &options, &Control::new()).unwrap();
            assert_eq!(early.distances()[v as usize / 2], alone[i][v as usize / 2], "{name}");
            for (d, full) in early.distances().iter().zip(&alone[i]) {
                assert_eq!(*d, if *full <= early.final_radius() { *full } else { f64::INFINITY }, "{name}");
            }
        }
        let samples = solver.farthest_points(&sources[..1], 3, &Control::new()).unwrap();
        assert_eq!(samples[0].1, largest, "{name}");
    }
}

#[test]
fn curves_through_points() {
    let mut random = Random(8);
    let mesh = shapes::torus(20, 14, 2.0, 0.7).mesh().unwrap();
    let solver = ExactSolver::new(&mesh).unwrap();
    let through = |points: &[SurfacePoint]| solver.curve_through(points, &Control::new());
    let stops: Vec<SurfacePoint> = (0..5).map(|_| random.point(&mesh)).collect();
    let curve = through(&stops).unwrap();
    let ways =
        stops.windows(2).map(|pair| field(&mesh, &[Source::point(pair[0])]).distance(Target::Point(pair[1])).unwrap());
    let length: f64 = pieces(&mesh, &curve).iter().map(|&[a, b]| euclid(a, b)).sum();
    assert!((length - ways.sum::<f64>()).abs() < 1e-12);
    for (i, pair) in curve.points.windows(2).enumerate() {
        assert!(is_in(&mesh, &pair[1], pair[0].face), "segment {i} leaves its triangle");
    }
    // A triangle holds both, so the way is straight, and points at one place are one.
    let inside = |a: f64| SurfacePoint { face: 7, barycentric: [a, 0.5 - a, 0.5] };
    assert_eq!(through(&[inside(0.1), inside(0.4), inside(0.4)]).unwrap().points.len(), 2);
    assert_eq!(through(&[inside(0.1), inside(0.1)]).unwrap().points.len(), 1);
    assert!(through(&[]).unwrap().points.is_empty());
    let error = through(&[inside(0.1), SurfacePoint { face: 9999, ..inside(0.1) }]).unwrap_err();
    assert_eq!((error.reason(), error.element()), (Reason::BadArgument, Some(Element::Point(1))));
    // Two parts.
    let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let both: Vec<[f64; 3]> = square.iter().copied().chain(square.map(|[x, y, _]| [x, y, 1.0])).collect();
    let parts = Mesh::from_triangles(&both, &[[0, 1, 2], [3, 4, 5]]).unwrap();
    let apart = [0, 1].map(|face| SurfacePoint { face, barycentric: [0.2, 0.3, 0.5] });
    let error = ExactSolver::new(&parts).unwrap().curve_through(&apart, &Control::new()).unwrap_err();
    assert_eq!((error.reason(), error.element()), (Reason::BadArgument, Some(Element::Point(1))));
}

#[test]
fn errors_name_the_source_and_the_point() {
    let mesh = shapes::grid(3, 3).mesh().unwrap();
    let inside = |face: u32| SurfacePoint { face, barycentric: [0.2, 0.3, 0.5] };
    let refused = |curve: Curve| -> Error {
        let sources = [Source::vertex(0), Source::curve(curve)];
        ExactSolver::new(&mesh).unwrap().field(&sources, &ExactOptions::default(), &Control::new()).unwrap_err()
    };
    let weights = |barycentric: [f64; 3]| open(vec![inside(0), SurfacePoint { face: 0, barycentric }]);
    let to_far = open(vec![inside(0), inside(0), inside(9)]);
    for (curve, message) in [
        (open(Vec::new()), "without points"),
        (open(vec![inside(0), inside(18)]), "point 1 lies in triangle 18"),
        (weights([f64::NAN, 0.5, 0.5]), "point 1 has the weights"),
        (weights([-0.5, 1.0, 0.5]), "point 1 has the weights"),
        (weights([0.5, 0.4, 0.0]), "point 1 has the weights"),
        (to_far.clone(), "from point 1 to the next lies in no triangle"),
        (Curve { is_closed: true, ..to_far }, "from point 1 to the next"),
    ] {
        let error = refused(curve);
        assert_eq!((error.reason(), error.element()), (Reason::BadArgument, Some(Element::Source(1))), "{message}");
        assert!(error.message().contains(message), "{}: expected {message}", error.message());
    }
    let offset = Source::curve(open(vec![inside(0), inside(0)])).with_offset(f64::INFINITY);
    let refused = ExactSolver::new(&mesh).unwrap().field(&[offset], &ExactOptions::default(), &Control::new());
    assert_eq!(refused.unwrap_err().reason(), Reason::BadArgument);
}

/// Triangles without area, edges without length, points at one place, coordinates at the ends of the range.
#[test]
fn hostile_meshes_have_answers() {
    let thirds = |face: u32| SurfacePoint { face, barycentric: [1.0 / 3.0; 3] };
    let pieces = |face: u32| open(vec![thirds(face), SurfacePoint { face, barycentric: [0.0, 0.5, 0.5] }]);
    for scale in [1.0, 1e-300, 1e300] {
        for (what, corners) in [
            ("no area", [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.4, 0.0, 0.0], [0.1, 0.9, 0.0]]),
            ("no length", [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.1, 0.9, 0.0]]),
            ("one place", [[0.3, 0.4, 0.5]; 4]),
            ("needle", [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1e-13, 0.0], [0.1, 0.9, 0.0]]),
        ] {
            let mut positions: Vec<[f64; 3]> = corners.iter().map(|p| p.map(|x| x * scale)).collect();
            positions.push([f64::NAN; 3]); // of no triangle
            let mesh = Mesh::from_triangles(&positions, &[[0, 1, 2], [0, 1, 3], [2, 1, 3], [3, 3, 0]]).unwrap();
            for face in 0..3 {
                let curve = pieces(face);
                let field = from_curve(&mesh, &curve);
                let pair = self::pieces(&mesh, &curve)[0];
                for v in 0..4 {
                    let d = field.distances()[v];
                    let least = to_segment(mesh.positions()[v].map(|x| x / scale), pair.map(|p| p.map(|x| x / scale)));
                    let is_sane = d / scale >= least - 1e-14 && d / scale <= 3.0;
                    assert!(is_sane, "{what}, scale {scale:e}, curve in {face}: vertex {v} at {d:e}, not {least:e}");
                }
                assert_eq!(field.distances()[4], f64::INFINITY);
            }
            // An ignored triangle holds no segment, but others that have its vertices do.
            let ignored = |barycentric: [f64; 3]| SurfacePoint { face: 3, barycentric };
            let edge = open(vec![ignored([1.0, 0.0, 0.0]), ignored([0.0, 0.0, 1.0])]);
            let right = from_curve(&mesh, &open(vec![corner(&mesh, 3), corner(&mesh, 0)]));
            assert_eq!(from_curve(&mesh, &edge).distances(), right.distances(), "{what}, scale {scale:e}");
        }
    }
}

/// Where the surface is flat the waves of a straight line stay one.
#[test]
fn windows_stay_few() {
    let cylinder = shapes::cylinder(40, 60, 3.0).mesh().unwrap();
    let rim = Curve { points: (0..40).map(|v| corner(&cylinder, v)).collect(), is_closed: true };
    let grid = shapes::grid(60, 60).mesh().unwrap();
    let line = through(&grid, &[corner(&grid, 5 * 61 + 3), corner(&grid, 41 * 61 + 57)], false);
    let torus = shapes::torus(96, 48, 1.0, 0.4).mesh().unwrap();
    let arc = through(&torus, &[corner(&torus, 7), corner(&torus, 2000)], false);
    for (name, mesh, curve, most) in
        [("rim", cylinder, rim, 9_200), ("line", grid, line, 28_000), ("arc", torus, arc, 190_000)]
    {
        let windows = from_curve(&mesh, &curve).windows();
        assert!(windows <= most, "{name}: {windows} windows");
    }
}

/// Up and down: the waves of two segments of one curve are parallel, but not equally far.
#[test]
fn parallel_segments_are_told_apart() {
    let mesh = shapes::grid(9, 9).mesh().unwrap();
    let point = |[a, b]: [f64; 2]| SurfacePoint { face: 80, barycentric: [a / 8.0, b / 8.0, 1.0 - (a + b) / 8.0] };
    let curve = open([[1.0, 1.0], [5.0, 1.0], [5.0, 2.0], [2.0, 2.0], [2.0, 3.0], [5.0, 3.0]].map(point).into());
    let pieces = pieces(&mesh, &curve);
    let least = |&p: &[f64; 3]| pieces.iter().map(|&piece| to_segment(p, piece)).fold(f64::INFINITY, f64::min);
    let expected: Vec<f64> = mesh.positions().iter().map(least).collect();
    assert_near(from_curve(&mesh, &curve).distances(), &expected, 1e-15, "up and down");
}

/// A scribble of so many segments in one triangle takes time in proportion.
#[test]
fn many_segments_in_one_triangle() {
    let mesh = cube();
    let mut random = Random(9);
    let points: Vec<SurfacePoint> = (0..20_000).map(|_| SurfacePoint { face: 0, ..random.point(&mesh) }).collect();
    let curve = open(points);
    let field = from_curve(&mesh, &curve);
    let pieces = pieces(&mesh, &curve);
    for v in [0, 1, 2, 3] {
        let right = pieces.iter().map(|&piece| to_segment(mesh.positions()[v], piece)).fold(f64::INFINITY, f64::min);
        assert!((field.distances()[v] - right).abs() < 1e-15, "vertex {v}");
    }
}

#[test]
fn real_meshes() {
    let mut random = Random(10);
    for name in
        ["bumpy.off", "fandisk.off", "moebius.obj", "triceratops_slivers.off", "fan3_nm_edge.obj", "louvre_cad.obj"]
    {
        let Some(folder) = corpus() else { return };
        let mesh = Mesh::read(folder.join(name)).unwrap();
        let heights: Vec<f64> = mesh.positions().iter().map(|p| p[0] + 0.3 * p[1] + 0.1 * p[2]).collect();
        let [low, high] = heights.iter().fold([f64::MAX, f64::MIN], |[low, high], &x| [low.min(x), high.max(x)]);
        let lines = isolines(&mesh, &heights, &[low + 0.37 * (high - low)]).unwrap();
        let longest = lines.iter().max_by_key(|line| line.curve.points.len()).unwrap().curve.clone();
        check_against_samples(&mesh, &longest, 8, name);
        let field = from_curve(&mesh, &longest);
        for v in (0..mesh.vertex_count() as u32).step_by(1 + mesh.vertex_count() / 500) {
            if let Some(path) = field.path(Target::Vertex(v)).unwrap() {
                check_path(&mesh, &path, field.distances()[v as usize], &format!("{name}, vertex {v}"));
            }
        }
        let face = random.below(mesh.triangle_count()) as u32;
        let within = (0..4).map(|_| SurfacePoint { face, ..random.point(&mesh) }).collect();
        check_against_samples(&mesh, &open(within), 30, name);
    }
}
