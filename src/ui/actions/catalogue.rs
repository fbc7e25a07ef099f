//! Every action there is, and where in the menus it is found: what keys and the command palette go through.

use egui::ThemePreference;

use crate::drag::DragMode;
use crate::fit::MapKind;
use crate::io::pdf::Paper;
use crate::render::View;
use crate::session::demos::Demo;
use crate::session::samples::Sample;
use crate::ui::actions::layout::Panes;
use crate::ui::actions::{Action, Tool};
use crate::ui::pointer::mouse::Mouse;
use crate::ui::preferences::units::LengthUnit;

/// Actions that can be chosen at any time. Not those of proposed marks, whose keys come before all others while there are
/// any, and not files opened before.
pub const ALL: &[Action] = &[
    Action::New,
    Action::StartPage,
    Action::Sample(Sample::Tshirt),
    Action::Sample(Sample::Skirt),
    Action::Sample(Sample::Dress),
    Action::Sample(Sample::Trousers),
    Action::Sample(Sample::Scarf),
    Action::Open,
    Action::Save,
    Action::SaveAs,
    Action::SaveCopy,
    Action::SaveNext,
    Action::Revert,
    Action::ImportPattern,
    Action::ImportBody,
    Action::PoseFromFile,
    Action::Sequence,
    Action::Sizes,
    Action::UseMannequin,
    Action::ExportPattern,
    Action::Export,
    Action::FitPage,
    Action::Picture,
    Action::SaveRecording,
    Action::ClearRecent,
    Action::Preferences,
    Action::Quit,
    Action::Undo,
    Action::Redo,
    Action::Delete,
    Action::SelectAll,
    Action::Duplicate,
    Action::DeleteMark,
    Action::RaiseMark,
    Action::LowerMark,
    Action::ToggleLaser,
    Action::SuggestMarks,
    Action::ClearMarks,
    Action::Choose(Tool::Mark),
    Action::Choose(Tool::Erase),
    Action::Choose(Tool::Move),
    Action::Choose(Tool::Points),
    Action::Choose(Tool::Sew),
    Action::Choose(Tool::Pen),
    Action::Choose(Tool::Rectangle),
    Action::Choose(Tool::Ellipse),
    Action::Choose(Tool::Line),
    Action::Choose(Tool::Hole),
    Action::Choose(Tool::Cut),
    Action::Choose(Tool::Dart),
    Action::Choose(Tool::Notch),
    Action::Choose(Tool::Grain),
    Action::Twin,
    Action::MakeSymmetric,
    Action::Unfold,
    Action::Fold,
    Action::Unlink,
    Action::TurnOver,
    Action::ToggleLock,
    Action::ToggleFrozen,
    Action::ToggleDeactivated,
    Action::Hide,
    Action::ShowPieces,
    Action::InsertPoint,
    Action::ToggleSmooth,
    Action::Straighten,
    Action::Curve,
    Action::Arc,
    Action::TurnSeam,
    Action::MakeEqual,
    Action::FreeLengths,
    Action::Untwist,
    Action::Dress,
    Action::Wrap,
    Action::Rewrap,
    Action::CancelWrap,
    Action::Unwrap,
    Action::ToggleRelaxing,
    Action::Choose(Tool::Place),
    Action::BringPieces,
    Action::ToggleRolled,
    Action::Unplace,
    Action::Sew,
    Action::ToggleDrape,
    Action::StepDrape,
    Action::Choose(Tool::Drag(DragMode::Surface)),
    Action::Choose(Tool::Drag(DragMode::Vertex)),
    Action::Choose(Tool::Drag(DragMode::Rigid)),
    Action::Choose(Tool::Pin),
    Action::Choose(Tool::Bone),
    Action::OwnBones,
    Action::NoBones,
    Action::ClearPins,
    Action::Look(View::Front),
    Action::Look(View::Back),
    Action::Look(View::Left),
    Action::Look(View::Right),
    Action::Look(View::Top),
    Action::Look(View::Below),
    Action::Look(View::ThreeQuarter),
    Action::FrameAll,
    Action::FrameSelection,
    Action::TrueSize,
    Action::ToggleParallel,
    Action::ToggleFreeTurning,
    Action::ToggleCloth,
    Action::ToggleWire,
    Action::ToggleSheer,
    Action::ToggleXray,
    Action::TogglePairs,
    Action::ToggleSnapping,
    Action::ClearGuides,
    Action::TogglePanel,
    Action::Show(Panes::Both),
    Action::Show(Panes::Pattern),
    Action::Show(Panes::Body),
    Action::SwapPanes,
    Action::ToggleHistory,
    Action::ToggleLog,
    Action::Map(None),
    Action::Map(Some(MapKind::Warp)),
    Action::Map(Some(MapKind::Weft)),
    Action::Map(Some(MapKind::Shear)),
    Action::Map(Some(MapKind::Area)),
    Action::Map(Some(MapKind::Ease)),
    Action::Map(Some(MapKind::Curvature)),
    Action::Map(Some(MapKind::MeanCurvature)),
    Action::Map(Some(MapKind::Seams)),
    Action::Map(Some(MapKind::Pressure)),
    Action::ToggleMapTable,
    Action::Compare,
    Action::ToggleDifference,
    Action::ChangeSides,
    Action::CloseComparison,
    Action::NextPane,
    Action::PreviousPane,
    Action::Unit(LengthUnit::Cm),
    Action::Unit(LengthUnit::Mm),
    Action::Unit(LengthUnit::Inch),
    Action::Theme(ThemePreference::Dark),
    Action::Theme(ThemePreference::Light),
    Action::Theme(ThemePreference::System),
    Action::Mouse(Mouse::Paper),
    Action::Mouse(Mouse::Clo),
    Action::Mouse(Mouse::Blender),
    Action::Mouse(Mouse::Maya),
    Action::Paper(Paper::A4),
    Action::Paper(Paper::Letter),
    Action::Paper(Paper::One),
    Action::CommandPalette,
    Action::Shortcuts,
    Action::Tour,
    Action::Demo(Demo::Wrapping),
    Action::Demo(Demo::Dragging),
    Action::Demo(Demo::Rewrapping),
    Action::Demo(Demo::Rewearing),
    Action::Demo(Demo::Laser),
    Action::Demo(Demo::Scarf),
    Action::Demo(Demo::Modes),
    Action::Demo(Demo::Pins),
    Action::StopDemo,
];

