//! Binary glTF 2.0: a scene of nodes that place triangle meshes, described in JSON, and one chunk of numbers.
//!
//! The mesh is the whole scene: every triangle of every node, each moved by its node's transform and those above it, in
//! the order of the nodes (depth first), their primitives and their faces; triangle strips and fans become triangles, and
//! a transform that mirrors turns its triangles round. The scene is the default one, or all nodes without a parent where
//! the file names none. Vertices of equal position are one vertex ([`Welder`]), because glTF repeats a vertex along each
//! seam of normals, texture or material; they are numbered by the primitives' own order, so that a mesh without seams
//! keeps its numbers, vertices that no face uses included.
//!
//! Numbers may be 32-bit floats or, by KHR_mesh_quantization, integers; accessors may be sparse. Refused are skins and
//! weighted morph targets (the file would not show the shape that it means), buffers outside of the file, and files that
//! require an extension that may change the shape, Draco and meshopt compression among them. An extension that a file
//! uses without requiring it may be ignored, says the standard.
//!
//! Cost: linear in the size of the scene. Nodes may show one mesh many times; a scene that grows out of proportion to
//! its file is refused, and so are nodes that are reached twice.
//!
//! Why not a crate: of gltf 1.4.1, the one that is kept up, the validation itself indexes out of bounds where a POSITION
//! accessor does not exist; without it, reading does (an index), subtracts 1 from a count of 0, and adds offsets that
//! overflow; sparse indices that do not ascend are dropped in silence, and a sparse accessor of 4 thousand million
//! zeros is believed. It also refuses files for textures that nobody asked for. serde_json alone reads the same files.
//!
//! References: Khronos Group, "glTF 2.0 Specification" (2021); ISO/IEC 12113:2022.

use super::Polygons;
use super::weld::Welder;
use crate::error::{Error, Reason, Result};
use nalgebra::{Matrix3, Matrix4, Quaternion, Translation3, UnitQuaternion, Vector3};
use serde::Deserialize;

/// How many vertices, corners, primitives and weights a scene may show for each byte of its file. Every byte of an ordinary file
/// describes less than one; more than this many must be repetition.
const MOST_REPETITION: u64 = 16;

pub(super) fn polygons(bytes: &[u8]) -> Result<Polygons> {
    let Chunks { json, numbers } = Chunks::new(bytes)?;
    let document: Document = serde_json::from_slice(json).map_err(|error| malformed(format!("JSON: {error}")))?;
    if let Some(name) = document.extensions_required.iter().find(|name| may_change_shape(name)) {
        return Err(refused(format!("the file requires the extension {name}, which is not read")));
    }
    let mut scene = Scene {
        document: &document,
        numbers,
        left: MOST_REPETITION * bytes.len() as u64,
        welder: Welder::default(),
        polygons: Polygons::default(),
    };
    scene.add_nodes()?;
    let Scene { welder, mut polygons, .. } = scene;
    if polygons.ends.is_empty() {
        return Err(malformed("the scene shows no triangles"));
    }
    polygons.positions = welder.into_positions();
    Ok(polygons)
}

/// Whether a file that requires this extension may have another shape than it seems to have without.
fn may_change_shape(extension: &str) -> bool {
    let harmless = ["KHR_materials_", "KHR_texture_", "EXT_texture_", "MSFT_texture_", "KHR_lights_", "EXT_lights_"];
    extension != "KHR_mesh_quantization" && !harmless.iter().any(|prefix| extension.starts_with(prefix))
}

/// The parts of the file.
struct Chunks<'a> {
    json: &'a [u8],
    numbers: &'a [u8],
}

