//! Colours and spacing of the themes.

use egui::{Color32, CornerRadius, Margin, Stroke, ThemePreference, Vec2, Visuals};

use crate::pattern::activity::Activity;
use crate::render::{Look, Rgb};
use crate::ui::look::contrast::{contrast, readable};
use crate::ui::look::scheme::{Scheme, Theme};

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
    /// Opacity of seams that are neither selected nor under the pointer.
    pub faint: f32,
    /// How much of the cloth's colour a piece in the pattern pane has, 0..=1.
    pub dyed: f32,
    /// Width of the outline of a piece, and of one that is selected or under the pointer, points.
    pub outline: [f32; 2],
    /// The button that stops something.
    pub stop: Color32,
    /// Least contrast of text on its ground.
    pub least: f32,
}

impl Palette {
    /// The palette of `scheme`.
    pub fn of(scheme: Scheme) -> Self {
        match scheme {
            Scheme::Light => Self::light(),
            Scheme::Dark => Self::dark(),
            Scheme::HighContrast => Self::high_contrast(),
        }
    }

    fn light() -> Self {
        Self {
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
            guide: rgb(0x1f6a9a),
            knob: rgb(0xffffff),
            seam_tone: [0.85, 0.66],
            faint: 0.42,
            dyed: 0.42,
            outline: [1.4, 2.4],
            stop: rgb(0xb3261e),
            least: 4.5,
        }
    }

    fn dark() -> Self {
        Self {
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
            guide: rgb(0x7cc0ea),
            knob: rgb(0x1e2125),
            seam_tone: [0.66, 0.92],
            faint: 0.42,
            dyed: 0.42,
            outline: [1.4, 2.4],
            stop: rgb(0xb03a33),
            least: 4.5,
        }
    }

    fn high_contrast() -> Self {
        Self {
            accent: rgb(0xffe14d),
            on_accent: rgb(0x000000),
            table: rgb(0x000000),
            table_grid: rgb(0x5e5e5e),
            table_grid_strong: rgb(0x808080),
            front: [rgb(0x10261a), rgb(0xb8ffc4)],
            back: [rgb(0x33121b), rgb(0xffc2cf)],
            over: [
                [rgb(0x0c2440), rgb(0xa8d4ff)],
                [rgb(0x332700), rgb(0xffdf80)],
                [rgb(0x2d1238), rgb(0xf0bfff)],
                [rgb(0x262626), rgb(0xe6e6e6)],
            ],
            frozen: rgb(0x0a2a55),
            thread: rgb(0xd0d0d0),
            piece_text: rgb(0xffffff),
            halo: rgb(0xffffff),
            warning: rgb(0xffd75e),
            error: rgb(0xff9a90),
            weak: rgb(0xd4d4d4),
            overlay: rgb(0x000000),
            guide: rgb(0x8fd8ff),
            knob: rgb(0x000000),
            seam_tone: [0.4, 1.0],
            faint: 0.85,
            dyed: 0.28,
            outline: [2.0, 3.6],
            stop: rgb(0xff9a90),
            least: 7.0,
        }
    }
}

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

    /// Fill of an active piece seen from its front, whose cloth has this colour: as pale as those of the layers, so that lines
    /// stay visible on it.
    pub fn dyed(&self, cloth: Color32) -> Color32 {
        self.table.lerp_to_gamma(cloth, self.dyed)
    }

    /// The colour of the name of a piece with this fill.
    pub fn name_on(&self, fill: Color32) -> Color32 {
        readable(self.piece_text, fill, self.least)
    }

    /// Ground and ink of a small label: as given, or changed until it can be read.
    pub fn label(&self, paper: Color32, ink: Color32) -> [Color32; 2] {
        let ink = readable(ink, paper, self.least);
        if contrast(ink, paper) >= self.least { [paper, ink] } else { [Color32::BLACK, Color32::WHITE] }
    }

    /// The colour of the seam with this number, for both its edges; consecutive numbers have different hues.
    pub fn seam(&self, number: u32) -> Color32 {
        let [saturation, value] = self.seam_tone;
        // Multiples of the golden ratio keep the hues of any number of seams apart.
        let hue = (number as f32 * 0.618_034).fract();
        egui::ecolor::Hsva::new(hue, saturation, value, 1.0).into()
    }
}

/// Colours and light of the body pane under `scheme`.
pub fn look(scheme: Scheme) -> Look {
    match scheme {
        Scheme::Light => Look::light(),
        Scheme::Dark => Look::dark(),
        Scheme::HighContrast => Look::high_contrast(),
    }
}

/// The colour as egui's type.
pub fn colour(c: Rgb) -> Color32 {
    Color32::from_rgb(c[0], c[1], c[2])
}

const fn rgb(hex: u32) -> Color32 {
    Color32::from_rgb((hex >> 16) as u8, (hex >> 8) as u8, hex as u8)
}

