//! THIRD-PARTY.txt holds the notices of all packages that are linked into libtaut, for the licences ask that they go with
//! a library in binary form. `TAUT_BLESS=1 cargo test --test licences` rewrites it.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// The licences a package may have, the preferred one first. Another one, or a combination of several, wants to be read
/// by a person before it is added.
const ALLOWED: [&str; 2] = ["MIT", "Apache-2.0"];

/// Of what faer ported from Eigen there is nothing in the library, which cpp_tests/licences.cmake keeps true.
const NOT_LINKED: &str = "COPYING.EIGEN.MPL2";

const PREFACE: &str = "\
libtaut contains the packages below, under the licences that follow their names. It also contains parts of the Rust
standard library, (c) The Rust Project contributors, MIT or Apache-2.0, whose own notices come with each Rust toolchain
as share/doc/rust/COPYRIGHT-library.html.
";

fn cargo(arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO"))
        .args(arguments)
        .arg("--locked")
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// What `cargo metadata` knows of each package that the library is linked from, on any machine.
fn linked_packages(features: &str) -> Vec<Value> {
    let tree = "tree --package taut --edges normal,no-proc-macro --target all --prefix none --no-dedupe --format {p}";
    let tree = cargo(&[&tree.split(' ').collect::<Vec<_>>()[..], &["--features", features]].concat());
    let linked: BTreeSet<&str> = tree.lines().collect();
    let mut metadata: Value = serde_json::from_str(&cargo(&["metadata", "--format-version", "1"])).unwrap();
    let mut packages: Vec<Value> = metadata["packages"].as_array_mut().unwrap().drain(..).collect();
    packages
        .retain(|package| linked.contains(format!("{} v{}", text(package, "name"), text(package, "version")).as_str()));
    assert_eq!(packages.len() + 1, linked.len(), "all of them but taut, which has its path beside its name");
    packages
}

fn text<'a>(package: &'a Value, key: &str) -> &'a str {
    package[key].as_str().unwrap_or_default()
}

fn allowed_licence(package: &Value) -> Option<&'static str> {
    let offered: Vec<&str> = text(package, "license").split(" OR ").flat_map(|part| part.split('/')).collect();
    ALLOWED.into_iter().find(|allowed| offered.contains(allowed))
}

/// The licence as the package words it, then the notices of code that it ported from elsewhere.
fn notices(package: &Value, licence: &str) -> Vec<String> {
    let folder = Path::new(text(package, "manifest_path")).parent().unwrap();
    let mut files: Vec<String> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    files.sort();
    let word = licence.split('-').next().unwrap().to_uppercase();
    let own = files.iter().find(|file| file.starts_with("LICENSE") && file.to_uppercase().contains(&word));
    let own = own.or_else(|| files.iter().find(|file| file.split('.').next() == Some("LICENSE")));
    let ported = files.iter().filter(|file| file.starts_with("COPYING.") && *file != NOT_LINKED);
    let read = |file: &String| fs::read_to_string(folder.join(file)).unwrap();
    let own = own.map_or_else(|| licence_without_a_file(package, licence), read);
    std::iter::once(own).chain(ported.map(read)).map(|notice| tidy(&notice)).collect()
}

fn licence_without_a_file(package: &Value, licence: &str) -> String {
    assert_eq!(licence, "MIT", "{} has no file LICENSE", package["name"]);
    let authors: Vec<&str> = package["authors"].as_array().unwrap().iter().filter_map(Value::as_str).collect();
    let ours = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/LICENSE-MIT")).unwrap();
    let permission = &ours[ours.find("Permission").unwrap()..];
    format!("Copyright (c) the authors of {}: {}\n\n{permission}", text(package, "repository"), authors.join(", "))
}

fn tidy(notice: &str) -> String {
    let lines: Vec<&str> = notice.lines().map(str::trim_end).collect();
    lines.join("\n").trim_matches('\n').to_owned()
}

#[test]
fn third_party_notices_are_up_to_date() {
    let mut packages_of: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for package in linked_packages("default") {
        let name = format!("{} {}", text(&package, "name"), text(&package, "version"));
        let licence = allowed_licence(&package).unwrap_or_else(|| panic!("{name}: {}", package["license"]));
        for notice in notices(&package, licence) {
            packages_of.entry(notice).or_default().push(name.clone());
        }
    }
    let mut sections: Vec<String> =
        packages_of.into_iter().map(|(notice, packages)| format!("== {}\n\n{notice}\n", packages.join(", "))).collect();
    sections.sort();
    let expected = format!("{PREFACE}\n{}", sections.join("\n"));

    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("THIRD-PARTY.txt");
    if std::env::var_os("TAUT_BLESS").is_some() {
        fs::write(&path, &expected).unwrap();
    }
    assert!(
        fs::read_to_string(&path).unwrap_or_default() == expected,
        "THIRD-PARTY.txt is out of date: TAUT_BLESS=1 cargo test --test licences"
    );
}

#[test]
fn only_the_feature_ldl_brings_a_licence_that_is_not_allowed() {
    let refused = |features| {
        let packages = linked_packages(features).into_iter().filter(|package| allowed_licence(package).is_none());
        packages.map(|package| text(&package, "name").to_owned()).collect::<Vec<_>>()
    };
    assert_eq!(refused("default"), [""; 0]);
    assert_eq!(refused("ldl"), ["sprs-ldl"]);
}
