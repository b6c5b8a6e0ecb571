//! `taut path`, and sources anywhere on the surface, as a person runs them.

mod common;

use common::{Desk, obj};
use serde_json::Value;
use taut::shapes;

/// What the command prints: the comment of each target, and the points behind it.
fn printed(text: &str) -> Vec<(String, Vec<[f64; 3]>)> {
    let point = |line: &str| {
        let numbers: Vec<f64> = line.split(' ').map(|word| word.parse().unwrap()).collect();
        numbers.try_into().unwrap()
    };
    let path = |block: &str| {
        let mut lines = block.lines();
        (lines.next().unwrap().to_owned(), lines.map(point).collect())
    };
    text.split("\n\n").map(path).collect()
}

fn euclid(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
}

fn length(points: &[[f64; 3]]) -> f64 {
    points.windows(2).map(|ends| euclid(ends[0], ends[1])).sum()
}

#[track_caller]
fn assert_near(a: f64, b: f64) {
    assert!((a - b).abs() <= 1e-12 * b.abs().max(1.0), "{a}, expected {b}");
}

#[test]
fn paths_on_a_flat_grid_are_straight_lines_to_the_nearer_source() {
    let desk = Desk::with_grid();
    let paths = printed(&desk.prints("path grid.obj --source 0 --source 440 --target 7 --target 433 --target 71"));
    assert_eq!(paths.len(), 3);
    for ((head, points), (i, source, from, to)) in paths.iter().zip([
        (0, 0, [7.0, 0.0, 0.0], [0.0; 3]),
        (1, 1, [13.0, 20.0, 0.0], [20.0, 20.0, 0.0]),
        (2, 0, [8.0, 3.0, 0.0], [0.0; 3]),
    ]) {
        let told = head.strip_prefix(&format!("# target {i}: source {source}, length ")).expect(head);
        assert_near(told.parse().unwrap(), euclid(from, to));
        assert_near(length(points), euclid(from, to));
        assert_eq!((points[0], points[points.len() - 1]), (from, to), "{head}");
        // It crosses every line of the grid.
        assert!(points.len() >= 8, "{head}");
    }
}

#[test]
fn sources_and_targets_are_anywhere() {
    let desk = Desk::with_grid();
    // Above the grid and beside it: the nearest places are straight below and on the rim.
    let line =
        "path grid.obj --source 440 --source-at 2.25,3.5,7 --target 0 --target-at -5,3.5,0 --target-at 19.5,19.75,1";
    let paths = printed(&desk.prints(line));
    let ends: Vec<[[f64; 3]; 2]> = paths.iter().map(|(_, points)| [points[0], points[points.len() - 1]]).collect();
    for (ends, expected) in ends.iter().zip([
        [[0.0; 3], [2.25, 3.5, 0.0]],
        [[0.0, 3.5, 0.0], [2.25, 3.5, 0.0]],
        [[19.5, 19.75, 0.0], [20.0, 20.0, 0.0]],
    ]) {
        assert!((0..2).all(|k| euclid(ends[k], expected[k]) < 1e-14), "{ends:?}, expected {expected:?}");
    }
    let sources: Vec<bool> = paths.iter().map(|(head, _)| head.contains("source 1")).collect();
    assert_eq!(sources, [true, true, false], "vertices are counted before points");
}

#[test]
fn distances_and_isolines_begin_at_points_too() {
    let desk = Desk::with_grid();
    let found = desk.distances("distance grid.obj --method exact --source-at 2.25,3.5,0");
    for (d, p) in found.iter().zip(shapes::grid(20, 20).positions) {
        assert_near(*d, euclid(p, [2.25, 3.5, 0.0]));
    }
    desk.prints("isolines grid.obj --method exact --source-at 2.25,3.5,0 --count 3 -o lines.obj");

    let point = &desk.json("path grid.obj --source 0 --target-at 2.25,3.5,0 --json")["paths"][0]["points"][0];
    let weights: Vec<String> = point["barycentric"].as_array().unwrap().iter().map(Value::to_string).collect();
    desk.write("sources.txt", &format!("{} {}\n440 100\n", point["face"], weights.join(" ")));
    assert_eq!(desk.distances("distance grid.obj --method exact --sources sources.txt"), found);
    desk.write("sources.txt", &format!("{} {} 1.5\n", point["face"], weights.join(" ")));
    for (later, d) in desk.distances("distance grid.obj --method exact --sources sources.txt").iter().zip(&found) {
        assert_near(*later, d + 1.5);
    }

    let by_heat = desk.distances("distance grid.obj --source-at 2.25,3.5,0");
    assert!(by_heat.iter().zip(&found).all(|(heat, exact)| (heat - exact).abs() < 0.1 * exact + 0.5));
}

