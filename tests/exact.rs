//! Exact distances against closed forms and invariants.

mod common;
#[path = "common/places.rs"]
mod places;

use common::corpus;
use places::{Random, euclid};
use std::f64::consts::{PI, SQRT_2};
use taut::shapes::{self, Shape};
use taut::{Control, Element, ExactField, ExactOptions, ExactSolver, Mesh, Reason, Source, Target};

type Points = Vec<[f64; 3]>;
type Triangles = Vec<[u32; 3]>;

fn field(points: &[[f64; 3]], triangles: &[[u32; 3]], sources: &[Source], targets: &[u32]) -> ExactField {
    let mesh = Mesh::from_triangles(points, triangles).unwrap();
    let options =
        ExactOptions { targets: targets.iter().copied().map(Target::Vertex).collect(), ..ExactOptions::default() };
    ExactSolver::new(&mesh).unwrap().field(sources, &options, &Control::new()).unwrap()
}

fn distances(points: &[[f64; 3]], triangles: &[[u32; 3]], source: u32) -> Vec<f64> {
    field(points, triangles, &[Source::vertex(source)], &[]).distances().to_vec()
}

#[track_caller]
fn assert_close(ours: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(ours.len(), expected.len());
    let largest = expected.iter().copied().filter(|d| d.is_finite()).fold(0.0, f64::max);
    for (v, (&d, &e)) in ours.iter().zip(expected).enumerate() {
        let same = d == e || (d - e).abs() <= tolerance * largest;
        assert!(same, "vertex {v}: {d}, expected {e}, off by {:e} of the largest", (d - e).abs() / largest);
    }
}

/// An n by n grid of squares of side 1/n, each cut along a diagonal; `height` lifts it.
fn grid(n: u32, height: impl Fn(f64, f64) -> f64) -> (Points, Triangles) {
    let Shape { mut positions, triangles } = shapes::grid(n, n);
    for [x, y, z] in &mut positions {
        [*x, *y] = [*x, *y].map(|i| i / f64::from(n));
        *z = height(*x, *y);
    }
    (positions, triangles)
}

fn rough(x: f64, y: f64) -> f64 {
    0.2 * (7.0 * x + 1.0).sin() * (5.0 * y).cos() + 0.05 * (31.0 * x * y).sin()
}

fn rotated(points: &[[f64; 3]]) -> Points {
    let (s, c) = 0.7f64.sin_cos();
    points.iter().map(|&[x, y, z]| [c * x - s * y, c * (s * x + c * y) - s * z, s * (s * x + c * y) + c * z]).collect()
}

/// Removes a rectangle of squares from an n by n grid.
fn without(n: u32, triangles: &[[u32; 3]], hole: impl Fn(u32, u32) -> bool) -> Triangles {
    let square = |index: usize| ((index / 2) as u32 % n, (index / 2) as u32 / n);
    let keep = |index: usize| {
        let (i, j) = square(index);
        !hole(i, j)
    };
    triangles.iter().enumerate().filter(|&(index, _)| keep(index)).map(|(_, t)| *t).collect()
}

#[test]
fn plane_is_euclidean() {
    let (flat, triangles) = grid(23, |_, _| 0.0);
    for points in [flat.clone(), rotated(&flat), flat.iter().map(|p| p.map(|x| f64::from(x as f32))).collect()] {
        for source in [0, 11 * 24 + 12, 300] {
            let expected: Vec<f64> = points.iter().map(|&p| euclid(p, points[source as usize])).collect();
            assert_close(&distances(&points, &triangles, source), &expected, 1e-14);
        }
    }
}

#[test]
fn path_bends_at_a_reflex_boundary_corner() {
    // An L: the upper right quarter is missing. From the far end of one arm to the other the path touches (1/2, 1/2).
    let (points, triangles) = grid(8, |_, _| 0.0);
    let triangles = without(8, &triangles, |i, j| i >= 4 && j >= 4);
    let source = 8 * 9 + 4; // (1/2, 1)
    let corner = [0.5, 0.5, 0.0];
    let all = distances(&points, &triangles, source);
    for v in 0..points.len() {
        let p = points[v];
        if p[0] > 0.5 && p[1] > 0.5 {
            assert_eq!(all[v], f64::INFINITY, "nothing is left of vertex {v}");
        } else {
            let expected = if p[0] > 0.5 { 0.5 + euclid(corner, p) } else { euclid(points[source as usize], p) };
            assert!((all[v] - expected).abs() < 1e-14, "vertex {v}: {} not {expected}", all[v]);
        }
    }
}

