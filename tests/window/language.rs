//! The window in other languages.

use egui::accesskit::Role;

use super::files::write_by;
use super::hand::dressed_window;
use super::marker::enter;
use super::*;

/// A window that keeps its preferences in `folder`.
fn window_kept_in(folder: &std::path::Path) -> Window {
    let mut window = window();
    edit(&mut window, |app, ctx| app.keep_preferences(ctx, folder.join("preferences.json")));
    window
}

#[test]
fn a_language_is_chosen_at_once_and_kept() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window_kept_in(folder.path());
    key(&mut window, Modifiers::COMMAND, Key::Comma);
    act(&mut window, "Language: As the system");
    act(&mut window, "Deutsch");
    for label in ["Einstellungen", "Sprache: Deutsch", "Datei", "Kleidung", "Fertig"] {
        assert!(window.query_by_label(label).is_some(), "{label}");
    }
    assert!(window.query_by_label("File").is_none());
    act(&mut window, "Fertig");
    act(&mut window, "Bearbeiten");
    assert!(window.query_by_label_contains("Alles auswählen").is_some());
    key(&mut window, Modifiers::NONE, Key::Escape);
    // Commands are found by their names in both languages.
    for typed in ["alles aus", "select all"] {
        key(&mut window, Modifiers::COMMAND, Key::P);
        window.event(Event::Text(typed.to_owned()));
        window.run_steps(3);
        assert!(window.query_by_label("Befehl Alles auswählen").is_some(), "{typed}");
        key(&mut window, Modifiers::NONE, Key::Escape);
    }
    let again = window_kept_in(folder.path());
    assert!(again.query_by_label("Datei").is_some());
}

#[test]
fn the_system_is_followed_and_tables_of_files_are_offered() {
    let folder = tempfile::tempdir().expect("a folder");
    let tables = folder.path().join("languages");
    std::fs::create_dir(&tables).expect("made");
    let french = r#"{"code": "fr", "name": "Français", "texts": {"File": "Fichier"}}"#;
    std::fs::write(tables.join("fr.json"), french).expect("written");
    std::fs::write(tables.join("broken.json"), "{\"code\": 1}").expect("written");
    let mut window = window_kept_in(folder.path());
    assert!(window.query_by_label_contains("broken.json").is_some(), "what is no table is told");
    assert!(window.query_by_label("File").is_some());
    edit(&mut window, |app, _| app.follow_language("fr_CA.UTF-8".to_owned()));
    assert!(window.query_by_label("Fichier").is_some());
    assert!(window.query_by_label("Edit").is_some(), "what the table lacks is English");
    edit(&mut window, |app, _| app.follow_language("de_AT".to_owned()));
    assert!(window.query_by_label("Datei").is_some());
}

fn value(window: &Window, role: Role, label: &str) -> String {
    window.get_by_role_and_label(role, label).accesskit_node().value().expect("a value")
}

#[test]
fn in_german_numbers_have_a_comma_and_both_signs_are_typed() {
    let mut window = window();
    edit(&mut window, |app, _| app.follow_language("de".to_owned()));
    from_menu(&mut window, "Datei", "Schnittbild…");
    for (typed, shown) in [("2,5", "2,5"), ("3.5", "3,5"), ("4", "4,0")] {
        enter(&mut window, Role::SpinButton, "Neigung", typed);
        window.run_steps(2);
        let found = value(&window, Role::SpinButton, "Neigung");
        assert_eq!(found.trim_end_matches('°'), shown, "{typed}");
    }
    for (typed, shown) in [("140,5", "140,5 cm"), ("1.255 m", "125,5 cm"), ("130", "130 cm")] {
        enter(&mut window, Role::TextInput, "Stoffbreite", typed);
        window.run_steps(2);
        assert_eq!(value(&window, Role::TextInput, "Stoffbreite"), shown, "{typed}");
    }
}

#[test]
fn in_english_a_comma_may_be_typed_too() {
    let mut window = window();
    from_menu(&mut window, "File", "Marker…");
    enter(&mut window, Role::SpinButton, "Tilt", "2,5");
    window.run_steps(2);
    assert_eq!(value(&window, Role::SpinButton, "Tilt").trim_end_matches('°'), "2.5");
}

#[test]
fn the_legend_of_a_map_is_in_the_language_of_the_window() {
    let mut window = dressed_window();
    edit(&mut window, |app, _| app.follow_language("de".to_owned()));
    for label in ["Ansicht", "Karte", "Mehrweite: Abstand zum Körper"] {
        window.get_by_label(label).click();
        window.run_steps(4);
    }
    let legend =
        window.get_by_label_contains("Legende: Mehrweite").accesskit_node().label().expect("a label");
    let has_comma =
        legend.split(' ').any(|word| word.contains(',') && word.replace(',', ".").parse::<f64>().is_ok());
    assert!(has_comma && !legend.contains('.'), "{legend}");
}

#[test]
fn the_fit_report_is_in_the_language_of_the_window() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("fit.html");
    let mut window = dressed_window();
    edit(&mut window, |app, _| app.follow_language("de".to_owned()));
    super::hand::choose(&mut window, "Datei", "Passformbericht…");
    if !write_by(&mut window, "Schreiben", &path) {
        return;
    }
    window.run_steps(30);
    let page = std::fs::read_to_string(&path).expect("the page");
    assert!(page.contains("<html lang=\"de\">") && page.contains("Kleidungsstück und Körper"), "{page:.400}");
    assert!(!page.contains("Garment and body") && !page.contains("Measures of the body"));
}
