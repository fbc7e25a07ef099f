//! What is worked along the selected edges and lines: fold lines, elastic, topstitching, hems, piping, wrinkles, buttons.

use egui::{Grid, RichText};

use crate::pattern::edit::{PatternEdit, TrimLine};
use crate::pattern::stitches::PLAIN;
use crate::pattern::trims::{ELASTIC_RATIOS, ELASTIC_TENSIONS, PIPING_RADII};
use crate::pattern::{Elastic, Fold, Hem, Piping, Topstitch, Trims, Wrinkle};
use crate::session::Command;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::language::tr;
use crate::ui::panels::colours::colour_menu;
use crate::ui::panels::context::PanelContext;
use crate::ui::panels::fastenings::buttons_ui;
use crate::ui::panels::fields::{angle_field, length_field, number_field};
use crate::ui::selection::Selection;

/// Strengths of a fold, N, and their names.
const STRENGTHS: [(f64, &str, &str); 3] = [
    (0.004, "Soft", "Finger-pressed: it opens under a light load"),
    (Fold::PRESSED, "Pressed", "Pressed with an iron"),
    (0.2, "Stitched", "Stitched along the crease, or with stiff interfacing"),
];

/// The selected edges and lines.
fn selected(selection: &Selection) -> Vec<TrimLine> {
    let edges = selection.edges.iter().map(|&edge| TrimLine::Edge(edge));
    edges.chain(selection.lines.iter().map(|l| TrimLine::Line { piece: l.piece, line: l.line })).collect()
}

fn dragged(edit: PatternEdit) -> Command {
    Command::EditPattern { edits: vec![edit], anew: true }
}

fn ask(edit: PatternEdit) -> Ask {
    Ask::Do(Command::EditPattern { edits: vec![edit], anew: false })
}

/// Draws the trims of the selected edges and lines; nothing where none is selected.
pub fn trims_ui(ui: &mut egui::Ui, told: &PanelContext<'_>, asks: &mut Asks) {
    let lines = selected(told.selection);
    let of = |line: &TrimLine| line.of(told.document.pattern.pieces.get(&line.piece())?);
    let Some(trims) = lines.first().and_then(of) else { return };
    fold_ui(ui, told, &lines, &trims, asks);
    elastic_ui(ui, told, &lines, &trims, asks);
    topstitch_ui(ui, told, &lines, &trims, asks);
    hem_ui(ui, told, &lines, &trims, asks);
    piping_ui(ui, told, &lines, &trims, asks);
    wrinkle_ui(ui, told, &lines, &trims, asks);
    buttons_ui(ui, told, &lines, asks);
}

fn topstitch_ui(
    ui: &mut egui::Ui,
    told: &PanelContext<'_>,
    lines: &[TrimLine],
    trims: &Trims,
    asks: &mut Asks,
) {
    let set =
        |topstitch: Option<Topstitch>| ask(PatternEdit::SetTopstitch { lines: lines.to_vec(), topstitch });
    let mut on = trims.topstitch.is_some();
    let tip = tr("Rows of stitches that are seen on the outside");
    if ui.checkbox(&mut on, tr("Topstitching")).on_hover_text(tip).changed() {
        asks.push(set(on.then(Topstitch::default)));
    }
    let Some(old) = trims.topstitch else { return };
    let unit = told.now.unit;
    Grid::new("topstitching").num_columns(4).spacing([6.0, 4.0]).show(ui, |ui| {
        let label = weak(ui, told, tr("Distance"));
        if let Some(new) = length_field(ui, "stitch distance", &label, old.distance, unit) {
            asks.push(set(Some(Topstitch { distance: new.clamp(0.0, 0.1), ..old })));
        }
        let label = weak(ui, told, tr("Stitch"));
        if let Some(new) = length_field(ui, "stitch length", &label, old.length, unit) {
            asks.push(set(Some(Topstitch { length: new.clamp(0.0005, 0.03), ..old })));
        }
        ui.end_row();
        let label = weak(ui, told, tr("Rows"));
        if let Some(new) = number_field(ui, "stitch rows", &label, f64::from(old.rows)) {
            asks.push(set(Some(Topstitch { rows: new.round().clamp(1.0, 6.0) as u8, ..old })));
        }
        let label = weak(ui, told, tr("Apart"));
        if let Some(new) = length_field(ui, "stitch spacing", &label, old.spacing, unit) {
            asks.push(set(Some(Topstitch { spacing: new.clamp(0.0005, 0.05), ..old })));
        }
        ui.end_row();
        weak(ui, told, tr("Thread"));
        colour_menu(ui, tr("Thread of the topstitching"), old.colour, asks, |colour| {
            let topstitch = Some(Topstitch { colour, ..old });
            dragged(PatternEdit::SetTopstitch { lines: lines.to_vec(), topstitch })
        });
    });
}

