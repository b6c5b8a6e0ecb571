//! What the heat method starts from: vertices, points, curves, start distances of any size; and heat that fades away.

mod common;
#[path = "common/places.rs"]
mod places;

use common::corpus;
use places::{Random, euclid};
use taut::{
    Control, Curve, Element, ExactSolver, HeatField, HeatOptions, HeatSolver, Laplacian, Mesh, Shift, Source,
    SurfacePoint, TimeFormula, TimeScale, TimeStep, shapes,
};

fn field(mesh: &Mesh, options: &HeatOptions, sources: &[Source]) -> HeatField {
    HeatSolver::new(mesh, options, &Control::new()).unwrap().field(sources, &Control::new()).unwrap()
}

fn exact(mesh: &Mesh, sources: &[Source]) -> Vec<f64> {
    places::field(mesh, sources).distances().to_vec()
}

/// The mean of the relative errors in percent, over what is farther than 0 and not +inf.
fn mean_error(distances: &[f64], exact: &[f64]) -> f64 {
    let pairs = distances.iter().zip(exact).filter(|(_, e)| **e > 0.0 && e.is_finite());
    let errors: Vec<f64> = pairs.map(|(d, e)| 100.0 * (d - e).abs() / e).collect();
    errors.iter().sum::<f64>() / errors.len() as f64
}

fn times(factor: f64) -> HeatOptions {
    let time_step = TimeStep::Formula { formula: TimeFormula::MeanEdge, scale: TimeScale::Paper, factor };
    HeatOptions { time_step, ..HeatOptions::default() }
}

// ------------------------------------------------------------------------------------------------------- faded heat

/// e^-0.87 for each edge is 0 after about 850 of them.
#[test]
fn heat_that_fades_starts_anew() {
    let strip = shapes::grid(2, 2000).mesh().unwrap();
    let exact: Vec<f64> = strip.positions().iter().map(|&p| euclid(p, strip.positions()[1])).collect();
    for (factor, laplacian) in [(1.0, Laplacian::Intrinsic), (0.1, Laplacian::Intrinsic), (1.0, Laplacian::Plain)] {
        let field = field(&strip, &HeatOptions { laplacian, ..times(factor) }, &[Source::vertex(1)]);
        assert!(field.restarts() >= 2 && field.nonpositive_heat() == 0, "{field:?}");
        let off = field.distances().iter().zip(&exact).map(|(d, e)| (d - e).abs()).fold(0.0, f64::max);
        assert!(off < 1.0, "{factor} {laplacian:?}: {off}");
        // Every step along the strip is one cell long, where heat started anew too.
        let middle: Vec<f64> = field.distances().iter().skip(1).step_by(3).copied().collect();
        assert!(middle[20..1990].windows(2).all(|pair| (pair[1] - pair[0] - 1.0).abs() < 2e-3), "{middle:?}");
    }
}

/// Beyond the place where heat starts anew a wide sheet is no worse than before it.
#[test]
fn the_front_runs_on_in_the_plane() {
    let (width, length) = (40, 900);
    let sheet = shapes::grid(width, length).mesh().unwrap();
    let source = width / 3;
    let field = field(&sheet, &times(1.0), &[Source::vertex(source)]);
    assert_eq!(field.restarts(), 1);
    let position = |v: usize| sheet.positions()[v];
    let zones: Vec<f64> = (1..9)
        .map(|zone| {
            let rows = 100 * zone * (width as usize + 1)..100 * (zone + 1) * (width as usize + 1);
            let errors = rows
                .clone()
                .map(|v| 100.0 * (field.distances()[v] / euclid(position(v), position(source as usize)) - 1.0).abs());
            errors.sum::<f64>() / rows.len() as f64
        })
        .collect();
    assert!(zones.iter().all(|&zone| zone < 0.6), "{zones:?}");
}

/// A start distance e^-x of whose heat is 0: its source comes in where heat starts anew.
#[test]
fn large_start_distances_come_in_late() {
    let sheet = shapes::grid(1500, 2).mesh().unwrap();
    let side = |column: u32| along(&sheet, (0..3).map(|row| row * 1501 + column), false);
    for [near, late] in [[0, 1500].map(Source::vertex), [0, 1500].map(side)] {
        let sources = [near, late.with_offset(1000.0)];
        let field = field(&sheet, &times(1.0), &sources);
        let exact = exact(&sheet, &sources);
        let off = field.distances().iter().zip(&exact).map(|(d, e)| (d - e).abs()).fold(0.0, f64::max);
        // On this grid heat decays by e^-0.87 for each cell, a start distance by e^-0.88: over a thousand that is fifteen
        // cells.
        assert!(field.restarts() >= 1 && off < 30.0, "{off}");
        assert_eq!(field.distances()[1500], 1000.0);
    }
}

