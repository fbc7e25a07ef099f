//! Plays a demo in the window: the commands of a recording, carried out by an animated pointer ("hand").

use std::time::{Duration, Instant};

use egui::{Align2, Area, Color32, FontId, Frame, Id, Order, Painter, Pos2, Rect, RichText, Stroke, Vec2};
use glam::{DVec2, DVec3};

use crate::cloth::FlatPiece;
use crate::drag::DragMode;
use crate::geometry::ids::PieceId;
use crate::pattern::EdgeRef;
use crate::pattern::edit::{PatternEdit, TrimLine};
use crate::render::{Camera, mark_colour};
use crate::session::demos::Demo;
use crate::session::recording::Recording;
use crate::session::replay::Replay;
use crate::session::{Command, Session};
use crate::sim::ClothPlace;
use crate::sim::thread::DEFAULT_RATE_HZ;
use crate::ui::actions::Action;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::language::{said, say, tr};
use crate::ui::look::theme::Palette;
use crate::ui::pattern_pane::view::TableView;

/// Playing speed of settling cloth relative to real time.
const SETTLING_SPEED: f64 = 2.5;
/// Time budget for the ticks of one frame.
const BUDGET: Duration = Duration::from_millis(45);
/// Longest time step of a frame, seconds, so that after a pause the demo goes on where it was.
const LONGEST_FRAME: f64 = 0.2;
/// Time that the hand takes to move to the next place, seconds.
const TRAVEL: f64 = 0.45;
/// Largest angular speed of the view, rad/s.
const TURN_RATE: f32 = 2.2;
/// The view turns when the cosine between the direction of the eye and that of the place is not above this.
const SEEN_FROM: f32 = 0.35;
/// Radius of the ring that shows the hand, points.
const RING: f32 = 9.0;

/// The panes that the hand moves over.
pub struct Stage<'a> {
    /// Area of the pattern pane on the screen, and its view.
    pub table: (Rect, TableView),
    /// Area of the body pane on the screen.
    pub scene: Rect,
    /// Camera of the body pane; it is turned when the place of a command is out of sight.
    pub camera: &'a mut Camera,
}

/// A demo that is being played.
#[derive(Debug)]
pub struct Player {
    /// The demo.
    pub demo: Demo,
    replay: Box<Replay>,
    /// Seconds spent on the next command.
    acted: f64,
    ticks_due: f64,
    /// Position of the hand on the screen; `from` is where its present motion began.
    hand: Option<Pos2>,
    from: Option<Pos2>,
    /// What the hand does, in words.
    deed: String,
    /// The point where the dragged cloth was grabbed, metres.
    held: Option<DVec3>,
    /// The part of a stroke painted so far, on the screen, and the number of its mark.
    painted: (Vec<Pos2>, usize),
    ended: bool,
}

impl Player {
    /// A player at the beginning of `demo`. The error is a message.
    pub fn new(demo: Demo) -> Result<Self, String> {
        let recording = Recording::parse(demo.recording()).map_err(|e| {
            say!("The demo {name} cannot be read: {why}", name = quoted(demo), why = said(&e.words()))
        })?;
        Ok(Self {
            demo,
            replay: Box::new(Replay::to_watch(recording)),
            acted: 0.0,
            ticks_due: 0.0,
            hand: None,
            from: None,
            deed: String::new(),
            held: None,
            painted: (Vec::new(), 0),
            ended: false,
        })
    }

    /// The session of the demo.
    pub fn session(&self) -> &Session {
        self.replay.shown()
    }

    /// Whether the demo has ended.
    pub fn has_ended(&self) -> bool {
        self.ended
    }

