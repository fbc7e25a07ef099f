//! A small scene that dresses in a blink: a patch of cloth with one pair of marks on a ball. Beside it what else several
//! programs of tests share.

#![allow(dead_code, unused_imports, reason = "not every program uses all of it")]

pub mod chance;
pub mod exact;
pub mod limb;

use std::f64::consts::{PI, TAU};
use std::sync::Arc;
use std::time::Duration;

use glam::{DQuat, DVec2, DVec3};
use toile::geometry::ids::{MarkId, PieceId};
use toile::geometry::mesh::TriMesh;
use toile::pattern::{EdgeRef, Pattern, Piece, Seam, SpacePose};
use toile::session::{BodyChoice, Document, Project, Session, Settings};
use toile::sim::{Runner, Simulation};
use toile::wrap::{BodyMark, ClothMark, ClothSide, Marks};

/// Closed, outward, `radius` metres.
pub fn ball(radius: f64, rings: u32, sectors: u32) -> TriMesh {
    let mut positions = vec![DVec3::new(0.0, radius, 0.0)];
    for i in 1..rings {
        let (sin, cos) = (PI * f64::from(i) / f64::from(rings)).sin_cos();
        for j in 0..sectors {
            let (z, x) = (TAU * f64::from(j) / f64::from(sectors)).sin_cos();
            positions.push(DVec3::new(x * sin, cos, -z * sin) * radius);
        }
    }
    positions.push(DVec3::new(0.0, -radius, 0.0));
    let last = positions.len() as u32 - 1;
    let at = |i: u32, j: u32| 1 + (i - 1) * sectors + j % sectors;
    let mut triangles = Vec::new();
    for j in 0..sectors {
        triangles.push([0, at(1, j), at(1, j + 1)]);
        triangles.push([last, at(rings - 1, j + 1), at(rings - 1, j)]);
        for i in 1..rings - 1 {
            triangles.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            triangles.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    TriMesh { positions, triangles }
}

/// A line on the ball at height `y`, on its front, `2 * half` metres wide.
pub fn line_on_ball(radius: f64, y: f64, half: f64) -> Vec<DVec3> {
    let point = |x: f64| DVec3::new(x, y, (radius * radius - x * x - y * y).sqrt());
    vec![point(-half), point(0.0), point(half)]
}

/// Two patches sewn side by side, one stroke on each of two sides.
pub fn project() -> Project {
    let corners = [(0.0, 0.0), (0.25, 0.0), (0.25, 0.3), (0.0, 0.3)].map(DVec2::from);
    let mut pattern = Pattern::default();
    let left = pattern.add_piece(Piece::polygon("left", &corners));
    let right = pattern.add_piece(Piece::polygon("right", &corners));
    let side = |piece: PieceId, edge: usize| EdgeRef { piece, edge };
    pattern.add_seam(Seam::of_edges([side(left, 1), side(right, 3)], false));
    let marks = Marks {
        cloth: vec![ClothMark {
            id: MarkId(1),
            piece: left,
            side: ClothSide::Front,
            points: vec![DVec2::new(0.05, 0.2), DVec2::new(0.2, 0.2)],
        }],
        body: vec![BodyMark { id: MarkId(2), points: line_on_ball(0.75, 0.2, 0.075) }],
        ..Marks::default()
    };
    Project {
        document: Document {
            pattern: Arc::new(pattern),
            body: BodyChoice::Imported { name: "ball".to_owned(), mesh: Arc::new(ball(0.75, 24, 48)) },
            marks: Arc::new(marks),
            last_mark: 2,
            settings: Settings { edge_length: 0.06, ..Settings::default() },
            ..Document::default()
        },
        dressed: None,
    }
}

/// A front and a back sewn into a tube that fits a ball, without marks.
pub fn tube_project() -> Project {
    let (width, height) = (0.4, 0.12);
    let corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)].map(DVec2::from);
    let mut pattern = Pattern::default();
    let [front, back] = ["front", "back"].map(|name| pattern.add_piece(Piece::polygon(name, &corners)));
    for (edge, other) in [(1, 3), (3, 1)] {
        let sides = [EdgeRef { piece: front, edge }, EdgeRef { piece: back, edge: other }];
        pattern.add_seam(Seam::of_edges(sides, false));
    }
    let mut document = project().document;
    document.pattern = Arc::new(pattern);
    document.take_marks(Arc::default());
    document.body = BodyChoice::Imported { name: "ball".to_owned(), mesh: Arc::new(ball(0.12, 12, 24)) };
    document.settings.edge_length = 0.03;
    Project { document, dressed: None }
}

/// A front and a back sewn into a tube, `bottom` and `top` metres wide, without marks: placed before and behind a spindle that
/// is 75 cm round.
pub fn placed_project(bottom: f64, top: f64) -> Project {
    let mut project = tube_project();
    let document = &mut project.document;
    let (left, right, height) = ((bottom - top) / 2.0, (bottom + top) / 2.0, 0.2);
    let corners = [(0.0, 0.0), (bottom, 0.0), (right, height), (left, height)].map(DVec2::from);
    let pattern = Arc::make_mut(&mut document.pattern);
    for (piece, turn) in [(1, 0.0), (2, std::f64::consts::PI)] {
        let piece = Arc::make_mut(pattern.pieces.get_mut(&PieceId(piece)).expect("a piece"));
        for (edge, corner) in piece.outline.iter_mut().zip(corners) {
            edge.start = corner;
        }
        let rotation = DQuat::from_rotation_y(turn);
        let translation = rotation * DVec3::new(-bottom / 2.0, -0.09, 0.16);
        piece.placement = Some(SpacePose::flat(translation, rotation));
    }
    document.settings.edge_length = 0.025;
    let mut mesh = ball(0.12, 24, 48);
    mesh.positions.iter_mut().for_each(|p| p.y *= 3.0);
    document.body = BodyChoice::Imported { name: "spindle".to_owned(), mesh: Arc::new(mesh) };
    project
}

/// A session on the scene with the simulation inline.
pub fn session() -> Session {
    Session::new(project(), Runner::inline(Simulation::default()))
}

/// Runs an inline session for at most `ticks` ticks; how many it ran. On a thread it runs by itself: waits a little.
pub fn run(session: &mut Session, ticks: usize) -> usize {
    let Some(simulation) = session.runner().simulation() else {
        std::thread::sleep(Duration::from_millis(ticks.min(20) as u64));
        return 0;
    };
    let before = simulation.ticks();
    for _ in 0..ticks {
        simulation.tick();
    }
    let ran = (simulation.ticks() - before) as usize;
    session.update();
    ran
}

/// Hash of what moves in an inline session.
pub fn cloth_hash(session: &mut Session) -> u64 {
    session.runner().simulation().expect("inline").hash()
}
