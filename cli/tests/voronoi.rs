//! `taut voronoi` as a person runs it.

mod common;

use common::{Desk, obj};
use taut::shapes;

/// The areas of the cells, and how many vertices these have.
fn cells(desk: &Desk, line: &str) -> Vec<(f64, u64)> {
    let report = desk.json(&format!("voronoi {line} --json"));
    let cells = report["cells"].as_array().unwrap();
    cells.iter().map(|cell| (cell["area"].as_f64().unwrap(), cell["vertices"].as_u64().unwrap())).collect()
}

#[test]
fn cells_on_a_flat_grid_are_those_of_the_plane() {
    let desk = Desk::with_grid();
    let sources = [[0.0, 0.0], [20.0, 20.0], [13.0, 4.0], [3.3, 15.2]];
    let text = desk.prints("voronoi grid.obj --source 0 --source 440 --source 97 --source-at 3.3,15.2,0");
    let found: Vec<usize> = text.lines().map(|line| line.parse().unwrap()).collect();
    assert_eq!(found.len(), 441);
    for (p, &source) in shapes::grid(20, 20).positions.iter().zip(&found) {
        let distance = |[x, y]: [f64; 2]| (p[0] - x).hypot(p[1] - y);
        assert!(sources.iter().all(|&other| distance(sources[source]) <= distance(other) + 1e-12), "{p:?}: {source}");
    }
}

#[test]
fn areas_are_those_of_the_cells_and_not_of_their_triangles() {
    let desk = Desk::with_grid();
    // The border at x = 9.65 runs through the squares.
    let halves = cells(&desk, "grid.obj --source-at 4.3,10,0 --source-at 15,10,0");
    assert!((halves[0].0 - 193.0).abs() < 1e-4 && (halves[1].0 - 207.0).abs() < 1e-4, "{halves:?}");
    assert_eq!([halves[0].1, halves[1].1], [10 * 21, 11 * 21]);
    // A start distance of 1 moves it by a half, and bends it into a branch of a hyperbola.
    desk.write("later.txt", "220\n220 0.5\n440 1000\n");
    let alone = cells(&desk, "grid.obj --sources later.txt");
    assert!((alone[0].0 - 400.0).abs() < 1e-9 && alone[1..] == [(0.0, 0), (0.0, 0)], "{alone:?}");
    // Three cells meet in the middle of a triangle: thirds of the plane around (10, 10).
    let thirds = cells(&desk, "grid.obj --source-at 10.2,16.1,0 --source-at 4.8,7.0,0 --source-at 15.4,6.9,0");
    let total: f64 = thirds.iter().map(|cell| cell.0).sum();
    assert!((total - 400.0).abs() < 1e-9 && thirds.iter().all(|cell| cell.0 > 100.0), "{thirds:?}");
}

/// Heat knows the nearest source of vertices alone: cells are cut in the middle of edges.
#[test]
fn cells_by_heat_are_those_of_their_vertices() {
    let desk = Desk::with_grid();
    // The border at x = 9.65 becomes one at 9.5.
    let halves = cells(&desk, "grid.obj --source-at 4.3,10,0 --source-at 15,10,0 --method heat");
    assert!((halves[0].0 - 190.0).abs() < 1e-9 && (halves[1].0 - 210.0).abs() < 1e-9, "{halves:?}");
    assert_eq!([halves[0].1, halves[1].1], [10 * 21, 11 * 21]);

    desk.write("ball.obj", &obj(&shapes::icosphere(4)));
    let line = "ball.obj --source 0 --source 300 --source 700 --source 1200 --source 1900 --source 2300";
    let [heat, exact] = ["heat", "exact"].map(|method| cells(&desk, &format!("{line} --method {method}")));
    for (heat, exact) in heat.iter().zip(&exact) {
        assert!((heat.0 / exact.0 - 1.0).abs() < 0.1, "{heat:?}, exact {exact:?}");
    }
    let total = |cells: &[(f64, u64)]| cells.iter().map(|cell| cell.0).sum::<f64>();
    assert!((total(&heat) - total(&exact)).abs() < 1e-9);
    let [heat, exact] = ["heat", "exact"].map(|method| desk.prints(&format!("voronoi {line} --method {method}")));
    let differ = heat.lines().zip(exact.lines()).filter(|(heat, exact)| heat != exact).count();
    assert!(heat.lines().count() == 2562 && differ <= 50, "{differ} differ");
}

#[test]
fn areas_on_a_curved_surface_add_up() {
    let desk = Desk::new();
    desk.write("ball.obj", &obj(&shapes::icosphere(3)));
    let poles = cells(&desk, "ball.obj --source-at 0.1,0,2 --source-at -0.1,0,-2");
    // Opposite points of a symmetric body.
    assert!((poles[0].0 - poles[1].0).abs() < 1e-3, "{poles:?}");
    let total = poles[0].0 + poles[1].0;
    assert!((total / (4.0 * std::f64::consts::PI) - 1.0).abs() < 0.02, "{total}");
    assert_eq!(poles[0].1 + poles[1].1, 642);
}