impl<'a> Chunks<'a> {
    fn new(bytes: &'a [u8]) -> Result<Chunks<'a>> {
        let truncated = || Error::new(Reason::Truncated, "the file ends before the length in its head");
        let (magic, rest) = bytes.split_first_chunk().ok_or_else(truncated)?;
        if magic != b"glTF" {
            return Err(malformed("a binary glTF file begins with glTF"));
        }
        let (version, rest) = take_u32(rest).ok_or_else(truncated)?;
        if version != 2 {
            return Err(refused(format!("glTF of version {version} is not read")));
        }
        let (length, _) = take_u32(rest).ok_or_else(truncated)?;
        let mut rest = bytes.get(..length as usize).ok_or_else(truncated)?.get(12..).unwrap_or_default();
        let mut chunks = Vec::new();
        while !rest.is_empty() {
            let (length, kind, body) = take_u32(rest)
                .and_then(|(length, rest)| rest.split_first_chunk::<4>().map(|(kind, body)| (length, kind, body)))
                .ok_or_else(|| malformed("a chunk has no head"))?;
            let chunk = body.get(..length as usize).ok_or_else(|| malformed("a chunk is longer than the file"))?;
            chunks.push((kind, chunk));
            rest = &body[chunk.len()..];
        }
        match chunks[..] {
            [(b"JSON", json), (b"BIN\0", numbers), ..] => Ok(Chunks { json, numbers }),
            [(b"JSON", json), ..] => Ok(Chunks { json, numbers: &[] }),
            _ => Err(malformed("the first chunk must be JSON")),
        }
    }
}

fn take_u32(bytes: &[u8]) -> Option<(u32, &[u8])> {
    bytes.split_first_chunk().map(|(&number, rest)| (u32::from_le_bytes(number), rest))
}

/// What of the JSON matters here; every index counts from 0.
#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
struct Document {
    extensions_required: Vec<String>,
    scene: Option<u32>,
    scenes: Vec<SceneDef>,
    nodes: Vec<Node>,
    meshes: Vec<MeshDef>,
    accessors: Vec<Accessor>,
    buffer_views: Vec<BufferView>,
    buffers: Vec<Buffer>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct SceneDef {
    nodes: Vec<u32>,
}

/// Three bytes of JSON make a node: the transforms, which most nodes lack, are boxed to keep it small.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct Node {
    children: Vec<u32>,
    mesh: Option<u32>,
    skin: Option<u32>,
    weights: Vec<f64>,
    /// Column by column; else the transform is the next three.
    matrix: Option<Box<[f64; 16]>>,
    translation: Option<Box<[f64; 3]>>,
    /// x, y, z, w.
    rotation: Option<Box<[f64; 4]>>,
    scale: Option<Box<[f64; 3]>>,
}

#[derive(Debug, Deserialize)]
struct MeshDef {
    primitives: Vec<Primitive>,
    #[serde(default)]
    weights: Vec<f64>,
}

#[derive(Debug, Deserialize)]
struct Primitive {
    attributes: Attributes,
    indices: Option<u32>,
    mode: Option<u32>,
}

#[derive(Debug, Deserialize)]
struct Attributes {
    #[serde(rename = "POSITION")]
    position: Option<u32>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
struct Accessor {
    buffer_view: Option<u32>,
    #[serde(default)]
    byte_offset: u64,
    component_type: u32,
    #[serde(default)]
    normalized: bool,
    count: u64,
    #[serde(rename = "type")]
    shape: String,
    sparse: Option<Sparse>,
}

#[derive(Debug, Deserialize)]
struct Sparse {
    count: u64,
    indices: SparseIndices,
    values: SparseValues,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
struct SparseIndices {
    buffer_view: u32,
    #[serde(default)]
    byte_offset: u64,
    component_type: u32,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
struct SparseValues {
    buffer_view: u32,
    #[serde(default)]
    byte_offset: u64,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
struct BufferView {
    buffer: u32,
    #[serde(default)]
    byte_offset: u64,
    byte_length: u64,
    byte_stride: Option<u64>,
}

#[derive(Debug, Deserialize)]
struct Buffer {
    uri: Option<serde::de::IgnoredAny>,
}

impl Node {
    fn transform(&self) -> Matrix4<f64> {
        if let Some(matrix) = &self.matrix {
            return Matrix4::from_column_slice(&**matrix);
        }
        let [x, y, z, w] = self.rotation.as_deref().copied().unwrap_or([0.0, 0.0, 0.0, 1.0]);
        let translation = self.translation.as_deref().copied().unwrap_or_default();
        let scale = self.scale.as_deref().copied().unwrap_or([1.0; 3]);
        Translation3::from(translation).to_homogeneous()
            * UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z)).to_homogeneous()
            * Matrix4::new_nonuniform_scaling(&Vector3::from(scale))
    }
}

impl Document {
    /// The nodes that the scene begins with.
    fn roots(&self) -> Result<Vec<u32>> {
        if let Some(scene) = self.scene {
            return Ok(named(&self.scenes, "scene", scene)?.nodes.clone());
        }
        let mut is_child = vec![false; self.nodes.len()];
        for &child in self.nodes.iter().flat_map(|node| &node.children) {
            *is_child.get_mut(child as usize).ok_or_else(|| missing("node", child))? = true;
        }
        Ok((0..).zip(is_child).filter(|(_, is_child)| !is_child).map(|(node, _)| node).collect())
    }
}

/// What the walk over the nodes has found so far.
struct Scene<'a> {
    document: &'a Document,
    numbers: &'a [u8],
    /// How many more vertices, corners, primitives and weights the scene may show.
    left: u64,
    welder: Welder,
    polygons: Polygons,
}

impl<'a> Scene<'a> {
    fn add_nodes(&mut self) -> Result<()> {
        let document = self.document;
        let mut is_reached = vec![false; document.nodes.len()];
        let roots = document.roots()?;
        // The nodes that wait on each level and the transform above them: no depth exhausts the program's own stack.
        let mut levels = vec![(roots.iter(), Matrix4::identity())];
        while let Some((waiting, above)) = levels.last_mut() {
            let Some(&index) = waiting.next() else {
                levels.pop();
                continue;
            };
            let node = named(&document.nodes, "node", index)?;
            if std::mem::replace(&mut is_reached[index as usize], true) {
                return Err(malformed(format!("node {index} is reached twice; the nodes of a scene are a tree")));
            }
            let transform = *above * node.transform();
            if let Some(mesh) = node.mesh {
                self.add_mesh(index, node, mesh, &transform)?;
            }
            levels.push((node.children.iter(), transform));
        }
        Ok(())
    }

