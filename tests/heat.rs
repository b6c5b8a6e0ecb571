//! The heat method against closed forms, the paper, itself, and meshes that break other codes.

#[path = "common/bad.rs"]
mod bad;
mod common;
#[path = "common/places.rs"]
mod places;

use bad::bad_meshes;
use common::corpus;
use places::{Random, euclid};
use taut::shapes::{self, Shape};
use taut::{
    Control, Element, Error, ExactOptions, ExactSolver, HeatOptions, HeatSolver, Laplacian, Mesh, Reason, Shift,
    Solver, Source, TimeFormula, TimeScale, TimeStep,
};

// ---------------------------------------------------------------------------------------------------------- meshes

/// Positions and triangles, still to be changed.
type Buffers = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// The square [0, 1]² as n × n cells; inner vertices are moved by up to `jitter` of a cell, always in the same way.
fn grid(n: u32, jitter: f64) -> Buffers {
    let mut random = Random(1);
    let mut moved = |i: f64| if i == 0.0 || i == f64::from(n) { i } else { i + jitter * (2.0 * random.next() - 1.0) };
    let Shape { mut positions, triangles } = shapes::grid(n, n);
    positions.iter_mut().for_each(|[x, y, _]| [*x, *y] = [*x, *y].map(|i| moved(i) / f64::from(n)));
    (positions, triangles)
}

fn mesh((positions, triangles): &Buffers) -> Mesh {
    Mesh::from_triangles(positions, triangles).unwrap()
}

fn scaled((positions, triangles): &Buffers, size: f64) -> Buffers {
    (positions.iter().map(|p| p.map(|x| x * size)).collect(), triangles.clone())
}

// --------------------------------------------------------------------------------------------------------- helpers

fn solver(mesh: &Mesh, options: &HeatOptions) -> HeatSolver {
    HeatSolver::new(mesh, options, &Control::new()).unwrap()
}

fn distances(mesh: &Mesh, options: &HeatOptions, sources: &[Source]) -> Vec<f64> {
    solver(mesh, options).field(sources, &Control::new()).unwrap().into_distances()
}

fn refused(mesh: &Mesh, options: &HeatOptions) -> Error {
    HeatSolver::new(mesh, options, &Control::new()).unwrap_err()
}

/// Relative errors in percent; the source counts as an error of 0.
fn errors(distances: &[f64], exact: &[f64]) -> Vec<f64> {
    let error = |(d, e): (&f64, &f64)| if *e == 0.0 { 0.0 } else { 100.0 * (d - e).abs() / e };
    distances.iter().zip(exact).map(error).collect()
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    (values[(values.len() - 1) / 2] + values[values.len() / 2]) / 2.0
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|x| x.to_bits()).collect()
}

// ------------------------------------------------------------------------------------------------------- the paper

/// The paper's best mean and median error on its first mesh, and their neighbours on the curve, to every printed digit.
/// The same figures come out with the exact distances of Kirsanov's code as reference.
#[test]
fn paper_bunny_reproduces_to_five_digits() {
    let Some(folder) = corpus() else { return };
    let mesh = Mesh::read(folder.join("paper_bunny_1.obj")).unwrap();
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for p in mesh.positions() {
        low = [0, 1, 2].map(|k| low[k].min(p[k]));
        high = [0, 1, 2].map(|k| high[k].max(p[k]));
    }
    let s = 24.976 / euclid(low, high);
    let source = [Source::vertex(7649)];
    let exact = ExactSolver::new(&mesh).unwrap().field(&source, &ExactOptions::default(), &Control::new()).unwrap();
    let step = |t: f64| TimeStep::Value(t / (s * s));
    let options = HeatOptions {
        laplacian: Laplacian::Plain,
        shift: Shift::Min,
        time_step: step(0.0254),
        ..HeatOptions::default()
    };
    let solver = solver(&mesh, &options);
    let table = [
        (0.0254, "0.53031", "0.37701"),
        (0.0246, "0.53149", "0.37351"),
        (0.0225, "0.54696", "0.39168"),
        (0.028, "0.54100", "0.38560"),
    ];
    for (t, mean_percent, median_percent) in table {
        let solver = solver.with_time_step(&step(t), &Control::new()).unwrap();
        let errors = errors(&solver.field(&source, &Control::new()).unwrap().into_distances(), exact.distances());
        assert_eq!(format!("{:.5}", mean(&errors)), mean_percent, "t = {t}");
        assert_eq!(format!("{:.5}", median(errors)), median_percent, "t = {t}");
    }
}