#[test]
fn cube() {
    let points: Points = (0..8).map(|i| [f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2)]).collect();
    let quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let triangles: Triangles = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let expected = [0.0, 1.0, 1.0, SQRT_2, 1.0, SQRT_2, SQRT_2, 5f64.sqrt()];
    assert_close(&distances(&points, &triangles, 0), &expected, 1e-15);
}

/// A pyramid of `n` equal isosceles triangles with apex angle `angle` and sides 1; for a sum of angles above 2π the rim
/// goes up and down. Vertex 0 is the apex.
fn pyramid(n: u32, angle: f64) -> (Points, Triangles) {
    let chord = 2.0 * (angle / 2.0).sin();
    let turn = 2.0 * PI / f64::from(n);
    let total = f64::from(n) * angle;
    // Rim vertices on the unit sphere at height ±z: neighbours are a chord apart.
    let z = if total < 2.0 * PI {
        (1.0 - (chord / (2.0 * (turn / 2.0).sin())).powi(2)).sqrt()
    } else {
        let s2 = (turn / 2.0).sin().powi(2);
        ((chord * chord / 4.0 - s2) / (1.0 - s2)).sqrt()
    };
    let r = (1.0 - z * z).sqrt();
    let mut points = vec![[0.0; 3]];
    for i in 0..n {
        let (s, c) = (turn * f64::from(i)).sin_cos();
        points.push([r * c, r * s, if total < 2.0 * PI || i % 2 == 0 { z } else { -z }]);
    }
    (points, (0..n).map(|i| [0, 1 + i, 1 + (i + 1) % n]).collect())
}

#[test]
fn cones_below_and_above_two_pi() {
    for (n, angle) in [(7, 0.3), (9, 0.5), (12, 0.4), (6, 1.2), (8, 1.0), (10, 0.9)] {
        let (points, triangles) = pyramid(n, angle);
        for source in 1..=n {
            let along = |v: u32| f64::from((v.abs_diff(source)).min(n - v.abs_diff(source))) * angle;
            let chord = |angle: f64| if angle < PI { 2.0 * (angle / 2.0).sin() } else { 2.0 };
            let mut expected = vec![1.0];
            expected.extend((1..=n).map(|v| chord(along(v))));
            assert_close(&distances(&points, &triangles, source), &expected, 1e-14);
        }
    }
}

#[test]
fn prism_unrolls_to_a_strip() {
    let (sides, rings) = (13u32, 9u32);
    let radius = 0.5 / (PI / f64::from(sides)).sin(); // sides of length 1
    let ring = |i: u32| (2.0 * PI * f64::from(i) / f64::from(sides)).sin_cos();
    let points: Points = (0..rings * sides)
        .map(|v| [radius * ring(v % sides).0, radius * ring(v % sides).1, f64::from(v / sides) * 0.7])
        .collect();
    let at = |i: u32, j: u32| j * sides + i % sides;
    let triangles: Triangles = (0..rings - 1)
        .flat_map(|j| (0..sides).map(move |i| (i, j)))
        .flat_map(|(i, j)| [[at(i, j), at(i + 1, j), at(i, j + 1)], [at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]])
        .collect();
    let source = 4 * sides + 3;
    let expected: Vec<f64> = (0..rings * sides)
        .map(|v| {
            let around = (v % sides).abs_diff(3);
            f64::from(around.min(sides - around)).hypot((f64::from(v / sides) - 4.0) * 0.7)
        })
        .collect();
    assert_close(&distances(&points, &triangles, source), &expected, 1e-14);
}

