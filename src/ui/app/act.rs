//! Carries out actions.

use std::sync::Arc;

use egui::ViewportCommand;
use glam::DVec3;

use crate::cloth::Fabric;
use crate::render::Projection;
use crate::session::{Command, Project};
use crate::ui::actions::layout::Panes;
use crate::ui::actions::{Action, Tool};
use crate::ui::app::App;
use crate::ui::body_pane::ghosts::Ghosts;
use crate::ui::files::{self, Purpose};
use crate::ui::language::tr;
use crate::ui::pattern_pane::Fit;
use crate::ui::shell::dialogs::Dialog;
use crate::wrap::{BodyMark, ClothMark};

impl App {
    /// Carries out `action`; if it would lose unsaved changes, asks first.
    pub fn act(&mut self, ctx: &egui::Context, action: Action) {
        if let Action::OpenRecent(i) = action {
            // The file is noted now, since saving the project may change the order of the list.
            let file = self.shell.recent.files().get(usize::from(i));
            self.shell.opening = file.map(|file| file.path.clone());
        }
        let leaves = matches!(
            action,
            Action::New
                | Action::Open
                | Action::OpenRecent(_)
                | Action::Quit
                | Action::Sample(_)
                | Action::Tour
        );
        if leaves && self.session.is_modified() {
            self.dialog = Some(Dialog::Unsaved { then: action });
        } else {
            self.act_unguarded(ctx, action);
        }
    }

    /// Carries out `action` without asking about unsaved changes.
    pub(in crate::ui) fn act_unguarded(&mut self, ctx: &egui::Context, action: Action) {
        if self.shell.start.is_some() && !action.row().on_start_page {
            self.leave_start_page();
        }
        if let Action::Choose(tool) = action {
            self.tool = tool;
            return;
        }
        match action.row().menu.split(" › ").next().unwrap_or_default() {
            "File" => self.act_on_file(ctx, action),
            "Edit" => self.act_on_edit(ctx, action),
            "Pattern" => self.change_pattern(action),
            "Garment" => self.act_on_garment(action),
            "Pose" | "Fabric" => self.act_on_panel(action),
            _ => self.act_on_view(ctx, action),
        }
    }

    /// Carries out an action of the File menu.
    fn act_on_file(&mut self, ctx: &egui::Context, action: Action) {
        match action {
            Action::New => self.replace(Project::default(), None),
            Action::Sample(sample) => self.replace(files::sample(sample), None),
            Action::Open => self.ask_file(Purpose::Open),
            Action::Save => self.save(ctx),
            Action::SaveAs => self.ask_file(Purpose::Save),
            Action::SaveCopy => self.ask_file(Purpose::Copy),
            Action::SaveNext => self.save_next(ctx),
            Action::Revert => {
                if let Some(path) = self.path.clone() {
                    self.dialog = Some(Dialog::Revert { path });
                }
            }
            Action::ImportPattern => self.ask_file(Purpose::ImportPattern),
            Action::ImportBody => self.ask_file(Purpose::ImportBody),
            Action::AddImage => self.ask_file(Purpose::Image),
            Action::PoseFromFile => self.ask_file(Purpose::Pose),
            Action::Sequence => self.ask_file(Purpose::Sequence),
            Action::Sizes => self.ask_file(Purpose::Sizes),
            Action::UseMannequin => self.apply(files::use_mannequin()),
            Action::ExportPattern => self.ask_file(Purpose::ExportPattern),
            Action::Export => self.ask_file(Purpose::Export),
            Action::FitPage => self.ask_file(Purpose::FitPage),
            Action::TechPack => self.ask_pack_language(),
            Action::Marker => self.open_marker(),
            Action::SaveRecording => self.ask_file(Purpose::Recording),
            Action::Paper(paper) => self.prefer(ctx, |p| p.paper = paper),
            Action::Quit => {
                self.may_close = true;
                ctx.send_viewport_cmd(ViewportCommand::Close);
            }
            _ => self.act_on_shell(ctx, action),
        }
    }

