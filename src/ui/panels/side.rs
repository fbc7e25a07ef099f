//! The side panel: sections for the pattern, marks, problems and cloth settings.

use std::cmp::Ordering;

use egui::{CollapsingHeader, Id, RichText, ScrollArea};

use crate::pattern::{Problem, ProblemKind};
use crate::session::{Command, Document, Settings};
use crate::sim::Fault;
use crate::ui::actions::Tool;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::language::fields::slider;
use crate::ui::language::{said, say, tr};
use crate::ui::look::theme::Palette;
use crate::ui::panels::artwork::artwork_ui;
use crate::ui::panels::context::{PanelContext, problem_row};
use crate::ui::panels::fabric;
use crate::ui::panels::fastenings::fastenings_ui;
use crate::ui::panels::marks::MarksPanel;
use crate::ui::panels::pattern::{PatternPanel, seams_ui};
use crate::ui::panels::pins::pins_ui;
use crate::ui::panels::pose::PosePanel;
use crate::ui::panels::sizes::SizesPanel;
use crate::ui::panels::tape::TapePanel;
use crate::ui::panels::tight::tight_ui;

/// Width that is left free for the scroll bar, points.
const BAR: f32 = 8.0;

/// Draws the panel. Returns its first widget, for the keyboard focus.
pub fn side_panel_ui(
    ui: &mut egui::Ui,
    told: &PanelContext<'_>,
    marks: &mut MarksPanel,
    pattern: (&mut PatternPanel, &mut SizesPanel),
    (pose, tape): (&mut PosePanel, &mut TapePanel),
    asks: &mut Asks,
) -> Option<Id> {
    let PanelContext { document, palette, .. } = *told;
    let mut first = None;
    let (pattern, sizes) = pattern;
    ScrollArea::vertical().auto_shrink([false, false]).show(ui, |ui| {
        // The scroll bar floats over what is at the right edge.
        ui.set_max_width(ui.available_width() - BAR);
        // The section of the chosen tool comes first.
        let on_pattern =
            !matches!(told.now.tool, Tool::Mark | Tool::Erase | Tool::Drag(_) | Tool::Pin | Tool::Bone);
        if on_pattern {
            first = Some(pattern_ui(ui, told, (&mut *pattern, &mut *sizes), asks));
        }
        let marks = section(ui, "Marks", tr("Marks"), true, |ui| marks.ui(ui, told, asks));
        first = first.or(Some(marks));
        if !document.pins.is_empty() {
            let title = say!("Pins ({count})", count = document.pins.len());
            section(ui, "Pins", &title, true, |ui| pins_ui(ui, told, asks));
        }
        section(ui, "Problems", tr("Problems"), true, |ui| problems_ui(ui, told, asks));
        section(ui, "Fabric", tr("Fabric"), true, |ui| fabric::fabric_ui(ui, told, asks));
        section(ui, "Images", tr("Images"), true, |ui| artwork_ui(ui, told, asks));
        section(ui, "Pose", tr("Pose"), false, |ui| pose.ui(ui, told, asks));
        section(ui, "Measures", tr("Measures of the body"), false, |ui| tape.ui(ui, told, asks));
        section(ui, "Cloth", tr("Cloth"), true, |ui| settings_ui(ui, &document.settings, palette, asks));
        if !on_pattern {
            pattern_ui(ui, told, (pattern, sizes), asks);
        }
    });
    first
}

fn pattern_ui(
    ui: &mut egui::Ui,
    told: &PanelContext<'_>,
    (pattern, sizes): (&mut PatternPanel, &mut SizesPanel),
    asks: &mut Asks,
) -> Id {
    let of_pattern = !told.selection.is_empty() && told.selection.pins.is_empty();
    let selected = of_pattern
        .then(|| section(ui, "Selected", tr("Selected"), true, |ui| pattern.inspector_ui(ui, told, asks)));
    let pieces = section(ui, "Pieces", tr("Pieces"), true, |ui| pattern.outliner_ui(ui, told, asks));
    let seams = say!("Seams ({count})", count = told.document.pattern.seams.len());
    section(ui, "Seams", &seams, false, |ui| seams_ui(ui, told, asks));
    section(ui, "Sizes", tr("Sizes of the pattern"), false, |ui| sizes.ui(ui, told, asks));
    let pattern = &told.document.pattern;
    let zips = pattern.seams.values().filter(|seam| seam.zip.is_some()).count();
    let count = pattern.buttons.len() + zips;
    if count > 0 {
        let title = say!("Fastenings ({count})", count);
        section(ui, "Fastenings", &title, false, |ui| fastenings_ui(ui, told, asks));
    }
    selected.unwrap_or(pieces)
}

fn section(
    ui: &mut egui::Ui,
    salt: &str,
    title: &str,
    open: bool,
    contents: impl FnOnce(&mut egui::Ui),
) -> Id {
    ui.add_space(4.0);
    let header = CollapsingHeader::new(RichText::new(title).strong().size(14.0));
    let shown = header.id_salt(salt).default_open(open).show_unindented(ui, |ui| {
        ui.add_space(2.0);
        contents(ui);
        ui.add_space(6.0);
    });
    shown.header_response.id
}

