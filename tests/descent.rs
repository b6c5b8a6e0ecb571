//! Paths of steepest descent on distances of both methods and on made-up fields.

#[path = "common/bad.rs"]
mod bad;
mod common;
#[path = "common/places.rs"]
mod places;
#[path = "common/segments.rs"]
mod segments;

use bad::bad_meshes;
use common::corpus;
use places::{Random, euclid, field};
use segments::{is_in, length};
use taut::{
    Control, Curve, DescentPath, Element, HeatOptions, HeatSolver, Mesh, Reason, Source, SurfacePoint, Target,
    descent_paths, shapes,
};

const INF: f64 = f64::INFINITY;

fn exact(mesh: &Mesh, sources: &[Source]) -> Vec<f64> {
    field(mesh, sources).distances().to_vec()
}

fn heat(mesh: &Mesh, sources: &[Source]) -> Vec<f64> {
    let solver = HeatSolver::new(mesh, &HeatOptions::default(), &Control::new()).unwrap();
    solver.field(sources, &Control::new()).unwrap().into_distances()
}

/// The value at a point.
fn value(mesh: &Mesh, values: &[f64], point: &SurfacePoint) -> f64 {
    let corners = mesh.triangles()[point.face as usize].map(|v| values[v as usize]);
    (0..3).filter(|&k| point.barycentric[k] != 0.0).map(|k| point.barycentric[k] * corners[k]).sum()
}

fn is_vertex(point: &SurfacePoint) -> bool {
    point.barycentric.contains(&1.0)
}

/// What holds for each path on any field: it runs from triangle to triangle, falls, and ends at a source or where no
/// neighbour is lower.
#[track_caller]
fn check(what: &str, mesh: &Mesh, values: &[f64], path: &DescentPath) {
    check_way(what, mesh, values, path);
    let largest = values.iter().filter(|u| u.is_finite()).fold(0.0, |most: f64, u| most.max(u.abs()));
    let fell: Vec<f64> = path.curve.points.iter().map(|point| value(mesh, values, point)).collect();
    // The value at a source is its start distance, not that of the field.
    let end = fell.len() - usize::from(path.source.is_some());
    for i in 1..end {
        assert!(fell[i] <= fell[i - 1] + 4.0 * f64::EPSILON * largest, "{what}: rises to point {i}");
        assert!(fell[i] < fell[i - 1] || is_vertex(&path.curve.points[i]), "{what}: level to point {i}");
    }
}

/// What holds also where a path goes over a pass.
#[track_caller]
fn check_way(what: &str, mesh: &Mesh, values: &[f64], path: &DescentPath) {
    let Curve { points, is_closed } = &path.curve;
    let positions = path.curve.positions(mesh).unwrap();
    assert!(!is_closed && points.len() <= 1 + mesh.vertex_count() + mesh.triangle_count(), "{what}");
    let is_shared = |i: usize| mesh.positions().iter().filter(|p| **p == positions[i]).count() > 1;
    for i in 1..points.len() {
        assert!(is_in(mesh, &points[i], points[i - 1].face), "{what}: segment {i} leaves its triangle");
        assert_ne!(positions[i - 1], positions[i], "{what}: point {i} twice");
        let is_end = path.source.is_some() && i + 1 == points.len();
        let weights = points[i].barycentric;
        assert!(is_end || weights.contains(&0.0) && weights.iter().sum::<f64>() == 1.0, "{what}: {weights:?}");
    }
    if let [.., before, last] = &points[..] {
        assert_eq!(before.face, last.face, "{what}: the last point names another triangle");
    }
    // Of several vertices in one place any may be the end.
    if path.source.is_none() && !is_shared(points.len() - 1) {
        let last = &points[points.len() - 1];
        let k = (0..3).find(|&k| last.barycentric[k] == 1.0).unwrap_or_else(|| panic!("{what}: ends at no vertex"));
        let v = mesh.triangles()[last.face as usize][k];
        let around = mesh.triangles().iter().filter(|[a, b, c]| a != b && b != c && c != a).filter(|t| t.contains(&v));
        let lower = around.flatten().find(|&&w| (f64::MIN..values[v as usize]).contains(&values[w as usize]));
        assert_eq!(lower, None, "{what}: ends at {v}");
    }
}

