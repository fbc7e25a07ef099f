//! What menus, buttons and panels need to know to show themselves.

use std::sync::Arc;

use egui::ThemePreference;

use crate::drag::DragMode;
use crate::fit::MapKind;
use crate::geometry::ids::MarkId;
use crate::io::pdf::Paper;
use crate::pattern::activity::Activity;
use crate::sim::{DrapeState, Start};
use crate::ui::actions::drawer::Drawer;
use crate::ui::actions::keymap::Keymap;
use crate::ui::actions::layout::Layout;
use crate::ui::actions::picked::Picked;
use crate::ui::actions::sight::Sight;
use crate::ui::actions::{Action, Tool};
use crate::ui::files::recent::RecentFile;
use crate::ui::pointer::mouse::Mouse;
use crate::ui::preferences::units::LengthUnit;
use crate::ui::selection::Item;
use crate::ui::shell::pace::Pace;
use crate::wrap::{MarkPlace, Phase};

/// How things stand in this frame.
#[derive(Clone, Debug)]
pub struct FrameContext {
    /// What undo would take back.
    pub undo: Option<String>,
    /// What redo would do again.
    pub redo: Option<String>,
    /// What the left button does.
    pub tool: Tool,
    /// What all mouse buttons do.
    pub mouse: Mouse,
    /// What patterns are printed on.
    pub paper: Paper,
    /// Strokes go through everything under the pointer.
    pub laser: bool,
    /// Pieces on the table.
    pub pieces: usize,
    /// Marks on the cloth and on the body.
    pub marks: [usize; 2],
    /// Pins in the cloth.
    pub pins: usize,
    /// What is selected of the pattern.
    pub picked: Picked,
    /// Seams join fronts to backs.
    pub twisted: bool,
    /// What lies near draws the pointer on.
    pub snapping: bool,
    /// What of the pattern the pointer is over, in either pane.
    pub highlight: Option<Item>,
    /// How many points of the screen a metre takes.
    pub points_per_metre: f64,
    /// How fast window and simulation go.
    pub pace: Pace,
    /// What lengths are shown in.
    pub unit: LengthUnit,
    /// The selected mark.
    pub selected: Option<(MarkId, MarkPlace)>,
    /// Pairs of marks proposed and not accepted yet.
    pub proposed: usize,
    /// There is a body that cloth can be put on.
    pub has_body: bool,
    /// There is cloth on the body.
    pub dressed: bool,
    /// The cloth lies as a wrap has laid it, which can be taken back.
    pub wrapped: bool,
    /// A wrap was asked for and the cloth is not all on the body yet.
    pub wrapping: bool,
    /// While starts are tried: the one under way, and whether it is draped already.
    pub trying: Option<(Start, bool)>,
    /// The simulation has something to do.
    pub working: bool,
    /// The simulation has done what it was asked for so far.
    pub caught_up: bool,
    /// Cloth is in the hand.
    pub dragging: bool,
    /// False while held still.
    pub relaxing: bool,
    /// A piece is placed in space.
    pub placed: bool,
    /// How draping stands.
    pub drape: Option<DrapeState>,
    /// How far the dressing has come.
    pub phase: Option<Phase>,
    /// 0..=1.
    pub progress: f64,
    /// Ticks of the simulation.
    pub tick: u64,
    /// Triangles of the garment.
    pub triangles: usize,
    /// The cloth is drawn.
    pub show_cloth: bool,
    /// Which panes are shown, and where.
    pub layout: Layout,
    /// The side panel is open.
    pub show_panel: bool,
    /// The project is in a file.
    pub has_file: bool,
    /// Near and far look the same size.
    pub parallel: bool,
    /// The view turns like a ball.
    pub free_turning: bool,
    /// A demo is shown.
    pub demo: bool,
    /// Dark, light or as the system.
    pub theme: ThemePreference,
    /// Which keys do what.
    pub keymap: Arc<Keymap>,
    /// Files that were open before.
    pub recent: Arc<Vec<RecentFile>>,
    /// What is drawn of body and cloth besides their surfaces.
    pub sight: Sight,
    /// What is open below the panes.
    pub drawer: Option<Drawer>,
    /// What the cloth is coloured by.
    pub map: Option<MapKind>,
    /// Another garment is shown beside; whether the difference to it is.
    pub difference: Option<bool>,
    /// What draws the body; None: nothing can.
    pub adapter: Option<String>,
    /// A turn of pictures or a fit report is being made.
    pub picturing: bool,
}

