//! What several tests share.

use std::path::Path;
use std::process::Command;

/// Runs the command in a folder: its exit code, what it prints and what it says on standard error.
pub(crate) fn taut(folder: &Path, line: &str) -> (i32, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_taut"));
    let output = command.args(line.split_whitespace()).current_dir(folder).output().unwrap();
    let [printed, said] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    (output.status.code().unwrap(), printed, said)
}
