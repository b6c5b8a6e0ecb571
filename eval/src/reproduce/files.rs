//! Files that are there whole or not at all.

use crate::error::{Error, Result};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fs;
use std::path::{Path, PathBuf};
use taut::MeshFormat;

/// Writes a file beside its place, then moves it there: whoever is interrupted leaves the old file or the new one.
pub(crate) fn write(path: &Path, content: &[u8]) -> Result<()> {
    let mut beside = path.as_os_str().to_owned();
    beside.push(".part");
    let beside = PathBuf::from(beside);
    fs::write(&beside, content).map_err(Error::of_file(&beside))?;
    fs::rename(&beside, path).map_err(Error::of_file(path))
}

/// Writes an object as JSON.
pub(crate) fn write_json(path: &Path, object: &impl Serialize) -> Result<()> {
    let json = serde_json::to_vec_pretty(object).map_err(|error| Error::Input(error.to_string()))?;
    write(path, &json)
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

/// A name as a file may have it: letters, digits, `.`, `-` and `_` stay.
pub(crate) fn safe(name: &str) -> String {
    let is_safe = |c: char| c.is_alphanumeric() || "-_.".contains(c);
    name.chars().map(|c| if is_safe(c) { c } else { '_' }).collect()
}
