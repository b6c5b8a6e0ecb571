//! Isolines of made-up fields and of distances, against segments that are found triangle by triangle.

mod common;

use common::corpus;
use std::collections::{HashMap, HashSet};
use std::f64::consts::PI;
use taut::shapes::{self, Shape};
use taut::{
    Control, Curve, Element, ExactOptions, ExactSolver, HeatOptions, HeatSolver, Isoline, MAX_LEVELS, Mesh, Reason,
    Source, SurfacePoint, even_levels, isolines, spaced_levels,
};

const INF: f64 = f64::INFINITY;

type Point = [f64; 3];

/// Also where squares overflow or vanish.
fn distance(p: Point, q: Point) -> f64 {
    let largest = p.iter().chain(&q).fold(f64::MIN_POSITIVE, |most, x| x.abs().max(most));
    let [x, y, z] = [0, 1, 2].map(|k| p[k] / largest - q[k] / largest);
    x.hypot(y).hypot(z) * largest
}

/// The field's values at the vertices, from a function of the position.
fn field(mesh: &Mesh, f: impl FnMut(Point) -> f64) -> Vec<f64> {
    mesh.positions().iter().copied().map(f).collect()
}

/// Pairs of neighbouring points.
fn segments<T: Copy>(points: &[T], is_closed: bool) -> Vec<[T; 2]> {
    let joined = is_closed.then(|| [points[points.len() - 1], points[0]]);
    points.windows(2).map(|pair| [pair[0], pair[1]]).chain(joined).collect()
}

fn length(mesh: &Mesh, curve: &Curve) -> f64 {
    let positions = curve.positions(mesh).unwrap();
    segments(&positions, curve.is_closed).iter().map(|&[p, q]| distance(p, q)).sum()
}

/// The witness: a mesh, a field on it, and how many triangles with lines each edge has.
struct Oracle<'a> {
    mesh: &'a Mesh,
    values: &'a [f64],
    triangles_at: HashMap<[u32; 2], usize>,
}

