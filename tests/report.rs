//! The report and the properties: closed forms, invariants, an independent table of the corpus, the paper's tables.

mod common;

use common::corpus;
use std::collections::{BTreeMap, BTreeSet};
use taut::shapes::{self, Shape};
use taut::{Mesh, MeshReport, Properties};

fn report(shape: &Shape) -> MeshReport {
    MeshReport::new(&shape.mesh().unwrap())
}

fn of(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> MeshReport {
    MeshReport::new(&Mesh::from_triangles(positions, triangles).unwrap())
}

/// Points that are all different, in general position.
fn points(count: u32) -> Vec<[f64; 3]> {
    (0..count).map(f64::from).map(|i| [i, (1.7 * i).sin(), (2.3 * i).cos()]).collect()
}

#[test]
fn clean_shapes_have_nothing_to_report() {
    let cases = [
        ("sphere", shapes::icosphere(2), 0, 0),
        ("torus", shapes::torus(12, 8, 1.0, 0.4), 1, 0),
        ("grid", shapes::grid(5, 4), 0, 1),
        ("cylinder", shapes::cylinder(7, 3, 1.0), 0, 2),
    ];
    for (name, shape, genus, loops) in cases {
        let report = report(&shape);
        let [component] = report.components[..] else { panic!("{name}: {:?}", report.components) };
        assert_eq!((component.genus(), component.boundary_loops), (Some(genus), loops), "{name}");
        assert_eq!(component.euler_characteristic(), 2 - 2 * i64::from(genus) - i64::from(loops), "{name}");
        assert!(report.boundary_loops.iter().all(|chain| chain.is_closed), "{name}");
        assert!(report.nonmanifold_edges.is_empty() && report.nonmanifold_vertices.is_empty(), "{name}");
        assert!(report.inconsistent_edges.is_empty() && report.zero_area_faces.is_empty(), "{name}");
        assert!(report.duplicate_faces.is_empty() && report.duplicate_vertices.is_empty(), "{name}");
        assert!(report.repeated_index_faces.is_empty() && report.unreferenced_vertices.is_empty(), "{name}");
    }
}

#[test]
fn the_boundary_of_a_grid_goes_round_it_in_the_direction_of_its_faces() {
    let report = report(&shapes::grid(2, 1));
    assert_eq!(report.boundary_loops.len(), 1);
    let mut chain = report.boundary_loops[0].vertices.clone();
    let first = chain.iter().position(|&v| v == 0).unwrap();
    chain.rotate_left(first);
    assert_eq!(chain, [0, 1, 2, 5, 4, 3]);
}

#[test]
fn a_moebius_strip_cannot_be_oriented() {
    // n quads in a ring, the last joined to the first upside down.
    for n in [3, 4, 5, 8] {
        let quads = (0..n).flat_map(|i| {
            let [a, b] = [2 * i, 2 * i + 1];
            let [c, d] = if i == n - 1 { [1, 0] } else { [a + 2, b + 2] };
            [[a, b, c], [b, d, c]]
        });
        let report = of(&points(2 * n), &quads.collect::<Vec<_>>());
        assert_eq!(report.components.len(), 1);
        assert!(report.components[0].is_manifold && !report.components[0].is_orientable);
        assert_eq!((report.components[0].euler_characteristic(), report.components[0].genus()), (0, None));
        assert_eq!(report.boundary_loops.len(), 1);
        assert_eq!(report.boundary_loops[0].vertices.len(), 2 * n as usize);
        assert_eq!(report.inconsistent_edges, [[0, 1]]);
    }
}

#[test]
fn a_face_turned_over_has_inconsistent_edges_but_can_be_turned_back() {
    let mut shape = shapes::icosphere(1);
    let [a, b, c] = shape.triangles[17];
    shape.triangles[17] = [a, c, b];
    let report = report(&shape);
    let mut edges = [[a, b], [b, c], [c, a]].map(|[u, v]| [u.min(v), u.max(v)]);
    edges.sort();
    assert_eq!(report.inconsistent_edges, edges);
    assert!(report.components[0].is_orientable);
}

#[test]
fn places_that_are_not_manifold() {
    let fan = of(&points(5), &[[0, 1, 2], [0, 1, 3], [1, 0, 4]]);
    assert_eq!((&fan.nonmanifold_edges[..], fan.nonmanifold_vertices.len()), (&[[0, 1]][..], 0));
    let ends: Vec<_> = fan.boundary_loops.iter().map(|chain| (chain.is_closed, &chain.vertices[..])).collect();
    assert_eq!(ends, [(false, &[1, 2, 0][..]), (false, &[1, 3, 0]), (false, &[0, 4, 1])]);
    assert!(!fan.components[0].is_manifold);

    let bow = of(&points(5), &[[0, 1, 2], [0, 3, 4]]);
    assert_eq!((bow.nonmanifold_edges.len(), &bow.nonmanifold_vertices[..]), (0, &[0][..]));
    let chains: Vec<_> = bow.boundary_loops.iter().map(|chain| (chain.is_closed, chain.vertices.len())).collect();
    assert_eq!(chains, [(true, 3), (true, 3)], "two holes that touch in a vertex stay two");
    // Three triangles on an edge and one more that touches its end.
    let both = of(&points(7), &[[0, 1, 2], [0, 1, 3], [1, 0, 4], [0, 5, 6]]);
    assert_eq!(both.nonmanifold_vertices, [0]);
}

#[test]
fn repeated_indices_copies_and_loose_vertices() {
    let mut positions = points(6);
    positions[4] = positions[1];
    positions[2][1] = 0.0;
    positions[5] = positions[2];
    positions[5][1] = -0.0; // the same place
    positions.push([f64::NAN; 3]);
    positions.push([f64::NAN; 3]);
    let faces = [[0, 1, 2], [3, 3, 1], [2, 0, 1], [1, 0, 2], [0, 1, 3], [4, 4, 4]];
    let report = of(&positions, &faces);
    assert_eq!(report.repeated_index_faces, [1, 5]);
    assert_eq!(report.duplicate_faces, [[2, 0], [3, 0]]);
    assert_eq!(report.duplicate_vertices, [[4, 1], [5, 2]]);
    assert_eq!(report.unreferenced_vertices, [4, 5, 6, 7]);
    assert_eq!(report.component_of, [0, 0, 0, 0, u32::MAX, u32::MAX, u32::MAX, u32::MAX]);
}

#[test]
fn no_area_means_none_that_the_coordinates_can_tell() {
    let faces = [[0, 1, 2]];
    let line = |height: f64, shift: f64| {
        let corners = [[shift, 0.0, 0.0], [shift + 0.5, height, 0.0], [shift + 1.0, 0.0, 0.0]];
        of(&corners, &faces).zero_area_faces.len()
    };
    assert_eq!([line(0.0, 0.0), line(1e-17, 0.0), line(1e-13, 0.0)], [1, 1, 0]);
    assert_eq!([line(1e-13, 1e3), line(1e-9, 1e3)], [1, 0]);
    assert_eq!(of(&[[0.0; 3], [0.0; 3], [1.0, 0.0, 0.0]], &faces).zero_area_faces, [0]);
    let tenths = [[0.1, 0.1, 0.0], [0.2, 0.2, 0.0], [0.3, 0.3, 0.0]];
    assert_eq!(of(&tenths, &faces).zero_area_faces, [0]);
}

#[test]
fn the_extreme_angles_are_named() {
    let report = of(&[[0.0; 3], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0], [9.0, 9.0, 9.0]], &[[3, 3, 0], [0, 1, 2]]);
    let (smallest, largest) = (report.smallest_angle.unwrap(), report.largest_angle.unwrap());
    assert_eq!((smallest.face, smallest.vertex, largest.face, largest.vertex), (1, 1, 1, 0));
    assert!((smallest.radians - 0.75f64.atan()).abs() < 1e-15);
    assert!((largest.radians - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
    assert!(of(&[[0.0; 3]], &[]).smallest_angle.is_none());
}

#[test]
fn properties_of_a_right_triangle() {
    let at = |size: f64| {
        let corners = [[0.0; 3], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0]].map(|p| p.map(|x| x * size));
        Properties::of(&Mesh::from_triangles(&corners, &[[0, 1, 2]]).unwrap()).unwrap()
    };
    let sigma = (2.0f64 / 3.0).sqrt();
    for size in [1.0, 1e-3, 1e100, 1e-140] {
        let p = at(size);
        let found = [
            [p.mean_edge, 4.0],
            [p.variance_edge / size, 2.0 / 3.0],
            [p.sigma_edge, sigma],
            [p.mean_absolute_deviation, 2.0 / 3.0],
            [p.median_absolute_deviation, 1.0],
            [p.min_edge, 3.0],
            [p.max_edge, 5.0],
            [p.edge_ratio * size, 0.6],
            [p.q1, 3.5],
            [p.q2, 4.0],
            [p.q3, 4.5],
            [p.quartile_deviation, 0.5],
            [p.min_angle * size, 0.75f64.atan()],
            [p.max_angle * size, std::f64::consts::FRAC_PI_2],
            [p.anisotropy * size, 6.0 * 5.0 / (2.0 * 3f64.sqrt() * 6.0)],
            [p.paper_scale * size * size, 24.976 / 5.0],
        ];
        for (i, [value, expected]) in found.into_iter().enumerate() {
            let value = value / size;
            assert!((value - expected).abs() <= 1e-13 * expected, "value {i} at {size:e}: {value}, {expected}");
        }
        assert_eq!((p.vertices, p.edges, p.faces), (3, 3, 1));
    }
}

/// Counted anew, the slow way, on random soups of few vertices.
#[test]
fn random_soups_are_reported_as_by_brute_force() {
    let mut state = 1u64;
    let mut next = |below: u64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((state >> 33) % below) as u32
    };
    for _ in 0..3000 {
        let (vertices, faces) = (3 + next(7), next(12));
        let triangles: Vec<[u32; 3]> = (0..faces).map(|_| [0; 3].map(|_| next(u64::from(vertices)))).collect();
        let report = of(&points(vertices), &triangles);
        assert_counted(&triangles, vertices, &report);
    }
}

