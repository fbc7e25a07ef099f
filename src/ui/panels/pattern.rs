//! The sections of the pattern: properties of the selection, and lists of pieces and seams.

use egui::accesskit::Role;
use egui::{Button, ComboBox, Grid, Key, RichText, TextEdit, WidgetInfo};
use glam::DVec2;

use crate::geometry::ids::{PieceId, SeamId};
use crate::pattern::activity::Activity;
use crate::pattern::edit::{LinePoint, PatternEdit, PointRef, WIDEST_ALLOWANCE};
use crate::pattern::layers::MOST_LAYER;
use crate::pattern::{AllowanceCorner, EdgeRef, EdgeShape, Piece, PlanePose, Seam, Side};
use crate::session::Command;
use crate::ui::actions::Action;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::language::{say, signed, tr};
use crate::ui::list::list_ui;
use crate::ui::look::signs::{Sign, sign_button};
use crate::ui::panels::context::PanelContext;
use crate::ui::panels::fastenings::zip_ui;
use crate::ui::panels::fields::{angle_field, length_field, number_field};
use crate::ui::panels::trims::trims_ui;
use crate::ui::pattern_pane::seam_words;
use crate::ui::pointer::mouse::held;
use crate::ui::selection::{Item, Selection};

/// State of the sections between frames.
#[derive(Debug, Default)]
pub struct PatternPanel {
    /// The name being typed, and its piece.
    typed: Option<(PieceId, String)>,
}

fn ask(edits: Vec<PatternEdit>) -> Ask {
    Ask::Do(Command::EditPattern { edits, anew: false })
}

impl PatternPanel {
    /// Draws the properties of the selection.
    pub fn inspector_ui(&mut self, ui: &mut egui::Ui, told: &PanelContext<'_>, asks: &mut Asks) {
        let selection = told.selection;
        ui.label(RichText::new(selection.words()).color(told.palette.weak).size(12.5));
        if let Some(&id) = selection.seams.first().filter(|_| selection.seams.len() == 1) {
            seam_ui(ui, told, id, asks);
        }
        if let Some(&edge) = selection.edges.first().filter(|_| selection.edges.len() == 1) {
            edge_ui(ui, told, edge, asks);
        }
        trims_ui(ui, told, asks);
        if let Some(&point) = selection.points.first().filter(|_| selection.points.len() == 1) {
            point_ui(ui, told, point, asks);
        }
        if let Some(&point) = selection.line_points.first().filter(|_| selection.line_points.len() == 1) {
            line_point_ui(ui, told, point, asks);
        }
        if !selection.pieces.is_empty() {
            self.pieces_ui(ui, told, asks);
        }
    }

