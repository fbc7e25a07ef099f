//! Actions of the File menu.

use egui::{Key, KeyboardShortcut, Modifiers};

use crate::io::pdf::Paper;
use crate::ui::actions::Action;
use crate::ui::actions::row::{Need, Row, ctrl, ctrl_shift, row};

/// The rows in the order of the menus.
pub const ROWS: &[Row] = &[
    row("File", Action::New, "New", "Start with an empty table and the mannequin").keys(&[ctrl(Key::N)]),
    row("File", Action::StartPage, "Start page", "Begin anew, open a file or a sample, or take the tour")
        .on_start_page(),
    row("File", Action::Open, "Open…", "Open a project").keys(&[ctrl(Key::O)]).on_start_page(),
    row("File", Action::Save, "Save", "Save the project").keys(&[ctrl(Key::S)]),
    row("File", Action::SaveAs, "Save as…", "Save the project under another name")
        .keys(&[ctrl_shift(Key::S)]),
    row(
        "File",
        Action::SaveCopy,
        "Save a copy…",
        "Save the project under another name and go on with this one",
    ),
    row(
        "File",
        Action::SaveNext,
        "Save the next version",
        "Save the project beside its file, with the next number in its name",
    )
    .keys(&[KeyboardShortcut::new(Modifiers::COMMAND.plus(Modifiers::ALT), Key::S)])
    .needs(&[Need::File]),
    row("File", Action::Revert, "Revert…", "Go back to what the file holds").needs(&[Need::File]),
    row(
        "File",
        Action::ImportPattern,
        "Import pattern…",
        "Take the pieces of a DXF, SVG or GarmentCode file",
    )
    .keys(&[ctrl(Key::I)]),
    row("File", Action::ImportBody, "Import body…", "Take a body from an OBJ or glTF file"),
    row(
        "File",
        Action::AddImage,
        "Take an image…",
        "Take a PNG or JPEG into the project, for fabrics and graphics",
    ),
    row(
        "File",
        Action::PoseFromFile,
        "Pose from a file…",
        "Lead the body to its pose in an OBJ or glTF file or through the animations \
         there, or the mannequin through a BVH motion",
    ),
    row(
        "File",
        Action::Sequence,
        "Sequence of OBJ files…",
        "Take numbered OBJ files, one for each picture, as an animation of the body",
    ),
    row(
        "File",
        Action::Sizes,
        "Sizes from a table…",
        "Read the sizes of a table (CSV), to build the mannequin to one of them",
    ),
    row("File", Action::UseMannequin, "Use the mannequin", "Go back to the built-in figure"),
    row(
        "File",
        Action::ExportPattern,
        "Export pattern…",
        "Write the pieces as .pdf in true size, .svg, .dxf or .json (GarmentCode)",
    )
    .keys(&[ctrl_shift(Key::E)])
    .needs(&[Need::Pieces]),
    row("File", Action::Export, "Export…", "Write the dressed garment as .obj, .glb, .usda or .usdz")
        .keys(&[ctrl(Key::E)])
        .needs(&[Need::Dressed])
        .in_demos(),
    row(
        "File",
        Action::FitPage,
        "Fit report…",
        "Write views, ease, seams, strain and maps of the dressed garment on one page (HTML)",
    )
    .needs(&[Need::NotPicturing, Need::Dressed]),
    row(
        "File",
        Action::TechPack,
        "Tech pack…",
        "Write what a garment maker needs to know as PDF: pictures, cloth needed, measures, pieces, seams, trims",
    )
    .needs(&[Need::NotPicturing, Need::Pieces]),
    row(
        "File",
        Action::Marker,
        "Marker…",
        "Lay all pieces out on a width of cloth, to be cut: length, yield, and the layout as .pdf, .svg or .dxf",
    )
    .needs(&[Need::Pieces])
    .in_demos(),
    row(
        "File",
        Action::Picture,
        "Save a picture…",
        "Write the body pane as PNG: any size, any side, with a transparent background, \
         or a full turn",
    )
    .keys(&[ctrl_shift(Key::P)])
    .needs(&[Need::NotPicturing, Need::Adapter])
    .in_demos(),
    row(
        "File",
        Action::SaveRecording,
        "Save recording…",
        "Write everything done so far as a script that can be replayed",
    ),
    row("File", Action::ClearRecent, "Clear the list", "Forget which files were open before")
        .needs(&[Need::Recent])
        .on_start_page(),
    row("File", Action::OpenRecent(0), "Open again", "Open a file that was open before")
        .needs(&[Need::RecentFile])
        .on_start_page()
        .aside(),
    row("File", Action::Quit, "Quit", "Leave Toile").keys(&[ctrl(Key::Q)]).in_demos().on_start_page(),
    row(
        "File › Paper",
        Action::Paper(Paper::A4),
        "A4",
        "Print patterns (PDF) on A4 pages, to be glued together",
    )
    .in_demos()
    .on_start_page(),
    row(
        "File › Paper",
        Action::Paper(Paper::Letter),
        "Letter",
        "Print patterns (PDF) on Letter pages, to be glued together",
    )
    .in_demos()
    .on_start_page(),
    row(
        "File › Paper",
        Action::Paper(Paper::One),
        "One page",
        "Print patterns (PDF) on one page as large as needed, for a plotter",
    )
    .in_demos()
    .on_start_page(),
];
