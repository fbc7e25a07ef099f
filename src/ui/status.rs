//! The status bar: what the mouse does here, and what the simulation does now.

use egui::{Align, Layout, ProgressBar, RichText};

use crate::ui::situation::Situation;
use crate::ui::theme::Palette;
use crate::wrap::Phase;

/// Height of the bar, points.
pub const HEIGHT: f32 = 28.0;

/// Draws the bar.
pub fn status_ui(ui: &mut egui::Ui, now: &Situation, hint: &str, palette: &Palette) {
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        let weak = |text: String| RichText::new(text).color(palette.weak).size(12.0);
        if now.triangles > 0 {
            ui.label(weak(format!("tick {}", now.tick)));
            ui.separator();
            ui.label(weak(format!("{} triangles", grouped(now.triangles))));
            ui.separator();
        }
        if now.working && now.phase.is_some() && !now.dragging {
            let bar = ProgressBar::new(now.progress as f32).desired_width(96.0).desired_height(8.0);
            ui.add(bar.fill(palette.accent));
        }
        ui.label(RichText::new(phase_words(now)).size(12.0));
        ui.separator();
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
            ui.add(egui::Label::new(weak(hint.to_owned())).truncate());
        });
    });
}

fn phase_words(now: &Situation) -> String {
    let percent = (now.progress * 100.0).floor() as u32;
    match now.phase {
        _ if now.wrapping && now.phase != Some(Phase::Growing) => "Cutting the cloth".to_owned(),
        None => "No cloth on the body".to_owned(),
        Some(_) if now.dragging => "In your hand".to_owned(),
        Some(_) if !now.relaxing => "Held still".to_owned(),
        Some(Phase::Growing) => format!("Growing {percent} %"),
        Some(Phase::Settling) => format!("Settling {percent} %"),
        Some(Phase::AtRest) => "At rest".to_owned(),
    }
}

/// 12345 as "12 345".
fn grouped(n: usize) -> String {
    let digits = n.to_string();
    let mut out = String::new();
    for (i, c) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            out.push('\u{2009}');
        }
        out.push(c);
    }
    out
}
