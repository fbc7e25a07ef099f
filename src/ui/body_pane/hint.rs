//! Hints for the status bar: what the pointer does in the body pane.

use crate::ui::actions::Tool;
use crate::ui::pointer::mouse::Mouse;

/// The hint of the body pane for the status bar.
pub fn hint(tool: Tool, mouse: Mouse, laser: bool, dressed: bool, next: usize) -> String {
    let view = mouse.view_hint();
    match tool {
        Tool::Mark if laser => {
            let far = next + 1;
            format!(
                "Drag: paint mark {next} on the near side and {far} on the far side · L: only the near · {view}"
            )
        }
        Tool::Mark => {
            let click =
                if dressed && mouse == Mouse::Paper { "pin the cloth" } else { "a dot, or select a mark" };
            format!("Drag on the body: paint mark {next} · Click: {click} · Ctrl+click: erase · {view}")
        }
        Tool::Erase => format!("Click a mark: take it away · {view}"),
        Tool::Pin => format!("Click: pin the cloth, or pull the pin out · Drag: a row of pins · {view}"),
        Tool::Drag(_) => format!("Drag the cloth · Esc: put it back · {view}"),
        Tool::Bone => format!("Drag through the body: a bone · Ctrl+click a bone: take it away · {view}"),
        Tool::Place => format!(
            "Click a piece, then a dot: it stands there · Drag a piece, an arrow or a ring: move or turn it · {view}"
        ),
        _ => format!("Drag: turn · {view}"),
    }
}
