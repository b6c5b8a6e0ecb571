//! Anti-aliased text in Inter, a typeface under the Open Font License (font/OFL.txt).

use super::canvas::Canvas;
use ab_glyph::{Font, FontRef, Glyph, PxScale, ScaleFont, point};
use glam::Vec3;

static INTER: &[u8] = include_bytes!("font/Inter-Medium-latin.ttf");

/// Writes `text` from `x` on the base line `y`, `size` pixels high.
pub(super) fn write(canvas: &mut Canvas, text: &str, [x, y]: [f32; 2], size: f32, colour: Vec3) {
    let Some(font) = font() else { return };
    let font = font.as_scaled(PxScale::from(size));
    let mut x = x;
    let mut previous = None;
    for character in text.chars() {
        let id = font.glyph_id(character);
        x += previous.map_or(0.0, |previous| font.kern(previous, id));
        previous = Some(id);
        let glyph = Glyph { id, scale: font.scale, position: point(x, y) };
        x += font.h_advance(id);
        if let Some(outline) = font.outline_glyph(glyph) {
            let corner = outline.px_bounds().min;
            outline.draw(|dx, dy, cover| {
                // Dark letters on light ground look thin where light is added up rightly.
                let cover = cover * (2.0 - cover);
                canvas.blend([corner.x as i64 + i64::from(dx), corner.y as i64 + i64::from(dy)], colour, cover);
            });
        }
    }
}

/// `None` never: the font is built in.
fn font() -> Option<FontRef<'static>> {
    FontRef::try_from_slice(INTER).ok()
}