    fn add_mesh(&mut self, index: u32, node: &Node, mesh: u32, transform: &Matrix4<f64>) -> Result<()> {
        let mesh = named(&self.document.meshes, "mesh", mesh)?;
        self.take((mesh.primitives.len() + mesh.weights.len()) as u64)?;
        if node.skin.is_some() {
            return Err(refused(format!("node {index} has a skin; skinned meshes are not read")));
        }
        if node.weights.iter().chain(&mesh.weights).any(|&weight| weight != 0.0) {
            return Err(refused(format!("node {index} has a morph target with a weight; such meshes are not read")));
        }
        mesh.primitives.iter().try_for_each(|primitive| self.add_primitive(primitive, transform))
    }

    fn add_primitive(&mut self, primitive: &Primitive, transform: &Matrix4<f64>) -> Result<()> {
        let mode = match primitive.mode.unwrap_or(4) {
            // Points and lines.
            0..=3 => return Ok(()),
            4 => Mode::Triangles,
            5 => Mode::Strip,
            6 => Mode::Fan,
            mode => return Err(malformed(format!("a primitive has the mode {mode}"))),
        };
        let position = primitive.attributes.position.ok_or_else(|| malformed("a primitive has no POSITION"))?;
        let vertices = self.vertices(position, transform)?;
        let corners = match primitive.indices {
            Some(accessor) => self.indices(accessor)?,
            None => (0..).take(vertices.len()).collect(),
        };
        let is_mirrored = transform.fixed_view::<3, 3>(0, 0).determinant() < 0.0;
        for [a, b, c] in mode.triangles(&corners)? {
            for corner in if is_mirrored { [a, c, b] } else { [a, b, c] } {
                let vertex = vertices.get(corner as usize).ok_or_else(|| {
                    let message = format!("names vertex {corner} of its primitive, which has {}", vertices.len());
                    Error::at(Reason::IndexOutOfRange, self.polygons.face(), message)
                })?;
                self.polygons.add_corner((*vertex).into())?;
            }
            self.polygons.end_face()?;
        }
        Ok(())
    }

