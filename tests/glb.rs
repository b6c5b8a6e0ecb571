//! Binary glTF: how a scene becomes one mesh, and what is said of scenes that are not read.

#[path = "common/glb.rs"]
mod common;

use common::{floats, glb};
use taut::{Element, Mesh, MeshFormat, Reason};

const CORNERS: [f32; 12] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0];

fn read(file: &[u8]) -> Mesh {
    Mesh::read_bytes(file, MeshFormat::Glb).unwrap()
}

fn fails(file: &[u8]) -> Reason {
    Mesh::read_bytes(file, MeshFormat::Glb).unwrap_err().reason()
}

/// A scene of these nodes, of meshes with one primitive each, over the views that the accessors name. View 0 has the
/// four corners of a unit square, view 1 the numbers 0, 1, 2, 3 as bytes.
fn scene(nodes: &str, primitives: &[&str], accessors: &str) -> Vec<u8> {
    let meshes: Vec<String> = primitives.iter().map(|primitive| format!("{{\"primitives\":[{primitive}]}}")).collect();
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"nodes":[{nodes}],"meshes":[{}],"accessors":[{accessors}],
            "bufferViews":[{{"buffer":0,"byteLength":48}},{{"buffer":0,"byteOffset":48,"byteLength":4}}],
            "buffers":[{{"byteLength":52}},{{"byteLength":48}}]}}"#,
        meshes.join(",")
    );
    glb(&json, &[floats(&CORNERS), vec![0, 1, 2, 3]].concat())
}

const SQUARE: &str = r#"{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}"#;
const TRIANGLE: &str = r#"{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}"#;
const BYTES: &str = r#"{"bufferView":1,"componentType":5121,"count":4,"type":"SCALAR"}"#;
const NODE: &str = r#"{"mesh":0}"#;
const PLAIN: &str = r#"{"attributes":{"POSITION":0}}"#;

#[test]
fn the_suffix_is_glb() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("triangle.glb");
    std::fs::write(&path, scene(NODE, &[PLAIN], TRIANGLE)).unwrap();
    assert_eq!(Mesh::read(&path).unwrap().triangles(), [[0, 1, 2]]);
}

#[test]
fn a_mesh_without_seams_keeps_its_vertices_and_their_order() {
    let indices = r#"{"bufferView":1,"byteOffset":1,"componentType":5121,"count":3,"type":"SCALAR"}"#;
    let primitive = r#"{"attributes":{"POSITION":0,"NORMAL":7},"indices":1}"#;
    let mesh = read(&scene(NODE, &[primitive], &[SQUARE, indices].join(",")));
    assert_eq!(mesh.positions(), [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]]);
    assert_eq!(mesh.triangles(), [[1, 2, 3]]);
}

