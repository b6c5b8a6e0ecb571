//! `taut evaluate` as a person and as a program sees it.

mod common;

use common::{Desk, corpus, obj};
use serde_json::Value;
use std::io::{BufRead, BufReader, Read};
use std::process::{Command, Stdio};
use taut::Mesh;
use taut::shapes;

/// The bounding-box diagonal that the paper gives all its meshes.
const DIAGONAL: f64 = 24.976;

/// With `rough.obj`, a torus whose edges and angles vary.
fn desk() -> Desk {
    let desk = Desk::new();
    desk.write("rough.obj", &obj(&shapes::torus(30, 14, 2.0, 0.8)));
    desk
}

/// Rows of comma-separated values without quotes, as pairs of column and value.
fn rows(csv: &str) -> Vec<Vec<(String, String)>> {
    let mut lines = csv.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
    let head = lines.next().unwrap();
    let row = |cells: Vec<String>| {
        assert_eq!(cells.len(), head.len(), "{cells:?}");
        head.iter().cloned().zip(cells).collect()
    };
    lines.map(row).collect()
}

fn cell<'a>(row: &'a [(String, String)], column: &str) -> &'a str {
    &row.iter().find(|(name, _)| name == column).unwrap_or_else(|| panic!("no {column} in {row:?}")).1
}

fn number(row: &[(String, String)], column: &str) -> f64 {
    cell(row, column).parse().unwrap_or_else(|_| panic!("{column} in {row:?}"))
}

#[track_caller]
fn assert_close(ours: f64, expected: f64) {
    assert!((ours - expected).abs() <= 1e-9 * expected.abs(), "{ours} for {expected}");
}

