//! Any soup of triangles through both methods: the right distances, or an error that names the element.

use taut::{
    Control, Element, ExactOptions, ExactSolver, HeatOptions, HeatSolver, Laplacian, Mesh, MeshReport, Properties,
    Reason, Source,
};

const INF: f64 = f64::INFINITY;

fn exact(mesh: &Mesh, source: u32) -> taut::Result<Vec<f64>> {
    let solver = ExactSolver::new(mesh)?;
    Ok(solver.field(&[Source::vertex(source)], &ExactOptions::default(), &Control::new())?.distances().to_vec())
}

fn heat(mesh: &Mesh, source: u32, laplacian: Laplacian) -> taut::Result<Vec<f64>> {
    let options = HeatOptions { laplacian, ..HeatOptions::default() };
    let solver = HeatSolver::new(mesh, &options, &Control::new())?;
    Ok(solver.field(&[Source::vertex(source)], &Control::new())?.into_distances())
}

fn mesh(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Mesh {
    Mesh::from_triangles(positions, triangles).unwrap()
}

const SQUARE: [[f64; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];

/// Exact to rounding; heat reaches the same vertices and is not more than `share` of the largest distance off.
#[track_caller]
fn assert_distances(mesh: &Mesh, source: u32, expected: &[f64], share: f64) {
    let largest = expected.iter().copied().filter(|d| d.is_finite()).fold(0.0, f64::max);
    let close = |found: &[f64], share: f64| {
        assert_eq!(found.len(), expected.len());
        for (v, (&d, &right)) in found.iter().zip(expected).enumerate() {
            let is_close = if right.is_finite() { (d - right).abs() <= share * largest } else { d == right };
            assert!(is_close, "vertex {v}: {d} should be {right}");
        }
    };
    close(&exact(mesh, source).unwrap(), 1e-12);
    for laplacian in [Laplacian::Intrinsic, Laplacian::Plain] {
        close(&heat(mesh, source, laplacian).unwrap(), share);
    }
    // The report and the properties look at anything, too.
    let _ = (MeshReport::new(mesh), Properties::of(mesh));
}

#[test]
fn nothing_one_point_and_points_without_faces() {
    for positions in [&[][..], &[[f64::NAN; 3]]] {
        let mesh = mesh(positions, &[]);
        assert_eq!(Properties::of(&mesh), None);
        assert_eq!(MeshReport::new(&mesh).unreferenced_vertices.len(), positions.len());
        let no_edges = heat(&mesh, 0, Laplacian::Intrinsic).unwrap_err();
        assert_eq!(no_edges.reason(), Reason::BadTimeStep);
        assert!(no_edges.message().contains("the mesh has none"), "{no_edges}");
    }
    let outside = exact(&mesh(&[], &[]), 0).unwrap_err();
    assert_eq!((outside.reason(), outside.element()), (Reason::VertexOutOfRange, Some(Element::Source(0))));
    assert_eq!(exact(&mesh(&[[1.0; 3]], &[]), 0).unwrap(), [0.0]);
    assert_eq!(exact(&mesh(&[[1.0; 3]; 3], &[]), 1).unwrap(), [INF, 0.0, INF]);
}

#[test]
fn all_points_in_one_place() {
    let point = mesh(&[[5.0; 3]; 3], &[[0, 1, 2]]);
    assert_eq!(exact(&point, 0).unwrap(), [0.0; 3]);
    let error = heat(&point, 0, Laplacian::Intrinsic).unwrap_err();
    assert!(error.message().contains("needs edges of some length"), "{error}");
    assert_eq!(MeshReport::new(&point).zero_area_faces, [0]);
}

#[test]
fn a_line() {
    let line = mesh(&[[0.0; 3], [1.0, 0.0, 0.0], [3.0, 0.0, 0.0]], &[[0, 1, 2]]);
    // With plain cotangents rounding is 1e-16 of the length, and the height that mollifying gives the triangle 1e-5 of it.
    assert_distances(&line, 0, &[0.0, 1.0, 3.0], 1e-5);
    let both_ways = mesh(&[[0.0; 3], [1.0, 0.0, 0.0], [3.0, 0.0, 0.0]], &[[0, 1, 2], [2, 1, 0]]);
    assert_distances(&both_ways, 0, &[0.0, 1.0, 3.0], 1e-5);
    // A triangle that repeats a vertex is no way at all.
    let repeated = mesh(&[[0.0; 3], [1.0, 0.0, 0.0]], &[[0, 1, 1]]);
    assert_eq!(exact(&repeated, 0).unwrap(), [0.0, INF]);
}

#[test]
fn a_folded_pair_and_copies_of_a_face() {
    let expected = [0.0, 1.0, 2f64.sqrt(), INF];
    for faces in [&[[0, 1, 2]][..], &[[0, 1, 2], [2, 1, 0]], &[[0, 1, 2]; 3], &[[0, 1, 2], [1, 2, 0], [1, 0, 2]]] {
        assert_distances(&mesh(&SQUARE, faces), 0, &expected, 0.3);
    }
    // Two triangles on the same edge, folded onto the same side.
    let folded = mesh(&[[0.0; 3], [2.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 1.0, 0.0]], &[[0, 1, 2], [1, 0, 3]]);
    assert_distances(&folded, 2, &[2f64.sqrt(), 2f64.sqrt(), 0.0, 2.0], 0.4);
}

#[test]
fn faces_that_share_a_vertex_index_are_connected_and_those_that_share_a_place_are_not() {
    let positions = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0; 3]];
    let touching = mesh(&positions, &[[0, 1, 2], [0, 3, 4]]);
    assert_distances(&touching, 1, &[1.0, 0.0, 2f64.sqrt(), 2.0, 2.0, INF], 0.4);
    let apart = mesh(&positions, &[[0, 1, 2], [5, 3, 4]]);
    assert_distances(&apart, 1, &[1.0, 0.0, 2f64.sqrt(), INF, INF, INF], 0.4);
    assert_eq!(MeshReport::new(&touching).nonmanifold_vertices, [0]);
    assert_eq!(MeshReport::new(&apart).duplicate_vertices, [[5, 0]]);
}

