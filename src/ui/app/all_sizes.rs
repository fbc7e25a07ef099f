//! All sizes of the pattern, dressed one after the other on the present body, with their fit side by side.

use std::path::Path;

use egui::{ComboBox, Grid, Id, Modal, RichText, ScrollArea, TextureHandle, TextureOptions};
use glam::UVec2;
use image::RgbaImage;

use crate::fit::{self, BodyIndex, MapKind};
use crate::geometry::words::{Words, words};
use crate::pattern::Problem;
use crate::pattern::grading::graded;
use crate::render::{Camera, Look, View, png};
use crate::session::grading;
use crate::session::size_fit::{self, Ease, SizeFit};
use crate::session::{Command, Document, Notice, Outfit, Project, Session};
use crate::sim::{Runner, StartChoice};
use crate::ui::app::App;
use crate::ui::body_pane::Graphics;
use crate::ui::files::{self, Purpose};
use crate::ui::language::pictures::no_picture;
use crate::ui::language::{number, said, say, signed, tr};
use crate::ui::list::list_ui;
use crate::ui::look::theme::Palette;
use crate::ui::scenery::portrait::worn_scene;
use crate::ui::scenery::scene::Scenery;
use crate::ui::scenery::size_maps::SizeMaps;

/// Ticks a second at most: nobody watches.
const UNSEEN_RATE_HZ: f64 = 1e5;
/// Size of the picture of a size, pixels.
const PICTURE: UVec2 = UVec2::new(360, 620);
/// Width of a picture in the dialog, points.
const SHOWN: f32 = 150.0;
/// Maps to choose from.
const MAPS: [MapKind; 4] = [MapKind::Ease, MapKind::Warp, MapKind::Weft, MapKind::Pressure];

/// The open dialog.
pub struct AllSizes {
    /// The document as it was when the dialog was opened.
    document: Document,
    /// Sizes that are not begun yet, the next one last.
    waiting: Vec<String>,
    /// The size being dressed.
    trial: Option<Trial>,
    /// Sizes that are done, in order.
    done: Vec<SizeFit>,
    /// Those of them that are on the body, each with its number in `done`.
    worn: Vec<(usize, Outfit)>,
    map: MapKind,
    /// Pictures of `worn` with the map in `shown`, in its order.
    pictures: Vec<RgbaImage>,
    textures: Vec<TextureHandle>,
    /// The map and the number of sizes that the pictures show.
    shown: Option<(MapKind, usize)>,
    scenery: Scenery,
}

impl std::fmt::Debug for AllSizes {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "AllSizes({} of {} done)", self.done.len(), self.count())
    }
}

/// A size being dressed in a session of its own.
#[derive(Debug)]
struct Trial {
    session: Session,
    fit: SizeFit,
}

/// The user's answer to the dialog.
#[derive(PartialEq)]
enum Answer {
    None,
    Close,
    Stop,
    Save,
}

impl AllSizes {
    fn new(document: &Document) -> Self {
        Self {
            document: document.clone(),
            waiting: document.pattern.sizes.names.iter().rev().cloned().collect(),
            trial: None,
            done: Vec::new(),
            worn: Vec::new(),
            map: MAPS[0],
            pictures: Vec::new(),
            textures: Vec::new(),
            shown: None,
            scenery: Scenery::default(),
        }
    }

    /// Number of sizes.
    fn count(&self) -> usize {
        self.done.len() + usize::from(self.trial.is_some()) + self.waiting.len()
    }

    /// Begins the next size with `runner`, or takes what became of the present one.
    fn go_on(&mut self, runner: impl FnOnce() -> std::io::Result<Runner>) {
        let Some(mut trial) = self.trial.take() else {
            if let Some(size) = self.waiting.pop() {
                match Trial::begin(&self.document, &size, runner) {
                    Ok(trial) => self.trial = Some(trial),
                    Err(fit) => self.done.push(*fit),
                }
            }
            return;
        };
        if !trial.is_over() {
            self.trial = Some(trial);
            return;
        }
        let outfit = trial.measure();
        self.worn.extend(outfit.map(|outfit| (self.done.len(), outfit)));
        self.done.push(trial.fit);
    }