// ---------------------------------------------------------------------------------------------------- closed forms

#[test]
fn plane_error_is_small_and_falls_under_refinement() {
    let mut last = f64::INFINITY;
    for n in [16, 32, 64] {
        let plane = mesh(&grid(n, 0.2));
        let source = n / 2 * (n + 1) + n / 2;
        let exact: Vec<f64> =
            plane.positions().iter().map(|&p| euclid(p, plane.positions()[source as usize])).collect();
        let error = mean(&errors(&distances(&plane, &HeatOptions::default(), &[Source::vertex(source)]), &exact));
        assert!(error < 0.7 * last, "{n}: {error} % after {last} %");
        last = error;
    }
    assert!(last < 1.5, "{last} %");
}

#[test]
fn sphere_error_is_small() {
    let sphere = shapes::icosphere(5).mesh().unwrap();
    let exact: Vec<f64> = sphere.positions().iter().map(|p| p[2].clamp(-1.0, 1.0).acos()).collect();
    for laplacian in [Laplacian::Intrinsic, Laplacian::Plain] {
        let options = HeatOptions { laplacian, ..HeatOptions::default() };
        let error = mean(&errors(&distances(&sphere, &options, &[Source::vertex(0)]), &exact));
        assert!(error < 1.5, "{laplacian:?}: {error} %");
    }
}

#[test]
fn distances_go_around_a_hole() {
    let n = 64;
    let (positions, mut triangles) = grid(n, 0.0);
    let inside = |v: u32| positions[v as usize][..2].iter().all(|&x| (0.25..=0.75).contains(&x));
    triangles.retain(|triangle| !triangle.iter().all(|&v| inside(v)));
    let plane = Mesh::from_triangles(&positions, &triangles).unwrap();
    // From the middle of one side of the hole to the middle of the opposite one: half a side, a side, half a side.
    let [from, to] = [0.25, 0.75].map(|x| positions.iter().position(|p| p[0] == x && p[1] == 0.5).unwrap() as u32);
    let d = distances(&plane, &HeatOptions::default(), &[Source::vertex(from)]);
    assert!((d[to as usize] - 1.0).abs() < 0.05, "{}", d[to as usize]);
    assert!(
        d.iter()
            .zip(&positions)
            .all(|(d, p)| d.is_infinite() == (0.26..0.74).contains(&p[0].min(p[1]).min(1.0 - p[0]).min(1.0 - p[1])))
    );
}

/// A triangle without area whose corners lie on a line closes the gap beside a vertex on an edge: heat crosses it.
#[test]
fn a_triangle_without_area_conducts() {
    let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 1.5, 0.0], [1.0, -1.5, 0.0]];
    let below = [[0, 4, 1], [1, 4, 2]];
    let joined = Mesh::from_triangles(&positions, &[&below[..], &[[0, 2, 3], [0, 1, 2]]].concat()).unwrap();
    let proper = Mesh::from_triangles(&positions, &[&below[..], &[[0, 1, 3], [1, 2, 3]]].concat()).unwrap();
    let options = HeatOptions { time_step: TimeStep::Value(1.0), ..HeatOptions::default() };
    let [d, expected] = [&joined, &proper].map(|mesh| distances(mesh, &options, &[Source::vertex(3)]));
    // A triangle lengthened by ε rises by about √ε.
    assert!(largest_difference(&d, &expected) < 1e-4, "{d:?} {expected:?}");
    assert!(solver(&joined, &options).report().mollified && !solver(&proper, &options).report().mollified);
}

