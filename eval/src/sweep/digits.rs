//! Numbers of three significant digits, counted.
//!
//! Number k is m · 10^(d - 2) with m = 100 + k mod 900 and d = ⌊k / 900⌋: 1.00 is number 0, 1.01 number 1, 10.0 number 900.

/// The number of the nearest one to `t`, which is positive and finite.
pub(super) fn nearest(t: f64) -> i32 {
    let text = format!("{t:.2e}"); // as 2.54e-2
    let (digits, decade) = text.split_once('e').unwrap_or((&text, "0"));
    let digits: f64 = digits.parse().unwrap_or(1.0);
    let decade: i32 = decade.parse().unwrap_or(0);
    900 * decade + (100.0 * digits).round() as i32 - 100 // from 0 to 899
}

/// Number k.
pub(super) fn value(k: i32) -> f64 {
    let (decade, mantissa) = (k.div_euclid(900), 100 + k.rem_euclid(900));
    format!("{mantissa}e{}", decade - 2).parse().unwrap_or(f64::NAN) // always a number
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_are_the_decimals() {
        let known = [(0, 1.0), (1, 1.01), (899, 9.99), (900, 10.0), (-1, 0.999), (-900, 0.1), (-1800 + 154, 0.0254)];
        for (k, t) in known {
            assert_eq!(value(k), t);
            assert_eq!(nearest(t), k);
        }
        for k in -5000..5000 {
            assert_eq!(nearest(value(k)), k);
            assert!(value(k) < value(k + 1));
            assert_eq!(nearest(value(k) * 1.0004), k);
        }
    }
}
