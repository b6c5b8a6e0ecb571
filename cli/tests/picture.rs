//! Pictures as a person asks for them: decoded, and looked at where it is known what must be there.

mod common;

use common::{Desk, obj};
use taut::shapes;

/// The picture that `taut distance LINE --picture` draws.
fn draws(desk: &Desk, line: &str) -> Picture {
    desk.prints(&format!("distance {line} --picture picture.png"));
    Picture::read(&bytes(desk, "picture.png"))
}

fn bytes(desk: &Desk, name: &str) -> Vec<u8> {
    std::fs::read(desk.path(name)).unwrap()
}

type Colour = [u8; 3];

const BACKGROUND: Colour = [0xf6, 0xf7, 0xf9];

struct Picture {
    width: usize,
    height: usize,
    pixels: Vec<Colour>,
    /// The box around what is neither background nor shadow, left of the legend: [left, top, right, bottom].
    surface: [usize; 4],
}

impl Picture {
    fn read(bytes: &[u8]) -> Picture {
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        let mut data = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut data).unwrap();
        assert_eq!((info.color_type, info.bit_depth), (png::ColorType::Rgb, png::BitDepth::Eight));
        let pixels = data.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect();
        let surface = [usize::MAX, usize::MAX, 0, 0];
        let mut picture = Picture { width: info.width as usize, height: info.height as usize, pixels, surface };
        for [x, y] in (0..picture.height).flat_map(|y| (0..picture.width * 3 / 4).map(move |x| [x, y])) {
            if picture.at(x, y).iter().zip(BACKGROUND).any(|(&a, b)| a.abs_diff(b) > 30) {
                let [left, top, right, bottom] = picture.surface;
                picture.surface = [left.min(x), top.min(y), right.max(x), bottom.max(y)];
            }
        }
        picture
    }

    fn at(&self, x: usize, y: usize) -> Colour {
        self.pixels[y * self.width + x]
    }

    fn corners(&self) -> [Colour; 4] {
        let [right, bottom] = [self.width - 1, self.height - 1];
        [[0, 0], [right, 0], [0, bottom], [right, bottom]].map(|[x, y]| self.at(x, y))
    }

    /// The colour where the grid, seen from the top, has the coordinates (x, y) in [0, 20]; a source near the border would
    /// stick out.
    fn on_grid(&self, [x, y]: [f64; 2]) -> Colour {
        let [left, top, right, bottom] = self.surface.map(|side| side as f64);
        let column = left + (right + 1.0 - left) * x / 20.0;
        let row = bottom + 1.0 - (bottom + 1.0 - top) * y / 20.0;
        self.at(column as usize, row as usize)
    }
}

fn brightness(colour: Colour) -> f64 {
    colour.map(f64::from).iter().sum::<f64>() / 3.0
}

/// A flat thing seen from the top or the bottom, so narrow that nothing reaches the legend's quarter of the picture.
const TOP: &str = "--view top --size 600x300";
const LARGE: &str = "--view top --size 1200x600";

#[test]
fn a_picture_has_its_size_and_a_clean_border() {
    let desk = Desk::with_grid();
    for (option, size) in [("", (1200, 900)), ("--size 300x200", (300, 200)), ("--size 64x500", (64, 500))] {
        let picture = draws(&desk, &format!("grid.obj --source 0 {option}"));
        assert_eq!((picture.width, picture.height), size);
        assert_eq!(picture.corners(), [BACKGROUND; 4]);
    }
}

#[test]
fn colours_follow_the_distance() {
    let picture = draws(&Desk::with_grid(), &format!("grid.obj --source 44 --method exact {LARGE}"));
    let steps = [3.0, 6.0, 10.0, 14.0, 18.5].map(|x| picture.on_grid([x, x]));
    assert!(steps.windows(2).all(|pair| brightness(pair[0]) > brightness(pair[1]) + 10.0), "{steps:?}");
    let [r, g, b] = steps[0];
    assert!(r > 220 && r > g && g > b, "light and warm near the source: {steps:?}");
    let [r, g, b] = steps[4];
    assert!(b > r && r > g && r < 100, "dark and cool far away: {steps:?}");
}

