//! What several tests of the command share.
#![allow(dead_code, reason = "each test uses a part of it")]

use serde_json::Value;
use std::path::PathBuf;
use std::process::{Command, Output};
use taut::shapes::{self, Shape};
use tempfile::TempDir;

/// A folder of its own for one test, and the command run in it.
pub(crate) struct Desk(TempDir);

impl Desk {
    pub(crate) fn new() -> Desk {
        Desk(tempfile::tempdir().unwrap())
    }

    /// With `grid.obj`, a flat grid of 20 × 20 unit squares.
    pub(crate) fn with_grid() -> Desk {
        let desk = Desk::new();
        desk.write("grid.obj", &obj(&shapes::grid(20, 20)));
        desk
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, content: &str) {
        std::fs::write(self.path(name), content).unwrap();
    }

    pub(crate) fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.path(name)).unwrap()
    }

    pub(crate) fn run(&self, line: &str) -> Output {
        let words = line.split_whitespace();
        Command::new(env!("CARGO_BIN_EXE_taut")).args(words).current_dir(self.0.path()).output().unwrap()
    }

    /// What the command prints when it succeeds.
    pub(crate) fn prints(&self, line: &str) -> String {
        let output = self.run(line);
        assert!(output.status.success(), "{line}: {}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).unwrap()
    }

    pub(crate) fn distances(&self, line: &str) -> Vec<f64> {
        numbers(&self.prints(line))
    }

    pub(crate) fn json(&self, line: &str) -> Value {
        serde_json::from_str(&self.prints(line)).unwrap()
    }

    /// What the command says when it fails with this exit code; it prints nothing on standard output.
    pub(crate) fn says(&self, code: i32, line: &str) -> String {
        let output = self.run(line);
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(code), "{line}: {message}");
        assert!(output.stdout.is_empty(), "{line}");
        message
    }
}

pub(crate) fn obj(shape: &Shape) -> String {
    let vertices = shape.positions.iter().map(|[x, y, z]| format!("v {x} {y} {z}\n"));
    let faces = shape.triangles.iter().map(|[a, b, c]| format!("f {} {} {}\n", a + 1, b + 1, c + 1));
    vertices.chain(faces).collect()
}

pub(crate) fn numbers(text: &str) -> Vec<f64> {
    text.lines().map(|line| line.parse().unwrap()).collect()
}

/// The folder of real meshes, if it is there: beside the project, or where TAUT_CORPUS says.
pub(crate) fn corpus() -> Option<PathBuf> {
    let beside = || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/meshes"));
    let folder = std::env::var_os("TAUT_CORPUS").map_or_else(beside, PathBuf::from);
    if folder.is_dir() {
        return Some(folder);
    }
    eprintln!("skipped: no corpus in {}", folder.display());
    None
}
