//! `include/taut.h` is what cbindgen makes of `src/ffi`. `TAUT_BLESS=1 cargo test --test header` rewrites it.

use std::fs;
use std::path::Path;

/// In the order of the manual.
const SOURCES: [&str; 8] = [
    "src/ffi/version.rs",
    "src/error.rs",
    "src/ffi/guard.rs",
    "src/ffi/types.rs",
    "src/ffi/control.rs",
    "src/ffi/mesh.rs",
    "src/ffi/heat.rs",
    "src/ffi/exact.rs",
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
    String::from_utf8(header).unwrap()
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
