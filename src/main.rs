//! The program: command-line arguments in, exit code out.

/// Memory allocator. glibc's fragments memory where many threads allocate and free all the time, as while a window is open: see
/// `Cargo.toml`.
#[cfg(not(target_os = "macos"))]
#[global_allocator]
static MEMORY: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> std::process::ExitCode {
    toile::cli::main()
}
