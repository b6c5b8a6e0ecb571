//! Things on the surface: sources, targets, points, the closest place, curves and isolines; later paths and comparisons.

pub(crate) mod closest;
pub(crate) mod curve;
pub(crate) mod isoline;
pub(crate) mod point;
pub(crate) mod source;
pub(crate) mod target;
