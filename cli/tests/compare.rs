//! `taut compare` as a person runs it.

mod common;

use common::Desk;
use serde_json::{Value, json};

/// A folder with the distances `a.txt` and `b.txt`.
fn files(a: &str, b: &str) -> Desk {
    let desk = Desk::new();
    desk.write("a.txt", &a.replace(' ', "\n"));
    desk.write("b.txt", &b.replace(' ', "\n"));
    desk
}

fn compare(a: &str, b: &str) -> Value {
    files(a, b).json("compare a.txt b.txt --json")
}

#[test]
fn it_tells_the_errors_and_where_they_are() {
    let found = compare("0.5 1.5 2 8 inf", "0 1 2 10 inf");
    assert_eq!(
        found,
        json!({
            "vertices": 5,
            "error": {
                "mean_percent": 17.5,
                "median_percent": 10.0,
                "max_percent": 50.0,
                "max_vertex": 1,
                "largest_difference": 2.0,
                "largest_difference_vertex": 3,
            },
            "unreachable": {
                "both": { "count": 1, "first": 4 },
                "only_a": { "count": 0, "first": null },
                "only_b": { "count": 0, "first": null },
            },
        })
    );
}

#[test]
fn unreachable_in_one_only_is_an_infinite_error_of_its_first_vertex() {
    let found = compare("0 inf inf 3 4", "0 1 2 3 inf");
    let unreachable = &found["unreachable"];
    assert_eq!(unreachable["only_a"], json!({ "count": 2, "first": 1 }));
    assert_eq!(unreachable["only_b"], json!({ "count": 1, "first": 4 }));
    assert_eq!(unreachable["both"], json!({ "count": 0, "first": null }));
    let error = &found["error"];
    assert_eq!((&error["max_percent"], &error["max_vertex"]), (&Value::Null, &json!(1)));
    assert_eq!(error["largest_difference"], 0.0);
}

#[test]
fn in_text_it_says_the_same() {
    let printed = files("0.5 1.5 2 8 inf", "0 1 2 10 5").prints("compare a.txt b.txt");
    let expected = "\
vertices            5
mean error          inf %
median error        20.00000 %
maximum error       inf % at vertex 4
largest difference  2 at vertex 3
unreachable         0 in both, 1 (first: vertex 4) in A only, 0 in B only
";
    assert_eq!(printed, expected);
    let printed = files("", "").prints("compare a.txt b.txt");
    assert!(printed.contains("maximum error       0.00000 %\n"), "{printed}");
}

#[test]
fn files_that_do_not_fit_are_told() {
    let desk = files("0 1 2", "0 1");
    let said = desk.says(1, "compare a.txt b.txt");
    assert_eq!(said, "taut: error: a.txt: has 3 distances, but b.txt has 2\n");
    assert!(desk.says(1, "compare a.txt missing.txt").starts_with("taut: error: missing.txt: "));
    desk.write("nan.txt", "0\nnan\n1\n");
    let said = desk.says(1, "compare a.txt nan.txt");
    assert!(said.starts_with("taut: error: nan.txt: line 2: expected a distance"), "{said}");
    assert!(desk.says(2, "compare a.txt").contains("<B>"));
}
