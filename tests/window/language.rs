//! The window in other languages.

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
