//! The colours: the same thing has the same colour everywhere, and no two in one figure differ by red and green alone.

use crate::gain::Verdict;
use plotters::style::RGBColor;
use taut::{Laplacian, TimeFormula};

pub(super) const INK: RGBColor = RGBColor(0x26, 0x2a, 0x31);
pub(super) const SOFT: RGBColor = RGBColor(0x6b, 0x72, 0x80);
pub(super) const GRID: RGBColor = RGBColor(0xe3, 0xe5, 0xe8);
pub(super) const TREND: RGBColor = RGBColor(0xc4, 0x3c, 0x39);

/// Five shades from light to dark, for meshes that come in an order.
pub(super) const ORDERED: [RGBColor; 5] = [
    RGBColor(0xe0, 0xa5, 0x30),
    RGBColor(0xd9, 0x6f, 0x3a),
    RGBColor(0xb8, 0x3c, 0x5e),
    RGBColor(0x7a, 0x2b, 0x7d),
    RGBColor(0x2f, 0x22, 0x6b),
];

/// Those made for the mean error are red, those for the median green.
pub(super) fn of_formula(formula: TimeFormula) -> RGBColor {
    match formula {
        TimeFormula::MeanEdge => RGBColor(0x80, 0x8a, 0x9c),
        TimeFormula::Sigma => RGBColor(0xd1, 0x5c, 0x96),
        TimeFormula::MeanSigma => RGBColor(0x86, 0x1f, 0x5c),
        TimeFormula::MedianFit => RGBColor(0x3f, 0xb5, 0x9a),
        TimeFormula::MedianMean => RGBColor(0x0b, 0x69, 0x57),
    }
}

pub(super) fn of_laplacian(laplacian: Laplacian) -> RGBColor {
    match laplacian {
        Laplacian::Plain => RGBColor(0x4b, 0x55, 0xb0),
        Laplacian::Intrinsic => RGBColor(0xcf, 0x94, 0x08),
    }
}

pub(super) fn of_verdict(verdict: Verdict) -> RGBColor {
    match verdict {
        Verdict::Better => RGBColor(0x00, 0x72, 0xb2),
        Verdict::Worse => RGBColor(0xd5, 0x5e, 0x00),
        Verdict::Unsure => RGBColor(0x96, 0x9b, 0xa3),
    }
}

/// As style sheets have it.
pub(super) fn hex(RGBColor(red, green, blue): RGBColor) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}