    /// Carries out an action of the Edit menu.
    fn act_on_edit(&mut self, ctx: &egui::Context, action: Action) {
        match action {
            Action::Undo => self.apply(Command::Undo),
            Action::Redo => self.apply(Command::Redo),
            Action::SuggestMarks => self.suggest_marks(),
            Action::AcceptMarks => self.accept_marks(),
            Action::DismissMarks => self.ghosts = None,
            Action::Delete if self.selected.is_some() => self.change_selected(Action::DeleteMark),
            Action::DeleteMark | Action::RaiseMark | Action::LowerMark => self.change_selected(action),
            Action::Delete | Action::SelectAll | Action::Duplicate => self.change_pattern(action),
            Action::ClearMarks => self.apply(Command::ClearMarks),
            Action::ToggleLaser => self.laser = !self.laser,
            _ => self.act_on_shell(ctx, action),
        }
    }

    /// Carries out an action of the Garment menu.
    fn act_on_garment(&mut self, action: Action) {
        match action {
            Action::Dress => self.dress(),
            Action::DressAllSizes => self.dress_all_sizes(),
            Action::Wrap => {
                self.show_cloth = true;
                self.apply(Command::Wrap);
            }
            Action::Rewrap => self.rewrap(),
            Action::Cancel => self.cancel(),
            Action::Unwrap => self.apply(Command::Unwrap),
            Action::ToggleRelaxing => {
                let on = !self.session.snapshot().relaxing;
                self.apply(Command::SetRelaxing { on });
            }
            Action::BringPieces => self.bring_pieces(),
            Action::Sew => {
                if self.tool == Tool::Place {
                    // The placement tool shows pieces in place of the cloth, so another tool is chosen to show what is sewn.
                    self.tool = Tool::Move;
                }
                self.show_cloth = true;
                self.apply(Command::Sew);
            }
            Action::ToggleDrape => {
                let on = self.session.snapshot().drape.is_none_or(|drape| !drape.on || !drape.runs);
                self.apply(Command::SetDraping { on });
            }
            Action::StepDrape => self.apply(Command::StepDraping { ticks: 1 }),
            Action::ClearPins => self.apply(Command::ClearPins),
            Action::OwnBones => self.apply(Command::SetBones { bones: None }),
            Action::NoBones => self.apply(Command::SetBones { bones: Some(Vec::new()) }),
            _ => self.change_pattern(action),
        }
    }

    /// Carries out an action of the side panel.
    fn act_on_panel(&mut self, action: Action) {
        let command = match action {
            Action::Pose(pose) => self.shell.pose.take(pose, &self.session.document().body),
            Action::Fabric(number) => {
                let fabric = Fabric::presets().get(usize::from(number));
                fabric.map(|fabric| Command::SetFabric { piece: None, fabric: Some(fabric.name.to_string()) })
            }
            _ => None,
        };
        if let Some(command) = command {
            self.apply(command);
        }
    }

    /// Carries out an action of the View or Help menu.
    fn act_on_view(&mut self, ctx: &egui::Context, action: Action) {
        match action {
            Action::Look(_)
            | Action::FrameAll
            | Action::FrameSelection
            | Action::TrueSize
            | Action::ClearGuides
            | Action::ToggleParallel
            | Action::ToggleFreeTurning => self.change_view(ctx, action),
            Action::Compare => self.ask_file(Purpose::Compare),
            Action::EnvironmentMap => self.ask_file(Purpose::Environment),
            Action::NextPane => self.next_pane(ctx, false),
            Action::PreviousPane => self.next_pane(ctx, true),
            Action::ToggleSnapping => self.snapping = !self.snapping,
            Action::Unit(unit) => self.prefer(ctx, |p| p.unit = unit),
            Action::ToggleCloth => self.show_cloth = !self.show_cloth,
            Action::Show(panes) => self.prefer(ctx, |p| {
                // Choosing the same pane again shows both.
                p.layout.panes = if p.layout.panes == panes { Panes::Both } else { panes };
            }),
            Action::SwapPanes => self.prefer(ctx, |p| p.layout.swapped = !p.layout.swapped),
            Action::TogglePanel => self.show_panel = !self.show_panel,
            Action::Theme(theme) => self.prefer(ctx, |p| p.theme = theme),
            Action::Mouse(mouse) => self.prefer(ctx, |p| p.mouse = mouse),
            Action::Demo(demo) => self.begin_demo(demo),
            Action::StopDemo => self.stop_demo(),
            Action::Shortcuts => {
                let keymap = Arc::clone(&self.preferences.keymap);
                self.dialog = Some(Dialog::Shortcuts { mouse: self.preferences.mouse, keymap });
            }
            _ => self.act_on_shell(ctx, action),
        }
    }

