//! What can go wrong.

use std::fmt;
use std::path::{Path, PathBuf};
use taut::Reason;

/// A `Result` with this crate's error.
pub type Result<T> = std::result::Result<T, Error>;

/// Why an evaluation, or a part of it, failed.
#[derive(Debug)]
pub enum Error {
    /// A mesh, or computing on it.
    Model {
        /// Its name or its file.
        name: String,
        /// What the library says.
        error: taut::Error,
    },
    /// A file that cannot be read or written.
    File {
        /// Which.
        path: PathBuf,
        /// Why not.
        error: std::io::Error,
    },
    /// What was asked for makes no sense.
    Input(String),
}

impl Error {
    /// Whether the work was cancelled rather than failed.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        matches!(self, Error::Model { error, .. } if error.reason() == Reason::Cancelled)
    }

    pub(crate) fn of_model(name: &str) -> impl Fn(taut::Error) -> Error {
        move |error| Error::Model { name: name.to_owned(), error }
    }

    pub(crate) fn of_file(path: &Path) -> impl Fn(std::io::Error) -> Error {
        move |error| Error::File { path: path.to_owned(), error }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Error::Model { name, error } => write!(f, "{name}: {error}"),
            Error::File { path, error } => write!(f, "{}: {error}", path.display()),
            Error::Input(message) => f.write_str(message),
        }
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Error::Model { error, .. } => Some(error),
            Error::File { error, .. } => Some(error),
            Error::Input(_) => None,
        }
    }
}
