//! Numbers as people write them: three with commas on the command line, and files with one entry a line, sources or
//! distances, where `#` begins a comment and blank lines mean nothing.

use crate::Result;
use std::path::Path;
use std::str::FromStr;
use taut::{Source, SurfacePoint};

/// The sources of a file: `vertex [offset]` or `triangle weight weight weight [offset]` a line.
pub(crate) fn sources(path: &Path) -> Result<Vec<Source>> {
    entries(path, "a vertex, or a triangle and three weights, and, if wanted, a start distance", |words| {
        let (source, offset) = match words {
            [vertex, offset @ ..] if words.len() <= 2 => (Source::vertex(number(vertex)?), offset),
            [face, a, b, c, offset @ ..] if words.len() <= 5 => {
                let barycentric = [number(a)?, number(b)?, number(c)?];
                (Source::point(SurfacePoint { face: number(face)?, barycentric }), offset)
            }
            _ => return None,
        };
        Some(match offset {
            [offset] => source.with_offset(number(offset)?),
            _ => source,
        })
    })
}

/// The numbers of "x,y,z".
pub(crate) fn triple(text: &str) -> Option<[f64; 3]> {
    let numbers: Option<Vec<f64>> = text.split(',').map(|word| number(word.trim())).collect();
    numbers?.try_into().ok()
}

/// What the numbers are that this command writes.
pub(crate) const DISTANCE: &str = "a distance";

/// The numbers of a file, one a line; `what` each is called in messages.
pub(crate) fn numbers(path: &Path, what: &str) -> Result<Vec<f64>> {
    entries(path, what, |words| match words {
        [word] => number(word).filter(|number: &f64| !number.is_nan()),
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

pub(crate) fn number<T: FromStr>(word: &str) -> Option<T> {
    word.parse().ok()
}