    /// Advances by `seconds`. The error is a message.
    pub fn advance(&mut self, seconds: f64, stage: &mut Stage<'_>) -> Result<(), String> {
        let mut left = seconds.min(LONGEST_FRAME);
        let begun = Instant::now();
        while left > 0.0 && !self.ended && begun.elapsed() < BUDGET {
            if let Some(command) = self.replay.due_command().cloned() {
                if !self.act(&command, &mut left, stage) {
                    break;
                }
                self.finish_act(&command);
                self.step()?;
            } else if self.replay.is_tick_due() {
                if self.ticks_due < 1.0 {
                    self.ticks_due += left * self.rate();
                    left = 0.0;
                }
                if self.ticks_due >= 1.0 {
                    self.ticks_due -= 1.0;
                    // Ticks that do not fit in the time budget are not caught up on.
                    left = left.max(f64::MIN_POSITIVE);
                    self.step()?;
                }
            } else {
                self.step()?;
            }
        }
        self.ticks_due = self.ticks_due.min(1.0);
        self.replay.session().update();
        Ok(())
    }

    fn step(&mut self) -> Result<(), String> {
        match self.replay.step() {
            Ok(goes_on) => self.ended = !goes_on,
            Err(why) => {
                let (name, why) = (quoted(self.demo), said(&why.words()));
                return Err(say!("The demo {name} stopped: {why}", name, why));
            }
        }
        Ok(())
    }

    /// Playing speed, ticks per second.
    fn rate(&self) -> f64 {
        DEFAULT_RATE_HZ * if self.held.is_some() { 1.0 } else { SETTLING_SPEED }
    }

    /// Animates the hand for `command`, using up to `left` seconds. True when the animation is finished.
    fn act(&mut self, command: &Command, left: &mut f64, stage: &mut Stage<'_>) -> bool {
        if !self.turn_to(command, *left as f32, stage) {
            return false;
        }
        let whole = TRAVEL + length(command);
        if let Command::DragTo { .. } = command {
            self.hand = self.target(command, 1.0, stage).or(self.hand);
            return true;
        }
        let step = left.min(whole - self.acted);
        self.acted += step;
        *left -= step;
        self.deed = words(command, self.session());
        let share = ((self.acted - TRAVEL) / length(command).max(1e-9)).clamp(0.0, 1.0);
        if let Some(target) = self.target(command, share, stage) {
            let from = *self.from.get_or_insert(self.hand.unwrap_or(target));
            let way = (self.acted / TRAVEL).min(1.0) as f32;
            self.hand = Some(from.lerp(target, way * way * (3.0 - 2.0 * way)));
        }
        self.paint(command, share, stage);
        self.acted >= whole - 1e-9
    }

    fn finish_act(&mut self, command: &Command) {
        self.acted = 0.0;
        self.from = None;
        self.painted.0.clear();
        match command {
            Command::Grab { piece, at, .. } => self.held = self.place(ClothPlace { piece: *piece, at: *at }),
            Command::Release => self.held = None,
            _ => {}
        }
    }

    /// Turns the view towards the place of `command`; true when it is in sight.
    fn turn_to(&self, command: &Command, seconds: f32, stage: &mut Stage<'_>) -> bool {
        let Some(out) = self.faces(command) else { return true };
        let eye = stage.camera.towards_eye();
        let (flat, eye) = (DVec2::new(out.x, out.z).as_vec2(), glam::Vec2::new(eye.x, eye.z));
        let (Some(flat), Some(eye)) = (flat.try_normalize(), eye.try_normalize()) else { return true };
        if flat.dot(eye) > SEEN_FROM && self.acted == 0.0 || flat.dot(eye) > 0.98 || self.acted > 0.0 {
            return true;
        }
        let angle = eye.perp_dot(flat).atan2(eye.dot(flat));
        let step = angle.clamp(-TURN_RATE * seconds, TURN_RATE * seconds);
        stage.camera.orbit(glam::Vec2::new(step, 0.0));
        (angle - step).abs() < 0.35 && flat.dot(eye) > SEEN_FROM
    }

