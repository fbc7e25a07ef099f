//! The section of body measurements, with those of the garment at the same places.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};

use egui::{Grid, Label, RichText};

use crate::body::Surface;
use crate::body::readings::{Reading, round_at};
use crate::fit::{Girth, girth, girths};
use crate::session::body::readings_of;
use crate::session::{BodyChoice, Outfit};
use crate::ui::actions::asks::Asks;
use crate::ui::language::{say, tr};
use crate::ui::panels::context::PanelContext;
use crate::ui::panels::fields::length_field;
use crate::ui::panels::size::SizePanel;

/// Measurements of the body, computed on a separate thread when they are first shown, and of the garment when it is at rest.
#[derive(Debug, Default)]
pub struct TapePanel {
    /// Sizes that the body can be built to.
    pub sizes: SizePanel,
    of: Option<Arc<Surface>>,
    coming: Option<Receiver<Option<Vec<Reading>>>>,
    read: Option<Vec<Reading>>,
    garment: Option<Measured>,
    chosen: Chosen,
}

/// A garment at rest and its girths, each with the index of the body's girth in the readings.
#[derive(Debug)]
struct Measured {
    outfit: Outfit,
    coming: Option<Receiver<Vec<(usize, Girth)>>>,
    girths: Vec<(usize, Girth)>,
}

/// A height chosen by the user, metres above the floor, and the girths of body and garment measured there.
#[derive(Debug, Default)]
struct Chosen {
    height: f64,
    read: Option<(f64, Option<Reading>, Option<Girth>)>,
}

impl TapePanel {
    /// Draws the section.
    pub fn ui(&mut self, ui: &mut egui::Ui, told: &PanelContext<'_>, asks: &mut Asks) {
        self.sizes.ui(ui, told, asks);
        let Some(surface) = told.surface else { return };
        if !self.of.as_ref().is_some_and(|of| Arc::ptr_eq(of, surface)) {
            self.begin(ui.ctx().clone(), surface, told.document.body.clone());
        }
        if let Some(read) = self.coming.as_ref().and_then(|coming| coming.try_recv().ok()) {
            (self.read, self.coming) = (read, None);
        }
        self.look_at_garment(ui.ctx(), told);
        let weak = |words: &str| Label::new(RichText::new(words).color(told.palette.weak)).wrap();
        match (&self.read, &self.coming) {
            (Some(read), _) => {
                let worn = self.garment.as_ref();
                let columns = if worn.is_some() { 4 } else { 2 };
                Grid::new("tape").num_columns(columns).striped(true).spacing([12.0, 2.0]).show(ui, |ui| {
                    if worn.is_some() {
                        for heading in ["", "Body", "Pattern", "Ease"] {
                            ui.add(weak(tr(heading)));
                        }
                        ui.end_row();
                    }
                    for (i, reading) in read.iter().enumerate() {
                        let round = worn.and_then(|worn| worn.girths.iter().find(|(at, _)| *at == i));
                        row_ui(ui, told, reading, round.map(|(_, girth)| girth));
                        ui.end_row();
                    }
                });
                if worn.is_some() {
                    self.chosen_ui(ui, told);
                }
            }
            (None, Some(_)) => _ = ui.add(weak(tr("Measuring…"))),
            (None, None) => _ = ui.add(weak(tr("It does not look like a standing human."))),
        }
    }

