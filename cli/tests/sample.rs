//! `taut sample` as a person runs it.

mod common;

use common::Desk;

#[test]
fn samples_of_a_square_are_its_corners_and_then_its_middle() {
    let desk = Desk::with_grid();
    let samples = |line: &str| -> Vec<u32> {
        let text = desk.prints(line);
        text.lines().map(|line| line.split(' ').next().unwrap().parse().unwrap()).collect()
    };
    let mut corners = samples("sample grid.obj --count 4");
    assert_eq!(corners[..2], [0, 440], "the first vertex, and the corner across");
    corners.sort_unstable();
    assert_eq!(corners, [0, 20, 420, 440]);
    assert_eq!(samples("sample grid.obj --count 5")[4], 220);
    assert_eq!(samples("sample grid.obj --count 1 --source-at 10,10,0"), [0]);
    assert!(samples("sample grid.obj --count 0").is_empty());
}

#[test]
fn what_it_writes_is_a_file_of_sources_and_json_tells_distances() {
    let desk = Desk::with_grid();
    desk.prints("sample grid.obj --count 9 -o samples.txt --picture samples.png");
    let nearest = desk.prints("voronoi grid.obj --sources samples.txt");
    assert_eq!(nearest.lines().next(), Some("0"));
    let report = desk.json("sample grid.obj --count 3 --json");
    assert!(report["samples"][0]["distance"].is_null());
    let across = report["samples"][1]["distance"].as_f64().unwrap();
    assert!((across - 800f64.sqrt()).abs() < 1e-13);
    assert!(std::fs::metadata(desk.path("samples.png")).unwrap().len() > 1000);
}
