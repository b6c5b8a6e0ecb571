//! Work that ends early: a radius, cancellation, a time limit, a memory limit; and what is known by then.

mod common;

use common::corpus;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::{self, ThreadId};
use std::time::{Duration, Instant};
use taut::{
    Closest, Control, Element, Error, ExactField, ExactOptions, ExactSolver, HeatOptions, HeatSolver, Mesh, Reason,
    Source, Status, SurfacePoint, Target, descent_paths, shapes,
};

/// What a field tells of its distances.
fn known(field: &ExactField) -> (&[f64], f64, u64) {
    (field.distances(), field.final_radius(), field.windows())
}

const PARTIAL: ExactOptions =
    ExactOptions { targets: Vec::new(), radius: f64::INFINITY, allow_partial: true, keep_windows: false };

fn within(radius: f64) -> ExactOptions {
    ExactOptions { radius, ..ExactOptions::default() }
}

/// Some mesh, and sources on it.
struct Case {
    name: &'static str,
    mesh: Mesh,
    solver: ExactSolver,
    sources: Vec<Source>,
}

impl Case {
    fn new(name: &'static str, mesh: Mesh, sources: &[(u32, f64)]) -> Case {
        let sources = sources.iter().map(|&(v, offset)| Source::vertex(v).with_offset(offset)).collect();
        Case { name, solver: ExactSolver::new(&mesh).unwrap(), mesh, sources }
    }

    fn field(&self, options: &ExactOptions, control: &Control) -> taut::Result<ExactField> {
        self.solver.field(&self.sources, options, control)
    }

    fn full(&self) -> ExactField {
        self.field(&ExactOptions::default(), &Control::new()).unwrap()
    }

    fn error(&self, control: &Control) -> Error {
        self.field(&ExactOptions::default(), control).unwrap_err()
    }
}

/// A terrain of 60 by 60 squares beside a sphere.
fn two_parts() -> Mesh {
    let (mut first, second) = (shapes::terrain(60, 0.3), shapes::icosphere(3));
    let shift = first.positions.len() as u32;
    first.positions.extend(second.positions.iter().map(|[x, y, z]| [x + 200.0, *y, *z]));
    first.triangles.extend(second.triangles.iter().map(|t| t.map(|v| v + shift)));
    first.mesh().unwrap()
}

fn cases() -> Vec<Case> {
    let torus = shapes::torus(96, 48, 1.0, 0.4).mesh().unwrap();
    vec![
        Case::new("terrain", shapes::terrain(60, 0.3).mesh().unwrap(), &[(1830, 0.0)]),
        Case::new("flat grid", shapes::grid(40, 40).mesh().unwrap(), &[(0, 0.0)]),
        Case::new("torus with start distances", torus, &[(5, 0.25), (2000, -0.5), (4000, 1.5)]),
        Case::new("two components", two_parts(), &[(17, 3.0), (3800, 2.5), (900, 0.0)]),
        Case::new("a start distance that swallows digits", shapes::terrain(60, 0.3).mesh().unwrap(), &[(0, 1e15)]),
        Case::new("long edges", shapes::cylinder(200, 2, 50.0).mesh().unwrap(), &[(0, 0.0)]),
    ]
}

/// Up to the final radius a field has all that the full one has, to the bit; beyond it nothing.
#[track_caller]
fn assert_part(part: &ExactField, full: &ExactField, what: &str) {
    for (v, (&d, &f)) in part.distances().iter().zip(full.distances()).enumerate() {
        let expected = if f <= part.final_radius() { f } else { f64::INFINITY };
        assert_eq!(d, expected, "{what}, vertex {v}; {f} up to {}", part.final_radius());
    }
}