    /// The vertex of each position of an accessor.
    fn vertices(&mut self, accessor: u32, transform: &Matrix4<f64>) -> Result<Vec<u32>> {
        let rows = self.rows(accessor, "VEC3", |component| component != Component::U32)?;
        let linear: Matrix3<f64> = transform.fixed_view::<3, 3>(0, 0).into();
        let shift: Vector3<f64> = transform.fixed_view::<3, 1>(0, 3).into();
        rows.into_iter().map(|row| self.welder.vertex((linear * Vector3::from(row) + shift).into())).collect()
    }

    /// The vertex indices of an accessor.
    fn indices(&mut self, accessor: u32) -> Result<Vec<u32>> {
        let rows = self.rows(accessor, "SCALAR", Component::is_index)?;
        // Exact: the components are unsigned integers of up to 32 bits.
        Ok(rows.into_iter().map(|[index]| index as u32).collect())
    }

    /// The elements of an accessor that must have this shape and a fitting component.
    fn rows<const N: usize>(&mut self, index: u32, shape: &str, fits: fn(Component) -> bool) -> Result<Vec<[f64; N]>> {
        let accessor = named(&self.document.accessors, "accessor", index)?;
        let component = Component::of(accessor.component_type).filter(|&component| fits(component));
        let Some(component) = component.filter(|_| accessor.shape == shape) else {
            let Accessor { shape, component_type, .. } = accessor;
            return Err(malformed(format!("accessor {index}: {shape} of type {component_type} does not belong here")));
        };
        self.take(accessor.count)?;
        let mut rows = match (accessor.buffer_view, &accessor.sparse) {
            (Some(view), _) => self.elements(view, accessor.byte_offset, accessor.count, component)?,
            // The count was taken from what is left, so that the size of the file bounds it.
            (None, Some(_)) => vec![[0.0; N]; usize::try_from(accessor.count).unwrap_or_default()],
            (None, None) => return Err(malformed(format!("accessor {index} has no data"))),
        };
        if let Some(Sparse { count, indices, values }) = &accessor.sparse {
            self.take(*count)?;
            let index_component = Component::of(indices.component_type).filter(|component| component.is_index());
            let index_component = index_component
                .ok_or_else(|| malformed(format!("accessor {index}: sparse indices of no index type")))?;
            let places = self.elements(indices.buffer_view, indices.byte_offset, *count, index_component)?;
            let values: Vec<[f64; N]> = self.elements(values.buffer_view, values.byte_offset, *count, component)?;
            for ([place], value) in places.into_iter().zip(values) {
                // Exact: an index type has up to 32 bits.
                *rows.get_mut(place as usize).ok_or_else(|| {
                    malformed(format!("accessor {index}: sparse index {place}, but there are {}", accessor.count))
                })? = value;
            }
        }
        if accessor.normalized && component != Component::F32 {
            let normal = |value: f64| f64::max(value / component.one(), -1.0);
            rows.iter_mut().for_each(|row| *row = row.map(normal));
        }
        Ok(rows)
    }

    /// Some elements of a view, `offset` bytes behind its begin.
    fn elements<const N: usize>(
        &self,
        view_index: u32,
        offset: u64,
        count: u64,
        component: Component,
    ) -> Result<Vec<[f64; N]>> {
        let view = named(&self.document.buffer_views, "buffer view", view_index)?;
        let buffer = named(&self.document.buffers, "buffer", view.buffer)?;
        if view.buffer != 0 || buffer.uri.is_some() {
            return Err(refused(format!("buffer {} is not in the file's own chunk of numbers", view.buffer)));
        }
        let size = component.size();
        let row = (N * size) as u64;
        let stride = view.byte_stride.unwrap_or(row);
        let span = count.checked_sub(1).map_or(Some(0), |to_last| to_last.checked_mul(stride)?.checked_add(row));
        let bytes = slice(self.numbers, view.byte_offset, Some(view.byte_length))
            .and_then(|bytes| slice(bytes, offset, span))
            .filter(|_| stride >= row)
            .ok_or_else(|| malformed(format!("buffer view {view_index} is shorter than its elements")))?;
        let element = |row: &[u8]| std::array::from_fn(|column| component.value(&row[column * size..]));
        // Only the last row is shorter than the stride.
        Ok(bytes.chunks(usize::try_from(stride).unwrap_or(usize::MAX)).map(element).collect())
    }

