//! `reproduce` on folders of small meshes: it goes on where it was, and nothing in a folder breaks it.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use taut::{Control, Mesh, shapes};
use taut_eval::{Bootstrap, Error, Observer, Options, Reproduction, Result, Summary, reproduce};
use tempfile::TempDir;

const OPTIONS: Options = Options { basic_seed: 1, bootstrap: Bootstrap { resamples: 20, sources: 2, seed: 1 } };

/// Writes down what it is told, and may do something when a model is begun or finished.
struct Watch<'a> {
    told: Mutex<Told>,
    begun: &'a (dyn Fn(&str) + Sync),
    finished: &'a (dyn Fn(&str) + Sync),
}

#[derive(Default, Clone)]
struct Told {
    planned: Option<(usize, usize)>,
    begun: Vec<String>,
    finished: Vec<String>,
    failed: Vec<String>,
    share: f64,
}

impl Default for Watch<'_> {
    fn default() -> Self {
        Watch { told: Mutex::default(), begun: &|_| {}, finished: &|_| {} }
    }
}

impl Observer for Watch<'_> {
    fn planned(&self, models: usize, done_before: usize) {
        self.told.lock().unwrap().planned = Some((models, done_before));
    }

    fn begun(&self, model: &str) {
        self.told.lock().unwrap().begun.push(model.to_owned());
        (self.begun)(model);
    }

    fn advanced(&self, share: f64) {
        assert!(share >= 0.0, "{share}");
        self.told.lock().unwrap().share += share;
    }

    fn finished(&self, model: &str, failure: Option<&str>) {
        let mut told = self.told.lock().unwrap();
        told.finished.push(model.to_owned());
        told.failed.extend(failure.map(str::to_owned));
        drop(told);
        (self.finished)(model);
    }
}

/// A folder of meshes and one for the report.
struct Folders(TempDir);

impl Folders {
    fn of(meshes: &[(&str, &Mesh)]) -> Folders {
        let folders = Folders(tempfile::tempdir().unwrap());
        fs::create_dir(folders.meshes()).unwrap();
        meshes.iter().for_each(|(name, mesh)| folders.add(name, &obj(mesh)));
        folders
    }

    fn meshes(&self) -> PathBuf {
        self.0.path().join("meshes")
    }

    fn out(&self) -> PathBuf {
        self.0.path().join("out")
    }

    fn add(&self, name: &str, content: &str) {
        fs::write(self.meshes().join(name), content).unwrap();
    }

    fn run(&self) -> (Summary, Told) {
        let watch = Watch::default();
        let summary = self.watched(&watch, OPTIONS, 1, &Control::new()).unwrap();
        (summary, watch.told.into_inner().unwrap())
    }

    fn watched(&self, observer: &Watch, options: Options, threads: usize, control: &Control) -> Result<Summary> {
        let (meshes, out) = (&*self.meshes(), &*self.out());
        reproduce(&Reproduction { meshes, out, options, threads, draw: &draw, observer, control })
    }

    /// The files where single models are kept, by name.
    fn kept(&self) -> Vec<PathBuf> {
        let files = fs::read_dir(self.out().join("work")).unwrap();
        let mut files: Vec<PathBuf> = files.map(|entry| entry.unwrap().path()).collect();
        files.sort();
        files
    }
}

/// Pictures that tell the errors apart.
fn draw(mesh: &Mesh, source: u32, exact: &[f64], errors: &[Vec<f64>]) -> std::result::Result<Vec<Vec<u8>>, String> {
    assert!(exact[source as usize] == 0.0 && exact.len() == mesh.vertex_count());
    Ok(errors.iter().map(|errors| errors.iter().flat_map(|error| error.to_bits().to_le_bytes()).collect()).collect())
}

fn obj(mesh: &Mesh) -> String {
    let vertices = mesh.positions().iter().map(|[x, y, z]| format!("v {x:e} {y:e} {z:e}\n"));
    let faces = mesh.triangles().iter().map(|t| t.map(|v| v + 1)).map(|[a, b, c]| format!("f {a} {b} {c}\n"));
    vertices.chain(faces).collect()
}

fn off(mesh: &Mesh) -> String {
    let vertices = mesh.positions().iter().map(|[x, y, z]| format!("{x} {y} {z}\n"));
    let faces = mesh.triangles().iter().map(|[a, b, c]| format!("3 {a} {b} {c}\n"));
    let head = format!("OFF\n{} {} 0\n", mesh.vertex_count(), mesh.triangles().len());
    std::iter::once(head).chain(vertices).chain(faces).collect()
}