    fn pieces_ui(&mut self, ui: &mut egui::Ui, told: &PanelContext<'_>, asks: &mut Asks) {
        let pattern = &*told.document.pattern;
        let pieces = told.selection.pieces.iter().filter_map(|id| Some((*id, &**pattern.pieces.get(id)?)));
        let pieces: Vec<(PieceId, &Piece)> = pieces.collect();
        let Some([lower, upper]) = box_of(&pieces) else { return };
        let unit = told.now.unit;
        if let [(id, piece)] = pieces[..] {
            ui.horizontal(|ui| {
                let label = weak(ui, told, tr("Name"));
                self.name_ui(ui, id, piece, &label, asks);
            });
        }
        let ids: Vec<PieceId> = pieces.iter().map(|(id, _)| *id).collect();
        let place = |pose: &dyn Fn(&PlanePose) -> PlanePose| {
            let poses = pieces.iter().map(|(id, piece)| (*id, pose(&piece.pose)));
            ask(vec![PatternEdit::Place { poses: poses.collect() }])
        };
        let size = upper - lower;
        Grid::new("piece numbers").num_columns(4).spacing([6.0, 4.0]).show(ui, |ui| {
            for (name, old, way) in [("x", lower.x, DVec2::X), ("y", lower.y, DVec2::Y)] {
                let label = weak(ui, told, name);
                if let Some(new) = length_field(ui, ("at", name), &label, old, unit) {
                    let by = way * (new - old);
                    asks.push(place(&|pose| PlanePose { offset: pose.offset + by, ..*pose }));
                }
            }
            ui.end_row();
            for (name, old, way) in [("Width", size.x, DVec2::X), ("Height", size.y, DVec2::Y)] {
                let label = weak(ui, told, tr(name));
                if let Some(new) =
                    length_field(ui, ("size", name), &label, old, unit).filter(|new| *new > 1e-4)
                {
                    let factor = DVec2::ONE + way * (new / old.max(1e-9) - 1.0);
                    asks.push(ask(vec![PatternEdit::Scale { pieces: ids.clone(), about: lower, factor }]));
                }
            }
            ui.end_row();
            if let [(_, piece)] = pieces[..] {
                let label = weak(ui, told, tr("Angle"));
                if let Some(new) = angle_field(ui, "angle", &label, piece.pose.rotation) {
                    let (by, about) = (new - piece.pose.rotation, (lower + upper) / 2.0);
                    let turn = DVec2::from_angle(by);
                    asks.push(place(&|pose| PlanePose {
                        offset: about + turn.rotate(pose.offset - about),
                        rotation: new,
                        ..*pose
                    }));
                }
            }
        });
        ui.horizontal(|ui| {
            let label = weak(ui, told, tr("Seam allowance"));
            let old = pieces[0].1.allowance;
            if let Some(width) = length_field(ui, "allowance", &label, old, unit) {
                let width = width.clamp(0.0, WIDEST_ALLOWANCE);
                asks.push(ask(vec![PatternEdit::SetAllowance { pieces: ids.clone(), width }]));
            }
        });
        ui.horizontal(|ui| {
            let label = weak(ui, told, tr("Layer"));
            let old = pieces[0].1.layer;
            if let Some(new) = number_field(ui, "layer", &label, f64::from(old)) {
                let layer = new.round().clamp(0.0, f64::from(MOST_LAYER)) as u8;
                asks.push(ask(vec![PatternEdit::SetLayer { pieces: ids.clone(), layer }]));
            }
            weak(ui, told, tr("0 next to the skin"));
        });
        activity_ui(ui, told, &ids, asks);
        let seen = [Action::Twin, Action::MakeSymmetric, Action::Unlink, Action::Fold];
        action_row(ui, told, &seen, asks);
    }

    fn name_ui(
        &mut self,
        ui: &mut egui::Ui,
        id: PieceId,
        piece: &Piece,
        label: &egui::Response,
        asks: &mut Asks,
    ) {
        let (whose, text) = self.typed.get_or_insert_with(|| (id, piece.name.clone()));
        if *whose != id {
            (*whose, *text) = (id, piece.name.clone());
        }
        let field = ui.add(TextEdit::singleline(text).desired_width(f32::INFINITY)).labelled_by(label.id);
        let given_up = ui.input(|i| i.key_pressed(Key::Escape));
        if field.lost_focus() && !given_up && !text.trim().is_empty() && text.trim() != piece.name {
            asks.push(ask(vec![PatternEdit::Rename { piece: id, name: text.trim().to_owned() }]));
        } else if !field.has_focus() && *text != piece.name {
            piece.name.clone_into(text);
        }
    }

