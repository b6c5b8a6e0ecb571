//! Real meshes that are hard on every method.

use crate::common::corpus;
use taut::Mesh;

const NAMES: [&str; 17] = [
    "beetle_lowres_nm.obj",
    "boeing_soup.off",
    "bunny_stanford_unref.obj.gz",
    "fan3_nm_edge.obj",
    "fandisk.off",
    "hero_soup.off",
    "hourglass_nm_vertex.obj",
    "klingon_starship.off",
    "louvre_cad.obj",
    "many_small_holes.ply",
    "moebius.obj",
    "mpi_near_degenerate.off",
    "office_chair_bad.obj",
    "suzanne.obj",
    "teapot.obj",
    "triceratops_slivers.off",
    "truck_nm.obj",
];

/// Meshes with slivers, holes, vertices of no triangle, non-manifold edges and vertices, one side, and soups, by
/// name; none without the corpus.
pub(crate) fn bad_meshes() -> impl Iterator<Item = (&'static str, Mesh)> {
    let read = |folder: std::path::PathBuf| NAMES.map(|name| (name, folder.join(name)));
    corpus().into_iter().flat_map(read).map(|(name, path)| (name, Mesh::read(path).unwrap()))
}