#[test]
fn a_radius_cuts_exactly_there() {
    for case in cases() {
        let full = case.full();
        let reached = || full.distances().iter().copied().filter(|d| d.is_finite());
        let (least, most) = (reached().fold(f64::INFINITY, f64::min), reached().fold(0.0, f64::max));
        for share in [0.0, 0.01, 0.1, 0.3, 0.5, 0.8, 0.99] {
            // A vertex's own distance is the sharpest radius.
            let aim = least + share * (most - least);
            let radius = reached().filter(|&d| d >= aim).fold(f64::INFINITY, f64::min).max(0.0);
            let part = case.field(&within(radius), &Control::new()).unwrap();
            let what = format!("{}, radius {radius}", case.name);
            assert_eq!(part.final_radius(), if radius < most { radius } else { f64::INFINITY }, "{what}");
            assert_part(&part, &full, &what);
        }
        let part = case.field(&within(most), &Control::new()).unwrap();
        assert_eq!(known(&part), known(&full), "{}: the radius leaves nothing out", case.name);
    }
}

#[test]
fn a_radius_changes_no_bit_on_bad_meshes() {
    let Some(folder) = corpus() else { return };
    for name in ["mpi_near_degenerate.off", "klingon_starship.off", "boeing_soup.off", "truck_nm.obj", "louvre_cad.obj"]
    {
        let case = Case::new(name, Mesh::read(folder.join(name)).unwrap(), &[(0, 0.0), (50, 0.1)]);
        let full = case.full();
        let mut radii: Vec<f64> = full.distances().iter().copied().filter(|d| d.is_finite()).collect();
        radii.sort_by(f64::total_cmp);
        for &radius in radii.iter().step_by(1 + radii.len() / 50) {
            let part = case.field(&within(radius), &Control::new()).unwrap();
            assert!(part.final_radius() >= radius, "{name}, radius {radius}");
            assert_part(&part, &full, &format!("{name}, radius {radius}"));
        }
    }
}

#[test]
fn the_work_within_a_radius_grows_like_its_area() {
    for (name, shape, source, radius) in [
        ("terrain", shapes::terrain(100, 0.3), 5100, 0.8),
        ("torus", shapes::torus(192, 96, 1.0, 0.4), 7, 0.4),
        ("grid", shapes::grid(100, 100), 5100, 40.0),
    ] {
        let case = Case::new(name, shape.mesh().unwrap(), &[(source, 0.0)]);
        let windows = |radius: f64| case.field(&within(radius), &Control::new()).unwrap().windows() as f64;
        let [quarter, half, whole] = [0.25, 0.5, 1.0].map(|share| windows(share * radius));
        assert!(half < 0.4 * whole && quarter < 0.4 * half, "{name}: {quarter}, {half}, {whole} windows");
    }
    // A rim of short edges, and sides much longer than the radius: a rule that subtracts the longest edge of the mesh
    // would go on for ever.
    let case = Case::new("long edges", long_edge_far_away(), &[(0, 0.0)]);
    let [near, all] = [0.25, f64::INFINITY].map(|r| case.field(&within(r), &Control::new()).unwrap().windows());
    assert!(near < all / 20, "{near} of {all} windows");
}

/// A terrain, and far from its vertex 0 a triangle with edges longer than it.
fn long_edge_far_away() -> Mesh {
    let mut shape = shapes::terrain(60, 0.3);
    let last = shape.positions.len() as u32 - 1;
    shape.positions.push([500.0, 500.0, 0.0]);
    shape.triangles.push([last - 1, last, last + 1]);
    shape.mesh().unwrap()
}

#[test]
fn a_radius_and_targets_stop_at_the_nearer() {
    let case = &cases()[0];
    let full = case.full();
    let target = 1830 + 5;
    let d = full.distances()[target as usize];
    for (radius, final_radius) in [(0.5 * d, 0.5 * d..=0.5 * d), (4.0 * d, d..=2.0 * d)] {
        let options = ExactOptions { targets: vec![Target::Vertex(target)], ..within(radius) };
        let part = case.field(&options, &Control::new()).unwrap();
        assert!(final_radius.contains(&part.final_radius()), "{} for {radius} and {d}", part.final_radius());
        assert_part(&part, &full, "radius and target");
    }
}

