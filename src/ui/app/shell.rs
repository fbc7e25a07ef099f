//! The interface around the panes: start page, tour, palette, preferences, pictures; and their actions.

use std::sync::Arc;

use crate::marker::Order;
use crate::pattern::Bow;
use crate::session::Command;
use crate::ui::actions::Action;
use crate::ui::actions::asks::Asks;
use crate::ui::actions::context::FrameContext;
use crate::ui::actions::drawer::Drawer;
use crate::ui::actions::sight::Sight;
use crate::ui::app::App;
use crate::ui::app::all_sizes::AllSizes;
use crate::ui::app::environment::EnvironmentMap;
use crate::ui::app::focus_round::FocusRound;
use crate::ui::app::marker_page::MarkerPage;
use crate::ui::app::picture_page::PicturePage;
use crate::ui::app::reporting::Reporting;
use crate::ui::app::start_page::StartPage;
use crate::ui::app::tech_pack::TechPack;
use crate::ui::app::tour::Tour;
use crate::ui::app::turn::Turn;
use crate::ui::body_pane::placing::Placing;
use crate::ui::files::Purpose;
use crate::ui::files::recent::Recent;
use crate::ui::files::thumbnails::Thumbnails;
use crate::ui::language::say;
use crate::ui::look::theme::{self, Palette};
use crate::ui::maps::MapView;
use crate::ui::panels::pose::PosePanel;
use crate::ui::panels::sizes::SizesPanel;
use crate::ui::panels::tape::TapePanel;
use crate::ui::pattern_pane::nests::SizeView;
use crate::ui::preferences::Preferences;
use crate::ui::preferences::page::PreferencesPage;
use crate::ui::shell::command_palette::CommandPalette;
use crate::ui::shell::drop_overlay;
use crate::ui::shell::manual::ManualPage;
use crate::ui::shell::status;

/// The interface around the panes.
#[derive(Debug, Default)]
pub struct Shell {
    /// The start page, shown instead of the panes.
    pub start: Option<StartPage>,
    /// The tour, shown over the panes.
    pub tour: Option<Tour>,
    /// The command palette.
    pub palette: Option<CommandPalette>,
    /// The manual.
    pub manual: Option<ManualPage>,
    /// The preferences dialog.
    pub preferences: Option<PreferencesPage>,
    /// The dialog with options of a picture.
    pub picture: Option<PicturePage>,
    /// A turntable being rendered.
    pub turn: Option<Turn>,
    /// The dialog in which all sizes are dressed.
    pub all_sizes: Option<AllSizes>,
    /// The Marker window.
    pub marker: Option<MarkerPage>,
    /// The order of the last marker.
    pub marker_order: Order,
    /// A fit report in the making.
    pub reporting: Option<Reporting>,
    /// A tech pack in the making.
    pub tech_pack: Option<TechPack>,
    /// Code of the language of the last tech pack; None for that of the window.
    pub pack_language: Option<String>,
    /// Measures of the last bow.
    pub bow: Option<Bow>,
    /// What the drawer below the panes shows; None when it is closed.
    pub drawer: Option<Drawer>,
    /// The list of recent files.
    pub recent: Recent,
    /// The file that is opened next.
    pub opening: Option<std::path::PathBuf>,
    /// Arrangement points and placed pieces, for the placement tool.
    pub placing: Placing,
    /// Display options of body and cloth.
    pub sight: Sight,
    /// The environment map, and the bar that rotates it.
    pub environment: EnvironmentMap,
    /// Whether the bar of the aperture is shown.
    pub sets_aperture: bool,
    /// Where the keyboard was and can go.
    pub round: FocusRound,
    /// First widgets of the toolbar and of the side panel, which get the keyboard focus.
    pub first_tool: Option<egui::Id>,
    pub first_of_panel: Option<egui::Id>,
    /// Panel of the mannequin's poses.
    pub pose: PosePanel,
    /// Panel of body measurements.
    pub tape: TapePanel,
    /// Sizes and grade rules of the pattern.
    pub sizes: SizesPanel,
    /// Which sizes are shown. Not kept in the pattern pane, which is taken out while it is shown.
    pub size_view: SizeView,
    /// The map that the cloth is coloured by.
    pub maps: MapView,
    /// Thumbnails of samples and projects.
    pub thumbnails: Thumbnails,
}

