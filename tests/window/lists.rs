//! Drop-down lists, led by keys and by the pointer.

use egui::accesskit::Role;
use toile::cloth::Fabric;
use toile::session::{Command, ImageFile};

use super::*;

/// Gives the keyboard to the list with this label, and opens it by a key.
fn open(window: &mut Window, list: &str) {
    window.get_by_role_and_label(Role::ComboBox, list).focus();
    window.run_steps(2);
    key(window, Modifiers::NONE, Key::Enter);
}

pub fn type_letters(window: &mut Window, letters: &str) {
    for letter in letters.chars() {
        window.event(Event::Text(letter.to_string()));
        window.run_steps(3);
    }
}

/// Checks which entry of the open list has the keyboard.
#[track_caller]
pub fn is_at(window: &Window, entry: &str) {
    assert!(window.get_by_role_and_label(Role::Button, entry).is_focused(), "{entry}");
}

/// Checks that the list is closed and has the keyboard, and what is chosen in it.
#[track_caller]
fn is_closed(window: &Window, list: &str, chosen: &str) {
    let list = window.get_by_role_and_label(Role::ComboBox, list);
    assert!(list.is_focused(), "the keyboard");
    assert_eq!(list.value().as_deref(), Some(chosen));
    assert!(!egui::Popup::is_any_open(&window.ctx), "the list");
}

fn fabric(window: &Window) -> String {
    app(window).session().document().fabrics.name(None).to_owned()
}

/// Where the entries of the list of fabrics are.
fn places(window: &Window) -> Vec<Rect> {
    let place = |fabric: &Fabric| window.get_by_role_and_label(Role::Button, &fabric.name).rect();
    Fabric::presets().iter().map(place).collect()
}