fn vertices(mesh: &Mesh, step: usize) -> Vec<Target> {
    (0..mesh.vertex_count() as u32).step_by(step).map(Target::Vertex).collect()
}

/// Paths from vertices and points, all of which find a source; each over the exact distance, less 1, in descending order.
fn excesses(what: &str, mesh: &Mesh, sources: &[Source], values: &[f64], seed: u64) -> Vec<f64> {
    let mut random = Random(seed);
    let points = (0..200).map(|_| Target::Point(random.point(mesh)));
    let targets: Vec<Target> = vertices(mesh, 1 + mesh.vertex_count() / 500).into_iter().chain(points).collect();
    let exact = field(mesh, sources);
    let paths = descent_paths(mesh, values, sources, &targets, &Control::new()).unwrap();
    let mut excesses = Vec::new();
    for (target, path) in targets.iter().zip(&paths) {
        let path = path.as_ref().unwrap();
        check_way(what, mesh, values, path);
        let end = path.curve.positions(mesh).unwrap()[path.curve.points.len() - 1];
        let source = sources[path.source.expect(what) as usize].positions(mesh).unwrap();
        assert!(source.len() > 1 || euclid(source[0], end) <= 1e-14, "{what}: ends beside its source");
        let distance = exact.distance(*target).unwrap();
        let length = length(mesh, &path.curve);
        assert!(length >= distance * (1.0 - 1e-12), "{what}: {length} is shorter than the distance {distance}");
        if distance > 0.0 {
            excesses.push(length / distance - 1.0);
        }
    }
    excesses.sort_by(|a, b| b.total_cmp(a));
    excesses
}

/// The mean excess and the hundredth part that is beyond.
#[track_caller]
fn assert_short(what: &str, excesses: &[f64], [mean, most]: [f64; 2]) {
    let found = [excesses.iter().sum::<f64>() / excesses.len() as f64, excesses[excesses.len() / 100]];
    assert!(found[0] <= mean && found[1] <= most, "{what}: {found:?}");
}

#[test]
fn paths_on_distances_are_little_longer_than_the_shortest() {
    let shapes = [
        ("grid", shapes::grid(40, 33)),
        ("sphere", shapes::icosphere(4)),
        ("torus", shapes::torus(60, 40, 2.0, 0.7)),
        ("cylinder", shapes::cylinder(40, 30, 3.0)),
        ("saddle", shapes::saddle(40)),
        ("terrain", shapes::terrain(40, 0.3)),
    ];
    for (name, shape) in shapes {
        let mesh = shape.mesh().unwrap();
        for source in [0, mesh.vertex_count() as u32 / 2] {
            let sources = [Source::vertex(source)];
            let short = excesses(name, &mesh, &sources, &exact(&mesh, &sources), 1);
            assert_short(&format!("{name}, exact"), &short, [0.01, 0.04]);
            let short = excesses(name, &mesh, &sources, &heat(&mesh, &sources), 2);
            assert_short(&format!("{name}, heat"), &short, [0.03, 0.1]);
        }
    }
}

#[test]
fn paths_end_at_sources_inside_triangles_and_on_curves() {
    let mut random = Random(7);
    for (name, shape) in [("grid", shapes::grid(30, 30)), ("sphere", shapes::icosphere(4))] {
        let mesh = shape.mesh().unwrap();
        let mut sources: Vec<Source> = (0..3).map(|_| Source::point(random.point(&mesh))).collect();
        sources.push(Source::vertex(40));
        let short = excesses(name, &mesh, &sources, &exact(&mesh, &sources), 3);
        assert_short(name, &short, [0.02, 0.2]);

        let [from, to] = [0, 1].map(|_| Target::Point(random.point(&mesh)));
        let Target::Point(start) = from else { unreachable!() };
        let line = field(&mesh, &[Source::point(start)]).path(to).unwrap().unwrap();
        let sources = [Source::curve(line), Source::vertex(0)];
        let short = excesses(name, &mesh, &sources, &exact(&mesh, &sources), 4);
        assert_short(&format!("{name}, curve"), &short, [0.02, 0.1]);
    }
}