impl<'a> Oracle<'a> {
    fn new(mesh: &'a Mesh, values: &'a [f64]) -> Oracle<'a> {
        let mut oracle = Oracle { mesh, values, triangles_at: HashMap::new() };
        let all = 0..mesh.triangle_count();
        for f in all.filter(|&f| oracle.has_lines(f)).collect::<Vec<_>>() {
            for edge in edges(mesh.triangles()[f]) {
                *oracle.triangles_at.entry(edge).or_default() += 1;
            }
        }
        oracle
    }

    fn has_lines(&self, f: usize) -> bool {
        let [a, b, c] = self.mesh.triangles()[f];
        a != b && b != c && c != a && [a, b, c].iter().all(|&v| self.values[v as usize].is_finite())
    }

    /// Whether lines never end: each edge has two triangles.
    fn is_closed(&self) -> bool {
        self.triangles_at.values().all(|&count| count == 2)
    }

    fn is_crossed(&self, [a, b]: [u32; 2], level: f64) -> bool {
        (self.values[a as usize] >= level) != (self.values[b as usize] >= level)
    }

    /// Where the level crosses the two edges of each triangle that it crosses.
    fn segments(&self, level: f64) -> HashMap<u32, Vec<Point>> {
        let mut found = HashMap::new();
        for f in (0..self.mesh.triangle_count()).filter(|&f| self.has_lines(f)) {
            let crossed = edges(self.mesh.triangles()[f]).into_iter().filter(|&edge| self.is_crossed(edge, level));
            let ends: Vec<Point> = crossed.map(|edge| self.crossing(edge, level)).collect();
            if !ends.is_empty() {
                assert_eq!(ends.len(), 2);
                found.insert(f as u32, ends);
            }
        }
        found
    }

    fn crossing(&self, [a, b]: [u32; 2], level: f64) -> Point {
        let [u, w] = [a, b].map(|v| self.values[v as usize]);
        let scale = if u.abs().max(w.abs()) > 1.0 { 0.25 } else { 4.0 };
        let t = ((scale * level - scale * u) / (scale * w - scale * u)).clamp(0.0, 1.0);
        let [p, q] = [a, b].map(|v| self.mesh.positions()[v as usize]);
        [0, 1, 2].map(|k| (1.0 - t) * p[k] + t * q[k])
    }

    /// What holds for the lines of any field on any mesh.
    fn check(&self, name: &str, levels: &[f64], lines: &[Isoline]) {
        assert!(lines.is_sorted_by_key(|line| line.level), "{name}");
        let size =
            self.mesh.positions().iter().flatten().filter(|x| x.is_finite()).fold(0.0, |m: f64, x| m.max(x.abs()));
        for (i, &level) in (0..).zip(levels) {
            let name = format!("{name}, level {level}");
            let mut open = self.segments(level);
            let ends = self.ends(level);
            for curve in lines.iter().filter(|line| line.level == i).map(|line| &line.curve) {
                assert!(curve.points.len() >= 2, "{name}");
                assert!(curve.is_closed || !self.is_closed(), "{name}: a line ends");
                curve.points.iter().for_each(|point| self.check_point(&name, point, level));
                let positions = curve.positions(self.mesh).unwrap();
                if let ([first, .., last], false) = (&positions[..], curve.is_closed) {
                    let is_end = |p: Point| ends.iter().any(|&end| distance(p, end) <= 1e-12 * size);
                    assert!(is_end(*first) && is_end(*last), "{name}: a line ends inside");
                }
                for (point, [p, q]) in curve.points.iter().zip(segments(&positions, curve.is_closed)) {
                    assert_ne!(p, q, "{name}: repeated point");
                    let ends = open.remove(&point.face).unwrap_or_else(|| panic!("{name}: face {}", point.face));
                    let gap = |[a, b]: [usize; 2]| distance(p, ends[a]).max(distance(q, ends[b]));
                    assert!(gap([0, 1]).min(gap([1, 0])) <= 1e-12 * size, "{name}: not in face {}", point.face);
                }
            }
            for (f, ends) in open {
                assert!(distance(ends[0], ends[1]) <= 1e-12 * size, "{name}: no line in face {f}");
            }
        }
    }

    fn check_point(&self, name: &str, point: &SurfacePoint, level: f64) {
        let w = point.barycentric;
        assert!(self.has_lines(point.face as usize), "{name}");
        assert!(w.contains(&0.0), "{name}: {w:?} is not on an edge");
        assert!(w.iter().all(|w| (0.0..=1.0).contains(w)) && w[0] + w[1] + w[2] == 1.0, "{name}: {w:?}");
        let corners = self.mesh.triangles()[point.face as usize].map(|v| self.values[v as usize]);
        let value: f64 = w.iter().zip(corners).map(|(w, u)| w * u).sum();
        let largest = corners.iter().fold(0.0, |m: f64, u| m.max(u.abs()));
        assert!((value - level).abs() <= 4.0 * f64::EPSILON * largest + f64::MIN_POSITIVE, "{name}: {value}");
    }

    /// Where open lines can end: on edges where not exactly two triangles with lines meet.
    fn ends(&self, level: f64) -> Vec<Point> {
        let crossed = self.triangles_at.iter().filter(|(edge, count)| **count != 2 && self.is_crossed(**edge, level));
        crossed.map(|(&edge, _)| self.crossing(edge, level)).collect()
    }
}

fn edges([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]].map(|[a, b]| [a.min(b), a.max(b)])
}

/// The lines, checked against the witness.
#[track_caller]
fn lines(name: &str, mesh: &Mesh, values: &[f64], levels: &[f64]) -> Vec<Isoline> {
    let found = isolines(mesh, values, levels).unwrap();
    Oracle::new(mesh, values).check(name, levels, &found);
    found
}

fn heat(mesh: &Mesh, source: u32) -> Vec<f64> {
    let control = Control::new();
    let solver = HeatSolver::new(mesh, &HeatOptions::default(), &control).unwrap();
    solver.field(&[Source::vertex(source)], &control).unwrap().into_distances()
}

/// Numbers that look random.
struct Random(u64);

impl Random {
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % bound
    }

    fn permutation(&mut self, n: usize) -> Vec<usize> {
        let mut order: Vec<usize> = (0..n).collect();
        (1..n).for_each(|i| order.swap(i, self.below(i + 1)));
        order
    }
}