#[test]
fn three_pages_on_one_edge_unfold_in_pairs() {
    let (sheet, page) = grid(6, |_, _| 0.0);
    let mut points = Points::new();
    let mut triangles = Triangles::new();
    for k in 0..3u32 {
        let (s, c) = (2.0 * PI * f64::from(k) / 3.0).sin_cos();
        points.extend(sheet.iter().map(|p| [p[0] * c, p[0] * s, p[1]]));
        let own = |v: u32| if v.is_multiple_of(7) { v } else { v + k * 49 }; // the spine belongs to page 0
        triangles.extend(page.iter().map(|t| t.map(own)));
    }
    let source = 3 * 7 + 4;
    let all = distances(&points, &triangles, source);
    for k in 0..3u32 {
        for v in (0..49u32).filter(|v| !v.is_multiple_of(7)) {
            let p = sheet[v as usize];
            let expected = euclid([if k == 0 { p[0] } else { -p[0] }, p[1], 0.0], sheet[source as usize]);
            let d = all[(v + k * 49) as usize];
            assert!((d - expected).abs() < 1e-14, "page {k}, vertex {v}: {d} not {expected}");
        }
    }
}

#[test]
fn fans_that_share_one_vertex_are_connected_through_it() {
    let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [-1.0, 1.0, 0.0]];
    let all = distances(&points, &[[0, 1, 2], [0, 3, 4]], 2);
    assert_close(&all, &[SQRT_2, 1.0, 0.0, 1.0 + SQRT_2, 2.0 * SQRT_2], 1e-15);
}

#[test]
fn triangle_without_area_conducts() {
    // M lies on AB; the triangle A M B has no area and is the only link between the sides of AB.
    let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.4, 0.0, 0.0], [0.1, 0.9, 0.0], [0.8, -0.7, 0.0]];
    let triangles = [[0, 2, 3], [2, 1, 3], [0, 1, 2], [0, 4, 1]];
    for source in 0..5 {
        let expected: Vec<f64> = points.iter().map(|&p| euclid(p, points[source as usize])).collect();
        assert_close(&distances(&points, &triangles, source), &expected, 1e-13);
    }
}

#[test]
fn edge_without_length_conducts() {
    // Vertices 1 and 4 lie at one place and are joined by triangles without area.
    let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [2.0, 1.0, 0.0], [1.0, 0.0, 0.0]];
    let triangles = [[0, 1, 2], [1, 4, 2], [4, 3, 2]];
    let all = distances(&points, &triangles, 0);
    assert_close(&all, &[0.0, 1.0, 1.0, 5f64.sqrt(), 1.0], 1e-14);
    // The same place without such triangles is two places.
    assert_eq!(distances(&points, &[[0, 1, 2]], 0)[4], f64::INFINITY);
}

#[test]
fn unreferenced_vertices_and_other_components_are_unreachable() {
    let points =
        [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [f64::NAN; 3], [5.0; 3], [6.0, 5.0, 5.0], [5.0, 6.0, 5.0]];
    let triangles = [[0, 1, 2], [4, 5, 6]];
    let inf = f64::INFINITY;
    assert_eq!(distances(&points, &triangles, 0), [0.0, 1.0, 1.0, inf, inf, inf, inf]);
    assert_eq!(distances(&points, &triangles, 3), [inf, inf, inf, 0.0, inf, inf, inf]);
}

#[test]
fn several_sources_give_the_least_of_each() {
    let (points, triangles) = grid(12, rough);
    let sources = [(5, 0.3), (100, -0.2), (160, 0.0)];
    let listed: Vec<Source> = sources.iter().map(|&(v, offset)| Source::vertex(v).with_offset(offset)).collect();
    let together = field(&points, &triangles, &listed, &[]);
    let mut least = vec![f64::INFINITY; points.len()];
    for (v, offset) in sources {
        for (least, d) in least.iter_mut().zip(distances(&points, &triangles, v)) {
            *least = least.min(d + offset);
        }
    }
    assert_close(together.distances(), &least, 1e-14);
}

#[test]
fn symmetric_metric() {
    let (points, triangles) = grid(9, rough);
    let all: Vec<Vec<f64>> = (0..points.len() as u32).map(|v| distances(&points, &triangles, v)).collect();
    for a in 0..points.len() {
        for b in 0..a {
            assert!((all[a][b] - all[b][a]).abs() < 1e-14, "{a} and {b}");
            assert!(all[a][b] >= euclid(points[a], points[b]) * (1.0 - 1e-15), "{a} and {b}: shorter than straight");
            for c in (0..points.len()).step_by(7) {
                assert!(all[a][b] <= all[a][c] + all[c][b] + 1e-14, "{a}, {b} over {c}");
            }
        }
    }
}

#[test]
fn splitting_triangles_at_midpoints_changes_nothing() {
    let (points, triangles) = grid(7, rough);
    let coarse = distances(&points, &triangles, 10);
    let (points, fine) = subdivided(&points, &triangles);
    assert_close(&distances(&points, &fine, 10)[..coarse.len()], &coarse, 1e-14);
}

