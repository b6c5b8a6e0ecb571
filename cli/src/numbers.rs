//! Files of numbers, one entry a line: sources and reference distances. `#` begins a comment, blank lines mean nothing.

use crate::Result;
use std::path::Path;
use std::str::FromStr;
use taut::Source;

/// The sources of a file: `vertex [offset]` a line.
pub(crate) fn sources(path: &Path) -> Result<Vec<Source>> {
    entries(path, "a vertex and, if wanted, its start distance", |words| match words {
        [vertex] => Some(Source::vertex(number(vertex)?)),
        [vertex, offset] => Some(Source::vertex(number(vertex)?).with_offset(number(offset)?)),
        _ => None,
    })
}

/// The distances of a file, as this command writes them.
pub(crate) fn distances(path: &Path) -> Result<Vec<f64>> {
    entries(path, "a distance", |words| match words {
        [distance] => number(distance).filter(|distance: &f64| !distance.is_nan()),
        _ => None,
    })
}

fn entries<T>(path: &Path, expected: &str, entry: impl Fn(&[&str]) -> Option<T>) -> Result<Vec<T>> {
    let text = std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
    let mut entries = Vec::new();
    for (line, text) in (1..).zip(text.lines()) {
        let content = text.split('#').next().unwrap_or_default();
        let words: Vec<&str> = content.split_whitespace().collect();
        if !words.is_empty() {
            let message =
                || format!("{}: line {line}: expected {expected}, found {:?}", path.display(), content.trim());
            entries.push(entry(&words).ok_or_else(message)?);
        }
    }
    Ok(entries)
}

fn number<T: FromStr>(word: &str) -> Option<T> {
    word.parse().ok()
}
