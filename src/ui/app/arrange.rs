//! Lays out the panels and panes of one frame, and collects the state they show.

use std::sync::Arc;

use egui::{Frame, Margin, Panel};

use crate::pattern::Pattern;
use crate::session::Document;
use crate::sim::Snapshot;
use crate::ui::actions::asks::Asks;
use crate::ui::actions::context::FrameContext;
use crate::ui::actions::layout::{Layout, Panes};
use crate::ui::actions::picked::Picked;
use crate::ui::actions::{PATTERN_TOOLS, Tool};
use crate::ui::app::App;
use crate::ui::app::focus_round::Bar;
use crate::ui::body_pane::{self, Graphics};
use crate::ui::language::{said, say, tr};
use crate::ui::look::theme::Palette;
use crate::ui::panels::context::PanelContext;
use crate::ui::panels::side;
use crate::ui::pattern_pane::Laid;
use crate::ui::pointer::mouse::Mouse;
use crate::ui::preferences::page::points_per_metre;
use crate::ui::preferences::units::LengthUnit;
use crate::ui::selection::Item;
use crate::ui::shell::menu;
use crate::ui::shell::pace::Work;
use crate::ui::shell::status;
use crate::ui::shell::toolbar;
use crate::wrap::Phase;

impl App {
    pub(in crate::ui) fn panels(
        &mut self,
        ui: &mut egui::Ui,
        document: &Document,
        snapshot: &Snapshot,
        now: &FrameContext,
        palette: &Palette,
        asks: &mut Asks,
    ) {
        let bar = |ui: &egui::Ui, y: i8| {
            Frame::new().fill(ui.visuals().panel_fill).inner_margin(Margin::symmetric(10, y))
        };
        let (thin, thick) = (bar(ui, 3), bar(ui, 6));
        let surface = self.shown().surface().cloned();
        let lost = self.shown().problems().to_vec();
        let menu = Panel::top("menu").frame(thin).show_separator_line(false);
        let menu = menu.show(ui, |ui| menu::menu_bar_ui(ui, now, asks));
        self.shell.round.show(Bar::Menu, menu.response.rect);
        let tools = Panel::top("tools").frame(thick).show(ui, |ui| {
            self.shell.first_tool = toolbar::toolbar_ui(ui, now, palette, asks);
        });
        self.shell.round.show(Bar::Toolbar, tools.response.rect);
        Panel::bottom("status").frame(thin).exact_size(status::HEIGHT).show(ui, |ui| {
            let hint = self.hint(ui.ctx(), document, now, palette);
            status::status_ui(ui, now, &hint, palette);
        });
        // Here, since the table may be hidden.
        self.pattern_pane.nests.update(&document.pattern);
        self.shell.first_of_panel = None;
        self.shell.pose.animation.play(ui.ctx(), document, now, asks);
        if self.show_panel {
            let side = Panel::right("side").default_size(256.0).size_range(220.0..=420.0).frame(thick);
            let side = side.show(ui, |ui| {
                let told = PanelContext {
                    document,
                    surface: surface.as_ref(),
                    snapshot,
                    selection: &self.picks.selection,
                    problems: &snapshot.problems,
                    verdict: snapshot.verdict.as_ref().map_or(&[], |found| found),
                    lost: &lost,
                    now,
                    sizes: self.shell.size_view,
                    nests: &self.pattern_pane.nests,
                    palette,
                };
                let (marks, pattern) = (&mut self.marks_panel, &mut self.pattern_panel);
                let pattern = (pattern, &mut self.shell.sizes);
                let of_body = (&mut self.shell.pose, &mut self.shell.tape);
                let first = side::side_panel_ui(ui, &told, marks, pattern, of_body, asks);
                self.shell.first_of_panel = first;
            });
            self.shell.round.show(Bar::Side, side.response.rect);
        }
        self.drawer_panel(ui, now, palette, asks);
        self.panes(ui, document, snapshot, now, palette, asks);
    }

