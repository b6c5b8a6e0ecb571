//! Heat and exact are each other's witness; straight lines and edge paths are the witnesses of both.

mod common;

use common::corpus;
use std::collections::BinaryHeap;
use taut::{Control, ExactOptions, ExactSolver, HeatOptions, HeatSolver, Mesh, Source, shapes};

fn exact(mesh: &Mesh, source: u32) -> Vec<f64> {
    let solver = ExactSolver::new(mesh).unwrap();
    solver.field(&[Source::vertex(source)], &ExactOptions::default(), &Control::new()).unwrap().distances().to_vec()
}

fn heat(mesh: &Mesh, source: u32) -> Vec<f64> {
    let solver = HeatSolver::new(mesh, &HeatOptions::default(), &Control::new()).unwrap();
    solver.field(&[Source::vertex(source)], &Control::new()).unwrap().into_distances()
}

/// The mean error in percent over the vertices that are reached and are not the source.
fn mean_error(heat: &[f64], exact: &[f64]) -> f64 {
    let pairs = heat.iter().zip(exact).filter(|(_, exact)| exact.is_finite() && **exact > 0.0);
    let errors: Vec<f64> = pairs.map(|(heat, exact)| 100.0 * (heat - exact).abs() / exact).collect();
    errors.iter().sum::<f64>() / errors.len() as f64
}

fn length(mesh: &Mesh, a: u32, b: u32) -> f64 {
    let [p, q] = [a, b].map(|v| mesh.positions()[v as usize]);
    (0..3).map(|k| (p[k] - q[k]).powi(2)).sum::<f64>().sqrt()
}

/// Dijkstra over the edges: never shorter than the distance over the surface.
fn edge_paths(mesh: &Mesh, source: u32) -> Vec<f64> {
    let mut neighbours = vec![Vec::new(); mesh.vertex_count()];
    for &[a, b, c] in mesh.triangles().iter().filter(|&&[a, b, c]| a != b && b != c && c != a) {
        for [u, v] in [[a, b], [b, c], [c, a]] {
            neighbours[u as usize].push(v);
            neighbours[v as usize].push(u);
        }
    }
    let mut paths = vec![f64::INFINITY; mesh.vertex_count()];
    let mut heap = BinaryHeap::from([(std::cmp::Reverse(0u64), source)]);
    paths[source as usize] = 0.0;
    while let Some((std::cmp::Reverse(key), u)) = heap.pop() {
        if f64::from_bits(key) > paths[u as usize] {
            continue;
        }
        for &v in &neighbours[u as usize] {
            let path = paths[u as usize] + length(mesh, u, v);
            if path < paths[v as usize] {
                paths[v as usize] = path;
                heap.push((std::cmp::Reverse(path.to_bits()), v));
            }
        }
    }
    paths
}

/// What holds on any mesh whatever.
#[track_caller]
fn assert_sound(name: &str, mesh: &Mesh, source: u32) {
    let (exact, heat, paths) = (exact(mesh, source), heat(mesh, source), edge_paths(mesh, source));
    let largest = exact.iter().copied().filter(|d| d.is_finite()).fold(0.0, f64::max);
    for v in 0..mesh.vertex_count() {
        let (e, h, path) = (exact[v], heat[v], paths[v]);
        assert_eq!([e, h].map(f64::is_finite), [path.is_finite(); 2], "{name}, vertex {v}: exact {e}, heat {h}");
        assert!(h >= 0.0, "{name}, vertex {v}: heat {h}");
        if path.is_finite() {
            let straight = length(mesh, source, v as u32);
            let bounds = (straight - 1e-12 * largest)..=(path + 1e-12 * largest);
            assert!(bounds.contains(&e), "{name}, vertex {v}: {e} is not between {straight} and {path}");
        }
    }
    for &[a, b, c] in mesh.triangles().iter().filter(|&&[a, b, c]| a != b && b != c && c != a) {
        for [u, v] in [[a, b], [b, c], [c, a]].map(|edge| edge.map(|v| v as usize)) {
            let along = length(mesh, u as u32, v as u32) + 1e-12 * largest;
            assert!(exact[u].is_infinite() || (exact[u] - exact[v]).abs() <= along, "{name}: edge {u} {v}");
        }
    }
}

#[test]
fn heat_comes_near_exact_on_made_shapes() {
    let cases = [
        ("sphere", shapes::icosphere(4), 1.5),
        ("torus", shapes::torus(48, 24, 1.0, 0.4), 4.0),
        ("terrain", shapes::terrain(40, 0.2), 4.0),
        ("saddle", shapes::saddle(30), 4.0),
    ];
    for (name, shape, most) in cases {
        let mesh = shape.mesh().unwrap();
        let error = mean_error(&heat(&mesh, 7), &exact(&mesh, 7));
        assert!(error < most, "{name}: mean error {error} %");
        assert_sound(name, &mesh, 7);
    }
}

#[test]
fn the_error_of_heat_falls_under_refinement() {
    let errors = [2, 3, 4, 5].map(|level| {
        let mesh = shapes::icosphere(level).mesh().unwrap();
        mean_error(&heat(&mesh, 0), &exact(&mesh, 0))
    });
    assert!(errors.is_sorted_by(|a, b| a > b), "{errors:?}");
}

#[test]
fn both_methods_answer_every_mesh_of_the_corpus() {
    let Some(folder) = corpus() else { return };
    let mut seen = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap();
        if name.ends_with(".tsv") || name.ends_with(".md") {
            continue;
        }
        let mesh = Mesh::read(&path).unwrap();
        if mesh.triangle_count() <= 30_000 {
            seen += 1;
            assert_sound(name, &mesh, mesh.triangles()[0][0]);
        }
    }
    assert!(seen > 40, "only {seen} meshes");
}
