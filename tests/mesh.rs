//! Buffers of any stride and type, and what a mesh accepts.

use taut::{Element, Faces, IndexType, Mesh, Reason, Rows, ScalarType, Status};

const SQUARE: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];

/// Rows as bytes, each `stride` bytes from the last, `lead` bytes into the buffer; the bytes between are noise.
fn packed<const N: usize>(rows: &[Vec<[u8; N]>], stride: usize, lead: usize) -> Vec<u8> {
    let mut bytes = vec![0xEE; lead + rows.len() * stride];
    for (i, row) in rows.iter().enumerate() {
        for (k, element) in row.iter().enumerate() {
            bytes[lead + i * stride + k * N..][..N].copy_from_slice(element);
        }
    }
    bytes
}

fn positions(bytes: &[u8], stride: usize, kind: ScalarType) -> Rows<'_, ScalarType> {
    Rows::new(bytes, SQUARE.len(), 3, stride, kind).unwrap()
}

fn doubles() -> Vec<u8> {
    packed(&SQUARE.map(|p| p.map(f64::to_ne_bytes).to_vec()), 24, 0)
}

#[test]
fn positions_of_any_type_stride_and_alignment() {
    let corners = packed(&[vec![0u32.to_ne_bytes(), 1u32.to_ne_bytes(), 2u32.to_ne_bytes()]], 12, 0);
    for (stride, lead) in [(24, 0), (24, 3), (40, 0), (31, 5)] {
        let wide = packed(&SQUARE.map(|p| p.map(f64::to_ne_bytes).to_vec()), stride, lead);
        let narrow = packed(&SQUARE.map(|p| p.map(|x| (x as f32).to_ne_bytes()).to_vec()), stride, lead);
        for (bytes, kind) in [(wide, ScalarType::F64), (narrow, ScalarType::F32)] {
            let faces = Faces::Triangles(Rows::new(&corners, 1, 3, 0, IndexType::U32).unwrap());
            let mesh = Mesh::from_buffers(positions(&bytes[lead..], stride, kind), faces).unwrap();
            assert_eq!(mesh.positions(), SQUARE);
        }
    }
}

#[test]
fn indices_of_any_type() {
    fn mesh<const N: usize>(kind: IndexType, index: impl Fn(i64) -> [u8; N]) -> taut::Result<Vec<[u32; 3]>> {
        let rows = [[0, 1, 2], [0, 2, 3]].map(|t: [i64; 3]| t.map(&index).to_vec());
        let (bytes, doubles) = (packed(&rows, 3 * N + 1, 0), doubles());
        let faces = Faces::Triangles(Rows::new(&bytes, 2, 3, 3 * N + 1, kind)?);
        Ok(Mesh::from_buffers(positions(&doubles, 24, ScalarType::F64), faces)?.triangles().to_vec())
    }
    let expected = Ok(vec![[0, 1, 2], [0, 2, 3]]);
    assert_eq!(mesh(IndexType::U16, |i| (i as u16).to_ne_bytes()), expected);
    assert_eq!(mesh(IndexType::U32, |i| (i as u32).to_ne_bytes()), expected);
    assert_eq!(mesh(IndexType::U64, |i| (i as u64).to_ne_bytes()), expected);
    assert_eq!(mesh(IndexType::I32, |i| (i as i32).to_ne_bytes()), expected);
    assert_eq!(mesh(IndexType::I64, i64::to_ne_bytes), expected);
    for wrong in [-1, 1 << 32, i64::MIN] {
        let bad = |i: i64| if i == 3 { wrong } else { i };
        let error = mesh(IndexType::I64, |i| bad(i).to_ne_bytes()).unwrap_err();
        assert_eq!((error.reason(), error.element()), (Reason::IndexOutOfRange, Some(Element::Face(1))), "{wrong}");
    }
}

#[test]
fn polygons_become_fans() {
    let mesh = Mesh::from_polygons(&SQUARE, &[0, 4, 7], &[0, 1, 2, 3, 3, 2, 0]).unwrap();
    assert_eq!(mesh.triangles(), [[0, 1, 2], [0, 2, 3], [3, 2, 0]]);
    let fails = |offsets: &[u32], corners: &[u32]| {
        let error = Mesh::from_polygons(&SQUARE, offsets, corners).unwrap_err();
        (error.reason(), error.element())
    };
    assert_eq!(fails(&[0, 3, 5], &[0, 1, 2, 2, 3]), (Reason::FaceTooSmall, Some(Element::Face(1))));
    assert_eq!(fails(&[0, 3, 2, 5], &[0, 1, 2, 2, 3]), (Reason::BadOffsets, Some(Element::Face(1))));
    for offsets in [&[1, 3][..], &[0, 4], &[]] {
        assert_eq!(fails(offsets, &[0, 1, 2]).0, Reason::BadOffsets, "{offsets:?}");
    }
    assert_eq!(Mesh::from_polygons(&SQUARE, &[], &[]).unwrap().triangle_count(), 0);
}

#[test]
fn a_repeated_index_is_reported_and_keeps_its_number() {
    let mesh = Mesh::from_triangles(&SQUARE, &[[0, 1, 2], [1, 1, 2], [0, 2, 3], [3, 0, 3]]).unwrap();
    assert_eq!(mesh.triangle_count(), 4);
    assert_eq!(mesh.ignored_triangles(), [1, 3]);
}

#[test]
fn only_a_referenced_vertex_needs_finite_coordinates() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut points = SQUARE;
        points[3][1] = bad;
        assert!(Mesh::from_triangles(&points, &[[0, 1, 2], [3, 3, 0]]).is_ok(), "an ignored triangle uses nothing");
        let error = Mesh::from_triangles(&points, &[[0, 1, 2], [0, 2, 3]]).unwrap_err();
        assert_eq!((error.reason(), error.element()), (Reason::NonFiniteCoordinate, Some(Element::Vertex(3))));
    }
}

#[test]
fn an_index_out_of_range_names_the_face() {
    let error = Mesh::from_triangles(&SQUARE, &[[0, 1, 2], [0, 4, 3]]).unwrap_err();
    assert_eq!((error.reason(), error.element()), (Reason::IndexOutOfRange, Some(Element::Face(1))));
    assert_eq!(error.status(), Status::InvalidMesh);
    assert!(Mesh::from_triangles(&[], &[]).is_ok());
}

#[test]
fn sizes_that_overflow_or_do_not_fit_are_refused() {
    let reason = |count, stride| Rows::new(&[0; 64], count, 3, stride, ScalarType::F64).unwrap_err().reason();
    assert_eq!(reason(usize::MAX, 24), Reason::TooManyElements);
    assert_eq!(reason(3, usize::MAX / 2), Reason::TooManyElements);
    assert_eq!(reason(3, 24), Reason::BufferTooSmall);
    assert!(Rows::new(&[0; 64], 2, 3, 40, ScalarType::F64).is_ok(), "the last row needs no padding behind it");
}
