//! The state of the app that menus, buttons and panels need to show themselves, and when an action is enabled.

use std::sync::Arc;

use crate::drag::DragMode;
use crate::fit::MapKind;
use crate::geometry::ids::MarkId;
use crate::io::pdf::Paper;
use crate::pattern::activity::Activity;
use crate::sim::{DrapeState, Snapshot, Trying};
use crate::ui::actions::drawer::Drawer;
use crate::ui::actions::keymap::Keymap;
use crate::ui::actions::layout::Layout;
use crate::ui::actions::picked::Picked;
use crate::ui::actions::row::Need;
use crate::ui::actions::sight::Sight;
use crate::ui::actions::{Action, Tool};
use crate::ui::files::recent::RecentFile;
use crate::ui::language::{say, tr};
use crate::ui::look::scheme::Theme;
use crate::ui::pointer::mouse::Mouse;
use crate::ui::preferences::units::LengthUnit;
use crate::ui::selection::Item;
use crate::ui::shell::pace::Pace;
use crate::wrap::{MarkPlace, Phase};

/// Work on the cloth that can be stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stops {
    /// Cloth is being put on the body: what was there before comes back.
    Wrap,
    /// Cloth goes to another pose or size of the body: the one before comes back.
    Pose,
    /// Cloth is draped: it stays where it is.
    Drape,
}

impl Stops {
    /// What Esc stops in the state of `snapshot`; `can_undo_pose` tells whether the newest step is a change of pose or size.
    pub fn of(wrapping: bool, snapshot: &Snapshot, can_undo_pose: bool) -> Option<Self> {
        let is_on_its_way = snapshot.is_posing || snapshot.drape.is_some_and(|drape| drape.way.is_some());
        match snapshot.drape {
            _ if wrapping => Some(Self::Wrap),
            _ if is_on_its_way && can_undo_pose => Some(Self::Pose),
            Some(drape) if drape.on && drape.runs => Some(Self::Drape),
            _ => None,
        }
    }
}

/// The state of the app in this frame.
#[derive(Clone, Debug)]
pub struct FrameContext {
    /// Name of the step that undo would take back; None if there is none.
    pub undo: Option<String>,
    /// Name of the step that redo would do again; None if there is none.
    pub redo: Option<String>,
    /// The chosen tool, which the left mouse button uses.
    pub tool: Tool,
    /// The mapping of mouse buttons.
    pub mouse: Mouse,
    /// Paper that patterns are printed on.
    pub paper: Paper,
    /// Laser mode: strokes go through all layers under the pointer.
    pub laser: bool,
    /// Whether the pattern has sizes.
    pub sizes: bool,
    /// Number of pieces in the pattern.
    pub pieces: usize,
    /// Whether the pattern has seams.
    pub sewn: bool,
    /// Number of marks on the cloth and on the body.
    pub marks: [usize; 2],
    /// Number of pins in the cloth.
    pub pins: usize,
    /// Summary of the selection in the pattern.
    pub picked: Picked,
    /// Whether some seam is twisted: it joins the front of one piece to the back of another.
    pub twisted: bool,
    /// Whether the pointer snaps to points, edges, guides and the grid.
    pub snapping: bool,
    /// The item of the pattern under the pointer, in either pane.
    pub highlight: Option<Item>,
    /// Screen points per metre at true size.
    pub points_per_metre: f64,
    /// Speed of the window and of the simulation.
    pub pace: Pace,
    /// Unit in which lengths are shown.
    pub unit: LengthUnit,
    /// The selected mark and its place among the marks.
    pub selected: Option<(MarkId, MarkPlace)>,
    /// Number of proposed pairs of marks that are not accepted yet.
    pub proposed: usize,
    /// Whether there is a body that cloth can be put on.
    pub has_body: bool,
    /// Whether the body has joints that take poses by name.
    pub has_joints: bool,
    /// Whether there is cloth on the body.
    pub dressed: bool,
    /// Whether the cloth is the result of a wrap, which can be removed again.
    pub wrapped: bool,
    /// Whether a wrap is in progress and the cloth is not all on the body yet.
    pub wrapping: bool,
    /// What Esc stops.
    pub stops: Option<Stops>,
    /// While starts are tried: the current one.
    pub trying: Option<Trying>,
    /// Whether the simulation has work to do.
    pub working: bool,
    /// Whether the simulation has finished all requests.
    pub caught_up: bool,
    /// Whether cloth is being dragged.
    pub dragging: bool,
    /// Whether the cloth relaxes; false while it is paused.
    pub relaxing: bool,
    /// Whether some piece is placed around the body.
    pub placed: bool,
    /// Whether the cloth lies as it was carried to the pose of the body.
    pub carried: bool,
    /// State of draping.
    pub drape: Option<DrapeState>,
    /// Phase of the wrap.
    pub phase: Option<Phase>,
    /// Progress of the work, 0..=1.
    pub progress: f64,
    /// Number of ticks of the simulation.
    pub tick: u64,
    /// Number of triangles of the garment.
    pub triangles: usize,
    /// Whether the cloth is drawn.
    pub show_cloth: bool,
    /// Which panes are shown, and where.
    pub layout: Layout,
    /// Whether the side panel is open.
    pub show_panel: bool,
    /// Whether the project has a file.
    pub has_file: bool,
    /// Whether the projection is parallel.
    pub parallel: bool,
    /// Whether the view turns by trackball instead of turntable.
    pub free_turning: bool,
    /// Whether a demo is shown.
    pub demo: bool,
    /// Theme of the interface.
    pub theme: Theme,
    /// Keyboard shortcuts.
    pub keymap: Arc<Keymap>,
    /// Recently opened files.
    pub recent: Arc<Vec<RecentFile>>,
    /// Display options of body and cloth.
    pub sight: Sight,
    /// Whether there is an environment map to go back to.
    pub keeps_environment: bool,
    /// The graphics adapter can draw depth of field.
    pub blurs: bool,
    /// Whether the bar that rotates the environment map is shown.
    pub rotating: bool,
    /// Whether the bar of the aperture is shown.
    pub sets_aperture: bool,
    /// What the drawer below the panes shows; None when it is closed.
    pub drawer: Option<Drawer>,
    /// Map that the cloth is coloured by.
    pub map: Option<MapKind>,
    /// None: no other garment is shown beside; else whether the difference to it is shown.
    pub difference: Option<bool>,
    /// Name of the graphics adapter; None if there is none.
    pub adapter: Option<String>,
    /// Whether a turntable or a fit report is being made.
    pub picturing: bool,
}