    /// Direction in which the place of `command` faces.
    fn faces(&self, command: &Command) -> Option<DVec3> {
        let surface = self.session().surface()?;
        match command {
            Command::AddBodyMark { points } => {
                let normals: DVec3 = points.iter().map(|&p| surface.nearest(p).normal).sum();
                Some(normals)
            }
            Command::AddPin { piece, at } | Command::Grab { piece, at, .. } => {
                Some(surface.nearest(self.place(ClothPlace { piece: *piece, at: *at })?).normal)
            }
            Command::Wrap => Some(DVec3::Z),
            _ => None,
        }
    }

    fn place(&self, place: ClothPlace) -> Option<DVec3> {
        let snapshot = self.session().snapshot();
        let garment = snapshot.garment.as_ref()?;
        let found = FlatPiece::new(garment, place.piece).nearest(garment, place.at)?;
        found.point(garment, &snapshot.cloth)
    }

    /// Position of the hand on the screen after the fraction `share` of the animation of `command`.
    fn target(&self, command: &Command, share: f64, stage: &Stage<'_>) -> Option<Pos2> {
        match command {
            Command::AddClothMark { .. } | Command::AddBodyMark { .. } => {
                stroke(self.session(), command, share, stage).last().copied()
            }
            Command::SetPiecePose { piece, .. } => self.middle(*piece, stage),
            Command::AddGraphic { graphic } => {
                let piece = self.session().document().pattern.pieces.get(&graphic.piece)?;
                Some(on_table(stage, piece.pose.plane_from_piece(graphic.at)))
            }
            Command::SetFabric { piece, .. } | Command::SetDye { piece, .. } => {
                // What all pieces get is shown on the last, which is mostly the largest.
                let last = || self.session().document().pattern.pieces.keys().last().copied();
                self.middle(piece.or_else(last)?, stage)
            }
            Command::EditPattern { edits, .. } => edited(edits.first()?, self.session(), stage),
            Command::AddSeam { seam } => {
                let side = &seam.sides[0];
                let piece = self.session().document().pattern.pieces.get(&side.piece)?;
                Some(on_table(stage, piece.pose.plane_from_piece(*side.points(piece, &[0.5])?.first()?)))
            }
            Command::AddPin { piece, at } | Command::Grab { piece, at, .. } => {
                on_body(stage, self.place(ClothPlace { piece: *piece, at: *at })?)
            }
            Command::DragTo { ray } => {
                let way = ray.direction.try_normalize()?;
                let depth = (self.held? - ray.origin).dot(way);
                on_body(stage, ray.origin + way * depth)
            }
            _ => None,
        }
    }

    /// The middle of a piece's outline on the screen.
    fn middle(&self, piece: PieceId, stage: &Stage<'_>) -> Option<Pos2> {
        let piece = self.session().document().pattern.pieces.get(&piece)?;
        let line = piece.flattened(0.01);
        let middle = line.iter().sum::<DVec2>() / line.len() as f64;
        Some(on_table(stage, piece.pose.plane_from_piece(middle)))
    }

    fn paint(&mut self, command: &Command, share: f64, stage: &Stage<'_>) {
        let marks = &self.session().document().marks;
        let number = match command {
            Command::AddClothMark { .. } => marks.cloth.len() + 1,
            Command::AddBodyMark { .. } => marks.body.len() + 1,
            _ => return,
        };
        let begun = self.acted > TRAVEL;
        let line = if begun { stroke(self.session(), command, share, stage) } else { Vec::new() };
        self.painted = (line, number);
    }

    /// Draws the hand over the panes, and the banner.
    pub fn ui(&self, ctx: &egui::Context, palette: &Palette, table: Rect, asks: &mut Asks) {
        let painter = ctx.layer_painter(egui::LayerId::new(Order::Middle, Id::unique("hand of the demo")));
        if self.painted.0.len() > 1 {
            let [r, g, b] = mark_colour(self.painted.1);
            painter.line(self.painted.0.clone(), Stroke::new(6.5, palette.halo));
            painter.line(self.painted.0.clone(), Stroke::new(3.2, Color32::from_rgb(r, g, b)));
        }
        if let Some(at) = self.hand.filter(|_| !self.ended) {
            hand_ui(&painter, at, self.held.is_some() || !self.painted.0.is_empty(), &self.deed, palette);
        }
        self.banner_ui(ctx, palette, table, asks);
    }

