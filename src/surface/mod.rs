//! Things on the surface: points, and later paths, isolines and comparisons.

pub(crate) mod point;
