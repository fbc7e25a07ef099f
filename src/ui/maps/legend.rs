//! The legend over the body pane: colour bar, values and histogram.

use egui::accesskit::Role;
use egui::{Align2, Color32, FontId, Frame, Margin, Rect, Sense, Stroke, WidgetInfo, pos2, vec2};

use super::ShownMap;
use crate::ui::actions::Action;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::language::fields::drag_value;
use crate::ui::language::{number, say, tr};
use crate::ui::look::theme::{Palette, colour};

/// Width of the legend, points.
const WIDTH: f32 = 222.0;
/// Height of the colour bar, points.
const BAR: f32 = 150.0;
/// Width of the colour bar, points.
const BAR_WIDTH: f32 = 16.0;
/// Width of the column of values between colour bar and histogram, points.
const TICKS_WIDTH: f32 = 52.0;

/// Margin to the pane's edges, points.
const BESIDE: f32 = 10.0;

/// Draws the legend of `map` in the lower left corner of `pane`, above the `buttons` there if there is no room beside them.
/// `value` is the value under the pointer.
pub fn legend_ui(
    ui: &mut egui::Ui,
    (pane, buttons): (Rect, Option<Rect>),
    map: &ShownMap,
    value: Option<f64>,
    palette: &Palette,
    asks: &mut Asks,
) {
    let size = vec2(WIDTH, BAR + 142.0);
    let corner = pos2(pane.left() + BESIDE, pane.bottom() - size.y - BESIDE);
    let mut area = Rect::from_min_size(corner, size);
    if let Some(buttons) = buttons.filter(|buttons| buttons.expand(BESIDE).intersects(area)) {
        area = area.translate(vec2(0.0, buttons.top() - BESIDE - area.bottom()));
    }
    if pane.width() < WIDTH + 24.0 || area.top() < pane.top() + 50.0 {
        return;
    }
    ui.scope_builder(egui::UiBuilder::new().max_rect(area), |ui| {
        let frame = Frame::new().fill(palette.overlay).inner_margin(Margin::same(9)).corner_radius(6);
        let frame = frame.stroke(Stroke::new(1.0, palette.table_grid_strong));
        frame.show(ui, |ui| {
            ui.set_width(WIDTH - 18.0);
            ui.spacing_mut().item_spacing = vec2(6.0, 4.0);
            title_ui(ui, map, asks);
            bar_ui(ui, map, value, palette);
            range_ui(ui, map, palette, asks);
        });
    });
}

fn title_ui(ui: &mut egui::Ui, map: &ShownMap, asks: &mut Asks) {
    let (unit, _) = map.kind().unit();
    let text = egui::RichText::new(format!("{}, {unit}", map.heading())).size(12.5).strong();
    ui.horizontal(|ui| {
        ui.add(egui::Label::new(text).truncate());
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let close = ui.add(egui::Button::new("×").small().frame(false)).on_hover_text(tr("No map"));
            close.widget_info(|| WidgetInfo::labeled(Role::Button, true, tr("Close the map")));
            if close.clicked() {
                asks.push(Ask::Act(Action::Map(None)));
            }
        });
    });
}

