//! Runs a session inline until its cloth is at rest.

use std::mem::ManuallyDrop;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use crate::card::CardSlot;
use crate::cli::arguments::CardKind;
use crate::cli::cloth_options::ClothOptions;
use crate::cli::failure::Failure;
use crate::cli::seconds::Seconds;
use crate::cli::{interrupt, output};
use crate::cloth::Fabric;
use crate::geometry::names;
use crate::session::{Command, Dye, Notice, Project, Session};
use crate::sim::{Runner, Simulation, Trying};
use crate::wrap::Phase;

/// Stack of each worker thread, bytes: they also call graphics drivers, which need more than RUST_MIN_STACK may allow.
const STACK: usize = 8 << 20;

/// Starts the worker threads for parallel steps, one per processor or as many as RAYON_NUM_THREADS says.
pub fn start_threads() -> Result<(), Failure> {
    let pool = rayon::ThreadPoolBuilder::new().stack_size(STACK);
    pool.build_global().map_err(|e| Failure::Limit(format!("worker threads cannot be started: {e}")))
}

/// Calls `work` with `threads` worker threads for parallel steps; without a number, one per processor. `work` runs on a worker
/// thread itself: from another thread every parallel loop would be handed over and waited for.
pub fn on_threads(
    threads: Option<usize>,
    work: impl FnOnce() -> Result<(), Failure> + Send,
) -> Result<(), Failure> {
    let Some(threads) = threads else { return rayon::scope(|_| work()) };
    if !(1..=1024).contains(&threads) {
        return Err(Failure::Usage("--threads takes a number from 1 to 1024".to_owned()));
    }
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .stack_size(STACK)
        .build()
        .map_err(|e| Failure::Limit(format!("{threads} threads cannot be started: {e}")))?;
    // Kept to the end of the process: threads that end while it does free what libraries of graphics keep for each thread, as these
    // themselves do then.
    ManuallyDrop::new(pool).install(work)
}

/// A session on `project`, read from `path`, whose simulation runs inline. Fails if the project's cloth cannot be put on its
/// body.
pub fn opened(project: Project, path: &Path) -> Result<Session, Failure> {
    let was_dressed = project.dressed.is_some();
    let mut session = Session::new(project, Runner::inline(Simulation::default()));
    for notice in session.update() {
        if let Notice::Failed { words, .. } = notice {
            return Err(Failure::input(path, words));
        }
    }
    if was_dressed && !session.snapshot().is_dressed() {
        return Err(Failure::input(path, "the cloth in it cannot be put on its body"));
    }
    Ok(session)
}

/// Takes the colourway, fabric, colour, print and images that `options` name.
pub fn choose_cloth(session: &mut Session, options: &ClothOptions) -> Result<(), Failure> {
    let ClothOptions { colourway, fabric, colour, print, art } = options;
    let mut choose = |command| session.apply_alone(command).map_err(|why| Failure::Usage(why.0.into()));
    if let Some(name) = colourway.clone() {
        choose(Command::WearColourway { name })?;
    }
    if fabric.is_some() {
        choose(Command::SetFabric { piece: None, fabric: fabric.as_deref().map(preset) })?;
    }
    if colour.is_some() || print.is_some() {
        let all = session.document().dyes.all;
        let dye = Dye { colour: colour.or(all.colour), print: print.or(all.print), image: all.image };
        session
            .apply_alone(Command::SetDye { piece: None, dye })
            .map_err(|why| Failure::Usage(why.0.into()))?;
    }
    art.choose(session)
}

/// The name of the preset that `typed` is in any case; what is none is left for the session to refuse.
fn preset(typed: &str) -> String {
    let presets = Fabric::presets();
    names::found(presets.iter().map(|fabric| fabric.name.as_str()), typed)
        .map_or_else(|| typed.to_owned(), |i| presets[i].name.clone())
}

/// The simulation of a session that runs inline.
pub fn simulation(session: &mut Session) -> Result<&mut Simulation, Failure> {
    let words = "the simulation does not run inline".to_owned();
    session.runner().simulation().ok_or(Failure::Internal(words))
}

/// The graphics card to drape any cloth on.
///
/// # Errors
/// There is none.
pub fn card(kind: CardKind) -> Result<Arc<CardSlot>, Failure> {
    let slot = CardSlot::new(kind == CardKind::Software, 0);
    slot.look().map_err(|why| Failure::Limit(format!("--card: {why}")))?;
    Ok(Arc::new(slot))
}

