//! Lays out the two panes: which of them are shown, and which is on the left.

use std::sync::Arc;

use egui::{CentralPanel, Frame, Panel};

use crate::body::Surface;
use crate::contact::Bone;
use crate::session::Document;
use crate::sim::Snapshot;
use crate::ui::actions::Tool;
use crate::ui::actions::asks::Asks;
use crate::ui::actions::context::FrameContext;
use crate::ui::actions::layout::{Layout, Panes};
use crate::ui::app::App;
use crate::ui::body_pane::Seen;
use crate::ui::body_pane::pair_lines::pair_lines_ui;
use crate::ui::look::theme::{self, Palette};
use crate::ui::maps;
use crate::ui::pattern_pane;
use crate::ui::selection::Item;
use crate::ui::shell::menu;

/// Width of the window (points) below which the panes share it evenly.
const NARROW: f32 = 500.0;

/// The state that both panes show.
struct PaneContents<'a> {
    document: &'a Document,
    snapshot: &'a Snapshot,
    now: &'a FrameContext,
    palette: &'a Palette,
    bones: &'a [Bone],
}

impl App {
    /// Draws the panes in the remaining area of the window.
    pub(in crate::ui) fn panes(
        &mut self,
        ui: &mut egui::Ui,
        document: &Document,
        snapshot: &Snapshot,
        now: &FrameContext,
        palette: &Palette,
        asks: &mut Asks,
    ) {
        // The bones are computed only while they are edited.
        let on_bones = now.tool == Tool::Bone && !now.demo;
        let bones = if on_bones { self.session.bones() } else { Arc::default() };
        if now.tool == Tool::Place && !now.demo {
            let (surface, bones) = (self.body_shown(snapshot), self.session.bones());
            self.shell.placing.update(document, surface.as_ref(), &bones);
        }
        let with = PaneContents { document, snapshot, now, palette, bones: &bones };
        let Layout { panes, swapped } = now.layout;
        if panes == Panes::Both {
            // Each order of the panes and a narrow window keep a width of their own.
            let width = ui.available_width();
            let (id, share) = match (swapped, width < NARROW) {
                (false, false) => ("table", 0.46),
                (true, false) => ("body first", 0.54),
                (_, true) => ("narrow", 0.5),
            };
            let least = (width - 200.0).max(160.0);
            let left =
                Panel::left(id).frame(Frame::new()).default_size(width * share).size_range(160.0..=least);
            left.show(ui, |ui| self.pane_ui(ui, swapped, &with, asks));
        } else {
            self.hide_pane(panes == Panes::Body);
        }
        let last_is_body = if panes == Panes::Both { !swapped } else { panes == Panes::Body };
        CentralPanel::default().frame(Frame::new()).show(ui, |ui| {
            self.pane_ui(ui, last_is_body, &with, asks);
            if panes == Panes::Both && self.shell.sight.pairs {
                let surface = self.body_shown(snapshot);
                pair_lines_ui(
                    ui,
                    &self.seen(&with, surface.as_ref(), &[]),
                    &self.pattern_pane,
                    &self.scene_pane,
                );
            }
        });
    }

    fn pane_ui(&mut self, ui: &mut egui::Ui, body: bool, with: &PaneContents<'_>, asks: &mut Asks) {
        if body { self.body_ui(ui, with, asks) } else { self.table_ui(ui, with, asks) }
    }

    /// Marks a hidden pane as having no pointer over it; a line that is drawn on the cloth is given up.
    fn hide_pane(&mut self, table: bool) {
        if table {
            let pane = &mut self.pattern_pane;
            (pane.hovered, pane.area, pane.id, pane.under) = (false, None, None, None);
            pane.bars = [None; 2];
        } else {
            let pane = &mut self.scene_pane;
            pane.give_up_line();
            (pane.hovered, pane.area, pane.id, pane.under) = (false, None, None, None);
        }
    }

