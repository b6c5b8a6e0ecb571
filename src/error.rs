//! Typed errors that name the element they concern.
//!
//! Every failure of the library is an [`Error`]: a [`Reason`] to match on, the [`Element`] that is at fault where there
//! is one, and a message that names the parameter. Each reason belongs to one of about ten coarse [`Status`] codes, the
//! ones that cross the C border.

use std::fmt;

/// `Result` with this crate's [`Error`].
pub type Result<T> = std::result::Result<T, Error>;

/// Coarse classes of failure; bindings map them one to one to exceptions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[repr(i32)]
pub enum Status {
    /// No failure.
    Ok = 0,
    /// A parameter is outside its documented range.
    InvalidArgument = 1,
    /// The mesh cannot be used: a bad index or coordinate.
    InvalidMesh = 2,
    /// A file could not be opened, read or written.
    Io = 3,
    /// A file's content is not what its format asks for.
    Format = 4,
    /// A valid request that this build or version does not serve.
    Unsupported = 5,
    /// The computation broke down numerically.
    Numeric = 6,
    /// The caller cancelled the work.
    Cancelled = 7,
    /// A size exceeds what the library can address or allocate.
    TooLarge = 8,
    /// A defect of the library; please report it.
    Internal = 9,
    /// The work reached a limit that the caller set.
    LimitReached = 10,
}

/// What went wrong, finer than the status.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[repr(i32)]
#[non_exhaustive]
pub enum Reason {
    /// A required pointer was NULL.
    NullPointer = 1,
    /// An argument has a value that its documentation excludes.
    BadArgument = 2,
    /// No source was given.
    NoSource = 3,
    /// A source or target names a vertex that the mesh does not have.
    VertexOutOfRange = 4,
    /// A buffer is too small for its count and stride.
    BufferTooSmall = 5,
    /// The time step t is not positive and finite.
    BadTimeStep = 6,
    /// With pure Dirichlet conditions a source lies on the boundary.
    SourceOnBoundary = 7,
    /// A face names a vertex that the mesh does not have.
    IndexOutOfRange = 20,
    /// A vertex that a face uses has a coordinate that is NaN or infinite.
    NonFiniteCoordinate = 21,
    /// Polygon offsets do not start at 0, decrease, or do not end at the corner count.
    BadOffsets = 22,
    /// A face has fewer than three corners.
    FaceTooSmall = 23,
    /// The file could not be opened, read or written.
    Io = 40,
    /// The file's content does not follow its format.
    Malformed = 41,
    /// The file ends before its content does.
    Truncated = 42,
    /// The file's format is not one that the library reads.
    UnknownFormat = 43,
    /// This build lacks the requested feature.
    MissingFeature = 50,
    /// A factorisation met a pivot that is not positive.
    NotPositiveDefinite = 60,
    /// Rounding leaves a path undetermined, among triangles without area that lie upon each other.
    PathLost = 61,
    /// The caller cancelled.
    Cancelled = 70,
    /// The time limit of the control is over.
    TimeLimit = 71,
    /// The work uses more memory than the control allows.
    MemoryLimit = 72,
    /// More vertices, faces or half-edges than 32-bit indices address.
    TooManyElements = 80,
    /// An allocation failed.
    OutOfMemory = 81,
    /// A panic was caught at the C border.
    Panic = 90,
}

impl Reason {
    /// The coarse class of this reason.
    #[must_use]
    pub fn status(self) -> Status {
        match self {
            Reason::NullPointer
            | Reason::BadArgument
            | Reason::NoSource
            | Reason::VertexOutOfRange
            | Reason::BufferTooSmall
            | Reason::BadTimeStep
            | Reason::SourceOnBoundary => Status::InvalidArgument,
            Reason::IndexOutOfRange | Reason::NonFiniteCoordinate | Reason::BadOffsets | Reason::FaceTooSmall => {
                Status::InvalidMesh
            }
            Reason::Io => Status::Io,
            Reason::Malformed | Reason::Truncated | Reason::UnknownFormat => Status::Format,
            Reason::MissingFeature => Status::Unsupported,
            Reason::NotPositiveDefinite | Reason::PathLost => Status::Numeric,
            Reason::Cancelled => Status::Cancelled,
            Reason::TimeLimit | Reason::MemoryLimit => Status::LimitReached,
            Reason::TooManyElements | Reason::OutOfMemory => Status::TooLarge,
            Reason::Panic => Status::Internal,
        }
    }
}

/// The element that an error is about; every index counts from 0, a line from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Element {
    /// A vertex of the mesh.
    Vertex(u64),
    /// A face of the input.
    Face(u64),
    /// An entry of the list of sources.
    Source(u64),
    /// An entry of the list of targets.
    Target(u64),
    /// A line of a text file.
    Line(u64),
    /// An entry of the list of levels.
    Level(u64),
    /// An entry of a list of points.
    Point(u64),
}

impl fmt::Display for Element {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Element::Vertex(i) => write!(out, "vertex {i}"),
            Element::Face(i) => write!(out, "face {i}"),
            Element::Source(i) => write!(out, "source {i}"),
            Element::Target(i) => write!(out, "target {i}"),
            Element::Line(i) => write!(out, "line {i}"),
            Element::Level(i) => write!(out, "level {i}"),
            Element::Point(i) => write!(out, "point {i}"),
        }
    }
}

/// A failure: its reason, the element at fault where there is one, and a message for people.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Error {
    reason: Reason,
    element: Option<Element>,
    message: String,
}

impl Error {
    /// An error that concerns no single element.
    pub fn new(reason: Reason, message: impl Into<String>) -> Error {
        Error { reason, element: None, message: message.into() }
    }

    /// An error about one element.
    pub fn at(reason: Reason, element: Element, message: impl Into<String>) -> Error {
        Error { reason, element: Some(element), message: message.into() }
    }

    /// The same error, about this element.
    #[must_use]
    pub fn about(self, element: Element) -> Error {
        Error { element: Some(element), ..self }
    }

    /// What went wrong.
    #[must_use]
    pub fn reason(&self) -> Reason {
        self.reason
    }

    /// The coarse class of the failure.
    #[must_use]
    pub fn status(&self) -> Status {
        self.reason.status()
    }

    /// The element at fault, where there is one.
    #[must_use]
    pub fn element(&self) -> Option<Element> {
        self.element
    }

    /// The message without the element.
    #[must_use]
    pub fn message(&self) -> &str {
        &self.message
    }
}

impl fmt::Display for Error {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.element {
            Some(element) => write!(out, "{element}: {}", self.message),
            None => out.write_str(&self.message),
        }
    }
}

impl std::error::Error for Error {}
