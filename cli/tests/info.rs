//! `taut info` as a person and as a program sees it.

mod common;

use common::{Desk, obj};
use serde_json::Value;
use taut::shapes;

/// Two triangles that touch in vertex 2, one of them twice; a repeated index; a copy of vertex 0; a loose vertex.
const MESSY: &str = "OFF\n7 4 0\n0 0 0\n1 0 0\n0 1 0\n0 2 0\n1 2 0\n0 0 -0\n5 5 5\n\
                     3 0 1 2\n3 2 3 4\n3 1 0 2\n3 5 5 1\n";

fn line<'a>(text: &'a str, head: &str) -> &'a str {
    let line = text.lines().find(|line| line.trim_start().starts_with(head));
    line.unwrap_or_else(|| panic!("no line {head:?} in {text}")).trim_start()[head.len()..].trim()
}

#[test]
fn a_clean_mesh_in_words() {
    let desk = Desk::with_grid();
    let text = desk.prints("info grid.obj");
    assert_eq!(line(&text, "mesh"), "441 vertices, 1240 edges, 800 triangles");
    assert_eq!(line(&text, "component 0"), "800 triangles from vertex 0, genus 0, 1 boundary loop");
    assert_eq!(line(&text, "boundary loops"), "1; the longest has 80 vertices");
    for kind in ["non-manifold edges", "duplicate faces", "unreferenced vertices", "zero-area faces"] {
        assert_eq!(line(&text, kind), "none");
    }
    assert!(line(&text, "angles").starts_with("45.0000° (face 0, vertex "));
    assert!(line(&text, "median-fit").split_whitespace().all(|t| t.parse::<f64>().unwrap() > 0.0));
    desk.write("torus.obj", &obj(&shapes::torus(12, 8, 1.0, 0.4)));
    let torus = desk.prints("info torus.obj");
    assert_eq!(line(&torus, "component 0"), "192 triangles from vertex 0, genus 1");
    assert_eq!(line(&torus, "boundary loops"), "none: closed");
}

#[test]
fn findings_are_counted_shown_and_explained() {
    let desk = Desk::new();
    desk.write("messy.off", MESSY);
    let text = desk.prints("info messy.off");
    assert_eq!(line(&text, "component 0"), "3 triangles from vertex 0, not manifold, 1 boundary loop");
    assert_eq!(line(&text, "duplicate faces"), "1: 2 as 0; ways lead over one as over the other");
    assert_eq!(line(&text, "duplicate vertices"), "1: 5 as 0; the surface is cut where they lie");
    assert_eq!(line(&text, "repeated-index faces"), "1: 3; ignored");
    assert_eq!(line(&text, "unreferenced vertices"), "2: 5, 6; out of reach");
    assert!(line(&text, "non-manifold vertices").starts_with("1: 2; "));
    // Three quads in a ring, the last joined to the first upside down.
    desk.write(
        "moebius.off",
        "OFF\n6 3 0\n0 0 0\n0 0 1\n1 0 0\n1 0 1\n0 1 0\n0 1 1\n4 0 1 3 2\n4 2 3 5 4\n4 4 5 0 1\n",
    );
    let text = desk.prints("info moebius.off");
    assert_eq!(line(&text, "component 0"), "6 triangles from vertex 0, not orientable, 1 boundary loop");
    assert!(line(&text, "one-sided components").starts_with("1: 0; "));
    // Of many, the first few.
    let loose: String = (0..1000).map(|i| format!("v {i} 0 0\n")).collect();
    desk.write("loose.obj", &format!("{loose}f 1 2 3\n"));
    let text = desk.prints("info loose.obj");
    assert_eq!(line(&text, "unreferenced vertices"), "997: 3, 4, 5, 6, 7, …; out of reach");
}

#[test]
fn a_formula_that_says_nothing_says_so() {
    let desk = Desk::new();
    desk.write("equal.off", "OFF\n4 4 0\n0 0 0\n1 1 0\n1 0 1\n0 1 1\n3 0 1 2\n3 0 2 3\n3 0 3 1\n3 1 3 2\n");
    assert_eq!(line(&desk.prints("info equal.off"), "sigma"), "says nothing here      says nothing here");
    let steps = &desk.json("info equal.off --json")["time_steps"];
    assert!(steps["sigma"]["paper"].is_null());
    assert!((steps["mean-edge"]["raw"].as_f64().unwrap() - 2.0).abs() < 1e-14);
}

#[test]
fn the_json_object_lists_everything() {
    let desk = Desk::new();
    desk.write("messy.off", MESSY);
    let info = desk.json("info messy.off --json");
    let list = |text: &str| serde_json::from_str::<Value>(text).unwrap();
    assert_eq!(info["duplicate_faces"], list("[[2, 0]]"));
    assert_eq!(info["duplicate_vertices"], list("[[5, 0]]"));
    assert_eq!(info["unreferenced_vertices"], list("[5, 6]"));
    assert_eq!(info["repeated_index_faces"], list("[3]"));
    assert_eq!(info["nonmanifold_vertices"], list("[2]"));
    assert_eq!(info["nonmanifold_edges"], list("[]"));
    assert_eq!(info["boundary_loops"], list(r#"[{"closed": true, "vertices": [2, 3, 4]}]"#));
    let part = &info["components"][0];
    assert_eq!(["vertices", "edges", "faces"].map(|key| part[key].as_u64()), [5, 6, 3].map(Some));
    assert_eq!((part["manifold"].as_bool(), &part["genus"]), (Some(false), &Value::Null));
    assert_eq!(["face", "vertex"].map(|key| info["largest_angle"][key].as_u64()), [Some(0); 2]);
    let keys = [
        "vertices",
        "edges",
        "faces",
        "mean_edge",
        "variance_edge",
        "sigma_edge",
        "mean_absolute_deviation",
        "median_absolute_deviation",
        "min_edge",
        "max_edge",
        "edge_ratio",
        "q1",
        "q2",
        "q3",
        "quartile_deviation",
        "min_angle_deg",
        "max_angle_deg",
        "anisotropy",
        "paper_scale",
    ];
    let properties = info["properties"].as_object().unwrap();
    assert!(keys.iter().all(|key| properties[*key].is_number()) && properties.len() == keys.len());
    assert!((info["properties"]["min_angle_deg"].as_f64().unwrap() - 45.0).abs() < 1e-12);
}

#[test]
fn a_mesh_without_faces_has_a_report_too() {
    let desk = Desk::new();
    desk.write("empty.off", "OFF\n0 0 0\n");
    desk.write("point.obj", "v 1 2 3\n");
    assert!(desk.prints("info empty.off").starts_with("mesh                    0 vertices, 0 edges, 0 triangles\n"));
    let info = desk.json("info point.obj --json");
    assert!(info["properties"].is_null() && info["smallest_angle"].is_null());
    assert_eq!(info["unreferenced_vertices"][0], 0);
    assert!(desk.says(1, "info missing.obj").starts_with("taut: error: missing.obj: "));
    assert!(desk.prints("info --help").contains("--json"));
}
