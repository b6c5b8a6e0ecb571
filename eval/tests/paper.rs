//! Which meshes of the corpus are the paper's own.

mod common;

use common::corpus;
use std::collections::BTreeMap;
use std::fs;
use taut_eval::paper::{is_basic, is_own_tessellation, midpoint_split, table5};
use taut_eval::{Model, ModelProperties};

/// Each mesh of the corpus that Table 5 names: its number there, and whether it is the paper's own tessellation.
#[test]
fn four_models_are_the_papers_own_tessellations() {
    let Some(folder) = corpus() else { return };
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().split('.').next().unwrap();
        let Some(row) = table5(name) else { continue };
        let model = Model::read(&path, None).unwrap();
        assert!(!is_basic(&model.mesh));
        found.insert(name.to_owned(), (row.number, is_own_tessellation(row, &ModelProperties::of(&model).unwrap())));
        if name == "fertility_base" {
            let split = Model::new(name.to_owned(), midpoint_split(&model.mesh).unwrap(), None).unwrap();
            assert!(is_own_tessellation(row, &ModelProperties::of(&split).unwrap()));
        }
    }
    let expected = [
        ("armadillo_uniform", 1, false),
        ("bimba", 3, false),
        ("cow_nm_vertex", 7, false),
        ("fandisk", 11, false),
        ("fertility_base", 13, false),
        ("gargoyle", 15, false),
        ("genus3", 16, false),
        ("lion_100k", 20, false),
        ("lucy", 21, false),
        ("max_planck", 22, false),
        ("paper_camel", 5, true),
        ("paper_fandisk2", 12, true),
        ("paper_homer", 17, true),
        ("rocker_arm", 26, false),
        ("suzanne", 27, false),
        ("teapot", 28, false),
    ];
    assert_eq!(found, expected.map(|(name, number, own)| (name.to_owned(), (number, own))).into());
}

#[test]
fn the_first_basic_mesh_is_known_in_any_unit_and_not_when_it_is_bent() {
    let Some(folder) = corpus() else { return };
    let mesh = Model::read(&folder.join("paper_bunny_1.obj"), None).unwrap().mesh;
    assert_eq!(Model::default_source(&mesh), Some(7649));
    let moved = |f: fn([f64; 3]) -> [f64; 3]| {
        let positions: Vec<[f64; 3]> = mesh.positions().iter().copied().map(f).collect();
        is_basic(&mesh.with_positions(&positions).unwrap())
    };
    assert!(moved(|[x, y, z]| [1e6 * x + 3.0, 1e6 * y, 1e6 * z]));
    assert!(!moved(|[x, y, z]| [1.01 * x, y, z]));
}
