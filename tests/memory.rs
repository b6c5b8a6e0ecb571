//! Memory: reading takes it in proportion to the file, whatever its counts promise; the exact method within its limit.
//!
//! One test, because the allocator counts what all threads of the process ask for.

#![allow(unsafe_code, reason = "an allocator that counts is unsafe by its trait")]

#[path = "common/glb.rs"]
mod common;

use common::{floats, glb};
use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use taut::{Control, ExactOptions, ExactSolver, Mesh, MeshFormat, Source, shapes};

static USED: AtomicUsize = AtomicUsize::new(0);
static PEAK: AtomicUsize = AtomicUsize::new(0);

struct Counting;

// SAFETY: every call goes to the system's allocator as it came.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let used = USED.fetch_add(layout.size(), Relaxed) + layout.size();
        PEAK.fetch_max(used, Relaxed);
        // SAFETY: the caller keeps the contract, which is the same.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        USED.fetch_sub(layout.size(), Relaxed);
        // SAFETY: as above.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

/// The most bytes in use at once during the work, beyond those before it, and its result.
fn peak<T>(work: impl FnOnce() -> T) -> (usize, T) {
    let before = USED.load(Relaxed);
    PEAK.store(before, Relaxed);
    let result = work();
    (PEAK.load(Relaxed) - before, result)
}

/// The peak while the file is read, and whether it is a mesh.
fn peak_of(file: &[u8], format: MeshFormat) -> (usize, bool) {
    peak(|| Mesh::read_bytes(file, format).is_ok())
}

/// Small files whose counts promise this many vertices or faces.
fn promises(count: u64) -> Vec<(MeshFormat, Vec<u8>)> {
    let ply = |encoding: &str, element: &str, property: &str| {
        format!("ply\nformat {encoding} 1.0\nelement {element} {count}\n{property}\nend_header\n1 2 3 4 5 6 7 8 9\n")
    };
    let encodings = ["ascii", "binary_little_endian", "binary_big_endian"];
    let vertices = encodings.map(|e| ply(e, "vertex", "property float x\nproperty float y\nproperty float z"));
    let faces = encodings.map(|e| ply(e, "face", "property list uint int vertex_indices"));
    let accessor = |accessor: &str| {
        let json = format!(
            r#"{{"nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],
            "buffers":[{{}}],"bufferViews":[{{"buffer":0,"byteLength":{count}}},{{"buffer":0,"byteLength":36}}],
            "accessors":[{accessor},{{"bufferView":1,"componentType":5125,"count":{count},"type":"SCALAR"}}]}}"#
        );
        glb(&json, &floats(&[0.0; 9]))
    };
    let sparse = format!(
        r#"{{"componentType":5126,"count":{count},"type":"VEC3","sparse":{{"count":1,
        "indices":{{"bufferView":1,"componentType":5125}},"values":{{"bufferView":1}}}}}}"#
    );
    let plain = |view: u32| format!(r#"{{"bufferView":{view},"componentType":5126,"count":{count},"type":"VEC3"}}"#);
    let triangles = u32::try_from(count).unwrap_or(u32::MAX).to_le_bytes();
    let stl = [&[b' '; 80][..], &triangles, &[0; 100]].concat();
    let off = format!("OFF\n{count} {count} 0\n0 0 0\n");
    let list = format!("OFF\n1 1 0\n0 0 0\n{count} 0 0 0\n");
    let texts = [off, list].map(|text| (MeshFormat::Off, text.into_bytes()));
    let glbs = [sparse, plain(0), plain(1)].map(|json| (MeshFormat::Glb, accessor(&json)));
    let plys = [vertices, faces].concat().into_iter().map(|text| (MeshFormat::Ply, text.into_bytes()));
    texts.into_iter().chain(glbs).chain(plys).chain([(MeshFormat::Stl, stl)]).collect()
}

/// Whole files of about n² faces; the corners of the STL file are hardly ever at one place.
fn grids(n: u32) -> Vec<(MeshFormat, Vec<u8>)> {
    let corners = |i: u32| [[0, i, 0], [1, i, 0], [0, i, 1]].map(|corner: [u32; 3]| corner.map(|x| x as f32));
    let triangle = |i: u32| [vec![0; 12], floats(corners(i).as_flattened()), vec![0; 2]].concat();
    let stl = [vec![b' '; 80], (n * n).to_le_bytes().to_vec(), (0..n * n).flat_map(triangle).collect()].concat();
    let mut obj: String = (0..n * n).map(|i| format!("v {} {} 0\n", i % n, i / n)).collect();
    obj.extend((n..n * n).map(|i| format!("f {i} {} {}\n", i + 1, i + 1 - n)));
    vec![(MeshFormat::Stl, stl), (MeshFormat::Obj, obj.into_bytes())]
}

fn memory_is_in_proportion_to_the_file() {
    for count in [4_000_000_000, u64::from(u32::MAX), 1 << 62] {
        for (format, file) in promises(count) {
            let (bytes, is_mesh) = peak_of(&file, format);
            assert!(!is_mesh && bytes < 20 * file.len() + 10_000, "{format:?}: {bytes} of {}", file.len());
        }
    }
    let nodes = vec!["{}"; 100_000].join(",");
    let (bytes, _) = peak_of(&glb(&format!(r#"{{"nodes":[{nodes}]}}"#), &[]), MeshFormat::Glb);
    assert!(bytes < 100 * nodes.len(), "nodes of glTF: {bytes} of {}", nodes.len());
    for (format, file) in grids(200) {
        let (bytes, is_mesh) = peak_of(&file, format);
        assert!(is_mesh && bytes < 20 * file.len(), "{format:?}: {bytes} of {}", file.len());
    }
}

fn memory_stays_within_its_limit() {
    let solver = ExactSolver::new(&shapes::terrain(200, 0.3).mesh().unwrap()).unwrap();
    let field = |limit: usize, allow_partial: bool| {
        let control = Control::new();
        control.set_memory_limit(limit);
        let options = ExactOptions { allow_partial, ..ExactOptions::default() };
        peak(|| solver.field(&[Source::vertex(0)], &options, &control).is_ok())
    };
    let (whole, _) = field(usize::MAX, false);
    assert!(field(whole, false).1, "what is in use is counted once");
    assert!(!field(whole / 10 * 9, false).1, "what is in use is counted");
    for share in [6, 7, 8, 9] {
        let limit = whole / 10 * share;
        let (bytes, _) = field(limit, true);
        // A few thousand windows come between two looks at the limit.
        assert!(bytes < limit + 400_000, "{bytes} bytes at a limit of {limit}, {whole} without one");
    }
}

#[test]
fn memory_is_bounded() {
    memory_is_in_proportion_to_the_file();
    memory_stays_within_its_limit();
}
