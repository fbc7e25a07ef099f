//! The Marker window: all pieces laid out on a width of cloth behind it, shown, and written.

use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::time::Duration;

use egui::{Button, Grid, Id, Modal, RichText, ScrollArea};

use crate::geometry::words::Words;
use crate::io::pdf::Paper;
use crate::marker::nest::Watch;
use crate::marker::{FinishedMarker, MOST_PIECES, MarkerError, MarkerFormat, Order};
use crate::pattern::Pattern;
use crate::ui::app::App;
use crate::ui::app::marker_preview::Preview;
use crate::ui::files::{self, Purpose};
use crate::ui::language::fields::drag_value;
use crate::ui::language::{number, said, say, tr};
use crate::ui::look::theme::Palette;
use crate::ui::panels::fields::length_field;
use crate::ui::preferences::units::LengthUnit;

/// Width of the column of options, points.
const OPTIONS: f32 = 250.0;
/// Largest width of the window, points.
const WIDEST: f32 = 1120.0;
/// Time between two looks at the progress.
const LOOK: Duration = Duration::from_millis(80);

/// The open window.
#[derive(Debug)]
pub struct MarkerPage {
    /// Name of the project, for the report.
    name: String,
    /// The pattern as it was when the window was opened.
    pattern: Arc<Pattern>,
    /// What is laid out next.
    order: Order,
    work: Option<Work>,
    shown: Option<Shown>,
    /// Why there is no marker, in words.
    error: Option<String>,
}

/// A marker in the making. Dropping it stops it.
#[derive(Debug)]
struct Work {
    watch: Arc<Watch>,
    coming: Receiver<Result<FinishedMarker, MarkerError>>,
}

impl Drop for Work {
    fn drop(&mut self) {
        self.watch.stop();
    }
}

/// The marker that is shown.
#[derive(Debug)]
struct Shown {
    made: FinishedMarker,
    preview: Preview,
}

/// The user's answer to the window.
enum Answer {
    None,
    Close,
    Make,
    Cancel,
    Save(MarkerFormat),
}

/// What the window shows itself by.
#[derive(Clone, Copy)]
struct Look<'a> {
    palette: &'a Palette,
    unit: LengthUnit,
    paper: Paper,
}

impl MarkerPage {
    /// The window on `pattern` with the options that were used last.
    fn new(name: String, pattern: Arc<Pattern>, last: &Order) -> Self {
        let order = Order { garments: garments(&pattern, last), ..last.clone() };
        Self { name, pattern, order, work: None, shown: None, error: None }
    }

    /// Begins to lay out what is ordered.
    fn begin(&mut self, ctx: &egui::Context) {
        let (name, pattern, order) = (self.name.clone(), Arc::clone(&self.pattern), self.order.clone());
        let watch = Arc::<Watch>::default();
        let (send, coming) = channel();
        let (watched, ctx) = (Arc::clone(&watch), ctx.clone());
        let work = move || {
            // Sending fails if the window was closed.
            send.send(FinishedMarker::new(&name, &pattern, &order, &watched)).ok();
            ctx.request_repaint();
        };
        self.error = None;
        match std::thread::Builder::new().name("marker".to_owned()).spawn(work) {
            Ok(_) => self.work = Some(Work { watch, coming }),
            Err(why) => self.error = Some(say!("The marker cannot be made: {why}", why)),
        }
    }

    /// Takes the marker once it is made.
    fn take(&mut self, unit: LengthUnit) {
        let Some(work) = self.work.take() else { return };
        match work.coming.try_recv() {
            Err(TryRecvError::Empty) => self.work = Some(work),
            Err(TryRecvError::Disconnected) => {
                self.error = Some(tr("The marker could not be made").to_owned());
            }
            Ok(Err(why)) => {
                let words = said(&why.words_by(&|metres| Words::plain(unit.text(metres))));
                (self.error, self.shown) = (Some(say!("There is no marker: {words}", words)), None);
            }
            Ok(Ok(made)) => {
                let preview = Preview::new(&made.marker);
                self.shown = Some(Shown { made, preview });
            }
        }
    }