    /// Draws the girth of body and garment at a chosen height.
    fn chosen_ui(&mut self, ui: &mut egui::Ui, told: &PanelContext<'_>) {
        let (Some(read), Some(worn), Some(surface)) = (&self.read, &self.garment, &self.of) else { return };
        let Some(hip) = read.iter().find(|r| r.name == "hip").and_then(|hip| hip.tape.as_ref()) else {
            return;
        };
        let chosen = &mut self.chosen;
        let tall = read.first().map_or(2.0, |height| height.metres);
        if chosen.height == 0.0 {
            let waist = read.iter().find(|r| r.name == "waist").and_then(|waist| waist.height);
            chosen.height = waist.unwrap_or(0.6 * tall);
        }
        ui.horizontal(|ui| {
            let label = ui.label(tr("Round the trunk at")).on_hover_text(tr("Height above the floor"));
            let typed = length_field(ui, "tape height", &label, chosen.height, told.now.unit);
            chosen.height = typed.map_or(chosen.height, |typed| typed.clamp(0.0, tall));
        });
        if chosen.read.as_ref().is_none_or(|(at, ..)| *at != chosen.height) {
            let body = round_at(&surface.mesh, chosen.height, hip.origin.x);
            let tape = body.as_ref().and_then(|body| body.tape.as_ref());
            let round = tape.and_then(|tape| girth(&worn.outfit.garment, &worn.outfit.state, tape, &[]));
            chosen.read = Some((chosen.height, body, round));
        }
        let Some((_, body, round)) = &chosen.read else { return };
        match body {
            Some(body) => {
                Grid::new("tape anywhere").num_columns(4).spacing([12.0, 2.0]).show(ui, |ui| {
                    row_ui(ui, told, body, round.as_ref());
                    ui.end_row();
                });
            }
            None => _ = ui.label(RichText::new(tr("There is no trunk.")).color(told.palette.weak)),
        }
    }

    /// Measures the garment when it has come to rest in a new state.
    fn look_at_garment(&mut self, ctx: &egui::Context, told: &PanelContext<'_>) {
        let rests = !told.snapshot.working && self.read.is_some();
        let outfit = Outfit::of(told.snapshot, &told.document.fabrics)
            .filter(|outfit| rests && self.of.as_ref().is_some_and(|of| Arc::ptr_eq(of, &outfit.body)));
        let (Some(outfit), Some(read)) = (outfit, &self.read) else {
            (self.garment, self.chosen.read) = (None, None);
            return;
        };
        if !self.garment.as_ref().is_some_and(|known| known.outfit.is(&outfit)) {
            let (send, coming) = channel();
            let (ctx, cloth, read) = (ctx.clone(), outfit.clone(), read.clone());
            let work = move || {
                send.send(girths(&cloth.garment, &cloth.state, &read)).ok();
                ctx.request_repaint();
            };
            let begun = std::thread::Builder::new().name("tape".to_owned()).spawn(work).is_ok();
            self.chosen.read = None;
            self.garment = Some(Measured { outfit, coming: begun.then_some(coming), girths: Vec::new() });
        }
        if let Some(garment) = &mut self.garment
            && let Some(girths) = garment.coming.as_ref().and_then(|coming| coming.try_recv().ok())
        {
            (garment.girths, garment.coming) = (girths, None);
        }
    }

    fn begin(&mut self, ctx: egui::Context, surface: &Arc<Surface>, choice: BodyChoice) {
        let (send, coming) = channel();
        let body = Arc::clone(surface);
        let work = move || {
            // Sending fails if the window was closed or the body has changed.
            send.send(readings_of(&choice, &body.mesh)).ok();
            ctx.request_repaint();
        };
        let begun = std::thread::Builder::new().name("tape".to_owned()).spawn(work).is_ok();
        (self.of, self.coming, self.read) = (Some(Arc::clone(surface)), begun.then_some(coming), None);
        self.chosen = Chosen::default();
    }
}

/// Draws a row: name, girth of the body, and where cloth goes all the way round, that of the pattern and its ease.
fn row_ui(ui: &mut egui::Ui, told: &PanelContext<'_>, reading: &Reading, round: Option<&Girth>) {
    let Reading { name, metres, height, .. } = reading;
    // Body measurements are rounded to the millimetre.
    let text = |metres: f64| told.now.unit.text((metres * 1e3).round() / 1e3);
    let label = ui.label(tr(name));
    if let Some(height) = height {
        label.on_hover_text(say!("{height} above the floor", height = text(*height)));
    }
    ui.label(text(*metres));
    if let Some(round) = round {
        let worn = say!("As it lies: {girth}", girth = text(round.worn));
        ui.label(text(round.flat)).on_hover_text(worn);
        let ease = round.flat - metres;
        let sign = if ease > 0.0 { "+" } else { "" };
        ui.label(RichText::new(format!("{sign}{}", text(ease))).strong());
    }
}
