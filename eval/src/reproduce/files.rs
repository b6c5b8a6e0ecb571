//! Files that are there whole or not at all.

use crate::error::{Error, Result};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use taut::MeshFormat;

/// Writes a file beside its place, then moves it there: whoever is interrupted leaves the old file or the new one.
///
/// Two that write the same file at once do so at different places, and the last one's stays.
pub(crate) fn write(path: &Path, content: &[u8]) -> Result<()> {
    static WRITTEN: AtomicUsize = AtomicUsize::new(0);
    let mut beside = path.as_os_str().to_owned();
    beside.push(format!(".{}-{}.part", std::process::id(), WRITTEN.fetch_add(1, Ordering::Relaxed)));
    let done = fs::write(&beside, content).and_then(|()| fs::rename(&beside, path));
    done.map_err(|error| {
        let _ = fs::remove_file(&beside); // it may not even be there; the first error is the one to tell
        Error::of_file(path)(error)
    })
}

/// An object as JSON.
pub(crate) fn to_json(object: &impl Serialize) -> Result<Vec<u8>> {
    serde_json::to_vec_pretty(object).map_err(|error| Error::Input(error.to_string()))
}

/// The object of a JSON file; `None` where there is no such file, or something else in it.
pub(crate) fn read_json<T: DeserializeOwned>(path: &Path) -> Option<T> {
    serde_json::from_slice(&fs::read(path).ok()?).ok()
}

/// Makes a folder, and those above it.
pub(crate) fn folder(path: &Path) -> Result<()> {
    fs::create_dir_all(path).map_err(Error::of_file(path))
}

/// The mesh files of a folder, by name; not those of the folders in it.
///
/// # Errors
/// [`Error::File`] if the folder cannot be read.
pub fn mesh_files(folder: &Path) -> Result<Vec<PathBuf>> {
    let entries = fs::read_dir(folder).map_err(Error::of_file(folder))?;
    let mut files = Vec::new();
    for entry in entries {
        let path = entry.map_err(Error::of_file(folder))?.path();
        if path.is_file() && MeshFormat::of(&path).is_some() {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

/// The begin of a name as a file may have it anywhere: ASCII letters, digits, `.`, `-` and `_` stay. Names that differ may
/// become the same.
pub(crate) fn safe(name: &str) -> String {
    let is_safe = |c: char| c.is_ascii_alphanumeric() || "-_.".contains(c);
    name.chars().take(60).map(|c| if is_safe(c) { c } else { '_' }).collect()
}