/// A source with a start distance so large that another one is nearer is no source of any path.
#[test]
fn paths_pass_sources_that_others_beat() {
    let mesh = shapes::grid(20, 20).mesh().unwrap();
    let sources = [Source::vertex(10), Source::vertex(220).with_offset(30.0), Source::vertex(430).with_offset(5.0)];
    let nearest: Vec<Option<u32>> = field(&mesh, &sources).nearest_sources().collect();
    let paths = descent_paths(&mesh, &exact(&mesh, &sources), &sources, &vertices(&mesh, 1), &Control::new()).unwrap();
    let found: Vec<Option<u32>> = paths.iter().map(|path| path.as_ref().unwrap().source).collect();
    assert!(found.iter().all(|source| matches!(source, Some(0 | 2))));
    let differ = found.iter().zip(&nearest).filter(|(found, nearest)| found != nearest).count();
    assert!(differ <= 10, "{differ}");
    assert_eq!((found[10], found[430], found[220]), (Some(0), Some(2), Some(0)));
    let there = paths[10].as_ref().unwrap();
    assert_eq!((there.curve.points.len(), length(&mesh, &there.curve)), (1, 0.0));
}

#[test]
fn on_a_plane_paths_are_straight_lines_along_the_slope() {
    let mesh = shapes::grid(12, 12).mesh().unwrap();
    let values: Vec<f64> = mesh.positions().iter().map(|[x, y, _]| 3.0 * x + 2.0 * y).collect();
    let from = SurfacePoint { face: 2 * (12 * 11 + 11), barycentric: [0.25, 0.5, 0.25] };
    let paths = descent_paths(&mesh, &values, &[], &[Target::Point(from)], &Control::new()).unwrap();
    let path = paths[0].as_ref().unwrap();
    check("plane", &mesh, &values, path);
    let positions = path.curve.positions(&mesh).unwrap();
    let [x0, y0, _] = positions[0];
    let slanted = positions.iter().take_while(|[x, ..]| *x > 0.0).count();
    for [x, y, _] in &positions[..slanted] {
        assert!(((x - x0) * 2.0 - (y - y0) * 3.0).abs() < 1e-12, "({x}, {y})");
    }
    // Then down the rim, to the corner.
    assert!(slanted > 20 && positions[slanted..].iter().all(|[x, ..]| *x == 0.0));
    assert_eq!(positions[positions.len() - 1], [0.0; 3]);
}

#[test]
fn valleys_and_ridges_are_edges() {
    // Two slopes that meet in the edge from 0, the lower end, to 1.
    let positions = [[0.0; 3], [4.0, 0.0, 0.0], [2.0, 2.0, 0.0], [2.0, -2.0, 0.0]];
    let mesh = Mesh::from_triangles(&positions, &[[0, 1, 2], [1, 0, 3]]).unwrap();
    let end = |values: &[f64; 4], from: SurfacePoint| {
        let paths = descent_paths(&mesh, values, &[], &[Target::Point(from)], &Control::new()).unwrap();
        check("edge", &mesh, values, paths[0].as_ref().unwrap());
        paths[0].as_ref().unwrap().curve.positions(&mesh).unwrap()
    };
    let inside = SurfacePoint { face: 0, barycentric: [0.2, 0.4, 0.4] };
    let valley = end(&[0.0, 1.0, 4.0, 4.0], inside);
    assert_eq!(valley.len(), 3, "{valley:?}");
    assert_eq!((valley[1][1], valley[2]), (0.0, [0.0; 3]));
    // A point on a ridge takes the steeper side.
    let on_edge = SurfacePoint { face: 0, barycentric: [0.5, 0.5, 0.0] };
    assert_eq!(end(&[4.0, 4.0, 1.0, 0.0], on_edge), [[2.0, 0.0, 0.0], positions[3]]);
    assert_eq!(end(&[4.0, 4.0, 0.0, 1.0], on_edge), [[2.0, 0.0, 0.0], positions[2]]);
}