/// A setting of relaxation and draping.
struct Setting {
    text: &'static str,
    tip: &'static str,
    value: fn(&mut Settings) -> &mut f64,
    /// Accepted values, in the shown unit.
    range: std::ops::RangeInclusive<f64>,
    /// Factor from the setting's own unit to the shown one, and the shown unit's name.
    unit: (f64, &'static str),
}

const SETTINGS: [Setting; 7] = [
    Setting {
        text: "Triangle size",
        tip: "Length of the edges of the cloth's triangles; takes effect with the next wrap",
        value: |settings| &mut settings.edge_length,
        range: 5.0..=60.0,
        unit: (1000.0, " mm"),
    },
    Setting {
        text: "Skin offset",
        tip: "Distance between skin and cloth",
        value: |settings| &mut settings.relax.offset,
        range: 0.5..=20.0,
        unit: (1000.0, " mm"),
    },
    Setting {
        text: "Shape stiffness",
        tip: "How strongly triangles keep their flat shape while the cloth relaxes",
        value: |settings| &mut settings.relax.stretch,
        range: 0.0..=1.0,
        unit: (1.0, ""),
    },
    Setting {
        text: "Fold smoothing",
        tip: "How strongly folds are smoothed away",
        value: |settings| &mut settings.relax.flatten,
        range: 0.0..=1.0,
        unit: (1.0, ""),
    },
    Setting {
        text: "Gravity",
        tip: "How strongly gravity pulls while the cloth relaxes",
        value: |settings| &mut settings.relax.gravity,
        range: 0.0..=0.05,
        unit: (1.0, ""),
    },
    Setting {
        text: "Friction",
        tip: "Friction between cloth and skin while the cloth relaxes",
        value: |settings| &mut settings.relax.friction,
        range: 0.0..=1.5,
        unit: (1.0, ""),
    },
    Setting {
        text: "Strain limit",
        tip: "Strain beyond which draped cloth does not stretch further",
        value: |settings| &mut settings.strain,
        range: 0.1..=20.0,
        unit: (100.0, " %"),
    },
];

fn settings_ui(ui: &mut egui::Ui, settings: &Settings, palette: &Palette, asks: &mut Asks) {
    let mut new = *settings;
    let mut ended = false;
    for Setting { text, tip, value, range, unit: (unit, sign) } in SETTINGS {
        let value = value(&mut new);
        let mut shown = *value * unit;
        let digits = if unit > 500.0 { 1 } else { 3 };
        ui.label(RichText::new(tr(text)).color(palette.weak).size(12.5));
        let field = slider(&mut shown, range).suffix(sign).max_decimals(digits);
        let response = ui.add(field).on_hover_text(tr(tip));
        response.widget_info(|| egui::WidgetInfo::slider(true, shown, tr(text)));
        if response.changed() {
            *value = shown / unit;
        }
        ended |= response.drag_stopped() || (response.changed() && !response.dragged());
    }
    ui.add_space(2.0);
    if ui.add_enabled(*settings != Settings::default(), egui::Button::new(tr("Reset")).small()).clicked() {
        asks.push(Ask::Do(Command::SetSettings { settings: Settings::default() }));
        return;
    }
    if new != *settings {
        asks.push(Ask::Drag(Command::SetSettings { settings: new }));
    }
    if ended {
        asks.push(Ask::EndDrag);
    }
}

fn problems_ui(ui: &mut egui::Ui, told: &PanelContext<'_>, asks: &mut Asks) {
    let palette = told.palette;
    let lonely: Vec<String> = unpaired(told.document).into_iter().collect();
    let nothing = told.lost.is_empty() && told.problems.is_empty() && told.verdict.is_empty();
    if lonely.is_empty() && nothing && told.snapshot.tight.is_empty() {
        ui.label(RichText::new(tr("None")).color(palette.weak));
        return;
    }
    for words in lonely {
        problem_row(ui, palette.warning, &words, None, asks);
    }
    let (notes, real): (Vec<&Problem>, Vec<&Problem>) =
        told.lost.iter().chain(told.problems).partition(|problem| problem.kind.is_note());
    for problem in real {
        problem_row(ui, palette.error, &said(&problem.in_words()), None, asks);
    }
    for Fault { problem, marks } in told.verdict {
        let numbers: Vec<usize> = marks.iter().map(|m| m.number).collect();
        let words = said(&problem.in_words());
        let shows = (Ask::ShowMarks(numbers), tr("Show the marks concerned"));
        let shows = Some(shows).filter(|_| !marks.is_empty());
        problem_row(ui, palette.error, &words, shows, asks);
    }
    tight_ui(ui, told, asks);
    notes_ui(ui, palette, notes, asks);
    if !told.verdict.is_empty() && told.now.wrapped {
        ui.add_space(4.0);
        let tip = tr("What was on the body before this wrap comes back; then paint the marks anew");
        if ui.button(tr("Take this wrap back")).on_hover_text(tip).clicked() {
            asks.push(Ask::Do(Command::CancelWrap));
        }
    }
}

/// Draws a row for each of `notes`; those about what is as it is meant come last, and quieter.
fn notes_ui(ui: &mut egui::Ui, palette: &Palette, mut notes: Vec<&Problem>, asks: &mut Asks) {
    notes.sort_by_key(|note| note.kind == ProblemKind::Gather);
    for note in notes {
        let ink = if note.kind == ProblemKind::Gather { palette.weak } else { palette.warning };
        problem_row(ui, ink, &said(&note.in_words()), None, asks);
    }
}

/// A message about marks that have no partner, so that no wrap can use them.
fn unpaired(document: &Document) -> Option<String> {
    let (cloth, body) = (document.marks.cloth.len(), document.marks.body.len());
    let (first, last) = (cloth.min(body) + 1, cloth.max(body));
    Some(match (cloth.cmp(&body), first == last) {
        (Ordering::Equal, _) => return None,
        (Ordering::Less, true) => say!("Mark {n} has no partner on the cloth yet", n = first),
        (Ordering::Less, false) => {
            say!("Marks {first} to {last} have no partner on the cloth yet", first, last)
        }
        (Ordering::Greater, true) => say!("Mark {n} has no partner on the body yet", n = first),
        (Ordering::Greater, false) => {
            say!("Marks {first} to {last} have no partner on the body yet", first, last)
        }
    })
}
