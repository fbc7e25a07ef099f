//! The section of the side panel for fabrics, colours, prints, images and colourways, and for draping step by step.

use egui::{ComboBox, RichText, Ui};

use crate::cloth::Fabric;
use crate::geometry::ids::PieceId;
use crate::pattern::naming;
use crate::render::cloth_front;
use crate::session::{Artwork, Command, Dye, Motif, Print};
use crate::ui::actions::Action;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::language::fields::drag_value;
use crate::ui::language::{counted, say, tr, unbroken};
use crate::ui::list::list_ui;
use crate::ui::panels::artwork::surface_ui;
use crate::ui::panels::colours::{SWATCH, colour_ui, panel_menu};
use crate::ui::panels::context::PanelContext;
use crate::ui::scenery::print_match::{PrintMatch, print_matches};

/// Width of the lists, points.
const WIDTH: f32 = 104.0;
/// Colour that a piece without a fabric colour is given first, sRGB.
const FIRST_COLOUR: [u8; 3] = [176, 60, 62];
/// The print that a piece is given first.
const FIRST_PRINT: Print = Print { motif: Motif::Stripes, repeat_m: 0.02, colour: [244, 242, 236] };

/// Prints that are off by less than this at a seam count as meeting, mm: a sewer does not do better.
const MATCHES_MM: f64 = 1.0;

/// Draws a row for the whole garment and one for each piece, the colourways, and the button for one step of draping.
pub fn fabric_ui(ui: &mut Ui, told: &PanelContext<'_>, asks: &mut Asks) {
    row(ui, told, None, tr("All pieces"), asks);
    for (&id, piece) in &told.document.pattern.pieces {
        row(ui, told, Some(id), &piece.name, asks);
    }
    ui.add_space(2.0);
    colourways_ui(ui, told, asks);
    matches_ui(ui, told);
    ui.add_space(2.0);
    let step = Action::StepDrape;
    let why_not = told.now.why_not(step);
    let button = egui::Button::new(tr(step.row().text)).small();
    let response = ui.add_enabled(why_not.is_none(), button).on_hover_text(tr(step.row().tip));
    if response.on_disabled_hover_text(why_not.unwrap_or_default()).clicked() {
        asks.push(Ask::Act(step));
    }
}

/// Fabric, colour and print of a piece.
fn row(ui: &mut Ui, told: &PanelContext<'_>, piece: Option<PieceId>, name: &str, asks: &mut Asks) {
    ui.horizontal(|ui| {
        dye_menu(ui, told, piece, name, asks);
        fabric_list(ui, told, piece, name, asks);
    });
}

fn fabric_list(ui: &mut Ui, told: &PanelContext<'_>, piece: Option<PieceId>, name: &str, asks: &mut Asks) {
    let fabrics = &told.document.fabrics;
    let own = match piece {
        None => Some(fabrics.name(None)),
        Some(piece) => fabrics.pieces.get(&piece).map(String::as_str),
    };
    let shown =
        own.map_or(RichText::new(tr("as all")).color(told.palette.weak), |own| RichText::new(tr(own)));
    let combo = ComboBox::from_id_salt(("fabric", piece)).selected_text(shown).width(WIDTH);
    let shown = list_ui(ui, combo, |entries| {
        let mut set = |fabric: Option<&str>| {
            asks.push(Ask::Do(Command::SetFabric { piece, fabric: fabric.map(str::to_owned) }));
        };
        if piece.is_some() && entries.add(own.is_none(), tr("as all")).clicked() {
            set(None);
        }
        for fabric in Fabric::presets() {
            let row = entries.add(own == Some(&fabric.name), tr(&fabric.name));
            if row.on_hover_text(figures(fabric)).clicked() {
                set(Some(&fabric.name));
            }
        }
    });
    // A label of the box's own would widen the panel by a long name; cut short, left and right would be the same.
    let label = ui.add(egui::Label::new(name).wrap());
    shown.labelled_by(label.id);
}