#[test]
fn lines_on_closed_shapes_are_loops_with_a_point_on_each_crossed_edge() {
    for (name, shape) in [("sphere", shapes::icosphere(4)), ("torus", shapes::torus(60, 30, 2.0, 0.7))] {
        let mesh = shape.mesh().unwrap();
        let values = field(&mesh, |[x, y, z]| x + 0.3 * y * y - 0.7 * z * x);
        let levels = even_levels(&mesh, &values, 9).unwrap();
        let found = lines(name, &mesh, &values, &levels);
        let oracle = Oracle::new(&mesh, &values);
        for (i, &level) in (0..).zip(&levels) {
            let crossed = oracle.triangles_at.keys().filter(|&&edge| oracle.is_crossed(edge, level)).count();
            let of_level = found.iter().filter(|line| line.level == i);
            assert_eq!(of_level.map(|line| line.curve.points.len()).sum::<usize>(), crossed, "{name}, {level}");
        }
        assert!(found.len() >= levels.len());
    }
}

#[test]
fn higher_ground_is_on_the_left() {
    let mesh = shapes::icosphere(3).mesh().unwrap();
    let values = field(&mesh, |[x, y, z]| x * y + z);
    for line in lines("sphere", &mesh, &values, &[-0.4, 0.1, 0.51]) {
        let positions = line.curve.positions(&mesh).unwrap();
        for (point, [p, q]) in line.curve.points.iter().zip(segments(&positions, true)) {
            // On the left of p -> q, seen from outside the sphere, lies p × (q - p) = p × q.
            let left = [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
            let level = [-0.4, 0.1, 0.51][line.level as usize];
            for v in mesh.triangles()[point.face as usize] {
                let corner = mesh.positions()[v as usize];
                let side: f64 = (0..3).map(|k| (corner[k] - p[k]) * left[k]).sum();
                assert_eq!(side > 0.0, values[v as usize] > level);
            }
        }
    }
}

#[test]
fn distance_circles_on_a_flat_grid_have_the_length_of_circles() {
    let error = |squares: u32| {
        let mesh = shapes::grid(squares, squares).mesh().unwrap();
        let source = [Source::vertex(0)];
        let field = ExactSolver::new(&mesh).unwrap().field(&source, &ExactOptions::default(), &Control::new()).unwrap();
        let radii = [0.3, 0.55, 0.9].map(|share| share * f64::from(squares));
        let found = lines("grid", &mesh, field.distances(), &radii);
        assert!(found.len() == 3 && found.iter().all(|line| !line.curve.is_closed));
        let off = found.iter().zip(radii).map(|(line, r)| (length(&mesh, &line.curve) / (0.5 * PI * r) - 1.0).abs());
        off.fold(0.0, f64::max)
    };
    let [coarse, middle, fine] = [error(16), error(32), error(64)];
    assert!(coarse < 4e-3 && middle < coarse / 3.0 && fine < middle / 3.0, "{coarse} {middle} {fine}");
}

/// The lines as sets of points: by level, whether closed, and position.
fn as_sets(mesh: &Mesh, found: &[Isoline]) -> HashSet<(u32, bool, Vec<[u64; 3]>)> {
    let set = |line: &Isoline| {
        let positions = line.curve.positions(mesh).unwrap();
        let mut bits: Vec<[u64; 3]> = positions.iter().map(|p| p.map(f64::to_bits)).collect();
        bits.sort_unstable();
        (line.level, line.curve.is_closed, bits)
    };
    found.iter().map(set).collect()
}

#[test]
fn the_names_of_vertices_and_triangles_do_not_matter() {
    let mut random = Random(5);
    for shape in [shapes::saddle(12), shapes::torus(12, 9, 2.0, 0.7), shapes::icosphere(2)] {
        let mesh = shape.mesh().unwrap();
        let values = field(&mesh, |[x, y, z]| (2.0 * x).floor() + y - z * z);
        let levels = [-2.0, -0.25, 0.3, 1.0];
        let expected = as_sets(&mesh, &lines("as it is", &mesh, &values, &levels));
        for _ in 0..10 {
            let new_to_old = random.permutation(values.len());
            let mut old_to_new = vec![0; values.len()];
            (0..).zip(&new_to_old).for_each(|(new, &old)| old_to_new[old] = new);
            // Renamed, in another order, begun at another corner, and some turned over.
            let triangles = random.permutation(shape.triangles.len()).into_iter().map(|f| {
                let mut triangle = shape.triangles[f].map(|v| old_to_new[v as usize]);
                triangle.rotate_left(random.below(3));
                if random.below(2) == 0 {
                    triangle.reverse();
                }
                triangle
            });
            let triangles: Vec<[u32; 3]> = triangles.collect();
            let positions: Vec<Point> = new_to_old.iter().map(|&old| shape.positions[old]).collect();
            let renamed = Mesh::from_triangles(&positions, &triangles).unwrap();
            let values: Vec<f64> = new_to_old.iter().map(|&old| values[old]).collect();
            let found = lines("renamed", &renamed, &values, &levels);
            assert_eq!(as_sets(&renamed, &found), expected);
        }
    }
}

#[test]
fn a_level_through_vertices_has_each_point_once() {
    let mesh = shapes::grid(4, 3).mesh().unwrap();
    let found = lines("columns", &mesh, &field(&mesh, |[x, ..]| x), &[2.0]);
    assert_eq!(found.len(), 1);
    let expected = [[2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [2.0, 2.0, 0.0], [2.0, 3.0, 0.0]];
    let mut positions = found[0].curve.positions(&mesh).unwrap();
    positions.sort_by(|p, q| p[1].total_cmp(&q[1]));
    assert_eq!(positions, expected);
    // A vertex has two weights of 0.
    assert!(found[0].curve.points.iter().all(|point| point.barycentric.contains(&1.0)));
}

/// That each line is a source: the segment from a point to the next one lies in a triangle.
#[track_caller]
fn check_as_sources(mesh: &Mesh, found: Vec<Isoline>) {
    let solver = ExactSolver::new(mesh).unwrap();
    let near = ExactOptions { radius: 0.0, ..Default::default() };
    for line in found {
        solver.field(&[Source::curve(line.curve)], &near, &Control::new()).unwrap();
    }
}

#[test]
fn lines_within_rounding_of_vertices_are_sources() {
    let mut random = Random(7);
    for (name, shape) in
        [("grid", shapes::grid(12, 12)), ("sphere", shapes::icosphere(3)), ("saddle", shapes::saddle(9))]
    {
        let mesh = shape.mesh().unwrap();
        let largest = mesh.positions().iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
        for _ in 0..20 {
            // Steps of a quarter, each off by a few units in the last place, more or fewer.
            let mut off = || 10f64.powi(-(random.below(6) as i32) - 13) * (random.below(9) as f64 - 4.0);
            let values: Vec<f64> = field(&mesh, |[x, y, _]| ((x + 0.5 * y) / largest * 4.0).round() / 4.0);
            let values: Vec<f64> = values.iter().map(|u| u * (1.0 + off())).collect();
            check_as_sources(&mesh, lines(name, &mesh, &values, &[-0.5, -0.25, 0.0, 0.25, 0.5, 0.75]));
        }
    }
}

#[test]
fn distances_from_a_line_beside_vertices_are_straight() {
    let mesh = shapes::grid(12, 12).mesh().unwrap();
    let mut random = Random(3);
    let values = field(&mesh, |[x, ..]| x * (1.0 + 1e-16 * random.below(9) as f64));
    let line = lines("columns", &mesh, &values, &[5.0]).remove(0);
    let source = Source::curve(line.curve);
    let found = ExactSolver::new(&mesh).unwrap().field(&[source], &ExactOptions::default(), &Control::new()).unwrap();
    for (d, [x, ..]) in found.distances().iter().zip(mesh.positions()) {
        assert!((d - (x - 5.0).abs()).abs() < 1e-14, "{d} at {x}");
    }
}

#[test]
fn lines_over_triangles_without_area_are_sources() {
    // A strip of triangles, some of them without area.
    let mut random = Random(11);
    for _ in 0..200 {
        let positions: Vec<Point> =
            (0..30).map(|i| [f64::from(i / 2), random.below(2) as f64 * f64::from(i % 2), 0.0]).collect();
        let strip: Vec<[u32; 3]> =
            (0..28).map(|i| if i % 2 == 0 { [i, i + 1, i + 2] } else { [i + 1, i, i + 2] }).collect();
        let mesh = Mesh::from_triangles(&positions, &strip).unwrap();
        let values: Vec<f64> = (0..30).map(|_| random.below(5) as f64 / 4.0).collect();
        check_as_sources(&mesh, isolines(&mesh, &values, &[0.125, 0.25, 0.5, 0.625]).unwrap());
    }
}

#[test]
fn a_plateau_has_a_line_towards_lower_ground_only() {
    let mesh = shapes::grid(6, 6).mesh().unwrap();
    let height = |p: Point| (p[0] - 3.0).abs().max((p[1] - 3.0).abs());
    // A hill and a pit with the floor |x|, |y| ≤ 1 around the middle.
    let hill = field(&mesh, |p| -height(p).max(1.0));
    let pit = field(&mesh, |p| height(p).max(1.0));
    let border = lines("hill", &mesh, &hill, &[-1.0]);
    assert_eq!(border.len(), 1);
    assert!(border[0].curve.is_closed);
    assert_eq!(length(&mesh, &border[0].curve), 8.0);
    assert_eq!(lines("pit", &mesh, &pit, &[1.0]), []);
    // A level that everything has, and one that a peak alone has.
    assert_eq!(lines("flat", &mesh, &vec![1.0; mesh.vertex_count()], &[1.0]), []);
    assert_eq!(lines("peak", &mesh, &field(&mesh, |p| -height(p)), &[0.0]), []);
    // A ridge from (3, 2) to (3, 4): there and back.
    let ridge = field(&mesh, |[x, y, _]| if x == 3.0 && (2.0..=4.0).contains(&y) { 1.0 } else { 0.0 });
    let around = lines("ridge", &mesh, &ridge, &[1.0]);
    assert!(around.len() == 1 && around[0].curve.is_closed);
    assert_eq!(length(&mesh, &around[0].curve), 4.0);
}

#[test]
fn lines_branch_where_three_triangles_meet() {
    // Three triangles on the edge from 0 to 1, and the field its height.
    let positions = [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.5], [-1.0, 1.0, 0.5], [-1.0, -1.0, 0.5]];
    let mesh = Mesh::from_triangles(&positions, &[[0, 1, 2], [1, 0, 3], [0, 1, 4]]).unwrap();
    let found = lines("fan", &mesh, &field(&mesh, |p| p[2]), &[0.25]);
    assert_eq!(found.len(), 3);
    for line in &found {
        let ends = line.curve.positions(&mesh).unwrap();
        assert!(ends.len() == 2 && ends.contains(&[0.0, 0.0, 0.25]), "{ends:?}");
    }
    // With a corner of the third that has no value, the line goes on over the edge.
    let values = [0.0, 1.0, 0.5, 0.5, INF];
    let found = lines("fan without a leaf", &mesh, &values, &[0.25]);
    assert!(found.len() == 1 && found[0].curve.points.len() == 3);
}

#[test]
fn a_line_that_returns_to_a_branch_is_closed() {
    // A tetrahedron with a fin on the edge from 0 to 3.
    let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [-1.0, -1.0, 0.0]];
    let triangles = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3], [0, 3, 4]];
    let mesh = Mesh::from_triangles(&positions, &triangles).unwrap();
    let found = lines("fin", &mesh, &field(&mesh, |p| p[2]), &[0.5]);
    let shapes: Vec<(usize, bool)> = found.iter().map(|line| (line.curve.points.len(), line.curve.is_closed)).collect();
    assert_eq!(shapes, [(3, true), (2, false)]);
}

