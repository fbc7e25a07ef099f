//! The environment map that lights the body pane.

use std::path::{Path, PathBuf};

use egui::accesskit::Role;

use super::*;

/// Writes an image of all directions, red on one side and blue on the other, of this width; it is 8 pixels high.
fn write_image(path: &Path, width: usize) {
    let mut bytes = Vec::new();
    let side = |i: usize| if i % width < width / 2 { [9.0, 1.0, 1.0] } else { [1.0, 1.0, 9.0] };
    let pixels: Vec<_> = (0..8 * width).map(|i| image::Rgb(side(i))).collect();
    image::codecs::hdr::HdrEncoder::new(&mut bytes).encode(&pixels, width, 8).expect("written");
    std::fs::write(path, bytes).expect("a file");
}

/// A folder with garden.hdr, square.hdr, which is not twice as wide as high, and the path of preferences that are not there yet.
fn folder() -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    write_image(&folder.path().join("garden.hdr"), 16);
    write_image(&folder.path().join("square.hdr"), 8);
    let preferences = folder.path().join("preferences.json");
    (folder, preferences)
}

#[derive(Debug)]
struct File(PathBuf);

impl egui::DroppedFile for File {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|why| why.to_string())
    }
}

fn drop_file(window: &mut Window, path: &Path) {
    window.input_mut().dropped_files = vec![Arc::new(File(path.to_owned()))];
    window.run_steps(2);
}

/// Chooses an entry of View › Theme.
pub(super) fn from_theme(window: &mut Window, entry: &str) {
    open_theme(window);
    act(window, entry);
}

/// Opens View › Theme.
pub(super) fn open_theme(window: &mut Window) {
    act(window, "View");
    window.get_by_label_contains("Theme").scroll_to_me();
    window.run_steps(30);
    window.get_by_label_contains("Theme").click();
    window.run_steps(4);
}

/// Chooses the image at `path` from the menu. False where the desktop has a dialog of its own.
fn choose(window: &mut Window, path: &Path) -> bool {
    from_theme(window, "Environment map…");
    if super::hand::has_file_dialogs() {
        return false;
    }
    assert!(window.query_all_by_label_contains("(.hdr, .png, .jpg, .jpeg)").next().is_some());
    window.get_by_role(Role::TextInput).focus();
    window.run_steps(2);
    window.get_by_role(Role::TextInput).type_text(&path.display().to_string());
    window.run_steps(2);
    act(window, "Read");
    true
}

/// Runs frames until the window says `words`, for at most 20 seconds.
pub(super) fn wait_for_words(window: &mut Window, words: &str) {
    let start = Instant::now();
    while window.query_by_label_contains(words).is_none() {
        assert!(start.elapsed() < Duration::from_secs(20), "{words:?} is not said");
        std::thread::sleep(Duration::from_millis(5));
        window.run_steps(1);
    }
}

/// Drags the slider of the rotation from its left end over about a quarter of its length.
fn rotate(window: &mut Window) {
    let rail = window.get_by_role_and_label(Role::Slider, "Rotation").rect();
    let from = Pos2::new(rail.left() + 6.0, rail.center().y);
    let path: Vec<Pos2> = (0..8).map(|i| from + Vec2::new(3.0 * i as f32, 0.0)).collect();
    drag(window, &path, PointerButton::Primary);
    window.run_steps(4);
}

/// Types the rotation into the field beside its slider.
fn type_rotation(window: &mut Window, degrees: &str) {
    let rail = window.get_by_role_and_label(Role::Slider, "Rotation").rect();
    let fields = window.query_all_by_role(Role::SpinButton).map(|field| field.rect());
    let is_beside =
        |field: &Rect| (field.center().y - rail.center().y).abs() < 6.0 && field.left() > rail.left();
    let field = fields.filter(is_beside).min_by(|a, b| a.left().total_cmp(&b.left())).expect("a field");
    drag(window, &[field.center()], PointerButton::Primary);
    key(window, Modifiers::COMMAND, Key::A);
    window.event(Event::Text(degrees.to_owned()));
    window.run_steps(2);
    key(window, Modifiers::NONE, Key::Enter);
    window.run_steps(4);
}

