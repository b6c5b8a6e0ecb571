//! Bytes that nobody meant: small files of every format, changed at random. Each is a mesh or an error, and no mesh is
//! out of proportion to its file.

#[path = "common/glb.rs"]
mod common;

use common::{floats, glb};
use taut::{Mesh, MeshFormat};

/// A tetrahedron in every format and encoding.
fn files() -> Vec<(MeshFormat, Vec<u8>)> {
    let positions = [[0.0_f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let faces = [[0_u32, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    let rows: Vec<String> = positions.iter().map(|[x, y, z]| format!("{x} {y} {z}\n")).collect();
    let triangles: Vec<String> = faces.iter().map(|[a, b, c]| format!("3 {a} {b} {c}\n")).collect();
    let obj: String =
        rows.iter().map(|row| format!("v {row}")).chain(["f 1 -2 2\nf 1/1 2//1 4/1/1 3\n".into()]).collect();
    let off = format!("OFF\n4 4 0\n{}{}", rows.concat(), triangles.concat());
    let ply = |encoding: &str| {
        format!(
            "ply\nformat {encoding} 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
             element face 4\nproperty list uchar int vertex_indices\nend_header\n"
        )
    };
    let ply_text = ply("ascii") + &rows.concat() + &triangles.concat();
    let values = floats(positions.as_flattened());
    let lists: Vec<u8> =
        faces.iter().flat_map(|face| std::iter::once(3).chain(face.iter().flat_map(|v| v.to_le_bytes()))).collect();
    let ply_binary = [ply("binary_little_endian").into_bytes(), values.clone(), lists].concat();
    let corners = || faces.iter().map(|face| face.map(|v| positions[v as usize]));
    let facet = |corners: [[f32; 3]; 3]| {
        let vertices: String = corners.iter().map(|[x, y, z]| format!("vertex {x} {y} {z}\n")).collect();
        format!("facet normal 0 0 1\nouter loop\n{vertices}endloop\nendfacet\n")
    };
    let stl_text = format!("solid\n{}endsolid\n", corners().map(facet).collect::<String>());
    let triangle = |corners: [[f32; 3]; 3]| [vec![0; 12], floats(corners.as_flattened()), vec![0; 2]].concat();
    let stl_binary = [vec![b' '; 80], vec![4, 0, 0, 0], corners().flat_map(triangle).collect()].concat();
    let json = r#"{"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"children":[1],"scale":[1,2,1]},{"mesh":0}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"mode":4}]}],"buffers":[{"byteLength":72}],
        "bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
        {"bufferView":1,"byteOffset":0,"componentType":5123,"count":12,"type":"SCALAR","sparse":{"count":1,"indices":
        {"bufferView":1,"componentType":5123},"values":{"bufferView":1,"byteOffset":2}}}]}"#;
    let indices: Vec<u8> = faces.iter().flatten().flat_map(|&v| (v as u16).to_le_bytes()).collect();
    vec![
        (MeshFormat::Obj, obj.into_bytes()),
        (MeshFormat::Off, off.into_bytes()),
        (MeshFormat::Ply, ply_text.into_bytes()),
        (MeshFormat::Ply, ply_binary),
        (MeshFormat::Stl, stl_text.into_bytes()),
        (MeshFormat::Stl, stl_binary),
        (MeshFormat::Glb, glb(json, &[values, indices].concat())),
    ]
}

/// Numbers that look random and are the same each time (xorshift).
struct Random(u64);

impl Random {
    fn below(&mut self, end: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % end as u64) as usize
    }
}

/// Changes some bits, a digit, or the number of some bytes.
fn mutate(file: &mut Vec<u8>, random: &mut Random) {
    if file.is_empty() {
        return;
    }
    let at = random.below(file.len());
    let end = file.len().min(at + 1 + random.below(40));
    match random.below(6) {
        0 => file[at] ^= 1 << random.below(8),
        1 => file[at] = b"0123456789-.e\n \xff\0"[random.below(17)],
        2 => drop(file.drain(at..end)),
        3 => file.truncate(at),
        4 => file.splice(at..at, file[at..end].to_vec()).for_each(drop),
        _ => file[at..end].reverse(),
    }
}

#[test]
fn changed_bytes_are_a_mesh_in_proportion_or_an_error() {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    for (format, file) in files() {
        assert_eq!(Mesh::read_bytes(&file, format).unwrap().vertex_count(), 4, "{format:?}");
        let mut meshes = 0;
        for _ in 0..20_000 {
            let mut changed = file.clone();
            for _ in 0..=random.below(3) {
                mutate(&mut changed, &mut random);
            }
            if let Ok(mesh) = Mesh::read_bytes(&changed, format) {
                meshes += 1;
                assert!(mesh.vertex_count() + mesh.triangle_count() <= 16 * changed.len(), "{format:?} {changed:?}");
            }
        }
        assert!((400..19_600).contains(&meshes), "{format:?}: {meshes} of 20000 are meshes");
    }
}
