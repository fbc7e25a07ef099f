//! The graphics adapter of a command: opened once, while the garment is still being dressed.

use std::panic::catch_unwind;
use std::sync::mpsc::{self, Receiver, TryRecvError};
use std::time::Duration;

use crate::cli::arguments::PictureOptions;
use crate::cli::failure::Failure;
use crate::cli::picture::Artist;
use crate::session::Session;

/// A graphics adapter that draws any number of pictures. To open one takes a driver in software about as long as a garment takes to
/// be wrapped, so it is done beside that, by one of the threads that share the work of steps.
#[derive(Default)]
pub struct Graphics(State);

#[derive(Default)]
enum State {
    #[default]
    Closed,
    Opening(Receiver<Result<Artist, Failure>>),
    Open(Box<Artist>),
}

impl Graphics {
    /// Begins to open the adapter, if it is closed.
    pub fn open(&mut self) {
        if matches!(self.0, State::Closed) {
            let (to, from) = mpsc::channel();
            rayon::spawn(move || {
                let opened = catch_unwind(Artist::new).unwrap_or_else(|_| Err(broken()));
                drop(to.send(opened));
            });
            self.0 = State::Opening(from);
        }
    }

    /// Draws `session` as PNG, see [`Artist::png`]. After an error the adapter is closed.
    pub fn png(&mut self, session: &Session, options: &PictureOptions) -> Result<Vec<u8>, Failure> {
        let mut artist = match std::mem::take(&mut self.0) {
            State::Closed => Box::new(Artist::new()?),
            State::Opening(opened) => Box::new(awaited(&opened)?),
            State::Open(artist) => artist,
        };
        let png = artist.png(session, options)?;
        self.0 = State::Open(artist);
        Ok(png)
    }
}

/// The program does not end while a driver is being opened: many do not survive that.
impl Drop for Graphics {
    fn drop(&mut self) {
        if let State::Opening(opened) = std::mem::take(&mut self.0) {
            drop(awaited(&opened));
        }
    }
}

/// Waits for the adapter. Where this is one of the threads that share work, perhaps the only one, it is opened here if need be.
fn awaited(opened: &Receiver<Result<Artist, Failure>>) -> Result<Artist, Failure> {
    loop {
        match opened.try_recv() {
            Ok(artist) => return artist,
            Err(TryRecvError::Disconnected) => return Err(broken()),
            Err(TryRecvError::Empty) => {
                if rayon::yield_now() != Some(rayon::Yield::Executed) {
                    std::thread::sleep(Duration::from_millis(1));
                }
            }
        }
    }
}

fn broken() -> Failure {
    Failure::Graphics("the graphics driver broke off, see above".to_owned())
}