#[test]
fn what_no_source_reaches_belongs_to_none() {
    let desk = Desk::new();
    desk.write("two.off", "OFF\n7 3 0\n0 0 0\n1 0 0\n0 1 0\n5 0 0\n6 0 0\n5 1 0\n9 9 nan\n3 0 1 2\n3 3 4 5\n3 3 3 4\n");
    let printed = desk.prints("voronoi two.off --source 1 --source 0 --picture cells.png");
    assert_eq!(printed, "1\n0\n1\n-1\n-1\n-1\n-1\n");
    assert!(desk.prints("voronoi two.off --source 1 --source 0 --method heat").ends_with("\n-1\n-1\n-1\n-1\n"));
    let report = desk.json("voronoi two.off --source 1 --source 0 --json");
    assert_eq!((&report["unreachable"], &report["cells"][0]["vertices"]), (&4.into(), &1.into()));
    assert!(["read", "setup", "solve", "cells"].iter().all(|stage| report["timing"][stage]["cpu"].is_number()));
    assert!(std::fs::read(desk.path("cells.png")).unwrap().starts_with(b"\x89PNG"));
}

#[test]
fn a_radius_ends_cells() {
    let desk = Desk::with_grid();
    let text = desk.prints("voronoi grid.obj --source 220 --radius 5");
    assert_eq!(text.lines().filter(|&line| line == "0").count(), 81, "points of a lattice in a circle");
    let disc = cells(&desk, "grid.obj --source 220 --radius 5")[0];
    // The circle is cut off straight in each triangle, whose sides are no longer than √2.
    let circle = 25.0 * std::f64::consts::PI;
    assert!(disc.0 < circle && disc.0 > 0.97 * circle && disc.1 == 81, "{disc:?}");
}

#[test]
fn every_cell_has_a_colour_that_ends_at_its_border() {
    let desk = Desk::with_grid();
    let pixels = |line: &str| {
        desk.prints(&format!("voronoi grid.obj {line} --picture cells.png --view top --size 1200x900 -o numbers.txt"));
        let file = std::fs::read(desk.path("cells.png")).unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().unwrap();
        let mut data = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut data).unwrap();
        data.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect::<Vec<[u8; 3]>>()
    };
    // Seen from above, away from the sources, a row has one colour on each side of the border at x = 9.15.
    let row = &pixels("--source-at 3.3,1,0 --source-at 15,1,0")[300 * 1200..][..1000];
    let spread = |[r, g, b]: &[u8; 3]| r.max(g).max(b) - r.min(g).min(b);
    let inside: Vec<[u8; 3]> = row.iter().copied().filter(|colour| spread(colour) > 40).collect();
    let mut runs: Vec<(usize, [u8; 3])> = Vec::new();
    for run in inside.chunk_by(|a, b| (0..3).all(|k| a[k].abs_diff(b[k]) < 12)).filter(|run| run.len() > 3) {
        runs.push((run.len(), run[run.len() / 2]));
    }
    let [(left, blue), (right, orange)] = runs[..] else { panic!("{runs:?}") };
    assert!(blue[2] > blue[0] && orange[0] > orange[2], "{runs:?}");
    let share = left as f64 / (left + right) as f64;
    assert!((share - 0.4575).abs() < 0.003, "{share}");
}

#[test]
fn every_mesh_has_cells_and_a_picture() {
    let desk = Desk::new();
    let triangle = |scale: &str| format!("v 0 0 0\nv {scale} 0 0\nv 0 {scale} 0\nf 1 2 3\n");
    for (name, mesh, area) in [
        ("a line", "v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n".to_owned(), Some(0.0)),
        ("one place", "v 5 5 5\nv 5 5 5\nv 5 5 5\nf 1 2 3\n".to_owned(), Some(0.0)),
        ("large", triangle("1e150"), Some(1e300 / 6.0)),
        ("huge", triangle("1.7e308"), None),
        ("subnormal", triangle("1e-320"), Some(0.0)),
        ("twice and folded", triangle("1") + "v 0 1 1\nf 1 2 3\nf 3 2 1\nf 1 2 4\nf 2 1 1\n", Some(0.5)),
    ] {
        desk.write("mesh.obj", &mesh);
        let line = "voronoi mesh.obj --source 0 --source 1 --source 2 --picture cells.png --size 64x64 --json";
        let found = desk.json(line)["cells"][2]["area"].as_f64();
        let is_right = match (found, area) {
            (Some(found), Some(area)) => (found - area).abs() <= 0.5 * area,
            _ => found == area,
        };
        assert!(is_right, "{name}: {found:?}, expected {area:?}");
    }
}

#[test]
fn what_makes_no_sense_is_refused_and_leaves_no_file() {
    let desk = Desk::with_grid();
    for (code, line, expected) in [
        (2, "", "--source-at"),
        (2, "--source 0 -o a.txt --view top", "--picture"),
        (2, "--source 0 -o a.txt --partial", "--time-limit"),
        (2, "--source 0 -o a.txt --time-step 1", "--method exact"),
        (2, "--source 0 -o a.txt --method heat --radius 5", "--method exact"),
        (1, "--source 441 -o a.txt", "source 0: is vertex 441"),
        (1, "--source 0 -o a.txt --picture no/such/a.png", "no/such/a.png"),
        (1, "--source 0 -o a.txt --memory-limit 0", "memory limit"),
    ] {
        let said = desk.says(code, &format!("voronoi grid.obj {line}"));
        assert!(said.contains(expected), "{line}: {said}");
    }
    assert!(!desk.path("a.txt").exists());
}
