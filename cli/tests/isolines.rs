//! `taut isolines` as a person runs it.

mod common;

use common::{Desk, obj};
use taut::shapes;

/// Of an OBJ file of lines: for each its level and its positions, the first again at the end of a closed one.
fn polylines(text: &str) -> Vec<(f64, Vec<[f64; 3]>)> {
    let mut level = f64::NAN;
    let mut vertices: Vec<[f64; 3]> = Vec::new();
    let mut lines = Vec::new();
    for line in text.lines().filter(|line| !line.starts_with('#')) {
        let (kind, rest) = line.split_once(' ').unwrap();
        let numbers = || rest.split(' ').map(|word| word.parse::<f64>().unwrap());
        match kind {
            "o" => level = rest.strip_prefix("level_").unwrap().parse().unwrap(),
            "v" => vertices.push(numbers().collect::<Vec<_>>().try_into().unwrap()),
            "l" => lines.push((level, numbers().map(|index| vertices[index as usize - 1]).collect())),
            _ => panic!("{line}"),
        }
    }
    lines
}

/// The pairs of coordinates of each line of an SVG.
fn drawn(text: &str) -> Vec<Vec<[f64; 2]>> {
    let pair = |word: &str| word.split_once(',').map(|(x, y)| [x, y].map(|x| x.parse().unwrap())).unwrap();
    let points = |rest: &str| rest.split('"').next().unwrap().split(' ').map(pair).collect();
    text.split("points=\"").skip(1).map(points).collect()
}

#[test]
fn lines_of_exact_distance_on_a_flat_grid_are_circles() {
    let desk = Desk::with_grid();
    assert_eq!(desk.prints("isolines grid.obj --source 0 --method exact --spacing 6 -o lines.obj"), "");
    let lines = polylines(&desk.read("lines.obj"));
    // From 24 on, beyond the sides of 20, an arc in the far corner.
    assert_eq!(lines.iter().map(|(level, _)| *level).collect::<Vec<_>>(), [6.0, 12.0, 18.0, 24.0]);
    for (level, points) in lines {
        assert!(points.len() > 5 && points[0] != points[points.len() - 1]);
        for [x, y, z] in points {
            // Distance is convex along an edge, which is √2 long at most: 1/8 · 2 / level above the chord.
            let off = level - x.hypot(y);
            assert!(z == 0.0 && (-1e-12..0.26 / level).contains(&off), "{level}: {x} {y}");
        }
    }
}

#[test]
fn a_count_of_levels_and_closed_lines() {
    let desk = Desk::with_grid();
    let report = desk.json("isolines grid.obj --source 220 --count 3 -o lines.obj --json");
    let lines = polylines(&desk.read("lines.obj"));
    let levels = report["levels"].as_array().unwrap();
    assert_eq!((&report["vertices"], &report["faces"]), (&441.into(), &800.into()));
    assert_eq!((levels.len(), report["lines"].as_u64()), (3, Some(lines.len() as u64)));
    assert!(levels.iter().zip([0.25, 0.5, 0.75]).all(|(level, share)| {
        let farthest = 200f64.sqrt();
        (level.as_f64().unwrap() - share * farthest).abs() < 0.05 * farthest
    }));
    let closed = lines.iter().filter(|(_, points)| points[0] == points[points.len() - 1]).count();
    assert!(closed > 0 && report["closed_lines"] == closed);
    let points: usize = lines.iter().map(|(_, points)| points.len()).sum();
    assert_eq!(report["points"], points - closed);
    assert!(report["timing"]["solve"]["cpu"].is_number() && report["timing"]["lines"]["wall"].is_number());
}

#[test]
fn the_lines_of_a_file_of_values() {
    let desk = Desk::with_grid();
    desk.prints("distance grid.obj --source 0 --method exact -o distances.txt");
    desk.prints("isolines grid.obj --values distances.txt --count 5 -o by-values.obj");
    desk.prints("isolines grid.obj --source 0 --method exact --count 5 -o by-source.obj");
    assert_eq!(desk.read("by-values.obj"), desk.read("by-source.obj"));

    let columns: String = shapes::grid(20, 20).positions.iter().map(|p| format!("{}\n", p[0])).collect();
    desk.write("columns.txt", &columns.replace("20\n", "inf\n"));
    let report = desk.json("isolines grid.obj --values columns.txt --spacing 2.5 -o columns.obj --json");
    assert_eq!(report["levels"], serde_json::json!([2.5, 5.0, 7.5, 10.0, 12.5, 15.0, 17.5]));
    for (level, points) in polylines(&desk.read("columns.obj")) {
        assert!(points.iter().all(|p| (p[0] - level).abs() < 1e-12));
    }
    desk.write("short.txt", "0\n1\n");
    assert!(desk.says(1, "isolines grid.obj --values short.txt --count 1 -o a.obj").contains("2 numbers"));
}