fn assert_counted(triangles: &[[u32; 3]], vertices: u32, report: &MeshReport) {
    let used: Vec<[u32; 3]> = triangles.iter().copied().filter(|&[a, b, c]| a != b && b != c && c != a).collect();
    let mut edges: BTreeMap<[u32; 2], Vec<[u32; 2]>> = BTreeMap::new();
    for &[a, b, c] in &used {
        for [u, v] in [[a, b], [b, c], [c, a]] {
            edges.entry([u.min(v), u.max(v)]).or_default().push([u, v]);
        }
    }
    let with = |count: usize| edges.iter().filter(move |(_, on)| on.len() == count).map(|(&edge, _)| edge);
    let crowded: Vec<_> = edges.iter().filter(|(_, on)| on.len() > 2).map(|(&edge, _)| edge).collect();
    assert_eq!(report.nonmanifold_edges, crowded, "{triangles:?}");
    let same_way: Vec<_> = with(2).filter(|edge| edges[edge][0] == edges[edge][1]).collect();
    assert_eq!(report.inconsistent_edges, same_way, "{triangles:?}");

    // Every boundary edge lies on one chain, once.
    let joined = report.boundary_loops.iter().flat_map(|chain| {
        let closing = chain.is_closed.then(|| [chain.vertices[chain.vertices.len() - 1], chain.vertices[0]]);
        chain.vertices.windows(2).map(|pair| [pair[0], pair[1]]).chain(closing).collect::<Vec<_>>()
    });
    let mut chained: Vec<[u32; 2]> = joined.map(|[u, v]| [u.min(v), u.max(v)]).collect();
    chained.sort_unstable();
    assert_eq!(chained, with(1).collect::<Vec<_>>(), "{triangles:?}");

    // Parts, and fans at each vertex, by merging sets until nothing changes.
    let parts = merged(&used, |a, b| a.iter().any(|v| b.contains(v)));
    assert_eq!(report.components.len(), parts.len(), "{triangles:?}");
    assert_eq!(report.components.iter().map(|part| part.faces as usize).sum::<usize>(), used.len());
    assert_eq!(report.components.iter().map(|part| part.edges as usize).sum::<usize>(), edges.len());
    let unreferenced: Vec<u32> = (0..vertices).filter(|v| used.iter().all(|t| !t.contains(v))).collect();
    assert_eq!(report.unreferenced_vertices, unreferenced);
    let several_fans = |&v: &u32| {
        let at: Vec<[u32; 3]> = used.iter().copied().filter(|t| t.contains(&v)).collect();
        merged(&at, |a, b| a.iter().any(|w| *w != v && b.contains(w))).len() > 1
    };
    assert_eq!(report.nonmanifold_vertices, (0..vertices).filter(several_fans).collect::<Vec<_>>(), "{triangles:?}");

    // A component can be oriented if some choice of turned triangles leaves no inconsistent edge.
    for (part, component) in parts.iter().zip(&report.components) {
        let triangles: Vec<[u32; 3]> = part.iter().map(|&i| used[i]).collect();
        let agrees = |turned: u32| {
            let turn = |(i, &[a, b, c]): (usize, &[u32; 3])| if turned >> i & 1 == 1 { [a, c, b] } else { [a, b, c] };
            let turned: Vec<[u32; 3]> = triangles.iter().enumerate().map(turn).collect();
            let runs = |[u, v]: [u32; 2]| {
                turned.iter().filter(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]].contains(&[u, v])).count()
            };
            let pairs = with(2).filter(|[u, _]| triangles.iter().any(|t| t.contains(u)));
            pairs.into_iter().all(|[u, v]| runs([u, v]) == 1 && runs([v, u]) == 1)
        };
        assert_eq!(component.is_orientable, (0..1 << triangles.len()).any(agrees), "{triangles:?}");
    }
}