    fn ui(&mut self, ctx: &egui::Context, look: Look<'_>) -> Answer {
        let room = ctx.content_rect().size() - egui::vec2(72.0, 60.0);
        let size = egui::vec2(room.x.clamp(560.0, WIDEST), (room.y - 110.0).clamp(240.0, 560.0));
        let shown = Modal::new(Id::unique("marker")).show(ctx, |ui| {
            ui.set_width(size.x);
            ui.heading(tr("Marker"));
            ui.add_space(6.0);
            let mut answer = Answer::None;
            ui.horizontal_top(|ui| {
                ui.allocate_ui(egui::vec2(OPTIONS, size.y), |ui| {
                    ui.vertical(|ui| {
                        ui.set_width(OPTIONS);
                        let most = size.y - 48.0;
                        ScrollArea::vertical().max_height(most).show(ui, |ui| self.options_ui(ui, look.unit));
                        ui.add_space(8.0);
                        answer = self.work_ui(ui, look.palette);
                    });
                });
                ui.add_space(6.0);
                ui.vertical(|ui| self.result_ui(ui, size.y, look));
            });
            ui.add_space(10.0);
            ui.horizontal(|ui| {
                if let Some(format) = self.save_ui(ui, look.paper) {
                    answer = Answer::Save(format);
                }
                ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                    if ui.button(tr("Close")).clicked() {
                        answer = Answer::Close;
                    }
                });
            });
            answer
        });
        if shown.should_close() { Answer::Close } else { shown.inner }
    }

    fn options_ui(&mut self, ui: &mut egui::Ui, unit: LengthUnit) {
        let has_sizes = !self.pattern.sizes.is_empty();
        let order = &mut self.order;
        Grid::new("marker options").num_columns(2).spacing([14.0, 7.0]).show(ui, |ui| {
            let label = ui.label(tr("Width of the cloth"));
            let label = label.on_hover_text(tr("What can be used of it, without the selvedges"));
            order.width = length_field(ui, "width", &label, order.width, unit).unwrap_or(order.width);
            ui.end_row();
            for (size, count) in &mut order.garments {
                let words = match has_sizes {
                    true => say!("Garments in size {size}", size),
                    false => tr("Garments").to_owned(),
                };
                let label = ui.label(words);
                ui.add(drag_value(count).range(0..=MOST_PIECES)).labelled_by(label.id);
                ui.end_row();
            }
            let label = ui.label(tr("Gap"));
            let label = label.on_hover_text(tr("Least distance between pieces"));
            order.gap = length_field(ui, "gap", &label, order.gap, unit).unwrap_or(order.gap);
            ui.end_row();
            let label = ui.label(tr("Tilt"));
            let label = label.on_hover_text(tr("By how much pieces may also lie out of the grain"));
            let mut degrees = order.tilt.to_degrees();
            let value = drag_value(&mut degrees).range(0.0..=45.0).speed(0.1).max_decimals(1).suffix("°");
            if ui.add(value).labelled_by(label.id).changed() {
                order.tilt = degrees.to_radians();
            }
            ui.end_row();
            let label = ui.label(tr("Search"));
            let label = label
                .on_hover_text(tr("How long to look for a shorter layout: longer finds some percent more"));
            let value = drag_value(&mut order.effort.seconds);
            ui.add(value.range(0.0..=600.0).speed(0.1).max_decimals(1).suffix(" s")).labelled_by(label.id);
            ui.end_row();
        });
        ui.add_space(2.0);
        let tip = tr("For velvet, fur or a one-way print. Otherwise pieces may be turned by 180 degrees");
        ui.checkbox(&mut order.nap, tr("Nap: all pieces point one way")).on_hover_text(tip);
    }

    /// The button that begins, or the progress with the button that stops it.
    fn work_ui(&self, ui: &mut egui::Ui, palette: &Palette) -> Answer {
        let Some(work) = &self.work else {
            let words = if self.shown.is_some() { tr("Make it again") } else { tr("Make the marker") };
            let button = Button::new(RichText::new(words).color(palette.on_accent)).fill(palette.accent);
            return if ui.add(button).clicked() { Answer::Make } else { Answer::None };
        };
        ui.ctx().request_repaint_after(LOOK);
        ui.horizontal(|ui| {
            let bar = egui::ProgressBar::new(work.watch.share() as f32).fill(palette.accent);
            ui.add(bar.desired_width(OPTIONS - 90.0).desired_height(8.0));
            let button = ui.button(tr("Cancel")).on_hover_text(tr("Stop making this marker"));
            if button.clicked() { Answer::Cancel } else { Answer::None }
        })
        .inner
    }

    /// The marker to scale, and its figures; or why there is none.
    fn result_ui(&self, ui: &mut egui::Ui, height: f32, look: Look<'_>) {
        let (figures, gap) = (52.0, 6.0);
        let size = egui::vec2(ui.available_width(), height - figures - gap);
        match &self.shown {
            Some(shown) => shown.preview.ui(ui, size, look.palette, look.unit),
            None => {
                let (rect, _) = ui.allocate_exact_size(size, egui::Sense::hover());
                ui.painter().rect_filled(rect, 5.0, look.palette.table);
                let words = match self.work {
                    Some(_) => tr("Laying the pieces out…"),
                    None => tr("No marker yet"),
                };
                let font = egui::TextStyle::Body.resolve(ui.style());
                ui.painter().text(rect.center(), egui::Align2::CENTER_CENTER, words, font, look.palette.weak);
            }
        }
        ui.add_space(gap);
        ui.allocate_ui(egui::vec2(size.x, figures), |ui| {
            ui.set_min_size(egui::vec2(size.x, figures));
            match (&self.error, &self.shown) {
                (Some(words), _) => {
                    ui.add(egui::Label::new(RichText::new(words).color(look.palette.error)).wrap());
                }
                (None, Some(shown)) => self.figures_ui(ui, &shown.made, look),
                (None, None) => {}
            }
        });
    }

    fn figures_ui(&self, ui: &mut egui::Ui, made: &FinishedMarker, look: Look<'_>) {
        let report = &made.report;
        let figures = [
            (tr("Length"), look.unit.text(report.length)),
            (tr("Yield"), format!("{} %", number(report.yield_percent, 1))),
            (tr("For each garment"), look.unit.text(report.length_per_garment)),
            (tr("Pieces"), report.places.len().to_string()),
        ];
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 26.0;
            for (what, figure) in figures {
                ui.vertical(|ui| {
                    ui.spacing_mut().item_spacing.y = 1.0;
                    ui.label(RichText::new(what).color(look.palette.weak).size(12.0));
                    ui.label(RichText::new(figure).strong().size(16.0));
                });
            }
            if made.marker.order != self.order {
                let words = tr("The options have changed since: make it again");
                ui.add(egui::Label::new(RichText::new(words).color(look.palette.warning)).wrap());
            } else if let [first, rest @ ..] = &report.problems[..] {
                let words = match rest.len() {
                    0 => said(first),
                    more => say!("{problem} (and {more} more)", problem = said(first), more),
                };
                let words = RichText::new(words).color(look.palette.warning);
                ui.add(egui::Label::new(words).wrap())
                    .on_hover_text(report.problems.iter().map(said).collect::<Vec<_>>().join("\n"));
            }
        });
    }

    /// A button for each format.
    fn save_ui(&self, ui: &mut egui::Ui, paper: Paper) -> Option<MarkerFormat> {
        let mut chosen = None;
        for format in MarkerFormat::ALL {
            let (words, tip) = match format {
                MarkerFormat::Pdf => {
                    let paper = tr(crate::ui::actions::Action::Paper(paper).row().text);
                    (tr("Save as PDF…"), say!("At true size. Paper: {paper} (File › Paper)", paper))
                }
                MarkerFormat::Svg => (tr("Save as SVG…"), tr("At true size").to_owned()),
                MarkerFormat::Dxf => {
                    (tr("Save as DXF…"), tr("For a plotter or cutter (AAMA, ASTM)").to_owned())
                }
            };
            let button = ui.add_enabled(self.shown.is_some() && self.work.is_none(), Button::new(words));
            if button.on_hover_text(tip).clicked() {
                chosen = Some(format);
            }
        }
        chosen
    }
}

