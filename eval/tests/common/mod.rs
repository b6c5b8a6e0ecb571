//! What several tests share.

use std::path::PathBuf;

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
