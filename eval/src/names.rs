//! The library's choices by the names they have on the command line and in files.

use serde::{Deserialize, Deserializer, Serializer, de::Error as _};
use taut::{Laplacian, TimeFormula, TimeScale};

/// The formulas of t, in the order of the paper's equations 1 to 5.
pub const FORMULAS: [(&str, TimeFormula); 5] = [
    ("mean-edge", TimeFormula::MeanEdge),
    ("sigma", TimeFormula::Sigma),
    ("mean-sigma", TimeFormula::MeanSigma),
    ("median-fit", TimeFormula::MedianFit),
    ("median-mean", TimeFormula::MedianMean),
];

/// The Laplacians: the paper's first.
pub const LAPLACIANS: [(&str, Laplacian); 2] = [("plain", Laplacian::Plain), ("intrinsic", Laplacian::Intrinsic)];

/// The units a formula is evaluated in.
pub const SCALES: [(&str, TimeScale); 2] = [("paper", TimeScale::Paper), ("raw", TimeScale::Raw)];

/// What a choice is called on the command line and in files.
pub(crate) fn name<T: PartialEq>(names: &[(&'static str, T)], choice: T) -> &'static str {
    names.iter().find(|(_, known)| *known == choice).map_or("", |(name, _)| name)
}

/// What a formula is called in tables: `Eq. 1` to `Eq. 5`.
#[must_use]
pub fn equation(formula: TimeFormula) -> &'static str {
    match formula {
        TimeFormula::MeanEdge => "Eq. 1",
        TimeFormula::Sigma => "Eq. 2",
        TimeFormula::MeanSigma => "Eq. 3",
        TimeFormula::MedianFit => "Eq. 4",
        TimeFormula::MedianMean => "Eq. 5",
    }
}

/// A choice that a file knows by its name, for `#[serde(with)]`.
macro_rules! by_name {
    ($module:ident, $type:ty, $names:ident) => {
        pub(crate) mod $module {
            use super::*;

            pub(crate) fn serialize<S: Serializer>(value: &$type, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.serialize_str(name(&$names, *value))
            }

            pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<$type, D::Error> {
                let name = String::deserialize(deserializer)?;
                let choice = $names.iter().find(|(known, _)| *known == name).map(|&(_, choice)| choice);
                choice.ok_or_else(|| D::Error::custom(format!("{name:?} is no {}", stringify!($module))))
            }
        }
    };
}

by_name!(formula, TimeFormula, FORMULAS);
by_name!(laplacian, Laplacian, LAPLACIANS);
by_name!(scale, TimeScale, SCALES);