    /// Draws the list of pieces: select, rename, lock, hide.
    pub fn outliner_ui(&mut self, ui: &mut egui::Ui, told: &PanelContext<'_>, asks: &mut Asks) {
        let pattern = &*told.document.pattern;
        if pattern.pieces.is_empty() {
            ui.label(RichText::new(tr("None")).color(told.palette.weak));
        }
        for (&id, piece) in &pattern.pieces {
            // Icons come first: on the right the scroll bar would cover them.
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = 3.0;
                let name = &piece.name;
                let tip = tr("Hidden pieces are not shown here; they are sewn all the same");
                if sign_button(ui, Sign::Eye, !piece.hidden, &say!("Show {name}", name), tip) {
                    let hidden = !piece.hidden;
                    asks.push(ask(vec![PatternEdit::SetHidden { pieces: vec![id], hidden }]));
                }
                let tip = tr("Locked pieces are not changed by the pointer");
                if sign_button(ui, Sign::Lock, piece.locked, &say!("Lock {name}", name), tip) {
                    let locked = !piece.locked;
                    asks.push(ask(vec![PatternEdit::SetLocked { pieces: vec![id], locked }]));
                }
                let signs = [
                    (piece.symmetric, tr("symmetric")),
                    (piece.twin.is_some(), tr("twin")),
                    (piece.activity == Activity::Frozen, tr("frozen")),
                    (piece.activity.is_deactivated(), tr("deactivated")),
                ];
                let signs: String = signs.iter().filter(|s| s.0).map(|s| format!(" · {}", s.1)).collect();
                let text = RichText::new(format!("{name}{signs}"));
                let text = if piece.hidden { text.color(told.palette.weak) } else { text };
                row(ui, told, Item::Piece(id), text, &say!("Select {name}", name), asks);
            });
        }
    }
}

/// Draws the list of seams: select, reverse, undo.
pub fn seams_ui(ui: &mut egui::Ui, told: &PanelContext<'_>, asks: &mut Asks) {
    let pattern = &*told.document.pattern;
    if pattern.seams.is_empty() {
        let words = tr("None yet: choose Sew and click two edges.");
        ui.add(egui::Label::new(RichText::new(words).color(told.palette.weak)).wrap());
    }
    for (&id, seam) in &pattern.seams {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 3.0;
            let (dot, _) = ui.allocate_exact_size(egui::vec2(14.0, 16.0), egui::Sense::hover());
            ui.painter().circle_filled(dot.center(), 4.5, told.palette.seam(id.0));
            let words = seam_words(pattern, seam);
            let name = say!("Turn round: {seam}", seam = words);
            if sign_button(ui, Sign::Turn, true, &name, tr("Sew it the other way round")) {
                asks.push(ask(vec![PatternEdit::TurnSeam { seam: id }]));
            }
            let name = say!("Unpick: {seam}", seam = words);
            if sign_button(ui, Sign::Cross, true, &name, tr("Undo this seam")) {
                asks.push(ask(vec![PatternEdit::Unpick { seams: vec![id] }]));
            }
            // Messages name seams by their numbers.
            let text = RichText::new(format!("{} · {words}", id.0)).size(12.5);
            row(ui, told, Item::Seam(id), text, &say!("Select {name}", name = words), asks);
        });
    }
}

fn row(ui: &mut egui::Ui, told: &PanelContext<'_>, item: Item, text: RichText, words: &str, asks: &mut Asks) {
    let is_selected = told.selection.has(item);
    let whole = text.text().to_owned();
    let mut button = ui.add(Button::selectable(is_selected, text).truncate());
    if button.intrinsic_size().is_some_and(|size| size.x > button.rect.width() + 1.0) {
        button = button.on_hover_text(whole);
    }
    button.widget_info(|| WidgetInfo::selected(Role::Button, true, is_selected, words));
    if button.clicked() {
        let more = held(ui).shift || held(ui).command;
        asks.push(Ask::Pick(
            match is_selected && told.selection.pieces.len() + told.selection.seams.len() == 1 {
                true => Selection::default(),
                false => told.selection.clicked(Some(item), more),
            },
        ));
    }
}

fn action_row(ui: &mut egui::Ui, told: &PanelContext<'_>, actions: &[Action], asks: &mut Asks) {
    ui.horizontal_wrapped(|ui| {
        for &action in actions.iter().filter(|&&action| told.now.why_not(action).is_none()) {
            let entry = action.row();
            if ui.small_button(tr(entry.text)).on_hover_text(tr(entry.tip)).clicked() {
                asks.push(Ask::Act(action));
            }
        }
    });
}