fn terrain(squares: u32) -> Mesh {
    shapes::terrain(squares, 2.0).mesh().unwrap()
}

fn sphere() -> Mesh {
    shapes::icosphere(1).mesh().unwrap()
}

/// All that a report's folder has, without the seconds.
fn written(out: &Path) -> BTreeMap<String, String> {
    let files = fs::read_dir(out).unwrap().map(|entry| entry.unwrap().path()).filter(|path| path.is_file());
    let of = |path: PathBuf| {
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        let text = fs::read_to_string(&path).unwrap();
        (name, without_seconds(&text))
    };
    files.map(of).collect()
}

/// The text without the word "seconds" and the number behind it, as JSON and the report have them.
fn without_seconds(text: &str) -> String {
    let mut rest = text;
    let mut kept = String::new();
    while let Some((before, after)) = rest.split_once("seconds") {
        kept.push_str(before);
        let is_number = |c: char| c.is_ascii_digit() || ".e-".contains(c);
        let ends = after.find(|c: char| c.is_ascii_digit()).map_or(0, |start| {
            let length = after[start..].find(|c| !is_number(c)).unwrap_or(after.len() - start);
            kept.push_str(&after[..start]);
            start + length
        });
        rest = &after[ends..];
    }
    kept + rest
}

fn data(folders: &Folders) -> serde_json::Value {
    serde_json::from_slice(&fs::read(folders.out().join("data.json")).unwrap()).unwrap()
}

fn models(folders: &Folders) -> Vec<String> {
    let data = data(folders);
    data["models"].as_array().unwrap().iter().map(|of| of["model"].as_str().unwrap().to_owned()).collect()
}

#[test]
fn interrupted_work_goes_on_and_gives_the_same_files() {
    let meshes = [("a.obj", &terrain(8)), ("b.obj", &sphere()), ("c.obj", &terrain(5)), ("d.obj", &terrain(3))];
    let whole = Folders::of(&meshes);
    let (summary, told) = whole.run();
    assert_eq!((summary.models, summary.failed.len()), (4, 0));
    assert_eq!(told.planned, Some((4, 0)));
    assert_eq!(told.begun, ["a", "b", "c", "d"], "the largest first");
    let expected = written(&whole.out());
    let files: Vec<&str> = expected.keys().map(String::as_str).collect();
    assert_eq!(files, ["best.csv", "data.json", "gains.csv", "properties.csv", "report.html", "sweep.csv"]);

    for threads in [1, 2] {
        let folders = Folders::of(&meshes);
        let control = Control::new();
        let watch = Watch {
            // Whichever is done first: by then at most one other is in work.
            finished: &|_| control.cancel(),
            ..Watch::default()
        };
        let error = folders.watched(&watch, OPTIONS, threads, &control).unwrap_err();
        assert!(error.is_cancelled(), "{error}");
        assert!(written(&folders.out()).is_empty());
        let first = watch.told.into_inner().unwrap();
        assert!(first.finished.len() < 4 && first.failed.is_empty(), "{:?} {:?}", first.finished, first.failed);

        let watch = Watch::default();
        folders.watched(&watch, OPTIONS, threads, &Control::new()).unwrap();
        let second = watch.told.into_inner().unwrap();
        assert_eq!(second.planned, Some((4, first.finished.len())));
        let mut all = [first.finished, second.finished].concat();
        all.sort();
        assert_eq!(all, ["a", "b", "c", "d"], "each is finished once");
        assert!((second.share - 1.0).abs() < 1e-12);
        assert_eq!(written(&folders.out()), expected);
    }
}

