//! What the paper prints.
use taut::Mesh;
/// The source of its first basic mesh
pub const BASIC_SOURCE: u32 = 7649;
/// Whether a mesh has the counts of the paper's 1.obj: 14290 vertices, 42864 edges, 28576 triangles.
#[must_use]
pub fn is_basic(mesh: &Mesh) -> bool {
    mesh.vertex_count() == 14290 && mesh.triangle_count() == 28576
}