#[test]
fn lines_end_beside_what_is_not_finite() {
    let mesh = shapes::grid(10, 10).mesh().unwrap();
    for bad in [INF, -INF, f64::NAN] {
        let values = field(&mesh, |[x, y, _]| if x < 4.0 { y } else { bad });
        let found = lines("half", &mesh, &values, &[2.5, 5.0]);
        assert_eq!(found.len(), 2, "{bad}");
        for line in found {
            assert!(line.curve.positions(&mesh).unwrap().iter().all(|p| p[0] <= 3.0), "{bad}");
        }
        assert_eq!(even_levels(&mesh, &values, 1).unwrap(), [5.0]);
        let nothing = vec![bad; mesh.vertex_count()];
        assert_eq!(lines("nothing", &mesh, &nothing, &[0.0]), []);
        assert_eq!(even_levels(&mesh, &nothing, 3).unwrap(), [0.0; 0]);
        assert_eq!(spaced_levels(&mesh, &nothing, 3.0).unwrap(), [0.0; 0]);
    }
}

#[test]
fn each_level_has_the_lines_that_it_has_alone() {
    let mesh = shapes::saddle(9).mesh().unwrap();
    let values = field(&mesh, |p| p[2]);
    let levels = [0.5, -0.25, 0.5, 7.0, 0.0];
    let together = lines("together", &mesh, &values, &levels);
    let mut one_by_one = Vec::new();
    for (level, value) in (0..).zip(levels) {
        let alone = isolines(&mesh, &values, &[value]).unwrap();
        one_by_one.extend(alone.into_iter().map(|line| Isoline { level, ..line }));
    }
    assert_eq!(together, one_by_one);
}

