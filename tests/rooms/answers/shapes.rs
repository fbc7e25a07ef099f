//! Bodies of revolution, cloth that fits them, and where it should come to lie.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use glam::{DVec2, DVec3};
use toile::body::Surface;
use toile::cloth::{ClothState, Garment, build};
pub use toile::fit::exact::{excess, residual};
use toile::geometry::ids::MarkId;
use toile::geometry::mesh::TriMesh;
use toile::pattern::{EdgeRef, Pattern, Piece, Seam};
use toile::relax::RelaxSettings;
use toile::wrap::{BodyMark, ClothMark, ClothSide, Dressing, Marks, Phase, coarser};

/// Height of the cloth above the skin, metres.
pub const OFFSET: f64 = 0.004;

/// `profile` (radius and height, from the bottom pole up to the top pole; both poles have radius 0) turned about y.
pub fn revolved(profile: &[DVec2], round: u32) -> TriMesh {
    let [bottom, rings @ .., top] = profile else { panic!("two poles") };
    let mut mesh = TriMesh::default();
    for p in rings {
        for i in 0..round {
            let (sin, cos) = (f64::from(i) / f64::from(round) * TAU).sin_cos();
            mesh.positions.push(DVec3::new(p.x * sin, p.y, p.x * cos));
        }
    }
    let low = mesh.positions.len() as u32;
    mesh.positions.extend([DVec3::Y * bottom.y, DVec3::Y * top.y]);
    let last = (rings.len() as u32 - 1) * round;
    for i in 0..round {
        let j = (i + 1) % round;
        mesh.triangles.extend([[low, j, i], [low + 1, last + i, last + j]]);
        for row in (0..last).step_by(round as usize) {
            let (a, b) = (row + i, row + j);
            mesh.triangles.extend([[a, b, b + round], [a, b + round, a + round]]);
        }
    }
    mesh
}

/// A ball about the origin.
pub fn ball(radius: f64, rings: u32, round: u32) -> TriMesh {
    let at = |i: u32| {
        let (sin, cos) = (PI * f64::from(i) / f64::from(rings)).sin_cos();
        DVec2::new(if i.is_multiple_of(rings) { 0.0 } else { radius * sin }, -radius * cos)
    };
    revolved(&(0..=rings).map(at).collect::<Vec<_>>(), round)
}

/// A cone on y = 0 with its apex at y = 1 and `half` radians between its axis and its side.
pub fn cone(half: f64, rows: u32, round: u32) -> TriMesh {
    let mut profile = vec![DVec2::ZERO];
    profile.extend((0..rows).map(|row| {
        let y = f64::from(row) / f64::from(rows);
        DVec2::new((1.0 - y) * half.tan(), y)
    }));
    profile.push(DVec2::Y);
    revolved(&profile, round)
}

/// Cloth, its marks, and where it lies without strain.
pub struct Cut {
    pub pattern: Pattern,
    pub marks: Marks,
    /// Place of a flat point; the flag tells the back piece.
    pub exact: Box<dyn Fn(DVec2, bool) -> DVec3>,
}

impl Cut {
    /// A front and a back of `outline`, sewn at the edges `right` and `left` of one to `left` and `right` of the other. A
    /// stroke down the middle of each through `spine`, onto the skin below where it should lie.
    fn new(
        outline: &[DVec2],
        [right, left]: [usize; 2],
        spine: &[DVec2],
        exact: impl Fn(DVec2, bool) -> DVec3 + 'static,
        body: &Surface,
    ) -> Self {
        let mut pattern = Pattern::default();
        let pieces = ["front", "back"].map(|name| pattern.add_piece(Piece::polygon(name, outline)));
        let side = |piece: usize, edge: usize| EdgeRef { piece: pieces[piece], edge };
        for sides in [[side(0, right), side(1, left)], [side(0, left), side(1, right)]] {
            pattern.add_seam(Seam::of_edges(sides, false));
        }
        let mut marks = Marks::default();
        for (i, piece) in pieces.into_iter().enumerate() {
            let points = spine.iter().map(|&p| body.nearest(exact(p, i == 1)).point).collect();
            marks.body.push(BodyMark { id: MarkId(2 * i as u32 + 2), points });
            let id = MarkId(2 * i as u32 + 1);
            marks.cloth.push(ClothMark { id, piece, side: ClothSide::Front, points: spine.to_vec() });
        }
        Self { pattern, marks, exact: Box::new(exact) }
    }

