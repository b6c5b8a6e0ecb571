//! Things on the surface: sources, points, curves and isolines; later paths and comparisons.

pub(crate) mod isoline;
pub(crate) mod point;