/// The triangles in groups, by index, such that related ones are in one group; ordered by their smallest vertex.
fn merged(triangles: &[[u32; 3]], related: impl Fn(&[u32; 3], &[u32; 3]) -> bool) -> Vec<BTreeSet<usize>> {
    let mut groups: Vec<BTreeSet<usize>> = (0..triangles.len()).map(|i| BTreeSet::from([i])).collect();
    let touching = |a: &BTreeSet<usize>, b: &BTreeSet<usize>| {
        a.iter().any(|&i| b.iter().any(|&j| related(&triangles[i], &triangles[j])))
    };
    while let Some((i, j)) =
        (0..groups.len()).flat_map(|j| (0..j).map(move |i| (i, j))).find(|&(i, j)| touching(&groups[i], &groups[j]))
    {
        let other = groups.remove(j);
        groups[i].extend(other);
    }
    groups.sort_by_key(|group| group.iter().flat_map(|&i| triangles[i]).min());
    groups
}

/// The table that came with the corpus was made by another program.
#[test]
fn the_corpus_is_reported_as_its_table_says() {
    let Some(folder) = corpus() else { return };
    let table = std::fs::read_to_string(folder.join("meshes.tsv")).unwrap();
    let mut lines = table.lines().map(|line| line.split('\t').collect::<Vec<_>>());
    let names = lines.next().unwrap();
    let mut seen = 0;
    for row in lines {
        let row: BTreeMap<&str, &str> = names.iter().copied().zip(row).collect();
        if row["F"].parse::<usize>().unwrap() < 300_000 {
            seen += 1;
            assert_row(&Mesh::read(folder.join(row["file"])).unwrap(), &row);
        }
    }
    assert!(seen > 70);
}

