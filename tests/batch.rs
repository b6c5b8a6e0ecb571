//! Many sources over one mesh: rows in threads, distances within a radius, farthest points.

mod common;

use common::corpus;
use std::ops::ControlFlow;
use std::sync::{Arc, Mutex};
use std::thread;
use taut::{Control, Element, ExactOptions, ExactSolver, Mesh, Reason, Source, SurfacePoint, shapes};

fn made() -> Vec<(&'static str, Mesh)> {
    let shapes = [("terrain", shapes::terrain(20, 0.5)), ("torus", shapes::torus(30, 20, 2.0, 0.7))];
    let mut meshes: Vec<_> = shapes.map(|(name, shape)| (name, shape.mesh().unwrap())).into();
    // Two components and an unreferenced vertex.
    let mut two = shapes::icosphere(2);
    let count = two.positions.len() as u32;
    two.positions.extend(two.positions.clone().iter().map(|p| [p[0] + 3.0, p[1], p[2]]));
    two.triangles.extend(two.triangles.clone().iter().map(|t| t.map(|v| v + count)));
    two.positions.push([9.0, 9.0, 9.0]);
    meshes.push(("two spheres", two.mesh().unwrap()));
    meshes
}

fn alone(solver: &ExactSolver, sources: &[Source]) -> Vec<f64> {
    solver.field(sources, &ExactOptions::default(), &Control::new()).unwrap().distances().to_vec()
}

fn sets(mesh: &Mesh, count: u32) -> Vec<Vec<Source>> {
    let step = mesh.vertex_count() as u32 / count;
    let inside = |i: u32| SurfacePoint { face: i * 7 % mesh.triangle_count() as u32, barycentric: [0.2, 0.3, 0.5] };
    (0..count)
        .map(|i| match i % 3 {
            0 => vec![Source::vertex(i * step)],
            1 => vec![Source::point(inside(i)), Source::vertex(i).with_offset(0.1)],
            _ => vec![Source::vertex(i * step).with_offset(-0.5), Source::vertex(i)],
        })
        .collect()
}

#[test]
fn rows_are_fields_to_the_bit_for_any_number_of_threads() {
    for (name, mesh) in made() {
        let solver = ExactSolver::new(&mesh).unwrap();
        let sets = sets(&mesh, 20);
        let expected: Vec<Vec<f64>> = sets.iter().map(|set| alone(&solver, set)).collect();
        for threads in [0, 1, 2, 8, 100] {
            let rows = solver.distance_rows(&sets, threads, &Control::new()).unwrap();
            assert!(rows == expected, "{name}: {threads} threads");
        }
    }
}

#[test]
fn no_rows_of_no_sources() {
    let solver = ExactSolver::new(&shapes::icosphere(1).mesh().unwrap()).unwrap();
    assert!(solver.distance_rows(&[], 3, &Control::new()).unwrap().is_empty());
    let sparse = solver.distances_within(&[], 1.0, 3, &Control::new()).unwrap();
    assert_eq!((sparse.rows(), sparse.row_start()), (0, &[0][..]));
    let error = solver.distance_rows(&[Vec::new()], 3, &Control::new()).unwrap_err();
    assert_eq!(error.reason(), Reason::NoSource);
}

#[test]
fn progress_ends_with_the_work() {
    let solver = ExactSolver::new(&shapes::icosphere(2).mesh().unwrap()).unwrap();
    let sources: Vec<Source> = (0..7).map(Source::vertex).collect();
    let sets: Vec<Vec<Source>> = sources.chunks(1).map(<[Source]>::to_vec).collect();
    let calls: [&dyn Fn(&Control); 3] = [
        &|control| drop(solver.distance_rows(&sets, 3, control).unwrap()),
        &|control| drop(solver.distances_within(&sources, 0.1, 3, control).unwrap()),
        &|control| drop(solver.farthest_points(&sources, 1000, control).unwrap()),
    ];
    for call in calls {
        let control = Control::new();
        call(&control);
        assert_eq!(control.progress(), 1.0);
    }
}