    /// Draws the pictures anew where sizes were added or another map was chosen. The error is in words.
    fn draw(&mut self, ctx: &egui::Context, graphics: &mut Graphics) -> Result<(), String> {
        let shown = (self.map, self.worn.len());
        if self.shown == Some(shown) {
            return Ok(());
        }
        self.shown = Some(shown);
        let maps = SizeMaps::new(self.map, self.worn.iter().map(|(_, outfit)| outfit));
        self.pictures.clear();
        for (i, (size, outfit)) in self.worn.iter().enumerate() {
            let colours = std::sync::Arc::new(maps.colours(i));
            let scene = worn_scene(&mut self.scenery, outfit, Some(&colours));
            let mut camera = Camera::default();
            camera.look(View::Front);
            camera.frame_points(&scene.points(), PICTURE.x as f32 / PICTURE.y as f32);
            let picture = graphics.photograph(&scene, &camera, &Look::light(), PICTURE);
            let mut picture = picture.map_err(|why| no_picture(&why))?;
            maps.legend(&self.done[*size].size).burn(&mut picture);
            self.pictures.push(picture);
        }
        let texture = |picture: &RgbaImage| {
            let size = [picture.width() as usize, picture.height() as usize];
            let image = egui::ColorImage::from_rgba_unmultiplied(size, picture.as_raw());
            ctx.load_texture("a size", image, TextureOptions::LINEAR)
        };
        self.textures = self.pictures.iter().map(texture).collect();
        Ok(())
    }

    /// All pictures side by side as PNG; None where there are none. The error is in words.
    fn png(&self) -> Result<Option<Vec<u8>>, String> {
        let mut whole = RgbaImage::new(PICTURE.x * self.pictures.len() as u32, PICTURE.y);
        for (i, picture) in self.pictures.iter().enumerate() {
            image::imageops::replace(&mut whole, picture, i64::from(PICTURE.x) * i as i64, 0);
        }
        (!self.pictures.is_empty()).then(|| png(&whole).map_err(|why| no_picture(&why))).transpose()
    }

    fn ui(&mut self, ctx: &egui::Context, palette: &Palette) -> Answer {
        let room = ctx.content_rect().size() - egui::vec2(80.0, 120.0);
        let shown = Modal::new(Id::unique("all sizes")).show(ctx, |ui| {
            ui.set_width((self.count() as f32 * (SHOWN + 16.0) + 150.0).clamp(420.0, room.x.max(420.0)));
            ui.heading(tr("All sizes on this body"));
            ui.add_space(4.0);
            let mut answer = Answer::None;
            ui.horizontal(|ui| answer = self.head_ui(ui, palette));
            ui.add_space(6.0);
            ScrollArea::both().max_height(room.y - 110.0).show(ui, |ui| self.table_ui(ui, palette));
            ui.add_space(8.0);
            ui.horizontal(|ui| {
                let text = RichText::new(tr("Save the table…")).color(palette.on_accent);
                let save =
                    ui.add_enabled(!self.done.is_empty(), egui::Button::new(text).fill(palette.accent));
                if save.on_hover_text(tr("Write it as CSV, with the pictures beside it as PNG")).clicked() {
                    answer = Answer::Save;
                }
                if ui.button(tr("Close")).clicked() {
                    answer = Answer::Close;
                }
            });
            answer
        });
        if shown.should_close() { Answer::Close } else { shown.inner }
    }