/// Runs ticks until nothing moves.
///
/// # Errors
/// A signal, an internal failure, or more than `max_ticks` ticks.
pub fn to_rest(session: &mut Session, max_ticks: u64, seconds: &mut Seconds) -> Result<(), Failure> {
    let simulation = simulation(session)?;
    while !simulation.is_at_rest() {
        interrupt::check()?;
        if simulation.ticks() >= max_ticks {
            let words = format!("the cloth still moves after {max_ticks} ticks (see --max-ticks)");
            return Err(Failure::Limit(words));
        }
        let (phase, result, posing) =
            (simulation.phase(), simulation.result_in_work(), simulation.is_posing());
        let start = Instant::now();
        simulation.tick();
        let took = start.elapsed().as_secs_f64();
        if let Some(number) = result {
            let count = seconds.starts.len().max(number + 1);
            seconds.starts.resize(count, 0.0);
            seconds.starts[number] += took;
        }
        match phase {
            _ if posing => *seconds.repose.get_or_insert_default() += took,
            Some(Phase::Growing) => seconds.grow += took,
            _ => seconds.settle += took,
        }
        seconds.longest_tick = seconds.longest_tick.max(took);
        show_progress(simulation);
    }
    output::progress("");
    for notice in session.update() {
        if let Notice::Failed { words, .. } = notice {
            return Err(Failure::Internal(words.into()));
        }
    }
    Ok(())
}

/// Drapes the cloth that is on the body until it is at rest.
pub fn drape(
    session: &mut Session,
    project: &Path,
    max_ticks: u64,
    seconds: &mut Seconds,
) -> Result<(), Failure> {
    let mut of_drape = Seconds::default();
    session.apply_alone(Command::SetDraping { on: true }).map_err(|why| Failure::input(project, why))?;
    to_rest(session, max_ticks, &mut of_drape)?;
    seconds.drape = Some(of_drape.settle);
    seconds.longest_tick = seconds.longest_tick.max(of_drape.longest_tick);
    match session.snapshot().drape {
        Some(_) => Ok(()),
        None => {
            let words: Vec<&str> = session.snapshot().problems.iter().map(|p| p.words.as_str()).collect();
            Err(Failure::input(project, format!("it was not draped: {}", words.join("; "))))
        }
    }
}

fn show_progress(simulation: &Simulation) {
    let phase = match simulation.phase() {
        _ if simulation.is_posing() => "re-posing",
        Some(Phase::Growing) => "growing",
        _ => "settling",
    };
    if simulation.ticks().is_multiple_of(8) {
        output::progress(&progress_words(simulation.trying(), phase, simulation.progress()));
    }
}

/// How far the work has come: `share` (0..=1) of it, over all starts while they are tried.
fn progress_words(trying: Option<Trying>, phase: &str, share: f64) -> String {
    let percent = (share * 100.0).floor();
    let Some(Trying { start, draped, number }) = trying else { return format!("{phase} {percent:.0} %") };
    let attempt = if number > 1 { format!(", attempt {number}") } else { String::new() };
    let draped = if draped { ", draped" } else { "" };
    format!("dressing {percent:.0} %{attempt}: {start}{draped}, {phase}")
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;
    use std::sync::atomic::{AtomicUsize, Ordering};
    use std::time::Duration;

    use super::*;
    use crate::sim::Start;

    #[test]
    fn progress_is_told_over_all_starts() {
        let trying = |draped, number| Some(Trying { start: Start::Marks, draped, number });
        assert_eq!(progress_words(trying(false, 1), "growing", 0.257), "dressing 25 %: marks, growing");
        let second = progress_words(trying(true, 2), "settling", 0.5);
        assert_eq!(second, "dressing 50 %, attempt 2: marks, draped, settling");
        assert_eq!(progress_words(None, "growing", 1.0), "growing 100 %");
    }

    static ENDED: AtomicUsize = AtomicUsize::new(0);

    struct Counted;

    impl Drop for Counted {
        fn drop(&mut self) {
            ENDED.fetch_add(1, Ordering::SeqCst);
        }
    }

    thread_local! {
        static COUNTED: Cell<Option<Counted>> = const { Cell::new(None) };
    }

    /// Threads that ended while the process did, too, made it end with a fault.
    #[test]
    fn worker_threads_live_to_the_end_of_the_process() {
        let work = || {
            rayon::broadcast(|_| COUNTED.set(Some(Counted)));
            Ok(())
        };
        assert!(on_threads(Some(2), work).is_ok());
        std::thread::sleep(Duration::from_millis(200));
        assert_eq!(ENDED.load(Ordering::SeqCst), 0);
    }
}
