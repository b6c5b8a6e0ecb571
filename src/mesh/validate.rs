//! What a mesh must satisfy; everything else is allowed.

use crate::error::{Element, Error, Reason, Result};

/// Vertices, triangles and half-edges 3f + k must have 32-bit numbers, with one value to spare that means "none".
pub(crate) fn sizes(vertices: usize, triangles: usize) -> Result<()> {
    let most = u32::MAX as usize;
    if vertices > most || triangles.checked_mul(3).is_none_or(|halfedges| halfedges > most) {
        return Err(Error::new(
            Reason::TooManyElements,
            format!("{vertices} vertices and {triangles} triangles exceed 32-bit half-edge indices"),
        ));
    }
    Ok(())
}

/// Every index is in range and every vertex that a triangle uses has finite coordinates.
pub(crate) fn elements(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<()> {
    for (f, triangle) in triangles.iter().enumerate() {
        for &v in triangle {
            let Some(position) = positions.get(v as usize) else {
                let message = format!("names vertex {v}, but the mesh has {} vertices", positions.len());
                return Err(Error::at(Reason::IndexOutOfRange, Element::Face(f as u64), message));
            };
            if !position.iter().all(|x| x.is_finite()) && !repeats_index(triangle) {
                let message = format!("has a coordinate that is not finite and belongs to face {f}");
                return Err(Error::at(Reason::NonFiniteCoordinate, Element::Vertex(u64::from(v)), message));
            }
        }
    }
    Ok(())
}

/// The triangles that repeat a vertex index.
pub(crate) fn repeated_index(triangles: &[[u32; 3]]) -> Vec<u32> {
    (0..).zip(triangles).filter(|(_, triangle)| repeats_index(triangle)).map(|(f, _)| f).collect()
}

/// Whether a triangle names one vertex twice, and so is ignored.
pub(crate) fn repeats_index(&[a, b, c]: &[u32; 3]) -> bool {
    a == b || b == c || c == a
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halfedges_fit_in_32_bits_with_one_number_to_spare() {
        let most = (u32::MAX / 3) as usize;
        assert_eq!(3 * most, u32::MAX as usize, "the last half-edge is MAX - 1, and MAX means none");
        assert!(sizes(u32::MAX as usize, most).is_ok());
        for (vertices, triangles) in [(0, most + 1), (u32::MAX as usize + 1, 0), (0, usize::MAX)] {
            assert_eq!(sizes(vertices, triangles).unwrap_err().reason(), Reason::TooManyElements);
        }
    }
}