#[test]
fn strips_and_fans_become_triangles_and_points_and_lines_nothing() {
    assert_eq!(fails(&scene(NODE, &[PLAIN], SQUARE)), Reason::Malformed, "four corners are no triangles");
    for (mode, triangles) in [(5, [[0, 1, 2], [1, 3, 2]]), (6, [[1, 2, 0], [2, 3, 0]])] {
        let primitive = format!(r#"{{"attributes":{{"POSITION":0}},"indices":1,"mode":{mode}}}"#);
        assert_eq!(read(&scene(NODE, &[&primitive], &[SQUARE, BYTES].join(","))).triangles(), triangles);
    }
    for mode in 0..4 {
        let points = format!(r#"{{"attributes":{{"POSITION":0}},"mode":{mode}}}"#);
        let nodes = r#"{"mesh":1},{"mesh":0}"#;
        assert_eq!(read(&scene(nodes, &[PLAIN, &points], TRIANGLE)).triangles(), [[0, 1, 2]]);
        assert_eq!(fails(&scene(NODE, &[&points], TRIANGLE)), Reason::Malformed, "no triangle at all");
    }
    assert_eq!(fails(&scene(NODE, &[r#"{"attributes":{"POSITION":0},"mode":7}"#], TRIANGLE)), Reason::Malformed);
}

#[test]
fn nodes_place_their_meshes_and_those_below_them() {
    let nodes = r#"{"children":[2],"translation":[10,0,0]},{"mesh":0},
        {"mesh":0,"rotation":[0,0,0.7071067811865476,0.7071067811865476],"scale":[2,1,1]}"#;
    let mesh = read(&scene(nodes, &[PLAIN], TRIANGLE));
    let expected =
        [[10.0, 0.0, 0.0], [10.0, 2.0, 0.0], [9.0, 0.0, 0.0], [0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    assert_eq!(mesh.triangles(), [[0, 1, 2], [3, 4, 5]]);
    for (found, expected) in mesh.positions().iter().flatten().zip(expected.iter().flatten()) {
        assert!((found - expected).abs() < 1e-14, "{:?}", mesh.positions());
    }
}

#[test]
fn a_mirror_turns_triangles_round_and_equal_positions_of_two_nodes_are_one_vertex() {
    let nodes = r#"{"mesh":0},{"mesh":0,"matrix":[-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}"#;
    let mesh = read(&scene(nodes, &[PLAIN], TRIANGLE));
    assert_eq!(mesh.positions(), [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]);
    assert_eq!(mesh.triangles(), [[0, 1, 2], [0, 2, 3]]);
}

#[test]
fn the_default_scene_leaves_other_nodes_out() {
    let nodes = r#"{"mesh":0,"translation":[5,0,0]},{"mesh":0}"#;
    let json = |scene: u32| {
        format!(
            r#"{{"scene":{scene},"scenes":[{{"nodes":[0]}},{{"nodes":[1]}}],"nodes":[{nodes}],"meshes":[{{"primitives":[{PLAIN}]}}],
            "accessors":[{TRIANGLE}],"bufferViews":[{{"buffer":0,"byteLength":36}}],"buffers":[{{"byteLength":36}}]}}"#
        )
    };
    for (scene, x) in [(0, 5.0), (1, 0.0)] {
        let mesh = read(&glb(&json(scene), &floats(&CORNERS[..9])));
        assert_eq!((mesh.vertex_count(), mesh.positions()[0][0]), (3, x));
    }
    assert_eq!(fails(&glb(&json(2), &floats(&CORNERS))), Reason::Malformed);
}

#[test]
fn indices_of_every_type_strides_and_sparse_values() {
    for (code, bytes) in [
        (5121, vec![2, 1, 0]),
        (5123, [2_u16, 1, 0].iter().flat_map(|i| i.to_le_bytes()).collect()),
        (5125, [2_u32, 1, 0].iter().flat_map(|i| i.to_le_bytes()).collect()),
    ] {
        // Positions four floats apart, the last without its filler; vertex 2 is moved by a sparse value.
        let positions = floats(&[0.0, 0.0, 0.0, 9.0, 1.0, 0.0, 0.0, 9.0, 0.0, 1.0, 0.0]);
        let sparse = [vec![2, 0, 0, 0], floats(&[7.0, 8.0, 9.0])].concat();
        let json = format!(
            r#"{{"nodes":[{NODE}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],
            "buffers":[{{}}],"bufferViews":[{{"buffer":0,"byteLength":44,"byteStride":16}},
            {{"buffer":0,"byteOffset":44,"byteLength":16}},{{"buffer":0,"byteOffset":60,"byteLength":{}}}],
            "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","sparse":{{"count":1,
            "indices":{{"bufferView":1,"componentType":5121}},"values":{{"bufferView":1,"byteOffset":4}}}}}},
            {{"bufferView":2,"componentType":{code},"count":3,"type":"SCALAR"}}]}}"#,
            bytes.len()
        );
        let mesh = read(&glb(&json, &[positions, sparse, bytes].concat()));
        assert_eq!(mesh.positions(), [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [7.0, 8.0, 9.0]]);
        assert_eq!(mesh.triangles(), [[2, 1, 0]]);
    }
}

#[test]
fn quantized_positions_are_numbers_or_parts_of_one() {
    let with = |normalized: bool| {
        let json = format!(
            r#"{{"extensionsRequired":["KHR_mesh_quantization"],"nodes":[{NODE}],"meshes":[{{"primitives":[{PLAIN}]}}],
            "buffers":[{{}}],"bufferViews":[{{"buffer":0,"byteLength":9}}],
            "accessors":[{{"bufferView":0,"componentType":5120,"count":3,"type":"VEC3","normalized":{normalized}}}]}}"#
        );
        read(&glb(&json, &[127, 0, 0, 0, 127, 0, 128, 129, 0])).positions().to_vec()
    };
    assert_eq!(with(false), [[127.0, 0.0, 0.0], [0.0, 127.0, 0.0], [-128.0, -127.0, 0.0]]);
    assert_eq!(with(true), [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, -1.0, 0.0]]);
}