/// Where the boundary absorbs all heat u is 0: that is no fading. A strip along which heat fades is no worse than a short one.
#[test]
fn absorbed_heat_has_not_faded() {
    let error = |length: u32, has_faded: bool| {
        let strip = shapes::grid(length, 12).mesh().unwrap();
        let source = 6 * (length + 1) + length / 2;
        let absorbing = HeatOptions { boundary: 1.0, ..times(1.0) };
        let field = field(&strip, &absorbing, &[Source::vertex(source)]);
        assert_eq!((field.restarts() > 0, field.nonpositive_heat()), (has_faded, 0));
        let exact: Vec<f64> =
            strip.positions().iter().map(|&p| euclid(p, strip.positions()[source as usize])).collect();
        mean_error(field.distances(), &exact)
    };
    let [short, long] = [(600, false), (1600, true)].map(|(length, has_faded)| error(length, has_faded));
    assert!(long < 1.1 * short, "{short} {long}");
}

// ------------------------------------------------------------------------------------------------ points and curves

fn inside(face: u32, barycentric: [f64; 3]) -> SurfacePoint {
    SurfacePoint { face, barycentric }
}

/// Error in percent of fields from inside triangles, from edges and from curves, beside that from a vertex.
#[test]
fn points_and_curves_are_as_good_as_vertices() {
    for shape in [shapes::icosphere(4), shapes::terrain(40, 0.4), shapes::torus(60, 40, 1.0, 0.4)] {
        let mesh = shape.mesh().unwrap();
        let face = mesh.triangle_count() as u32 / 3;
        let point = |barycentric| Source::point(inside(face, barycentric));
        let error = |source: Source| {
            let source = [source];
            mean_error(field(&mesh, &HeatOptions::default(), &source).distances(), &exact(&mesh, &source))
        };
        let vertex = error(Source::vertex(mesh.triangles()[face as usize][0]));
        for source in
            [point([0.3, 0.3, 0.4]), point([0.5, 0.5, 0.0]), point([0.9, 0.1, 0.0]), point([0.98, 0.01, 0.01])]
        {
            let error = error(source.clone());
            assert!(error < 1.5 * vertex + 0.2, "{source:?}: {error} beside {vertex}");
        }
        assert_eq!(error(point([1.0, 0.0, 0.0])), vertex);
        let solver = ExactSolver::new(&mesh).unwrap();
        let ends = [inside(face, [0.3, 0.3, 0.4]), inside(0, [0.3, 0.3, 0.4])];
        let curve = solver.curve_through(&ends, &Control::new()).unwrap();
        // A curve is as good as the points that it is made of.
        let points: Vec<Source> = curve.points.iter().map(|&point| Source::point(point)).collect();
        let of_points = mean_error(field(&mesh, &HeatOptions::default(), &points).distances(), &exact(&mesh, &points));
        let error = error(Source::curve(curve));
        assert!(error < 1.3 * of_points, "a curve: {error} beside {of_points}");
    }
}

/// Distances are those that are known at the corners around a source.
#[test]
fn the_surroundings_of_a_source_are_pinned() {
    let plane = shapes::grid(20, 20).mesh().unwrap();
    let point = inside(421, [0.2, 0.5, 0.3]);
    let at = point.position(&plane).unwrap();
    let source = [Source::point(point).with_offset(3.5)];
    let field = field(&plane, &HeatOptions::default(), &source);
    for v in plane.triangles()[421] {
        let known = 3.5 + euclid(at, plane.positions()[v as usize]);
        assert!((field.distances()[v as usize] - known).abs() < 1e-13 * known);
    }
    assert!(field.distances().iter().all(|&d| d >= 3.5));
    // A curve along a row of edges and through triangles.
    let curve = Curve {
        points: [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|barycentric| inside(421, barycentric)).to_vec(),
        is_closed: false,
    };
    let ends = curve.positions(&plane).unwrap();
    let d = field_of(&plane, Source::curve(curve));
    for (d, &p) in d.iter().zip(plane.positions()) {
        if ends.contains(&p) {
            assert_eq!(*d, 0.0);
        }
    }
}

fn field_of(mesh: &Mesh, source: Source) -> Vec<f64> {
    field(mesh, &HeatOptions::default(), &[source]).into_distances()
}

/// A curve through vertices, along edges.
fn along(mesh: &Mesh, vertices: impl Iterator<Item = u32>, is_closed: bool) -> Source {
    let at = |v: u32| {
        let face = mesh.triangles().iter().position(|triangle| triangle.contains(&v)).unwrap();
        inside(face as u32, mesh.triangles()[face].map(|corner| f64::from(corner == v)))
    };
    Source::curve(Curve { points: vertices.map(at).collect(), is_closed })
}

