//! The program's icon: the pictures beside its SVG are what that shows. With TOILE_BLESS=1 they are drawn anew.

use std::path::PathBuf;

use image::{Rgba, RgbaImage};
use kurbo::{BezPath, Cap, Line, PathEl, Point, Stroke, StrokeOpts};
use usvg::tiny_skia_path::PathSegment;
use usvg::{Group, Node, Paint, Tree};

const SIZES: [u32; 3] = [48, 128, 256];
/// Samples of a pixel, each way.
const SAMPLES: u32 = 8;
/// Largest distance of flattened curves, units of the SVG.
const FLAT: f64 = 0.01;

fn path(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("assets/install/icons").join(name)
}

/// What is filled, in one colour.
struct Shape {
    lines: Vec<Line>,
    colour: [u8; 3],
}

fn curves(segments: impl Iterator<Item = PathSegment>) -> BezPath {
    let point = |p: usvg::tiny_skia_path::Point| Point::new(f64::from(p.x), f64::from(p.y));
    segments
        .map(|segment| match segment {
            PathSegment::MoveTo(p) => PathEl::MoveTo(point(p)),
            PathSegment::LineTo(p) => PathEl::LineTo(point(p)),
            PathSegment::QuadTo(a, p) => PathEl::QuadTo(point(a), point(p)),
            PathSegment::CubicTo(a, b, p) => PathEl::CurveTo(point(a), point(b), point(p)),
            PathSegment::Close => PathEl::ClosePath,
        })
        .collect()
}

/// The edges of the area that `path` surrounds, with its ends joined.
fn edges(path: &BezPath) -> Vec<Line> {
    let mut lines = Vec::new();
    let (mut first, mut last) = (Point::ZERO, Point::ZERO);
    kurbo::flatten(path.elements().iter().copied(), FLAT, |element| match element {
        PathEl::MoveTo(p) => {
            lines.push(Line::new(last, first));
            (first, last) = (p, p);
        }
        PathEl::LineTo(p) => {
            lines.push(Line::new(last, p));
            last = p;
        }
        _ => {
            lines.push(Line::new(last, first));
            last = first;
        }
    });
    lines.push(Line::new(last, first));
    lines
}

fn shapes(group: &Group, shapes_so_far: &mut Vec<Shape>) {
    for node in group.children() {
        match node {
            Node::Group(inner) => shapes(inner, shapes_so_far),
            Node::Path(path) => {
                let outline = curves(path.data().segments());
                let mut add = |paint: &Paint, area: &BezPath| {
                    let Paint::Color(colour) = paint else { panic!("plain colours only") };
                    let colour = [colour.red, colour.green, colour.blue];
                    shapes_so_far.push(Shape { lines: edges(area), colour });
                };
                if let Some(fill) = path.fill() {
                    add(fill.paint(), &outline);
                }
                if let Some(stroke) = path.stroke() {
                    let style = Stroke::new(f64::from(stroke.width().get())).with_caps(Cap::Round);
                    add(stroke.paint(), &kurbo::stroke(outline, &style, &StrokeOpts::default(), FLAT));
                }
            }
            _ => panic!("paths only"),
        }
    }
}

/// Where the row at `y` is inside the edges: sorted crossings with the direction of each.
fn crossings(lines: &[Line], y: f64) -> Vec<(f64, i32)> {
    let crossing = |line: &Line| {
        let (a, b) = (line.p0, line.p1);
        let upward = (a.y <= y) && (b.y > y);
        let downward = (b.y <= y) && (a.y > y);
        (upward || downward)
            .then(|| (a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x), if upward { 1 } else { -1 }))
    };
    let mut found: Vec<(f64, i32)> = lines.iter().filter_map(crossing).collect();
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found
}

/// The shapes, one over the other, at `size` pixels of a drawing 128 wide.
fn drawn(shapes: &[Shape], size: u32) -> RgbaImage {
    let step = 128.0 / f64::from(size * SAMPLES);
    let mut picture = RgbaImage::new(size, size);
    for shape in shapes {
        let mut cover = vec![0_u32; (size * size) as usize];
        for row in 0..size * SAMPLES {
            let found = crossings(&shape.lines, (f64::from(row) + 0.5) * step);
            let (mut next, mut winding) = (0, 0);
            for column in 0..size * SAMPLES {
                while next < found.len() && found[next].0 <= (f64::from(column) + 0.5) * step {
                    winding += found[next].1;
                    next += 1;
                }
                cover[(row / SAMPLES * size + column / SAMPLES) as usize] += u32::from(winding != 0);
            }
        }
        for (pixel, cover) in picture.pixels_mut().zip(cover) {
            let alpha = f64::from(cover) / f64::from(SAMPLES * SAMPLES);
            let below = f64::from(pixel[3]) / 255.0;
            let all = alpha + below * (1.0 - alpha);
            if all > 0.0 {
                let mixed = |i: usize| {
                    (f64::from(shape.colour[i]) * alpha + f64::from(pixel[i]) * below * (1.0 - alpha)) / all
                };
                *pixel = Rgba([mixed(0), mixed(1), mixed(2), all * 255.0].map(|value| value.round() as u8));
            }
        }
    }
    picture
}

#[test]
fn the_pictures_of_the_icon_are_those_of_its_svg() {
    let svg = std::fs::read(path("toile.svg")).expect("the icon");
    let tree = Tree::from_data(&svg, &usvg::Options::default()).expect("an SVG");
    let mut all = Vec::new();
    shapes(tree.root(), &mut all);
    assert!(all.len() > 8, "{} shapes", all.len());
    for size in SIZES {
        let picture = drawn(&all, size);
        let path = path(&format!("toile-{size}.png"));
        if std::env::var_os("TOILE_BLESS").is_some() {
            picture.save(&path).expect("written");
        }
        let kept = image::open(&path).expect("a picture").to_rgba8();
        assert_eq!(kept.dimensions(), (size, size));
        let differ = |(a, b): &(&u8, &u8)| a.abs_diff(**b) > 2;
        let wrong = kept.as_raw().iter().zip(picture.as_raw()).filter(differ).count();
        assert_eq!(wrong, 0, "{}: TOILE_BLESS=1 draws it anew", path.display());
    }
}
