//! Curves as sources, as a person gives them.

mod common;

use common::Desk;

/// The distances from the line x = 5 of a grid of 20 × 20 squares.
fn from_five() -> Vec<f64> {
    (0..441).map(|v| (f64::from(v % 21) - 5.0).abs()).collect()
}

#[track_caller]
fn assert_near(ours: &[f64], expected: &[f64]) {
    assert_eq!(ours.len(), expected.len());
    for (v, (d, e)) in ours.iter().zip(expected).enumerate() {
        assert!((d - e).abs() < 1e-13, "vertex {v}: {d}, expected {e}");
    }
}

#[test]
fn points_of_all_kinds_make_a_line() {
    let desk = Desk::with_grid();
    // Vertices that share no triangle, places beside the surface, a point of a triangle: corner 0 of triangle 2 * (5 + 20 * 7).
    let points =
        ["5\n425", "5\n5 11.25 0\n425 # the other end", "# upward\n5 -1 3\n\t5 20.5 -2\n", "290 1 0 0\n5\n5\n425\n"];
    for text in points {
        desk.write("line.txt", text);
        assert_near(&desk.distances("distance grid.obj --method exact --source-curve line.txt"), &from_five());
    }
    // The first curve of an OBJ file is closed, the second has two points.
    desk.write("lines.OBJ", "v 5 0 0\nv 5 20 0\no other\nv 8 8 1\nv 8 12 1\nl 1 2 1\nl -2 -1\nf 1 2 3\n");
    let expected: Vec<f64> = (0..441)
        .map(|v| {
            let [x, y] = [v % 21, v / 21].map(f64::from);
            (x - 5.0).abs().min((x - 8.0).hypot((y - y.clamp(8.0, 12.0)).abs()))
        })
        .collect();
    assert_near(&desk.distances("distance grid.obj --method exact --source-curve lines.OBJ"), &expected);
}

#[test]
fn curves_come_last_and_each_is_one_source() {
    let desk = Desk::with_grid();
    desk.write("two.txt", "0\n420\n\n# and the right side\n20\n440\n");
    desk.write("sources.txt", "220 0.5\n");
    let nearest = |line: &str| -> Vec<i32> { desk.prints(line).lines().map(|n| n.parse().unwrap()).collect() };
    let found = nearest("voronoi grid.obj --source-curve two.txt --source 220");
    assert_eq!((found[220], found[0], found[210 + 1], found[440], found[210 + 18]), (0, 1, 1, 2, 2));
    assert_eq!(nearest("voronoi grid.obj --sources sources.txt --source-curve two.txt")[220], 0);
    let found = nearest("voronoi grid.obj --source-curve two.txt --source-curve two.txt");
    assert!(found.contains(&0) && found.contains(&1));
}

#[test]
fn what_the_command_writes_is_a_source() {
    let desk = Desk::with_grid();
    desk.prints("isolines grid.obj --method exact --source 0 --count 3 -o lines.obj");
    let from_lines = desk.distances("distance grid.obj --method exact --source-curve lines.obj");
    // Three levels between 0 and 20 √2, of which the lines are chords.
    let level = 20.0 * 2f64.sqrt() / 4.0;
    assert!((from_lines[0] - level).abs() < 0.1, "{} to the first line", from_lines[0]);
    for (file, option) in [("path.txt", ""), ("path.obj", "-o path.obj")] {
        let printed = desk.prints(&format!("path grid.obj --source 0 --target 437 --target 120 {option}"));
        desk.write("path.txt", &printed);
        let from_paths = desk.distances(&format!("distance grid.obj --method exact --source-curve {file}"));
        assert!([0, 437, 120].iter().all(|&v| from_paths[v as usize] == 0.0), "{file}");
        assert!(from_paths[21] > 0.5, "{file}");
    }
    // A path that begins at its source is a point; one that leads nowhere is none.
    let point = desk.prints("path grid.obj --source 7 --target 7");
    desk.write("point.txt", &point);
    let paths = desk.prints("path grid.obj --source-curve point.txt --target 0 --picture path.png");
    assert!(paths.starts_with("# target 0: source 0, length 7\n"), "{paths}");
    assert!(desk.path("path.png").exists());
}

#[test]
fn what_is_wrong_is_said() {
    let desk = Desk::with_grid();
    let refused = |text: &str, name: &str| {
        desk.write(name, text);
        desk.says(1, &format!("distance grid.obj --method exact --source-curve {name}"))
    };
    for (text, name, said) in [
        ("# nothing\n", "empty.txt", "has no curves"),
        ("1\n\n2 3\n", "odd.txt", "line 3: expected a vertex"),
        ("1\n441\n", "far.txt", "the mesh has no triangle at a vertex 441"),
        ("1\n800 1 0 0\n", "face.txt", "point 1: lies in triangle 800"),
        ("1\nnan 0 0\n", "nan.txt", "not finite"),
        ("v 0 0 0\nl 1 2\n", "lines.obj", "line 2: expected the numbers of vertices above"),
        ("v 0 0\n", "short.obj", "line 1: expected three coordinates"),
        ("v 0 0 0\nl\n", "none.obj", "line 2: expected the numbers"),
    ] {
        let message = refused(text, name);
        assert!(message.contains(name) && message.contains(said), "{message}");
    }
    assert!(desk.says(1, "distance grid.obj --source-curve missing.txt").contains("missing.txt"));
    desk.write("line.txt", "0\n1\n");
    let [heat, exact] = ["heat", "exact"]
        .map(|method| desk.distances(&format!("distance grid.obj --source-curve line.txt --method {method}")));
    assert!(heat.iter().zip(&exact).all(|(heat, exact)| (heat - exact).abs() < 0.1 * exact + 0.5));
    assert!(desk.says(2, "isolines grid.obj --values x --source-curve line.txt --count 3").contains("--source-curve"));
}