/// How many garments of each size of `pattern`: as many as were ordered last, else one in the base size.
fn garments(pattern: &Pattern, last: &Order) -> Vec<(String, usize)> {
    let base = pattern.sizes.base_name().to_owned();
    let names = if pattern.sizes.is_empty() { vec![base.clone()] } else { pattern.sizes.names.clone() };
    let known =
        |name: &String| last.garments.iter().find(|garment| garment.0 == *name).map(|garment| garment.1);
    let is_new = names.iter().filter_map(known).sum::<usize>() == 0;
    let count = |name: &String| if is_new { usize::from(*name == base) } else { known(name).unwrap_or(0) };
    names.iter().map(|name| (name.clone(), count(name))).collect()
}

impl App {
    /// Opens the Marker window on the pattern that is shown, which may be a demo's.
    pub(in crate::ui) fn open_marker(&mut self) {
        let own = || self.path.as_deref().map_or_else(|| "untitled".to_owned(), files::stem);
        let name = self.demo.as_ref().map_or_else(own, |(player, ..)| player.demo.file_stem().to_owned());
        let pattern = Arc::clone(&self.shown().document().pattern);
        self.shell.marker = Some(MarkerPage::new(name, pattern, &self.shell.marker_order));
    }

    /// Draws the Marker window, and takes what is made behind it.
    pub(in crate::ui) fn marker_ui(&mut self, ctx: &egui::Context, palette: &Palette) {
        let Some(mut page) = self.shell.marker.take() else { return };
        let look = Look { palette, unit: self.preferences.unit, paper: self.preferences.paper };
        page.take(look.unit);
        match page.ui(ctx, look) {
            Answer::None => {}
            Answer::Close => return self.shell.marker_order = page.order.clone(),
            Answer::Make => page.begin(ctx),
            Answer::Cancel => page.work = None,
            Answer::Save(format) => self.ask_file(Purpose::Marker(format)),
        }
        self.shell.marker = Some(page);
    }

