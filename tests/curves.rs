//! Curves as sources: closed forms, invariants, and the field of many points on the curve.

mod common;

use common::corpus;
use taut::shapes::Shape;
use taut::{Closest, Control, Curve, Element, Error, ExactField, ExactOptions, ExactSolver, HeatOptions, HeatSolver};
use taut::{Mesh, Reason, Source, SurfacePoint, isolines, shapes};

/// A small deterministic generator of numbers in [0, 1).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn below(&mut self, n: usize) -> usize {
        (self.next() * n as f64) as usize
    }

    fn point(&mut self, mesh: &Mesh) -> SurfacePoint {
        let [u, v] = [self.next(), self.next()];
        let [u, v] = if u + v > 1.0 { [1.0 - u, 1.0 - v] } else { [u, v] };
        SurfacePoint { face: self.below(mesh.triangle_count()) as u32, barycentric: [u, v, 1.0 - u - v] }
    }
}

fn field(mesh: &Mesh, sources: &[Source]) -> ExactField {
    let options = ExactOptions { keep_windows: true, ..ExactOptions::default() };
    ExactSolver::new(mesh).unwrap().field(sources, &options, &Control::new()).unwrap()
}

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

fn euclid(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
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
                let [ours, right] = [from_curve.distance(&point).unwrap(), expected(point.position(&mesh).unwrap())];
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
        check_path(&mesh, &field.path_from_vertex(v).unwrap().unwrap(), expected[v as usize], "rim");
    }
    // A part of an edge, and an inner point of the mesh above it.
    let [a, b] = [0.25, 0.75].map(|w| along(&mesh, [0, 1], w));
    let part = from_curve(&mesh, &open(vec![a, b]));
    let middle = SurfacePoint { face: a.face, barycentric: [1.0 / 3.0; 3] };
    let distance = part.distance(&middle).unwrap();
    assert!((distance - middle.position(&mesh).unwrap()[2]).abs() < 1e-15);
    check_path(&mesh, &part.path(&middle).unwrap().unwrap(), distance, "part of an edge");
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

/// Whether a point lies in a triangle, by its corners or by its place.
fn is_in(mesh: &Mesh, point: &SurfacePoint, face: u32) -> bool {
    let [corners, others] = [face, point.face].map(|face| mesh.triangles()[face as usize]);
    let shares_corners = (0..3).all(|k| point.barycentric[k] == 0.0 || corners.contains(&others[k]));
    shares_corners || {
        let alone = Mesh::from_triangles(&corners.map(|v| mesh.positions()[v as usize]), &[[0, 1, 2]]).unwrap();
        let place = point.position(mesh).unwrap();
        let size = place.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
        Closest::new(&alone).unwrap().point(place).unwrap().distance <= 1e-15 * size
    }
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
    let length: f64 = positions.windows(2).map(|pair| euclid(pair[0], pair[1])).sum();
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
                let path = field.path_from_vertex(v).unwrap().unwrap();
                check_path(mesh, &path, field.distances()[v as usize], &format!("{what}, vertex {v}"));
                assert!(off_curve(mesh, &path, curve) < 1e-12, "{what}: the path of vertex {v} ends beside it");
            }
            for _ in 0..20 {
                let point = random.point(mesh);
                let distance = field.distance(&point).unwrap();
                let path = field.path(&point).unwrap().unwrap();
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
