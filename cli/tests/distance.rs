//! The command as a person runs it.

mod common;

use common::{Desk, numbers};
use serde_json::Value;
use taut::shapes;

/// Straight-line distance of each vertex of the grid from its vertex `source`.
fn euclidean(source: u32) -> Vec<f64> {
    let [x, y] = [source % 21, source / 21].map(f64::from);
    shapes::grid(20, 20).positions.iter().map(|p| (p[0] - x).hypot(p[1] - y)).collect()
}

/// The largest difference as a fraction of the largest expected value.
fn difference(found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let most = expected.iter().fold(0.0, |most: f64, &d| most.max(d));
    found.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / most
}

#[test]
fn exact_distances_on_a_flat_grid_are_straight_lines() {
    let found = Desk::with_grid().distances("distance grid.obj --source 0 --method exact");
    assert!(difference(&found, &euclidean(0)) < 1e-12);
}

#[test]
fn heat_distances_on_a_flat_grid_are_near_them() {
    let desk = Desk::with_grid();
    let plain =
        "distance grid.obj --source 220 --laplacian plain --time-step mean-edge --time-scale raw --solver supernodal";
    for line in ["distance grid.obj --source 220", plain] {
        let found = desk.distances(line);
        assert!(difference(&found, &euclidean(220)) < 0.05, "{line}");
        assert_eq!(found[220], 0.0, "{line}");
    }
}

#[test]
fn every_heat_option_reaches_the_solver() {
    let desk = Desk::with_grid();
    let plain = desk.distances("distance grid.obj --source 220");
    for option in ["--time-factor 4", "--time-step 9", "--boundary 1", "--time-step median-mean"] {
        let changed = desk.distances(&format!("distance grid.obj --source 220 {option}"));
        assert!(difference(&changed, &plain) > 1e-6, "{option}");
    }
    let ldl = desk.distances("distance grid.obj --source 220 --solver ldl");
    assert!(difference(&ldl, &plain) < 1e-9);
    let explicit = desk.json("distance grid.obj --source 220 --time-step 0.25 --shift min --json");
    assert_eq!(explicit["time_step"], 0.25);
    let paper = &desk.json("distance grid.obj --source 220 --time-step sigma --json")["time_step"];
    let raw = &desk.json("distance grid.obj --source 220 --time-step sigma --time-scale raw --json")["time_step"];
    assert_ne!(paper, raw);
}

#[test]
fn a_file_of_sources_has_offsets_and_comments() {
    let desk = Desk::with_grid();
    desk.write("sources.txt", "# two corners\n\n0\n440 -1.5 # nearer by this\n");
    let found = desk.distances("distance grid.obj --sources sources.txt --method exact");
    let [near, far] = [euclidean(0), euclidean(440)];
    let expected: Vec<f64> = near.iter().zip(&far).map(|(a, b)| a.min(b - 1.5)).collect();
    assert!(difference(&found, &expected) < 1e-12);
    let both = desk.distances("distance grid.obj --source 0 --source 440 --method exact");
    let expected: Vec<f64> = near.iter().zip(&far).map(|(a, b)| a.min(*b)).collect();
    assert!(difference(&both, &expected) < 1e-12);
}

#[test]
fn unreachable_vertices_are_inf() {
    let desk = Desk::new();
    desk.write("two.off", "OFF\n7 2 0\n0 0 0\n1 0 0\n0 1 0\n5 0 0\n6 0 0\n5 1 0\n9 9 9\n3 0 1 2\n3 3 4 5\n");
    let printed = desk.prints("distance two.off --source 0 --method exact");
    assert_eq!(printed, "0\n1\n1\ninf\ninf\ninf\ninf\n");
    let report = desk.json("distance two.off --source 0 --method exact --json");
    assert_eq!((&report["unreachable"], &report["largest_distance"]), (&4.into(), &1.0.into()));
}

#[test]
fn a_target_is_printed_alone() {
    let desk = Desk::with_grid();
    for target in [0, 22, 440] {
        let found = desk.distances(&format!("distance grid.obj --source 0 --method exact --target {target}"));
        assert_eq!(found.len(), 1);
        assert!((found[0] - euclidean(0)[target]).abs() < 1e-12);
    }
    let all = desk.prints("distance grid.obj --source 0");
    let one = desk.prints("distance grid.obj --source 0 --target 100");
    assert_eq!(one.trim_end(), all.lines().nth(100).unwrap());
    assert!(desk.says(1, "distance grid.obj --source 0 --target 441").contains("target 0: is vertex 441"));
}

#[test]
fn a_radius_leaves_out_what_is_farther() {
    let desk = Desk::with_grid();
    let all = desk.distances("distance grid.obj --source 0 --method exact");
    let near = desk.distances("distance grid.obj --source 0 --method exact --radius 7.5");
    let expected: Vec<f64> = all.iter().map(|&d| if d <= 7.5 { d } else { f64::INFINITY }).collect();
    assert_eq!(near, expected);
    let report = desk.json("distance grid.obj --source 0 --method exact --radius 7.5 --json");
    assert_eq!((&report["final_radius"], &report["unreachable"]), (&7.5.into(), &389.into()));
    let whole = "distance grid.obj --source 0 --method exact --radius 100";
    assert_eq!(desk.distances(whole), all);
    assert!(desk.json(&format!("{whole} --json")).get("final_radius").is_none());
}

