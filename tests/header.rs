//! `include/taut.h` is what cbindgen makes of `src/ffi`. `TAUT_BLESS=1 cargo test --test header` rewrites it.

use std::fs;
use std::path::Path;

/// In the order of the manual.
const SOURCES: [&str; 12] = [
    "src/ffi/version.rs",
    "src/error.rs",
    "src/ffi/guard.rs",
    "src/ffi/types.rs",
    "src/ffi/control.rs",
    "src/ffi/mesh.rs",
    "src/ffi/report.rs",
    "src/ffi/heat.rs",
    "src/ffi/exact.rs",
    "src/ffi/batch.rs",
    "src/ffi/surface.rs",
    "src/ffi/closest.rs",
];

fn generate(root: &Path) -> String {
    let mut config = cbindgen::Config::from_file(root.join("cbindgen.toml").to_str().unwrap()).unwrap();
    let versions = [
        ("@MAJOR@", env!("CARGO_PKG_VERSION_MAJOR")),
        ("@MINOR@", env!("CARGO_PKG_VERSION_MINOR")),
        ("@PATCH@", env!("CARGO_PKG_VERSION_PATCH")),
    ];
    for (placeholder, number) in versions {
        config.after_includes = config.after_includes.map(|text| text.replace(placeholder, number));
    }
    let builder = cbindgen::Builder::new().with_config(config);
    let builder = SOURCES.iter().fold(builder, |builder, source| builder.with_src(root.join(source)));
    let mut header = Vec::new();
    builder.generate().unwrap().write(&mut header);
    tidy(&String::from_utf8(header).unwrap())
}

/// Brings the values of an integer type to the type, where cbindgen puts them last, and short comments on one line.
fn tidy(header: &str) -> String {
    let mut paragraphs: Vec<String> =
        header.split("\n\n").map(|paragraph| paragraph.trim_matches('\n').into()).collect();
    let mut i = 0;
    while let Some(paragraph) = paragraphs.get(i) {
        if let Some((_, name)) = paragraph.rsplit_once("\ntypedef uint32_t ") {
            let define = format!("\n#define {}_", name.trim_end_matches(';').to_uppercase());
            let (values, others) = paragraphs.into_iter().partition::<Vec<_>, _>(|other| other.contains(&define));
            paragraphs = others;
            paragraphs[i] = [std::slice::from_ref(&paragraphs[i]), &values].concat().join("\n");
        }
        i += 1;
    }
    one_line_comments(&(paragraphs.join("\n\n") + "\n"))
}

/// Writes `/** x */` for a comment of one line.
fn one_line_comments(header: &str) -> String {
    let mut lines: Vec<String> = Vec::new();
    for line in header.lines() {
        match lines.as_slice() {
            [.., open, text] if line.trim() == "*/" && open.trim() == "/**" => {
                let short = format!("{}/**{} */", &open[..open.len() - 3], &text.trim_start()[1..]);
                lines.truncate(lines.len() - 2);
                lines.push(short);
            }
            _ => lines.push(line.to_owned()),
        }
    }
    lines.join("\n") + "\n"
}

#[test]
fn the_header_is_up_to_date() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let path = root.join("include/taut.h");
    let header = generate(root);
    if std::env::var_os("TAUT_BLESS").is_some() {
        fs::write(&path, &header).unwrap();
    }
    let checked_in = fs::read_to_string(&path).unwrap_or_default();
    assert!(checked_in == header, "include/taut.h is stale; run: TAUT_BLESS=1 cargo test --test header");
}
