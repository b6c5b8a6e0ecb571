//! Numbers as people read them.

/// Three significant digits, or more where these are whole: `0.0254`, `12.3`, `14290`, `3.20·10⁻⁷`.
pub(crate) fn significant(value: f64) -> String {
    digits(value, 3)
}

/// So many significant digits, or more where these are whole.
pub(crate) fn digits(value: f64, count: usize) -> String {
    let size = value.abs();
    if !value.is_finite() || value == 0.0 {
        return fixed(value, 0);
    }
    if !(1e-4..1e6).contains(&size) {
        let written = format!("{value:.*e}", count.saturating_sub(1));
        let (digits, exponent) = written.split_once('e').unwrap_or((&written, "0"));
        return format!("{}·10{}", signed(digits), raised(exponent));
    }
    let before = size.log10().floor() as i32 + 1;
    fixed(value, (count as i32 - before).max(0) as usize)
}

/// With so many digits after the point.
pub(crate) fn fixed(value: f64, decimals: usize) -> String {
    match value {
        _ if value.is_nan() => "–".to_owned(),
        _ if value.is_infinite() => signed(if value > 0.0 { "∞" } else { "-∞" }),
        _ => {
            let written = format!("{value:.decimals$}");
            let is_zero = written.bytes().all(|b| b"-0.".contains(&b));
            signed(if is_zero { written.trim_start_matches('-') } else { &written })
        }
    }
}

/// The gain 100 (1 - ratio) with its sign.
pub(crate) fn gain(ratio: f64) -> String {
    let gain = 100.0 * (1.0 - ratio);
    let sign = if gain >= 0.05 { "+" } else { "" };
    format!("{sign}{}\u{202f}%", fixed(gain, if gain.abs() < 100.0 { 1 } else { 0 }))
}

/// The minus sign instead of the hyphen.
fn signed(written: &str) -> String {
    written.replace('-', "−")
}

/// A power of ten: `10⁻⁷`.
pub(crate) fn power_of_ten(exponent: i32) -> String {
    format!("10{}", raised(&exponent.to_string()))
}

fn raised(digits: &str) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let one = |c: char| c.to_digit(10).map_or('⁻', |digit| RAISED[digit as usize]);
    digits.chars().map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_digits_wherever_the_point_is() {
        let cases = [(0.025_43, "0.0254"), (12.345, "12.3"), (14290.4, "14290"), (-0.5, "−0.500"), (999.96, "1000")];
        for (value, expected) in cases {
            assert_eq!(significant(value), expected);
        }
        assert_eq!(significant(3.2e-7), "3.20·10⁻⁷");
        assert_eq!(significant(-1e300), "−1.00·10³⁰⁰");
        assert_eq!([0.215_854_1, 102.294_44, 1.03e-5].map(|x| digits(x, 6)), ["0.215854", "102.294", "1.03000·10⁻⁵"]);
        assert_eq!([f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0].map(significant), ["–", "∞", "−∞", "0"]);
    }

    #[test]
    fn a_gain_has_its_sign() {
        assert_eq!(
            [0.877, 1.25, 1.0, 31.0].map(gain),
            ["+12.3\u{202f}%", "−25.0\u{202f}%", "0.0\u{202f}%", "−3000\u{202f}%"]
        );
        assert_eq!(fixed(-0.000_001, 3), "0.000");
    }
}
