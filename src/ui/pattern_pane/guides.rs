//! Guides: lines on the table to draw along, dragged out of the rulers and moved.

use egui::{CursorIcon, Pos2, Rect};
use glam::DVec2;

use super::input::Input;
use super::table::Guide;
use super::view::TableView;

/// Largest distance of a press from a guide, points.
const REACH: f32 = 4.0;

/// The guides, and the one being dragged.
#[derive(Debug, Default)]
pub(super) struct Guides {
    /// The guides on the table.
    pub all: Vec<Guide>,
    /// A guide being dragged out of a ruler.
    pub new: Option<Guide>,
    /// The index of a guide being moved, and its old position.
    held: Option<(usize, Guide)>,
    /// The guide under the pointer, which could be dragged.
    near: Option<Guide>,
}

impl Guides {
    /// Whether a guide is being dragged.
    pub fn is_held(&self) -> bool {
        self.held.is_some()
    }

    /// Handles the part of `input` that concerns guides and removes it. `free`: the pointer is over nothing else; `escape`: the
    /// drag is cancelled; `rounded` rounds a position to the grid.
    pub fn step(
        &mut self,
        view: &TableView,
        pane: Rect,
        free: bool,
        input: &mut Input,
        escape: bool,
        rounded: impl Fn(DVec2) -> DVec2,
    ) {
        let at = |p: Option<Pos2>| p.filter(|_| free).and_then(|p| self.at(view, pane, p));
        let (near, pressed) = (at(input.hover), at(input.pressed));
        self.near = near.map(|i| self.all[i]);
        if let Some(i) = pressed {
            self.held = Some((i, self.all[i]));
        }
        let Some((i, was)) = self.held else { return };
        let to = input.trail.last().map(|&p| rounded(view.table_from_screen(pane, p)));
        self.all[i] = match (escape, self.all[i], to) {
            (true, ..) => was,
            (_, Guide::Upright(_), Some(p)) => Guide::Upright(p.x),
            (_, Guide::Level(_), Some(p)) => Guide::Level(p.y),
            (_, still, None) => still,
        };
        if input.let_go || escape {
            self.held = None;
            if !is_seen(view, pane, self.all[i]) {
                self.all.remove(i);
            }
        }
        *input = Input { hover: input.hover, held: input.held, ..Input::default() };
    }

    /// The cursor over a guide or while one is dragged.
    pub fn cursor(&self) -> Option<CursorIcon> {
        Some(match self.held.map(|(_, guide)| guide).or(self.near)? {
            Guide::Upright(_) => CursorIcon::ResizeHorizontal,
            Guide::Level(_) => CursorIcon::ResizeVertical,
        })
    }

    /// Takes a guide that is dragged out of a ruler, and whether it was released.
    pub fn take(&mut self, view: &TableView, pane: Rect, dragged: Option<(Guide, bool)>) {
        self.new = None;
        let Some((guide, let_go)) = dragged else { return };
        match (is_seen(view, pane, guide), let_go) {
            (true, true) => self.all.push(guide),
            (true, false) => self.new = Some(guide),
            _ => {}
        }
    }

    fn at(&self, view: &TableView, pane: Rect, p: Pos2) -> Option<usize> {
        let away = |guide: &Guide| match *guide {
            Guide::Upright(x) => (view.screen_from_table(pane, DVec2::new(x, 0.0)).x - p.x).abs(),
            Guide::Level(y) => (view.screen_from_table(pane, DVec2::new(0.0, y)).y - p.y).abs(),
        };
        let near = self.all.iter().map(away).enumerate().filter(|(_, away)| *away <= REACH);
        near.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(i, _)| i)
    }
}

fn is_seen(view: &TableView, pane: Rect, guide: Guide) -> bool {
    let (lower, upper) = view.seen(pane);
    match guide {
        Guide::Upright(x) => (lower.x..upper.x).contains(&x),
        Guide::Level(y) => (lower.y..upper.y).contains(&y),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::{pos2, vec2};

    #[test]
    fn a_guide_is_moved_put_back_and_taken_away() {
        let view = TableView { centre: DVec2::ZERO, scale: 1000.0 };
        let pane = Rect::from_min_size(pos2(0.0, 0.0), vec2(400.0, 200.0));
        let mut guides = Guides { all: vec![Guide::Upright(0.05)], ..Guides::default() };
        let drag = |guides: &mut Guides, from: f32, to: f32, escape: bool| {
            let (from, to) = (pos2(from, 60.0), pos2(to, 60.0));
            let mut input = Input { hover: Some(from), pressed: Some(from), ..Input::default() };
            guides.step(&view, pane, true, &mut input, false, |p| p);
            assert!(input.pressed.is_none() && guides.is_held(), "the tool sees nothing of it");
            let mut input = Input { hover: Some(to), trail: vec![to], ..Input::default() };
            guides.step(&view, pane, false, &mut input, escape, |p| p);
            let mut input = Input { hover: Some(to), let_go: true, ..Input::default() };
            guides.step(&view, pane, false, &mut input, false, |p| p);
            assert!(!guides.is_held());
        };
        drag(&mut guides, 250.0, 300.0, false);
        assert_eq!(guides.all, [Guide::Upright(0.1)]);
        drag(&mut guides, 300.0, 340.0, true);
        assert_eq!(guides.all, [Guide::Upright(0.1)]);
        drag(&mut guides, 300.0, -20.0, false);
        assert!(guides.all.is_empty());
        let mut input = Input { pressed: Some(pos2(250.0, 60.0)), ..Input::default() };
        guides.step(&view, pane, true, &mut input, false, |p| p);
        assert!(input.pressed.is_some(), "nothing there: the tool's");
    }
}