/// Points in the midst of triangles and on their edges, spread over a mesh.
fn points(mesh: &Mesh, count: usize) -> Vec<Target> {
    let faces = (0..mesh.triangle_count() as u32).step_by(1 + mesh.triangle_count() / count);
    let weights = [[0.2, 0.3, 0.5], [0.9, 0.09, 0.01], [0.4, 0.6, 0.0]];
    faces
        .zip(weights.into_iter().cycle())
        .map(|(face, barycentric)| Target::Point(SurfacePoint { face, barycentric }))
        .collect()
}

#[test]
fn a_target_inside_a_triangle_is_final_when_the_work_stops() {
    for case in cases() {
        let keeping = ExactOptions { keep_windows: true, ..ExactOptions::default() };
        let full = case.field(&keeping, &Control::new()).unwrap();
        for target in points(&case.mesh, 40) {
            let options = ExactOptions { targets: vec![target], ..keeping.clone() };
            let part = case.field(&options, &Control::new()).unwrap();
            let what = format!("{}, {target:?}", case.name);
            let distance = full.distance(target).unwrap();
            assert_eq!(part.distance(target).unwrap(), distance, "{what}");
            assert_eq!(part.path(target).unwrap(), full.path(target).unwrap(), "{what}");
            assert!(part.final_radius() >= distance, "{what}");
            assert_part(&part, &full, &what);
        }
    }
}

#[test]
fn the_work_for_a_near_target_inside_a_triangle_is_small() {
    let case = Case::new("terrain", shapes::terrain(100, 0.3).mesh().unwrap(), &[(5100, 0.0)]);
    let all = case.full().windows();
    // Beside the source; and with a far one, which decides.
    let [near, far] = [10_100, 0].map(|face| Target::Point(SurfacePoint { face, barycentric: [0.2, 0.3, 0.5] }));
    let windows = |targets: Vec<Target>| {
        let options = ExactOptions { targets, ..ExactOptions::default() };
        case.field(&options, &Control::new()).unwrap().windows()
    };
    let (one, both) = (windows(vec![near]), windows(vec![near, far, Target::Vertex(5101)]));
    assert!(one < all / 50 && both > all / 4, "{one} and {both} of {all} windows");
}

#[test]
fn targets_that_are_no_places_are_named() {
    let case = &cases()[0];
    let faces = case.mesh.triangle_count() as u32;
    let bad = [
        (Reason::VertexOutOfRange, Target::Vertex(case.mesh.vertex_count() as u32)),
        (Reason::BadArgument, Target::Point(SurfacePoint { face: faces, barycentric: [0.2, 0.3, 0.5] })),
        (Reason::BadArgument, Target::Point(SurfacePoint { face: 0, barycentric: [0.5, f64::NAN, 0.5] })),
    ];
    for (reason, target) in bad {
        let options = ExactOptions { targets: vec![Target::Vertex(0), target], ..ExactOptions::default() };
        let error = case.field(&options, &Control::new()).unwrap_err();
        assert_eq!((error.reason(), error.element()), (reason, Some(Element::Target(1))), "{target:?}");
        let error = case.full().paths(&[Target::Vertex(0), target], &Control::new()).unwrap_err();
        assert_eq!((error.reason(), error.element()), (reason, Some(Element::Target(1))), "{target:?}");
    }
}

#[test]
fn paths_are_cancelled_between_two() {
    let case = &cases()[0];
    let full = case.full();
    let targets: Vec<Target> = (0..case.mesh.vertex_count() as u32).step_by(100).map(Target::Vertex).collect();
    let control = Control::new();
    let paths = full.paths(&targets, &control).unwrap();
    assert_eq!(control.progress(), 1.0);
    for (&target, path) in targets.iter().zip(paths) {
        assert_eq!(full.path(target).unwrap(), path);
    }
    let error = full.paths(&targets, &cancelled_at(7)).unwrap_err();
    assert_eq!(error.reason(), Reason::Cancelled);
    let late = Control::new();
    late.set_time_limit(Duration::ZERO);
    assert_eq!(full.paths(&targets, &late).unwrap_err().reason(), Reason::TimeLimit);
    assert!(full.paths(&[], &Control::new()).unwrap().is_empty());
}

