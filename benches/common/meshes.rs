//! What the benchmarks run on.

use std::path::Path;
use taut::{Mesh, shapes};

/// Made shapes of about 20,000 triangles, and the meshes of the corpus that TAUT_CORPUS names.
pub(crate) fn all() -> Vec<(&'static str, Mesh)> {
    let made = [
        ("grid", shapes::grid(100, 100)),
        ("saddle", shapes::saddle(100)),
        ("terrain", shapes::terrain(100, 0.3)),
        ("sphere", shapes::icosphere(5)),
        ("torus", shapes::torus(144, 72, 1.0, 0.4)),
    ];
    let mut meshes: Vec<_> = made.map(|(name, shape)| (name, shape.mesh().expect("shapes are sound"))).into();
    if let Some(folder) = std::env::var_os("TAUT_CORPUS") {
        for name in ["bunny_stanford_unref.obj.gz", "mountain_terrain.obj.gz", "nefertiti.obj.gz", "lucy.obj.gz"] {
            meshes.push((name, Mesh::read(Path::new(&folder).join(name)).expect("TAUT_CORPUS holds the corpus")));
        }
    }
    meshes
}

/// The first vertex that a triangle uses.
pub(crate) fn source(mesh: &Mesh) -> u32 {
    mesh.triangles().iter().flatten().copied().min().expect("a mesh has triangles")
}
