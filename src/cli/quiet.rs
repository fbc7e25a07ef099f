//! Libraries of graphics drivers look for a display in the folder that XDG_RUNTIME_DIR names, and complain on standard error where
//! it names none (libwayland: "XDG_RUNTIME_DIR is invalid or not set in the environment").

/// Begins the program anew in its own process, with a folder named in which there is nothing. It goes on as it is where a folder is
/// named, and where the system does not let it.
#[cfg(all(unix, not(target_os = "macos")))]
pub fn begin_anew() {
    use std::os::unix::process::CommandExt;
    use std::process::Command;

    const NAME: &str = "XDG_RUNTIME_DIR";
    /// A path that is one, and can hold no folder.
    const NOWHERE: &str = "/dev/null";
    if std::env::var_os(NAME).is_some_and(|folder| std::path::Path::new(&folder).is_absolute()) {
        return;
    }
    let Ok(program) = std::env::current_exe() else { return };
    let mut arguments = std::env::args_os();
    let mut command = Command::new(program);
    if let Some(name) = arguments.next() {
        command.arg0(name);
    }
    let why = command.args(arguments).env(NAME, NOWHERE).exec();
    tracing::debug!("the program cannot be begun anew: {why}");
}

/// Nothing is looked for there.
#[cfg(not(all(unix, not(target_os = "macos"))))]
pub fn begin_anew() {}