#[test]
fn what_is_kept_is_used_only_where_it_fits() {
    let folders = Folders::of(&[("a.obj", &terrain(4)), ("b.obj", &sphere())]);
    folders.run();
    let expected = written(&folders.out());
    let [of_a, of_b] = folders.kept().try_into().unwrap();
    let (a, b) = (fs::read_to_string(&of_a).unwrap(), fs::read_to_string(&of_b).unwrap());
    let key = a.split('"').nth(3).unwrap();
    let damaged = [
        String::new(),
        a[..a.len() / 2].to_owned(),
        a[..a.len() - 1].to_owned(),
        "no JSON".to_owned(),
        "{}".to_owned(),
        a.replacen(key, &"0".repeat(64), 1),
        a.replacen("\"study\"", "\"studie\"", 1),
        b,
    ];
    for content in damaged {
        fs::write(&of_a, content).unwrap();
        let (summary, told) = folders.run();
        assert_eq!((summary.models, told.planned, told.begun), (2, Some((2, 1)), vec!["a".to_owned()]));
        assert_eq!(written(&folders.out()), expected);
        assert_eq!(without_seconds(&fs::read_to_string(&of_a).unwrap()), without_seconds(&a));
    }
    let (_, told) = folders.run();
    assert_eq!((told.planned, told.begun.len()), (Some((2, 2)), 0));
    assert_eq!(told.share, 1.0);
}

#[test]
fn another_mesh_or_other_options_are_other_results() {
    let folders = Folders::of(&[("a.obj", &terrain(4)), ("b.obj", &sphere())]);
    folders.run();
    let expected = written(&folders.out());
    folders.add("a.obj", &obj(&terrain(5)));
    assert_eq!(folders.run().1.begun, ["a"]);
    assert_ne!(written(&folders.out()), expected);
    folders.add("a.obj", &obj(&terrain(4)));
    assert!(folders.run().1.begun.is_empty(), "the former results are there still");
    assert_eq!(written(&folders.out()), expected);

    let other = |options| {
        let watch = Watch::default();
        folders.watched(&watch, options, 1, &Control::new()).unwrap();
        watch.told.into_inner().unwrap().planned
    };
    for bootstrap in [
        Bootstrap { seed: 2, ..OPTIONS.bootstrap },
        Bootstrap { sources: 3, ..OPTIONS.bootstrap },
        Bootstrap { resamples: 21, ..OPTIONS.bootstrap },
    ] {
        assert_eq!(other(Options { bootstrap, ..OPTIONS }), Some((2, 0)), "{bootstrap:?}");
    }
    assert_eq!(other(Options { basic_seed: 2, ..OPTIONS }), Some((2, 2)), "no mesh of the basic set is here");
}

#[test]
fn models_never_share_a_file() {
    let long = format!("{}.obj", "n".repeat(240));
    let longer = format!("{}m.obj", "n".repeat(240));
    let names =
        ["a b.obj", "a_b.obj", "A_b.obj", "ä.obj", "é.obj", "日本.obj", &long, &longer, ".x.obj", "..obj", "c*?.obj"];
    let meshes: Vec<Mesh> = (2..).take(names.len()).map(terrain).collect();
    let folders = Folders::of(&names.into_iter().zip(&meshes).collect::<Vec<_>>());
    let (summary, _) = folders.run();
    assert_eq!((summary.models, summary.failed), (names.len(), Vec::new()));
    assert_eq!(folders.kept().len(), names.len());
    let (_, told) = folders.run();
    assert_eq!(told.planned, Some((names.len(), names.len())));
    let data = data(&folders);
    for (name, mesh) in names.iter().zip(&meshes) {
        let model = data["models"]
            .as_array()
            .unwrap()
            .iter()
            .find(|of| format!("{}.obj", of["model"].as_str().unwrap()) == *name);
        assert_eq!(model.unwrap()["properties"]["vertices"], mesh.vertex_count(), "{name}");
    }
}

#[test]
fn two_files_have_two_names() {
    let meshes: Vec<Mesh> = (2..9).map(terrain).collect();
    let folders =
        Folders::of(&[("a.obj", &meshes[0]), ("2.obj", &meshes[1]), ("b.obj", &meshes[2]), ("c.obj.obj", &meshes[3])]);
    folders.add("b.off", &off(&meshes[4]));
    folders.add("2.off", &off(&meshes[5]));
    folders.add("c.off", &off(&meshes[6]));
    folders.add("same.off", &off(&meshes[0]));
    let (summary, _) = folders.run();
    assert_eq!(models(&folders), ["./2.obj", "2.off", "a", "b.obj", "b.off", "c", "c.obj"]);
    assert_eq!(summary.failed, [("same".to_owned(), "same: has the same mesh as a".to_owned())]);
}

