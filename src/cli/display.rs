//! The loss of the display while the window is open. It is told in plain words and is no internal error.
//!
//! The libraries of the window panic then, or return an error, or end the program by themselves: Xlib calls `exit`.

use std::cell::{Cell, RefCell};
use std::panic::{AssertUnwindSafe, PanicHookInfo, catch_unwind, resume_unwind};

use crate::cli::failure::Failure;
use crate::ui;
use address::Address;

/// The display of the window that this thread has open.
struct Shown {
    is_open: Cell<bool>,
    /// Where its server listens, as far as that is known.
    address: RefCell<Option<Address>>,
    /// Whether a panic showed that it is lost.
    is_lost: Cell<bool>,
}

thread_local! {
    static SHOWN: Shown =
        const { Shown { is_open: Cell::new(false), address: RefCell::new(None), is_lost: Cell::new(false) } };
}

impl Shown {
    /// Whether the server no longer answers.
    fn is_gone(&self) -> bool {
        self.is_open.get() && self.address.borrow().as_ref().is_some_and(Address::is_gone)
    }
}

impl Drop for Shown {
    /// At the end of the program, also when a library ends it: a window is still open only then.
    fn drop(&mut self) {
        if self.is_gone() {
            ended_by_library();
        }
    }
}

#[cfg(unix)]
fn ended_by_library() {
    let failure = Failure::Graphics(ui::display_lost());
    crate::cli::interrupt::tell(&failure);
    signal_hook::low_level::exit(i32::from(failure.exit_code()));
}

#[cfg(not(unix))]
fn ended_by_library() {}

/// Does `work`, which opens the window and returns when it is closed.
pub fn watched(work: impl FnOnce() -> anyhow::Result<()>) -> Result<(), Failure> {
    SHOWN.with(|shown| {
        shown.address.replace(Address::of_display());
        shown.is_open.set(true);
        let ended = catch_unwind(AssertUnwindSafe(work));
        let is_lost = !matches!(ended, Ok(Ok(()))) && (shown.is_lost.get() || shown.is_gone());
        shown.is_open.set(false);
        match ended {
            Ok(Ok(())) => Ok(()),
            _ if is_lost => Err(Failure::Graphics(ui::display_lost())),
            Ok(Err(error)) => Err(Failure::Graphics(error.to_string())),
            Err(panic) => resume_unwind(panic),
        }
    })
}

/// Whether `panic` comes of the loss of the display.
pub fn is_lost(panic: &PanicHookInfo) -> bool {
    let file = panic.location().map_or("", |place| place.file());
    let is_told = ui::is_loss_of_display(file, panic.payload_as_str().unwrap_or_default());
    let is_lost = |shown: &Shown| {
        shown.is_lost.set(shown.is_open.get() && (is_told || shown.is_gone()));
        shown.is_lost.get()
    };
    SHOWN.try_with(is_lost).unwrap_or(false)
}

#[cfg(all(unix, not(target_os = "macos")))]
mod address {
    use std::net::{TcpStream, ToSocketAddrs};
    use std::os::unix::net::UnixStream;
    use std::path::{Path, PathBuf};
    use std::time::Duration;

    /// First port of displays that are reached over a network.
    const FIRST_PORT: u16 = 6000;
    /// Longest wait for an answer over a network.
    const PATIENCE: Duration = Duration::from_secs(1);
    /// Number of times that a server is asked, and the time between them: one that ends may lose its windows first.
    const TIMES: u32 = 10;
    const BETWEEN: Duration = Duration::from_millis(50);

    /// Where the server of a display listens.
    #[derive(Clone, Debug, PartialEq)]
    pub enum Address {
        Socket(PathBuf),
        Remote(String, u16),
    }

    impl Address {
        /// That of the display that the environment names, if it answers.
        pub fn of_display() -> Option<Self> {
            let set = |name: &str| std::env::var(name).ok().filter(|value| !value.is_empty());
            let address = match set("WAYLAND_DISPLAY") {
                Some(name) => Self::of_wayland(&name, set("XDG_RUNTIME_DIR")?.as_ref()),
                None => Self::of_x(&set("DISPLAY")?)?,
            };
            Some(address).filter(Self::answers)
        }

        pub fn of_wayland(name: &str, folder: &Path) -> Self {
            Self::Socket(folder.join(name))
        }

        /// That of an X display: ":1", "unix:1.0", "localhost:10.0".
        pub fn of_x(display: &str) -> Option<Self> {
            let (host, number) = display.rsplit_once(':')?;
            let number: u16 = number.split('.').next()?.parse().ok()?;
            match host {
                "" | "unix" => Some(Self::Socket(format!("/tmp/.X11-unix/X{number}").into())),
                host => Some(Self::Remote(host.to_owned(), FIRST_PORT.checked_add(number)?)),
            }
        }

        fn answers(&self) -> bool {
            match self {
                Self::Socket(path) => UnixStream::connect(path).is_ok(),
                Self::Remote(host, port) => {
                    let mut found = (host.as_str(), *port).to_socket_addrs().into_iter().flatten();
                    found.any(|address| TcpStream::connect_timeout(&address, PATIENCE).is_ok())
                }
            }
        }

        /// Whether it does not answer any more.
        pub fn is_gone(&self) -> bool {
            (0..TIMES).any(|i| {
                if i > 0 {
                    std::thread::sleep(BETWEEN);
                }
                !self.answers()
            })
        }
    }
}

/// On other systems the display stays.
#[cfg(not(all(unix, not(target_os = "macos"))))]
mod address {
    pub struct Address;

    impl Address {
        pub fn of_display() -> Option<Self> {
            None
        }

        pub fn is_gone(&self) -> bool {
            false
        }
    }
}

#[cfg(all(test, unix, not(target_os = "macos")))]
mod tests {
    use super::*;

    #[test]
    fn displays_are_found_by_their_names() {
        let local = || Some(Address::Socket("/tmp/.X11-unix/X12".into()));
        assert_eq!([":12", ":12.0", "unix:12"].map(Address::of_x), [local(), local(), local()]);
        let remote = Some(Address::Remote("localhost".to_owned(), 6010));
        assert_eq!(["localhost:10.0", "nothing", ":x"].map(Address::of_x), [remote, None, None]);
        let wayland = Address::of_wayland("/run/user/1/wayland-0", "/elsewhere".as_ref());
        assert_eq!(wayland, Address::Socket("/run/user/1/wayland-0".into()));
    }
}