impl FrameContext {
    /// Why `action` is disabled; None when it is enabled.
    pub fn why_not(&self, action: Action) -> Option<&'static str> {
        let row = action.row();
        if self.demo && !row.in_demos {
            return Some(tr("A demo is shown: stop it first"));
        }
        row.needs.iter().find_map(|&need| self.lacks(need, action))
    }

    /// The message that `action` is disabled, and why; None when it is enabled.
    pub fn refusal(&self, action: Action) -> Option<String> {
        self.why_not(action).map(|why| format!("{}: {why}.", action.row().label()))
    }

    /// The reason to show if `need` of `action` is not met; None when it is met.
    fn lacks(&self, need: Need, action: Action) -> Option<&'static str> {
        let (picked, mark) = (&self.picked, self.selected.map(|(_, place)| place));
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
            Need::Sizes => {
                (self.sizes, "The pattern has no sizes: give it some first (Sizes of the pattern)")
            }
            Need::Body => (self.has_body, "There is no body"),
            Need::Joints => {
                (self.has_joints, "The body is from a file: only the mannequin takes poses by name")
            }
            Need::Dressed => (self.dressed, "There is no cloth on the body"),
            Need::Work => (self.stops.is_some(), "Nothing is being put on the body, posed or draped"),
            Need::NotGrowing => (!self.wrapping, "The cloth is growing"),
            Need::NotTrying => (self.trying.is_none(), "The garment is being put on: cancel that first"),
            Need::NotDraping => (!self.drapes(), "It drapes: pause it first"),
            Need::Placed => (self.placed, "No piece stands round the body"),
            Need::PlacedFirst => {
                (self.placed, "No piece stands round the body: place some first (Garment › Place pieces)")
            }
            Need::PlacedOrPairs => (self.placed || self.has_pairs(), self.what_to_sew()),
            Need::Pairs => (self.has_pairs(), "Paint at least one mark on a piece and one on the body first"),
            Need::NewPairs => (
                self.has_pairs(),
                "Paint the new marks first: on a piece, and on the body where it should lie",
            ),
            Need::Marks => (self.marks[0] + self.marks[1] > 0, "There are no marks"),
            Need::Mark => (self.selected.is_some(), "No mark is selected: click one"),
            Need::NotFirstMark => (mark.is_none_or(|mark| mark.number > 1), "It is the first"),
            Need::NotLastMark => (mark.is_none_or(|mark| mark.number < mark.count), "It is the last"),
            Need::Pins => (self.pins > 0, "There are no pins"),
            Need::Comparison => (self.difference.is_some(), "Nothing is shown beside: compare first"),
            Need::KeptEnvironment => {
                (self.keeps_environment, "No environment map is chosen: choose one first")
            }
            Need::EnvironmentMap if self.keeps_environment => {
                (self.sight.environment.is_some(), "The environment map is put aside: light by it first")
            }
            Need::EnvironmentMap => {
                (self.sight.environment.is_some(), "No environment map is chosen: choose one first")
            }
            Need::Perspective => (
                !self.parallel,
                "In parallel projection everything is sharp: leave it first (View › Parallel projection)",
            ),
            Need::Blurring => (self.blurs, "The adapter draws by OpenGL, which cannot blur"),
            Need::DepthOfField => (self.sight.lens.is_some(), "Depth of field is off: switch it on first"),
            Need::Selection => (self.selected.is_some() || picked.deletable, "Nothing is selected"),
            Need::PickedPiece => (picked.pieces > 0, "No piece is selected"),
            Need::PickedPieceOrPin => (picked.pieces + picked.pins > 0, "No piece or pin is selected"),
            Need::PickedStraight => (picked.straight, "Select a straight edge of an outline first"),
            Need::PickedSymmetric => (picked.symmetric, "Select a symmetric piece first"),
            Need::PickedLinked => (picked.linked, "Select a twin or a symmetric piece first"),
            Need::Standing => (picked.standing, "No piece that stands round the body is selected"),
            Need::PickedEdge => (picked.edges > 0, "No edge is selected"),
            Need::PickedLine => (picked.edges + picked.lines > 0, "No edge or line is selected"),
            Need::PickedInnerLine => (picked.lines > 0, "No line inside a piece is selected"),
            Need::BowPlace => (
                self.selected.is_some_and(|(_, place)| place.on_cloth) || picked.pieces == 1,
                "Select the place first: a mark on the cloth, a point, a line, an edge or a piece",
            ),
            Need::Buttons => (picked.buttons, "There is no button"),
            Need::PickedPoint => (picked.points > 0, "No point is selected"),
            Need::PickedSeam => (picked.seams > 0, "No seam is selected"),
            Need::Hidden => (picked.hidden, "No piece is hidden"),
            Need::Twisted => (self.twisted, "No seam is twisted"),
        };
        (!is_there).then(|| tr(words))
    }

    /// Why there is nothing to dress, where no piece is placed and there are no marks.
    fn what_to_sew(&self) -> &'static str {
        match self.sewn {
            true => {
                "No piece stands round the body, and there are no marks: place the pieces (Garment › Place pieces) or paint marks, then dress"
            }
            false => {
                "There are neither seams nor marks, and no piece stands round the body: sew the edges (Pattern › Tools › Sew), place the pieces (Garment › Place pieces), then dress"
            }
        }
    }

    fn lacks_file(&self, action: Action) -> Option<&'static str> {
        let Action::OpenRecent(i) = action else { return None };
        match self.recent.get(usize::from(i)) {
            None => Some(tr("No such file was open")),
            Some(file) => (!file.is_there).then(|| tr("The file is no longer there")),
        }
    }

    /// Whether the cloth is moved by draping.
    fn drapes(&self) -> bool {
        self.drape.is_some_and(|drape| drape.on && drape.runs)
    }

    /// Whether there is a pair of marks.
    fn has_pairs(&self) -> bool {
        self.marks[0].min(self.marks[1]) > 0
    }

    /// Whether *Dress* is the next step rather than *Wrap*: pieces are placed around the body, and there are no marks.
    pub fn is_for_dress(&self) -> bool {
        self.placed && !self.has_pairs()
    }

    /// Whether the option or tool that `action` chooses is on.
    pub fn is_on(&self, action: Action) -> bool {
        match action {
            // The one button for dragging is on for all drag modes.
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
            Action::Light(light) => self.sight.light == light && self.sight.environment.is_none(),
            Action::ToggleEnvironment => self.sight.environment.is_some(),
            Action::RotateEnvironment => self.rotating,
            Action::ToggleDepthOfField => self.sight.lens.is_some(),
            Action::SetAperture => self.sets_aperture,
            Action::BodyLook(look) => self.sight.body_look == look,
            Action::ToggleSeamStitches => !self.sight.plain_seams,
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

    /// The label of `action`; for undo and redo with the name of the step.
    pub fn text(&self, action: Action) -> String {
        if let Action::OpenRecent(i) = action
            && let Some(file) = self.recent.get(usize::from(i))
        {
            return file.name().0;
        }
        match (action, &self.undo, &self.redo) {
            (Action::Undo, Some(what), _) => say!("Undo {what}", what),
            (Action::Redo, _, Some(what)) => say!("Redo {what}", what),
            _ => action.row().label().to_owned(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::Simulation;

    #[test]
    fn escape_stops_what_goes_on_with_the_cloth() {
        let rest = Simulation::default().snapshot();
        assert_eq!(Stops::of(false, &rest, true), None);
        assert_eq!(Stops::of(true, &rest, true), Some(Stops::Wrap));
        let posing = Snapshot { is_posing: true, ..rest.clone() };
        assert_eq!(Stops::of(false, &posing, true), Some(Stops::Pose));
        assert_eq!(Stops::of(false, &posing, false), None, "another step came after it");
        let drape = DrapeState {
            on: true,
            waits: false,
            runs: true,
            restless: false,
            residual: 0.5,
            speed: 0.1,
            ticks: 1,
            substeps: 10,
            card: false,
            way: None,
        };
        let draping = |drape| Snapshot { drape: Some(drape), ..rest.clone() };
        assert_eq!(Stops::of(false, &draping(drape), true), Some(Stops::Drape));
        assert_eq!(Stops::of(false, &draping(DrapeState { on: false, ..drape }), true), None);
        let on_its_way = draping(DrapeState { way: Some(0.3), ..drape });
        assert_eq!(Stops::of(false, &on_its_way, true), Some(Stops::Pose));
        assert_eq!(Stops::of(false, &on_its_way, false), Some(Stops::Drape));
    }
}