/// The factor from a file's units to the paper's size.
fn scale(desk: &Desk, name: &str) -> f64 {
    let mesh = Mesh::read(desk.path(name)).unwrap();
    let side = |k: usize| {
        let of = || mesh.positions().iter().map(|p| p[k]);
        of().fold(f64::NEG_INFINITY, f64::max) - of().fold(f64::INFINITY, f64::min)
    };
    DIAGONAL / [0, 1, 2].map(side).iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The mean and the median error of `taut distance` from vertex 0 at t in mesh units squared.
fn errors(desk: &Desk, laplacian: &str, t: f64) -> [f64; 2] {
    desk.prints("distance rough.obj --source 0 --method exact -o exact.txt");
    let error = &desk.json(&format!(
        "distance rough.obj --source 0 --laplacian {laplacian} --shift min --time-step {t} --reference exact.txt --json"
    ))["error"];
    ["mean_percent", "median_percent"].map(|key| error[key].as_f64().unwrap())
}

#[test]
fn properties_of_a_grid_are_what_geometry_says() {
    let desk = Desk::with_grid();
    let s = DIAGONAL / (20.0 * 2f64.sqrt());
    let mean = (840.0 + 400.0 * 2f64.sqrt()) / 1240.0;
    let variance = (840.0 * (1.0 - mean).powi(2) + 400.0 * (2f64.sqrt() - mean).powi(2)) / 1240.0;
    let anisotropy = (1.0 + 2f64.sqrt() / 2.0) * 2f64.sqrt() / (2.0 * 3f64.sqrt() * 0.5);

    let csv = rows(&desk.prints("evaluate properties grid.obj --format csv"));
    let [row] = &csv[..] else { panic!("{csv:?}") };
    assert_eq!(cell(row, "model"), "grid");
    for (column, count) in [("vertices", "441"), ("edges", "1240"), ("faces", "800"), ("source", "0")] {
        assert_eq!(cell(row, column), count);
    }
    let expected = [
        ("scale", s),
        ("anisotropy", anisotropy),
        ("mean_edge", s * mean),
        ("variance", s * s * variance),
        ("sigma", s * variance.sqrt()),
        ("min_edge", s),
        ("max_edge", s * 2f64.sqrt()),
        ("edge_ratio", 0.5f64.sqrt()),
        ("min_angle", 45.0),
        ("max_angle", 90.0),
        ("q2", s),
    ];
    let json = &desk.json("evaluate properties grid.obj --format json")[0];
    assert_eq!(json["model"], "grid");
    for (key, value) in expected {
        assert_close(number(row, key), value);
        assert_close(json[key].as_f64().unwrap(), value);
    }

    let text = desk.prints("evaluate properties grid.obj grid.obj");
    let line = |head: &str| -> Vec<String> {
        let line = text.lines().find(|line| line.starts_with(head)).unwrap();
        line.split_whitespace().map(str::to_owned).collect()
    };
    assert_eq!(line("vertices")[1..], ["N_v", "441", "441"]);
    assert_eq!(line("mean edge")[2..], ["ē".to_owned(), format!("{:.5}", s * mean), format!("{mean:.5}")]);
    assert_eq!(line("largest angle")[2..], ["max_α", "90.0000", "90.0000"]);
    assert_eq!(text.matches("N_v").count(), 2);
}

#[test]
fn the_best_t_is_where_distances_say() {
    let desk = desk();
    let csv = rows(&desk.prints("evaluate best-t rough.obj --format csv"));
    assert_eq!(csv.len(), 8);
    let area_scale = scale(&desk, "rough.obj").powi(2);
    for of in csv.chunks(2) {
        let [sweep, search] = of else { unreachable!() };
        assert_eq!([sweep, search].map(|row| cell(row, "method")), ["sweep", "search"]);
        assert_eq!(cell(sweep, "t"), cell(search, "t"));
        assert_eq!(cell(sweep, "at_end"), "false");
        let at = |t: f64| {
            errors(&desk, cell(sweep, "laplacian"), t / area_scale)[usize::from(cell(sweep, "measure") == "median")]
        };
        let (t, error) = (number(sweep, "t"), number(sweep, "error_percent"));
        assert_close(at(t), error);
        assert!([0.5, 0.97, 1.03, 2.0].iter().all(|factor| at(factor * t) > error), "{sweep:?}");
    }

    let studies = desk.json("evaluate best-t rough.obj --laplacian intrinsic --format json");
    let points = studies[0]["laplacians"][0]["sweep"]["points"].as_array().unwrap();
    let least = |key: &str| points.iter().map(|p| p[key].as_f64().unwrap()).fold(f64::INFINITY, f64::min);
    assert_eq!(least("mean").to_string(), cell(&csv[4], "error_percent"));
    assert_eq!(least("median").to_string(), cell(&csv[6], "error_percent"));

    let text = desk.prints("evaluate best-t rough.obj --search --laplacian plain");
    assert!(text.starts_with("Best t by the search that stops at the maximum t\n"), "{text}");
    let row: Vec<&str> = text.lines().nth(3).unwrap().split_whitespace().collect();
    assert_eq!(row[..3], ["rough", "plain", "mean"]);
    assert_eq!(row[3], format!("{:.5}", number(&csv[1], "error_percent")));
    assert_eq!(row[4].parse(), Ok(number(&csv[1], "t")));
    assert_eq!(row.last(), Some(&cell(&csv[1], "probes")));
}

#[test]
fn a_curve_is_a_drawing_of_one_laplacian() {
    let desk = desk();
    desk.prints("evaluate best-t rough.obj --laplacian plain --curve curve.svg");
    let drawing = desk.read("curve.svg");
    assert!(drawing.starts_with("<svg") && drawing.trim_end().ends_with("</svg>"), "{drawing}");
    assert!(desk.says(2, "evaluate best-t rough.obj --curve other.svg").contains("--laplacian plain or intrinsic"));
    assert!(!desk.path("other.svg").exists());
}

#[test]
fn a_gain_is_a_ratio_of_errors() {
    let desk = desk();
    let line = "evaluate verify rough.obj --laplacian plain --resamples 200 --bootstrap-sources 3";
    let csv = rows(&desk.prints(&format!("{line} --format csv")));
    assert_eq!(csv.len(), 9);
    let area_scale = scale(&desk, "rough.obj").powi(2);
    let of_row = |row| errors(&desk, "plain", number(row, "t") / area_scale);
    let original = of_row(&csv[0]);
    assert_eq!(cell(&csv[0], "formula"), "mean-edge");
    for row in &csv {
        for ((measure, error), original) in ["mean", "median"].into_iter().zip(of_row(row)).zip(original) {
            assert_close(number(row, &format!("{measure}_error_percent")), error);
            let of = |what: &str| format!("{measure}_{what}_over_vertices");
            let [ratio, low, high] = ["ratio", "low", "high"].map(|what| number(row, &of(what)));
            assert_close(ratio, error / original);
            let verdict = if high < 1.0 {
                "better"
            } else if low > 1.0 {
                "worse"
            } else {
                "unsure"
            };
            assert!(low <= high && cell(row, &of("verdict")) == verdict, "{row:?}");
        }
    }
    let formula = desk.json("distance rough.obj --source 0 --time-step mean-sigma --json")["time_step"].as_f64();
    assert_close(number(&csv[2], "t") / area_scale, formula.unwrap());

    let text = desk.prints(line);
    assert!(text.lines().all(|line| line.chars().count() <= 100), "{text}");
    assert_eq!(text.lines().filter(|line| line.contains("Eq. 3  paper")).count(), 2);
    assert!(!text.contains("Better / worse"));
    let two = desk.prints(&format!("{line} rough.obj"));
    let counts = two.lines().find(|line| line.starts_with("plain        Eq. 2    mean")).unwrap();
    // Better, worse and unsure over vertices come first.
    let numbers = counts.split_whitespace().skip(4).filter_map(|word| word.parse::<u32>().ok());
    assert_eq!(numbers.take(3).sum::<u32>(), 2, "{counts}");
    let json = desk.json(&format!("{line} --format json"));
    assert_eq!(json[0]["laplacians"][0]["formulas"].as_array().map(Vec::len), Some(9));
}

#[test]
fn made_meshes_know_their_source() {
    let desk = desk();
    let text = desk.prints("evaluate basic-set rough.obj --source 200 --seed 3 -o made");
    assert!(text.starts_with("Table 1\n       1.obj"), "{text}");
    assert!(!text.contains("paper"), "{text}");
    let files: Vec<String> = (1..=5).map(|i| format!("made/{i}.obj")).collect();
    let first = Mesh::read(desk.path("rough.obj")).unwrap();
    let mut sources = String::new();
    let mut counts = Vec::new();
    for file in &files {
        let mesh = Mesh::read(desk.path(file)).unwrap();
        let source = mesh.positions().iter().position(|p| *p == first.positions()[200]).unwrap();
        sources += &format!(" --source {source}");
        counts.push(mesh.vertex_count());
        let csv = rows(&desk.prints(&format!("evaluate properties {file} --format csv")));
        assert_eq!(cell(&csv[0], "source"), source.to_string());
    }
    assert!(counts.is_sorted_by(|a, b| a > b), "{counts:?}");
    let again = desk.prints("evaluate basic-set made/1.obj --seed 3 -o again");
    assert_eq!(again, text);
    assert!((1..=5).all(|i| desk.read(&format!("made/{i}.obj")) == desk.read(&format!("again/{i}.obj"))));

    for word in ["correlate", "fit"] {
        let csv = desk.prints(&format!("evaluate {word} made --format csv"));
        assert_eq!(csv, desk.prints(&format!("evaluate {word} {} --format csv{sources}", files.join(" "))));
        assert_ne!(csv, desk.prints(&format!("evaluate {word} made --source 0 --format csv")));
    }
}

#[test]
fn correlations_and_lines_are_those_of_the_best_t() {
    let desk = desk();
    desk.prints("evaluate basic-set rough.obj -o made");
    let points = |column: &str| -> Vec<f64> {
        rows(&desk.prints("evaluate properties made --format csv")).iter().map(|row| number(row, column)).collect()
    };
    let best = rows(&desk.prints("evaluate best-t made --laplacian plain --format csv"));
    let t: Vec<f64> = best.iter().skip(2).step_by(4).map(|row| number(row, "t")).collect();
    let sum = |x: &[f64], y: &[f64]| -> f64 {
        let mean = |of: &[f64]| of.iter().sum::<f64>() / of.len() as f64;
        x.iter().zip(y).map(|(a, b)| (a - mean(x)) * (b - mean(y))).sum()
    };
    let sigma = points("sigma");

    let correlations = rows(&desk.prints("evaluate correlate made --laplacian plain --format csv"));
    assert_eq!(correlations.len(), 2 * 18);
    let of = |measure: &str, property: &str| {
        let found =
            correlations.iter().find(|row| cell(row, "measure") == measure && cell(row, "property") == property);
        found.unwrap()
    };
    let r = sum(&sigma, &t) / (sum(&sigma, &sigma) * sum(&t, &t)).sqrt();
    assert_close(number(of("median", "sigma"), "r"), r);
    assert_eq!(cell(of("median", "source"), "undefined"), "does not vary");
    let text = desk.prints("evaluate correlate made --laplacian plain");
    assert!(
        text.lines().any(|line| line.starts_with("source vertex") && line.ends_with("v_s  does not vary")),
        "{text}"
    );

    let lines = rows(&desk.prints("evaluate fit made --laplacian plain --format csv"));
    assert_eq!(lines.len(), 4);
    assert_eq!([cell(&lines[2], "measure"), cell(&lines[2], "line")], ["median", "t over sigma"]);
    assert_close(number(&lines[2], "slope"), sum(&sigma, &t) / sum(&sigma, &sigma));
    assert_close(number(&lines[2], "r_squared"), r * r);
    let json = desk.json("evaluate fit made --laplacian plain --format json");
    let slope = json[1]["over_sigma"]["Ok"]["slope"]["value"].as_f64().unwrap();
    assert_eq!(slope.to_string(), cell(&lines[2], "slope"));
    assert!(desk.prints("evaluate fit made").contains("the paper's Eq. 4"));
}

#[test]
fn a_report_has_what_the_words_tell() {
    let desk = desk();
    std::fs::create_dir(desk.path("meshes")).unwrap();
    desk.write("meshes/rough.obj", &desk.read("rough.obj"));
    desk.write("meshes/broken.ply", "ply, or not");
    let options = "--resamples 100 --bootstrap-sources 2";
    let output = desk.run(&format!("evaluate reproduce meshes -o out {options}"));
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success() && said.starts_with("1 model\n") && said.contains("broken"), "{said}");
    assert_eq!(String::from_utf8(output.stdout).unwrap(), "out/report.html: 1 model\n");
    assert!(desk.read("out/report.html").starts_with("<!DOCTYPE html>"));
    let data: Value = serde_json::from_str(&desk.read("out/data.json")).unwrap();
    assert_eq!(data["models"][0]["model"], "rough");
    assert_eq!(data["failed"][0][0], "broken");
    for (file, line) in [
        ("properties.csv", "evaluate properties rough.obj --format csv".to_owned()),
        ("best.csv", "evaluate best-t rough.obj --format csv".to_owned()),
        ("gains.csv", format!("evaluate verify rough.obj {options} --format csv")),
    ] {
        assert_eq!(desk.read(&format!("out/{file}")), desk.prints(&line), "{file}");
    }
}