#[test]
fn isolines_are_where_the_distance_is_round() {
    let picture = draws(&Desk::with_grid(), &format!("grid.obj --source 220 --method exact {LARGE}"));
    // Distances reach 14.1, so lines are half a unit apart. Away from the source the triangles are nearly exact.
    let mean = |off: f64| {
        let places = (0..400).flat_map(|i| (6..18).map(move |half| [f64::from(i), 0.5 * f64::from(half) + off]));
        let colours = places.map(|[degrees, d]| {
            let angle = degrees.to_radians();
            brightness(picture.on_grid([10.0 + d * angle.cos(), 10.0 + d * angle.sin()]))
        });
        colours.sum::<f64>() / 4800.0
    };
    let [on, before, after] = [0.0, -0.25, 0.25].map(mean);
    assert!(on < 0.88 * before && on < 0.88 * after, "{before} {on} {after}");
}

#[test]
fn the_source_is_marked() {
    let picture = draws(&Desk::with_grid(), &format!("grid.obj --source 220 {LARGE}"));
    assert!(brightness(picture.on_grid([10.15, 9.85])) < 80.0);
    assert!(brightness(picture.on_grid([10.5, 10.5])) > 180.0);
}

#[test]
fn what_no_source_reaches_is_grey() {
    let desk = Desk::with_grid();
    let mut two = shapes::grid(20, 20);
    let first = two.positions.len() as u32;
    two.positions.extend(shapes::grid(20, 20).positions.iter().map(|p| [p[0] + 21.0, p[1], 0.0]));
    two.triangles.extend(shapes::grid(20, 20).triangles.iter().map(|t| t.map(|v| v + first)));
    desk.write("two.obj", &obj(&two));
    let picture = draws(&desk, "two.obj --source 220 --view top --size 600x600");
    let [left, top, right, bottom] = picture.surface;
    let row = (top + bottom) / 2;
    let spread = |[r, g, b]: Colour| r.max(g).max(b) - r.min(g).min(b);
    let [reached, unreached] = [left + 20, right - 5].map(|column| picture.at(column, row));
    assert!(spread(reached) > 60, "{reached:?}");
    assert!(spread(unreached) < 10 && brightness(unreached) < 225.0, "{unreached:?}");
}

#[test]
fn top_and_bottom_mirror_each_other() {
    let desk = Desk::with_grid();
    let [top, bottom] = ["top", "bottom"]
        .map(|view| draws(&desk, &format!("grid.obj --source 47 --method exact --view {view} --size 600x300")));
    let mut most: f64 = 0.0;
    for [x, y] in (0..36).flat_map(|i| (0..36).map(move |j| [1.1 + 0.5 * f64::from(i), 1.1 + 0.5 * f64::from(j)])) {
        // Not at the ball: its light comes from above in both.
        if (x - 5.0).hypot(y - 2.0) > 1.5 {
            let [seen, mirrored] = [top.on_grid([x, y]), bottom.on_grid([x, 20.0 - y])];
            most = most.max((brightness(seen) - brightness(mirrored)).abs());
        }
    }
    // An isoline may fall on the next pixel.
    assert!(most < 60.0, "{most}");
    assert_eq!(top.surface[0], bottom.surface[0]);
}

#[test]
fn the_same_command_gives_the_same_bytes() {
    let desk = Desk::with_grid();
    let draw = |name: &str| {
        draws(&desk, "grid.obj --source 0 --size 300x200");
        std::fs::rename(desk.path("picture.png"), desk.path(name)).unwrap();
        bytes(&desk, name)
    };
    assert_eq!(draw("first.png"), draw("second.png"));
}