fn weak(ui: &mut egui::Ui, told: &PanelContext<'_>, text: &str) -> egui::Response {
    ui.label(RichText::new(text).color(told.palette.weak).size(12.5))
}

/// Draws the choice of the pieces' activity in draping.
fn activity_ui(ui: &mut egui::Ui, told: &PanelContext<'_>, pieces: &[PieceId], asks: &mut Asks) {
    weak(ui, told, tr("Draping"));
    // Beside their label the buttons would widen the panel and shift the body pane.
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 2.0;
        for (activity, text, tip) in [
            (Activity::Active, "Active", "Draping and relaxing move it"),
            (Activity::Frozen, "Frozen", Action::ToggleFrozen.row().tip),
            (Activity::Deactivated, "Deactivated", Action::ToggleDeactivated.row().tip),
        ] {
            let is_so = told.now.picked.activity == Some(activity);
            if ui.selectable_label(is_so, tr(text)).on_hover_text(tr(tip)).clicked() && !is_so {
                asks.push(ask(vec![PatternEdit::SetActivity { pieces: pieces.to_vec(), activity }]));
            }
        }
    });
}

fn edge_ui(ui: &mut egui::Ui, told: &PanelContext<'_>, edge: EdgeRef, asks: &mut Asks) {
    let Some(piece) = told.document.pattern.pieces.get(&edge.piece) else { return };
    let (a, b) = piece.edge_ends(edge.edge);
    let length = piece.edge_length(edge.edge);
    ui.label(say!("{piece}, edge {n}", piece = piece.name, n = edge.edge + 1));
    Grid::new("edge numbers").num_columns(4).spacing([6.0, 4.0]).show(ui, |ui| {
        let label = weak(ui, told, tr("Length"));
        let end = PointRef { piece: edge.piece, point: piece.next_edge(edge.edge) };
        if let Some(new) =
            length_field(ui, "edge length", &label, length, told.now.unit).filter(|l| *l > 1e-4)
        {
            // The curve is scaled with its chord.
            let to = a + (b - a) * (new / length);
            asks.push(ask(vec![PatternEdit::MovePoints { points: vec![(end, to)] }]));
        }
        let label = weak(ui, told, tr("Angle"));
        let placed = [a, b].map(|p| piece.pose.plane_from_piece(p));
        let way = placed[1] - placed[0];
        if let Some(new) = angle_field(ui, "edge angle", &label, way.to_angle()) {
            let to = piece.pose.piece_from_plane(placed[0] + DVec2::from_angle(new) * way.length());
            asks.push(ask(vec![PatternEdit::MovePoints { points: vec![(end, to)] }]));
        }
        ui.end_row();
        if let EdgeShape::Arc { radius, large, sweep } = piece.edge(edge.edge).shape {
            let label = weak(ui, told, tr("Radius"));
            if let Some(new) = length_field(ui, "radius", &label, radius, told.now.unit) {
                let radius = new.max(a.distance(b) / 2.0);
                let shape = EdgeShape::Arc { radius, large, sweep };
                asks.push(ask(vec![PatternEdit::SetEdge { edge, shape }]));
            }
            ui.end_row();
        }
    });
    action_row(
        ui,
        told,
        &[Action::InsertPoint, Action::Straighten, Action::Curve, Action::Arc, Action::Unfold],
        asks,
    );
}

