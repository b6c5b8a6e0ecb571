//! Exact distances, set-up and solve apart: on shapes made here and, where the corpus is, on real meshes.
//!
//! ```text
//! cargo bench --bench exact
//! ```

#[path = "common/meshes.rs"]
mod meshes;

use criterion::{Criterion, criterion_group, criterion_main};
use taut::{Control, ExactOptions, ExactSolver, Source};

fn exact(criterion: &mut Criterion) {
    for (name, mesh) in meshes::all() {
        let mut group = criterion.benchmark_group(format!("exact/{name}"));
        group.sample_size(10);
        let source = [Source::vertex(meshes::source(&mesh))];
        let solver = ExactSolver::new(&mesh).expect("a mesh was checked");
        group.bench_function("set-up", |bencher| bencher.iter(|| ExactSolver::new(&mesh)));
        group.bench_function("solve", |bencher| {
            bencher.iter(|| solver.field(&source, &ExactOptions::default(), &Control::new()));
        });
        group.finish();
    }
}

criterion_group!(benches, exact);
criterion_main!(benches);