#[test]
fn orientation_and_numbering_do_not_matter() {
    let (points, triangles) = grid(11, rough);
    let plain = distances(&points, &triangles, 60);
    let mut random = Random(7);
    let mut flipped: Triangles = triangles
        .iter()
        .map(|&[a, b, c]| match (random.next() * 6.0) as u32 {
            0 => [a, b, c],
            1 => [b, c, a],
            2 => [c, a, b],
            3 => [b, a, c],
            4 => [a, c, b],
            _ => [c, b, a],
        })
        .collect();
    for i in (1..flipped.len()).rev() {
        flipped.swap(i, (random.next() * (i + 1) as f64) as usize);
    }
    assert_close(&distances(&points, &flipped, 60), &plain, 1e-14);
    let renumber = |v: u32| points.len() as u32 - 1 - v;
    let reversed: Points = points.iter().rev().copied().collect();
    let relabelled: Triangles = flipped.iter().map(|t| t.map(renumber)).collect();
    let mut mirrored = distances(&reversed, &relabelled, renumber(60));
    mirrored.reverse();
    assert_close(&mirrored, &plain, 1e-14);
}

#[test]
fn powers_of_two_scale_every_bit() {
    let (points, triangles) = grid(10, rough);
    let plain = distances(&points, &triangles, 3);
    for exponent in [-1000, -40, 7, 1000] {
        let scale = 2f64.powi(exponent);
        let scaled: Points = points.iter().map(|p| p.map(|x| x * scale)).collect();
        let expected: Vec<f64> = plain.iter().map(|d| d * scale).collect();
        assert_eq!(distances(&scaled, &triangles, 3), expected, "scale 2^{exponent}");
    }
}

#[test]
fn a_plane_so_far_away_that_its_units_overflow() {
    // One coordinate is 1e300, the same for all; the others extend over 1e-100.
    let (flat, triangles) = grid(4, |_, _| 0.0);
    let far: Points = flat.iter().map(|&[x, y, _]| [x * 1e-100, y * 1e-100, 1e300]).collect();
    let near: Points = far.iter().map(|&[x, y, _]| [x, y, 0.0]).collect();
    assert_eq!(distances(&far, &triangles, 3), distances(&near, &triangles, 3));
}

#[test]
fn targets_stop_early_with_final_distances() {
    let (points, triangles) = grid(40, rough);
    let full = field(&points, &triangles, &[Source::vertex(0)], &[]);
    let target = 5 * 41 + 5;
    let near = field(&points, &triangles, &[Source::vertex(0)], &[target]);
    assert_eq!(full.final_radius(), f64::INFINITY);
    assert!(near.windows() < full.windows() / 4, "{} of {} windows", near.windows(), full.windows());
    assert!(near.final_radius() >= full.distances()[target as usize]);
    for (d, f) in near.distances().iter().zip(full.distances()) {
        assert_eq!(*d, if *f <= near.final_radius() { *f } else { f64::INFINITY });
    }
}

#[test]
fn work_can_be_cancelled() {
    let (points, triangles) = grid(4, rough);
    let mesh = Mesh::from_triangles(&points, &triangles).unwrap();
    let control = Control::new();
    control.cancel();
    let result = ExactSolver::new(&mesh).unwrap().field(&[Source::vertex(0)], &ExactOptions::default(), &control);
    assert_eq!(result.unwrap_err().reason(), Reason::Cancelled);
}

#[test]
fn errors_name_the_source_or_target() {
    let (points, triangles) = grid(2, rough);
    let solver = ExactSolver::new(&Mesh::from_triangles(&points, &triangles).unwrap()).unwrap();
    let run = |sources: &[Source], targets: &[u32]| {
        let options =
            ExactOptions { targets: targets.iter().copied().map(Target::Vertex).collect(), ..ExactOptions::default() };
        let error = solver.field(sources, &options, &Control::new()).unwrap_err();
        (error.reason(), error.element())
    };
    let zero = || Source::vertex(0);
    assert_eq!(run(&[], &[]), (Reason::NoSource, None));
    assert_eq!(run(&[zero(), Source::vertex(9)], &[]), (Reason::VertexOutOfRange, Some(Element::Source(1))));
    let nan = zero().with_offset(f64::NAN);
    assert_eq!(run(&[zero(), zero(), nan], &[]), (Reason::BadArgument, Some(Element::Source(2))));
    assert_eq!(run(&[zero()], &[3, 9]), (Reason::VertexOutOfRange, Some(Element::Target(1))));
}