impl Shell {
    /// Whether pictures, a fit report or a tech pack are being made.
    pub fn is_picturing(&self) -> bool {
        self.turn.is_some() || self.reporting.is_some() || self.tech_pack.is_some()
    }

    /// Whether keys go to a dialog or page over the panes.
    pub fn is_asking(&self) -> bool {
        self.palette.is_some()
            || self.manual.is_some()
            || self.preferences.is_some()
            || self.picture.is_some()
            || self.all_sizes.is_some()
            || self.marker.is_some()
    }
}

impl App {
    /// Shows the start page over an empty table.
    pub fn begin_at_start_page(&mut self) {
        self.shell.recent.look();
        self.shell.start = Some(StartPage::default());
    }

    /// Makes thumbnails of samples and projects in the background.
    pub fn make_thumbnails(&mut self) {
        self.shell.thumbnails = Thumbnails::on();
    }

    pub(in crate::ui) fn act_on_shell(&mut self, ctx: &egui::Context, action: Action) {
        let toggled = |drawer| if self.shell.drawer == Some(drawer) { None } else { Some(drawer) };
        match action {
            Action::OpenRecent(_) => self.open_recent(ctx),
            Action::ClearRecent => {
                if let Err(words) = self.shell.recent.clear() {
                    self.messages.error(words);
                }
            }
            Action::StartPage => self.begin_at_start_page(),
            Action::Picture => {
                let pane = self.scene_pane.area.map_or(egui::Vec2::new(1280.0, 800.0), |area| area.size());
                self.shell.picture = Some(PicturePage::new(pane * ctx.pixels_per_point()));
            }
            Action::Preferences => self.shell.preferences = Some(PreferencesPage::default()),
            Action::ToggleWire => self.shell.sight.wire = !self.shell.sight.wire,
            Action::ToggleSheer => self.shell.sight.sheer = !self.shell.sight.sheer,
            Action::ToggleXray => self.shell.sight.xray = !self.shell.sight.xray,
            Action::Light(light) => self.choose_light(ctx, light),
            Action::ToggleEnvironment => self.toggle_environment(ctx),
            Action::RotateEnvironment => {
                self.shell.environment.is_rotated = !self.shell.environment.is_rotated;
                self.shell.sets_aperture &= !self.shell.environment.is_rotated;
            }
            Action::ToggleDepthOfField => self.toggle_depth_of_field(ctx),
            Action::SetAperture => self.show_aperture(!self.shell.sets_aperture),
            Action::BodyLook(look) => self.shell.sight.body_look = look,
            Action::ToggleSeamStitches => self.shell.sight.plain_seams = !self.shell.sight.plain_seams,
            Action::TogglePairs => self.shell.sight.pairs = !self.shell.sight.pairs,
            Action::ToggleHistory => self.shell.drawer = toggled(Drawer::History),
            Action::ToggleLog => self.shell.drawer = toggled(Drawer::Log),
            Action::Map(kind) => self.shell.maps.choose(kind),
            Action::ToggleDifference => self.shell.maps.toggle_difference(),
            Action::ChangeSides => {
                self.shell.maps.change_sides();
                self.scene_pane.frame = Some(None);
            }
            Action::CloseComparison => {
                self.shell.maps.compare(None);
                self.scene_pane.frame = Some(None);
            }
            Action::ToggleMapTable => self.shell.drawer = toggled(Drawer::Map),
            Action::CommandPalette => self.shell.palette = Some(CommandPalette::default()),
            Action::Manual => self.shell.manual = Some(ManualPage::default()),
            Action::Tour => self.begin_tour(),
            _ => debug_assert!(false, "{action:?} is in the table and does nothing"),
        }
    }