#[test]
fn the_object_of_json_has_what_the_text_has() {
    let desk = Desk::new();
    desk.write("knot.obj", &obj(&shapes::knot(60, 8, 0.4)));
    desk.write("sources.txt", "0 0.25\n");
    let targets = "--target 250 --target 0 --target-at 1,1,1";
    let text = printed(&desk.prints(&format!("path knot.obj --sources sources.txt {targets}")));
    let report = desk.json(&format!("path knot.obj --sources sources.txt {targets} --json"));
    assert_eq!((&report["vertices"], &report["faces"]), (&480.into(), &960.into()));
    assert!(["read", "setup", "solve", "paths"].iter().all(|stage| report["timing"][stage]["cpu"].is_number()));
    let paths = report["paths"].as_array().unwrap();
    assert_eq!(paths.len(), 3);
    for (path, (head, points)) in paths.iter().zip(&text) {
        let told = head.rsplit(' ').next().unwrap().parse().unwrap();
        assert_near(path["length"].as_f64().unwrap(), told);
        assert_eq!(path["source"], 0);
        assert_near(path["distance"].as_f64().unwrap(), length(points) + 0.25);
        let found = path["points"].as_array().unwrap();
        assert_eq!(found.len(), points.len());
        for (point, position) in found.iter().zip(points) {
            let told: Vec<f64> = point["position"].as_array().unwrap().iter().filter_map(Value::as_f64).collect();
            assert!(euclid(told.try_into().unwrap(), *position) < 1e-14);
        }
        let sums = found.iter().map(|p| p["barycentric"].as_array().unwrap().iter().filter_map(Value::as_f64).sum());
        sums.for_each(|sum: f64| assert_near(sum, 1.0));
    }
    assert_eq!(text[1].0, "# target 1: source 0, length 0", "a target that is the source");
    assert_eq!(text[1].1.len(), 1);
}

#[test]
fn what_no_source_reaches_has_no_path() {
    let desk = Desk::new();
    desk.write("two.off", "OFF\n7 2 0\n0 0 0\n1 0 0\n0 1 0\n5 0 0\n6 0 0\n5 1 0\n9 9 9\n3 0 1 2\n3 3 4 5\n");
    let line = "path two.off --source 1 --target 4 --target 2 --target 6";
    let text = desk.prints(line);
    let near = "# target 1: source 0, length 1.4142135623730951\n0 1 0\n1 0 0\n";
    assert_eq!(text, format!("# target 0: no path\n\n{near}\n# target 2: no path\n"));
    let paths = &desk.json(&format!("{line} --json"))["paths"];
    assert!(paths[0].is_null() && paths[1].is_object() && paths[2].is_null());
    assert_eq!(desk.prints(&format!("{line} -o paths.obj --picture paths.png")), "");
    let file = desk.read("paths.obj");
    assert!(file.ends_with("\no target_1\nv 0 1 0\nv 1 0 0\nl 1 2\n") && file.matches("o ").count() == 1, "{file}");

    let beyond = desk.prints("path two.off --source 1 --target 2 --target 0 --radius 1.2");
    assert_eq!(beyond, "# target 0: no path\n\n# target 1: source 0, length 1\n0 0 0\n1 0 0\n");
}

#[test]
fn paths_are_written_as_lines_and_drawn() {
    let desk = Desk::with_grid();
    let line = "path grid.obj --source 0 --target 440 --target 0";
    desk.prints(&format!("{line} -o paths.obj"));
    let file = desk.read("paths.obj");
    let count = file.matches("\nv ").count();
    let indices: Vec<String> = (1..count).map(|i| i.to_string()).collect();
    assert!(file.contains("\no target_0\nv 20 20 0\n") && file.contains(&format!("\nl {}\n", indices.join(" "))));
    assert!(file.ends_with(&format!("\no target_1\nv 0 0 0\np {count}\n")), "{file}");

    desk.prints(&format!("{line} -o paths.svg --view top"));
    let file = desk.read("paths.svg");
    assert!(file.starts_with("<svg ") && file.contains("<title>target 0</title>\n<polyline points="), "{file}");

    let draw = |line: &str| {
        desk.prints(&format!("{line} --size 300x200 --view top --picture picture.png"));
        std::fs::read(desk.path("picture.png")).unwrap()
    };
    let [none, far, near] = [
        "distance grid.obj --source 0 --method exact",
        "path grid.obj --source 0 --target 440",
        "path grid.obj --source 0 --target 220",
    ]
    .map(draw);
    assert!(far.starts_with(b"\x89PNG") && none != far && far != near);
}