    /// Progress, or the result in words; and the choice of the map.
    fn head_ui(&mut self, ui: &mut egui::Ui, palette: &Palette) -> Answer {
        let mut answer = Answer::None;
        match &self.trial {
            Some(trial) => {
                let (done, count) = (self.done.len(), self.count());
                let size = &trial.fit.size;
                ui.label(say!("Dressing {size}: {number} of {count}", size, number = done + 1, count));
                let bar = egui::ProgressBar::new(done as f32 / count as f32).fill(palette.accent);
                ui.add(bar.desired_width(160.0).desired_height(8.0));
                if ui.button(tr("Stop")).on_hover_text(tr("Leave the other sizes out")).clicked() {
                    answer = Answer::Stop;
                }
            }
            None => {
                ui.label(summary(&self.done));
            }
        }
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let combo = ComboBox::from_id_salt("map of sizes").selected_text(tr(self.map.title()));
            let shown = list_ui(ui, combo, |entries| {
                for kind in MAPS {
                    entries.add_value(&mut self.map, kind, tr(kind.title()));
                }
            });
            let label = ui.label(tr("Map"));
            shown.labelled_by(label.id);
        });
        answer
    }

    /// A column for each size: picture, outcome, ease at every girth.
    fn table_ui(&self, ui: &mut egui::Ui, palette: &Palette) {
        let weak = |words: &str| RichText::new(words).color(palette.weak);
        let best = size_fit::best(&self.done).map(|size| &size.size);
        Grid::new("sizes").num_columns(self.done.len() + 1).spacing([16.0, 4.0]).striped(true).show(
            ui,
            |ui| {
                ui.label("");
                for size in &self.done {
                    let name = RichText::new(&size.size).strong();
                    let is_best = self.trial.is_none() && best == Some(&size.size);
                    ui.label(if is_best { name.color(palette.accent) } else { name });
                }
                ui.end_row();
                if !self.textures.is_empty() {
                    ui.label("");
                    for i in 0..self.done.len() {
                        let texture = self.worn.iter().position(|(size, _)| *size == i);
                        let texture = texture.and_then(|at| self.textures.get(at));
                        let shown = egui::vec2(SHOWN, SHOWN * PICTURE.y as f32 / PICTURE.x as f32);
                        match texture {
                            Some(texture) => ui.add(egui::Image::new((texture.id(), shown))),
                            None => ui.allocate_response(shown, egui::Sense::hover()),
                        };
                    }
                    ui.end_row();
                }
                ui.label(weak(tr("Result")));
                for size in &self.done {
                    let (words, ink) = match size.is_clean() {
                        true => (tr("dressed"), ui.visuals().text_color()),
                        false => (tr("not without faults"), palette.error),
                    };
                    let all = size.why.iter().chain(&size.problems).map(said).collect::<Vec<_>>().join("\n");
                    let response = ui.label(RichText::new(words).color(ink));
                    if !all.is_empty() {
                        response.on_hover_text(all);
                    }
                }
                ui.end_row();
                ui.label(weak(tr("Strain p99, %")));
                for size in &self.done {
                    ui.label(size.strain_p99.map_or("–".to_owned(), |p99| number(p99 * 100.0, 1)));
                }
                ui.end_row();
                for name in size_fit::girth_names(&self.done) {
                    ui.label(weak(&say!("Ease at {name}, cm", name = tr(name))));
                    for size in &self.done {
                        let ease = size.ease.iter().find(|ease| ease.name == name).map(Ease::metres);
                        let text = ease.map_or("–".to_owned(), |ease| signed(ease * 100.0, 1));
                        let is_tight = ease.is_some_and(|ease| ease < 0.0);
                        let text = RichText::new(text);
                        ui.label(if is_tight { text.color(palette.error) } else { text });
                    }
                    ui.end_row();
                }
            },
        );
    }
}

/// The result in one or two lines.
fn summary(sizes: &[SizeFit]) -> String {
    let clean = sizes.iter().filter(|size| size.is_clean()).count();
    let dressed = say!("{clean} of {count} sizes are dressed without a fault", clean, count = sizes.len());
    let best = size_fit::best(sizes).and_then(|size| Some((&size.size, size.tightest()?)));
    let Some((size, (ease, girth))) = best else { return dressed };
    let best = say!(
        "{size} fits this body best: its least ease is {ease} cm, at the {girth}",
        size,
        ease = signed(ease * 100.0, 1),
        girth = tr(girth)
    );
    format!("{dressed}\n{best}")
}

