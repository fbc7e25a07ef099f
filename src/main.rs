//! The program: arguments in, exit code out.

/// Threads take memory and give it back all the time a window is open: see `Cargo.toml`.
#[global_allocator]
static MEMORY: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> std::process::ExitCode {
    toile::cli::main()
}
