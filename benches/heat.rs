//! The heat method, the stages of set-up, another time step and solve apart: on shapes made here and, where the corpus is, on real meshes.
//!
//! ```text
//! cargo bench --bench heat
//! ```

#[path = "common/meshes.rs"]
mod meshes;

use criterion::{Criterion, criterion_group, criterion_main};
use std::time::Duration;
use taut::{Control, HeatOptions, HeatSolver, HeatTimes, Source};

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
        let source = |i: usize| vec![Source::vertex(mesh.triangles()[i % mesh.triangle_count()][0])];
        group.bench_function("time step", |bencher| {
            bencher.iter(|| solver.with_time_step(&options.time_step, &control));
        });
        group.bench_function("solve", |bencher| {
            bencher.iter(|| solver.field(&[Source::vertex(meshes::source(&mesh))], &control));
        });
        let eight: Vec<Vec<Source>> = (0..8).map(|i| source(97 * i)).collect();
        group.bench_function("eight rows", |bencher| bencher.iter(|| solver.distance_rows(&eight, 1, &control)));
        group.finish();
    }
}

criterion_group!(benches, heat);
criterion_main!(benches);