#[test]
fn lines_begin_where_the_manual_says() {
    let mesh = shapes::icosphere(2).mesh().unwrap();
    let found = lines("sphere", &mesh, &field(&mesh, |[x, y, z]| x * y * z), &[0.1]);
    let first: Vec<u32> = found.iter().map(|line| line.curve.points[0].face).collect();
    let least: Vec<u32> =
        found.iter().map(|line| line.curve.points.iter().map(|point| point.face).min().unwrap()).collect();
    assert!(first.len() == 4 && first == least && first.is_sorted(), "{first:?}");
}

#[test]
fn numbers_of_any_size_are_interpolated() {
    let flat = shapes::grid(2, 2);
    for (size, height) in [(1e308, 1e308), (1e-300, 1e-320), (1.0, 1e308), (1e308, 5e-324), (0.0, 1.0)] {
        let positions: Vec<Point> = flat.positions.iter().map(|p| p.map(|x| (x - 1.0) * size)).collect();
        let mesh = Mesh::from_triangles(&positions, &flat.triangles).unwrap();
        let values: Vec<f64> = flat.positions.iter().map(|p| (p[0] - 1.0) * height).collect();
        let levels = even_levels(&mesh, &values, 3).unwrap();
        let found = lines("sizes", &mesh, &values, &levels);
        for line in &found {
            for p in line.curve.positions(&mesh).unwrap() {
                assert!(p.iter().all(|x| x.abs() <= size), "{p:?}");
                let expected = size * (levels[line.level as usize] / height);
                assert!((p[0] / 2.0 - expected / 2.0).abs() <= 1e-15 * size, "{p:?} {expected}");
            }
        }
        // Where all vertices are in one place, lines shrink to points.
        assert_eq!(found.is_empty(), size == 0.0, "{size} {height}");
    }
}