#[test]
fn with_a_reference_the_error_is_drawn() {
    let desk = Desk::with_grid();
    let exact = String::from_utf8(desk.run("distance grid.obj --source 44 --method exact").stdout).unwrap();
    desk.write("exact.txt", &exact);
    // Small errors are as light as the background: where the grid is, the picture of the distances tells.
    let surface = draws(&desk, &format!("grid.obj --source 44 --method exact {TOP}")).surface;
    let mut right = draws(&desk, &format!("grid.obj --source 44 --method exact --reference exact.txt {TOP}"));
    right.surface = surface;
    let [low, same] = [[5.0, 5.0], [15.0, 15.0]].map(|place| right.on_grid(place));
    assert!(brightness(low) > 215.0 && low == same, "{low:?} {same:?}");

    // Twice as far on one half: an error of 50 % there, and none on the other.
    let half = |(v, line): (usize, &str)| {
        let distance: f64 = line.parse().unwrap();
        format!("{}\n", if v % 21 > 10 { 2.0 * distance } else { distance })
    };
    desk.write("half.txt", &exact.lines().enumerate().map(half).collect::<String>());
    let mut wrong = draws(&desk, &format!("grid.obj --source 44 --method exact --reference half.txt {TOP}"));
    wrong.surface = surface;
    assert!(brightness(wrong.on_grid([5.0, 15.0])) > 215.0);
    assert!(brightness(wrong.on_grid([15.0, 15.0])) < 80.0);
}

#[test]
fn errors_name_what_is_wrong_and_leave_nothing() {
    let desk = Desk::with_grid();
    for view in ["above", "0,0,0", "1,2", "nan,0,1", "inf,0,0", ""] {
        let line = format!("distance grid.obj --source 0 --picture p.png --view={view}");
        assert!(desk.says(2, &line).contains("--view"), "{view}");
    }
    for size in ["10x10", "5000x100", "300", "ax100"] {
        let line = format!("distance grid.obj --source 0 --picture p.png --size {size}");
        assert!(desk.says(2, &line).contains("--size"), "{size}");
    }
    assert!(desk.says(2, "distance grid.obj --source 0 --view top").contains("--picture"));
    let message = desk.says(1, "distance grid.obj --source 0 --picture missing/p.png -o distances.txt");
    assert!(message.contains("missing/p.png"), "{message}");
    assert!(!desk.path("distances.txt").exists() && !desk.path("p.png").exists());
}

#[test]
fn every_mesh_has_a_picture() {
    let desk = Desk::with_grid();
    let triangle = |scale: &str, offset: &str| {
        format!("v {offset} {offset} {offset}\nv {scale} {offset} {offset}\nv {offset} {scale} {offset}\nf 1 2 3\n")
    };
    let meshes = [
        ("one point", "v 1 2 3\n".to_owned()),
        ("a line", "v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n".to_owned()),
        ("one place", "v 5 5 5\nv 5 5 5\nv 5 5 5\nf 1 2 3\n".to_owned()),
        ("a repeated index", "v 0 0 0\nv 1 0 0\nf 1 1 2\n".to_owned()),
        ("not a number", triangle("1", "0") + "v nan nan inf\n"),
        ("huge", triangle("1.7e308", "-1.7e308")),
        ("large", triangle("1e300", "0")),
        ("small", triangle("1e-300", "0")),
        ("subnormal", triangle("1e-320", "0")),
        ("far away", triangle("1000000001", "1000000000")),
    ];
    for (name, mesh) in meshes {
        desk.write("mesh.obj", &mesh);
        for view in ["", "--view front", "--view bottom", "--view 1,1,1"] {
            let picture = draws(&desk, &format!("mesh.obj --source 0 --method exact --size 120x90 {view}"));
            assert_eq!(picture.corners()[..2], [BACKGROUND; 2], "{name} {view}");
        }
    }
}

#[test]
fn a_source_off_the_surface_is_left_out() {
    let desk = Desk::with_grid();
    desk.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan nan nan\nv 1e9 0 0\nf 1 2 3\n");
    let [inside, nowhere, away] =
        [0, 3, 4].map(|v| draws(&desk, &format!("mesh.obj --source {v} --method exact {TOP}")).surface);
    assert_eq!(nowhere, away);
    assert!(inside[0] <= nowhere[0]);
}