/// On level ground a path goes to the nearest corner and ends, or goes on from there.
#[test]
fn plateaus() {
    let mesh = shapes::grid(2, 1).mesh().unwrap();
    let from = SurfacePoint { face: 0, barycentric: [0.2, 0.7, 0.1] };
    let corner = mesh.triangles()[0][1] as usize;
    for lowest in [None, Some(2)] {
        let mut values = [5.0; 6];
        lowest.into_iter().for_each(|v: usize| values[v] = 1.0);
        let paths =
            descent_paths(&mesh, &values, &[], &[Target::Point(from), Target::Vertex(0)], &Control::new()).unwrap();
        paths.iter().flatten().for_each(|path| check("plateau", &mesh, &values, path));
        let [point, vertex] = [0, 1].map(|i| paths[i].as_ref().unwrap().curve.positions(&mesh).unwrap());
        assert_eq!(point[1], mesh.positions()[corner]);
        assert_eq!(vertex, [mesh.positions()[0]]);
        assert_eq!(point[point.len() - 1], mesh.positions()[lowest.unwrap_or(corner)]);
    }
}

/// Edges between finite corners lead down also where their triangles have a corner that is not finite.
#[test]
fn values_that_are_not_finite() {
    let mesh = shapes::grid(3, 1).mesh().unwrap();
    let triangle = |face: u32| Target::Point(SurfacePoint { face, barycentric: [0.25, 0.5, 0.25] });
    for bad in [INF, -INF, f64::NAN] {
        let values = [0.0, 1.0, 2.0, 3.0, bad, bad, bad, bad];
        let targets = [Target::Vertex(3), Target::Vertex(4), triangle(0), Target::Vertex(0)];
        let paths = descent_paths(&mesh, &values, &[], &targets, &Control::new()).unwrap();
        paths.iter().flatten().for_each(|path| check("not finite", &mesh, &values, path));
        let lengths = paths.iter().map(|path| path.as_ref().map(|path| length(&mesh, &path.curve)));
        assert_eq!(lengths.collect::<Vec<_>>(), [Some(3.0), None, None, Some(0.0)], "{bad}");
    }
    // A vertex of no triangle is on no path; an ignored triangle holds none.
    let mesh = Mesh::from_triangles(&[[0.0; 3], [1.0, 0.0, 0.0], [f64::NAN; 3]], &[[0, 1, 1]]).unwrap();
    assert_eq!(
        descent_paths(&mesh, &[1.0, 0.0, 0.0], &[], &vertices(&mesh, 1), &Control::new()).unwrap(),
        [None, None, None]
    );
}

#[test]
fn on_edges_of_several_triangles_the_steepest_counts() {
    let positions = [[0.0; 3], [2.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 1.0], [1.0, -1.0, 0.0], [1.0, 0.0, -1.0]];
    let fan = [[0, 1, 2], [0, 1, 3], [1, 0, 4], [0, 1, 5]];
    let mesh = Mesh::from_triangles(&positions, &fan).unwrap();
    let from = SurfacePoint { face: 0, barycentric: [0.4, 0.4, 0.2] };
    for lowest in 3..6 {
        let mut values = [5.0, 5.0, 9.0, 4.0, 4.0, 4.0];
        values[lowest] = 1.0;
        let paths = descent_paths(&mesh, &values, &[], &[Target::Point(from)], &Control::new()).unwrap();
        let path = paths[0].as_ref().unwrap();
        check("fan", &mesh, &values, path);
        assert_eq!(
            path.curve.positions(&mesh).unwrap(),
            [from.position(&mesh).unwrap(), [1.0, 0.0, 0.0], positions[lowest]]
        );
    }
}