#[test]
fn paths_by_heat_descend_to_the_nearer_source() {
    let desk = Desk::with_grid();
    let line = "path grid.obj --source 0 --source 440 --target 7 --target 433 --target-at 8.5,3.25,0 --method heat";
    let paths = printed(&desk.prints(line));
    let report = desk.json(&format!("{line} --json"));
    let by_heat = desk.distances("distance grid.obj --source 0 --source 440");
    for (i, (head, points)) in paths.iter().enumerate() {
        let source = usize::from(i == 1);
        assert!(head.starts_with(&format!("# target {i}: source {source}, length ")), "{head}");
        let [from, to] = [points[0], [20.0 * source as f64, 20.0 * source as f64, 0.0]];
        assert_eq!(points[points.len() - 1], to);
        let shortest = euclid(from, to);
        assert!((shortest..1.05 * shortest).contains(&length(points)), "{head}, shortest {shortest}");
        let path = &report["paths"][i];
        assert_eq!(path["source"], source);
        assert_near(path["length"].as_f64().unwrap(), length(points));
    }
    assert_near(report["paths"][0]["distance"].as_f64().unwrap(), by_heat[7]);
    assert_near(report["paths"][1]["distance"].as_f64().unwrap(), by_heat[433]);

    // The distances of a file lead to the same place, which is then one without a lower neighbour.
    desk.prints("distance grid.obj --source 0 --source 440 -o distances.txt");
    let by_values = printed(&desk.prints("path grid.obj --values distances.txt --target 7 --target 433"));
    for ((head, points), (_, expected)) in by_values.iter().zip(&paths) {
        assert!(head.contains(": no source, length "), "{head}");
        assert_eq!(points[points.len() - 1], expected[expected.len() - 1]);
    }
    desk.prints("path grid.obj --values distances.txt --target 7 -o paths.obj --picture picture.png");
    assert!(desk.read("paths.obj").contains("\no target_0\nv 7 0 0\n"));
    assert!(desk.json("path grid.obj --values distances.txt --target 7 --json")["paths"][0]["source"].is_null());
}

#[test]
fn a_field_that_is_not_finite_at_a_target_has_no_path() {
    let desk = Desk::new();
    desk.write("square.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");
    desk.write("values.txt", "0\n1\n2\ninf\n");
    let found = desk.prints("path square.off --values values.txt --target 3 --target 1");
    assert_eq!(found, "# target 0: no path\n\n# target 1: no source, length 1\n1 0 0\n0 0 0\n");
}

#[test]
fn what_makes_no_sense_is_refused_and_leaves_no_file() {
    let desk = Desk::with_grid();
    desk.write("sources.txt", "0\n");
    desk.write("points.obj", "v 0 0 0\nv 1 0 0\n");
    for (line, expected) in [
        ("grid.obj --target 1", "--source-at"),
        ("grid.obj --source 0", "--target-at"),
        ("grid.obj --source 0 --sources sources.txt --target 1", "--sources"),
        ("grid.obj --source-at 0,0,0 --sources sources.txt --target 1", "--sources"),
        ("grid.obj --source-at 0,0 --target 1", "three finite numbers"),
        ("grid.obj --source-at 0,0,0,0 --target 1", "three finite numbers"),
        ("grid.obj --source 0 --target-at 0,nan,0", "three finite numbers"),
        ("grid.obj --source 0 --target-at 1e999,0,0", "three finite numbers"),
        ("grid.obj --source 0 --target 1 -o a.txt", ".svg"),
        ("grid.obj --source 0 --target 1 -o a.obj --view top", "--view"),
        ("grid.obj --source 0 --target 1 -o a.obj --partial", "--time-limit"),
        ("grid.obj --source 0 --target 1 -o a.obj --boundary 1", "--boundary belongs to the heat method"),
        ("grid.obj --source 0 --target 1 -o a.obj --method heat --radius 1", "--radius belongs to the exact method"),
        ("grid.obj --values sources.txt --source 0 --target 1 -o a.obj", "--source"),
        ("grid.obj --values sources.txt --target 1 -o a.obj --method heat", "--method"),
        ("grid.obj --values sources.txt --target 1 -o a.obj --radius 1", "--radius is about distances"),
    ] {
        let said = desk.says(2, &format!("path {line}"));
        assert!(said.contains(expected), "{line}: {said}");
    }
    desk.write("five.txt", "0 0.5 0.25 0.25 0 7\n");
    desk.write("weights.txt", "0 0.5 0.5 0.5\n");
    desk.write("three.txt", "0 0.5 0.5\n");
    for (line, expected) in [
        ("grid.obj --source 441 --target 0 -o a.obj", "source 0: is vertex 441"),
        ("grid.obj --source 0 --target 0 --target 441 -o a.obj", "target 1: is vertex 441"),
        ("grid.obj --source 0 --target 441 --picture a.obj", "target 0: is vertex 441"),
        ("points.obj --source 0 --target-at 0,0,0 -o a.obj", "no triangles"),
        ("grid.obj --sources five.txt --target 0 -o a.obj", "five.txt: line 1: expected a vertex, or a triangle"),
        ("grid.obj --sources three.txt --target 0 -o a.obj", "three.txt: line 1: expected a vertex, or a triangle"),
        ("grid.obj --sources weights.txt --target 0 -o a.obj", "source 0: has the weights"),
        ("grid.obj --source 0 --target 440 --time-limit 0 -o a.obj", "time limit"),
        ("grid.obj --values sources.txt --target 0 -o a.obj", "sources.txt: has 1 numbers"),
        ("grid.obj --source 0 --target 0 -o no/such/a.obj", "no/such/a.obj"),
    ] {
        let said = desk.says(1, &format!("path {line}"));
        assert!(said.contains(expected), "{line}: {said}");
    }
    assert!(!desk.path("a.obj").exists());
}