impl FrameContext {
    /// Why `action` cannot be chosen now; None when it can.
    pub fn why_not(&self, action: Action) -> Option<&'static str> {
        let unless = |can: bool, why: &'static str| (!can).then_some(why);
        match action {
            Action::StopDemo => unless(self.demo, "No demo is shown"),
            _ if self.demo && !action.is_for_demos() => Some("A demo is shown: stop it first"),
            Action::OpenRecent(i) => match self.recent.get(usize::from(i)) {
                None => Some("No such file was open"),
                Some(file) => unless(file.is_there, "The file is no longer there"),
            },
            Action::ClearRecent => unless(!self.recent.is_empty(), "No file was open before"),
            Action::Picture | Action::FitPage if self.picturing => Some("Pictures are being made"),
            Action::Picture => unless(self.adapter.is_some(), "There is no graphics adapter to draw with"),
            Action::Undo => unless(self.undo.is_some(), "There is nothing to undo"),
            Action::Redo => unless(self.redo.is_some(), "There is nothing to redo"),
            Action::Revert | Action::SaveNext => unless(self.has_file, "The project was not saved yet"),
            Action::ExportPattern => unless(self.pieces > 0, "There is no piece on the table"),
            Action::Dress | Action::Wrap if self.pieces == 0 => Some("There is no piece on the table"),
            Action::Dress if !self.has_body => Some("There is no body"),
            Action::Dress if self.wrapping => Some("The cloth is growing"),
            Action::Dress => unless(
                self.placed || self.has_pairs(),
                "No piece stands round the body, and there are no marks",
            ),
            Action::ToggleDrape | Action::StepDrape | Action::ToggleRelaxing if self.trying.is_some() => {
                Some("The garment is being put on: cancel that first")
            }
            Action::Wrap if !self.has_body => Some("There is no body"),
            Action::Wrap if self.wrapping => Some("The cloth is growing"),
            Action::Wrap => {
                unless(self.has_pairs(), "Paint at least one mark on a piece and one on the body first")
            }
            Action::Rewrap if !self.dressed => Some("There is no cloth on the body"),
            Action::Rewrap if self.wrapping => Some("The cloth is growing"),
            Action::Rewrap => unless(
                self.has_pairs(),
                "Paint the new marks first: on a piece, and on the body where it should lie",
            ),
            Action::CancelWrap => unless(self.wrapping, "Nothing is growing"),
            Action::Choose(Tool::Drag(_) | Tool::Pin) => {
                unless(self.dressed, "There is no cloth on the body")
            }
            Action::Choose(Tool::Bone) | Action::OwnBones | Action::NoBones => {
                unless(self.has_body, "There is no body")
            }
            Action::Choose(Tool::Place) if self.pieces == 0 => Some("There is no piece on the table"),
            Action::Choose(Tool::Place) => unless(self.has_body, "There is no body"),
            Action::BringPieces if !self.has_body => Some("There is no body"),
            Action::BringPieces => unless(self.placed, "No piece stands round the body"),
            Action::ToggleRolled | Action::Unplace => {
                unless(self.picked.standing, "No piece that stands round the body is selected")
            }
            Action::ClearPins => unless(self.pins > 0, "There are no pins"),
            Action::Sew if self.wrapping => Some("The cloth is growing"),
            Action::Sew if !self.has_body => Some("There is no body"),
            Action::Sew => unless(
                self.placed,
                "No piece stands round the body: place some first (Garment › Place pieces)",
            ),
            Action::StepDrape if self.drape.is_some_and(|drape| drape.on && drape.runs) => {
                Some("It drapes: pause it first")
            }
            Action::Unwrap
            | Action::ToggleCloth
            | Action::Export
            | Action::FitPage
            | Action::Compare
            | Action::ToggleRelaxing
            | Action::ToggleDrape
            | Action::StepDrape
            | Action::Map(Some(_)) => unless(self.dressed, "There is no cloth on the body"),
            Action::ToggleDifference | Action::ChangeSides | Action::CloseComparison => {
                unless(self.difference.is_some(), "Nothing is shown beside: compare first")
            }
            Action::DeleteMark | Action::RaiseMark | Action::LowerMark => match &self.selected {
                None => Some("No mark is selected: click one"),
                Some((_, place)) if action == Action::RaiseMark => {
                    unless(place.number > 1, "It is the first")
                }
                Some((_, place)) if action == Action::LowerMark => {
                    unless(place.number < place.count, "It is the last")
                }
                Some(_) => None,
            },
            Action::Delete => unless(self.selected.is_some() || self.picked.deletable, "Nothing is selected"),
            Action::SelectAll => unless(self.pieces > 0, "There is no piece on the table"),
            Action::Duplicate
            | Action::Twin
            | Action::MakeSymmetric
            | Action::TurnOver
            | Action::ToggleFrozen
            | Action::ToggleDeactivated
            | Action::Hide => unless(self.picked.pieces > 0, "No piece is selected"),
            Action::ToggleLock => {
                unless(self.picked.pieces + self.picked.pins > 0, "No piece or pin is selected")
            }
            Action::Unfold => unless(self.picked.straight, "Select a straight edge of an outline first"),
            Action::Fold => unless(self.picked.symmetric, "Select a symmetric piece first"),
            Action::Unlink => unless(self.picked.linked, "Select a twin or a symmetric piece first"),
            Action::ShowPieces => unless(self.picked.hidden, "No piece is hidden"),
            Action::InsertPoint | Action::Straighten | Action::Curve | Action::Arc => {
                unless(self.picked.edges > 0, "No edge is selected")
            }
            Action::ToggleSmooth => unless(self.picked.points > 0, "No point is selected"),
            Action::TurnSeam | Action::MakeEqual | Action::FreeLengths => {
                unless(self.picked.seams > 0, "No seam is selected")
            }
            Action::Untwist => unless(self.twisted, "No seam is twisted"),
            Action::ClearMarks => unless(self.marks[0] + self.marks[1] > 0, "There are no marks"),
            _ => None,
        }
    }

    /// Whether there is a pair of marks.
    fn has_pairs(&self) -> bool {
        self.marks[0].min(self.marks[1]) > 0
    }

    /// Whether *Dress* is what comes next, rather than *Wrap*: pieces stand round the body, and there are no marks.
    pub fn is_for_dress(&self) -> bool {
        self.placed && !self.has_pairs()
    }

    /// Whether `action` names something that is on.
    pub fn is_on(&self, action: Action) -> bool {
        match action {
            // The one button for dragging stands for all its ways.
            Action::Choose(Tool::Drag(DragMode::Surface)) => matches!(self.tool, Tool::Drag(_)),
            Action::Choose(tool) => self.tool == tool,
            Action::ToggleLaser => self.laser,
            Action::ToggleLock => self.picked.locked,
            Action::ToggleRolled => self.picked.rolled,
            Action::ToggleFrozen => self.picked.activity == Some(Activity::Frozen),
            Action::ToggleDeactivated => self.picked.activity == Some(Activity::Deactivated),
            Action::TogglePairs => self.sight.pairs,
            Action::ToggleSnapping => self.snapping,
            Action::Unit(unit) => self.unit == unit,
            Action::ToggleRelaxing => self.relaxing,
            Action::ToggleDrape => self.drape.is_some_and(|drape| drape.on && drape.runs),
            Action::ToggleCloth => self.show_cloth,
            Action::TogglePanel => self.show_panel,
            Action::Show(panes) => self.layout.panes == panes,
            Action::SwapPanes => self.layout.swapped,
            Action::ToggleParallel => self.parallel,
            Action::ToggleFreeTurning => self.free_turning,
            Action::Theme(theme) => self.theme == theme,
            Action::ToggleWire => self.sight.wire,
            Action::ToggleSheer => self.sight.sheer,
            Action::ToggleXray => self.sight.xray,
            Action::ToggleHistory => self.drawer == Some(Drawer::History),
            Action::ToggleLog => self.drawer == Some(Drawer::Log),
            Action::ToggleMapTable => self.drawer == Some(Drawer::Map),
            Action::Map(kind) => self.map == kind,
            Action::ToggleDifference => self.difference == Some(true),
            Action::Mouse(mouse) => self.mouse == mouse,
            Action::Paper(paper) => self.paper == paper,
            _ => false,
        }
    }

    /// The text of `action`, with what undo and redo are about.
    pub fn text(&self, action: Action) -> String {
        let plain = action.entry().text;
        if let Action::OpenRecent(i) = action
            && let Some(file) = self.recent.get(usize::from(i))
        {
            return file.name().0;
        }
        match (action, &self.undo, &self.redo) {
            (Action::Undo, Some(what), _) | (Action::Redo, _, Some(what)) => format!("{plain} {what}"),
            _ => plain.to_owned(),
        }
    }
}