#[test]
fn a_limit_fails_or_writes_what_is_final() {
    let desk = Desk::with_grid();
    let exact = "distance grid.obj --source 0 --method exact";
    for (limit, message) in [
        ("--time-limit 0", "the time limit of 0ns is reached, after "),
        ("--memory-limit 0", "the memory limit of 0 bytes is reached: "),
    ] {
        let said = desk.says(1, &format!("{exact} {limit} -o out.txt"));
        assert!(said.starts_with(&format!("taut: error: {message}")) && said.lines().count() == 1, "{said}");
        assert!(!desk.path("out.txt").exists());

        let output = desk.run(&format!("{exact} {limit} --partial"));
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.success() && said.starts_with(&format!("taut: {message}")), "{said}");
        assert!(
            said.ends_with(" are final, what is farther counts as unreachable\n") && said.lines().count() == 1,
            "{said}"
        );
        let part = numbers(&String::from_utf8(output.stdout).unwrap());
        assert!(part.len() == 441 && part.contains(&f64::INFINITY));
    }
    let all = desk.prints(exact);
    assert_eq!(desk.prints(&format!("{exact} --time-limit 600.5 --memory-limit 1000 --partial")), all);
}

#[test]
fn the_output_file_takes_the_place_of_standard_output() {
    let desk = Desk::with_grid();
    let printed = desk.prints("distance grid.obj --source 0 --method exact");
    assert_eq!(desk.prints("distance grid.obj --source 0 --method exact -o out.txt"), "");
    assert_eq!(std::fs::read_to_string(desk.path("out.txt")).unwrap(), printed);
    desk.json("distance grid.obj --source 0 --method exact --json --output json.txt");
    assert_eq!(std::fs::read_to_string(desk.path("json.txt")).unwrap(), printed);
}

#[test]
fn the_json_object_has_these_keys_in_this_order() {
    let desk = Desk::with_grid();
    let text = desk.prints("distance grid.obj --source 0 --json");
    let seconds = |stage: &Value| stage["cpu"].as_f64().unwrap() >= 0.0 && stage["wall"].as_f64().unwrap() >= 0.0;
    let report: Value = serde_json::from_str(&text).unwrap();
    assert_eq!((&report["vertices"], &report["faces"], &report["unreachable"]), (&441.into(), &800.into(), &0.into()));
    assert!(report["time_step"].as_f64().unwrap() > 0.0);
    assert!(["read", "setup", "solve"].iter().all(|stage| seconds(&report["timing"][stage])));
    let keys =
        ["vertices", "faces", "time_step", "largest_distance", "unreachable", "timing", "read", "setup", "solve"];
    let places: Vec<_> = keys.iter().map(|key| text.find(&format!("\"{key}\":")).unwrap()).collect();
    assert!(places.is_sorted());
    assert!(report.get("error").is_none() && report.as_object().unwrap().len() == 7);
    let heat = &report["heat"];
    assert_eq!((&heat["flips"], &heat["stuck_edges"], &heat["restarts"]), (&0.into(), &0.into(), &0.into()));
    assert!(heat["seconds"]["poisson"].as_f64().unwrap() > 0.0 && heat["nonpositive_heat"] == 0);

    let exact = desk.json("distance grid.obj --source 0 --method exact --json");
    assert!(exact["time_step"].is_null() && exact.get("heat").is_none());
    assert!((exact["largest_distance"].as_f64().unwrap() - 800_f64.sqrt()).abs() < 1e-12);
}

#[test]
fn a_reference_gives_the_error_in_percent() {
    let desk = Desk::with_grid();
    let lines = |factor: f64| euclidean(0).iter().map(|d| format!("{}\n", factor * d)).collect::<String>();
    desk.write("reference.txt", &format!("# 25 % more\n{}", lines(1.25)));
    let line = "distance grid.obj --source 0 --method exact --reference reference.txt";
    let error = &desk.json(&format!("{line} --json"))["error"];
    let percent = |key: &str| error[key].as_f64().unwrap();
    assert!((percent("mean_percent") - 20.0 * 440.0 / 441.0).abs() < 1e-9);
    assert!((percent("median_percent") - 20.0).abs() < 1e-9);
    assert!((percent("max_percent") - 20.0).abs() < 1e-9);
    assert_eq!(error.as_object().unwrap().len(), 6);

    let output = desk.run(line);
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(said, "mean error 19.95465 %, median error 20.00000 %, maximum error 20.00000 %\n");
    assert_eq!(numbers(&String::from_utf8(output.stdout).unwrap()).len(), 441);
}

#[test]
fn a_reference_that_does_not_fit_is_refused() {
    let desk = Desk::with_grid();
    desk.write("short.txt", "0\n1\n");
    let said = desk.says(1, "distance grid.obj --source 0 --reference short.txt");
    assert_eq!(said, "taut: error: short.txt: has 2 numbers, but the mesh has 441 vertices\n");
    for bad in ["nan", "1 2", "one"] {
        desk.write("bad.txt", &format!("0\n# comment\n{bad}\n"));
        let said = desk.says(1, "distance grid.obj --source 0 --reference bad.txt");
        assert!(said.starts_with("taut: error: bad.txt: line 3: expected a distance"), "{said}");
    }
}