    /// Draws the banner with the demo's title and buttons. It is over the pattern pane, where it hides no body.
    fn banner_ui(&self, ctx: &egui::Context, palette: &Palette, table: Rect, asks: &mut Asks) {
        let area = Area::new(Id::unique("demo")).order(Order::Foreground).pivot(Align2::CENTER_TOP);
        area.fixed_pos(table.center_top() + Vec2::new(0.0, 10.0)).show(ctx, |ui| {
            Frame::popup(ui.style()).stroke(Stroke::new(1.0, palette.accent)).show(ui, |ui| {
                ui.set_max_width((table.width() - 40.0).clamp(120.0, 560.0));
                ui.horizontal(|ui| {
                    let name = tr(self.demo.name());
                    let title = match self.demo.figure() {
                        Some(figure) => say!("{name} · Figure {figure}", name, figure),
                        None => name.to_owned(),
                    };
                    ui.label(RichText::new(title).strong().size(14.5));
                    if ui.button(if self.ended { tr("Back to your work") } else { tr("Stop") }).clicked() {
                        asks.push(Ask::Act(Action::StopDemo));
                    }
                    if let Some(action) = next_action(self.demo).filter(|_| self.ended) {
                        let row = action.row();
                        if ui.button(tr(row.text)).on_hover_text(tr(row.tip)).clicked() {
                            asks.push(Ask::Act(action));
                        }
                    }
                    if self.ended && ui.button(tr("Again")).clicked() {
                        asks.push(Ask::Act(Action::Demo(self.demo)));
                    }
                    ui.label(RichText::new("Esc").color(palette.weak).size(12.0));
                });
                let next = self.demo.leads_to().filter(|_| self.ended);
                ui.label(RichText::new(tr(next.unwrap_or(self.demo.tells()))).color(palette.weak));
            });
        });
    }
}

/// The name of `demo` in quotes.
fn quoted(demo: Demo) -> String {
    format!("{:?}", tr(demo.name()))
}

/// What a person does next with what `demo` made, as [`Demo::leads_to`] tells.
fn next_action(demo: Demo) -> Option<Action> {
    match demo {
        Demo::Cutting => Some(Action::Marker),
        Demo::Export => Some(Action::Export),
        _ => None,
    }
}

/// Duration of the animation of `command` at its place, seconds.
fn length(command: &Command) -> f64 {
    match command {
        Command::AddClothMark { .. } | Command::AddBodyMark { .. } => 0.9,
        Command::SetPiecePose { .. } => 0.3,
        Command::Wrap | Command::Rewrap { .. } | Command::Undo => 0.9,
        Command::AddPin { .. } | Command::Grab { .. } => 0.25,
        Command::AddPiece { .. }
        | Command::EditPattern { .. }
        | Command::AddSeam { .. }
        | Command::ReplacePattern { .. }
        | Command::SetBody { .. }
        | Command::ChangeSize { .. }
        | Command::Repose { .. }
        | Command::Dress { .. }
        | Command::Sew
        | Command::SetFabric { .. }
        | Command::SetDye { .. }
        | Command::AddImage { .. }
        | Command::AddGraphic { .. }
        | Command::KeepColourway { .. }
        | Command::WearColourway { .. }
        | Command::SetDraping { .. } => 0.8,
        _ => 0.05,
    }
}