#[test]
fn rows_within_a_radius_are_the_near_part_of_fields() {
    for (name, mesh) in made() {
        let solver = ExactSolver::new(&mesh).unwrap();
        let sources: Vec<Source> = sets(&mesh, 30).into_iter().flatten().collect();
        for radius in [0.0, 0.05, 0.3, 2.0, f64::INFINITY] {
            let [serial, threaded] =
                [1, 3].map(|threads| solver.distances_within(&sources, radius, threads, &Control::new()).unwrap());
            assert_eq!(serial, threaded, "{name}");
            assert_eq!(serial.rows(), sources.len());
            for (i, source) in sources.iter().enumerate() {
                let row = serial.row_start()[i]..serial.row_start()[i + 1];
                let near: Vec<(u32, f64)> = (0..)
                    .zip(alone(&solver, std::slice::from_ref(source)))
                    .filter(|&(_, d)| d <= radius && d < f64::INFINITY)
                    .collect();
                let given: Vec<(u32, f64)> = serial.vertices()[row.clone()]
                    .iter()
                    .copied()
                    .zip(serial.distances()[row].iter().copied())
                    .collect();
                assert_eq!(given, near, "{name}: source {i} within {radius}");
            }
        }
    }
}

#[test]
fn each_sample_is_the_farthest_from_those_before() {
    for (name, mesh) in made() {
        let solver = ExactSolver::new(&mesh).unwrap();
        let mut sources = vec![Source::vertex(3), Source::vertex(5).with_offset(-0.2)];
        let samples = solver.farthest_points(&sources, 25, &Control::new()).unwrap();
        assert_eq!(samples.len(), 25);
        for (i, &(v, distance)) in samples.iter().enumerate() {
            let mut all = alone(&solver, &sources);
            all.truncate(all.len() - usize::from(name == "two spheres")); // not on the surface
            let farthest = all.iter().copied().fold(0.0, f64::max);
            let near = |a: f64, b: f64| a == b || (a - b).abs() <= 1e-14 * b.abs();
            assert!(near(distance, farthest) && near(all[v as usize], farthest), "{name}: sample {i} at {distance}");
            sources.push(Source::vertex(v));
        }
    }
}

#[test]
fn samples_end_with_the_vertices() {
    let mesh = shapes::icosphere(1).mesh().unwrap();
    for offset in [0.0, -0.01] {
        let first = [Source::vertex(0).with_offset(offset)];
        let samples = ExactSolver::new(&mesh).unwrap().farthest_points(&first, 1000, &Control::new()).unwrap();
        let mut taken: Vec<u32> = samples.iter().map(|&(v, _)| v).collect();
        taken.sort_unstable();
        assert_eq!(taken, (1..mesh.vertex_count() as u32).collect::<Vec<_>>(), "start distance {offset}");
    }
}

#[test]
fn errors_and_cancellation_leave_no_rows() {
    let mesh = shapes::terrain(40, 0.5).mesh().unwrap();
    let solver = ExactSolver::new(&mesh).unwrap();
    let sets = vec![vec![Source::vertex(0)], vec![Source::vertex(1), Source::vertex(9999)]];
    let error = solver.distance_rows(&sets, 2, &Control::new()).unwrap_err();
    assert_eq!((error.reason(), error.element()), (Reason::VertexOutOfRange, Some(Element::Source(2))));
    let error = solver.distances_within(&[Source::vertex(0)], -1.0, 2, &Control::new()).unwrap_err();
    assert_eq!(error.reason(), Reason::BadArgument);
    let error = solver.farthest_points(&[], 2, &Control::new()).unwrap_err();
    assert_eq!(error.reason(), Reason::NoSource);

    // The callback runs on the thread of the call only, and its progress never falls.
    let seen = Arc::new(Mutex::new(Vec::new()));
    let control = Control::new();
    let (caller, told) = (thread::current().id(), seen.clone());
    control.set_callback(move |progress| {
        assert_eq!(thread::current().id(), caller);
        told.lock().unwrap().push(progress);
        if progress > 0.5 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    let sources: Vec<Source> = (0..60).map(Source::vertex).collect();
    let error = solver.distances_within(&sources, f64::INFINITY, 3, &control).unwrap_err();
    assert_eq!(error.reason(), Reason::Cancelled);
    assert!(seen.lock().unwrap().is_sorted());
}

#[test]
fn a_real_mesh_in_threads() {
    let Some(folder) = corpus() else { return };
    let mesh = Mesh::read(folder.join("bumpy.off")).unwrap();
    let solver = ExactSolver::new(&mesh).unwrap();
    let sets = sets(&mesh, 12);
    let rows = solver.distance_rows(&sets, 2, &Control::new()).unwrap();
    for (row, set) in rows.iter().zip(&sets) {
        assert!(*row == alone(&solver, set));
    }
}