fn point_ui(ui: &mut egui::Ui, told: &PanelContext<'_>, point: PointRef, asks: &mut Asks) {
    let Some(piece) = told.document.pattern.pieces.get(&point.piece) else { return };
    let edge = piece.edge(point.point);
    let p = piece.pose.plane_from_piece(edge.start);
    ui.label(say!("{piece}, point {n}", piece = piece.name, n = point.point + 1));
    if let Some(to) = place_ui(ui, told, "point", p) {
        let to = piece.pose.piece_from_plane(to);
        asks.push(ask(vec![PatternEdit::MovePoints { points: vec![(point, to)] }]));
    }
    let mut smooth = edge.smooth;
    if ui.checkbox(&mut smooth, tr("Smooth")).on_hover_text(tr(Action::ToggleSmooth.row().tip)).changed() {
        asks.push(ask(vec![PatternEdit::SetSmooth { point, smooth }]));
    }
    if point.point < piece.outline.len() && piece.allowance > 0.0 && piece.cut_line.is_empty() {
        corner_ui(ui, told, point, piece, asks);
    }
}

/// Draws the place of a point of an internal line.
fn line_point_ui(ui: &mut egui::Ui, told: &PanelContext<'_>, at: LinePoint, asks: &mut Asks) {
    let Some(piece) = told.document.pattern.pieces.get(&at.piece) else { return };
    let Some(p) = piece.place_of(&at.into()).map(|p| piece.pose.plane_from_piece(p)) else { return };
    let (line, number) = (at.line + 1, at.point + 1);
    ui.label(say!("{name}, line {line}, point {number}", name = piece.name, line, number));
    if let Some(to) = place_ui(ui, told, "line point", p) {
        let to = piece.pose.piece_from_plane(to);
        asks.push(ask(vec![PatternEdit::MoveLinePoints { points: vec![(at, to)] }]));
    }
    let Some(mut smooth) = piece.is_smooth_at(&at.into()) else { return };
    if ui.checkbox(&mut smooth, tr("Smooth")).on_hover_text(tr(Action::ToggleSmooth.row().tip)).changed() {
        asks.push(ask(vec![PatternEdit::SetLineSmooth { point: at, smooth }]));
    }
}

/// Draws fields with the coordinates of a place on the table; returns the place with a newly entered one.
fn place_ui(ui: &mut egui::Ui, told: &PanelContext<'_>, salt: &str, p: DVec2) -> Option<DVec2> {
    let mut to = None;
    Grid::new((salt, "numbers")).num_columns(4).spacing([6.0, 4.0]).show(ui, |ui| {
        for (name, old, way) in [("x", p.x, DVec2::X), ("y", p.y, DVec2::Y)] {
            let label = weak(ui, told, name);
            if let Some(new) = length_field(ui, (salt, name), &label, old, told.now.unit) {
                to = Some(p + way * (new - old));
            }
        }
    });
    to
}

/// Draws the choice of how the seam allowance goes round a point of the outline.
fn corner_ui(ui: &mut egui::Ui, told: &PanelContext<'_>, point: PointRef, piece: &Piece, asks: &mut Asks) {
    let n = piece.outline.len();
    let number = |side: Side| match side {
        Side::Before => (point.point + n - 1) % n + 1,
        Side::After => point.point + 1,
    };
    let words = |corner: AllowanceCorner| match corner {
        AllowanceCorner::Mitre => tr("Mitred").to_owned(),
        AllowanceCorner::Square(side) => say!("Square to edge {n}", n = number(side)),
        AllowanceCorner::TurnedUp(side) => say!("Turned up at edge {n}", n = number(side)),
    };
    let tip = |corner: AllowanceCorner| match corner {
        AllowanceCorner::Mitre => tr("Both sides run on until they meet"),
        AllowanceCorner::Square(_) => tr("The allowance of this edge ends at right angles to it"),
        AllowanceCorner::TurnedUp(_) => {
            tr("For a hem: its allowance mirrors the other edge, so that it fits turned up")
        }
    };
    let old = piece.outline[point.point].corner;
    let label = weak(ui, told, tr("Corner of the allowance"));
    let combo = ComboBox::from_id_salt("allowance corner").selected_text(words(old)).width(170.0);
    let shown = list_ui(ui, combo, |entries| {
        for corner in AllowanceCorner::ALL {
            let entry = entries.add(corner == old, words(corner)).on_hover_text(tip(corner));
            if entry.clicked() && corner != old {
                asks.push(ask(vec![PatternEdit::SetCorner { point, corner }]));
            }
        }
    });
    shown.labelled_by(label.id);
}