/// Draws colour bar, values, and histogram.
fn bar_ui(ui: &mut egui::Ui, map: &ShownMap, value: Option<f64>, palette: &Palette) {
    let (whole, response) = ui.allocate_exact_size(vec2(ui.available_width(), BAR + 12.0), Sense::hover());
    let legend = map.legend();
    let [from, to] = legend.range.map(|v| number(v, 2));
    let (map_name, unit) = (map.heading(), &legend.unit);
    let words = say!("Legend: {map}, {from} to {to} {unit}", map = map_name, from, to, unit);
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, words.clone()));
    let painter = ui.painter_at(whole);
    let bar = Rect::from_min_size(whole.min + vec2(0.0, 6.0), vec2(BAR_WIDTH, BAR));
    let at = |share: f64| bar.bottom() - BAR * share as f32;
    let span = map.range[1] - map.range[0];
    let mut mesh = egui::Mesh::default();
    const STRIPS: u32 = 64;
    for i in 0..=STRIPS {
        let share = f64::from(i) / f64::from(STRIPS);
        let ink = colour(legend.palette.colour(map.range[0] + span * share, map.range));
        mesh.colored_vertex(pos2(bar.left(), at(share)), ink);
        mesh.colored_vertex(pos2(bar.right(), at(share)), ink);
        if i > 0 {
            let k = 2 * i;
            mesh.add_triangle(k - 2, k - 1, k);
            mesh.add_triangle(k - 1, k, k + 1);
        }
    }
    painter.add(mesh);
    let ink = ui.visuals().text_color();
    for (i, words) in legend.ticks().iter().enumerate() {
        let y = at(i as f64 / 4.0);
        painter.hline(bar.right()..=bar.right() + 4.0, y, Stroke::new(1.0, ink));
        let place = pos2(bar.right() + 7.0, y);
        painter.text(place, Align2::LEFT_CENTER, words, FontId::proportional(11.5), ink);
    }
    let left = bar.right() + TICKS_WIDTH;
    histogram(&painter, map, Rect::from_min_max(pos2(left, bar.top()), pos2(whole.right(), bar.bottom())));
    if let Some(value) = value.filter(|_| span > 0.0) {
        let y = at(((value - map.range[0]) / span).clamp(0.0, 1.0));
        let stroke = Stroke::new(2.0, palette.accent);
        painter.hline(bar.left()..=bar.right() + 5.0, y, stroke);
        let text = painter.layout_no_wrap(map.words(value), FontId::proportional(12.5), ink);
        let place = Align2::RIGHT_CENTER.anchor_size(pos2(whole.right() - 3.0, y), text.size());
        painter.rect_filled(place.expand2(vec2(3.0, 1.0)), 3.0, palette.overlay.to_opaque());
        painter.galley(place.min, text, ink);
    }
}

/// Draws the histogram as horizontal bars, one for each step of the colours.
fn histogram(painter: &egui::Painter, map: &ShownMap, area: Rect) {
    let counts = &map.histogram.counts;
    let most = counts.iter().copied().max().unwrap_or(0).max(1) as f32;
    let height = area.height() / counts.len().max(1) as f32;
    let palette = map.palette();
    for (i, &count) in counts.iter().enumerate() {
        let middle = (map.histogram.borders[i] + map.histogram.borders[i + 1]) / 2.0;
        let width = area.width() * count as f32 / most;
        let bottom = area.bottom() - height * i as f32;
        let bar = Rect::from_min_max(
            pos2(area.left(), bottom - height + 0.5),
            pos2(area.left() + width, bottom - 0.5),
        );
        painter.rect_filled(bar, 0.0, colour(palette.colour(middle, map.range)));
        // Bars in pale colours need an outline on a light background.
        let ink = Color32::from_gray(128).gamma_multiply(0.5);
        painter.rect_stroke(bar, 0.0, Stroke::new(0.6, ink), egui::StrokeKind::Inside);
    }
}

fn range_ui(ui: &mut egui::Ui, map: &ShownMap, palette: &Palette, asks: &mut Asks) {
    let (unit, times) = map.kind().unit();
    let [mut from, mut to] = map.range.map(|v| v * times);
    let speed = ((to - from).abs() / 200.0).max(0.001);
    let mut changed = false;
    ui.horizontal(|ui| {
        for (value, name) in [(&mut from, "Range from"), (&mut to, "Range to")] {
            let drag = drag_value(value).speed(speed).max_decimals(2).range(-1e4..=1e4);
            let field = ui.add(drag);
            field.widget_info(|| WidgetInfo::labeled(Role::SpinButton, true, tr(name)));
            changed |= field.changed();
            if name == "Range from" {
                ui.label(tr("to"));
            }
        }
        ui.label(unit);
    });
    if changed && from < to {
        asks.push(Ask::MapRange(map.kind(), Some([from, to])));
    }
    ui.horizontal(|ui| {
        let mut automatic = map.is_automatic;
        let tip = tr("From the smallest to the largest hundredth of the values");
        if ui.checkbox(&mut automatic, tr("Automatic range")).on_hover_text(tip).changed() {
            asks.push(Ask::MapRange(map.kind(), (!automatic).then_some([from, to])));
        }
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let entry = Action::ToggleMapTable.row();
            if ui.small_button(tr("Table")).on_hover_text(tr(entry.tip)).clicked() {
                asks.push(Ask::Act(Action::ToggleMapTable));
            }
        });
    });
    let (median, most) = (map.words(map.stats.median), map.words(map.stats.p99));
    let words = say!("median {median}, 99 % below {most}", median, most);
    ui.add(egui::Label::new(egui::RichText::new(words).size(11.5).color(palette.weak)).truncate());
}