    pub(in crate::ui) fn laid<'a>(
        &'a self,
        document: &'a Document,
        now: &'a FrameContext,
        palette: &'a Palette,
    ) -> Laid<'a> {
        Laid {
            document,
            tool: now.tool,
            mouse: now.mouse,
            laser: now.laser,
            selected: now.selected.map(|(mark, _)| mark),
            selection: &self.picks.selection,
            highlight: now.highlight,
            spot: self.spot(),
            points_per_metre: now.points_per_metre,
            unit: now.unit,
            sizes: self.shell.size_view,
            snapping: self.snapping,
            ghosts: self.ghosts.as_ref().map(|g| &*g.marks),
            map: self.shell.maps.shown(),
            palette,
        }
    }

    fn hint(
        &self,
        ctx: &egui::Context,
        document: &Document,
        now: &FrameContext,
        palette: &Palette,
    ) -> String {
        let mouse = now.mouse;
        let next = |painted: usize| painted + 1;
        if self.demo.is_some() {
            tr("A demo is shown. Drag: turn · Wheel: zoom · Esc: back to your work").to_owned()
        } else if self.ghosts.is_some() {
            tr("Proposed marks: Enter takes them, Esc forgets them.").to_owned()
        } else if let Some(words) = self.scene_pane.hint_by_keys(self.tool, next(document.marks.body.len())) {
            words
        } else if let Some(words) = self.scene_pane.hint_of_line(mouse) {
            words
        } else if let Some(words) = self.pattern_pane.hint_by_keys(ctx).filter(|_| !self.scene_pane.hovered) {
            words.to_owned()
        } else if self.pattern_pane.hovered || self.pattern_pane.is_busy() {
            self.pattern_pane.hint(&self.laid(document, now, palette))
        } else if self.scene_pane.hovered {
            let words =
                body_pane::hint(self.tool, mouse, self.laser, now.dressed, next(document.marks.body.len()));
            let edge = now.highlight.and_then(|item| edge_words(&document.pattern, item, now.unit));
            // A tool of the table does nothing to the cloth.
            let is_of_table = PATTERN_TOOLS.iter().any(|group| group.contains(&self.tool));
            let next = (now.dressed && is_of_table).then(|| status::next_step(ctx, now));
            edge.into_iter().chain(next).chain([words]).collect::<Vec<_>>().join(" · ")
        } else {
            status::next_step(ctx, now)
        }
    }

    /// Which panes are shown, and where. Demos and the tour refer to both.
    fn layout(&self) -> Layout {
        match self.demo.is_some() || self.shell.tour.is_some() {
            true => Layout { panes: Panes::Both, ..self.preferences.layout },
            false => self.preferences.layout,
        }
    }

    pub(in crate::ui) fn situation(
        &mut self,
        ctx: &egui::Context,
        document: &Document,
        snapshot: &Snapshot,
    ) -> FrameContext {
        let [undo, redo] = self.shown().next_labels().map(|label| label.map(said));
        let asked = self.has_asked_for_wrap(snapshot);
        let work = match snapshot.phase {
            _ if snapshot.dragged.is_some() => Some(Work::Hand),
            _ if snapshot.trying.is_some() => Some(Work::Dressing),
            Some(Phase::Growing) => Some(Work::Growing),
            Some(Phase::Settling) => Some(Work::Settling),
            _ => None,
        };
        let work = work.filter(|_| snapshot.working).map(|work| (work, snapshot.progress));
        let pace = self.pacer.frame(ctx.input(|i| i.time), self.frames, snapshot.tick, work);
        FrameContext {
            pace,
            undo,
            redo,
            // In a demo the mouse only moves the view.
            tool: if self.demo.is_some() { Tool::Move } else { self.tool },
            mouse: if self.demo.is_some() { Mouse::Clo } else { self.preferences.mouse },
            paper: self.preferences.paper,
            laser: self.laser,
            picked: Picked::new(&document.pattern, &self.picks.selection),
            sewn: !document.pattern.seams.is_empty(),
            twisted: self.pattern_pane.has_twisted(),
            snapping: self.snapping,
            highlight: self.highlight(),
            points_per_metre: points_per_metre(ctx, self.preferences.screen),
            unit: self.preferences.unit,
            selected: self.selected.and_then(|mark| Some((mark, document.marks.place(mark)?))),
            sizes: !document.pattern.sizes.is_empty(),
            pieces: document.pattern.pieces.len(),
            marks: [document.marks.cloth.len(), document.marks.body.len()],
            pins: document.pins.len(),
            proposed: self.ghosts.as_ref().map_or(0, |g| g.marks.pairs().count()),
            has_body: self.shown().surface().is_some(),
            has_joints: document.body.measurements().is_some(),
            demo: self.demo.is_some(),
            dressed: snapshot.is_dressed(),
            wrapped: self.shown().can_cancel_wrap(),
            wrapping: self.is_wrapping(snapshot),
            stops: self.stoppable(snapshot),
            trying: snapshot.trying,
            working: asked || snapshot.working,
            caught_up: self.shown().is_caught_up(),
            dragging: snapshot.dragged.is_some(),
            relaxing: snapshot.relaxing,
            placed: document.pattern.pieces.values().any(|piece| piece.placement.is_some()),
            carried: snapshot.is_carried,
            drape: snapshot.drape,
            phase: snapshot.phase,
            progress: snapshot.progress,
            tick: snapshot.tick,
            triangles: snapshot.garment.as_ref().map_or(0, |g| g.triangles.len()),
            layout: self.layout(),
            has_file: self.path.is_some(),
            show_cloth: self.show_cloth,
            show_panel: self.show_panel,
            parallel: self.scene_pane.camera.projection == crate::render::Projection::Orthographic,
            free_turning: self.scene_pane.free_turning,
            theme: self.preferences.theme,
            keymap: Arc::clone(&self.preferences.keymap),
            recent: Arc::clone(self.shell.recent.files()),
            sight: self.shell.sight,
            blurs: self.scene_pane.graphics.as_ref().is_none_or(Graphics::blurs),
            keeps_environment: self.preferences.lighting.environment.is_some(),
            rotating: self.shell.environment.is_rotated,
            sets_aperture: self.shell.sets_aperture,
            drawer: self.shell.drawer,
            map: self.shell.maps.kind(),
            difference: self.shell.maps.beside().map(|beside| beside.difference),
            adapter: self.scene_pane.graphics.as_ref().map(|g| g.adapter_name().to_owned()),
            picturing: self.shell.is_picturing(),
        }
    }
}

/// Name and length of the edge `item`, in words.
fn edge_words(pattern: &Pattern, item: Item, unit: LengthUnit) -> Option<String> {
    let Item::Edge(edge) = item else { return None };
    let piece = pattern.pieces.get(&edge.piece).filter(|piece| edge.edge < piece.edge_count())?;
    Some(say!(
        "{piece}, edge {number}: {length}",
        piece = piece.name,
        number = edge.edge + 1,
        length = unit.text(piece.edge_length(edge.edge))
    ))
}