#[test]
fn nothing_reaches_other_components_and_unused_vertices() {
    let (mut positions, mut triangles) = grid(8, 0.2);
    let n = positions.len() as u32;
    positions.extend(positions.clone().iter().map(|p| [p[0] + 3.0, p[1], p[2]]));
    triangles.extend(triangles.clone().iter().map(|t| t.map(|v| v + n)));
    positions.push([f64::NAN; 3]);
    let unused = 2 * n;
    let two = Mesh::from_triangles(&positions, &triangles).unwrap();
    for shift in [Shift::Pinned, Shift::Min] {
        let solver = solver(&two, &HeatOptions { shift, ..HeatOptions::default() });
        let d = solver.field(&[Source::vertex(0)], &Control::new()).unwrap().into_distances();
        assert!(d[..n as usize].iter().all(|d| d.is_finite()));
        assert!(d[n as usize..].iter().all(|&d| d == f64::INFINITY));
        // Each component by itself: the same bits as alone.
        let sources = [Source::vertex(0), Source::vertex(n).with_offset(2.0), Source::vertex(unused).with_offset(7.0)];
        let all = solver.field(&sources, &Control::new()).unwrap().into_distances();
        assert_eq!(bits(&all[..n as usize]), bits(&d[..n as usize]));
        assert!(all[..n as usize].iter().zip(&all[n as usize..]).all(|(a, b)| (a + 2.0 - b).abs() < 1e-12));
        assert_eq!(all[unused as usize], 7.0);
    }
}

// --------------------------------------------------------------------------------------------------- against itself

#[test]
fn a_retimed_solver_has_the_bits_of_a_fresh_one() {
    let plane = mesh(&grid(20, 0.3));
    let sources = [Source::vertex(200), Source::vertex(33)];
    for (laplacian, boundary) in [(Laplacian::Intrinsic, 0.0), (Laplacian::Plain, 0.5)] {
        let options = HeatOptions { laplacian, boundary, ..HeatOptions::default() };
        let step = TimeStep::Formula { formula: TimeFormula::Sigma, scale: TimeScale::Paper, factor: 0.5 };
        let fresh = solver(&plane, &HeatOptions { time_step: step, ..options });
        let retimed = solver(&plane, &options).with_time_step(&step, &Control::new()).unwrap();
        assert_eq!(fresh.time_step(), retimed.time_step());
        let [a, b] = [&fresh, &retimed].map(|solver| solver.field(&sources, &Control::new()).unwrap().into_distances());
        assert_eq!(bits(&a), bits(&b));
    }
}

#[test]
fn threads_share_a_solver() {
    let plane = mesh(&grid(20, 0.3));
    let solver = solver(&plane, &HeatOptions::default());
    let solve = |v: u32| {
        bits(&solver.field(&[Source::vertex(v), Source::vertex(7)], &Control::new()).unwrap().into_distances())
    };
    let alone: Vec<_> = (0..4).map(solve).collect();
    let together: Vec<_> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..4).map(|v| scope.spawn(move || solve(v))).collect();
        threads.into_iter().map(|thread| thread.join().unwrap()).collect()
    });
    assert_eq!(alone, together);
}

#[cfg(feature = "ldl")]
#[test]
fn both_backends_agree() {
    for mesh in [mesh(&grid(30, 0.3)), shapes::icosphere(4).mesh().unwrap()] {
        for (shift, boundary) in [(Shift::Pinned, 0.0), (Shift::Min, 0.0), (Shift::Pinned, 0.5)] {
            let options = HeatOptions { shift, boundary, ..HeatOptions::default() };
            let sources = [Source::vertex(100), Source::vertex(500).with_offset(0.1)];
            let supernodal = distances(&mesh, &options, &sources);
            let ldl = distances(&mesh, &HeatOptions { solver: Solver::Ldl, ..options }, &sources);
            assert!(largest_difference(&supernodal, &ldl) < 1e-9 * supernodal.iter().copied().fold(0.0, f64::max));
        }
    }
}

#[test]
fn powers_of_two_change_nothing_but_the_scale() {
    let plane = grid(12, 0.3);
    for options in
        [HeatOptions::default(), HeatOptions { laplacian: Laplacian::Plain, boundary: 0.5, ..HeatOptions::default() }]
    {
        let sources = |size: f64| [Source::vertex(80), Source::vertex(20).with_offset(0.125 * size)];
        let d = distances(&mesh(&plane), &options, &sources(1.0));
        for exponent in [-400, -30, 1, 7, 400] {
            let size = 2f64.powi(exponent);
            let larger = distances(&mesh(&scaled(&plane, size)), &options, &sources(size));
            assert_eq!(bits(&d), bits(&larger.iter().map(|d| d / size).collect::<Vec<_>>()), "2^{exponent}");
        }
    }
}

