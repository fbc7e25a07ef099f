//! Text fields for numbers with units and arithmetic. An entry takes effect when Enter is pressed or the field loses the focus.

use egui::{Key, Response, TextEdit};

use crate::ui::language::short;
use crate::ui::preferences::units::{LengthUnit, degrees, length, number};

/// Width of a field, points.
const WIDTH: f32 = 66.0;
/// Margin around the text in a field.
const MARGIN: egui::Margin = egui::Margin::symmetric(4, 3);

/// A field for a length in metres; returns a newly entered value.
pub fn length_field(
    ui: &mut egui::Ui,
    salt: impl egui::AsIdSalt,
    label: &Response,
    metres: f64,
    unit: LengthUnit,
) -> Option<f64> {
    field(ui, salt, label, &unit.text(metres), |text| length(text, unit))
}

/// A field for an angle in radians, shown in degrees; returns a newly entered value.
pub fn angle_field(
    ui: &mut egui::Ui,
    salt: impl egui::AsIdSalt,
    label: &Response,
    radians: f64,
) -> Option<f64> {
    let read = |text: &str| number(text.trim().trim_end_matches('°')).map(f64::to_radians);
    field(ui, salt, label, &format!("{}°", degrees(radians)), read)
}

/// A field for a plain number; returns a newly entered value.
pub fn number_field(
    ui: &mut egui::Ui,
    salt: impl egui::AsIdSalt,
    label: &Response,
    value: f64,
) -> Option<f64> {
    field(ui, salt, label, &short(value, 4), number)
}

fn field(
    ui: &mut egui::Ui,
    salt: impl egui::AsIdSalt,
    label: &Response,
    shown: &str,
    read: impl Fn(&str) -> Result<f64, String>,
) -> Option<f64> {
    let id = ui.scope_id().with(salt);
    let typed = ui.data(|d| d.get_temp::<String>(id));
    let mut text = typed.unwrap_or_else(|| shown.to_owned());
    let response = ui
        .add_sized([WIDTH, 22.0], TextEdit::singleline(&mut text).id(id).margin(MARGIN))
        .labelled_by(label.id);
    let wrong = (text != shown).then(|| read(&text).err()).flatten();
    if let Some(why) = &wrong {
        response.show_tooltip_text(egui::RichText::new(why).color(ui.visuals().error_fg_color));
    }
    if response.has_focus() {
        ui.data_mut(|d| d.insert_temp(id, text));
        return None;
    }
    ui.data_mut(|d| d.remove_temp::<String>(id));
    let given_up = ui.input(|i| i.key_pressed(Key::Escape));
    (response.lost_focus() && !given_up && text != shown).then(|| read(&text).ok()).flatten()
}
