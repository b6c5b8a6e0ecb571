//! `include/taut.h` is what cbindgen makes of `src/ffi`. `TAUT_BLESS=1 cargo test --test header` rewrites it.

use std::fs;
use std::path::Path;

/// The sections of the manual, in its order, and where their items are.
const SECTIONS: [(&str, &[&str]); 11] = [
    ("Versions", &["src/ffi/version.rs"]),
    ("Errors", &["src/error.rs", "src/ffi/guard.rs"]),
    ("Buffers", &["src/ffi/types.rs"]),
    ("Progress, cancellation and limits", &["src/ffi/control.rs"]),
    ("Meshes", &["src/ffi/mesh.rs"]),
    ("Places on the surface", &["src/ffi/places.rs", "src/ffi/closest.rs"]),
    ("Exact distances", &["src/ffi/exact.rs"]),
    ("Exact distances from many sources at once", &["src/ffi/batch.rs"]),
    ("The heat method", &["src/ffi/heat.rs"]),
    ("Curves", &["src/ffi/lines.rs", "src/ffi/curves.rs"]),
    ("What is unusual about a mesh", &["src/ffi/report.rs"]),
];

/// What cbindgen puts around functions.
const EXTERN_C: [&str; 2] = [
    "#ifdef __cplusplus\nextern \"C\" {\n#endif // __cplusplus\n",
    "#ifdef __cplusplus\n}  // extern \"C\"\n#endif  // __cplusplus\n",
];

fn generate(root: &Path) -> String {
    let config = || cbindgen::Config::from_file(root.join("cbindgen.toml").to_str().unwrap()).unwrap();
    let mut frame = config();
    let versions = [
        ("@MAJOR@", env!("CARGO_PKG_VERSION_MAJOR")),
        ("@MINOR@", env!("CARGO_PKG_VERSION_MINOR")),
        ("@PATCH@", env!("CARGO_PKG_VERSION_PATCH")),
    ];
    for (placeholder, number) in versions {
        frame.after_includes = frame.after_includes.map(|text| text.replace(placeholder, number));
    }
    let frame = written(frame, root, &[]);
    let (head, guard_end) = frame.rsplit_once("#endif").unwrap();

    let mut handles = heading("Handles");
    let mut manual = String::new();
    for (title, files) in SECTIONS {
        let bare = cbindgen::Config {
            header: None,
            include_guard: None,
            sys_includes: Vec::new(),
            after_includes: None,
            ..config()
        };
        let items = tidy(&EXTERN_C.iter().fold(written(bare, root, files), |text, brace| text.replace(brace, "")));
        let items = items.split("\n\n").map(str::trim).filter(|item| !item.is_empty());
        let (opaque, others): (Vec<&str>, Vec<&str>) = items.partition(|item| is_handle(item));
        handles.extend(opaque.into_iter().map(|item| format!("{item}\n\n")));
        manual += &heading(title);
        manual.extend(others.into_iter().map(|item| format!("{item}\n\n")));
    }
    let [open, close] = EXTERN_C;
    format!("{}\n\n{open}\n{handles}{manual}{close}\n#endif{guard_end}", head.trim_end())
}

/// What cbindgen makes of some files. It does not know the types of others, and takes their names as they stand.
fn written(config: cbindgen::Config, root: &Path, files: &[&str]) -> String {
    let builder = cbindgen::Builder::new().with_config(config);
    let builder = files.iter().fold(builder, |builder, file| builder.with_src(root.join(file)));
    let mut text = Vec::new();
    builder.generate().unwrap().write(&mut text);
    String::from_utf8(text).unwrap()
}

/// `/* ---- title ---- */`, as long as a line.
fn heading(title: &str) -> String {
    let dashes = 120 - "/*    */".len() - title.len();
    format!("/* {} {title} {} */\n\n", "-".repeat(dashes / 2), "-".repeat(dashes - dashes / 2))
}

/// Whether a paragraph declares a type without a body. Sections may name those of later ones, so they come first.
fn is_handle(item: &str) -> bool {
    let line = item.lines().last().unwrap_or_default();
    line.starts_with("typedef struct ") && line.ends_with(';')
}

/// Brings the values of an integer type to the type, where cbindgen puts them last; what fits on one line goes there.
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
    one_line_comments(&paragraphs.iter().map(|item| one_line_prototype(item) + "\n\n").collect::<String>())
}

/// Writes a function on one line where it fits, which cbindgen does only sometimes.
fn one_line_prototype(item: &str) -> String {
    let Some(start) = item.find("\ntaut_status taut_").filter(|_| item.ends_with(");")) else { return item.to_owned() };
    let (comment, prototype) = item.split_at(start + 1);
    let line = prototype.split('\n').map(str::trim).collect::<Vec<_>>().join(" ");
    if line.len() <= 120 { format!("{comment}{line}") } else { item.to_owned() }
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