    /// Writes the marker that is shown to `path`. The error is a message.
    pub(in crate::ui) fn write_marker(&mut self, path: &Path, format: MarkerFormat) -> Result<(), String> {
        let shown = self.shell.marker.as_ref().and_then(|page| page.shown.as_ref());
        let Some(shown) = shown else { return Ok(()) };
        files::write_marker(path, &shown.made, format, self.preferences.paper)?;
        self.wrote(path);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::SizeRun;

    #[test]
    fn the_sizes_of_the_pattern_keep_the_counts_that_were_ordered_last() {
        let mut pattern = Pattern::default();
        let counts = |pattern: &Pattern, last: &[(&str, usize)]| -> Vec<usize> {
            let last = last.iter().map(|(name, count)| ((*name).to_owned(), *count)).collect();
            let order = Order { garments: last, ..Order::default() };
            garments(pattern, &order).into_iter().map(|garment| garment.1).collect()
        };
        assert_eq!(counts(&pattern, &[]), [1]);
        assert_eq!(counts(&pattern, &[("", 3)]), [3]);
        pattern.sizes = SizeRun::new(["S", "M", "L"], "M").expect("a run");
        assert_eq!(counts(&pattern, &[("", 3)]), [0, 1, 0]);
        assert_eq!(counts(&pattern, &[("L", 2), ("S", 1)]), [1, 0, 2]);
        assert_eq!(counts(&pattern, &[("L", 0)]), [0, 1, 0], "nothing is no order");
    }
}