#[test]
fn shares_sum_up_to_all() {
    let folders = Folders::of(&[("a.obj", &terrain(6)), ("b.obj", &sphere()), ("c.obj", &terrain(3))]);
    folders.add("broken.obj", "f 1 2 3");
    folders.add("flat.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n");
    let (summary, told) = folders.run();
    assert_eq!((summary.models, summary.failed.len()), (3, 2));
    assert!((told.share - 1.0).abs() < 1e-12, "{}", told.share);
    assert_eq!(told.begun.len(), told.finished.len());
    assert_eq!(told.failed.len(), 1, "the other one is no model at all: {:?}", told.failed);
    fs::remove_file(&folders.kept()[1]).unwrap();
    let (_, told) = folders.run();
    assert_eq!(told.planned, Some((4, 2)));
    assert!((told.share - 1.0).abs() < 1e-12, "{}", told.share);
}

/// Random triangles between random vertices.
fn soup(vertices: u32, triangles: u32, size: f64) -> String {
    let mut state = u64::from(vertices ^ triangles);
    let mut random = move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 33) as u32
    };
    let mut text: String = (0..vertices)
        .map(|_| [(); 3].map(|()| size * (f64::from(random() % 1000) / 1000.0)))
        .map(|[x, y, z]| format!("v {x:e} {y:e} {z:e}\n"))
        .collect();
    for _ in 0..triangles {
        let [a, b, c] = [(); 3].map(|()| random() % vertices + 1);
        text.push_str(&format!("f {a} {b} {c}\n"));
    }
    text
}

fn scaled(mesh: &Mesh, factor: f64) -> String {
    let positions: Vec<[f64; 3]> = mesh.positions().iter().map(|p| p.map(|x| factor * x)).collect();
    obj(&Mesh::from_triangles(&positions, mesh.triangles()).unwrap())
}

#[test]
fn whatever_is_in_the_folder_is_in_the_report_or_left_out_for_a_reason() {
    let good = terrain(12);
    let folders = Folders::of(&[("good.obj", &good)]);
    let tiny_part = format!(
        "v 9 9 9\nv 9 9 8\nv 9 8 9\nf 1 2 3\n{}",
        obj(&good).lines().map(|line| shifted(line, 3)).collect::<String>()
    );
    let strange = [
        ("empty.obj", String::new()),
        ("garbage.obj", "\u{0}\u{1}garbage".to_owned()),
        ("garbage.ply", "ply\nformat nonsense".to_owned()),
        ("garbage.stl", "x".to_owned()),
        ("garbage.obj.gz", "not packed".to_owned()),
        ("points.obj", "v 0 0 0\nv 1 0 0\n".to_owned()),
        ("index.obj", "v 0 0 0\nv 1 0 0\nf 1 2 7\n".to_owned()),
        ("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n".to_owned()),
        ("unused-nan.obj", format!("{}v nan inf 0\n", obj(&good))),
        ("unused.obj", format!("{}v 1e300 0 0\n", obj(&good))),
        ("one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n".to_owned()),
        ("two.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n".to_owned()),
        ("equal.obj", obj(&shapes::icosphere(0).mesh().unwrap())),
        ("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nf 1 2 3\nf 2 3 4\n".to_owned()),
        ("place.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\nf 2 3 4\n".to_owned()),
        ("repeats.obj", "v 0 0 0\nv 1 0 0\nf 1 1 2\n".to_owned()),
        ("tiny-part.obj", tiny_part),
        ("soup.obj", soup(40, 60, 1.0)),
        ("dense-soup.obj", soup(20, 300, 1.0)),
        ("sparse-soup.obj", soup(300, 100, 1.0)),
        ("huge-soup.obj", soup(30, 80, 1e307)),
        ("tiny-soup.obj", soup(30, 80, 1e-307)),
        ("1e150.obj", scaled(&good, 1e150)),
        ("1e-150.obj", scaled(&good, 1e-150)),
        ("1e306.obj", scaled(&good, 1e306)),
        ("1e-306.obj", scaled(&good, 1e-306)),
        ("1e-320.obj", scaled(&good, 1e-320)),
        (
            "far.obj",
            "v 0 0 0\nv 1e308 0 0\nv 0 1e308 0\nv -1e308 -1e308 1e308\nf 1 2 3\nf 1 3 4\nf 1 4 2\nf 2 4 3\n".to_owned(),
        ),
    ];
    strange.iter().for_each(|(name, content)| folders.add(name, content));
    fs::create_dir(folders.meshes().join("folder.obj")).unwrap();
    fs::write(folders.meshes().join("notes.txt"), "no mesh").unwrap();
    let watch = Watch::default();
    let summary = folders.watched(&watch, OPTIONS, 2, &Control::new()).unwrap();
    let share = watch.told.into_inner().unwrap().share;
    assert!((share - 1.0).abs() < 1e-12, "{share}");
    assert_eq!(models(&folders).len(), summary.models);
    for (name, reason) in &summary.failed {
        assert!(reason.contains(name), "{name}: {reason}");
    }
    let failed: Vec<&str> = summary.failed.iter().map(|(name, _)| name.as_str()).collect();
    let expected = [
        // What cannot be read or has nothing to measure on:
        "empty",
        "garbage.obj",
        "garbage.obj.gz",
        "garbage.ply",
        "garbage.stl",
        "index",
        "nan",
        "points",
        "repeats",
        // The largest first: t in squares of these units is 0 or beyond all numbers.
        "1e-306",
        "1e306",
        "huge-soup",
        "tiny-soup",
        "far",
        "1e-320",
        "place",
    ];
    assert_eq!(BTreeSet::from_iter(failed), BTreeSet::from(expected));
    assert_eq!(summary.models + summary.failed.len(), 1 + strange.len());

    let data = data(&folders);
    no_nulls(&data, "");
    let of = |name: &str| data["models"].as_array().unwrap().iter().find(|of| of["model"] == name).unwrap().clone();
    assert_eq!((&of("tiny-part")["reached"], &of("tiny-part")["sources"][0]), (&3.into(), &0.into()));
    // Neither units nor what no triangle uses change anything.
    for name in ["unused", "unused-nan"] {
        assert_eq!(of(name)["laplacians"], of("good")["laplacians"], "{name}");
    }
    let best = |name: &str| of(name)["laplacians"][0]["sweep"]["mean"]["t"].clone();
    assert_eq!([best("1e150"), best("1e-150")], [best("good"), best("good")]);
}

