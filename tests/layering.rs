//! Keeps the import table of ARCHITECTURE.md: a module of src/ uses only what its row allows.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// What a module may use, as paths: "mesh", "surface::point", or "crate root".
type Table = BTreeMap<String, BTreeSet<String>>;

const ROOT: &str = "crate root";

fn project() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The rows of the table below the heading "Who may import whom": | `module`, `module` | `use`, `use` |
fn table() -> Table {
    let text = fs::read_to_string(project().join("ARCHITECTURE.md")).unwrap();
    let section = text.split("## Who may import whom").nth(1).expect("the heading of the import table");
    let mut table = Table::new();
    for line in section.lines().take_while(|line| !line.starts_with("## ")) {
        let cells: Vec<&str> = line.split('|').collect();
        if let [_, modules, uses, _] = cells[..] {
            for module in quoted(modules) {
                table.insert(module, quoted(uses).into_iter().collect());
            }
        }
    }
    table
}

/// The words of a cell that stand in `backquotes`.
fn quoted(cell: &str) -> Vec<String> {
    cell.split('`').skip(1).step_by(2).map(str::to_owned).collect()
}

fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        match path.is_dir() {
            true => files.extend(sources(&path)),
            false if path.extension().is_some_and(|extension| extension == "rs") => files.push(path),
            false => {}
        }
    }
    files
}

/// The top-level module that a file belongs to.
fn module_of(file: &Path) -> String {
    let inside = file.strip_prefix(project().join("src")).unwrap();
    inside.components().next().unwrap().as_os_str().to_str().unwrap().trim_end_matches(".rs").to_owned()
}

/// Code without line comments; documentation examples go with them.
fn code(file: &Path) -> String {
    let text = fs::read_to_string(file).unwrap();
    text.lines().map(|line| line.split("//").next().unwrap()).collect::<Vec<_>>().join("\n")
}

/// Every path that follows `crate::`, two segments deep, braces expanded one level.
fn imports(code: &str) -> Vec<String> {
    let mut found = Vec::new();
    for rest in code.split("crate::").skip(1) {
        match rest.strip_prefix('{') {
            Some(list) => found.extend(split_list(list).into_iter().map(|item| path(&item))),
            None => found.push(path(rest)),
        }
    }
    found
}

/// The items of a brace list whose opening brace is already gone.
fn split_list(list: &str) -> Vec<String> {
    let (mut depth, mut items, mut item) = (0, Vec::new(), String::new());
    for c in list.chars() {
        match c {
            '}' if depth == 0 => break,
            ',' if depth == 0 => items.push(std::mem::take(&mut item)),
            _ => {
                depth += i32::from(c == '{') - i32::from(c == '}');
                item.push(c);
            }
        }
    }
    items.push(item);
    items.into_iter().map(|item| item.trim().to_owned()).filter(|item| !item.is_empty()).collect()
}

fn path(text: &str) -> String {
    let word = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    let full: String = text.chars().take_while(|&c| word(c)).collect();
    full.split("::").filter(|segment| !segment.is_empty()).take(2).collect::<Vec<_>>().join("::")
}

/// A use of `import` needs `module`, `module::child`, or the crate root where it is none of our modules.
fn allowed(import: &str, own: &str, uses: &BTreeSet<String>, modules: &BTreeSet<String>) -> bool {
    let top = import.split("::").next().unwrap();
    if !modules.contains(top) {
        return uses.contains(ROOT);
    }
    top == own || uses.contains(top) || uses.contains(import)
}

#[test]
fn modules_use_only_what_the_table_allows() {
    let table = table();
    let files = sources(&project().join("src"));
    let modules: BTreeSet<String> = files.iter().map(|file| module_of(file)).filter(|m| m != "lib").collect();
    let mut seen = 0;
    for file in files.iter().filter(|file| module_of(file) != "lib") {
        let module = module_of(file);
        let uses = table.get(&module).unwrap_or_else(|| panic!("ARCHITECTURE.md has no row for `{module}`"));
        for import in imports(&code(file)) {
            seen += 1;
            let name = file.display();
            assert!(allowed(&import, &module, uses, &modules), "{name}: `{module}` must not use crate::{import}");
        }
    }
    assert!(seen > 20, "only {seen} imports found: the reader of imports is broken");
}

#[test]
fn the_table_names_no_module_that_is_gone() {
    let modules: BTreeSet<String> = sources(&project().join("src")).iter().map(|file| module_of(file)).collect();
    for module in table().keys() {
        assert!(modules.contains(module), "ARCHITECTURE.md has a row for `{module}`, which does not exist");
    }
}

/// Whether `name` stands in the code as the start of a path or statement, not as the end of a longer one.
fn uses_word(code: &str, name: &str) -> bool {
    let in_word = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    code.match_indices(name).any(|(at, _)| !code[..at].ends_with(in_word))
}

#[test]
fn outside_crates_stay_in_their_modules() {
    let homes = [
        ("faer::", "linear"),
        ("pulp::", "linear"),
        ("sprs::", "linear"),
        ("sprs_ldl::", "linear"),
        ("tobj::", "mesh"),
        ("flate2::", "mesh"),
        ("rstar::", "surface"),
        ("libc::", "ffi"),
        ("unsafe ", "ffi"),
    ];
    for file in sources(&project().join("src")) {
        let (module, code) = (module_of(&file), code(&file));
        for (name, home) in homes {
            let used = uses_word(&code, name);
            assert!(!used || module == home, "{}: `{name}` belongs to `{home}`", file.display());
        }
    }
}

#[test]
fn the_reader_of_imports_understands_braces() {
    let code = "use crate::{Mesh, heat::{A, B}, metric::Scale};\nlet x = crate::exact::charts::f();";
    assert_eq!(imports(code), ["Mesh", "heat", "metric::Scale", "exact::charts"]);
}