fn assert_row(mesh: &Mesh, row: &BTreeMap<&str, &str>) {
    let name = row["file"];
    let (report, properties) = (MeshReport::new(mesh), Properties::of(mesh).unwrap());
    let (edges, fans) = (report.nonmanifold_edges.len(), report.nonmanifold_vertices.len());
    let is_manifold = edges + fans == 0;
    let degenerate = format!("{}/{}", report.repeated_index_faces.len(), report.zero_area_faces.len());
    let manifold = if is_manifold { "yes".to_owned() } else { format!("NO ({edges} e, {fans} v)") };
    let is_closed = if report.boundary_loops.is_empty() { "yes" } else { "no" };
    for (column, found) in [
        ("V", properties.vertices.to_string()),
        ("E", properties.edges.to_string()),
        ("F", properties.faces.to_string()),
        ("closed", is_closed.to_owned()),
        ("manifold", manifold),
        ("comps", report.components.len().to_string()),
        ("bad orient edges", report.inconsistent_edges.len().to_string()),
        ("unref V", report.unreferenced_vertices.len().to_string()),
        ("degen F (repeat idx/zero area)", degenerate),
    ] {
        assert_eq!(found, row[column], "{name}: {column}");
    }
    // The table counts no duplicates among unreferenced vertices, and chains of a boundary that is not manifold as one.
    let used = |v: u32| report.component_of[v as usize] != u32::MAX;
    let duplicates = report.duplicate_vertices.iter().filter(|pair| used(pair[0])).count();
    assert_eq!(duplicates.to_string(), row["dup V"], "{name}");
    if is_manifold {
        assert_eq!(report.boundary_loops.len().to_string(), row["loops"], "{name}");
    }
    if let Ok(genus) = row["genus"].trim_end_matches(" (sum)").parse::<u32>() {
        assert_eq!(report.components.iter().map(|part| part.genus().unwrap()).sum::<u32>(), genus, "{name}");
    }
    let close = |column: &str, found: f64| {
        let printed: f64 = row[column].parse().unwrap();
        // The table has two to six digits; of angles below 1e-3 degrees, which the arc cosine cannot tell from 0, none.
        assert!((found - printed).abs() <= 5e-3 * printed.abs() + 1e-3, "{name}: {column} {printed}, found {found}");
    };
    close("mean e", properties.mean_edge);
    close("std e", properties.sigma_edge);
    close("min angle", properties.min_angle.to_degrees());
    if report.zero_area_faces.is_empty() {
        close("max angle", properties.max_angle.to_degrees());
    }
}

