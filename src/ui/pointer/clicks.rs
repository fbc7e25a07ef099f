//! All clicks of one frame. A slow frame may contain several at different positions, of which egui reports only one.

use egui::{Event, PointerButton, Pos2, Response};

/// Distance below which two clicks of one frame count as one, from a trembling finger, points.
const SAME: f32 = 8.0;

/// Positions at which `button` was clicked on the widget of `response` since the last frame, in order.
pub fn clicks(ui: &egui::Ui, response: &Response, button: PointerButton) -> Vec<Pos2> {
    if !response.clicked_by(button) {
        return Vec::new();
    }
    let mut places: Vec<Pos2> = ui.input(|input| releases(&input.events, button));
    places.retain(|at| response.interact_rect.contains(*at));
    places.dedup_by(|later, earlier| later.distance(*earlier) < SAME);
    if places.is_empty() {
        // A click by the keyboard or a screen reader.
        places.extend(response.interact_pointer_pos());
    }
    places
}

/// Positions at which the button was released; a drag that began in the same frame is no click.
fn releases(events: &[Event], button: PointerButton) -> Vec<Pos2> {
    let mut pressed_at = None;
    let mut places = Vec::new();
    for event in events {
        let Event::PointerButton { pos, button: of, pressed, .. } = *event else { continue };
        if of == button && pressed {
            pressed_at = Some(pos);
        } else if of == button && pressed_at.take().is_none_or(|from: Pos2| from.distance(pos) < SAME) {
            places.push(pos);
        }
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    fn event(x: f32, pressed: bool) -> Event {
        let (button, modifiers) = (PointerButton::Primary, egui::Modifiers::NONE);
        Event::PointerButton { pos: Pos2::new(x, 0.0), button, pressed, modifiers }
    }

    #[test]
    fn every_click_of_a_frame_counts_and_drags_do_not() {
        let two = [event(1.0, false), event(50.0, true), event(50.0, false)];
        let found = releases(&two, PointerButton::Primary);
        assert_eq!(found, [Pos2::new(1.0, 0.0), Pos2::new(50.0, 0.0)]);
        let dragged = [event(1.0, true), event(50.0, false)];
        assert!(releases(&dragged, PointerButton::Primary).is_empty());
        assert!(releases(&two, PointerButton::Secondary).is_empty());
    }
}