#[test]
fn a_failure_names_its_cause_and_writes_nothing() {
    let desk = Desk::with_grid();
    desk.write("bad.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n");
    desk.write("sources.txt", "0\n1 2 3\n");
    desk.write("none.txt", "# nobody\n");
    for (line, part) in [
        ("distance missing.obj --source 0", "taut: error: missing.obj: "),
        ("distance grid.step --source 0", "taut: error: grid.step: the suffix"),
        ("distance bad.off --source 0", "taut: error: bad.off: face 0: names vertex 7"),
        ("distance grid.obj --sources missing.txt", "taut: error: missing.txt: "),
        ("distance grid.obj --sources sources.txt", "taut: error: sources.txt: line 2: expected a vertex"),
        ("distance grid.obj --sources none.txt", "taut: error: "),
        ("distance grid.obj --source 441", "taut: error: source 0: is vertex 441"),
        ("distance grid.obj --source 441 --method exact", "taut: error: source 0: is vertex 441"),
        ("distance grid.obj --source 0 --boundary -0.5", "taut: error: "),
        ("distance grid.obj --source 0 --time-step 0", "taut: error: "),
        ("distance grid.obj --source 0 --time-step nan", "taut: error: "),
        ("distance grid.obj --source 0 --time-factor -1", "taut: error: "),
        ("distance grid.obj --source 0 --method exact --radius -1", "taut: error: radius is -1"),
        ("distance grid.obj --source 0 --method exact --radius nan", "taut: error: radius is NaN"),
    ] {
        let said = desk.says(1, &format!("{line} -o out.txt"));
        assert!(said.starts_with(part) && said.lines().count() == 1, "{line}: {said}");
        assert!(!desk.path("out.txt").exists(), "{line}");
    }
    let said = desk.says(1, "distance grid.obj --source 0 --method exact -o nowhere/out.txt");
    assert!(said.starts_with("taut: error: nowhere/out.txt: "), "{said}");
}

#[test]
fn a_command_line_that_makes_no_sense_is_refused_with_code_2() {
    let desk = Desk::with_grid();
    for (line, part) in [
        ("", "Usage"),
        ("distance grid.obj", "--source"),
        ("distance grid.obj --source 0 --sources s.txt", "cannot be used with"),
        ("distance grid.obj --source -1", "-1"),
        ("distance grid.obj --source 0 --method dijkstra", "heat, exact"),
        ("distance grid.obj --source 0 --time-step fast", "mean-edge"),
        ("distance grid.obj --source 0 --time-step 0.5 --time-factor 2", "--time-factor"),
        ("distance grid.obj --source 0 --method exact --boundary 0", "--boundary"),
        ("distance grid.obj --source 0 --method exact --shift min", "--shift"),
        ("distance grid.obj --source 0 --method exact --time-scale raw", "--time-scale"),
        ("distance grid.obj --source 0 --radius 1", "--radius"),
        ("distance grid.obj --source 0 --time-limit 1", "--time-limit"),
        ("distance grid.obj --source 0 --memory-limit 1", "--memory-limit"),
        ("distance grid.obj --source 0 --partial", "--partial"),
        ("distance grid.obj --source 0 --method exact --partial", "--memory-limit"),
        ("distance grid.obj --source 0 --method exact --time-limit -1", "negative"),
        ("distance grid.obj --source 0 --method exact --time-limit soon", "not a number"),
        ("distance grid.obj --source 0 --method exact --memory-limit -1", "-1"),
        ("isolines grid.obj --values v.txt --radius 1 --count 3 -o lines.obj", "--radius"),
        ("walk grid.obj", "walk"),
    ] {
        let said = desk.says(2, line);
        assert!(said.contains(part), "{line}: {said}");
    }
}

#[test]
fn help_names_every_option() {
    let help = Desk::new().prints("distance --help");
    for option in [
        "<MESH>",
        "--source",
        "--sources",
        "--source-curve",
        "--method",
        "--time-step",
        "--time-scale",
        "--time-factor",
        "--laplacian",
        "--solver",
        "--boundary",
        "--shift",
        "--radius",
        "--time-limit",
        "--memory-limit",
        "--partial",
        "--target",
        "--reference",
        "--output",
        "--json",
        "--picture",
        "--view",
        "--size",
        "Examples:",
    ] {
        assert!(help.contains(option), "{option}");
    }
    assert!(help.lines().all(|line| line.chars().count() <= 100), "{help}");
}

#[test]
fn the_shipped_mesh_is_served() {
    let mesh = concat!(env!("CARGO_MANIFEST_DIR"), "/../data/knot.obj");
    let distances = Desk::new().distances(&format!("distance {mesh} --source 0"));
    assert_eq!(distances.len(), 7680);
    assert!(distances.iter().all(|&d| (0.0..30.0).contains(&d)));
}