    /// Takes from what the scene may still show.
    fn take(&mut self, count: u64) -> Result<()> {
        self.left = self.left.checked_sub(count).ok_or_else(|| {
            malformed(format!(
                "the scene shows more than {MOST_REPETITION} vertices and corners for each byte of the file"
            ))
        })?;
        Ok(())
    }
}

fn slice(bytes: &[u8], offset: u64, length: Option<u64>) -> Option<&[u8]> {
    let rest = bytes.get(usize::try_from(offset).ok()?..)?;
    rest.get(..usize::try_from(length?).ok()?)
}

/// How corners make triangles.
#[derive(Debug, Clone, Copy)]
enum Mode {
    Triangles,
    Strip,
    Fan,
}

impl Mode {
    fn triangles(self, corners: &[u32]) -> Result<Vec<[u32; 3]>> {
        Ok(match self {
            Mode::Triangles => match corners.as_chunks() {
                (triangles, []) => triangles.to_vec(),
                _ => return Err(malformed(format!("a primitive of triangles has {} corners", corners.len()))),
            },
            Mode::Strip => corners
                .windows(3)
                .enumerate()
                .map(
                    |(i, corner)| {
                        if i % 2 == 0 { [corner[0], corner[1], corner[2]] } else { [corner[0], corner[2], corner[1]] }
                    },
                )
                .collect(),
            Mode::Fan => match corners {
                [first, rest @ ..] => rest.windows(2).map(|pair| [pair[0], pair[1], *first]).collect(),
                [] => Vec::new(),
            },
        })
    }
}

/// A type of an accessor's numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    /// The type of this code, which is OpenGL's.
    fn of(code: u32) -> Option<Component> {
        Some(match code {
            5120 => Component::I8,
            5121 => Component::U8,
            5122 => Component::I16,
            5123 => Component::U16,
            5125 => Component::U32,
            5126 => Component::F32,
            _ => return None,
        })
    }

    fn size(self) -> usize {
        match self {
            Component::I8 | Component::U8 => 1,
            Component::I16 | Component::U16 => 2,
            Component::U32 | Component::F32 => 4,
        }
    }

    /// Whether indices may be of this type.
    fn is_index(self) -> bool {
        matches!(self, Component::U8 | Component::U16 | Component::U32)
    }

    /// The number that begins these bytes.
    fn value(self, bytes: &[u8]) -> f64 {
        let [a, b, c, d] = std::array::from_fn(|i| bytes.get(i).copied().unwrap_or_default());
        match self {
            Component::I8 => i8::from_le_bytes([a]).into(),
            Component::U8 => a.into(),
            Component::I16 => i16::from_le_bytes([a, b]).into(),
            Component::U16 => u16::from_le_bytes([a, b]).into(),
            Component::U32 => u32::from_le_bytes([a, b, c, d]).into(),
            Component::F32 => f32::from_le_bytes([a, b, c, d]).into(),
        }
    }

    /// What stands for 1 where integers are normalized; the least integer of a signed type then stands for -1 too.
    fn one(self) -> f64 {
        match self {
            Component::I8 => i8::MAX.into(),
            Component::U8 => u8::MAX.into(),
            Component::I16 => i16::MAX.into(),
            Component::U16 => u16::MAX.into(),
            Component::U32 => u32::MAX.into(),
            Component::F32 => 1.0,
        }
    }
}

fn named<'a, T>(list: &'a [T], kind: &str, index: u32) -> Result<&'a T> {
    list.get(index as usize).ok_or_else(|| missing(kind, index))
}

fn missing(kind: &str, index: u32) -> Error {
    malformed(format!("{kind} {index} does not exist"))
}

fn malformed(message: impl Into<String>) -> Error {
    Error::new(Reason::Malformed, message)
}

fn refused(message: impl Into<String>) -> Error {
    Error::new(Reason::UnknownFormat, message)
}
