//! Midpoint subdivision: the paper's fertility is the well-known mesh after one step of it.

use taut::shapes::{Shape, subdivided};
use taut::{Mesh, Reason};

/// Each triangle cut in four at the midpoints of its edges: the same surface. Vertices keep their index, then comes one for
/// each edge; triangles that repeat an index have none and become four of their kind. O(V + F).
///
/// # Errors
/// [`Reason::TooManyElements`] if the result might not fit in 32 bits.
pub fn midpoint_split(mesh: &Mesh) -> taut::Result<Mesh> {
    let [vertices, corners] = [mesh.vertex_count(), mesh.triangle_count().saturating_mul(3)];
    let most = vertices.saturating_add(corners).max(corners.saturating_mul(4));
    if u32::try_from(most).is_err() {
        return Err(taut::Error::new(Reason::TooManyElements, "the mesh is too large to be split"));
    }
    subdivided(&Shape { positions: mesh.positions().to_vec(), triangles: mesh.triangles().to_vec() }).mesh()
}

#[cfg(test)]
mod tests {
    use super::*;
    use taut::Properties;

    #[test]
    fn a_split_halves_edges_and_keeps_angles() {
        let mesh = taut::shapes::icosphere(1).mesh().unwrap();
        let fine = midpoint_split(&mesh).unwrap();
        let [before, after] = [&mesh, &fine].map(|mesh| Properties::of(mesh).unwrap());
        assert_eq!(after.vertices, before.vertices + before.edges);
        assert_eq!((after.faces, after.edges), (4 * before.faces, 2 * before.edges + 3 * before.faces));
        assert_eq!(&fine.positions()[..mesh.vertex_count()], mesh.positions());
        assert!((after.min_angle - before.min_angle).abs() < 1e-12);
        assert!((after.max_angle - before.max_angle).abs() < 1e-12);
        assert!((after.anisotropy - before.anisotropy).abs() < 1e-12);
        assert!((after.max_edge - before.max_edge / 2.0).abs() < 1e-12);
    }

    #[test]
    fn vertices_that_no_triangle_uses_may_hold_anything() {
        let mesh = Mesh::from_triangles(&[[f64::NAN; 3], [0.0; 3], [1.0; 3], [0.0, 1.0, 0.0]], &[[1, 2, 3]]).unwrap();
        assert_eq!(midpoint_split(&mesh).unwrap().triangles()[3], [4, 5, 6]);
    }

    #[test]
    fn nothing_splits_into_nothing() {
        let mesh = Mesh::from_triangles(&[], &[]).unwrap();
        assert_eq!(midpoint_split(&mesh).unwrap().triangle_count(), 0);
    }
}