#[test]
fn other_scales_change_the_result_by_rounding_only() {
    let plane = grid(12, 0.3);
    for formula in [
        TimeFormula::MeanEdge,
        TimeFormula::Sigma,
        TimeFormula::MeanSigma,
        TimeFormula::MedianFit,
        TimeFormula::MedianMean,
    ] {
        let time_step = TimeStep::Formula { formula, scale: TimeScale::Paper, factor: 1.0 };
        let options = HeatOptions { time_step, ..HeatOptions::default() };
        let d = distances(&mesh(&plane), &options, &[Source::vertex(80)]);
        for size in [1e-3, 1e3, 1e6] {
            let larger = distances(&mesh(&scaled(&plane, size)), &options, &[Source::vertex(80)]);
            let back: Vec<f64> = larger.iter().map(|d| d / size).collect();
            assert!(largest_difference(&d, &back) < 1e-10, "{formula:?} {size}");
        }
    }
}

// ------------------------------------------------------------------------------------------------ sources, boundary

#[test]
fn pinned_sources_have_their_offsets() {
    let plane = mesh(&grid(24, 0.2));
    let sources =
        [Source::vertex(30).with_offset(0.1), Source::vertex(300), Source::vertex(560).with_offset(1.0 / 3.0)];
    let d = distances(&plane, &HeatOptions::default(), &sources);
    assert_eq!([d[30], d[300], d[560]], [0.1, 0.0, 1.0 / 3.0]);
    let exact: Vec<f64> = plane
        .positions()
        .iter()
        .map(|&p| {
            let from = |(v, o): (usize, f64)| euclid(p, plane.positions()[v]) + o;
            [(30, 0.1), (300, 0.0), (560, 1.0 / 3.0)].map(from).into_iter().fold(f64::INFINITY, f64::min)
        })
        .collect();
    assert!(mean(&errors(&d, &exact)) < 6.0, "{}", mean(&errors(&d, &exact)));
    let d = distances(&plane, &HeatOptions { shift: Shift::Min, ..HeatOptions::default() }, &sources);
    assert_eq!(d.iter().copied().fold(f64::INFINITY, f64::min), 0.0);
}

#[test]
fn an_offset_at_a_single_source_is_added() {
    let plane = mesh(&grid(10, 0.2));
    for (shift, offset) in [(Shift::Pinned, 2.5), (Shift::Min, 2.5), (Shift::Pinned, -1e9)] {
        let options = HeatOptions { shift, ..HeatOptions::default() };
        let d = distances(&plane, &options, &[Source::vertex(60)]);
        let shifted = distances(&plane, &options, &[Source::vertex(60).with_offset(offset)]);
        assert!(d.iter().zip(&shifted).all(|(d, shifted)| d + offset == *shifted));
    }
}

#[test]
fn boundary_blends_from_neumann_to_dirichlet() {
    let plane = mesh(&grid(32, 0.2));
    let exact: Vec<f64> = plane.positions().iter().map(|&p| euclid(p, plane.positions()[300])).collect();
    let error = |boundary: f64| {
        let options = HeatOptions { boundary, ..HeatOptions::default() };
        mean(&errors(&distances(&plane, &options, &[Source::vertex(300)]), &exact))
    };
    let [neumann, average, dirichlet] = [0.0, 0.5, 1.0].map(error);
    // Isolines meet the boundary at right angles, or run along it; the truth is between.
    assert!(average < neumann && average < dirichlet, "{neumann} {average} {dirichlet}");
    // A mesh without boundary does not notice.
    let sphere = shapes::icosphere(3).mesh().unwrap();
    let [a, b] = [0.0, 1.0]
        .map(|boundary| distances(&sphere, &HeatOptions { boundary, ..HeatOptions::default() }, &[Source::vertex(9)]));
    assert_eq!(bits(&a), bits(&b));
}

#[test]
fn a_source_on_the_boundary() {
    let plane = mesh(&grid(8, 0.2));
    let sources = [Source::vertex(40), Source::vertex(3)];
    let absorbing = solver(&plane, &HeatOptions { boundary: 1.0, ..HeatOptions::default() });
    let error = absorbing.field(&sources, &Control::new()).unwrap_err();
    assert_eq!((error.reason(), error.element()), (Reason::SourceOnBoundary, Some(Element::Source(1))));
    assert!(absorbing.field(&sources[..1], &Control::new()).is_ok());
    let d = distances(&plane, &HeatOptions { boundary: 0.5, ..HeatOptions::default() }, &sources[1..]);
    assert!(d[3] == 0.0 && d.iter().all(|d| (0.0..2.0).contains(d)));
}

