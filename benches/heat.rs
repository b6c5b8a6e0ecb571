//! The heat method, set-up, another time step and solve apart: on shapes made here and, where the corpus is, on real meshes.
//!
//! ```text
//! cargo bench --bench heat
//! ```

#[path = "common/meshes.rs"]
mod meshes;

use criterion::{Criterion, criterion_group, criterion_main};
use taut::{Control, HeatOptions, HeatSolver, Source};

fn heat(criterion: &mut Criterion) {
    let (options, control) = (HeatOptions::default(), Control::new());
    for (name, mesh) in meshes::all() {
        let mut group = criterion.benchmark_group(format!("heat/{name}"));
        group.sample_size(10);
        let source = [Source::vertex(meshes::source(&mesh))];
        let solver = HeatSolver::new(&mesh, &options, &control).expect("a mesh with edges");
        group.bench_function("set-up", |bencher| bencher.iter(|| HeatSolver::new(&mesh, &options, &control)));
        group.bench_function("time step", |bencher| {
            bencher.iter(|| solver.with_time_step(&options.time_step, &control));
        });
        group.bench_function("solve", |bencher| bencher.iter(|| solver.field(&source, &control)));
        group.finish();
    }
}

criterion_group!(benches, heat);
criterion_main!(benches);