/// JSON has `null` for what is no finite number; where something may be absent it is one too.
fn no_nulls(value: &serde_json::Value, key: &str) {
    const MAY_BE_ABSENT: [&str; 3] = ["maximum_t", "anisotropy", "over_sources"];
    match value {
        serde_json::Value::Null => assert!(MAY_BE_ABSENT.contains(&key), "{key} is null"),
        serde_json::Value::Array(values) => values.iter().for_each(|value| no_nulls(value, key)),
        serde_json::Value::Object(values) => values.iter().for_each(|(key, value)| no_nulls(value, key)),
        _ => {}
    }
}

fn shifted(line: &str, by: u32) -> String {
    let words = line.split(' ').map(|word| match line.starts_with('f') {
        true => word.parse::<u32>().map_or(word.to_owned(), |v| (v + by).to_string()),
        false => word.to_owned(),
    });
    words.collect::<Vec<_>>().join(" ") + "\n"
}

#[test]
fn what_cannot_be_written_or_read_is_named() {
    let named = |folders: &Folders, path: &Path| {
        let error = folders.watched(&Watch::default(), OPTIONS, 2, &Control::new()).unwrap_err();
        assert!(matches!(error, Error::File { .. }), "{error:?}");
        let expected = path.display().to_string();
        assert!(error.to_string().starts_with(&expected), "{error} does not name {expected}");
    };
    let mesh = terrain(3);
    let folders = Folders::of(&[("a.obj", &mesh)]);
    fs::write(folders.out(), "a file").unwrap();
    named(&folders, &folders.out());
    for file in ["report.html", "data.json", "gains.csv"] {
        let folders = Folders::of(&[("a.obj", &mesh)]);
        fs::create_dir_all(folders.out().join(file)).unwrap();
        named(&folders, &folders.out().join(file));
        let mut left = fs::read_dir(folders.out()).unwrap().map(|entry| entry.unwrap().path());
        assert!(left.all(|path| !path.to_str().unwrap().ends_with(".part")));
    }
    let folders = Folders::of(&[]);
    fs::remove_dir(folders.meshes()).unwrap();
    named(&folders, &folders.meshes());
    fs::create_dir(folders.meshes()).unwrap();
    let error = folders.watched(&Watch::default(), OPTIONS, 1, &Control::new()).unwrap_err();
    assert!(matches!(&error, Error::Input(message) if message.contains("no mesh files")), "{error}");
}