#[cfg(unix)]
#[test]
fn ctrl_c_stops_between_whole_files() {
    let desk = Desk::new();
    std::fs::create_dir(desk.path("meshes")).unwrap();
    desk.write("meshes/sphere.obj", &obj(&shapes::icosphere(6)));
    let mut command = Command::new(env!("CARGO_BIN_EXE_taut"));
    command.args(["evaluate", "reproduce", "meshes", "-o", "out"]).current_dir(desk.path(""));
    let mut taut = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let mut errors = BufReader::new(taut.stderr.take().unwrap());
    let mut said = String::new();
    errors.read_line(&mut said).unwrap(); // how many models there are: work begins
    let interrupt = Command::new("sh").args(["-c", &format!("kill -INT {}", taut.id())]).status().unwrap();
    assert!(interrupt.success());
    errors.read_to_string(&mut said).unwrap();
    assert_eq!(taut.wait().unwrap().code(), Some(1), "{said}");
    assert!(said.contains("taut: stopping") && said.contains("the same command goes on"), "{said}");
    assert!(!said.contains("panic"), "{said}");
    let left: Vec<_> = std::fs::read_dir(desk.path("out/work")).unwrap().collect();
    assert!(left.is_empty(), "{left:?}");
    assert!(!desk.path("out/report.html").exists());
}