/// A button in the colour of the piece that opens its colour and print.
fn dye_menu(ui: &mut Ui, told: &PanelContext<'_>, piece: Option<PieceId>, name: &str, asks: &mut Asks) {
    let document = told.document;
    let own = match piece {
        None => document.dyes.all,
        Some(piece) => document.dyes.pieces.get(&piece).copied().unwrap_or_default(),
    };
    let fabric = Fabric::preset(document.fabrics.name(piece)).and_then(|fabric| fabric.look.colour);
    let all = document.dyes.all.colour.filter(|_| piece.is_some());
    let seen = own.colour.or(all).or(fabric);
    let opaque = |[r, g, b]: [u8; 3]| egui::Color32::from_rgb(r, g, b);
    let border = own.print.map_or(told.palette.weak, |print| opaque(print.colour));
    let button = egui::Button::new("").min_size(SWATCH).stroke(egui::Stroke::new(2.0, border));
    let layer = piece.and_then(|id| document.pattern.pieces.get(&id)).map_or(0, |piece| piece.layer);
    let button = button.fill(opaque(seen.unwrap_or_else(|| cloth_front(layer))));
    let response = panel_menu(ui, button, |ui| {
        if let Some(dye) = dye_ui(ui, &document.artwork, own, seen, piece.is_none()) {
            asks.push(Ask::Drag(Command::SetDye { piece, dye }));
        }
        // A drag over the colours is one step.
        if ui.input(|input| input.pointer.any_released() || input.key_pressed(egui::Key::Enter)) {
            asks.push(Ask::EndDrag);
        }
    });
    let label = say!("Colour and print of {name}", name);
    let name_of_button = label.clone();
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &name_of_button));
    response.on_hover_text(label);
}

/// The dye that was chosen, if any was.
fn dye_ui(ui: &mut Ui, artwork: &Artwork, own: Dye, seen: Option<[u8; 3]>, is_for_all: bool) -> Option<Dye> {
    let mut dye = own;
    let plain = if is_for_all { tr("As the fabric") } else { tr("As all pieces") };
    let mut is_own = own.colour.is_some();
    if ui.checkbox(&mut is_own, tr("Own colour")).on_hover_text(plain).changed() {
        dye.colour = is_own.then(|| seen.unwrap_or(FIRST_COLOUR));
    }
    if let Some(colour) = &mut dye.colour {
        colour_ui(ui, "colour", colour);
    }
    ui.separator();
    let mut has_print = own.print.is_some();
    if ui.checkbox(&mut has_print, tr("Print")).changed() {
        dye.print = has_print.then_some(FIRST_PRINT);
    }
    if let Some(print) = &mut dye.print {
        ui.horizontal_wrapped(|ui| {
            for motif in Motif::ALL {
                ui.selectable_value(&mut print.motif, motif, tr(motif.name()));
            }
        });
        ui.horizontal(|ui| {
            let label = ui.label(tr("Repeat"));
            let mut millimetres = print.repeat_m * 1e3;
            let value = drag_value(&mut millimetres).range(1.0..=2000.0).suffix(" mm").max_decimals(1);
            if ui.add(value).labelled_by(label.id).on_hover_text(tr("Length of a repeat")).changed() {
                print.repeat_m = millimetres / 1e3;
            }
        });
        colour_ui(ui, "print", &mut print.colour);
    }
    ui.separator();
    surface_ui(ui, artwork, &mut dye);
    (dye != own).then_some(dye)
}

