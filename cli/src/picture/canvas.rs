//! A picture in linear light.

use super::colour::Encoder;
use glam::Vec3;

pub(super) struct Canvas {
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) pixels: Vec<Vec3>,
}

impl Canvas {
    pub(super) fn new(width: u32, height: u32, colour: Vec3) -> Canvas {
        Canvas { width, height, pixels: vec![colour; width as usize * height as usize] }
    }

    /// Covers a part of a pixel with a colour; a place off the picture is left alone.
    pub(super) fn blend(&mut self, [x, y]: [i64; 2], colour: Vec3, cover: f32) {
        if (0..i64::from(self.width)).contains(&x) && (0..i64::from(self.height)).contains(&y) {
            let at = &mut self.pixels[y as usize * self.width as usize + x as usize];
            *at = at.lerp(colour, cover.clamp(0.0, 1.0));
        }
    }

    /// Covers a shape with the colours of its rows: `cover` tells how much of the pixel whose middle is (x, y).
    pub(super) fn fill(&mut self, box_: [f32; 4], colour: impl Fn(f32) -> Vec3, cover: impl Fn(f32, f32) -> f32) {
        let [left, top, right, bottom] = box_;
        for row in top.floor() as i64..bottom.ceil() as i64 {
            let y = row as f32 + 0.5;
            for column in left.floor() as i64..right.ceil() as i64 {
                self.blend([column, row], colour(y), cover(column as f32 + 0.5, y));
            }
        }
    }

    /// The bytes of a PNG file.
    pub(super) fn png(&self) -> Result<Vec<u8>, png::EncodingError> {
        let encoder = Encoder::new();
        let bytes: Vec<u8> = self.pixels.iter().flat_map(|&pixel| encoder.bytes(pixel)).collect();
        let mut file = Vec::new();
        let mut png = png::Encoder::new(&mut file, self.width, self.height);
        png.set_color(png::ColorType::Rgb);
        png.set_depth(png::BitDepth::Eight);
        png.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        png.set_filter(png::Filter::Adaptive);
        png.set_compression(png::Compression::Balanced);
        let mut writer = png.write_header()?;
        writer.write_image_data(&bytes)?;
        writer.finish()?;
        Ok(file)
    }
}