#[test]
fn what_would_be_another_shape_is_refused() {
    let triangle = String::from_utf8_lossy(&scene(NODE, &[PLAIN], TRIANGLE)[20..]).into_owned();
    let json = &triangle[..triangle.rfind('}').unwrap() + 1];
    let refused = [
        ("\"asset\"", r#""extensionsRequired":["KHR_draco_mesh_compression"],"asset""#),
        ("\"asset\"", r#""extensionsRequired":["KHR_materials_unlit","EXT_meshopt_compression"],"asset""#),
        ("\"mesh\":0", r#""mesh":0,"skin":0"#),
        ("\"mesh\":0", r#""mesh":0,"weights":[0,0.5]"#),
        ("\"primitives\"", r#""weights":[1],"primitives""#),
        ("{\"byteLength\":52}", r#"{"byteLength":52,"uri":"cube.bin"}"#),
        ("[{\"buffer\":0,\"byteLength\":48}", r#"[{"buffer":1,"byteLength":48}"#),
    ];
    for (part, change) in refused {
        let changed = json.replacen(part, change, 1);
        assert_ne!(changed, json, "{part}");
        assert_eq!(fails(&glb(&changed, &floats(&CORNERS))), Reason::UnknownFormat, "{change}");
    }
    let harmless = json.replacen("\"asset\"", r#""extensionsRequired":["KHR_materials_unlit"],"asset""#, 1);
    assert_eq!(read(&glb(&harmless, &[floats(&CORNERS), vec![0; 4]].concat())).triangle_count(), 1);
}

#[test]
fn broken_descriptions_are_errors() {
    let of = |accessor: &str| scene(NODE, &[PLAIN], accessor);
    for (part, change) in [
        ("\"count\":3", "\"count\":5"),
        ("\"count\":3", "\"count\":18446744073709551615"),
        ("\"count\":3", "\"count\":-1"),
        ("\"count\":3", "\"count\":4"),
        ("\"count\":3", "\"count\":0"),
        ("5126", "5125"),
        ("5126", "5120.5"),
        ("VEC3", "VEC2"),
        ("\"bufferView\":0", "\"bufferView\":9"),
        ("\"bufferView\":0,", ""),
        ("\"count\":3", "\"count\":3,\"byteOffset\":18446744073709551615"),
    ] {
        let changed = TRIANGLE.replacen(part, change, 1);
        assert_eq!(fails(&of(&changed)), Reason::Malformed, "{changed}");
    }
    for nodes in [r#"{"mesh":1}"#, r#"{"children":[1]}"#, r#"{"mesh":0,"children":[0]}"#, "{}", ""] {
        assert_eq!(fails(&scene(nodes, &[PLAIN], TRIANGLE)), Reason::Malformed, "{nodes}");
    }
    for primitive in ["{}", r#"{"attributes":{}}"#, r#"{"attributes":{"POSITION":1}}"#] {
        assert_eq!(fails(&scene(NODE, &[primitive], TRIANGLE)), Reason::Malformed, "{primitive}");
    }
    let primitive = r#"{"attributes":{"POSITION":0},"indices":1}"#;
    let indices = r#"{"bufferView":1,"byteOffset":1,"componentType":5121,"count":3,"type":"SCALAR"}"#;
    let error = Mesh::read_bytes(&scene(NODE, &[primitive], &[TRIANGLE, indices].join(",")), MeshFormat::Glb);
    let error = error.unwrap_err();
    assert_eq!((error.reason(), error.element()), (Reason::IndexOutOfRange, Some(Element::Face(0))));
}

#[test]
fn a_file_cut_anywhere_is_an_error() {
    let file = scene(NODE, &[PLAIN], TRIANGLE);
    for length in 0..file.len() {
        assert_eq!(fails(&file[..length]), Reason::Truncated, "{length}");
    }
    assert_eq!(fails(b"glTF\x01\0\0\0\0\0\0\0"), Reason::UnknownFormat);
    assert_eq!(fails(b"solid"), Reason::Malformed);
}

#[test]
fn a_scene_out_of_proportion_to_its_file_is_refused() {
    let nodes = vec![NODE; 2000].join(",");
    assert_eq!(read(&scene(&nodes, &[PLAIN], TRIANGLE)).triangle_count(), 2000);
    let many = vec![PLAIN; 2000].join(",");
    assert_eq!(fails(&scene(&nodes, &[&many], TRIANGLE)), Reason::Malformed);
    let zeros = format!(r#"{{"primitives":[],"weights":[{}]}}"#, vec!["0"; 100_000].join(","));
    let json = format!(r#"{{"nodes":[{}],"meshes":[{zeros}]}}"#, vec![NODE; 100_000].join(","));
    let message = Mesh::read_bytes(&glb(&json, &[]), MeshFormat::Glb).unwrap_err().to_string();
    assert!(message.contains("for each byte of the file"), "{message}: 10^10 weights are not looked at");
    // A diamond of nodes, each twice the child of the one before, would be 2^60 meshes.
    let diamond: Vec<String> = (1..60).map(|i| format!("{{\"children\":[{i},{i}]}}")).chain([NODE.into()]).collect();
    assert_eq!(fails(&scene(&diamond.join(","), &[PLAIN], TRIANGLE)), Reason::Malformed);
    let chain: Vec<String> = (1..100_000).map(|i| format!("{{\"children\":[{i}]}}")).chain([NODE.into()]).collect();
    assert_eq!(read(&scene(&chain.join(","), &[PLAIN], TRIANGLE)).triangle_count(), 1, "no depth is too deep");
}