/// A soup of a few vertices on a small lattice, some in one place, with triangles that repeat vertices and lie upon each
/// other, and a field with equal and infinite values.
fn soup(random: &mut Random) -> (Mesh, Vec<f64>) {
    let vertices = 4 + random.below(12);
    let positions: Vec<[f64; 3]> = (0..vertices).map(|_| [0; 3].map(|_| random.below(4) as f64)).collect();
    let triangles: Vec<[u32; 3]> =
        (0..2 + random.below(30)).map(|_| [0; 3].map(|_| random.below(vertices) as u32)).collect();
    let levels = [3, 1000][random.below(2)];
    let value = |random: &mut Random| match random.below(20) {
        0 => [INF, f64::NAN, -INF][random.below(3)],
        1 => [1e308, -1.7e308, 1e-310][random.below(3)],
        _ => random.below(levels) as f64,
    };
    let values = positions.iter().map(|_| value(random)).collect();
    (Mesh::from_triangles(&positions, &triangles).unwrap(), values)
}

#[test]
fn soups() {
    let mut random = Random(11);
    for case in 0..20_000 {
        let (mesh, values) = soup(&mut random);
        let is_ignored =
            |target: &Target| matches!(target, Target::Point(p) if mesh.ignored_triangles().contains(&p.face));
        let points = (0..6).map(|_| Target::Point(random.point(&mesh)));
        let targets: Vec<Target> = vertices(&mesh, 1).into_iter().chain(points).filter(|t| !is_ignored(t)).collect();
        for path in descent_paths(&mesh, &values, &[], &targets, &Control::new()).unwrap().iter().flatten() {
            check(&format!("soup {case}"), &mesh, &values, path);
        }
        let sources = [Source::vertex(0), Source::vertex(1).with_offset(1.5)];
        for path in descent_paths(&mesh, &values, &sources, &targets, &Control::new()).unwrap().iter().flatten() {
            check_way(&format!("soup {case} with sources"), &mesh, &values, path);
        }
    }
}

#[test]
fn units_do_not_matter() {
    let shape = shapes::torus(30, 20, 2.0, 0.7);
    let mesh = shape.mesh().unwrap();
    let mut random = Random(5);
    let source = random.point(&mesh);
    let targets: Vec<Target> = (0..50).map(|_| Target::Point(random.point(&mesh))).collect();
    let values = exact(&mesh, &[Source::point(source)]);
    let paths = descent_paths(&mesh, &values, &[Source::point(source)], &targets, &Control::new()).unwrap();
    for exponent in [-900, -300, 300, 900] {
        let size = 2f64.powi(exponent);
        let positions: Vec<[f64; 3]> = shape.positions.iter().map(|p| p.map(|x| size * x)).collect();
        let scaled = Mesh::from_triangles(&positions, &shape.triangles).unwrap();
        let values: Vec<f64> = values.iter().map(|u| size * u).collect();
        assert_eq!(
            descent_paths(&scaled, &values, &[Source::point(source)], &targets, &Control::new()).unwrap(),
            paths,
            "2^{exponent}"
        );
        assert_eq!(
            descent_paths(&mesh, &values, &[Source::point(source)], &targets, &Control::new()).unwrap(),
            paths,
            "field alone"
        );
    }
    // From one end of the numbers to the other.
    let huge = [[-1.7e308, 0.0, 0.0], [1.7e308, 0.0, 0.0], [0.0, 1.7e308, 0.0], [0.0, -1.7e308, 0.0]];
    let mesh = Mesh::from_triangles(&huge, &[[0, 1, 2], [1, 0, 3]]).unwrap();
    let values = [1.7e308, -1.7e308, 1e308, 0.0];
    for path in descent_paths(&mesh, &values, &[], &vertices(&mesh, 1), &Control::new()).unwrap().iter().flatten() {
        check("huge", &mesh, &values, path);
        assert_eq!(path.curve.positions(&mesh).unwrap()[path.curve.points.len() - 1], huge[1]);
    }
}