/// Very many pins are held by a factorisation of their own: the same distances as by multipliers.
#[test]
fn long_curves_hold_their_vertices() {
    let plane = shapes::grid(400, 12).mesh().unwrap();
    for count in [20, 400] {
        let source = [along(&plane, (0..count).map(|i| 6 * 401 + i), false)];
        let d = field(&plane, &HeatOptions::default(), &source).into_distances();
        assert!(mean_error(&d, &exact(&plane, &source)) < 2.5);
        assert!((0..count as usize).all(|i| d[6 * 401 + i] == 0.0));
    }
}

// ------------------------------------------------------------------------------------------------- several sources

/// Zero at each source, or its start distance, is better than the right minimum.
#[test]
fn pinned_sources_are_better() {
    let mesh = shapes::icosphere(4).mesh().unwrap();
    let sources: Vec<Source> = (0..20).map(|i| Source::vertex(i * 127)).collect();
    let exact = exact(&mesh, &sources);
    let error = |shift| {
        let field = field(&mesh, &HeatOptions { shift, ..HeatOptions::default() }, &sources);
        mean_error(field.distances(), &exact)
    };
    let [pinned, shifted] = [Shift::Pinned, Shift::Min].map(error);
    assert!(pinned < 0.7 * shifted, "{pinned} {shifted}");
}

/// A source that another reaches sooner changes nothing much: its start distance is no distance.
#[test]
fn a_source_that_another_reaches_sooner_does_not_count() {
    let plane = shapes::grid(40, 40).mesh().unwrap();
    let one = [Source::vertex(820)];
    let both = [Source::vertex(820), Source::vertex(800).with_offset(25.0)];
    let [alone, with] =
        [&one[..], &both].map(|sources| field(&plane, &HeatOptions::default(), sources).into_distances());
    let off = alone.iter().zip(&with).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(off < 0.05, "{off}");
    // One that is not reached sooner does.
    let near = [Source::vertex(820), Source::vertex(800).with_offset(15.0)];
    assert_eq!(field(&plane, &HeatOptions::default(), &near).distances()[800], 15.0);
}

/// Two rings around the tube of a torus, opposite each other. The inner side of the second is 1.9 from the first and the
/// outer one 2.7: of a start distance between them only the outer side counts, of a larger one nothing.
#[test]
fn a_curve_counts_where_no_other_reaches_it_sooner() {
    let torus = shapes::torus(90, 60, 1.0, 0.4).mesh().unwrap();
    let ring = |column: u32| (0..60).map(move |row| row * 90 + column);
    let [first, second] = [0, 45].map(|column| along(&torus, ring(column), true));
    let [outer, inner] = [45, 30 * 90 + 45];
    let alone = field_of(&torus, first.clone());
    let exact_alone = exact(&torus, std::slice::from_ref(&first));
    assert!(exact_alone[inner] < 2.0 && exact_alone[outer] > 2.7, "{} {}", exact_alone[inner], exact_alone[outer]);

    let partly = [first.clone(), second.clone().with_offset(2.5)];
    let expected = exact(&torus, &partly);
    let by_heat = field(&torus, &HeatOptions::default(), &partly);
    let d = by_heat.distances();
    assert!(d[outer] == 2.5 && (d[inner] / expected[inner] - 1.0).abs() < 0.05, "{} {}", d[outer], d[inner]);
    let nearest = by_heat.nearest_sources();
    assert_eq!([nearest[outer], nearest[inner]], [Some(1), Some(0)]);
    let [error, error_alone] = [mean_error(d, &expected), mean_error(&alone, &exact_alone)];
    assert!(error < 1.1 * error_alone, "{error} beside {error_alone}");

    let wholly = field(&torus, &HeatOptions::default(), &[first, second.with_offset(5.0)]);
    let off = wholly.distances().iter().zip(&alone).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(off < 1e-9, "{off}");
    assert!(wholly.nearest_sources().iter().all(|&source| source == Some(0)));
}

/// Rows have the bits of fields, for any number of threads; errors count sources through all sets.
#[test]
fn rows_are_fields() {
    let mesh = shapes::terrain(20, 0.4).mesh().unwrap();
    let solver =
        HeatSolver::new(&mesh, &HeatOptions { boundary: 0.3, ..HeatOptions::default() }, &Control::new()).unwrap();
    let mut sets: Vec<Vec<Source>> = (0..19).map(|i| vec![Source::vertex(i * 20)]).collect();
    sets[3].push(Source::vertex(100).with_offset(0.1));
    sets[7].push(Source::point(inside(70, [0.5, 0.25, 0.25])));
    let rows = solver.distance_rows(&sets, 1, &Control::new()).unwrap();
    for (set, row) in sets.iter().zip(&rows) {
        assert_eq!(row, solver.field(set, &Control::new()).unwrap().distances());
    }
    for threads in [0, 2, 5] {
        assert_eq!(solver.distance_rows(&sets, threads, &Control::new()).unwrap(), rows);
    }
    assert!(solver.distance_rows(&[], 3, &Control::new()).unwrap().is_empty());
    sets[12] = vec![Source::vertex(1).with_offset(1e308), Source::vertex(2).with_offset(-1e308)];
    let error = solver.distance_rows(&sets, 2, &Control::new()).unwrap_err();
    assert_eq!(error.element(), Some(Element::Source(14)));
    sets[12] = vec![Source::vertex(1_000_000)];
    let error = solver.distance_rows(&sets, 2, &Control::new()).unwrap_err();
    assert_eq!(error.element(), Some(Element::Source(14)));
}

