//! The section of images, and of the graphics made of them.

use egui::accesskit::Role;
use egui::{Button, Response, RichText, Ui, WidgetInfo};
use glam::DVec2;

use crate::geometry::ids::{GraphicId, ImageId, PieceId};
use crate::pattern::Piece;
use crate::session::artwork::WIDTHS;
use crate::session::{Artwork, Command, Dye, Graphic, Repeated};
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::actions::{Action, Tool};
use crate::ui::language::fields::drag_value;
use crate::ui::language::{said, say, tr};
use crate::ui::panels::context::{PanelContext, problem_row};

/// Largest height of the images of which a fabric has one, points: four names.
const IMAGES_HEIGHT: f32 = 104.0;
/// Width of a new graphic, metres.
const FIRST_WIDTH: f64 = 0.1;
/// Width of a repeat of an image on a fabric that has none yet, metres.
const FIRST_REPEAT: f64 = 0.1;

/// Draws the list of images, the button that takes one, and the graphics with their numbers.
pub fn artwork_ui(ui: &mut Ui, told: &PanelContext<'_>, asks: &mut Asks) {
    let artwork = &*told.document.artwork;
    for (&image, file) in &artwork.images {
        image_row(ui, told, (image, &file.name), asks);
        if let Err(why) = file.picture() {
            let words = say!(
                "{image}: {why}. It is kept in the project, and squares are shown instead",
                image = file.name,
                why = said(why)
            );
            problem_row(ui, told.palette.error, &words, None, asks);
        }
    }
    for (&id, graphic) in &artwork.graphics {
        graphic_ui(ui, told, id, graphic, asks);
    }
    let row = Action::AddImage.row();
    if ui.add(Button::new(tr(row.text)).small()).on_hover_text(tr(row.tip)).clicked() {
        asks.push(Ask::Act(Action::AddImage));
    }
}

fn image_row(ui: &mut Ui, told: &PanelContext<'_>, (image, name): (ImageId, &str), asks: &mut Asks) {
    ui.horizontal(|ui| {
        let piece = told.selection.pieces.first().copied();
        let piece = piece.or_else(|| told.document.pattern.pieces.keys().next().copied());
        let place = ui.add_enabled(piece.is_some(), Button::new(tr("Place")).small());
        place.widget_info(|| WidgetInfo::labeled(Role::Button, piece.is_some(), say!("Place {name}", name)));
        let tip = tr("Place it on the selected piece, or the first; drag it there with the tool Graphics");
        if place.on_hover_text(tip).on_disabled_hover_text(tr("There is no piece")).clicked()
            && let Some(found) = piece.and_then(|id| Some((id, told.document.pattern.pieces.get(&id)?)))
        {
            asks.push(Ask::Do(Command::AddGraphic { graphic: first_graphic(image, found.0, found.1) }));
            asks.push(Ask::Act(Action::Choose(Tool::Graphic)));
        }
        let close = ui.add(Button::new("×").small());
        close.widget_info(|| WidgetInfo::labeled(Role::Button, true, say!("Delete {name}", name)));
        if close.on_hover_text(tr("Delete it with its graphics")).clicked() {
            asks.push(Ask::Do(Command::DeleteImage { image }));
        }
        ui.add(egui::Label::new(name).truncate());
    });
}

/// A graphic in the middle of `piece`.
fn first_graphic(image: ImageId, id: PieceId, piece: &Piece) -> Graphic {
    let starts = || piece.outline.iter().map(|edge| edge.start);
    let low = starts().fold(DVec2::INFINITY, DVec2::min);
    let high = starts().fold(DVec2::NEG_INFINITY, DVec2::max);
    let at = if piece.outline.is_empty() { DVec2::ZERO } else { low.midpoint(high) };
    Graphic { piece: id, image, at, width_m: FIRST_WIDTH, angle: 0.0, on_twin: false }
}