/// The words shown beside the hand during `command`.
fn words(command: &Command, session: &Session) -> String {
    let marks = &session.document().marks;
    match command {
        Command::AddClothMark { .. } => {
            say!("Mark {number} on the cloth", number = marks.cloth.len() + 1)
        }
        Command::AddBodyMark { .. } => say!("Mark {number} on the body", number = marks.body.len() + 1),
        Command::SetPiecePose { .. } => tr("Turn the piece over").to_owned(),
        Command::Wrap => tr("Wrap").to_owned(),
        Command::Rewrap { .. } => tr("Rewrap").to_owned(),
        Command::Undo => tr("Undo").to_owned(),
        Command::AddPin { .. } => tr("Pin").to_owned(),
        Command::Grab { mode: DragMode::Surface, .. } => tr("Drag along the skin").to_owned(),
        Command::Grab { mode: DragMode::Vertex, .. } => tr("Drag one point").to_owned(),
        Command::Grab { mode: DragMode::Rigid, .. } => tr("Drag rigidly").to_owned(),
        Command::AddPiece { .. } => tr("A new piece").to_owned(),
        Command::EditPattern { edits, .. } => edits.first().map_or("", edit_words).to_owned(),
        Command::AddSeam { .. } => tr("Sew a seam").to_owned(),
        Command::ReplacePattern { .. } => tr("Import a pattern").to_owned(),
        Command::SetBody { .. } => tr("Another body").to_owned(),
        Command::ChangeSize { .. } => tr("Another size").to_owned(),
        Command::Repose { .. } => tr("Another pose").to_owned(),
        Command::Dress { .. } => tr("Dress").to_owned(),
        Command::Sew => tr("Sew from placement").to_owned(),
        Command::SetFabric { .. } => tr("A fabric for all pieces").to_owned(),
        Command::SetDye { .. } => tr("Colour and print").to_owned(),
        Command::AddImage { .. } => tr("Take an image").to_owned(),
        Command::AddGraphic { .. } => tr("Place a graphic").to_owned(),
        Command::KeepColourway { name } => say!("Keep the colourway {name}", name),
        Command::WearColourway { name } => say!("Colourway {name}", name),
        Command::SetDraping { on: true } => tr("Drape").to_owned(),
        _ => String::new(),
    }
}

fn edit_words(edit: &PatternEdit) -> &'static str {
    match edit {
        PatternEdit::MovePoints { .. } | PatternEdit::MoveLinePoints { .. } => tr("Move points"),
        PatternEdit::AddDart { .. } => tr("Cut a dart"),
        PatternEdit::Duplicate { .. } => tr("Duplicate"),
        PatternEdit::Scale { .. } => tr("Make it wider"),
        PatternEdit::SetSizes { .. } => tr("Choose sizes"),
        PatternEdit::SetRules { .. } => tr("Rules for its points"),
        PatternEdit::AddButtons { .. } => tr("Sew on buttons"),
        PatternEdit::SetTopstitch { .. } => tr("Topstitching"),
        PatternEdit::SetHem { .. } => tr("Hem"),
        PatternEdit::SetAllowance { .. } => tr("Seam allowance"),
        PatternEdit::SetCorner { .. } => tr("Corner of the allowance"),
        PatternEdit::AddNotch { .. } => tr("Notch"),
        PatternEdit::SetGrainline { .. } => tr("Turn the grainline"),
        _ => "",
    }
}

/// The first fraction `share` of a stroke on the screen, at least its first point.
fn stroke(session: &Session, command: &Command, share: f64, stage: &Stage<'_>) -> Vec<Pos2> {
    let upto = |count: usize| 1 + (share * count.saturating_sub(1) as f64).round() as usize;
    match command {
        Command::AddClothMark { piece, points, .. } => {
            let Some(piece) = session.document().pattern.pieces.get(piece) else { return Vec::new() };
            let points = points.iter().take(upto(points.len()));
            points.map(|&p| on_table(stage, piece.pose.plane_from_piece(p))).collect()
        }
        Command::AddBodyMark { points } => {
            points.iter().take(upto(points.len())).filter_map(|&p| on_body(stage, p)).collect()
        }
        _ => Vec::new(),
    }
}