fn seam_ui(ui: &mut egui::Ui, told: &PanelContext<'_>, id: SeamId, asks: &mut Asks) {
    let pattern = &*told.document.pattern;
    let Some(seam) = pattern.seams.get(&id) else { return };
    let length = |k: usize| seam.sides[k].length(pattern.pieces.get(&seam.sides[k].piece)?);
    let (Some(a), Some(b)) = (length(0), length(1)) else { return };
    let unit = told.now.unit;
    ui.add(egui::Label::new(seam_words(pattern, seam)).wrap());
    let percent = (a / b.max(1e-9) - 1.0) * 100.0;
    let more = (a - b) * 1000.0;
    let words = say!("{one} on {other}", one = unit.text(a), other = unit.text(b));
    ui.label(words);
    let ink = if percent.abs() > 1.0 { told.palette.warning } else { told.palette.weak };
    let words = say!("Difference {mm} mm ({share} %)", mm = signed(more, 1), share = signed(percent, 2));
    ui.label(RichText::new(words).color(ink).size(12.5));
    ratio_ui(ui, told, id, seam, a / b.max(1e-9), asks);
    zip_ui(ui, told, id, seam, asks);
    ui.horizontal(|ui| {
        action_row(ui, told, &[Action::TurnSeam, Action::Delete], asks);
    });
}

/// Whether a seam counts as not gathered: the lengths in pattern files are seldom equal to the last digit.
fn is_equal(ratio: f64) -> bool {
    (ratio - 1.0).abs() < 5e-4
}

/// Draws the ratio of both sides' lengths, and whether it is kept.
fn ratio_ui(
    ui: &mut egui::Ui,
    told: &PanelContext<'_>,
    seam: SeamId,
    old: &Seam,
    present: f64,
    asks: &mut Asks,
) {
    let set = |ratio: Option<f64>| ask(vec![PatternEdit::SetRatio { seam, ratio }]);
    ui.horizontal_wrapped(|ui| {
        let equal = old.ratio.is_some_and(is_equal);
        let text = if equal { tr("Equal") } else { tr("Make equal") };
        let tip = tr("Both sides have one length, and keep it");
        if ui.selectable_label(equal, text).on_hover_text(tip).clicked() {
            asks.push(set(Some(1.0)));
        }
        let gathered = old.ratio.is_some() && !equal;
        let tip = tr("The first side stays so many times as long as the second");
        if ui.selectable_label(gathered, tr("Gather")).on_hover_text(tip).clicked() {
            asks.push(set(Some(present)));
        }
        let tip = tr("Each side may change alone");
        if ui.selectable_label(old.ratio.is_none(), tr("Free")).on_hover_text(tip).clicked() {
            asks.push(set(None));
        }
    });
    if let Some(ratio) = old.ratio.filter(|ratio| !is_equal(*ratio)) {
        ui.horizontal(|ui| {
            let label = weak(ui, told, tr("Ratio"));
            if let Some(new) = number_field(ui, "ratio", &label, ratio).filter(|r| (0.1..=10.0).contains(r)) {
                asks.push(set(Some(new)));
            }
        });
    }
}

fn box_of(pieces: &[(PieceId, &Piece)]) -> Option<[DVec2; 2]> {
    let points = pieces
        .iter()
        .flat_map(|(_, piece)| piece.flattened(5e-4).into_iter().map(|p| piece.pose.plane_from_piece(p)));
    points.map(|p| [p, p]).reduce(|[a, b], [c, d]| [a.min(c), b.max(d)])
}
