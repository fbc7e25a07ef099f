//! The overlay shown while files are dragged over the window: it says what each pane will do with them.

use std::path::Path;

use egui::{Align2, Color32, FontId, Id, LayerId, Order, Rect, Stroke, StrokeKind};

use crate::io::pattern_formats::PatternFormat;
use crate::ui::language::{say, tr};
use crate::ui::look::theme::Palette;

/// What happens with a dropped file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dropped {
    /// It is opened as a project.
    Project,
    /// It is imported as a pattern.
    Pattern,
    /// It is imported as the body.
    Body,
    /// It is taken as an image.
    Image,
    /// It becomes the environment map.
    Environment,
    /// It cannot be read.
    Nothing,
}

impl Dropped {
    /// Determined by the extension of the file.
    pub fn of(path: &Path) -> Self {
        let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
        let is_pattern = |ending: &str| PatternFormat::of_ending(ending).is_some_and(PatternFormat::is_read);
        match extension.as_deref() {
            Some("toile") => Self::Project,
            Some(ending) if is_pattern(ending) => Self::Pattern,
            Some("obj" | "glb" | "gltf") => Self::Body,
            Some("png" | "jpg" | "jpeg") => Self::Image,
            Some("hdr") => Self::Environment,
            _ => Self::Nothing,
        }
    }

    /// What the pattern pane and the body pane will do, in words; None for nothing.
    fn words(self, name: &str) -> [Option<String>; 2] {
        match self {
            Self::Project => {
                [Some(say!("Open the project {name}", name)), Some(tr("with its body and cloth").to_owned())]
            }
            Self::Pattern => [Some(say!("Lay the pieces of {name} on the table", name)), None],
            Self::Body => [None, Some(say!("{name} becomes the body", name))],
            Self::Image => [Some(say!("Take the image {name} into the project", name)), None],
            Self::Environment => [None, Some(say!("{name} lights the scene", name))],
            Self::Nothing => [
                Some(say!("{name}: not a project (.toile) or pattern (.dxf, .svg, .json)", name)),
                Some(
                    tr("nor a body (.obj, .glb, .gltf), image (.png, .jpg) or environment map (.hdr)")
                        .to_owned(),
                ),
            ],
        }
    }
}

/// Draws the overlay over both `panes`.
pub fn ui(ctx: &egui::Context, palette: &Palette, panes: [Option<Rect>; 2]) {
    let held = ctx.input(|i| i.raw.hovered_files.clone());
    let Some(first) = held.first() else { return };
    let path = first.path.clone().unwrap_or_default();
    let name = match path.file_name() {
        Some(name) => name.to_string_lossy().into_owned(),
        None => tr("the file").to_owned(),
    };
    let dropped = Dropped::of(&path);
    let painter = ctx.layer_painter(LayerId::new(Order::Foreground, Id::unique("dropped files")));
    for ((pane, words), what) in
        panes.into_iter().zip(dropped.words(&name)).zip(["pattern pane", "body pane"])
    {
        let Some(pane) = pane else { continue };
        let (ink, line) = match (&words, dropped) {
            (_, Dropped::Nothing) => (palette.error, palette.error),
            (Some(_), _) => (ctx.style_of(ctx.theme()).visuals.text_color(), palette.accent),
            (None, _) => (palette.weak, Color32::TRANSPARENT),
        };
        painter.rect_filled(pane, 0.0, palette.overlay.gamma_multiply(0.92));
        painter.rect_stroke(pane.shrink(10.0), 8.0, Stroke::new(2.5, line), StrokeKind::Inside);
        let words = words.unwrap_or_else(|| tr("Nothing changes here").to_owned());
        let text = painter.layout(words.clone(), FontId::proportional(17.0), ink, pane.width() - 60.0);
        let at = Align2::CENTER_CENTER.align_size_within_rect(text.size(), pane).min;
        painter.galley(at, text, ink);
        egui::Area::new(Id::unique("dropped").with(what)).fixed_pos(pane.min).interactable(false).show(
            ctx,
            |ui| {
                let node = ui.interact(pane, ui.scope_id().with(what), egui::Sense::hover());
                node.widget_info(|| {
                    let name = format!("{}: {words}", tr(what));
                    egui::WidgetInfo::labeled(egui::accesskit::Role::Status, true, name)
                });
            },
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_go_where_their_name_says() {
        for (name, goes) in [
            ("a/Shirt.TOILE", Dropped::Project),
            ("b.dxf", Dropped::Pattern),
            ("b.Svg", Dropped::Pattern),
            ("c.json", Dropped::Pattern),
            ("d.obj", Dropped::Body),
            ("d.GLB", Dropped::Body),
            ("e.png", Dropped::Image),
            ("f.HDR", Dropped::Environment),
            ("e.gif", Dropped::Nothing),
            ("e.exr", Dropped::Nothing),
            ("toile", Dropped::Nothing),
        ] {
            assert_eq!(Dropped::of(Path::new(name)), goes, "{name}");
        }
    }
}