#[test]
fn a_fabric_is_chosen_by_keys_alone() {
    let mut window = window();
    open(&mut window, "All pieces");
    is_at(&window, "cotton");
    for (pressed, entry) in [
        (Key::ArrowDown, "wool"),
        (Key::ArrowUp, "cotton"),
        (Key::ArrowUp, "sweat-knit"),
        (Key::ArrowLeft, "sweat-knit"),
        (Key::Home, "denim-11oz"),
        (Key::ArrowUp, "denim-11oz"),
        (Key::End, "tulle"),
        (Key::ArrowDown, "tulle"),
    ] {
        key(&mut window, Modifiers::NONE, pressed);
        is_at(&window, entry);
    }
    for (letter, entry) in [("w", "woven-heavy"), ("o", "woven-heavy"), ("o", "wool")] {
        type_letters(&mut window, letter);
        is_at(&window, entry);
    }
    assert_eq!(fabric(&window), "cotton", "none is chosen yet");
    key(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(fabric(&window), "wool");
    is_closed(&window, "All pieces", "wool");
    // It begins at what was chosen, and Esc leaves that.
    key(&mut window, Modifiers::NONE, Key::Space);
    is_at(&window, "wool");
    key(&mut window, Modifiers::NONE, Key::ArrowDown);
    key(&mut window, Modifiers::NONE, Key::Escape);
    is_closed(&window, "All pieces", "wool");
    assert_eq!(app(&window).session().undo_label(), Some("change the fabric"));
}

#[test]
fn a_list_is_scrolled_to_the_entry_that_keys_lead_to() {
    let mut window = window();
    open(&mut window, "All pieces");
    for (pressed, entry) in [(Key::End, "tulle"), (Key::Home, "denim-11oz")] {
        key(&mut window, Modifiers::NONE, pressed);
        let at = window.get_by_role_and_label(Role::Button, entry).rect().center();
        let under = window.ctx.layer_id_at(at).expect("a layer");
        assert_eq!(under.order, egui::Order::Foreground, "{entry} is in the list");
    }
    // Opened by a key it shows the present entry, however far below the others that is.
    key(&mut window, Modifiers::NONE, Key::Escape);
    edit(&mut window, |app, _| wear(app, "tulle"));
    open(&mut window, "All pieces");
    is_at(&window, "tulle");
    window.get_by_role_and_label(Role::Button, "leather").click();
    window.run_steps(3);
    assert_eq!(fabric(&window), "leather");
}

fn wear(app: &mut App, fabric: &str) {
    let command = Command::SetFabric { piece: None, fabric: Some(fabric.to_owned()) };
    app.session_mut().apply_alone(command).expect("a fabric");
}

/// The click after the one that opened the list hit the entry that had moved below the pointer.
#[test]
fn a_list_that_the_pointer_opened_stays_where_it_is_until_a_key_leads_on() {
    for present in ["denim-11oz", "cotton", "tulle"] {
        let mut window = window();
        edit(&mut window, |app, _| wear(app, present));
        window.get_by_role_and_label(Role::ComboBox, "All pieces").click();
        window.run_steps(3);
        let first = places(&window);
        for _ in 0..40 {
            window.run_steps(1);
            assert_eq!(places(&window), first, "{present}");
        }
        is_at(&window, present);
    }
    let mut window = window();
    edit(&mut window, |app, _| wear(app, "tulle"));
    window.get_by_role_and_label(Role::ComboBox, "All pieces").click();
    window.run_steps(3);
    let first = places(&window);
    key(&mut window, Modifiers::NONE, Key::ArrowUp);
    is_at(&window, "leather");
    assert!(places(&window)[0].top() < first[0].top(), "now it is scrolled");
    // What the pointer opened and closed does not keep the keyboard: Space is to drape.
    window.get_by_role_and_label(Role::Button, "leather").click();
    window.run_steps(3);
    assert_eq!(fabric(&window), "leather");
    assert_eq!(window.ctx.memory(|m| m.focused()), None);
}

#[test]
fn a_joint_is_chosen_by_keys() {
    let mut window = window_on(Project::default(), None);
    act(&mut window, "Pose");
    window.run_steps(8);
    open(&mut window, "Joint");
    is_at(&window, "Left elbow");
    type_letters(&mut window, "r");
    is_at(&window, "Right elbow");
    key(&mut window, Modifiers::NONE, Key::Home);
    is_at(&window, "Spine");
    key(&mut window, Modifiers::NONE, Key::Space);
    is_closed(&window, "Joint", "Spine");
    window.get_by_role_and_label(Role::Slider, "Spine: Forward / backward");
}

#[test]
fn keys_lead_through_lists_of_dialogs_and_escape_closes_only_the_list() {
    let mut window = window();
    key(&mut window, Modifiers::COMMAND, Key::Comma);
    open(&mut window, "Size of everything: 100 %");
    is_at(&window, "100 %");
    key(&mut window, Modifiers::NONE, Key::ArrowDown);
    is_at(&window, "110 %");
    key(&mut window, Modifiers::NONE, Key::Escape);
    assert!(window.query_by_label("150 %").is_none(), "the list is closed");
    assert!(window.query_by_label("Reset this page").is_some(), "the page is not");
    open(&mut window, "Copies of unsaved work: every 10 seconds");
    key(&mut window, Modifiers::NONE, Key::End);
    is_at(&window, "every 5 minutes");
    key(&mut window, Modifiers::NONE, Key::Enter);
    window.get_by_role_and_label(Role::ComboBox, "Copies of unsaved work: every 5 minutes");
    open(&mut window, "Language: As the system");
    type_letters(&mut window, "d");
    is_at(&window, "Deutsch");
    key(&mut window, Modifiers::NONE, Key::Enter);
    window.get_by_role_and_label(Role::ComboBox, "Sprache: Deutsch");
}

#[test]
fn the_view_of_a_picture_is_chosen_by_keys() {
    let Some(device) = egui_wgpu_device() else { return };
    let mut window = window_on(project(), Some(device));
    key(&mut window, Modifiers::COMMAND | Modifiers::SHIFT, Key::P);
    open(&mut window, "Seen");
    is_at(&window, "as now");
    type_letters(&mut window, "b");
    is_at(&window, "Back");
    key(&mut window, Modifiers::NONE, Key::Enter);
    is_closed(&window, "Seen", "Back");
    open(&mut window, "Smoothness");
    type_letters(&mut window, "4");
    key(&mut window, Modifiers::NONE, Key::Space);
    is_closed(&window, "Smoothness", "4 × 4 samples for each pixel");
}

/// As a list that drops down it closed the menu that it was in.
#[test]
fn the_image_of_a_fabric_is_chosen_in_the_menu_of_its_colours() {
    let mut window = window();
    edit(&mut window, |app, _| {
        let picture = image::RgbaImage::from_pixel(20, 10, image::Rgba([200, 30, 40, 255]));
        for name in ["stripes.png", "dots.png"] {
            let file = ImageFile::new(name, toile::render::png(&picture).expect("a file"));
            app.session_mut().apply_alone(Command::AddImage { file: Arc::new(file) }).expect("an image");
        }
    });
    let worn = |window: &Window| {
        let document = app(window).session().document();
        document.dyes.all.image.map(|own| document.artwork.images[&own.image].name.clone())
    };
    act(&mut window, "Colour and print of All pieces");
    window.get_by_role_and_label(Role::CheckBox, "Image").click();
    window.run_steps(4);
    assert_eq!(worn(&window).as_deref(), Some("stripes.png"));
    for name in ["dots.png", "stripes.png"] {
        window.get_by_role_and_label(Role::Button, name).click();
        window.run_steps(4);
        assert_eq!(worn(&window).as_deref(), Some(name), "and the menu is still open");
    }
}