/// The numbers of a graphic.
fn graphic_ui(ui: &mut Ui, told: &PanelContext<'_>, id: GraphicId, graphic: &Graphic, asks: &mut Asks) {
    let Some(piece) = told.document.pattern.pieces.get(&graphic.piece) else { return };
    let name = told.document.artwork.images.get(&graphic.image).map_or("", |file| &file.name);
    ui.add_space(2.0);
    ui.horizontal(|ui| {
        let close = ui.add(Button::new("×").small());
        close.widget_info(|| WidgetInfo::labeled(Role::Button, true, say!("Delete graphic {n}", n = id.0)));
        if close.on_hover_text(tr("Delete this graphic")).clicked() {
            asks.push(Ask::Do(Command::DeleteGraphic { id }));
        }
        let words = say!("{image} on {piece}", image = name, piece = piece.name);
        ui.add(egui::Label::new(RichText::new(words).strong()).truncate());
    });
    let mut new = *graphic;
    let mut fields = Vec::new();
    ui.horizontal(|ui| {
        fields.push(millimetres(ui, "x ", &mut new.at.x, -100_000.0..=100_000.0));
        fields.push(millimetres(ui, "y ", &mut new.at.y, -100_000.0..=100_000.0));
    });
    ui.horizontal(|ui| {
        fields.push(millimetres(ui, &format!("{} ", tr("w")), &mut new.width_m, widths()));
        fields.push(degrees_ui(ui, &mut new.angle));
    });
    if piece.twin.is_some() {
        ui.checkbox(&mut new.on_twin, tr("Mirrored on the twin"));
    }
    // A drag over a number is one step.
    let is_dragged = fields.iter().any(|field| field.dragged());
    let is_ended = fields.iter().any(|field| field.drag_stopped() || field.lost_focus());
    if new != *graphic {
        asks.push(Ask::Drag(Command::SetGraphic { id, graphic: new }));
    }
    if is_ended || (new != *graphic && !is_dragged && !fields.iter().any(Response::has_focus)) {
        asks.push(Ask::EndDrag);
    }
}

/// Range of widths, millimetres.
fn widths() -> std::ops::RangeInclusive<f64> {
    let [least, most] = WIDTHS.map(|metres| metres * 1e3);
    least..=most
}

fn millimetres(ui: &mut Ui, name: &str, metres: &mut f64, range: std::ops::RangeInclusive<f64>) -> Response {
    let mut value = *metres * 1e3;
    let field = drag_value(&mut value).range(range).prefix(name).suffix(" mm").max_decimals(1);
    let response = ui.add(field);
    if response.changed() {
        *metres = value / 1e3;
    }
    response
}

fn degrees_ui(ui: &mut Ui, angle: &mut f64) -> Response {
    let mut value = angle.to_degrees();
    let field = drag_value(&mut value).range(-360.0..=360.0).suffix("°").max_decimals(1);
    let response = ui.add(field).on_hover_text(tr("Angle, counter-clockwise"));
    if response.changed() {
        *angle = value.to_radians();
    }
    response
}

/// The image all over a fabric, as a part of `dye`.
pub fn surface_ui(ui: &mut Ui, artwork: &Artwork, dye: &mut Dye) {
    let Some(&first) = artwork.images.keys().next() else {
        ui.add_enabled(false, egui::Checkbox::new(&mut false, tr("Image")))
            .on_disabled_hover_text(tr("Take an image first: Images in the side panel"));
        return;
    };
    let mut has_image = dye.image.is_some();
    let tip = tr("An image all over the cloth");
    if ui.checkbox(&mut has_image, tr("Image")).on_hover_text(tip).changed() {
        dye.image = has_image.then_some(Repeated { image: first, width_m: FIRST_REPEAT, angle: 0.0 });
    }
    let Some(own) = &mut dye.image else { return };
    // A list that drops down would close the menu that this is in.
    egui::ScrollArea::vertical().id_salt("image of the fabric").max_height(IMAGES_HEIGHT).show(ui, |ui| {
        for (&image, file) in &artwork.images {
            ui.selectable_value(&mut own.image, image, &file.name);
        }
    });
    ui.horizontal(|ui| {
        millimetres(ui, &format!("{} ", tr("every")), &mut own.width_m, widths());
        degrees_ui(ui, &mut own.angle);
    });
}