/// Sets the styles of egui's two themes in `ctx`.
pub fn install(ctx: &egui::Context) {
    ctx.set_visuals_of(egui::Theme::Light, visuals(Scheme::Light));
    ctx.set_visuals_of(egui::Theme::Dark, visuals(Scheme::Dark));
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

/// Shows `theme` in `ctx`.
pub fn choose(ctx: &egui::Context, theme: Theme) {
    let dark = if theme == Theme::HighContrast { Scheme::HighContrast } else { Scheme::Dark };
    ctx.set_visuals_of(egui::Theme::Dark, visuals(dark));
    ctx.set_theme(ThemePreference::from(theme));
}

/// Colours of egui's widgets that the palette has not.
struct Grounds {
    panel: Color32,
    window: Color32,
    text: Color32,
    /// Borders and separators.
    line: Color32,
    /// A button, and one under the pointer.
    button: [Color32; 2],
    /// Ground and ink of what is chosen.
    chosen: [Color32; 2],
}

impl Grounds {
    const fn of(scheme: Scheme) -> Self {
        match scheme {
            Scheme::Light => Self {
                panel: rgb(0xf3f5f7),
                window: rgb(0xfcfdfd),
                text: rgb(0x20262c),
                line: rgb(0xd9dee3),
                button: [rgb(0xe5e9ed), rgb(0xdae0e5)],
                chosen: [rgb(0xc4e3d2), rgb(0x0f4a31)],
            },
            Scheme::Dark => Self {
                panel: rgb(0x25282d),
                window: rgb(0x2b2f35),
                text: rgb(0xe3e7eb),
                line: rgb(0x3b4047),
                button: [rgb(0x363b42), rgb(0x424850)],
                chosen: [rgb(0x2c5c47), rgb(0xe8fff4)],
            },
            Scheme::HighContrast => Self {
                panel: rgb(0x000000),
                window: rgb(0x000000),
                text: rgb(0xffffff),
                line: rgb(0xd4d4d4),
                button: [rgb(0x000000), rgb(0x303030)],
                chosen: [rgb(0x00307a), rgb(0xffe14d)],
            },
        }
    }
}

fn visuals(scheme: Scheme) -> Visuals {
    let (palette, grounds) = (Palette::of(scheme), Grounds::of(scheme));
    let Grounds { panel, window, text, line, button: [idle, hover], chosen: [chosen, on_chosen] } = grounds;
    let mut v = if scheme == Scheme::Light { Visuals::light() } else { Visuals::dark() };
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
    (v.widgets.inactive.weak_bg_fill, v.widgets.inactive.bg_fill) = (idle, idle);
    (v.widgets.hovered.weak_bg_fill, v.widgets.hovered.bg_fill) = (hover, hover);
    v.selection.bg_fill = chosen;
    v.selection.stroke = Stroke::new(1.0, on_chosen);
    if scheme == Scheme::HighContrast {
        sharpen(&mut v, &grounds);
    }
    v
}

/// Gives every widget a border, and the one with the keyboard a broad ring.
fn sharpen(v: &mut Visuals, grounds: &Grounds) {
    let [_, hover] = grounds.button;
    let ring = Stroke::new(2.5, grounds.chosen[1]);
    let border = |width: f32| Stroke::new(width, grounds.line);
    // Rails of sliders and insides of boxes have this colour, and no border.
    let rail = rgb(0x6e6e6e);
    for (widget, line) in [
        (&mut v.widgets.inactive, border(1.0)),
        (&mut v.widgets.hovered, border(2.0)),
        (&mut v.widgets.active, ring),
        (&mut v.widgets.open, border(2.0)),
    ] {
        widget.bg_stroke = line;
        widget.bg_fill = rail;
        widget.fg_stroke = Stroke::new(1.5, grounds.text);
    }
    (v.widgets.active.weak_bg_fill, v.widgets.open.weak_bg_fill) = (hover, hover);
    v.selection.stroke = ring;
    v.window_stroke = border(2.0);
    v.extreme_bg_color = rgb(0x1a1a1a);
    v.faint_bg_color = rgb(0x1a1a1a);
    v.disabled_alpha = 0.7;
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `ink` with its opacity on an opaque `paper`.
    fn blended(ink: Color32, paper: Color32) -> Color32 {
        paper.blend(ink)
    }

    /// Colours that cloth may have.
    fn cloths() -> impl Iterator<Item = Color32> {
        let steps = [0, 64, 128, 192, 255];
        steps
            .into_iter()
            .flat_map(move |r| steps.into_iter().flat_map(move |g| steps.map(|b| Color32::from_rgb(r, g, b))))
    }

    /// Every text of the window's own with its ground.
    fn texts(scheme: Scheme) -> Vec<(String, Color32, Color32)> {
        let (v, p) = (visuals(scheme), Palette::of(scheme));
        let text = v.widgets.noninteractive.fg_stroke.color;
        let overlay = blended(p.overlay, p.table);
        let mut all = vec![
            ("text", text, v.panel_fill),
            ("text in windows", text, v.window_fill),
            ("text in striped rows", text, blended(v.faint_bg_color, v.window_fill)),
            ("text that is typed", text, v.text_edit_bg_color()),
            ("buttons", v.widgets.inactive.fg_stroke.color, v.widgets.inactive.weak_bg_fill),
            ("buttons under the pointer", v.widgets.hovered.fg_stroke.color, v.widgets.hovered.weak_bg_fill),
            ("buttons pressed", v.widgets.active.fg_stroke.color, v.widgets.active.weak_bg_fill),
            ("buttons opened", v.widgets.open.fg_stroke.color, v.widgets.open.weak_bg_fill),
            ("weak text", p.weak, v.panel_fill),
            ("weak text in windows", p.weak, v.window_fill),
            ("weak text on the table", p.weak, p.table),
            ("weak text over a pane", p.weak, overlay),
            ("warnings", p.warning, v.panel_fill),
            ("warnings in windows", p.warning, v.window_fill),
            ("errors", p.error, v.panel_fill),
            ("errors in windows", p.error, v.window_fill),
            ("primary button", p.on_accent, p.accent),
            ("button that stops", p.on_accent, p.stop),
            ("chosen", v.selection.stroke.color, v.selection.bg_fill),
            ("guides told", p.guide, p.table),
            ("angles of folds", p.guide, p.front[0]),
        ]
        .into_iter()
        .map(|(what, ink, paper)| (what.to_owned(), ink, paper))
        .collect::<Vec<_>>();
        let fills = pieces(&p).into_iter().map(|[fill, _]| fill).chain(cloths().map(|cloth| p.dyed(cloth)));
        all.extend(fills.map(|fill| (format!("name on {fill:?}"), p.name_on(fill), fill)));
        for ink in (1..=10).map(|number| colour(crate::render::mark_colour(number))) {
            for (paper, ink) in [(ink, Color32::WHITE), (p.halo, ink)] {
                let [paper, ink] = p.label(paper, ink);
                all.push((format!("number of a mark on {paper:?}"), ink, paper));
            }
        }
        all
    }

    /// Fill and outline of pieces of every kind.
    fn pieces(p: &Palette) -> Vec<[Color32; 2]> {
        let kinds = [Activity::Active, Activity::Frozen, Activity::Deactivated];
        let of = |kind| (0..=4).map(move |layer| p.piece(true, layer, kind)).chain([p.piece(false, 0, kind)]);
        kinds.into_iter().flat_map(of).collect()
    }

    #[test]
    fn text_can_be_read_in_every_theme() {
        for scheme in [Scheme::Light, Scheme::Dark, Scheme::HighContrast] {
            let least = if scheme == Scheme::HighContrast { 7.0 } else { 4.5 };
            assert!((Palette::of(scheme).least - least).abs() < 1e-6);
            for (what, ink, paper) in texts(scheme) {
                let ratio = contrast(ink, paper);
                assert!(ratio >= least, "{scheme:?} {what}: {ratio}");
            }
        }
    }

    #[test]
    fn borders_and_lines_are_seen_in_high_contrast() {
        let (v, p) = (visuals(Scheme::HighContrast), Palette::of(Scheme::HighContrast));
        let border = |what: &str, line: Stroke, paper: Color32| {
            assert!(line.width >= 1.0, "{what}");
            let ratio = contrast(line.color, paper);
            assert!(ratio >= 7.0, "{what}: {ratio}");
        };
        border("windows", v.window_stroke, v.window_fill);
        border("separators", v.widgets.noninteractive.bg_stroke, v.panel_fill);
        border("buttons", v.widgets.inactive.bg_stroke, v.panel_fill);
        border("buttons under the pointer", v.widgets.hovered.bg_stroke, v.panel_fill);
        border("what has the keyboard", v.widgets.active.bg_stroke, v.panel_fill);
        border("the field that is typed in", v.selection.stroke, v.panel_fill);
        assert!(v.widgets.active.bg_stroke.width > v.widgets.hovered.bg_stroke.width);
        let line = |what: &str, ink: Color32, paper: Color32| {
            let ratio = contrast(blended(ink, paper), paper);
            assert!(ratio >= 3.0, "{what}: {ratio}");
        };
        line("rails of sliders", v.widgets.inactive.bg_fill, v.panel_fill);
        for (what, ink) in
            [("grid", p.table_grid), ("strong grid", p.table_grid_strong), ("threads", p.thread)]
        {
            line(what, ink, p.table);
        }
        let dyed = cloths().map(|cloth| [p.dyed(cloth), p.front[1]]);
        for [fill, outline] in pieces(&p).into_iter().chain(dyed) {
            line("outline on the cloth", outline, fill);
            line("outline on the table", outline, p.table);
            line("allowance on the table", outline.gamma_multiply(0.75), p.table);
            for (what, ink) in [("selection", p.accent), ("guide", p.guide)] {
                line(what, ink, fill);
                line(what, ink, p.table);
            }
            for seam in 0..40 {
                line("seam on the cloth", p.seam(seam).gamma_multiply(p.faint), fill);
                line("seam on the table", p.seam(seam).gamma_multiply(p.faint), p.table);
            }
        }
    }
}