fn hem_ui(ui: &mut egui::Ui, told: &PanelContext<'_>, lines: &[TrimLine], trims: &Trims, asks: &mut Asks) {
    if !lines.iter().all(|line| matches!(line, TrimLine::Edge(_))) {
        return;
    }
    let set = |hem: Option<Hem>| ask(PatternEdit::SetHem { lines: lines.to_vec(), hem });
    let mut on = trims.hem.is_some();
    let tip = tr("The edge is turned in and sewn down: it is doubled, and stiffer");
    if ui.checkbox(&mut on, tr("Hem")).on_hover_text(tip).changed() {
        asks.push(set(on.then_some(Hem::USUAL)));
    }
    let Some(hem) = trims.hem else { return };
    ui.horizontal(|ui| {
        let label = weak(ui, told, tr("Width"));
        if let Some(new) = length_field(ui, "hem width", &label, hem.width, told.now.unit) {
            asks.push(set(Some(Hem { width: new.clamp(0.003, 0.2), ..hem })));
        }
        colour_menu(ui, tr("Thread of the hem"), hem.colour.unwrap_or(PLAIN), asks, |colour| {
            let hem = Some(Hem { colour: Some(colour), ..hem });
            dragged(PatternEdit::SetHem { lines: lines.to_vec(), hem })
        });
    });
}

fn piping_ui(ui: &mut egui::Ui, told: &PanelContext<'_>, lines: &[TrimLine], trims: &Trims, asks: &mut Asks) {
    let edit = |piping: Option<Piping>| PatternEdit::SetPiping { lines: lines.to_vec(), piping };
    let mut on = trims.piping.is_some();
    let tip = tr("A covered cord is sewn in here: it shows as an edge, and is stiffer");
    if ui.checkbox(&mut on, tr("Piping")).on_hover_text(tip).changed() {
        asks.push(ask(edit(on.then_some(Piping::USUAL))));
    }
    let Some(piping) = trims.piping else { return };
    ui.horizontal(|ui| {
        let label = weak(ui, told, tr("Radius"));
        let label = label.on_hover_text(tr("Of the covered cord: 0.5 to 6 mm"));
        if let Some(new) = length_field(ui, "piping radius", &label, piping.radius, told.now.unit) {
            let radius = new.clamp(*PIPING_RADII.start(), *PIPING_RADII.end());
            asks.push(ask(edit(Some(Piping { radius, ..piping }))));
        }
        colour_menu(ui, tr("Colour of the piping"), piping.colour, asks, |colour| {
            dragged(edit(Some(Piping { colour, ..piping })))
        });
    });
}

fn wrinkle_ui(
    ui: &mut egui::Ui,
    told: &PanelContext<'_>,
    lines: &[TrimLine],
    trims: &Trims,
    asks: &mut Asks,
) {
    if !lines.iter().all(|line| matches!(line, TrimLine::Line { .. })) {
        return;
    }
    let set = |wrinkle: Option<Wrinkle>| ask(PatternEdit::SetWrinkle { lines: lines.to_vec(), wrinkle });
    let mut on = trims.wrinkle.is_some();
    let tip = tr("Draped cloth rises to a soft ridge along the line, or sinks to a valley, as at an elbow");
    if ui.checkbox(&mut on, tr("Wrinkle")).on_hover_text(tip).changed() {
        asks.push(set(on.then_some(Wrinkle::USUAL)));
    }
    let Some(wrinkle) = trims.wrinkle else { return };
    ui.horizontal(|ui| {
        let label =
            weak(ui, told, tr("Width")).on_hover_text(tr("Of the wrinkle across the line: 5 to 100 mm"));
        if let Some(new) = length_field(ui, "wrinkle width", &label, wrinkle.width, told.now.unit) {
            asks.push(set(Some(wrinkle.as_wide_as(new))));
        }
        let label = weak(ui, told, tr("Height"));
        let label =
            label.on_hover_text(tr("Of the wrinkle: at most half its width; below zero it goes inwards"));
        if let Some(new) = length_field(ui, "wrinkle height", &label, wrinkle.height, told.now.unit) {
            asks.push(set(Some(wrinkle.as_high_as(new))));
        }
    });
}