#[test]
fn an_edge_may_span_all_numbers() {
    let mesh = shapes::grid(1, 1).mesh().unwrap();
    let values = field(&mesh, |[x, ..]| if x == 0.0 { -f64::MAX } else { f64::MAX });
    let levels = [-0.5 * f64::MAX, 0.0, 0.5 * f64::MAX];
    let found = lines("the widest edge", &mesh, &values, &levels);
    for (line, x) in found.iter().zip([0.25, 0.5, 0.75]) {
        assert!(line.curve.positions(&mesh).unwrap().iter().all(|p| p[0] == x));
    }
}

#[test]
fn small_weights_keep_their_digits() {
    let mesh = shapes::grid(1, 1).mesh().unwrap();
    for [left, right, level] in [[0.0, 1.0, 1e-20], [-1.0, 0.0, -1e-20], [1.0, 0.0, 1e-20], [0.0, -1.0, -1e-20]] {
        let values = field(&mesh, |[x, ..]| if x == 0.0 { left } else { right });
        for line in isolines(&mesh, &values, &[level]).unwrap() {
            assert!(line.curve.points.iter().all(|point| point.barycentric.contains(&1e-20)), "{line:?}");
        }
    }
}

#[test]
fn lines_stay_on_flat_ground() {
    let mut shape = shapes::grid(10, 10);
    shape.positions.iter_mut().for_each(|p| p[2] = 0.1);
    let mesh = shape.mesh().unwrap();
    let values = field(&mesh, |[x, y, _]| x.sin() + y / 3.0);
    for line in lines("flat", &mesh, &values, &even_levels(&mesh, &values, 30).unwrap()) {
        assert!(line.curve.positions(&mesh).unwrap().iter().all(|p| p[2] == 0.1));
    }
}