/// A call that may fail.
type Attempt<'a> = &'a dyn Fn(&Control) -> Option<Error>;

#[test]
fn curves_closest_points_and_descent_are_cancelled_on_their_way() {
    let case = &cases()[0];
    let places: Vec<SurfacePoint> = (0..10).map(middle).collect();
    let closest = Closest::new(&case.mesh).unwrap();
    let positions = case.mesh.positions().repeat(1 + 640 / case.mesh.vertex_count());
    let heights: Vec<f64> = case.mesh.positions().iter().map(|position| position[2]).collect();
    let targets: Vec<Target> = places.iter().copied().map(Target::Point).collect();
    let calls: [Attempt<'_>; 3] = [
        &|control| case.solver.curve_through(&places, control).err(),
        &|control| closest.points(&positions, control).err(),
        &|control| descent_paths(&case.mesh, &heights, &[], &targets, control).err(),
    ];
    for call in calls {
        for n in [1, 3] {
            assert_eq!(call(&cancelled_at(n)).map(|error| error.reason()), Some(Reason::Cancelled));
        }
        let late = Control::new();
        late.set_time_limit(Duration::ZERO);
        assert_eq!(call(&late).map(|error| error.reason()), Some(Reason::TimeLimit));
    }
}

/// The middle of a triangle.
fn middle(face: u32) -> SurfacePoint {
    SurfacePoint { face, barycentric: [0.5, 0.25, 0.25] }
}

#[test]
fn a_radius_that_is_no_distance_is_refused() {
    for radius in [-1.0, f64::NAN, f64::NEG_INFINITY] {
        let error = cases()[1].field(&within(radius), &Control::new()).unwrap_err();
        assert_eq!((error.reason(), error.status()), (Reason::BadArgument, Status::InvalidArgument));
    }
    let least = cases()[1].field(&within(0.0), &Control::new()).unwrap();
    assert_eq!(least.distances().iter().filter(|d| d.is_finite()).count(), 1);
}