#[test]
fn coordinates_that_are_no_numbers_are_named_where_a_face_uses_them() {
    for bad in [f64::NAN, INF, -INF] {
        let mut positions = SQUARE;
        positions[2][1] = bad;
        let error = Mesh::from_triangles(&positions, &[[0, 1, 3], [1, 2, 3]]).unwrap_err();
        assert_eq!((error.reason(), error.element()), (Reason::NonFiniteCoordinate, Some(Element::Vertex(2))));
        assert_distances(&mesh(&positions, &[[0, 1, 3]]), 0, &[0.0, 1.0, INF, 1.0], 0.3);
    }
}

/// Scaling by a power of two changes no bit but the exponent, even where squares of lengths are no numbers.
#[test]
fn the_largest_and_the_smallest_coordinates() {
    let faces = [[0, 1, 2], [0, 2, 3]];
    let ordinary = mesh(&SQUARE, &faces);
    for exponent in [-1000, -500, 500, 1000, 1023] {
        let size = 2f64.powi(exponent);
        let scaled = mesh(&SQUARE.map(|p| p.map(|x| x * size)), &faces);
        let times = |distances: Vec<f64>| distances.into_iter().map(|d| d * size).collect::<Vec<f64>>();
        assert_eq!(exact(&scaled, 0).unwrap(), times(exact(&ordinary, 0).unwrap()), "2^{exponent}");
        for laplacian in [Laplacian::Intrinsic, Laplacian::Plain] {
            let expected = times(heat(&ordinary, 0, laplacian).unwrap());
            assert_eq!(heat(&scaled, 0, laplacian).unwrap(), expected, "2^{exponent}");
        }
    }
    for size in [1e-300, 1e308] {
        let scaled = mesh(&SQUARE.map(|p| p.map(|x| x * size)), &faces);
        assert_distances(&scaled, 0, &[0.0, size, size * 2f64.sqrt(), size], 0.3);
    }
    // From one end of the numbers to the other, and a triangle of that size beside a small one.
    let huge = [[-1.7e308, 0.0, 0.0], [1.7e308, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 2.0, 0.0]];
    let far = mesh(&huge, &[[0, 1, 2], [2, 1, 3]]);
    assert_eq!(exact(&far, 0).unwrap()[1], INF, "3.4e308 rounds to +inf");
    assert!(heat(&far, 2, Laplacian::Intrinsic).unwrap().iter().all(|d| *d >= 0.0));
}
