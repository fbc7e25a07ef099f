//! The environment map that lights the body pane: read on a separate thread, rotated in a bar over the pane, and kept in the
//! preferences.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use egui::SliderClamping;

use crate::language::{shown, shown_in};
use crate::render::{ImageLight, Light};
use crate::ui::actions::Action;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::app::App;
use crate::ui::files::{self, name_of};
use crate::ui::language::fields::slider;
use crate::ui::language::{say, tr};
use crate::ui::preferences::lighting::{Lighting, Rotation};

/// Largest width of the file's name in the bar, points.
const NAME_WIDTH: f32 = 160.0;

/// The environment map of the body pane.
#[derive(Debug, Default)]
pub struct EnvironmentMap {
    /// The last image that was read, and its light, not rotated.
    read: Option<(PathBuf, ImageLight)>,
    /// The image that is being read.
    coming: Option<Reading>,
    /// Whether the bar that rotates it is open.
    pub is_rotated: bool,
}

/// An image that is being read.
#[derive(Debug)]
struct Reading {
    path: PathBuf,
    coming: Receiver<Result<ImageLight, String>>,
}

impl EnvironmentMap {
    /// The light of the environment map of `lighting`, rotated; None where there is none or it is not read.
    fn light(&self, lighting: &Lighting) -> Option<ImageLight> {
        let (path, light) = self.read.as_ref()?;
        (lighting.environment_used() == Some(path.as_path()))
            .then(|| light.turned(lighting.rotation.radians()))
    }
}

impl App {
    /// The environment map that lights the body pane, and its rotation in degrees; None while one of the lights does.
    pub fn environment(&self) -> Option<(&Path, u16)> {
        let lighting = &self.preferences.lighting;
        let path = lighting.environment_used().filter(|_| self.shell.sight.environment.is_some())?;
        Some((path, lighting.rotation.degrees()))
    }

    /// Lights the body pane by the preferences.
    pub(in crate::ui) fn light_up(&mut self) {
        let lighting = &self.preferences.lighting;
        let environment = self.shell.environment.light(lighting);
        self.shell.sight.light = lighting.light;
        self.shell.sight.environment = environment;
        self.shell.environment.is_rotated &= environment.is_some();
    }

    /// Lights the body pane by `light` alone. The environment map is put aside, to go back to.
    pub(in crate::ui) fn choose_light(&mut self, ctx: &egui::Context, light: Light) {
        self.shell.environment.coming = None;
        self.prefer(ctx, |p| {
            p.lighting.light = light;
            p.lighting.is_put_aside = p.lighting.environment.is_some();
        });
    }

    /// Puts the environment map aside, or goes back to it.
    pub(in crate::ui) fn toggle_environment(&mut self, ctx: &egui::Context) {
        let is_lit = self.shell.environment.coming.is_some() || self.shell.sight.environment.is_some();
        if is_lit {
            return self.choose_light(ctx, self.preferences.lighting.light);
        }
        self.prefer(ctx, |p| p.lighting.is_put_aside = false);
        if self.shell.sight.environment.is_none() {
            self.read_kept_environment(ctx);
        }
    }

    /// Begins to read the image at `path`, which becomes the environment map. The error means that no thread could be started.
    pub(in crate::ui) fn choose_environment(
        &mut self,
        ctx: &egui::Context,
        path: &Path,
    ) -> Result<(), String> {
        let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        self.messages.tell(say!("Reading {name}…", name = name_of(&path)));
        self.read_environment(ctx, path)
    }

    /// Begins to read the environment map of the preferences, if they have one that is not put aside.
    pub(in crate::ui) fn read_kept_environment(&mut self, ctx: &egui::Context) {
        let Some(path) = self.preferences.lighting.environment_used().map(Path::to_owned) else { return };
        if let Err(words) = self.read_environment(ctx, path) {
            self.messages.error(words);
        }
    }

    fn read_environment(&mut self, ctx: &egui::Context, path: PathBuf) -> Result<(), String> {
        let (send, coming) = channel();
        let (file, table, done) = (path.clone(), shown(), ctx.clone());
        let work = move || {
            // Sending fails if another light was chosen meanwhile.
            send.send(shown_in(table, || files::read_environment(&file))).ok();
            done.request_repaint();
        };
        let thread = std::thread::Builder::new().name("environment map".to_owned()).spawn(work);
        thread.map_err(|why| say!("{name} cannot be opened: {why}", name = name_of(&path), why))?;
        self.shell.environment.coming = Some(Reading { path, coming });
        Ok(())
    }

    /// Lights the body pane by the environment map once it is read. One that cannot be read leaves the light as it is, and stays in
    /// the preferences if it was there: its disk may only be missing today.
    pub(in crate::ui) fn take_environment(&mut self, ctx: &egui::Context) {
        let Some(reading) = self.shell.environment.coming.take() else { return };
        let read = match reading.coming.try_recv() {
            Err(TryRecvError::Empty) => return self.shell.environment.coming = Some(reading),
            Err(TryRecvError::Disconnected) => {
                Err(say!("{name} could not be opened", name = name_of(&reading.path)))
            }
            Ok(read) => read,
        };
        match read {
            Ok(light) => {
                let path = reading.path;
                self.shell.environment.read = Some((path.clone(), light));
                if self.preferences.lighting.environment_used() == Some(path.as_path()) {
                    self.light_up();
                } else {
                    self.prefer(ctx, |p| {
                        (p.lighting.environment, p.lighting.is_put_aside) = (Some(path), false);
                    });
                }
            }
            Err(why) => self.messages.error(say!("The environment map was not taken: {why}", why)),
        }
    }

    /// Draws the bar that rotates the environment map, at the lower edge of the body pane, if it is open.
    pub(in crate::ui) fn rotation_ui(&mut self, ctx: &egui::Context, asks: &mut Asks) {
        if !self.shell.environment.is_rotated {
            return;
        }
        let Some(name) = self.environment().map(|(path, _)| name_of(path)) else { return };
        let mut rotation = self.preferences.lighting.rotation;
        let shown = self.bar_ui(ctx, "environment map", |ui| slider_ui(ui, &name, &mut rotation));
        let Some((slider, closes)) = shown else { return };
        if slider.dragged() && rotation != self.preferences.lighting.rotation {
            // It is kept when the slider is released.
            self.preferences.lighting.rotation = rotation;
            self.light_up();
            ctx.request_repaint();
        } else if slider.drag_stopped() || slider.changed() {
            self.prefer(ctx, |p| p.lighting.rotation = rotation);
            ctx.request_repaint();
        }
        if closes {
            asks.push(Ask::Act(Action::RotateEnvironment));
        }
    }
}

/// Draws the name of the image and the slider.
fn slider_ui(ui: &mut egui::Ui, name: &str, rotation: &mut Rotation) -> egui::Response {
    ui.scope(|ui| {
        ui.set_max_width(NAME_WIDTH);
        ui.add(egui::Label::new(egui::RichText::new(name).weak()).truncate());
    });
    let label = ui.label(tr("Rotation"));
    // The field takes any angle, which is wrapped once it is typed.
    let mut degrees = i32::from(rotation.degrees());
    let slider = slider(&mut degrees, 0..=Rotation::MOST.into()).suffix("°");
    let slider = ui.add(slider.clamping(SliderClamping::Never).update_while_editing(false));
    if slider.changed() {
        *rotation = Rotation::wrapped(degrees);
    }
    slider.labelled_by(label.id)
}