impl Action {
    /// Its name in files: stays the same whatever language people speak.
    pub fn id(self) -> String {
        format!("{self:?}")
    }

    /// The menu it is found in.
    pub fn menu(self) -> &'static str {
        match self {
            Self::New
            | Self::StartPage
            | Self::Open
            | Self::OpenRecent(_)
            | Self::ClearRecent
            | Self::Save
            | Self::SaveAs
            | Self::SaveCopy
            | Self::SaveNext
            | Self::Revert
            | Self::ImportPattern
            | Self::ImportBody
            | Self::PoseFromFile
            | Self::Sequence
            | Self::Sizes
            | Self::UseMannequin
            | Self::ExportPattern
            | Self::Export
            | Self::FitPage
            | Self::Picture
            | Self::SaveRecording
            | Self::Quit => "File",
            Self::Sample(_) => "File › Samples",
            Self::Paper(_) => "File › Paper",
            Self::Undo
            | Self::Redo
            | Self::Delete
            | Self::SelectAll
            | Self::Duplicate
            | Self::DeleteMark
            | Self::RaiseMark
            | Self::LowerMark
            | Self::ClearMarks
            | Self::SuggestMarks
            | Self::AcceptMarks
            | Self::DismissMarks
            | Self::ToggleLaser
            | Self::Preferences => "Edit",
            Self::Choose(Tool::Mark | Tool::Erase) => "Tools",
            Self::Choose(Tool::Drag(_) | Tool::Pin | Tool::Bone | Tool::Place)
            | Self::OwnBones
            | Self::NoBones
            | Self::ClearPins
            | Self::Dress
            | Self::Wrap
            | Self::Rewrap
            | Self::CancelWrap
            | Self::Unwrap
            | Self::ToggleRelaxing
            | Self::BringPieces
            | Self::ToggleRolled
            | Self::Unplace
            | Self::Sew
            | Self::ToggleDrape
            | Self::StepDrape => "Garment",
            Self::Choose(_) => "Pattern › Tools",
            Self::Twin
            | Self::MakeSymmetric
            | Self::Unfold
            | Self::Fold
            | Self::Unlink
            | Self::TurnOver
            | Self::ToggleLock
            | Self::ToggleFrozen
            | Self::ToggleDeactivated
            | Self::Hide
            | Self::ShowPieces
            | Self::InsertPoint
            | Self::ToggleSmooth
            | Self::Straighten
            | Self::Curve
            | Self::Arc
            | Self::TurnSeam
            | Self::MakeEqual
            | Self::FreeLengths
            | Self::Untwist => "Pattern",
            Self::Unit(_) => "View › Unit",
            Self::Theme(_) => "View › Theme",
            Self::Map(_) | Self::ToggleMapTable => "View › Map",
            Self::Compare | Self::ToggleDifference | Self::ChangeSides | Self::CloseComparison => "View",
            Self::Mouse(_) => "View › Mouse",
            Self::Shortcuts | Self::CommandPalette | Self::Tour | Self::StopDemo => "Help",
            Self::Demo(_) => "Help › Demos",
            Self::Look(_)
            | Self::FrameAll
            | Self::FrameSelection
            | Self::TrueSize
            | Self::NextPane
            | Self::PreviousPane
            | Self::ToggleSnapping
            | Self::ClearGuides
            | Self::ToggleParallel
            | Self::ToggleFreeTurning
            | Self::ToggleCloth
            | Self::ToggleWire
            | Self::ToggleSheer
            | Self::ToggleXray
            | Self::TogglePairs
            | Self::TogglePanel
            | Self::Show(_)
            | Self::SwapPanes
            | Self::ToggleHistory
            | Self::ToggleLog => "View",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_action_is_there_once_and_says_what_it_does() {
        for (i, action) in ALL.iter().enumerate() {
            assert!(!ALL[i + 1..].contains(action), "{action:?} is there twice");
            let entry = action.entry();
            assert!(!entry.text.is_empty() && !entry.tip.is_empty(), "{action:?}");
        }
        for sample in Sample::ALL {
            assert!(ALL.contains(&Action::Sample(sample)), "{sample:?}");
        }
        for kind in MapKind::ALL {
            assert!(ALL.contains(&Action::Map(Some(kind))), "{kind:?}");
        }
        for demo in Demo::ALL {
            assert!(ALL.contains(&Action::Demo(demo)), "{demo:?}");
        }
    }
}
