//! What the command writes.

use crate::Result;
use crate::field::HeatFacts;
use crate::measured::Seconds;
use serde::Serialize;
use std::fmt::Write as _;
use std::fs::File;
use std::io::{ErrorKind, Write as _};
use std::path::Path;
use taut_eval::Errors;

/// The object of `--json`, key by key; a number that is not finite is written as null.
#[derive(Debug, Serialize)]
pub(crate) struct Report {
    pub(crate) vertices: usize,
    pub(crate) faces: usize,
    /// t in mesh units squared; null for the exact method.
    pub(crate) time_step: Option<f64>,
    pub(crate) largest_distance: Option<f64>,
    pub(crate) unreachable: usize,
    /// Up to which distance the distances are there, if the work stopped before it had all.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) final_radius: Option<f64>,
    pub(crate) timing: Timing,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) heat: Option<HeatFacts>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) error: Option<Errors>,
}

/// Where the time went.
#[derive(Debug, Clone, Copy, Serialize)]
pub(crate) struct Timing {
    pub(crate) read: Seconds,
    pub(crate) setup: Seconds,
    pub(crate) solve: Seconds,
}

/// Prints an object on standard output as JSON, on one line.
pub(crate) fn json(object: &impl Serialize) -> Result<()> {
    let json = serde_json::to_string(object).map_err(|error| error.to_string())?;
    print(&(json + "\n"))
}

/// One number a line, each as the shortest decimal that reads back to it.
pub(crate) fn lines(distances: &[f64]) -> String {
    distances.iter().fold(String::with_capacity(20 * distances.len()), |mut text, distance| {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{distance}");
        text
    })
}

/// Writes to standard output; a reader that has seen enough, as `head` has, is no failure.
pub(crate) fn print(text: &str) -> Result<()> {
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(format!("standard output: {error}")),
        _ => Ok(()),
    }
}

/// A file to write.
pub(crate) type Output<'a> = (&'a Path, Vec<u8>);

/// Writes files, all or none: where one cannot be written, those that were begun are removed.
pub(crate) fn write(files: &[Output]) -> Result<()> {
    let mut begun = Vec::new();
    for (path, content) in files {
        let file = File::create(path).inspect(|_| begun.push(path));
        if let Err(error) = file.and_then(|mut file| file.write_all(content)) {
            for path in begun.into_iter().filter(|path| path.is_file()) {
                // What matters is the first failure; it is told.
                let _ = std::fs::remove_file(path);
            }
            return Err(format!("{}: {error}", path.display()));
        }
    }
    Ok(())
}