    /// A tube for a cylinder about y: `radius` metres is that of the cloth.
    pub fn tube(radius: f64, height: f64, low: f64, body: &Surface) -> Self {
        let width = PI * radius;
        let outline = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)].map(DVec2::from);
        let spine: Vec<DVec2> =
            (0..=20).map(|k| DVec2::new(width / 2.0, height * (0.05 + 0.9 * f64::from(k) / 20.0))).collect();
        let exact = move |uv: DVec2, back: bool| {
            let angle = uv.x / radius - PI / 2.0 + if back { PI } else { 0.0 };
            DVec3::new(radius * angle.sin(), low + uv.y, radius * angle.cos())
        };
        Self::new(&outline, [1, 3], &spine, exact, body)
    }

    /// A skirt for a [`cone`] with this half angle, from `top` to `bottom` metres from the apex of the cone it lies on.
    pub fn skirt(half: f64, top: f64, bottom: f64, body: &Surface) -> Self {
        let parts = 48;
        let flat = move |rho: f64, turn: f64| DVec2::new(rho * turn.sin(), -rho * turn.cos());
        let turn = move |k: usize| (k as f64 / parts as f64 - 0.5) * PI * half.sin();
        let mut outline: Vec<DVec2> = (0..=parts).map(|k| flat(bottom, turn(k))).collect();
        outline.extend((0..=parts).rev().map(|k| flat(top, turn(k))));
        let spine: Vec<DVec2> =
            (0..=20).map(|k| flat(bottom + (top - bottom) * (0.05 + 0.045 * f64::from(k)), 0.0)).collect();
        let apex = 1.0 + OFFSET / half.sin();
        let exact = move |uv: DVec2, back: bool| {
            let angle = uv.x.atan2(-uv.y) / half.sin() + if back { PI } else { 0.0 };
            let (r, y) = (uv.length() * half.sin(), apex - uv.length() * half.cos());
            DVec3::new(r * angle.sin(), y, r * angle.cos())
        };
        Self::new(&outline, [parts, 2 * parts + 1], &spine, exact, body)
    }

    /// Every vertex where it should lie.
    pub fn exact_state(&self, garment: &Garment) -> ClothState {
        let mut positions = vec![DVec3::ZERO; garment.vertex_count];
        for corner in &garment.corners {
            let back = corner.piece != garment.pieces[0].0;
            positions[corner.vertex as usize] = (self.exact)(corner.uv, back);
        }
        ClothState { positions, mapped: vec![true; garment.vertex_count] }
    }
}

/// No weight, no friction: only the shape counts.
pub fn settings(surface: &Surface) -> RelaxSettings {
    let offset = OFFSET / surface.scale();
    RelaxSettings { offset, gravity: 0.0, friction: 0.0, ..RelaxSettings::default() }
}

/// Wraps to rest as the program does.
pub fn wrapped(
    pattern: &Pattern,
    marks: &Marks,
    surface: &Arc<Surface>,
    settings: RelaxSettings,
    edge: f64,
) -> (Arc<Garment>, ClothState) {
    let (garment, problems) = build(pattern, edge);
    assert!(problems.is_empty(), "{problems:?}");
    let garment = Arc::new(garment);
    let coarser = coarser(pattern, &garment, edge, surface.scale());
    let (dressing, mut state, problems) =
        Dressing::coarse_to_fine(&coarser, garment.clone(), surface.clone(), marks, settings);
    assert!(problems.is_empty(), "{problems:?}");
    let mut dressing = dressing.expect("enough memory");
    let mut ticks = 0;
    while dressing.step(&mut state) != Phase::AtRest {
        ticks += 1;
        assert!(ticks < 5000, "never at rest");
    }
    assert!(state.mapped.iter().all(|&m| m));
    (garment, state)
}