fn weak(ui: &mut egui::Ui, told: &PanelContext<'_>, text: &str) -> egui::Response {
    ui.label(RichText::new(text).color(told.palette.weak).size(12.5))
}

fn elastic_ui(
    ui: &mut egui::Ui,
    told: &PanelContext<'_>,
    lines: &[TrimLine],
    trims: &Trims,
    asks: &mut Asks,
) {
    let set = |elastic: Option<Elastic>| ask(PatternEdit::SetElastic { lines: lines.to_vec(), elastic });
    let mut on = trims.elastic.is_some();
    let tip = tr("Draped cloth is gathered to the length of the elastic: waistbands, cuffs, ruffles");
    if ui.checkbox(&mut on, tr("Elastic")).on_hover_text(tip).changed() {
        asks.push(set(on.then_some(Elastic::USUAL)));
    }
    let Some(elastic) = trims.elastic else { return };
    ui.horizontal(|ui| {
        let label = weak(ui, told, tr("Length, %"));
        let label = label.on_hover_text(tr("Of the elastic at rest, of that of the cloth: 30 to 100"));
        if let Some(new) = number_field(ui, "elastic length", &label, elastic.ratio * 100.0) {
            let ratio = (new / 100.0).clamp(*ELASTIC_RATIOS.start(), *ELASTIC_RATIOS.end());
            asks.push(set(Some(Elastic { ratio, ..elastic })));
        }
    });
    ui.horizontal(|ui| {
        let label = weak(ui, told, tr("Tension, N"));
        let label = label.on_hover_text(tr("Force at double length; a waistband elastic has about 15"));
        if let Some(new) = number_field(ui, "elastic tension", &label, elastic.tension) {
            let tension = new.clamp(*ELASTIC_TENSIONS.start(), *ELASTIC_TENSIONS.end());
            asks.push(set(Some(Elastic { tension, ..elastic })));
        }
    });
}

fn fold_ui(ui: &mut egui::Ui, told: &PanelContext<'_>, lines: &[TrimLine], trims: &Trims, asks: &mut Asks) {
    let set = |fold: Option<Fold>| ask(PatternEdit::SetFold { lines: lines.to_vec(), fold });
    let mut on = trims.fold.is_some();
    let tip = tr("Draped cloth is creased here: pleats, collars, cuffs, pressed edges");
    if ui.checkbox(&mut on, tr("Fold line")).on_hover_text(tip).changed() {
        asks.push(set(on.then(|| Fold::pressed(std::f64::consts::PI))));
    }
    let Some(fold) = trims.fold else { return };
    ui.horizontal(|ui| {
        let label = weak(ui, told, tr("Angle"));
        let label =
            label.on_hover_text(tr("0 is flat; positive towards the outer side; 180 is folded double"));
        let half = std::f64::consts::PI;
        if let Some(new) = angle_field(ui, "fold angle", &label, fold.angle) {
            asks.push(set(Some(Fold { angle: new.clamp(-half, half), ..fold })));
        }
        if ui.small_button(tr("Other side")).on_hover_text(tr("Fold it to the other side")).clicked() {
            asks.push(set(Some(Fold { angle: -fold.angle, ..fold })));
        }
    });
    ui.horizontal_wrapped(|ui| {
        for (strength, name, tip) in STRENGTHS {
            if ui.selectable_label(fold.strength == strength, tr(name)).on_hover_text(tr(tip)).clicked() {
                asks.push(set(Some(Fold { strength, ..fold })));
            }
        }
    });
}