#[test]
fn what_makes_no_sense_is_named() {
    let mesh = shapes::grid(2, 2).mesh().unwrap();
    let values = [1.0; 9];
    let fails = |values: &[f64], sources: &[Source], targets: &[Target]| {
        let error = descent_paths(&mesh, values, sources, targets, &Control::new()).unwrap_err();
        (error.reason(), error.element())
    };
    let beyond = SurfacePoint { face: 8, barycentric: [1.0, 0.0, 0.0] };
    assert_eq!(fails(&values[1..], &[], &[]), (Reason::BadArgument, None));
    let target = Some(Element::Target(1));
    assert_eq!(fails(&values, &[], &[0, 9].map(Target::Vertex)), (Reason::VertexOutOfRange, target));
    assert_eq!(fails(&values, &[], &[Target::Vertex(0), Target::Point(beyond)]), (Reason::BadArgument, target));
    let source = Some(Element::Source(0));
    assert_eq!(fails(&values, &[Source::vertex(9)], &[]), (Reason::VertexOutOfRange, source));
    assert_eq!(fails(&values, &[Source::vertex(1).with_offset(INF)], &[]), (Reason::BadArgument, source));
}

/// A minimum that is no source holds a path only where no sources are known.
#[test]
fn paths_go_on_over_the_lowest_pass() {
    let mesh = shapes::grid(5, 1).mesh().unwrap();
    let row = [0.0, 2.0, 1.0, 4.0, 5.0, 6.0];
    let values = [row, row].concat();
    let end = |sources: &[Source]| {
        let path =
            descent_paths(&mesh, &values, sources, &[Target::Vertex(5)], &Control::new()).unwrap()[0].clone().unwrap();
        check_way("pass", &mesh, &values, &path);
        (path.source, path.curve.positions(&mesh).unwrap()[path.curve.points.len() - 1])
    };
    assert_eq!(end(&[]), (None, [2.0, 0.0, 0.0]));
    assert_eq!(end(&[Source::vertex(0), Source::vertex(6)]), (Some(0), [0.0; 3]));
    // A source above the field is none.
    assert_eq!(end(&[Source::vertex(0).with_offset(3.0)]), (None, [2.0, 0.0, 0.0]));
}

#[test]
fn real_meshes_however_bad() {
    for (name, mesh) in bad_meshes() {
        let sources = [Source::vertex(mesh.triangles()[mesh.triangle_count() / 2][0])];
        let targets = vertices(&mesh, 1 + mesh.vertex_count() / 500);
        let distances = exact(&mesh, &sources);
        for (target, path) in
            targets.iter().zip(descent_paths(&mesh, &distances, &sources, &targets, &Control::new()).unwrap())
        {
            let Some(path) = path else { continue };
            check_way(name, &mesh, &distances, &path);
            assert_eq!(path.source, Some(0), "{name}: {target:?}");
        }
        let heights: Vec<f64> = mesh.positions().iter().map(|[x, y, z]| x + 0.3 * y * z).collect();
        for path in descent_paths(&mesh, &heights, &[], &targets, &Control::new()).unwrap().iter().flatten() {
            check(name, &mesh, &heights, path);
        }
    }
}

#[test]
fn on_good_scans_paths_by_heat_are_little_longer_than_the_shortest() {
    let Some(folder) = corpus() else { return };
    for name in ["paper_bunny_1.obj", "max_planck.obj", "cup_genus2.off"] {
        let mesh = Mesh::read(folder.join(name)).unwrap();
        let sources = [Source::vertex(0)];
        assert_short(name, &excesses(name, &mesh, &sources, &heat(&mesh, &sources), 6), [0.01, 0.05]);
    }
}
