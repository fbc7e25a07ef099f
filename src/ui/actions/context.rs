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
use crate::ui::actions::row::Need;
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
        let row = action.row();
        if self.demo && !row.in_demos {
            return Some("A demo is shown: stop it first");
        }
        row.needs.iter().find_map(|&need| self.lacks(need, action))
    }

    /// What is to be told where there is not what `action` needs.
    fn lacks(&self, need: Need, action: Action) -> Option<&'static str> {
        let picked = &self.picked;
        let (is_there, words) = match need {
            Need::Demo => (self.demo, "No demo is shown"),
            Need::RecentFile => return self.lacks_file(action),
            Need::Recent => (!self.recent.is_empty(), "No file was open before"),
            Need::NotPicturing => (!self.picturing, "Pictures are being made"),
            Need::Adapter => (self.adapter.is_some(), "There is no graphics adapter to draw with"),
            Need::Undo => (self.undo.is_some(), "There is nothing to undo"),
            Need::Redo => (self.redo.is_some(), "There is nothing to redo"),
            Need::File => (self.has_file, "The project was not saved yet"),
            Need::Pieces => (self.pieces > 0, "There is no piece on the table"),
            Need::Body => (self.has_body, "There is no body"),
            Need::Dressed => (self.dressed, "There is no cloth on the body"),
            Need::Growing => (self.wrapping, "Nothing is growing"),
            Need::NotGrowing => (!self.wrapping, "The cloth is growing"),
            Need::NotTrying => (self.trying.is_none(), "The garment is being put on: cancel that first"),
            Need::NotDraping => (!self.drapes(), "It drapes: pause it first"),
            Need::Placed => (self.placed, "No piece stands round the body"),
            Need::PlacedFirst => {
                (self.placed, "No piece stands round the body: place some first (Garment › Place pieces)")
            }
            Need::PlacedOrPairs => {
                (self.placed || self.has_pairs(), "No piece stands round the body, and there are no marks")
            }
            Need::Pairs => (self.has_pairs(), "Paint at least one mark on a piece and one on the body first"),
            Need::NewPairs => (
                self.has_pairs(),
                "Paint the new marks first: on a piece, and on the body where it should lie",
            ),
            Need::Marks => (self.marks[0] + self.marks[1] > 0, "There are no marks"),
            Need::Mark => (self.selected.is_some(), "No mark is selected: click one"),
            Need::NotFirstMark => {
                (self.selected.is_none_or(|(_, place)| place.number > 1), "It is the first")
            }
            Need::NotLastMark => {
                (self.selected.is_none_or(|(_, place)| place.number < place.count), "It is the last")
            }
            Need::Pins => (self.pins > 0, "There are no pins"),
            Need::Comparison => (self.difference.is_some(), "Nothing is shown beside: compare first"),
            Need::Selection => (self.selected.is_some() || picked.deletable, "Nothing is selected"),
            Need::PickedPiece => (picked.pieces > 0, "No piece is selected"),
            Need::PickedPieceOrPin => (picked.pieces + picked.pins > 0, "No piece or pin is selected"),
            Need::PickedStraight => (picked.straight, "Select a straight edge of an outline first"),
            Need::PickedSymmetric => (picked.symmetric, "Select a symmetric piece first"),
            Need::PickedLinked => (picked.linked, "Select a twin or a symmetric piece first"),
            Need::Standing => (picked.standing, "No piece that stands round the body is selected"),
            Need::PickedEdge => (picked.edges > 0, "No edge is selected"),
            Need::PickedPoint => (picked.points > 0, "No point is selected"),
            Need::PickedSeam => (picked.seams > 0, "No seam is selected"),
            Need::Hidden => (picked.hidden, "No piece is hidden"),
            Need::Twisted => (self.twisted, "No seam is twisted"),
        };
        (!is_there).then_some(words)
    }

    fn lacks_file(&self, action: Action) -> Option<&'static str> {
        let Action::OpenRecent(i) = action else { return None };
        match self.recent.get(usize::from(i)) {
            None => Some("No such file was open"),
            Some(file) => (!file.is_there).then_some("The file is no longer there"),
        }
    }

    /// Whether physics moves the cloth.
    fn drapes(&self) -> bool {
        self.drape.is_some_and(|drape| drape.on && drape.runs)
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
            Action::ToggleDrape => self.drapes(),
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
        let plain = action.row().text;
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
