//! Sliders that move the dressed body to another pose.

use crate::session::{BodyChoice, Command};
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::panels::context::PanelContext;

/// The state of a slider that moves the body: Some(true) when it was released (the cloth follows exactly), Some(false) while it
/// is dragged (the cloth follows as a fast draft), None while there is nothing to do.
pub fn let_go(slider: &egui::Response, told: &PanelContext<'_>) -> Option<bool> {
    let done = slider.drag_stopped() || (slider.changed() && !slider.dragged());
    let follows = slider.dragged() && slider.changed() && told.now.caught_up;
    (done || follows).then_some(done)
}

/// Requests the command of such a slider. When it is released, the draft is replaced by an exact result.
pub fn follow(command: Command, done: bool, asks: &mut Asks) {
    asks.push(Ask::Drag(command));
    if done {
        asks.push(Ask::EndDrag);
    }
}

/// The command that puts the dressed body in another pose.
pub fn posed(body: BodyChoice, draft: bool) -> Command {
    Command::Repose { body, settle: false, draft }
}
