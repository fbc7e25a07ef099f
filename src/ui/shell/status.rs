//! The status bar: a hint about the mouse, and the state of the simulation.

use egui::{Align, Layout, ProgressBar, RichText};

use crate::drag::DragMode;
use crate::sim::{DrapeState, Start, Trying};
use crate::ui::actions::context::{FrameContext, Stops};
use crate::ui::actions::{Action, Tool};
use crate::ui::language::keys::shortcut_text;
use crate::ui::language::{number, say, tr};
use crate::ui::look::theme::Palette;
use crate::ui::shell::pace::{Pace, left_words};
use crate::wrap::Phase;

/// Height of the bar, points.
pub const HEIGHT: f32 = 28.0;

/// Draws the bar.
pub fn status_ui(ui: &mut egui::Ui, now: &FrameContext, hint: &str, palette: &Palette) {
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        let weak = |text: String| RichText::new(text).color(palette.weak).size(12.0);
        if let Some(adapter) = &now.adapter {
            ui.label(weak(short(adapter))).on_hover_text(say!("Drawn by {adapter}", adapter));
            ui.separator();
        }
        let unit = ui.label(weak(now.unit.sign().trim().to_owned()));
        unit.on_hover_text(tr("Lengths are shown in this unit"));
        ui.separator();
        if now.triangles > 0 {
            ui.label(weak(say!("tick {n}", n = now.tick)));
            ui.separator();
            ui.label(weak(say!("{n} triangles", n = grouped(now.triangles))));
            ui.separator();
        }
        if let Some(words) = pace_words(&now.pace) {
            let tip = tr("Pictures of the window a second, and how long a tick of the simulation takes");
            ui.label(weak(words)).on_hover_text(tip);
            ui.separator();
        }
        if let Some(seconds) = now.pace.left {
            ui.label(RichText::new(left_words(seconds)).size(12.0));
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

/// What can be done next, in words.
pub fn next_step(ctx: &egui::Context, now: &FrameContext) -> String {
    let key = |action| match now.keymap.keys(action).first() {
        Some(keys) => shortcut_text(ctx, keys),
        None => tr(action.row().text).to_owned(),
    };
    if now.wrapping {
        return say!("The cloth is being put on the body · {key}: cancel", key = key(Action::Cancel));
    }
    if !now.dressed {
        return if now.is_for_dress() {
            tr("Press Dress: the pieces that stand round the body are sewn and draped.").to_owned()
        } else {
            tr("Paint a mark on a piece and one on the body where it should lie, then press Wrap.").to_owned()
        };
    }
    if now.drape.is_some_and(|drape| drape.way.is_some()) {
        let key = key(if now.stops == Some(Stops::Pose) { Action::Cancel } else { Action::Undo });
        return say!("The cloth is draped on its way to the pose · {key}: back to the pose before", key);
    }
    let drag = Action::Choose(Tool::Drag(DragMode::Surface));
    let mut steps = vec![
        say!("{key}: drag the cloth", key = key(drag)),
        say!("{key}: pin it", key = key(Action::Choose(Tool::Pin))),
        match now.is_on(Action::ToggleDrape) {
            true => say!("{key}: pause draping", key = key(Action::ToggleDrape)),
            false => say!("{key}: drape it", key = key(Action::ToggleDrape)),
        },
    ];
    if !now.working {
        steps.push(tr("View › Map: read its fit").to_owned());
    }
    steps.join(" · ")
}

fn pace_words(pace: &Pace) -> Option<String> {
    let frames = format!("{:.0}", pace.frames?);
    let Some(ms) = pace.tick_ms else { return Some(say!("{frames} fps", frames)) };
    let digits = usize::from(ms < 10.0);
    Some(say!("{frames} fps, {ms} ms a tick", frames, ms = number(ms, digits)))
}

fn phase_words(now: &FrameContext) -> String {
    // While work goes on, it is not all done.
    let percent = (now.progress * 100.0).floor().min(99.0) as u32;
    match now.phase {
        Some(_) if now.trying.is_some() => {
            now.trying.map(|now| trying_words(now, percent)).unwrap_or_default()
        }
        _ if now.wrapping && now.phase != Some(Phase::Growing) => tr("Cutting the cloth").to_owned(),
        None => tr("No cloth on the body").to_owned(),
        Some(_) if now.dragging => tr("In your hand").to_owned(),
        // A change of pose goes on while draping is paused.
        Some(phase)
            if now.drape.is_some_and(|drape| !drape.waits && (drape.runs || phase == Phase::AtRest)) =>
        {
            drape_words(now.drape)
        }
        Some(_) if !now.relaxing => tr("Held still").to_owned(),
        Some(Phase::Growing) => say!("Growing {percent} %", percent),
        Some(Phase::Settling) => say!("Settling {percent} %", percent),
        Some(Phase::AtRest) if now.carried => tr("At rest as carried to the pose").to_owned(),
        Some(Phase::AtRest) => tr("At rest").to_owned(),
    }
}

/// State of draping in words: the residual force as a fraction of the cloth's weight.
fn drape_words(drape: Option<DrapeState>) -> String {
    match drape {
        Some(DrapeState { way: Some(way), .. }) => {
            let percent = (way * 100.0).floor() as u32;
            say!("Draping on the way to the pose: {percent} %", percent)
        }
        Some(drape) if drape.runs && drape.residual > 1.0 => tr("Draping: far out of balance").to_owned(),
        Some(drape) if drape.runs => {
            let percent = number(drape.residual * 100.0, 1);
            match drape.card {
                true => say!("Draping on the graphics card: {percent} % out of balance", percent),
                false => say!("Draping: {percent} % out of balance", percent),
            }
        }
        Some(drape) if !drape.on => tr("Draping paused").to_owned(),
        Some(drape) if drape.restless => tr("Draped, but not at rest").to_owned(),
        _ => tr("Draped, at rest").to_owned(),
    }
}

/// The name of an adapter without its part in brackets, shortened.
fn short(adapter: &str) -> String {
    let name = adapter.split(" (").next().unwrap_or_default();
    if name.chars().count() <= 22 { name.to_owned() } else { name.chars().take(21).chain(['…']).collect() }
}

/// A number with grouped digits: 12345 as "12 345".
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

/// The text of the status bar while starts are tried; `percent` of all of them is done.
pub fn trying_words(now: Trying, percent: u32) -> String {
    let dressing = match now.number {
        0 | 1 => say!("Dressing {percent} %", percent),
        number => say!("Dressing {percent} %, attempt {number}", percent, number),
    };
    let work = match (now.start, now.draped) {
        (Start::Marks, false) => tr("By marks: growing"),
        (Start::Marks, true) => tr("By marks: draping"),
        (Start::Placement, _) => tr("From placement: sewing"),
    };
    format!("{dressing} · {work}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_names_are_short() {
        assert_eq!(grouped(1_234_567), "1\u{2009}234\u{2009}567");
        assert_eq!(short("llvmpipe (LLVM 19.1, 256 bits) (Vulkan)"), "llvmpipe");
        assert_eq!(short("An adapter of a very long name indeed").chars().count(), 22);
    }

    #[test]
    fn later_starts_are_told_with_their_number() {
        let told = |start, draped, number| trying_words(Trying { start, draped, number }, 40);
        assert_eq!(told(Start::Marks, true, 1), "Dressing 40 % · By marks: draping");
        assert_eq!(told(Start::Placement, true, 2), "Dressing 40 %, attempt 2 · From placement: sewing");
    }
}