pub(super) fn keep_preferences(window: &mut Window, path: &Path) {
    edit(window, |app, ctx| app.keep_preferences(ctx, path.to_owned()));
}

pub(super) fn kept(path: &Path) -> serde_json::Value {
    serde_json::from_str(&std::fs::read_to_string(path).expect("kept")).expect("JSON")
}

#[test]
fn an_environment_map_is_chosen_rotated_and_kept_beside_other_lights() {
    let (folder, preferences) = folder();
    let garden = folder.path().join("garden.hdr");
    let mut window = window();
    keep_preferences(&mut window, &preferences);
    from_theme(&mut window, "Evening light");
    assert_eq!(kept(&preferences)["lighting"]["light"], "evening");
    if !choose(&mut window, &garden) {
        return;
    }
    wait(&mut window, "the image", |app| app.environment() == Some((garden.as_path(), 0)));
    assert!(!app(&window).session().is_modified(), "the document has no light");
    from_theme(&mut window, "Rotate environment map");
    window.get_by_label("garden.hdr");
    rotate(&mut window);
    let rotation = app(&window).environment().expect("a light").1;
    assert!((30..150).contains(&rotation), "{rotation}");
    let lighting = &kept(&preferences)["lighting"];
    assert_eq!((&lighting["light"], &lighting["rotation"]), (&"evening".into(), &rotation.into()));
    assert_eq!(lighting["environment"], garden.display().to_string());
    for (typed, kept_as) in [("450", 90), ("-90", 270), ("360", 360)] {
        type_rotation(&mut window, typed);
        assert_eq!(app(&window).environment(), Some((garden.as_path(), kept_as)), "{typed}");
        assert_eq!(kept(&preferences)["lighting"]["rotation"], kept_as, "{typed}");
    }
    rotate(&mut window);
    let rotation = app(&window).environment().expect("a light").1;
    act(&mut window, "Done");
    assert!(window.query_by_role_and_label(Role::Slider, "Rotation").is_none());

    let mut next = super::window();
    keep_preferences(&mut next, &preferences);
    wait(&mut next, "the image", |app| app.environment() == Some((garden.as_path(), rotation)));
    from_theme(&mut next, "Studio light");
    assert_eq!(app(&next).environment(), None);
    let lighting = &kept(&preferences)["lighting"];
    assert_eq!((&lighting["light"], &lighting["is_put_aside"]), (&"studio".into(), &true.into()));
    assert_eq!(lighting["environment"], garden.display().to_string(), "it is kept to go back to");

    // Another start reads it only when it is wanted.
    let mut last = super::window();
    keep_preferences(&mut last, &preferences);
    assert_eq!(app(&last).environment(), None);
    for window in [&mut next, &mut last] {
        from_theme(window, "Light by environment map");
        wait(window, "the image", |app| app.environment() == Some((garden.as_path(), rotation)));
        assert_eq!(kept(&preferences)["lighting"].get("is_put_aside"), None);
        from_theme(window, "Light by environment map");
        assert_eq!(app(window).environment(), None);
        assert_eq!(kept(&preferences)["lighting"]["light"], "studio");
    }
}

