//! Colours and spacing of the dark and the light theme.

use egui::{Color32, CornerRadius, Margin, Stroke, Theme, Vec2, Visuals};

use crate::pattern::activity::Activity;
use crate::render::{Look, Rgb};

/// Colours that egui has no place for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Palette {
    /// Primary actions and selected items.
    pub accent: Color32,
    /// Text on `accent`.
    pub on_accent: Color32,
    /// Background of the pattern pane.
    pub table: Color32,
    /// Grid lines every 10 cm.
    pub table_grid: Color32,
    /// Grid lines every 50 cm.
    pub table_grid_strong: Color32,
    /// Fill and outline of a piece seen from its front.
    pub front: [Color32; 2],
    /// Fill and outline of a piece seen from its back.
    pub back: [Color32; 2],
    /// Fill and outline of pieces on layers 1 to 4 seen from their front, with the hues they have on the body.
    pub over: [[Color32; 2]; 4],
    /// The colour that is mixed into frozen pieces.
    pub frozen: Color32,
    /// Lines between sewn edges.
    pub thread: Color32,
    /// Names of pieces.
    pub piece_text: Color32,
    /// Border around marks and numbers.
    pub halo: Color32,
    /// Warnings.
    pub warning: Color32,
    /// Errors.
    pub error: Color32,
    /// Secondary text; still readable.
    pub weak: Color32,
    /// Small frames over a pane.
    pub overlay: Color32,
    /// Guides.
    pub guide: Color32,
    /// Inside of points that can be dragged.
    pub knob: Color32,
    /// Saturation and value of the colours of seams.
    pub seam_tone: [f32; 2],
}

impl Palette {
    /// The palette of `theme`.
    pub fn of(theme: Theme) -> Self {
        match theme {
            Theme::Light => Self {
                accent: rgb(0x2b7a57),
                on_accent: rgb(0xffffff),
                table: rgb(0xfafbfc),
                table_grid: rgb(0xeef1f4),
                table_grid_strong: rgb(0xe0e5ea),
                front: [rgb(0xd9ead6), rgb(0x4b7d50)],
                back: [rgb(0xf7dde2), rgb(0xa8616f)],
                over: [
                    [rgb(0xd6e7f9), rgb(0x4b6f9b)],
                    [rgb(0xf1e4cb), rgb(0x8a6d2a)],
                    [rgb(0xf0e0f5), rgb(0x7d5f8c)],
                    [rgb(0xe1e6eb), rgb(0x5f6b78)],
                ],
                frozen: rgb(0xc4dcf7),
                thread: rgb(0x8a939d),
                piece_text: rgb(0x46564a),
                halo: rgb(0xffffff),
                warning: rgb(0x8a5a00),
                error: rgb(0xb3261e),
                weak: rgb(0x58626d),
                overlay: Color32::from_rgba_unmultiplied(255, 255, 255, 235),
                guide: rgb(0x3b8fc4),
                knob: rgb(0xffffff),
                seam_tone: [0.85, 0.66],
            },
            Theme::Dark => Self {
                accent: rgb(0x2f8560),
                on_accent: rgb(0xffffff),
                table: rgb(0x1e2125),
                table_grid: rgb(0x262a2f),
                table_grid_strong: rgb(0x31363d),
                front: [rgb(0x34493a), rgb(0x8fbf90)],
                back: [rgb(0x553841), rgb(0xdfa4b1)],
                over: [
                    [rgb(0x2c475c), rgb(0x8fb4dc)],
                    [rgb(0x51431d), rgb(0xd6b875)],
                    [rgb(0x503e56), rgb(0xc3a3d0)],
                    [rgb(0x40454a), rgb(0xa9b4bf)],
                ],
                frozen: rgb(0x2c4a72),
                thread: rgb(0x8f99a4),
                piece_text: rgb(0xcbd9cd),
                halo: rgb(0xf4f6f8),
                warning: rgb(0xf0b95a),
                error: rgb(0xff8a80),
                weak: rgb(0xa9b2bc),
                overlay: Color32::from_rgba_unmultiplied(36, 39, 44, 235),
                guide: rgb(0x4f9fd0),
                knob: rgb(0x1e2125),
                seam_tone: [0.66, 0.92],
            },
        }
    }
}

/// How much of the cloth's colour a piece in the pattern pane has.
const DYED: f32 = 0.42;

impl Palette {
    /// Fill and outline of a piece, by side, layer and activity. Layers have the hues that they have on the body.
    pub fn piece(&self, front: bool, layer: u8, activity: Activity) -> [Color32; 2] {
        let [cloth, line] = match (front, usize::from(layer)) {
            (false, _) => self.back,
            (true, 0) => self.front,
            (true, layer) => self.over[(layer - 1) % self.over.len()],
        };
        match activity {
            Activity::Active => [cloth, line],
            Activity::Frozen => [cloth.lerp_to_gamma(self.frozen, 0.6), line],
            Activity::Deactivated => {
                [cloth.lerp_to_gamma(self.table, 0.75), line.lerp_to_gamma(self.table, 0.4)]
            }
        }
    }

    /// Fill of an active piece seen from its front, whose cloth has this colour: as pale as those of the layers, so that lines and
    /// words stay readable on it.
    pub fn dyed(&self, cloth: Color32) -> Color32 {
        self.table.lerp_to_gamma(cloth, DYED)
    }

    /// The colour of the seam with this number, for both its edges; consecutive numbers have different hues.
    pub fn seam(&self, number: u32) -> Color32 {
        let [saturation, value] = self.seam_tone;
        // Multiples of the golden ratio keep the hues of any number of seams apart.
        let hue = (number as f32 * 0.618_034).fract();
        egui::ecolor::Hsva::new(hue, saturation, value, 1.0).into()
    }
}

