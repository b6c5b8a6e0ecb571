//! Where the segments of a path lie, and how long they are.

use crate::places::euclid;
use taut::{Closest, Curve, Mesh, SurfacePoint};

pub(crate) fn length(mesh: &Mesh, path: &Curve) -> f64 {
    path.positions(mesh).unwrap().windows(2).map(|pair| euclid(pair[0], pair[1])).sum()
}

/// Whether a point lies in a triangle, by its corners, or by its place: of several points of a path at one place, around a
/// triangle without area, only one is kept.
pub(crate) fn is_in(mesh: &Mesh, point: &SurfacePoint, face: u32) -> bool {
    let [corners, others] = [face, point.face].map(|face| mesh.triangles()[face as usize]);
    let shares_corners = (0..3).all(|k| point.barycentric[k] == 0.0 || corners.contains(&others[k]));
    shares_corners || {
        let alone = Mesh::from_triangles(&corners.map(|v| mesh.positions()[v as usize]), &[[0, 1, 2]]).unwrap();
        let place = point.position(mesh).unwrap();
        let size = place.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
        Closest::new(&alone).unwrap().point(place).unwrap().distance <= 1e-15 * size
    }
}