#[test]
fn a_drawing_shows_what_the_surface_does_not_hide() {
    let desk = Desk::new();
    let ball = shapes::icosphere(3);
    desk.write("ball.obj", &obj(&ball));
    let heights: String = ball.positions.iter().map(|p| format!("{}\n", p[1])).collect();
    desk.write("heights.txt", &heights);
    desk.prints("isolines ball.obj --values heights.txt --count 3 -o lines.svg --view front --size 600x600");
    let text = desk.read("lines.svg");
    assert!(text.starts_with("<svg ") && text.ends_with("</svg>\n") && text.contains("viewBox=\"0 0 600 600\""));
    assert_eq!(text.matches("<g ").count(), 3);
    // Of each circle of latitude the near half: over the same width on both sides, the higher one farther up.
    let halves: Vec<[f64; 3]> = drawn(&text)
        .iter()
        .map(|part| {
            let x = |pick: fn(f64, f64) -> f64| part.iter().map(|p| p[0]).reduce(pick).unwrap();
            [x(f64::min), x(f64::max), part.iter().map(|p| p[1]).sum::<f64>() / part.len() as f64]
        })
        .collect();
    assert_eq!(halves.len(), 3, "{halves:?}");
    for [left, right, _] in &halves {
        assert!((left + right - 600.0).abs() < 12.0 && right - left > 400.0, "{halves:?}");
    }
    assert!(halves.is_sorted_by(|a, b| a[2] > b[2] + 100.0), "{halves:?}");
}

#[test]
fn a_drawing_from_above_has_straight_lines_in_the_colours_of_their_levels() {
    let desk = Desk::with_grid();
    let columns: String = shapes::grid(20, 20).positions.iter().map(|p| format!("{}\n", p[0])).collect();
    desk.write("columns.txt", &columns);
    desk.prints("isolines grid.obj --values columns.txt --spacing 5 -o lines.svg --view top");
    let text = desk.read("lines.svg");
    let lines = drawn(&text);
    assert_eq!(lines.len(), 3);
    let mean = |line: &[[f64; 2]], k: usize| line.iter().map(|p| p[k]).sum::<f64>() / line.len() as f64;
    for line in &lines {
        let x = mean(line, 0);
        assert!(line.iter().all(|p| (p[0] - x).abs() < 0.02), "upright: {line:?}");
        let [top, bottom] = [line[0][1], line[line.len() - 1][1]];
        assert!((top - bottom).abs() > 700.0, "from rim to rim");
    }
    let step = [1, 2].map(|i| mean(&lines[i], 0) - mean(&lines[i - 1], 0));
    assert!(step[0].abs() > 150.0 && (step[0] - step[1]).abs() < 0.05, "{step:?}");
    let colours: Vec<&str> = text.split("stroke=\"").skip(1).map(|rest| rest.split('"').next().unwrap()).collect();
    assert_eq!(colours.last(), Some(&"rgb(59,50,128)"), "the last colour of pictures");
    assert!(colours[0] != colours[1] && colours[1] != colours[2]);
}

#[test]
fn a_picture_of_lines() {
    let desk = Desk::with_grid();
    let draw = |options: &str| {
        desk.prints(&format!("isolines grid.obj --source 0 --method exact --picture lines.png --view top {options}"));
        std::fs::read(desk.path("lines.png")).unwrap()
    };
    let [few, many] = ["--count 1", "--count 9 -o lines.obj"].map(draw);
    assert!(few.starts_with(b"\x89PNG") && few != many);
    assert_eq!(polylines(&desk.read("lines.obj")).len(), 9);
}

#[test]
fn no_levels_are_no_lines() {
    let desk = Desk::with_grid();
    let zeros = "0\n".repeat(441);
    desk.write("zeros.txt", &zeros);
    for file in ["none.obj", "none.svg"] {
        let report = desk.json(&format!("isolines grid.obj --values zeros.txt --count 3 -o {file} --json"));
        assert_eq!((&report["lines"], &report["levels"]), (&0.into(), &serde_json::json!([])));
        assert!(!desk.read(file).is_empty());
    }
}

#[test]
fn what_makes_no_sense_is_refused_and_leaves_no_file() {
    let desk = Desk::with_grid();
    desk.write("zeros.txt", &"0\n".repeat(441));
    for (line, expected) in [
        ("--count 3 -o a.obj", "--source"),
        ("--source 0 -o a.obj", "--count"),
        ("--source 0 --count 3", "--output"),
        ("--source 0 --count 3 -o a.obj --size 100x100", "--size"),
        ("--source 0 --count 3 --spacing 1 -o a.obj", "--spacing"),
        ("--source 0 --count -3 -o a.obj", "--count"),
        ("--source 0 --count 3 -o a.txt", ".svg"),
        ("--source 0 --count 3 -o a", ".svg"),
        ("--source 0 --count 3 -o a.obj --view top", "--view"),
        ("--source 0 --count 3 -o a.obj --values zeros.txt", "--values"),
        ("--sources zeros.txt --count 3 -o a.obj --values zeros.txt", "--values"),
        ("--method heat --count 3 -o a.obj --values zeros.txt", "--method"),
        ("--boundary 1 --count 3 -o a.obj --values zeros.txt", "--boundary"),
        ("--source 0 --method exact --boundary 1 --count 3 -o a.obj", "--boundary"),
    ] {
        assert!(desk.says(2, &format!("isolines grid.obj {line}")).contains(expected), "{line}");
    }
    for (line, expected) in [
        ("--source 441 --count 3 -o a.obj", "source 0"),
        ("--source 0 --count 10001 -o a.obj", "10000"),
        ("--source 0 --spacing 1e-9 -o a.obj", "more than 10000 levels"),
        ("--source 0 --spacing -1 -o a.obj", "positive"),
        ("--source 0 --count 3 -o no/such/a.obj", "no/such/a.obj"),
    ] {
        assert!(desk.says(1, &format!("isolines grid.obj {line}")).contains(expected), "{line}");
    }
    assert!(!desk.path("a.obj").exists());
}