/// Colours and light of the body pane under `theme`.
pub fn look(theme: Theme) -> Look {
    match theme {
        Theme::Light => Look::light(),
        Theme::Dark => Look::dark(),
    }
}

/// The colour as egui's type.
pub fn colour(c: Rgb) -> Color32 {
    Color32::from_rgb(c[0], c[1], c[2])
}

const fn rgb(hex: u32) -> Color32 {
    Color32::from_rgb((hex >> 16) as u8, (hex >> 8) as u8, hex as u8)
}

/// Sets the styles of both themes in `ctx`.
pub fn install(ctx: &egui::Context) {
    ctx.set_visuals_of(Theme::Light, visuals(Theme::Light));
    ctx.set_visuals_of(Theme::Dark, visuals(Theme::Dark));
    ctx.all_styles_mut(|style| {
        style.spacing.item_spacing = Vec2::new(8.0, 6.0);
        style.spacing.button_padding = Vec2::new(9.0, 4.0);
        style.spacing.interact_size.y = 24.0;
        style.spacing.menu_margin = Margin::same(6);
        style.spacing.slider_width = 120.0;
        for (kind, size) in [
            (egui::TextStyle::Body, 13.5),
            (egui::TextStyle::Button, 13.5),
            (egui::TextStyle::Small, 11.5),
            (egui::TextStyle::Heading, 17.0),
        ] {
            if let Some(font) = style.text_styles.get_mut(&kind) {
                font.size = size;
            }
        }
    });
}

fn visuals(theme: Theme) -> Visuals {
    let palette = Palette::of(theme);
    let (mut v, panel, window, text, line) = match theme {
        Theme::Light => (Visuals::light(), rgb(0xf3f5f7), rgb(0xfcfdfd), rgb(0x20262c), rgb(0xd9dee3)),
        Theme::Dark => (Visuals::dark(), rgb(0x25282d), rgb(0x2b2f35), rgb(0xe3e7eb), rgb(0x3b4047)),
    };
    v.panel_fill = panel;
    v.window_fill = window;
    v.window_stroke = Stroke::new(1.0, line);
    v.widgets.noninteractive.bg_stroke = Stroke::new(1.0, line);
    v.widgets.noninteractive.fg_stroke.color = text;
    v.widgets.inactive.fg_stroke.color = text;
    v.weak_text_color = Some(palette.weak);
    v.warn_fg_color = palette.warning;
    v.error_fg_color = palette.error;
    v.hyperlink_color = palette.accent;
    v.slider_trailing_fill = true;
    for widget in [
        &mut v.widgets.noninteractive,
        &mut v.widgets.inactive,
        &mut v.widgets.hovered,
        &mut v.widgets.active,
        &mut v.widgets.open,
    ] {
        widget.corner_radius = CornerRadius::same(5);
    }
    let (idle, hover) = match theme {
        Theme::Light => (rgb(0xe5e9ed), rgb(0xdae0e5)),
        Theme::Dark => (rgb(0x363b42), rgb(0x424850)),
    };
    (v.widgets.inactive.weak_bg_fill, v.widgets.inactive.bg_fill) = (idle, idle);
    (v.widgets.hovered.weak_bg_fill, v.widgets.hovered.bg_fill) = (hover, hover);
    v.selection.bg_fill = match theme {
        Theme::Light => rgb(0xc4e3d2),
        Theme::Dark => rgb(0x2c5c47),
    };
    v.selection.stroke = Stroke::new(1.0, if theme == Theme::Light { rgb(0x0f4a31) } else { rgb(0xe8fff4) });
    v
}

#[cfg(test)]
mod tests {
    use super::*;

    /// WCAG 2.1 contrast ratio.
    fn contrast(a: Color32, b: Color32) -> f32 {
        let luminance = |c: Color32| {
            let [r, g, b, _] = egui::Rgba::from(c).to_array();
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        let (x, y) = (luminance(a) + 0.05, luminance(b) + 0.05);
        (x / y).max(y / x)
    }

    #[test]
    fn text_can_be_read_in_both_themes() {
        for theme in [Theme::Light, Theme::Dark] {
            let (v, p) = (visuals(theme), Palette::of(theme));
            let text = v.widgets.noninteractive.fg_stroke.color;
            for (what, ink, paper) in [
                ("text", text, v.panel_fill),
                ("text in menus", text, v.window_fill),
                ("buttons", v.widgets.inactive.fg_stroke.color, v.widgets.inactive.weak_bg_fill),
                ("weak text", p.weak, v.panel_fill),
                ("warnings", p.warning, v.panel_fill),
                ("errors", p.error, v.panel_fill),
                ("primary button", p.on_accent, p.accent),
                ("chosen", v.selection.stroke.color, v.selection.bg_fill),
                ("front of pieces", p.piece_text, p.front[0]),
                ("back of pieces", p.piece_text, p.back[0]),
                ("pieces worn over others", p.piece_text, p.over[0][0]),
                ("over those", p.piece_text, p.over[1][0]),
                ("and those", p.piece_text, p.over[2][0]),
                ("outermost pieces", p.piece_text, p.over[3][0]),
                ("frozen pieces", p.piece_text, p.piece(true, 0, Activity::Frozen)[0]),
                ("deactivated pieces", p.piece_text, p.piece(true, 0, Activity::Deactivated)[0]),
                ("their backs", p.piece_text, p.piece(false, 0, Activity::Deactivated)[0]),
                ("backs of frozen ones", p.piece_text, p.piece(false, 0, Activity::Frozen)[0]),
            ] {
                let ratio = contrast(ink, paper);
                assert!(ratio >= 4.5, "{theme:?} {what}: {ratio}");
            }
        }
    }
}