/// A control whose callback cancels at the nth checkpoint.
fn cancelled_at(n: usize) -> Control {
    let control = Control::new();
    let mut calls = 0;
    control.set_callback(move |_| {
        calls += 1;
        if calls == n { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    control
}

#[test]
fn a_callback_that_rests_is_told_the_end() {
    let told_with = |interval: Duration| {
        let control = Control::new();
        let told = Arc::new(Mutex::new(Vec::new()));
        let teller = Arc::clone(&told);
        control.set_callback_interval(interval);
        control.set_callback(move |progress| {
            teller.lock().unwrap().push(progress);
            ControlFlow::Continue(())
        });
        cases()[1].field(&ExactOptions::default(), &control).unwrap();
        drop(control);
        Arc::into_inner(told).unwrap().into_inner().unwrap()
    };
    let always = told_with(Duration::ZERO);
    assert!(always.len() > 2);
    assert_eq!(told_with(Duration::MAX), [always[0], 1.0]);
}

#[test]
fn a_callback_that_breaks_cancels_at_any_checkpoint() {
    for case in cases() {
        let full = case.full();
        let checkpoints = (1..).find(|&n| {
            let what = format!("{}, checkpoint {n}", case.name);
            let part = case.field(&PARTIAL, &cancelled_at(n)).unwrap();
            assert_part(&part, &full, &what);
            let Some(reason) = part.interruption() else { return true };
            let error = case.error(&cancelled_at(n));
            assert_eq!((error.reason(), error.status()), (Reason::Cancelled, Status::Cancelled), "{what}");
            assert_eq!(*reason, error, "{what}");
            false
        });
        // At the last one all is done, and to cancel does not undo it.
        assert!(checkpoints > Some(1), "{}", case.name);
        assert_eq!(
            known(&case.field(&PARTIAL, &cancelled_at(checkpoints.unwrap())).unwrap()),
            known(&full),
            "{}",
            case.name
        );
    }
}

#[test]
fn the_callback_runs_on_the_thread_of_the_call_and_progress_grows() {
    let case = &cases()[2];
    let heat = HeatSolver::new(&case.mesh, &HeatOptions::default(), &Control::new()).unwrap();
    let seen: Arc<Mutex<Vec<(ThreadId, f64)>>> = Arc::default();
    let control = || {
        let (control, seen) = (Control::new(), Arc::clone(&seen));
        control.set_callback(move |progress| {
            seen.lock().unwrap().push((thread::current().id(), progress));
            ControlFlow::Continue(())
        });
        control
    };
    let places: Vec<SurfacePoint> = (0..case.mesh.triangle_count() as u32).step_by(99).map(middle).collect();
    let positions = case.mesh.positions().repeat(3);
    let closest = Closest::new(&case.mesh).unwrap();
    let heights: Vec<f64> = case.mesh.positions().iter().map(|position| position[2]).collect();
    let targets: Vec<Target> = places.iter().copied().map(Target::Point).collect();
    let calls: [&(dyn Fn(&Control) + Sync); 6] = [
        &|control| drop(case.field(&ExactOptions::default(), control).unwrap()),
        &|control| drop(HeatSolver::new(&case.mesh, &HeatOptions::default(), control).unwrap()),
        &|control| drop(heat.field(&[Source::vertex(0)], control).unwrap().into_distances()),
        &|control| drop(case.solver.curve_through(&places, control).unwrap()),
        &|control| drop(closest.points(&positions, control).unwrap()),
        &|control| drop(descent_paths(&case.mesh, &heights, &[], &targets, control).unwrap()),
    ];
    for call in calls {
        let control = control();
        let caller = thread::scope(|scope| {
            let work = || {
                call(&control);
                thread::current().id()
            };
            scope.spawn(work).join().unwrap()
        });
        let seen = std::mem::take(&mut *seen.lock().unwrap());
        assert!(seen.len() > 2 && seen.iter().all(|(id, _)| *id == caller));
        assert!(seen.is_sorted_by(|a, b| a.1 <= b.1) && seen[seen.len() - 1].1 == 1.0);
        assert_eq!(control.progress(), 1.0);
    }
}

#[test]
fn a_callback_may_use_its_control() {
    let case = Arc::new(cases().remove(1));
    let control = Control::new();
    let calls = Arc::new(AtomicUsize::new(0));
    let inside = (control.clone(), Arc::clone(&case), Arc::clone(&calls));
    control.set_callback(move |_| {
        let (control, case, calls) = &inside;
        calls.fetch_add(1, Ordering::Relaxed);
        // A call inside the callback does not run it again; it may also replace itself, or cancel.
        assert!(case.field(&ExactOptions::default(), control).is_ok());
        control.set_callback(|_| ControlFlow::Continue(()));
        control.cancel();
        ControlFlow::Continue(())
    });
    assert_eq!(case.error(&control).reason(), Reason::Cancelled);
    assert_eq!(calls.load(Ordering::Relaxed), 1);
}

#[test]
fn another_thread_cancels_a_long_call() {
    let case = Case::new("terrain", shapes::terrain(400, 0.3).mesh().unwrap(), &[(0, 0.0)]);
    let control = Control::new();
    let part = thread::scope(|scope| {
        let work = scope.spawn(|| case.field(&PARTIAL, &control).unwrap());
        while control.progress() < 0.05 {
            thread::yield_now();
        }
        control.cancel();
        work.join().unwrap()
    });
    assert!(part.final_radius() > 0.0 && part.final_radius() < f64::INFINITY);
    let reference = case.field(&within(part.final_radius()), &Control::new()).unwrap();
    assert_eq!(part.distances(), reference.distances());
}

#[test]
fn a_time_limit_ends_the_work_soon_after() {
    let case = Case::new("terrain", shapes::terrain(400, 0.3).mesh().unwrap(), &[(0, 0.0)]);
    let limit = Duration::from_millis(30);
    for allow_partial in [false, true] {
        let (control, start) = (Control::new(), Instant::now());
        control.set_time_limit(limit);
        let result = case.field(&ExactOptions { allow_partial, ..ExactOptions::default() }, &control);
        let elapsed = start.elapsed();
        assert!(elapsed >= limit && elapsed < limit + Duration::from_secs(2), "{elapsed:?}");
        match result {
            Ok(part) => {
                assert!(allow_partial && part.final_radius() < f64::INFINITY);
                assert_eq!(part.interruption().unwrap().reason(), Reason::TimeLimit);
                let reference = case.field(&within(part.final_radius().max(0.0)), &Control::new()).unwrap();
                assert!(part.final_radius() < 0.0 || part.distances() == reference.distances());
            }
            Err(error) => {
                assert!(!allow_partial);
                assert_eq!((error.reason(), error.status()), (Reason::TimeLimit, Status::LimitReached));
                assert!(error.message().starts_with("the time limit of 30ms is reached, after "), "{error}");
            }
        }
    }
}

#[test]
fn heat_stops_at_its_next_step() {
    let mesh = shapes::icosphere(4).mesh().unwrap();
    let solver = HeatSolver::new(&mesh, &HeatOptions::default(), &Control::new()).unwrap();
    let step = taut::TimeStep::Value(0.01);
    let late = || {
        let control = Control::new();
        control.set_time_limit(Duration::ZERO);
        control
    };
    for (reason, control) in
        [(Reason::Cancelled, &(|| cancelled_at(2)) as &dyn Fn() -> Control), (Reason::TimeLimit, &late)]
    {
        let errors = [
            HeatSolver::new(&mesh, &HeatOptions::default(), &control()).unwrap_err(),
            solver.with_time_step(&step, &control()).unwrap_err(),
            solver.field(&[Source::vertex(0)], &control()).unwrap_err(),
        ];
        assert!(errors.iter().all(|error| error.reason() == reason), "{errors:?}");
    }
}

#[test]
fn a_memory_limit_fails_cleanly_or_gives_a_part() {
    for case in cases() {
        let full = case.full();
        let limited = |bytes: usize, allow_partial: bool| {
            let control = Control::new();
            control.set_memory_limit(bytes);
            case.field(&ExactOptions { allow_partial, ..ExactOptions::default() }, &control)
        };
        let fixed = 32 * case.mesh.vertex_count() + 12 * case.mesh.triangle_count();
        for bytes in [0, fixed, fixed + 100_000, fixed + 300_000] {
            let Err(error) = limited(bytes, false) else { continue };
            assert_eq!((error.reason(), error.status()), (Reason::MemoryLimit, Status::LimitReached));
            let message = format!("the memory limit of {bytes} bytes is reached: ");
            assert!(error.message().starts_with(&message) && error.message().ends_with(" are in use"), "{error}");
            let part = limited(bytes, true).unwrap();
            assert_eq!(part.interruption(), Some(&error), "{}", case.name);
            assert_part(&part, &full, case.name);
        }
        assert_eq!(limited(fixed, false).unwrap_err().reason(), Reason::MemoryLimit, "{}", case.name);
        assert_eq!(known(&limited(1 << 30, false).unwrap()), known(&full), "{}", case.name);
    }
}

#[test]
fn limits_that_are_not_reached_change_nothing() {
    for case in cases() {
        let control = Control::new();
        control.set_time_limit(Duration::from_secs(3600));
        control.set_memory_limit(1 << 40);
        control.set_callback(|_| ControlFlow::Continue(()));
        let options = ExactOptions { allow_partial: true, ..within(f64::MAX) };
        assert_eq!(known(&case.field(&options, &control).unwrap()), known(&case.full()), "{}", case.name);
    }
}