// ---------------------------------------------------------------------------------------------------------- errors

#[test]
fn bad_options_are_refused() {
    let plane = mesh(&grid(4, 0.0));
    for boundary in [-0.1, 1.1, f64::NAN] {
        let error = refused(&plane, &HeatOptions { boundary, ..HeatOptions::default() });
        assert_eq!(error.reason(), Reason::BadArgument);
    }
    for t in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = refused(&plane, &HeatOptions { time_step: TimeStep::Value(t), ..HeatOptions::default() });
        assert_eq!(error.reason(), Reason::BadTimeStep);
    }
    let huge = mesh(&scaled(&grid(4, 0.0), 1e200));
    let error = refused(&huge, &HeatOptions { time_step: TimeStep::Value(1.0), ..HeatOptions::default() });
    assert_eq!(error.reason(), Reason::BadTimeStep);
    #[cfg(not(feature = "ldl"))]
    assert_eq!(
        refused(&plane, &HeatOptions { solver: Solver::Ldl, ..HeatOptions::default() }).reason(),
        Reason::MissingFeature
    );
}

#[test]
fn bad_sources_are_named() {
    let plane = mesh(&grid(4, 0.0));
    let solver = solver(&plane, &HeatOptions::default());
    let refused = |sources: &[Source]| {
        let error = solver.field(sources, &Control::new()).unwrap_err();
        (error.reason(), error.element())
    };
    assert_eq!(refused(&[]), (Reason::NoSource, None));
    let good = || Source::vertex(0);
    assert_eq!(refused(&[good(), Source::vertex(25)]), (Reason::VertexOutOfRange, Some(Element::Source(1))));
    assert_eq!(refused(&[good(), good().with_offset(f64::NAN)]), (Reason::BadArgument, Some(Element::Source(1))));
    let far = [Source::vertex(1).with_offset(1e308), good().with_offset(-1e308)];
    assert_eq!(refused(&far), (Reason::BadArgument, Some(Element::Source(0))));
}

#[test]
fn cancelled_work_stops() {
    let plane = mesh(&grid(4, 0.0));
    let control = Control::new();
    let solver = HeatSolver::new(&plane, &HeatOptions::default(), &control).unwrap();
    assert_eq!(control.progress(), 1.0);
    control.cancel();
    let cancelled = |result: Result<(), Error>| assert_eq!(result.unwrap_err().reason(), Reason::Cancelled);
    cancelled(HeatSolver::new(&plane, &HeatOptions::default(), &control).map(drop));
    cancelled(solver.with_time_step(&TimeStep::Value(1.0), &control).map(drop));
    cancelled(solver.field(&[Source::vertex(0)], &control).map(drop));
}

// ----------------------------------------------------------------------------------------------------------- soups

/// Every query is an answer without NaN and nothing below 0, or an error that says why; returns whether it was answers.
fn survives(name: &str, mesh: &Mesh) -> bool {
    let mut answered = true;
    for laplacian in [Laplacian::Intrinsic, Laplacian::Plain] {
        for (shift, boundary) in [(Shift::Pinned, 0.0), (Shift::Min, 0.5)] {
            let options = HeatOptions { laplacian, shift, boundary, ..HeatOptions::default() };
            let solver = match HeatSolver::new(mesh, &options, &Control::new()) {
                Ok(solver) => solver,
                Err(error) => {
                    assert_eq!(error.reason(), Reason::BadTimeStep, "{name}: {error}");
                    answered = false;
                    continue;
                }
            };
            let last = mesh.vertex_count() as u32 - 1;
            for sources in [vec![0], vec![last], vec![0, last / 2, last]] {
                let sources: Vec<Source> = sources.into_iter().map(Source::vertex).collect();
                let d = solver.field(&sources, &Control::new()).unwrap().into_distances();
                assert!(d.iter().all(|&d| d >= 0.0), "{name} {options:?}");
                assert!(d.contains(&0.0), "{name} {options:?}");
            }
        }
    }
    answered
}