/// Row 1 of Tables 1 to 4. The paper cuts digits off more often than it rounds: either is its number.
#[test]
fn the_papers_properties_of_its_bunny() {
    let Some(folder) = corpus() else { return };
    let mesh = Mesh::read(folder.join("paper_bunny_1.obj")).unwrap();
    let p = Properties::of(&mesh).unwrap();
    let s = p.paper_scale;
    assert_eq!((p.vertices, p.edges, p.faces), (14290, 42864, 28576));
    for (found, printed) in [
        (p.anisotropy, "1.079"),
        (s * p.mean_edge, "0.21585"),
        (s * s * p.variance_edge, "0.00062"),
        (s * p.sigma_edge, "0.02505"),
        (s * p.mean_absolute_deviation, "0.01959"),
        (s * p.min_edge, "0.1262"),
        (s * p.max_edge, "0.3296"),
        (s * p.q2, "0.21542"),
        (s * p.q3, "0.23136"),
        (s * p.quartile_deviation, "0.0155"),
    ] {
        assert_printed(found, printed);
    }
    // The other four come out of a copy at the paper's size whose coordinates end after four decimals, which moves an
    // edge of 0.1262 by 1e-4 and an angle by hundredths of a degree. The size is the one at which all four do.
    let copy = Properties::of(&cut_copy(&mesh, 24.9752)).unwrap();
    for (found, printed) in [
        (copy.edge_ratio, "0.38306"),
        (copy.min_angle.to_degrees(), "35.39"),
        (copy.max_angle.to_degrees(), "102.31"),
        (copy.q1, "0.20017"),
    ] {
        assert_printed(found, printed);
    }
}

/// The mesh about the centre of its box, of this diagonal, with coordinates cut off after four decimals.
fn cut_copy(mesh: &Mesh, diagonal: f64) -> Mesh {
    let bound = |pick: fn(f64, f64) -> f64| {
        mesh.positions().iter().copied().reduce(|a, b| [0, 1, 2].map(|k| pick(a[k], b[k]))).unwrap()
    };
    let (low, high) = (bound(f64::min), bound(f64::max));
    let size = (0..3).map(|k| (high[k] - low[k]).powi(2)).sum::<f64>().sqrt();
    let cut =
        |p: &[f64; 3]| [0, 1, 2].map(|k| ((p[k] - (low[k] + high[k]) / 2.0) * diagonal / size * 1e4).trunc() / 1e4);
    Mesh::from_triangles(&mesh.positions().iter().map(cut).collect::<Vec<_>>(), mesh.triangles()).unwrap()
}

#[track_caller]
fn assert_printed(found: f64, printed: &str) {
    let decimals = printed.split('.').nth(1).unwrap().len();
    let (value, digit): (f64, f64) = (printed.parse().unwrap(), 0.1f64.powi(decimals as i32));
    assert!(found >= value - 0.5 * digit && found < value + digit, "{found} is not printed as {printed}");
}
