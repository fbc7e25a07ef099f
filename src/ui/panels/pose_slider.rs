//! Sliders that lead the dressed body to another pose.

use crate::session::{BodyChoice, Command};
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::panels::context::PanelContext;

/// Whether a slider that leads the body was let go (the cloth follows exactly), or is dragged (it follows as quickly as it
/// can). None while there is nothing to do.
pub fn let_go(slider: &egui::Response, told: &PanelContext<'_>) -> Option<bool> {
    let done = slider.drag_stopped() || (slider.changed() && !slider.dragged());
    let follows = slider.dragged() && slider.changed() && told.now.caught_up;
    (done || follows).then_some(done)
}

/// Asks for a command of such a slider. What was shown as a draft is done again with care.
pub fn follow(command: Command, done: bool, asks: &mut Asks) {
    asks.push(Ask::Drag(command));
    if done {
        asks.push(Ask::EndDrag);
    }
}

/// Asks for the dressed body in another pose.
pub fn posed(body: BodyChoice, draft: bool) -> Command {
    Command::Repose { body, settle: false, draft }
}