#[test]
fn both_triangles_of_an_edge_agree_to_the_last_bit() {
    let mesh = shapes::terrain(20, 0.8).mesh().unwrap();
    let [plain, turned] = [0, 1].map(|turn| {
        let triangles: Vec<[u32; 3]> = mesh.triangles().iter().map(|&[a, b, c]| [[a, b, c], [b, a, c]][turn]).collect();
        Mesh::from_triangles(mesh.positions(), &triangles).unwrap()
    });
    let values = field(&mesh, |[x, y, z]| z / 3.0 + x * y);
    let levels = even_levels(&mesh, &values, 20).unwrap();
    let [plain, turned] = [&plain, &turned].map(|mesh| as_sets(mesh, &isolines(mesh, &values, &levels).unwrap()));
    assert_eq!(plain, turned);
}

#[test]
fn levels_are_picked_inside_the_range() {
    let mesh = shapes::grid(4, 1).mesh().unwrap();
    let values = field(&mesh, |[x, ..]| 10.0 * x - 20.0);
    assert_eq!(even_levels(&mesh, &values, 3).unwrap(), [-10.0, 0.0, 10.0]);
    assert_eq!(even_levels(&mesh, &values, 0).unwrap(), [0.0; 0]);
    assert_eq!(spaced_levels(&mesh, &values, 8.0).unwrap(), [-16.0, -8.0, 0.0, 8.0, 16.0]);
    assert_eq!(spaced_levels(&mesh, &values, 10.0).unwrap(), [-10.0, 0.0, 10.0]);
    assert_eq!(spaced_levels(&mesh, &values, 1e300).unwrap(), [0.0]);
    assert_eq!(even_levels(&mesh, &values, MAX_LEVELS).unwrap().len(), MAX_LEVELS);
    assert_eq!(spaced_levels(&mesh, &values, 40.0 / MAX_LEVELS as f64).unwrap().len(), MAX_LEVELS - 1);

    let flat = vec![3.0; values.len()];
    assert_eq!(even_levels(&mesh, &flat, 3).unwrap(), [0.0; 0]);
    assert_eq!(spaced_levels(&mesh, &flat, 1.0).unwrap(), [0.0; 0]);
    // Only one number lies between 1 and 1 + 2ε.
    let narrow: Vec<f64> = values.iter().map(|&u| if u > 0.0 { 1.0 + 2.0 * f64::EPSILON } else { 1.0 }).collect();
    assert_eq!(even_levels(&mesh, &narrow, 5).unwrap(), [1.0 + f64::EPSILON]);
    let wide: Vec<f64> = values.iter().map(|&u| if u > 0.0 { f64::MAX } else { -f64::MAX }).collect();
    assert_eq!(even_levels(&mesh, &wide, 1).unwrap(), [0.0]);
    assert_eq!(spaced_levels(&mesh, &wide, 1e308).unwrap(), [-1e308, 0.0, 1e308]);
}

#[test]
fn the_values_of_vertices_without_triangles_do_not_count() {
    let positions = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [f64::NAN; 3]];
    let mesh = Mesh::from_triangles(&positions, &[[0, 1, 2], [3, 3, 0]]).unwrap();
    let values = [0.0, 1.0, 1.0, 1e9];
    let levels = even_levels(&mesh, &values, 1).unwrap();
    assert_eq!(levels, [0.5]);
    assert_eq!(lines("one triangle", &mesh, &values, &levels).len(), 1);
}