    /// Draws pages and dialogs over the panes in this frame.
    pub(in crate::ui) fn over_panes(
        &mut self,
        ctx: &egui::Context,
        now: &FrameContext,
        palette: &Palette,
        asks: &mut Asks,
    ) {
        self.shell.thumbnails.take(ctx);
        if self.shell.start.is_none() {
            self.tour_ui(ctx, now, palette, asks);
        }
        if let Some(mut open) = self.shell.palette.take()
            && open.ui(ctx, now, palette, asks)
        {
            self.shell.palette = Some(open);
        }
        if let Some(mut open) = self.shell.manual.take()
            && open.ui(ctx, palette)
        {
            self.shell.manual = Some(open);
        }
        self.preferences_ui(ctx, palette);
        self.picture_ui(ctx, palette);
        self.all_sizes_ui(ctx, palette);
        self.marker_ui(ctx, palette);
        self.rotation_ui(ctx, asks);
        self.aperture_ui(ctx, asks);
        self.go_on_turning(ctx, palette, status::HEIGHT);
        self.go_on_reporting(ctx, palette, status::HEIGHT);
        self.go_on_packing(ctx, palette, status::HEIGHT);
        drop_overlay::ui(ctx, palette, [self.pattern_pane.area, self.scene_pane.area]);
    }

    fn preferences_ui(&mut self, ctx: &egui::Context, palette: &Palette) {
        let Some(mut page) = self.shell.preferences.take() else { return };
        let mut new = self.preferences.clone();
        if page.ui(ctx, &mut new, &self.languages, palette) {
            self.shell.preferences = Some(page);
        }
        if new != self.preferences {
            self.prefer(ctx, |preferences| *preferences = new);
        }
    }

    /// Changes the preferences, applies them and saves them.
    pub(in crate::ui) fn prefer(&mut self, ctx: &egui::Context, change: impl FnOnce(&mut Preferences)) {
        change(&mut self.preferences);
        self.live_by_preferences(ctx);
        if let Some(path) = &self.preferences_path
            && let Err(words) = self.preferences.write(path)
        {
            self.messages.error(say!("Your preferences could not be kept: {why}", why = words));
        }
    }

    pub(in crate::ui) fn live_by_preferences(&mut self, ctx: &egui::Context) {
        self.speak();
        self.use_card();
        self.light_up();
        self.focus_lens();
        theme::choose(ctx, self.preferences.theme);
        ctx.set_zoom_factor(self.preferences.scale.factor());
    }

    fn open_recent(&mut self, ctx: &egui::Context) {
        if let Some(path) = self.shell.opening.take() {
            self.file(ctx, Purpose::Open, &path);
        }
        self.shell.recent.look();
    }

    /// Moves `path` to the top of the list of recent files.
    pub(in crate::ui) fn remember(&mut self, path: &std::path::Path) {
        if let Err(words) = self.shell.recent.add(path) {
            self.messages.error(say!("The list of files could not be kept: {why}", why = words));
        }
    }

    /// Undoes (negative) or redoes (positive) this many steps.
    pub(in crate::ui) fn jump(&mut self, steps: i32) {
        for _ in 0..steps.unsigned_abs() {
            self.apply(if steps < 0 { Command::Undo } else { Command::Redo });
        }
    }

    pub(in crate::ui) fn is_at_body(&self, ctx: &egui::Context) -> bool {
        let focused = self.scene_pane.id.is_some_and(|id| ctx.memory(|m| m.has_focus(id)));
        self.scene_pane.hovered || (focused && !self.pattern_pane.hovered)
    }

    /// Turns the view of the body to the selected mark or the cloth of the selected pieces; to everything where nothing selected
    /// is on the body.
    pub(in crate::ui) fn frame_selected_on_body(&mut self) {
        let session = self.shown();
        let Some(surface) = session.surface().cloned() else { return };
        let marks = Arc::clone(&session.document().marks);
        let (pieces, snapshot) = (self.picks.selection.pieces_touched(), Arc::clone(session.snapshot()));
        let mut points: Vec<glam::DVec3> = match self.selected.and_then(|mark| marks.place(mark)) {
            Some(place) => marks.body.get(place.number - 1).map(|m| m.points.clone()).unwrap_or_default(),
            None => Vec::new(),
        };
        if let Some((garment, cloth)) = snapshot.drawn().filter(|_| points.is_empty()) {
            let corners = garment.corners.iter().filter(|c| pieces.contains(&c.piece));
            let on_body = corners.map(|c| c.vertex as usize).filter(|&v| cloth.mapped[v]);
            points = on_body.map(|v| cloth.positions[v]).collect();
        }
        if points.is_empty() {
            self.scene_pane.frame = Some(None);
        } else {
            self.scene_pane.come_near(&points, &surface);
        }
    }
}
