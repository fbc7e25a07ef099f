//! Nothing hangs: whatever is chosen, however things stand, the next frames come in time.

use std::collections::BTreeMap;
use std::process::abort;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};

use toile::ui::actions::rows::all;
use toile::ui::actions::{Action, Tool};

use super::hand::dressed_window;
use super::*;

/// Frames after which what was chosen is seen.
const FRAMES: usize = 6;
/// Frames after which what was begun is left.
const LAST: usize = 2;
/// Nobody should wait longer for a frame; two busy cores draw the slowest of these in 0.13 s.
const LONGEST: Duration = Duration::from_secs(2);
/// What takes longer does not end, and the tests with it.
const HANGS: Duration = Duration::from_secs(60);

/// Ends the tests with words where something hangs.
struct Watchdog(Sender<String>);

impl Watchdog {
    fn new() -> Self {
        let (beats, heard) = channel::<String>();
        std::thread::spawn(move || {
            let mut at = String::from("the start");
            loop {
                match heard.recv_timeout(HANGS) {
                    Ok(next) => at = next,
                    Err(RecvTimeoutError::Disconnected) => return,
                    Err(RecvTimeoutError::Timeout) => {
                        eprintln!("it hangs: {at}");
                        abort();
                    }
                }
            }
        });
        Self(beats)
    }

    /// Draws a frame of what is being done.
    fn frame(&self, window: &mut Window, what: &str) {
        self.0.send(what.to_owned()).expect("the watchdog lives");
        let start = Instant::now();
        window.run_steps(1);
        assert!(start.elapsed() < LONGEST, "{what}: a frame took {:?}", start.elapsed());
    }

    fn frames(&self, window: &mut Window, what: &str, count: usize) {
        (0..count).for_each(|_| self.frame(window, what));
    }

    /// Clicks, clicks twice, drags and pulls aside in both panes, and lets go of what was begun.
    fn hand(&self, window: &mut Window, what: &str) {
        for label in ["Pattern pane", "Body pane"] {
            let Some(area) = window.query_by_label(label).map(|pane| pane.rect()) else { continue };
            let what = format!("{what}, {label}");
            let path = line(area, Vec2::new(50.0, 20.0));
            let mut to = |event| {
                window.event(event);
                self.frame(window, &what);
            };
            let press = |pos, pressed| Event::PointerButton {
                pos,
                button: PointerButton::Primary,
                pressed,
                modifiers: Modifiers::NONE,
            };
            for pos in [area.center(), area.center(), area.left_top() + Vec2::splat(40.0)] {
                to(Event::PointerMoved(pos));
                to(press(pos, true));
                to(press(pos, false));
            }
            to(Event::PointerMoved(path[0]));
            to(press(path[0], true));
            path.iter().for_each(|&pos| to(Event::PointerMoved(pos)));
            to(press(path[path.len() - 1], false));
        }
        key(window, Modifiers::NONE, Key::Escape);
        self.frames(window, what, LAST);
    }
}

/// Every command there is, in a window of its own for each that has all its pieces selected; tools are used in both panes.
fn choose_all(stands: &str, mut window: Window) {
    let project = window.state_mut().as_mut().expect("the app").session_mut().project();
    let (watchdog, mut chosen) = (Watchdog::new(), BTreeMap::new());
    for action in all() {
        let what = format!("{stands}: {action:?}");
        let mut window = window_on(project.clone(), None);
        for (action, frames) in [(Action::SelectAll, 1), (action, FRAMES)] {
            let ctx = window.ctx.clone();
            window.state_mut().as_mut().expect("the app").act(&ctx, action);
            watchdog.frames(&mut window, &what, frames);
        }
        if matches!(action, Action::Choose(_)) {
            watchdog.hand(&mut window, &what);
        }
        key(&mut window, Modifiers::NONE, Key::Escape);
        watchdog.frames(&mut window, &what, LAST);
        chosen.insert(what, app(&window).frames());
    }
    assert_eq!(chosen.len(), all().count());
    assert!(chosen.values().all(|&frames| frames > FRAMES as u64), "{chosen:?}");
}

#[test]
fn every_command_answers_on_an_empty_table() {
    choose_all("empty", window_on(Project::default(), None));
}

#[test]
fn every_command_answers_on_a_pattern_with_marks() {
    let mut window = window();
    paint_both(&mut window);
    choose_all("marked", window);
}

#[test]
fn every_command_answers_on_a_dressed_body() {
    let mut window = dressed_window();
    let ctx = window.ctx.clone();
    window.state_mut().as_mut().expect("the app").act(&ctx, Action::Choose(Tool::Pin));
    window.run_steps(2);
    let at = pane(&window, "Body pane").center();
    drag(&mut window, &[at, at], PointerButton::Primary);
    assert!(!app(&window).session().document().pins.is_empty(), "no pin");
    choose_all("dressed", window);
}