    /// Selects the first of the pairs of marks with these numbers and turns the view to all of them. Where none are painted they are
    /// those that were suggested for the cloth, which cannot be selected.
    pub(in crate::ui) fn show_marks(&mut self, numbers: &[usize]) {
        let painted = Arc::clone(&self.shown().document().marks);
        let suggested = self.shown().snapshot().source.as_ref().map(|source| Arc::clone(&source.marks));
        let is_painted = painted.pairs().next().is_some();
        let marks = suggested.filter(|_| !is_painted).unwrap_or(painted);
        let shown: Vec<&BodyMark> =
            numbers.iter().filter_map(|&n| marks.body.get(n.checked_sub(1)?)).collect();
        self.selected = shown.first().map(|mark| mark.id).filter(|_| is_painted);
        let points: Vec<DVec3> = shown.iter().flat_map(|mark| mark.points.iter().copied()).collect();
        if let Some(surface) = self.shown().surface().cloned() {
            self.scene_pane.show(&points, &surface);
        }
    }

    fn change_selected(&mut self, action: Action) {
        let Some(mark) = self.selected else { return };
        let Some(place) = self.session.document().marks.place(mark) else { return };
        self.apply(match action {
            Action::RaiseMark => Command::MoveMark { mark, to: place.number - 1 },
            Action::LowerMark => Command::MoveMark { mark, to: place.number + 1 },
            _ => Command::DeleteMark { mark },
        });
    }

    /// Wraps again by the pairs painted since the last wrap, or by all pairs when there are none.
    fn rewrap(&mut self) {
        let used =
            self.session.snapshot().source.as_ref().map(|source| source.marks.clone()).unwrap_or_default();
        let known = |(cloth, body): (&ClothMark, &BodyMark)| {
            used.pairs().any(|(c, b)| (c.id, b.id) == (cloth.id, body.id))
        };
        let marks = &self.session.document().marks;
        let pairs = marks.pairs().enumerate().filter(|(_, pair)| !known(*pair)).map(|(i, _)| i + 1).collect();
        self.show_cloth = true;
        self.apply(Command::Rewrap { pairs });
    }

    fn suggest_marks(&mut self) {
        self.ghosts = Ghosts::proposed(&self.session);
        if self.ghosts.is_none() {
            let words =
                tr("No marks can be proposed: the pattern does not say where its pieces go round the body.");
            return self.messages.error(words);
        }
        // The side panel has the buttons to accept them.
        self.show_panel = true;
    }

    fn accept_marks(&mut self) {
        if let Some(ghosts) = self.ghosts.take() {
            self.apply(Command::SetMarks { marks: ghosts.marks });
        }
    }

    fn change_view(&mut self, ctx: &egui::Context, action: Action) {
        let at_body = self.is_at_body(ctx);
        let scene = &mut self.scene_pane;
        match action {
            Action::Look(view) => scene.camera.look(view),
            Action::FrameAll if self.pattern_pane.hovered || self.pattern_pane.has_focus(ctx) => {
                self.pattern_pane.fit = true
            }
            Action::FrameAll => scene.frame = Some(None),
            Action::FrameSelection if at_body => self.frame_selected_on_body(),
            Action::FrameSelection => self.pattern_pane.show = Some(Fit::Selection),
            Action::TrueSize => self.pattern_pane.show = Some(Fit::TrueSize),
            Action::ClearGuides => self.pattern_pane.clear_guides(),
            Action::ToggleParallel => {
                scene.camera.projection = match scene.camera.projection {
                    Projection::Perspective => Projection::Orthographic,
                    Projection::Orthographic => Projection::Perspective,
                }
            }
            Action::ToggleFreeTurning => scene.free_turning = !scene.free_turning,
            _ => {}
        }
    }

    fn save(&mut self, ctx: &egui::Context) {
        match self.path.clone() {
            Some(path) => self.save_or_ask(ctx, &path),
            None => self.ask_file(Purpose::Save),
        }
    }
}