/// A soup of random triangles on few vertices, which lie on a coarse grid or anywhere: edges with many triangles, fans
/// that meet at a vertex, triangles without area, edges without length, coplanar and folded pairs are the rule.
fn soup(random: &mut Random) -> (Points, Triangles) {
    let vertices = 4 + (random.next() * 6.0) as u32;
    let faces = 1 + (random.next() * 12.0) as u32;
    let coarse = random.next() < 0.6;
    let coordinate = |random: &mut Random| if coarse { (random.next() * 3.0).floor() } else { random.next() };
    let points = (0..vertices).map(|_| [0; 3].map(|_| coordinate(random))).collect();
    let triangles = (0..faces).map(|_| [0; 3].map(|_| (random.next() * f64::from(vertices)) as u32)).collect();
    (points, triangles)
}

/// Every triangle cut into four at the midpoints of its edges; the first vertices are the old ones.
fn subdivided(points: &[[f64; 3]], triangles: &[[u32; 3]]) -> (Points, Triangles) {
    let mut points = points.to_vec();
    let mut middle = std::collections::HashMap::new();
    let mut fine = Triangles::new();
    for &[a, b, c] in triangles.iter().filter(|&&[a, b, c]| a != b && b != c && c != a) {
        let mut mid = |u: u32, v: u32| {
            *middle.entry((u.min(v), u.max(v))).or_insert_with(|| {
                points.push(std::array::from_fn(|k| 0.5 * (points[u as usize][k] + points[v as usize][k])));
                points.len() as u32 - 1
            })
        };
        let [ab, bc, ca] = [mid(a, b), mid(b, c), mid(c, a)];
        fine.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
    }
    (points, fine)
}

/// The work, which noise cannot touch: what rounding, flat places or a forgotten rule would multiply.
#[test]
fn windows_stay_few() {
    let windows = |mesh: &Mesh, source: u32| {
        let solver = ExactSolver::new(mesh).unwrap();
        let sources = [Source::vertex(source)];
        solver.field(&sources, &ExactOptions::default(), &Control::new()).unwrap().windows()
    };
    for (name, shape, most) in [
        ("grid", shapes::grid(100, 100), 31_000),
        ("terrain", shapes::terrain(60, 0.3), 66_000),
        ("torus", shapes::torus(96, 48, 1.0, 0.4), 205_000),
    ] {
        let found = windows(&shape.mesh().unwrap(), 7);
        assert!(found <= most, "{name}: {found} windows");
    }
    let Some(folder) = corpus() else { return };
    let bunny = Mesh::read(folder.join("bunny_stanford_unref.obj.gz")).unwrap();
    let found = windows(&bunny, 0);
    assert!(found <= 1_500_000, "bunny: {found} windows");
}

#[test]
fn random_soups_keep_the_invariants() {
    let mut random = Random(1);
    for case in 0..50_000 {
        let (points, triangles) = soup(&mut random);
        let n = points.len() as u32;
        let all: Vec<Vec<f64>> = (0..n).map(|v| distances(&points, &triangles, v)).collect();
        let close = |a: f64, b: f64| a == b || (a - b).abs() <= 1e-12;
        for a in 0..n as usize {
            for b in 0..n as usize {
                assert!(close(all[a][b], all[b][a]), "case {case}: {a}, {b}: {} and {}", all[a][b], all[b][a]);
                assert!(
                    all[a][b] >= euclid(points[a], points[b]) - 1e-12,
                    "case {case}: {a}, {b} shorter than straight"
                );
                for c in 0..n as usize {
                    assert!(all[a][b] <= all[a][c] + all[c][b] + 1e-12, "case {case}: {a}, {b} over {c}");
                }
            }
        }
        let (fine_points, fine) = subdivided(&points, &triangles);
        let finer = distances(&fine_points, &fine, 0);
        for b in 0..n as usize {
            assert!(close(all[0][b], finer[b]), "case {case}: 0 to {b}: {}, subdivided {}", all[0][b], finer[b]);
        }
    }
}