#[test]
fn soups_are_survived() {
    let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.5, 0.5, 1.0]];
    let strip: Vec<[f64; 3]> = (0..16)
        .map(|i| {
            let (turn, side) = (f64::from(i / 2) * std::f64::consts::TAU / 8.0, f64::from(i % 2) - 0.5);
            let radius = 3.0 + side * (turn / 2.0).cos();
            [radius * turn.cos(), radius * turn.sin(), side * (turn / 2.0).sin()]
        })
        .collect();
    let quads = (0..8u32).flat_map(|i| {
        let [a, b] = [2 * i, 2 * i + 1];
        let [c, d] = if i == 7 { [1, 0] } else { [a + 2, b + 2] };
        [[a, b, c], [b, d, c]]
    });
    let needle = [[0.0; 3], [1.0, 0.0, 0.0], [0.5, 1e-9, 0.0], [0.5, 1.0, 0.0], [0.5, -1e-12, 0.0]];
    let far_away = square.map(|[x, y, _]| [1e300, 1e-100 * x, 1e-100 * y]);
    let mut unused = square.to_vec();
    unused.push([f64::NAN, f64::INFINITY, 0.0]);
    let soups = [
        ("one triangle", square.to_vec(), vec![[0, 1, 2]]),
        ("three triangles on an edge", square.to_vec(), vec![[0, 1, 2], [0, 1, 3], [1, 0, 4]]),
        ("the same triangle three times", square.to_vec(), vec![[0, 1, 2]; 3]),
        ("a triangle and its mirror image", square.to_vec(), vec![[0, 1, 2], [2, 1, 0]]),
        ("an obtuse pillow", needle.to_vec(), vec![[0, 1, 2], [2, 1, 0], [0, 1, 3]]),
        ("a repeated index", square.to_vec(), vec![[0, 1, 1], [0, 1, 2], [2, 2, 2]]),
        (
            "only repeated indices and no area",
            vec![[0.0; 3], [1.0, 0.0, 0.0], [3.0, 0.0, 0.0]],
            vec![[0, 1, 1], [0, 1, 2]],
        ),
        ("duplicate vertices", [&square[..], &square].concat(), vec![[0, 1, 2], [5, 7, 8], [0, 5, 2], [5, 2, 7]]),
        ("a Möbius strip", strip, quads.collect()),
        ("needles", needle.to_vec(), vec![[0, 1, 2], [0, 2, 3], [2, 1, 3], [0, 4, 1]]),
        ("fans that share a vertex", square.to_vec(), vec![[0, 1, 4], [4, 2, 3]]),
        ("an unused vertex that is not finite", unused, vec![[0, 1, 4], [4, 2, 3], [0, 1, 2]]),
        ("a plane so far away that its units overflow", far_away.to_vec(), vec![[0, 1, 2], [0, 2, 3]]),
        ("flipped neighbours", square.to_vec(), vec![[0, 1, 2], [0, 3, 2], [0, 4, 2]]),
    ];
    for (name, positions, triangles) in &soups {
        assert!(survives(name, &Mesh::from_triangles(positions, triangles).unwrap()), "{name}");
    }
    // All points in one place, or nothing to travel over.
    for (positions, triangles) in
        [(vec![[1.0; 3]; 3], vec![[0, 1, 2]]), (vec![[1.0; 3]; 3], vec![]), (vec![[1.0; 3]; 3], vec![[0, 1, 1]])]
    {
        assert!(!survives("without a time step", &Mesh::from_triangles(&positions, &triangles).unwrap()));
    }
}

#[test]
fn a_mesh_without_vertices_or_triangles() {
    let options = HeatOptions { time_step: TimeStep::Value(1.0), ..HeatOptions::default() };
    let empty = solver(&Mesh::from_triangles(&[], &[]).unwrap(), &options);
    let error = empty.field(&[Source::vertex(0)], &Control::new()).unwrap_err();
    assert_eq!(error.reason(), Reason::VertexOutOfRange);
    let points = Mesh::from_triangles(&[[0.0; 3]; 2], &[]).unwrap();
    assert_eq!(distances(&points, &options, &[Source::vertex(1)]), [f64::INFINITY, 0.0]);
}

#[test]
fn corpus_soups_are_survived() {
    for (name, mesh) in bad_meshes() {
        assert!(survives(name, &mesh), "{name}");
    }
}