impl Trial {
    /// Begins to dress `document` in `size`. The error is the size with the reason why it cannot be dressed.
    fn begin(
        document: &Document,
        size: &str,
        runner: impl FnOnce() -> std::io::Result<Runner>,
    ) -> Result<Self, Box<SizeFit>> {
        let refused = |why| Box::new(SizeFit::refused(size, why));
        let graded = graded(&document.pattern, size).map_err(refused)?;
        let mut fit = SizeFit::cut(&document.pattern, size, &graded);
        let mut document = document.clone();
        grading::take(&mut document, graded);
        let begun = runner().map_err(|why| Words::plain(why.to_string())).and_then(|runner| {
            let mut session = Session::new(Project { document, dressed: None }, runner);
            let dress = Command::Dress { choice: StartChoice::default() };
            session.apply_alone(dress).map_err(|why| why.0)?;
            Ok(session)
        });
        match begun {
            Ok(session) => Ok(Self { session, fit }),
            Err(why) => {
                fit.why = Some(why);
                Err(Box::new(fit))
            }
        }
    }

    /// Takes news of the simulation; whether the size is dressed or cannot be.
    fn is_over(&mut self) -> bool {
        for notice in self.session.update() {
            if let Notice::Failed { words, .. } = notice {
                self.fit.why = Some(words);
                return true;
            }
        }
        let snapshot = self.session.snapshot();
        let has_ended = snapshot.started.is_some() || !snapshot.working;
        self.session.is_caught_up() && snapshot.trying.is_none() && has_ended
    }

    /// Fills in the figures; gives the dressed garment.
    fn measure(&mut self) -> Option<Outfit> {
        let snapshot = self.session.snapshot();
        let document = self.session.document();
        let outfit = Outfit::of(snapshot, &document.fabrics);
        if let Some(outfit) = &outfit {
            let faults = snapshot.started.iter().flat_map(|started| &started.taken().faults).cloned();
            let why: Vec<Words> = self.fit.why.take().into_iter().chain(faults).collect();
            let index = BodyIndex::new(&outfit.body);
            let report = fit::measure(&outfit.source.pattern, &outfit.garment, &outfit.state, &index);
            let why = (!why.is_empty()).then(|| Words::joined(why, "; "));
            self.fit.take(outfit.garment.triangles.len(), report.strain.p99, why);
            self.fit.ease = Ease::of(&document.body, outfit);
        } else if self.fit.why.is_none() {
            let why = Words::joined(snapshot.problems.iter().map(Problem::in_words), "; ");
            self.fit.why = Some(words!("no cloth could be put on the body: {why}", why));
        }
        outfit
    }
}

impl App {
    /// Opens the dialog and begins with the first size.
    pub(in crate::ui) fn dress_all_sizes(&mut self) {
        self.shell.all_sizes = Some(AllSizes::new(self.session.document()));
    }

    /// Draws the dialog and goes on dressing.
    pub(in crate::ui) fn all_sizes_ui(&mut self, ctx: &egui::Context, palette: &Palette) {
        let Some(mut sizes) = self.shell.all_sizes.take() else { return };
        let wakeup = self.wakeup.clone();
        sizes.go_on(|| super::runner(&wakeup, UNSEEN_RATE_HZ));
        if let Some(graphics) = &mut self.scene_pane.graphics
            && let Err(why) = sizes.draw(ctx, graphics)
        {
            self.messages.error(why);
        }
        if sizes.trial.is_none() && !sizes.waiting.is_empty() {
            ctx.request_repaint();
        }
        match sizes.ui(ctx, palette) {
            Answer::Close => return,
            Answer::Save => self.ask_file(Purpose::AllSizes),
            Answer::Stop => (sizes.trial, sizes.waiting) = (None, Vec::new()),
            Answer::None => {}
        }
        self.shell.all_sizes = Some(sizes);
    }

    /// Writes the table of all sizes to `path`, and the pictures beside it. The error is a message.
    pub(in crate::ui) fn write_all_sizes(&mut self, path: &Path) -> Result<(), String> {
        let Some(sizes) = &self.shell.all_sizes else { return Ok(()) };
        if let Some(picture) = sizes.png()? {
            files::write(&path.with_extension("png"), &picture)?;
        }
        files::write(path, size_fit::csv(&sizes.done).as_bytes())?;
        self.wrote(path);
        Ok(())
    }
}