/// The list of colourways, and the name under which the present one is kept.
fn colourways_ui(ui: &mut Ui, told: &PanelContext<'_>, asks: &mut Asks) {
    let document = told.document;
    let is_worn = |c: &&crate::session::Colourway| c.fabrics == document.fabrics && c.dyes == document.dyes;
    let worn = document.colourways.iter().find(is_worn).map(|colourway| colourway.name.as_str());
    let id = ui.scope_id().with("new colourway");
    ui.horizontal(|ui| {
        let shown = RichText::new(worn.unwrap_or(tr("not kept"))).color(told.palette.weak);
        let combo = ComboBox::from_label(tr("Colourway")).selected_text(shown).width(WIDTH);
        list_ui(ui, combo, |entries| {
            for colourway in document.colourways.iter() {
                let name = &colourway.name;
                if entries.add(worn == Some(name), name).clicked() {
                    asks.push(Ask::Do(Command::WearColourway { name: name.clone() }));
                }
            }
            if let Some(name) = worn
                && entries.add_button(say!("Delete {name}", name)).clicked()
            {
                asks.push(Ask::Do(Command::DeleteColourway { name: name.to_owned() }));
            }
        });
    });
    let keep = egui::Button::new(tr("Keep colourway…")).small();
    let response = panel_menu(ui, keep, |ui| {
        let mut name: String = ui.data(|data| data.get_temp(id)).unwrap_or_default();
        let field = egui::TextEdit::singleline(&mut name).hint_text(tr("Name"));
        let typed = ui.add(field.desired_width(WIDTH));
        if is_just_opened(ui, id) {
            typed.request_focus();
        }
        let is_entered = typed.lost_focus() && ui.input(|input| input.key_pressed(egui::Key::Enter));
        let is_named = !name.trim().is_empty();
        let is_kept = ui.add_enabled(is_named, egui::Button::new(tr("Keep"))).clicked();
        if is_kept || (is_entered && is_named) {
            asks.push(Ask::Do(Command::KeepColourway { name: name.trim().to_owned() }));
            name.clear();
            ui.close();
        }
        ui.data_mut(|data| data.insert_temp(id, name));
    });
    response.on_hover_text(tr("Keep the present fabrics, colours and prints under a name"));
}

/// Whether what is drawn in a popup was not drawn until this frame or the last one. The first only measures it, and may lose the
/// focus again.
fn is_just_opened(ui: &Ui, id: egui::Id) -> bool {
    let (frame, id) = (ui.ctx().cumulative_frame_nr(), id.with("opened"));
    let [opened, last] = ui.data(|data| data.get_temp(id)).unwrap_or([frame; 2]);
    let opened = if last + 1 < frame { frame } else { opened };
    ui.data_mut(|data| data.insert_temp(id, [opened, frame]));
    frame <= opened + 1
}

/// How far the prints on both sides of a seam are off each other; of the seams where they meet only the number.
fn matches_ui(ui: &mut Ui, told: &PanelContext<'_>) {
    let Some(garment) = told.snapshot.garment.as_ref().filter(|_| !told.document.dyes.is_plain()) else {
        return;
    };
    let found = print_matches(garment, &told.document.pattern, &told.document.dyes);
    let (meeting, off): (Vec<PrintMatch>, Vec<PrintMatch>) =
        found.into_iter().partition(|found| found.offset * 1e3 < MATCHES_MM);
    for PrintMatch { seam, motif, offset } in off {
        let words = say!(
            "{place}: {print} are {mm} mm off",
            place = naming::seam_place(&told.document.pattern, seam),
            print = tr(motif.name()),
            mm = format!("{:.0}", offset * 1e3)
        );
        let label = ui.label(RichText::new(unbroken(&words)).small());
        label.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, &words));
    }
    if !meeting.is_empty() {
        let words = counted(meeting.len(), "Prints meet at 1 seam", "Prints meet at {n} seams");
        ui.label(RichText::new(words).small().color(told.palette.weak));
    }
}

/// Weight, stretch and bending stiffness as text.
fn figures(fabric: &Fabric) -> String {
    let grams = fabric.density_kg_per_m2 * 1000.0;
    let bending = fabric.bending.warp.max(fabric.bending.weft) * 1e6;
    let (warp, weft) = (fabric.stretch.warp, fabric.stretch.weft);
    say!(
        "{grams} g/m², stretch {warp} × {weft} N/m, bending {bending} µN·m",
        grams = format!("{grams:.0}"),
        warp = format!("{warp:.0}"),
        weft = format!("{weft:.0}"),
        bending = format!("{bending:.0}")
    )
}