#[test]
fn an_image_that_cannot_be_read_leaves_the_light_as_it_is() {
    let (folder, preferences) = folder();
    let [garden, square] = ["garden.hdr", "square.hdr"].map(|name| folder.path().join(name));
    let mut window = window();
    keep_preferences(&mut window, &preferences);
    drop_file(&mut window, &square);
    wait_for_words(
        &mut window,
        "The environment map was not taken: square.hdr could not be read: it has 8 by 8 pixels",
    );
    assert_eq!(app(&window).environment(), None);
    drop_file(&mut window, &garden);
    let lit = Some((garden.as_path(), 0));
    wait(&mut window, "the image", |app| app.environment() == lit);
    let words = folder.path().join("words.hdr");
    std::fs::write(&words, "no image").expect("a file");
    drop_file(&mut window, &words);
    wait_for_words(&mut window, "words.hdr could not be read: it is neither PNG, JPEG nor Radiance HDR");
    let half = folder.path().join("half.hdr");
    let whole = std::fs::read(&garden).expect("the image");
    std::fs::write(&half, &whole[..whole.len() / 2]).expect("a file");
    drop_file(&mut window, &half);
    wait_for_words(&mut window, "half.hdr could not be read: it is damaged: ");
    assert_eq!(app(&window).environment(), lit);
    assert_eq!(kept(&preferences)["lighting"]["environment"], garden.display().to_string());
}

#[test]
fn an_image_that_is_gone_is_told_once_and_is_there_again_when_it_is_back() {
    let (folder, preferences) = folder();
    let gone = folder.path().join("gone.hdr");
    let text = serde_json::json!({
        "theme": "light",
        "lighting": { "light": "evening", "environment": &gone, "rotation": 90 },
    });
    std::fs::write(&preferences, text.to_string()).expect("a file");
    let mut window = window();
    keep_preferences(&mut window, &preferences);
    wait_for_words(&mut window, "gone.hdr could not be read");
    window.run_steps(10);
    assert_eq!(window.query_all_by_label_contains("gone.hdr").count(), 1, "one message");
    assert_eq!(app(&window).environment(), None);
    assert_eq!(kept(&preferences), text, "nothing is lost");
    assert_eq!(window.ctx.theme(), egui::Theme::Light);
    // Another choice keeps it, too.
    from_theme(&mut window, "Dark");
    assert_eq!(kept(&preferences)["lighting"], text["lighting"]);

    write_image(&gone, 16);
    let mut next = super::window();
    keep_preferences(&mut next, &preferences);
    wait(&mut next, "the image", |app| app.environment() == Some((gone.as_path(), 90)));
}

#[test]
fn a_light_that_is_chosen_meanwhile_wins() {
    let (folder, _) = folder();
    let mut window = window();
    drop_file(&mut window, &folder.path().join("garden.hdr"));
    from_theme(&mut window, "Daylight");
    drop_file(&mut window, &folder.path().join("garden.hdr"));
    edit(&mut window, |app, ctx| {
        app.act(ctx, toile::ui::actions::Action::Light(toile::render::Light::Daylight));
    });
    std::thread::sleep(Duration::from_millis(300));
    window.run_steps(4);
    assert_eq!(app(&window).environment(), None);
}

#[test]
fn pictures_of_the_body_are_lit_as_the_pane_is() {
    let Some(device) = egui_wgpu_device() else { return };
    let (folder, _) = folder();
    let mut window = window_on(project(), Some(device));
    let picture = |window: &mut Window| {
        let app = window.state_mut().as_mut().expect("the app");
        let bytes = app.picture_of_body(glam::UVec2::new(320, 200)).expect("a picture");
        let picture = image::load_from_memory(&bytes).expect("a PNG").to_rgb8();
        // The middle of the picture, on the ball.
        let [r, _, b] = picture.get_pixel(160, 100).0.map(i32::from);
        (r - b, picture)
    };
    let (_, plain) = picture(&mut window);
    drop_file(&mut window, &folder.path().join("garden.hdr"));
    wait(&mut window, "the image", |app| app.environment().is_some());
    let (warmth, lit) = picture(&mut window);
    assert!(lit != plain);
    let drawn = app(&window).pictures();
    from_theme(&mut window, "Rotate environment map");
    rotate(&mut window);
    assert!(app(&window).pictures() > drawn, "the pane is drawn again");
    let (rotated, _) = picture(&mut window);
    // The red half, at +x, goes behind the body, and the blue half comes before it.
    let rotation = app(&window).environment().expect("a light").1;
    assert!((30..150).contains(&rotation) && rotated < warmth - 20, "{rotation}: {warmth}, {rotated}");
}
