//! Hints for the status bar: what the pointer does in the body pane.

use crate::ui::actions::Tool;
use crate::ui::language::say;
use crate::ui::pointer::mouse::Mouse;

/// The hint of the body pane for the status bar.
pub fn hint(tool: Tool, mouse: Mouse, laser: bool, dressed: bool, next: usize) -> String {
    let view = mouse.view_hint();
    match tool {
        Tool::Mark if laser => {
            let far = next + 1;
            say!(
                "Drag: paint mark {next} on the near side and {far} on the far side · L: only the near · {view}",
                next,
                far,
                view
            )
        }
        Tool::Mark if dressed && mouse == Mouse::Paper => say!(
            "Drag on the body: paint mark {next} · Click: pin the cloth · Ctrl+click: erase · {view}",
            next,
            view
        ),
        Tool::Mark => say!(
            "Drag on the body: paint mark {next} · Click: a dot, or select a mark · Ctrl+click: erase · {view}",
            next,
            view
        ),
        Tool::Erase => say!("Click a mark: take it away · {view}", view),
        Tool::Pin => say!("Click: pin the cloth, or pull the pin out · Drag: a row of pins · {view}", view),
        Tool::ClothLine => {
            say!("Click the cloth: a corner of a line on that piece · Drag: turn · {view}", view)
        }
        Tool::Drag(_) => say!("Drag the cloth · Esc: put it back · {view}", view),
        Tool::Bone => say!("Drag through the body: a bone · Ctrl+click a bone: take it away · {view}", view),
        Tool::Place => say!(
            "Click a piece, then a dot: it stands there · Drag a piece, an arrow or a ring: move or turn it · {view}",
            view
        ),
        _ => say!("Drag: turn · {view}", view),
    }
}
