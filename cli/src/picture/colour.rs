//! Colours and colour maps.
//!
//! Light adds up linearly, so colours are linear RGB throughout and become sRGB only in the file. A map runs through a few
//! colours at constant speed in Oklab, where equal distances look equal: equal steps of the value are equal steps to the
//! eye.
//!
//! References: B. Ottosson, "A perceptual color space for image processing" (2020); IEC 61966-2-1 (sRGB).

use glam::{Mat3, Vec3};

/// The linear colour of 0xRRGGBB.
pub(super) fn srgb(hex: u32) -> Vec3 {
    let channel = |shift: u32| {
        let c = ((hex >> shift) & 255) as f32 / 255.0;
        if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
    };
    Vec3::new(channel(16), channel(8), channel(0))
}

/// From linear light to the bytes of a file, by a table fine enough to hit every byte.
pub(crate) struct Encoder(Vec<u8>);

impl Encoder {
    const STEPS: f32 = 16384.0;

    pub(crate) fn new() -> Encoder {
        let encode = |i: u16| {
            let c = f32::from(i) / Encoder::STEPS;
            let c = if c <= 0.003_130_8 { 12.92 * c } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 };
            (255.0 * c).round() as u8 // saturates, as it should
        };
        Encoder((0..=Encoder::STEPS as u16).map(encode).collect())
    }

    pub(crate) fn bytes(&self, linear: Vec3) -> [u8; 3] {
        let steps = linear.clamp(Vec3::ZERO, Vec3::ONE) * Encoder::STEPS + 0.5;
        steps.to_array().map(|step| self.0[step as usize]) // cuts off the fraction; at most STEPS
    }
}

/// A colour for each value in [0, 1].
pub(crate) struct ColourMap(Vec<Vec3>);

impl ColourMap {
    const STEPS: usize = 1024;

    /// Through these colours, 0xRRGGBB, the first at 0 and the last at 1.
    pub(super) fn through(stops: &[u32]) -> ColourMap {
        let stops: Vec<Vec3> = stops.iter().map(|&hex| oklab(srgb(hex))).collect();
        let lengths: Vec<f32> = stops.windows(2).map(|pair| pair[0].distance(pair[1])).collect();
        let total: f32 = lengths.iter().sum();
        let colour = |i: usize| {
            let mut way = total * i as f32 / ColourMap::STEPS as f32;
            let mut k = 0;
            while k + 1 < lengths.len() && way > lengths[k] {
                way -= lengths[k];
                k += 1;
            }
            linear(stops[k].lerp(stops[k + 1], (way / lengths[k]).min(1.0)))
        };
        ColourMap((0..=ColourMap::STEPS).map(colour).collect())
    }

    /// These colours, 0xRRGGBB, alone: the first at 0 and the last at 1, each around its place.
    pub(super) fn steps(colours: &[u32]) -> ColourMap {
        let last = colours.len() - 1;
        let nearest = |i: usize| (i * last + ColourMap::STEPS / 2) / ColourMap::STEPS;
        ColourMap((0..=ColourMap::STEPS).map(|i| srgb(colours[nearest(i)])).collect())
    }

    /// The linear colour of `t`; below 0 and above 1 that of the end.
    pub(crate) fn at(&self, t: f32) -> Vec3 {
        self.0[(t.clamp(0.0, 1.0) * ColourMap::STEPS as f32 + 0.5) as usize] // at most STEPS
    }
}

fn oklab(linear: Vec3) -> Vec3 {
    let lms = TO_CONES.transpose() * linear;
    TO_LAB.transpose() * Vec3::new(lms.x.cbrt(), lms.y.cbrt(), lms.z.cbrt())
}

fn linear(lab: Vec3) -> Vec3 {
    let lms = TO_LAB.transpose().inverse() * lab;
    TO_CONES.transpose().inverse() * (lms * lms * lms)
}

/// Row by row, so transposed: glam's matrices are lists of columns.
const TO_CONES: Mat3 = Mat3::from_cols(
    Vec3::new(0.412_221_46, 0.536_332_55, 0.051_445_995),
    Vec3::new(0.211_903_5, 0.680_699_5, 0.107_396_96),
    Vec3::new(0.088_302_46, 0.281_718_85, 0.629_978_7),
);
const TO_LAB: Mat3 = Mat3::from_cols(
    Vec3::new(0.210_454_26, 0.793_617_8, -0.004_072_047),
    Vec3::new(1.977_998_5, -2.428_592_2, 0.450_593_7),
    Vec3::new(0.025_904_037, 0.782_771_77, -0.808_675_77),
);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_survive_linear_light() {
        let encoder = Encoder::new();
        for c in 0..=255u8 {
            let [r, g, b] = [c, 255 - c, c / 2];
            let hex = u32::from(r) << 16 | u32::from(g) << 8 | u32::from(b);
            assert_eq!(encoder.bytes(srgb(hex)), [r, g, b]);
        }
        assert_eq!(encoder.bytes(Vec3::new(-1.0, 2.0, f32::INFINITY)), [0, 255, 255]);
    }

    #[test]
    fn a_map_passes_its_stops_at_even_speed() {
        let map = ColourMap::through(&[0xff_f1_d6, 0xf8_8a_68, 0x3b_32_80]);
        let encoder = Encoder::new();
        let ends = [-1.0, 0.0, 1.0, 2.0].map(|t| encoder.bytes(map.at(t)));
        assert_eq!(ends, [[0xff, 0xf1, 0xd6], [0xff, 0xf1, 0xd6], [0x3b, 0x32, 0x80], [0x3b, 0x32, 0x80]]);
        let steps: Vec<f32> = map.0.windows(2).map(|pair| oklab(pair[0]).distance(oklab(pair[1]))).collect();
        let mean = steps.iter().sum::<f32>() / steps.len() as f32;
        // One step turns at the middle stop.
        assert!(steps.iter().filter(|&&step| (step / mean - 1.0).abs() > 0.02).count() <= 1);
    }
}