#[test]
fn what_makes_no_sense_is_refused() {
    let mesh = shapes::grid(2, 2).mesh().unwrap();
    let values = vec![0.0; 9];
    let error = isolines(&mesh, &values[1..], &[0.5]).unwrap_err();
    assert_eq!(
        (error.reason(), error.to_string().as_str()),
        (Reason::BadArgument, "there are 8 values, but the mesh has 9 vertices")
    );
    for bad in [f64::NAN, INF, -INF] {
        let error = isolines(&mesh, &values, &[0.5, bad]).unwrap_err();
        assert_eq!((error.reason(), error.element()), (Reason::BadArgument, Some(Element::Level(1))));
    }
    let slope = field(&mesh, |p| p[0]);
    let too_many = 2.0 / (MAX_LEVELS as f64 + 2.0);
    for bad in [0.0, -1.0, f64::NAN, INF, 5e-324, 1e-9, too_many] {
        assert_eq!(spaced_levels(&mesh, &slope, bad).unwrap_err().reason(), Reason::BadArgument, "{bad}");
    }
    for bad in [MAX_LEVELS + 1, usize::MAX] {
        assert_eq!(even_levels(&mesh, &slope, bad).unwrap_err().reason(), Reason::BadArgument);
    }
    let nowhere = SurfacePoint { face: 8, barycentric: [1.0, 0.0, 0.0] };
    assert_eq!(nowhere.position(&mesh).unwrap_err().element(), Some(Element::Face(8)));
}

#[test]
fn nothing_has_no_lines() {
    let mesh = Mesh::from_triangles(&[], &[]).unwrap();
    assert_eq!(isolines(&mesh, &[], &[1.0]).unwrap(), []);
    assert_eq!(even_levels(&mesh, &[], 3).unwrap(), [0.0; 0]);
    let sphere = shapes::icosphere(1).mesh().unwrap();
    assert_eq!(isolines(&sphere, &vec![1.0; sphere.vertex_count()], &[]).unwrap(), []);
}

/// Few vertices, many triangles of all kinds, few values: every special case at once.
#[test]
fn random_soups_have_sound_lines() {
    let mut random = Random(1);
    for case in 0..4000 {
        let vertices = 3 + random.below(8);
        let positions: Vec<Point> = (0..vertices).map(|_| [0; 3].map(|_| random.below(4) as f64)).collect();
        let triangles: Vec<[u32; 3]> =
            (0..1 + random.below(16)).map(|_| [0; 3].map(|_| random.below(vertices) as u32)).collect();
        let mesh = Mesh::from_triangles(&positions, &triangles).unwrap();
        let steps = [0.0, 1.0, 2.0, 3.0, 3.0 + 4.0 * f64::EPSILON, INF, f64::NAN];
        let kinds = if random.below(2) == 0 { 4 } else { steps.len() };
        let values: Vec<f64> = (0..vertices).map(|_| steps[random.below(kinds)]).collect();
        lines(&format!("soup {case}"), &mesh, &values, &[0.0, 0.5, 1.0, 1.7, 2.0, 3.0, 3.0 + 2.0 * f64::EPSILON]);
    }
}

#[test]
fn cylinders_keep_the_lengths_of_their_rims() {
    let Shape { positions, triangles } = shapes::cylinder(24, 10, 3.0);
    let mesh = Mesh::from_triangles(&positions, &triangles).unwrap();
    let values = heat(&mesh, 0);
    let rim = 48.0 * (PI / 24.0).sin();
    for line in lines("height", &mesh, &field(&mesh, |p| p[2]), &[0.1, 0.3, 1.55]) {
        assert!(line.curve.is_closed && (length(&mesh, &line.curve) / rim - 1.0).abs() < 1e-14);
    }
    lines("heat", &mesh, &values, &even_levels(&mesh, &values, 30).unwrap());
}

#[test]
fn the_lines_of_distances_are_sound_on_real_meshes() {
    let Some(folder) = corpus() else { return };
    let mut seen = 0;
    let mut paths: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    for path in paths.iter().filter(|path| path.extension().is_some_and(|extension| extension != "tsv")) {
        let Ok(mesh) = Mesh::read(path) else { continue };
        if mesh.triangle_count() < 30_000 {
            let name = path.file_name().unwrap().to_string_lossy();
            let values = heat(&mesh, mesh.triangles()[0][0]);
            let mut levels = even_levels(&mesh, &values, 7).unwrap();
            levels.extend(values.iter().find(|value| value.is_finite() && **value > levels[3])); // through a vertex
            lines(&name, &mesh, &values, &levels);
            seen += 1;
        }
    }
    assert!(seen > 30, "only {seen} meshes");
}