/// Both systems are solved to rounding; what is left is told as it is.
#[test]
fn residuals_are_rounding() {
    let mesh = shapes::terrain(40, 0.4).mesh().unwrap();
    let options = HeatOptions { boundary: 0.5, ..HeatOptions::default() };
    let solver = HeatSolver::new(&mesh, &options, &Control::new()).unwrap();
    for sources in [vec![Source::vertex(7)], vec![Source::vertex(7), Source::point(inside(900, [0.2, 0.2, 0.6]))]] {
        let residuals = solver.residuals(&sources, &Control::new()).unwrap();
        for residual in [residuals.heat, residuals.poisson] {
            assert!(residual > 0.0 && residual < 1e-12, "{residuals:?}");
        }
    }
}

// ------------------------------------------------------------------------------------------------- other positions

/// A mesh that moves: the solver of the place before gives what a new one gives.
#[test]
fn another_place_of_the_same_triangles() {
    let shape = shapes::terrain(30, 0.3);
    let mesh = shape.mesh().unwrap();
    for laplacian in [Laplacian::Intrinsic, Laplacian::Plain] {
        let options = HeatOptions { laplacian, boundary: 0.5, ..HeatOptions::default() };
        let solver = HeatSolver::new(&mesh, &options, &Control::new()).unwrap();
        let moved: Vec<[f64; 3]> = mesh.positions().iter().map(|&[x, y, z]| [2.0 * x + 0.3 * y, y, 3.0 * z]).collect();
        let moved = mesh.with_positions(&moved).unwrap();
        let again = solver.with_mesh(&moved, &Control::new()).unwrap();
        let fresh = HeatSolver::new(&moved, &options, &Control::new()).unwrap();
        assert_eq!(again.time_step(), fresh.time_step());
        assert_eq!(again.report().times.order, std::time::Duration::ZERO);
        let [a, b] = [&again, &fresh].map(|solver| solver.field(&[Source::vertex(7)], &Control::new()).unwrap());
        let off = a.distances().iter().zip(b.distances()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 1e-11, "{off}");
    }
    let other = shapes::terrain(29, 0.3).mesh().unwrap();
    let solver = HeatSolver::new(&mesh, &HeatOptions::default(), &Control::new()).unwrap();
    assert!(solver.with_mesh(&other, &Control::new()).is_err());
    assert!(mesh.with_positions(other.positions()).is_err());
    let mut broken = mesh.positions().to_vec();
    broken[5][1] = f64::NAN;
    assert!(mesh.with_positions(&broken).is_err());
}

/// A curve that has no length, because all corners of its triangle lie in one place, is a point.
#[test]
fn curves_without_length() {
    let positions = [[0.0; 3], [0.0; 3], [0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let mesh = Mesh::from_triangles(&positions, &[[0, 1, 2], [0, 3, 4]]).unwrap();
    let points = [[1.0, 0.0, 0.0], [0.0, 0.5, 0.5]].map(|barycentric| inside(0, barycentric)).to_vec();
    let d = field_of(&mesh, Source::curve(Curve { points, is_closed: false }));
    assert!(d[..3].iter().all(|&d| d == 0.0) && d[3..].iter().all(|&d| d > 0.5 && d < 2.0), "{d:?}");
}

/// The whole corpus, from a point inside a triangle: finite where the point's component is, and not negative.
#[test]
fn points_on_any_mesh() {
    let Some(folder) = corpus() else { return };
    for name in ["klingon_starship.off", "office_chair_bad.obj", "truck_nm.obj", "cube_shuffled.off", "moebius.obj"] {
        let mesh = Mesh::read(folder.join(name)).unwrap();
        let mut random = Random(1);
        for _ in 0..20 {
            let point = random.point(&mesh);
            if mesh.ignored_triangles().contains(&point.face) {
                continue;
            }
            let source = [Source::point(point), Source::vertex(0).with_offset(0.5)];
            let d = field(&mesh, &HeatOptions::default(), &source);
            let e = exact(&mesh, &source);
            assert!(
                d.distances().iter().zip(&e).all(|(d, e)| *d >= 0.0 && d.is_finite() == e.is_finite()),
                "{name} {source:?}"
            );
        }
    }
}
