//! The heat method, the stages of set-up, another time step, solves from vertices and curves, and the paths down its
//! distances apart: on shapes made here and, where the corpus is, on real meshes.
//!
//! ```text
//! cargo bench --bench heat
//! ```

#[path = "common/meshes.rs"]
mod meshes;

use criterion::{Criterion, criterion_group, criterion_main};
use std::time::Duration;
use taut::{Control, HeatOptions, HeatSolver, HeatTimes, Mesh, Source, Target};

/// A stage of a set-up, and the time that the solver itself tells of it.
type Stage = (&'static str, fn(HeatTimes) -> Duration);

const STAGES: [Stage; 6] = [
    ("delaunay", |times| times.delaunay),
    ("assembly", |times| times.assembly),
    ("order", |times| times.order),
    ("symbolic", |times| times.symbolic),
    ("numeric, Poisson", |times| times.poisson),
    ("numeric, heat", |times| times.heat),
];

fn heat(criterion: &mut Criterion) {
    let (options, control) = (HeatOptions::default(), Control::new());
    for (name, mesh) in meshes::all() {
        let mut group = criterion.benchmark_group(format!("heat/{name}"));
        group.sample_size(10);
        let new = || HeatSolver::new(&mesh, &options, &control).expect("a mesh with edges");
        group.bench_function("set-up", |bencher| bencher.iter(new));
        for (stage, time) in STAGES {
            group.bench_function(stage, |bencher| {
                bencher.iter_custom(|times| (0..times).map(|_| time(new().report().times)).sum());
            });
        }
        let solver = new();
        let vertex = |i: usize| mesh.triangles()[i % mesh.triangle_count()][0];
        group.bench_function("time step", |bencher| {
            bencher.iter(|| solver.with_time_step(&options.time_step, &control));
        });
        let source = [Source::vertex(meshes::source(&mesh))];
        group.bench_function("solve", |bencher| bencher.iter(|| solver.field(&source, &control)));
        let eight: Vec<Vec<Source>> = (0..8).map(|i| vec![Source::vertex(vertex(97 * i))]).collect();
        group.bench_function("eight rows", |bencher| bencher.iter(|| solver.distance_rows(&eight, 1, &control)));
        let distances = solver.field(&source, &control).expect("a source").into_distances();
        for (name, curves) in curves(&mesh, &distances, &source) {
            group.bench_function(name, |bencher| bencher.iter(|| solver.field(&curves, &control)));
        }
        let targets: Vec<Target> = (0..100).map(|i| Target::Vertex(vertex(1009 * i))).collect();
        group.bench_function("100 paths", |bencher| {
            bencher.iter(|| taut::descent_paths(&mesh, &distances, &source, &targets, &Control::new()));
        });
        group.finish();
    }
}

/// Curves to start from: the path from the farthest vertex, and the lines half way to it.
fn curves(mesh: &Mesh, distances: &[f64], source: &[Source]) -> [(&'static str, Vec<Source>); 2] {
    let reached = (0..).zip(distances).filter(|(_, d)| d.is_finite());
    let (farthest, d) = reached.max_by(|(_, a), (_, b)| a.total_cmp(b)).expect("a source reaches itself");
    let paths = taut::descent_paths(mesh, distances, source, &[Target::Vertex(farthest)], &Control::new())
        .expect("its own field");
    let lines = taut::isolines(mesh, distances, &[0.5 * d]).expect("its own field");
    [
        ("solve, path", paths.into_iter().flatten().map(|path| Source::curve(path.curve)).collect()),
        ("solve, isoline", lines.into_iter().map(|line| Source::curve(line.curve)).collect()),
    ]
}

criterion_group!(benches, heat);
criterion_main!(benches);