#[test]
fn a_model_that_cannot_be_kept_ends_it_at_once() {
    let folders = Folders::of(&[("a.obj", &terrain(8)), ("b.obj", &sphere()), ("c.obj", &terrain(3))]);
    folders.run();
    let files = folders.kept();
    files.iter().for_each(|file| fs::remove_file(file).unwrap());
    fs::create_dir(&files[0]).unwrap();
    let watch = Watch::default();
    let error = folders.watched(&watch, OPTIONS, 1, &Control::new()).unwrap_err();
    assert!(matches!(&error, Error::File { path, .. } if *path == files[0]), "{error}");
    assert_eq!(watch.told.into_inner().unwrap().begun, ["a"], "nobody waits for the others to learn of it");
}

#[test]
fn the_end_of_its_time_is_an_end_too_and_no_failure_of_models() {
    let folders = Folders::of(&[("a.obj", &terrain(8)), ("b.obj", &sphere())]);
    let control = Control::new();
    control.set_time_limit(std::time::Duration::ZERO);
    let error = folders.watched(&Watch::default(), OPTIONS, 2, &control).unwrap_err();
    assert!(matches!(&error, Error::Model { error, .. } if error.reason() == taut::Reason::TimeLimit), "{error}");
    let control = Control::new();
    control.cancel();
    let watch = Watch::default();
    assert!(folders.watched(&watch, OPTIONS, 2, &control).unwrap_err().is_cancelled());
    assert_eq!(watch.told.into_inner().unwrap().planned, None, "not even the meshes were read");
    assert!(written(&folders.out()).is_empty());
}

#[test]
fn a_mesh_that_changes_meanwhile_is_told() {
    let folders = Folders::of(&[("a.obj", &terrain(8)), ("b.obj", &sphere()), ("c.obj", &terrain(3))]);
    let change = |name: &str| {
        if name == "a" {
            folders.add("b.obj", &obj(&terrain(4)));
            fs::remove_file(folders.meshes().join("c.obj")).unwrap();
        }
    };
    let watch = Watch { begun: &change, ..Watch::default() };
    let summary = folders.watched(&watch, OPTIONS, 1, &Control::new()).unwrap();
    let [(b, of_b), (c, of_c)] = &summary.failed[..] else { panic!("{:?}", summary.failed) };
    assert_eq!((summary.models, b.as_str(), c.as_str()), (1, "b", "c"));
    assert!(of_b.contains("changed") && of_c.contains("c.obj"), "{of_b}; {of_c}");
}

#[test]
fn two_at_once_in_one_folder_break_nothing() {
    let meshes: Vec<Mesh> = (3..8).map(terrain).collect();
    let names = ["a.obj", "b.obj", "c.obj", "d.obj", "e.obj"];
    let folders = Folders::of(&names.into_iter().zip(&meshes).collect::<Vec<_>>());
    std::thread::scope(|scope| {
        let both =
            [(); 2].map(|()| scope.spawn(|| folders.watched(&Watch::default(), OPTIONS, 2, &Control::new()).unwrap()));
        both.into_iter().for_each(|one| assert_eq!(one.join().unwrap().models, 5));
    });
    let together = written(&folders.out());
    assert!(folders.kept().iter().all(|file| file.extension().unwrap() == "json"));
    fs::remove_dir_all(folders.out()).unwrap();
    folders.run();
    assert_eq!(written(&folders.out()), together);
}

#[test]
fn a_picture_that_cannot_be_drawn_fails_its_model() {
    let folders = Folders::of(&[("a.obj", &terrain(4)), ("b.obj", &sphere())]);
    let spheres = sphere().vertex_count();
    let fails = |mesh: &Mesh, source: u32, exact: &[f64], errors: &[Vec<f64>]| match mesh.vertex_count() == spheres {
        true => Err("no canvas".to_owned()),
        false => draw(mesh, source, exact, errors),
    };
    let (meshes, out, observer, control) = (&*folders.meshes(), &*folders.out(), &Watch::default(), &Control::new());
    let work = Reproduction { meshes, out, options: OPTIONS, threads: 1, draw: &fails, observer, control };
    let summary = reproduce(&work).unwrap();
    assert_eq!((summary.models, summary.failed), (1, vec![("b".to_owned(), "b: no canvas".to_owned())]));
    assert_eq!(folders.run().0.models, 2, "a failure is not kept");
}
