//! Keeps libraries of graphics drivers quiet. They look for a display in the folder that XDG_RUNTIME_DIR names, and complain on
//! standard error where it names none (libwayland: "XDG_RUNTIME_DIR is invalid or not set in the environment").

/// Restarts the program in its own process with XDG_RUNTIME_DIR set to a path where nothing is found. If the variable names a
/// folder already, or the system does not allow the restart, the program goes on as it is.
#[cfg(all(unix, not(target_os = "macos")))]
pub fn begin_anew() {
    use std::os::unix::process::CommandExt;
    use std::process::Command;

    const NAME: &str = "XDG_RUNTIME_DIR";
    /// A valid path that cannot be a folder.
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

/// Elsewhere drivers do not look there.
#[cfg(not(all(unix, not(target_os = "macos"))))]
pub fn begin_anew() {}