#[test]
fn what_is_wrong_is_named() {
    let desk = desk();
    std::fs::create_dir(desk.path("empty")).unwrap();
    std::fs::create_dir(desk.path("mixed")).unwrap();
    desk.write("mixed/a.obj", &desk.read("rough.obj"));
    desk.write("mixed/b.off", "OFF\nthree 1 0\n");
    desk.write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    desk.write("point.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n");
    desk.write("told.obj", &format!("# taut source 4000000\n{}", desk.read("rough.obj")));
    let cases = [
        ("properties no.obj", 1, "no.obj"),
        ("properties mixed", 1, "b.off: line 2"),
        ("properties empty", 1, "empty: has no mesh files"),
        ("properties points.obj", 1, "points: has no triangle"),
        ("properties point.obj", 1, "point: has no size"),
        ("best-t told.obj", 1, "vertex 4000000"),
        ("best-t rough.obj --source 420", 1, "the mesh has 420 vertices"),
        ("best-t rough.obj --source 1 --source 2", 1, "2 sources for 1 mesh:"),
        ("best-t rough.obj --source -1", 2, "-1"),
        ("best-t", 2, "MESH"),
        ("correlate rough.obj", 1, "fewer than three points: rough is the only mesh"),
        ("fit rough.obj rough.obj", 1, "fewer than three points: 2 meshes"),
        ("verify rough.obj --resamples 0", 1, "resamples"),
        ("basic-set no.obj -o out", 1, "no.obj"),
        ("basic-set rough.obj", 2, "--output"),
        ("reproduce empty -o out", 1, "empty"),
        ("reproduce no -o out", 1, "no"),
        ("properties rough.obj --format xml", 2, "xml"),
    ];
    for (words, code, message) in cases {
        let said = desk.says(code, &format!("evaluate {words}"));
        assert!(said.contains(message), "{words}: {said}");
    }
    assert!(!desk.path("out/report.html").exists() && !desk.path("out/1.obj").exists());
}

#[test]
fn the_papers_bunny_has_the_papers_errors() {
    let Some(corpus) = corpus() else { return };
    let desk = Desk::new();
    std::fs::copy(corpus.join("paper_bunny_1.obj"), desk.path("bunny.obj")).unwrap();
    let csv = rows(&desk.prints("evaluate best-t bunny.obj --laplacian plain --format csv"));
    for (row, error, t) in [(&csv[0], "0.53031", "0.0254"), (&csv[2], "0.37351", "0.0246")] {
        assert_eq!([&format!("{:.5}", number(row, "error_percent")), cell(row, "t")], [error, t]);
    }
    let set = desk.prints("evaluate basic-set bunny.obj -o basic");
    let line = |head: &str| set.lines().find(|line| line.starts_with(head)).unwrap().split_whitespace();
    assert!(line("v_s").skip(1).step_by(5).eq(["7649", "7649"]), "{set}");
    assert!(line("max_e").skip(1).step_by(5).eq(["0.3296", "0.3296"]), "{set}");
}