    fn table_ui(&mut self, ui: &mut egui::Ui, with: &PaneContents<'_>, asks: &mut Asks) {
        let PaneContents { document, now, palette, .. } = *with;
        let mut pane = std::mem::take(&mut self.pattern_pane);
        pane.ui(ui, &self.laid(document, now, palette), asks);
        self.pattern_pane = pane;
        if let Some(response) = self.pattern_pane.response.take() {
            response.context_menu(|ui| menu::context_ui(ui, now, asks));
        }
        if document.pattern.pieces.is_empty() && matches!(now.tool, Tool::Mark | Tool::Move) {
            let area = ui.max_rect().shrink2(egui::vec2(20.0, ui.max_rect().height() * 0.36));
            ui.scope_builder(egui::UiBuilder::new().max_rect(area), |ui| {
                pattern_pane::empty_ui(ui, asks);
            });
        }
    }

    fn body_ui(&mut self, ui: &mut egui::Ui, with: &PaneContents<'_>, asks: &mut Asks) {
        let stand_out = self.picks.standing_out(with.now.highlight);
        let surface = self.body_shown(with.snapshot);
        let mut pane = std::mem::take(&mut self.scene_pane);
        pane.ui(ui, &self.seen(with, surface.as_ref(), &stand_out), asks);
        self.scene_pane = pane;
        if let (Some(map), Some(pane)) = (self.shell.maps.shown(), self.scene_pane.area) {
            let value = self.scene_pane.value.or(self.pattern_pane.value);
            maps::legend_ui(ui, (pane, self.scene_pane.buttons), map, value, with.palette, asks);
        }
        match (self.shell.maps.opening(), self.shell.maps.beside(), self.scene_pane.area) {
            (Some(opening), _, Some(pane)) => maps::opening_ui(ui, pane, opening, with.palette, asks),
            (None, Some(beside), Some(pane)) => {
                let placed = (beside, self.shell.maps.is_on_the_left());
                maps::beside_ui(ui, pane, placed, with.palette, asks);
            }
            _ => {}
        }
    }

    /// The body to show: while the cloth has not followed to another pose yet, and while it is put on in another, the body in the pose
    /// that the cloth has.
    fn body_shown(&self, snapshot: &Snapshot) -> Option<Arc<Surface>> {
        let shown = self.shown();
        let has_other = snapshot.seq < shown.last_seq() || snapshot.trying.is_some();
        snapshot.body.as_ref().filter(|_| snapshot.is_dressed() && has_other).or(shown.surface()).cloned()
    }

    fn seen<'a>(
        &'a self,
        with: &PaneContents<'a>,
        body: Option<&'a Arc<Surface>>,
        stand_out: &'a [Item],
    ) -> Seen<'a> {
        let PaneContents { document, snapshot, now, palette, bones } = *with;
        let selection = &self.picks.selection;
        let places = (now.tool == Tool::Place && !now.demo).then(|| self.shell.placing.places(selection));
        let beside = self.shell.maps.beside().and_then(|beside| beside.meshes());
        Seen {
            document,
            body,
            cloth: snapshot.drawn().filter(|_| self.show_cloth && snapshot.is_dressed() && places.is_none()),
            whole: snapshot.garment.as_ref().map(|garment| (garment, &snapshot.cloth)),
            pinned: &snapshot.pinned,
            dragged: snapshot.dragged.as_ref(),
            map: self.shell.maps.shown(),
            beside: places.map(|places| places.standing.meshes()).or(beside),
            growing: now.wrapping,
            working: now.working,
            tool: now.tool,
            mouse: now.mouse,
            unit: now.unit,
            snapping: now.snapping,
            laser: self.laser,
            selected: now.selected.map(|(mark, _)| mark),
            bones,
            places,
            selected_pins: &self.picks.selection.pins,
            stand_out,
            spot: self.spot(),
            ghosts: self.ghosts.as_ref().map(|g| &g.marks),
            look: self.shell.sight.on(theme::look(self.scheme)),
            body_look: self.shell.sight.body_look,
            plain_seams: self.shell.sight.plain_seams,
            palette,
        }
    }
}