/// Where on the table an edit is made.
fn edited(edit: &PatternEdit, session: &Session, stage: &Stage<'_>) -> Option<Pos2> {
    let pattern = &session.document().pattern;
    let along = |edge: EdgeRef, at: f64| {
        let piece = pattern.pieces.get(&edge.piece)?;
        let is_there = edge.edge < piece.edge_count();
        let points = is_there.then(|| piece.edge_points(edge.edge, &[at]))?;
        Some((edge.piece, points.first().copied()))
    };
    let (id, at) = match edit {
        PatternEdit::MovePoints { points } => points.first().map(|(point, to)| (point.piece, Some(*to)))?,
        PatternEdit::MoveLinePoints { points } => {
            points.first().map(|(point, to)| (point.piece, Some(*to)))?
        }
        PatternEdit::AddDart { edge, .. } => (edge.piece, None),
        PatternEdit::Duplicate { pieces, .. }
        | PatternEdit::Scale { pieces, .. }
        | PatternEdit::SetAllowance { pieces, .. } => (*pieces.first()?, None),
        PatternEdit::SetRules { rules } => (rules.first()?.0.piece, None),
        PatternEdit::SetGrainline { piece, .. } => (*piece, None),
        PatternEdit::AddButtons { buttons } => {
            buttons.first().map(|b| (b.button.piece, Some(b.button.at)))?
        }
        PatternEdit::AddNotch { edge, at } => along(*edge, *at)?,
        PatternEdit::SetCorner { point, .. } => {
            along(EdgeRef { piece: point.piece, edge: point.point }, 0.0)?
        }
        PatternEdit::SetTopstitch { lines, .. } | PatternEdit::SetHem { lines, .. } => match lines.first()? {
            TrimLine::Edge(edge) => along(*edge, 0.5)?,
            TrimLine::Line { piece, .. } => (*piece, None),
        },
        _ => return None,
    };
    let piece = pattern.pieces.get(&id)?;
    let line = piece.flattened(0.01);
    let middle = || line.iter().sum::<DVec2>() / line.len() as f64;
    Some(on_table(stage, piece.pose.plane_from_piece(at.unwrap_or_else(middle))))
}

fn on_table(stage: &Stage<'_>, p: DVec2) -> Pos2 {
    stage.table.1.screen_from_table(stage.table.0, p)
}

fn on_body(stage: &Stage<'_>, p: DVec3) -> Option<Pos2> {
    let size = glam::Vec2::new(stage.scene.width().max(1.0), stage.scene.height().max(1.0));
    let seen = stage.camera.project(p.as_vec3(), size)?;
    Some(stage.scene.min + Vec2::new(seen.pixel.x, seen.pixel.y))
}

/// Draws the hand as a ring, filled while the button is down, with the words of what it does.
fn hand_ui(painter: &Painter, at: Pos2, is_down: bool, deed: &str, palette: &Palette) {
    painter.circle_stroke(at, RING, Stroke::new(4.5, palette.halo));
    painter.circle_stroke(at, RING, Stroke::new(2.2, palette.accent));
    if is_down {
        painter.circle_filled(at, RING - 4.0, palette.accent);
    }
    if deed.is_empty() {
        return;
    }
    let font = FontId::proportional(13.5);
    let text = painter.layout_no_wrap(deed.to_owned(), font, palette.on_accent);
    let room = Rect::from_min_size(at + Vec2::new(RING + 8.0, -text.size().y / 2.0), text.size());
    painter.rect_filled(room.expand2(Vec2::new(7.0, 4.0)), 5.0, palette.accent);
    painter.galley(room.min, text, palette.on_accent);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_demo_leads_to_is_a_button_with_the_name_that_is_told() {
        for demo in Demo::ALL {
            let Some(action) = next_action(demo) else {
                assert_eq!(demo.leads_to(), None, "{demo:?}");
                continue;
            };
            let row = action.row();
            let name = format!("{} › {}", row.menu, row.text);
            assert!(demo.leads_to().is_some_and(|words| words.starts_with(&name)), "{demo:?}: {name}");
            assert!(row.in_demos, "{demo:?}: {name} could not be chosen");
        }
    }

    #[test]
    fn there_are_ten_walks() {
        assert_eq!(Demo::ALL.iter().filter(|demo| demo.is_walk()).count(), 10);
    }
}
