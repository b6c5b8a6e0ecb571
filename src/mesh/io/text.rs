//! Lines, words and numbers of text files. Bytes, not strings: a name or comment in another encoding than UTF-8 is fine.

use crate::error::{Element, Error, Reason};

/// A line without its end and without white space around it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line<'a> {
    /// From 1.
    pub(super) number: u64,
    pub(super) text: &'a [u8],
    /// Whether a line feed follows; only the last line of a file can lack it.
    pub(super) terminated: bool,
}

impl<'a> Line<'a> {
    /// The line up to its comment, which `#` begins.
    pub(super) fn content(&self) -> &'a [u8] {
        let end = self.text.iter().position(|&byte| byte == b'#').unwrap_or(self.text.len());
        self.text[..end].trim_ascii_end()
    }

    /// An error about this line: [`Reason::Truncated`] where the file ends within it.
    pub(super) fn malformed(&self, message: impl Into<String>) -> Error {
        let reason = if self.terminated { Reason::Malformed } else { Reason::Truncated };
        Error::at(reason, Element::Line(self.number), message)
    }
}

/// The lines of a file, and what is left of it.
#[derive(Debug, Clone)]
pub(super) struct Lines<'a> {
    rest: &'a [u8],
    number: u64,
}

impl<'a> Lines<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Lines<'a> {
        // Some editors put a byte order mark before UTF-8; it would hide the first word.
        Lines { rest: bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes), number: 0 }
    }

    /// How many lines were taken.
    pub(super) fn taken(&self) -> u64 {
        self.number
    }

    /// What follows the lines that were taken.
    pub(super) fn rest(&self) -> &'a [u8] {
        self.rest
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = Line<'a>;

    fn next(&mut self) -> Option<Line<'a>> {
        if self.rest.is_empty() {
            return None;
        }
        let end = self.rest.iter().position(|&byte| byte == b'\n');
        let text = self.rest[..end.unwrap_or(self.rest.len())].trim_ascii();
        self.rest = end.map_or(&[], |end| &self.rest[end + 1..]);
        self.number += 1;
        Some(Line { number: self.number, text, terminated: end.is_some() })
    }
}

/// The words of a text, which white space parts.
pub(super) fn words(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    text.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

/// The number that a word spells, as `str::parse` reads it.
pub(super) fn number<T: std::str::FromStr>(word: &[u8]) -> Option<T> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// A vertex: the first three of these words.
pub(super) fn position<'a>(mut words: impl Iterator<Item = &'a [u8]>) -> Option<[f64; 3]> {
    let mut coordinate = || number(words.next()?);
    Some([coordinate()?, coordinate()?, coordinate()?])
}
