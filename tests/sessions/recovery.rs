//! Work that outlives a crash: copies, journals, locks, and saves cut short.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Child, Command as Process, Stdio};
use std::time::Duration;

use glam::DVec2;
use tempfile::tempdir;
use toile::geometry::ids::{MarkId, PieceId};
use toile::pattern::PlanePose;
use toile::pattern::edit::{PatternEdit, PointRef};
use toile::session::recovery::{About, Copying, Found, Keeper, Left, left};
use toile::session::{Command, Document, Project, Session, project_file};
use toile::sim::{Runner, Simulation};
use toile::wrap::ClothSide;

use crate::common::chance::Chance;
use crate::common::{project, run, session};

fn about() -> About {
    About { name: "shirt".to_owned(), path: Some(PathBuf::from("/tmp/shirt.toile")), unsaved: true }
}

/// Copies the session's work, as the window does.
fn copy(keeper: &mut Keeper, s: &mut Session) {
    begin_copy(keeper, s).write(&s.project()).expect("copied");
}

/// Begins a copy that somebody else writes.
fn begin_copy(keeper: &mut Keeper, s: &mut Session) -> Copying {
    let (journal, copying) = keeper.copy(&about()).expect("begun");
    s.mark_copied(Some(journal));
    copying
}

fn random(c: &mut Chance) -> Command {
    let piece = PieceId(1 + c.below(2) as u32);
    let at = |c: &mut Chance| DVec2::new(c.between(0.0, 0.25), c.between(0.0, 0.3));
    match c.below(8) {
        0 => Command::AddClothMark { piece, side: ClothSide::Front, points: vec![at(c), at(c)] },
        1 => Command::DeleteMark { mark: MarkId(1 + c.below(12) as u32) },
        2 => {
            let pose = PlanePose { offset: at(c), ..PlanePose::default() };
            Command::EditPattern {
                edits: vec![PatternEdit::Place { poses: vec![(piece, pose)] }],
                anew: false,
            }
        }
        3..=4 => {
            let points = vec![(PointRef { piece, point: c.below(4) as usize }, at(c) * 2.0)];
            Command::EditPattern { edits: vec![PatternEdit::MovePoints { points }], anew: false }
        }
        5 => Command::RenamePiece { piece, name: format!("piece {}", c.below(100)) },
        6 => Command::Undo,
        _ => Command::Redo,
    }
}

/// What the window makes of work found again: as much of it as can be done again.
fn restored(found: Found) -> Session {
    let mut s = Session::new(found.project, Runner::inline(Simulation::default()));
    let mut open = None;
    for (gesture, command) in found.commands {
        let own = match open {
            Some((of, own)) if of == gesture => own,
            _ => s.begin_gesture(),
        };
        open = Some((gesture, own));
        if s.apply(command, own).is_err() {
            break;
        }
    }
    s
}

/// A process that another test starts has the lock too, from its fork until it runs its own program: that is waited for.
fn only(root: &Path) -> Left {
    for _ in 0..200 {
        let mut all = left(root);
        if let Some(work) = all.pop() {
            assert!(all.is_empty(), "{} more are left", all.len());
            return work;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    panic!("nothing is left")
}

fn same(a: &Document, b: &Document) -> bool {
    serde_json::to_string(a).expect("written") == serde_json::to_string(b).expect("written")
}

#[test]
fn what_was_done_after_the_last_copy_is_done_again() {
    for seed in 1..=6 {
        let root = tempdir().expect("a folder");
        let mut s = session();
        let mut keeper = Keeper::begin(root.path()).expect("begun");
        copy(&mut keeper, &mut s);
        let mut c = Chance(seed);
        let mut copies = 0;
        for i in 0..200 {
            s.apply_alone(random(&mut c)).ok();
            // Steps from before the copy cannot be taken back from the copy alone.
            if s.needs_copy() || i % 70 == 69 {
                copy(&mut keeper, &mut s);
                copies += 1;
            }
            assert!(!s.needs_copy());
        }
        assert!(copies >= 2);
        drop(keeper); // It crashes.
        let work = only(root.path());
        assert_eq!(work.about, about());
        let found = work.read().expect("read");
        assert_eq!(found.lost, 0);
        assert!(same(restored(found).document(), s.document()), "seed {seed}");
        work.forget().expect("gone");
        assert!(left(root.path()).is_empty());
    }
}

#[test]
fn the_dressed_cloth_is_copied_too() {
    let root = tempdir().expect("a folder");
    let mut s = session();
    s.apply_alone(Command::Wrap).expect("wrapped");
    run(&mut s, 2000);
    let mut keeper = Keeper::begin(root.path()).expect("begun");
    copy(&mut keeper, &mut s);
    let lay = s.snapshot().cloth.clone();
    drop(keeper);
    let found = only(root.path()).read().expect("read");
    assert_eq!(found.project.dressed.expect("dressed").cloth, lay);
}

#[test]
fn a_live_session_is_left_alone_and_one_that_ended_well_leaves_nothing() {
    let root = tempdir().expect("a folder");
    let mut s = session();
    let mut keeper = Keeper::begin(root.path()).expect("begun");
    copy(&mut keeper, &mut s);
    assert!(left(root.path()).is_empty(), "its lock is held");
    keeper.finish().expect("gone");
    assert_eq!(fs::read_dir(root.path()).expect("there").count(), 0);
    // One that died before its first copy has nothing to offer.
    drop(Keeper::begin(root.path()).expect("begun"));
    assert!(left(root.path()).is_empty());
}

#[test]
fn a_journal_cut_anywhere_gives_what_came_before() {
    let root = tempdir().expect("a folder");
    let mut s = session();
    let mut keeper = Keeper::begin(root.path()).expect("begun");
    copy(&mut keeper, &mut s);
    let names: Vec<String> = (0..5).map(|i| format!("name {i}")).collect();
    for name in &names {
        s.apply_alone(Command::RenamePiece { piece: PieceId(1), name: name.clone() }).expect("renamed");
    }
    drop((keeper, s));
    let work = only(root.path());
    let journal = work.written().with_file_name("1.journal");
    let whole = fs::read(&journal).expect("read");
    let ends: Vec<usize> = (0..whole.len()).filter(|&i| whole[i] == b'\n').collect();
    for cut in 0..=whole.len() {
        fs::write(&journal, &whole[..cut]).expect("cut");
        let found = work.read().expect("read");
        let complete = ends.iter().filter(|&&end| end <= cut).count();
        assert_eq!(found.commands.len(), complete, "cut at {cut}");
        let at_an_end = cut == 0 || ends.iter().any(|&end| end == cut || end + 1 == cut);
        assert_eq!(found.lost, usize::from(!at_an_end), "cut at {cut}");
    }
    // One flipped bit anywhere: all before its line, and how many lines that are lost.
    for i in 0..whole.len() {
        let mut bytes = whole.clone();
        bytes[i] ^= 1 << (i % 8);
        fs::write(&journal, &bytes).expect("damaged");
        let found = work.read().expect("read");
        let line = ends.iter().filter(|&&end| end < i).count();
        assert!(found.commands.len() >= line && found.commands.len() < 5 && found.lost > 0, "bit at {i}");
        for ((_, command), name) in found.commands.iter().zip(&names) {
            assert_eq!(command, &Command::RenamePiece { piece: PieceId(1), name: name.clone() });
        }
    }
    // One that is there and cannot be read is not one without commands.
    fs::remove_file(&journal).expect("gone");
    fs::create_dir(&journal).expect("a folder in its place");
    let found = work.read().expect("read");
    assert_eq!((found.commands.len(), found.lost), (0, 1));
}

#[test]
fn a_copy_that_was_never_written_is_made_up_for_by_the_journals() {
    let root = tempdir().expect("a folder");
    let mut s = session();
    let mut keeper = Keeper::begin(root.path()).expect("begun");
    copy(&mut keeper, &mut s);
    for name in ["one", "two"] {
        s.apply_alone(Command::RenamePiece { piece: PieceId(1), name: name.to_owned() }).expect("renamed");
        drop(begin_copy(&mut keeper, &mut s));
    }
    s.apply_alone(Command::RenamePiece { piece: PieceId(2), name: "three".to_owned() }).expect("renamed");
    drop(keeper);
    let found = only(root.path()).read().expect("read");
    assert_eq!((found.commands.len(), found.lost), (3, 0));
    assert!(same(restored(found).document(), s.document()));
}

#[test]
fn a_damaged_copy_gives_way_to_the_one_before_and_both_journals() {
    let root = tempdir().expect("a folder");
    let mut s = session();
    let mut keeper = Keeper::begin(root.path()).expect("begun");
    for name in ["one", "two", "three"] {
        copy(&mut keeper, &mut s);
        s.apply_alone(Command::RenamePiece { piece: PieceId(1), name: name.to_owned() }).expect("renamed");
    }
    drop(keeper);
    let work = only(root.path());
    fs::write(work.written().with_file_name("3.toile"), b"{").expect("damaged");
    let found = work.read().expect("read");
    assert_eq!(found.commands.len(), 2, "the first copy and its journal are gone by now");
    assert!(same(restored(found).document(), s.document()));
    fs::write(work.written().with_file_name("2.toile"), b"").expect("damaged");
    work.read().expect_err("nothing can be read");
    drop(work);
    assert_eq!(left(root.path()).len(), 1, "what cannot be read is kept");
}

/// Set for a copy of this test that is to be killed: where it writes.
const VICTIM: &str = "TOILE_TEST_VICTIM";

fn victim(test: &str, folder: &Path) -> Child {
    let program = std::env::current_exe().expect("this test");
    let mut process = Process::new(program);
    process.args(["--exact", test]).env(VICTIM, folder).stdout(Stdio::null()).stderr(Stdio::null());
    process.spawn().expect("started")
}

/// Lets a victim run until it has written something, and a little longer; then kills it.
fn kill(mut child: Child, begun: impl Fn() -> bool, longer: Duration) {
    for _ in 0..2000 {
        if begun() {
            break;
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    assert!(begun(), "the victim never wrote");
    std::thread::sleep(longer);
    child.kill().expect("killed");
    child.wait().expect("dead");
}

fn numbered(number: usize) -> Project {
    let mut project = project();
    let document = &mut project.document;
    let pattern = std::sync::Arc::make_mut(&mut document.pattern);
    for piece in pattern.pieces.values_mut() {
        std::sync::Arc::make_mut(piece).name = format!("piece {number}");
    }
    project
}

#[test]
fn a_save_that_is_killed_leaves_the_old_file_or_the_new_one() {
    if let Some(folder) = std::env::var_os(VICTIM) {
        for i in 0..usize::MAX {
            project_file::save(&Path::new(&folder).join("a.toile"), &numbered(i)).expect("saved");
        }
    }
    let mut c = Chance(3);
    for _ in 0..12 {
        let folder = tempdir().expect("a folder");
        let path = folder.path().join("a.toile");
        let child =
            victim("recovery::a_save_that_is_killed_leaves_the_old_file_or_the_new_one", folder.path());
        kill(child, || path.exists(), Duration::from_micros(c.below(40_000)));
        for file in [path.clone(), folder.path().join("a.toile.bak")] {
            if file.exists() {
                let project = project_file::open(&file).expect("a whole file");
                let names: Vec<&String> = project.document.pattern.pieces.values().map(|p| &p.name).collect();
                assert!(names[0] == names[1] && names[0].starts_with("piece "), "{names:?}");
            }
        }
    }
}

#[test]
fn a_process_that_is_killed_loses_at_most_the_command_it_was_writing() {
    if let Some(folder) = std::env::var_os(VICTIM) {
        let mut keeper = Keeper::begin(Path::new(&folder)).expect("begun");
        let mut s = session();
        copy(&mut keeper, &mut s);
        for i in 1.. {
            let name = i.to_string();
            s.apply_alone(Command::RenamePiece { piece: PieceId(1), name }).expect("renamed");
            fs::write(Path::new(&folder).join("told"), i.to_string()).expect("told");
            if i % 40 == 0 {
                copy(&mut keeper, &mut s);
            }
        }
    }
    for longer in [1, 20, 70, 150] {
        let root = tempdir().expect("a folder");
        let told = root.path().join("told");
        let child = victim(
            "recovery::a_process_that_is_killed_loses_at_most_the_command_it_was_writing",
            root.path(),
        );
        kill(child, || told.exists(), Duration::from_millis(longer));
        let told: usize = fs::read_to_string(told).expect("read").parse().unwrap_or(0);
        let restored = restored(only(root.path()).read().expect("read"));
        let name: usize = restored.document().pattern.pieces[&PieceId(1)].name.parse().expect("a number");
        assert!(name >= told, "{name} of {told}");
    }
}

/// Kills of one run, where `TOILE_KILLS` says no other number: each takes about a second.
const USUAL_KILLS: u64 = 4;

/// The same work for the same seed: what a person might do, wraps and pins among it.
struct Work {
    session: Session,
    chance: Chance,
}

impl Work {
    fn new(seed: u64) -> Self {
        Self { session: session(), chance: Chance(seed) }
    }

    fn go_on(&mut self) {
        let command = match self.chance.below(12) {
            0 => Command::Wrap,
            1 => Command::AddPin { piece: PieceId(1), at: DVec2::new(0.1, 0.1) },
            2 => Command::ClearPins,
            _ => random(&mut self.chance),
        };
        self.session.apply_alone(command).ok();
        run(&mut self.session, 2);
    }
}

/// Killed at any moment, what is found again is the work after some whole number of its commands: all that had been carried out
/// when the last was told, and at most the one after them.
#[test]
fn what_is_found_after_a_kill_is_the_work_up_to_a_whole_command() {
    let seed_of = |number: u64| 100 + number;
    if let Some(folder) = std::env::var_os(VICTIM) {
        let folder = Path::new(&folder);
        let number: u64 = fs::read_to_string(folder.join("seed")).expect("read").parse().expect("a number");
        let mut keeper = Keeper::begin(folder).expect("begun");
        let mut work = Work::new(number);
        copy(&mut keeper, &mut work.session);
        for done in 1.. {
            work.go_on();
            if work.session.needs_copy() || done % 30 == 0 {
                copy(&mut keeper, &mut work.session);
            }
            let told = folder.join("told.new");
            fs::write(&told, done.to_string()).expect("told");
            fs::rename(told, folder.join("told")).expect("told");
        }
    }
    let kills =
        std::env::var("TOILE_KILLS").map_or(USUAL_KILLS, |n| n.parse().expect("TOILE_KILLS is a number"));
    let (mut chance, mut most) = (Chance(29), 0);
    for number in 0..kills {
        let root = tempdir().expect("a folder");
        fs::write(root.path().join("seed"), seed_of(number).to_string()).expect("written");
        let told = root.path().join("told");
        let child =
            victim("recovery::what_is_found_after_a_kill_is_the_work_up_to_a_whole_command", root.path());
        kill(child, || told.exists(), Duration::from_micros(chance.below(400_000)));
        let told: usize = fs::read_to_string(told).expect("read").parse().expect("a number");
        let found = only(root.path()).read().expect("read");
        assert!(found.lost <= 1, "kill {number}: {} lines", found.lost);
        let found = restored(found);
        let mut again = Work::new(seed_of(number));
        (0..told).for_each(|_| again.go_on());
        let is_all = same(found.document(), again.session.document());
        again.go_on();
        let is_one_more = same(found.document(), again.session.document());
        assert!(is_all || is_one_more, "kill {number} after {told} commands: other work is found");
        most = most.max(told);
    }
    println!("{kills} kills, the latest after {most} commands");
}

/// A clock that was set back makes the oldest copy look like the newest.
#[test]
fn which_copy_is_newest_is_told_by_its_number_whatever_the_clock_said() {
    let root = tempdir().expect("a folder");
    let mut s = session();
    let mut keeper = Keeper::begin(root.path()).expect("begun");
    for name in ["one", "two", "three"] {
        s.apply_alone(Command::RenamePiece { piece: PieceId(1), name: name.to_owned() }).expect("renamed");
        copy(&mut keeper, &mut s);
    }
    drop(keeper);
    let folder = only(root.path()).written().parent().expect("a folder").to_owned();
    let day = Duration::from_secs(24 * 60 * 60);
    for (name, back) in
        [("3.toile", 3), ("3.journal", 3), ("about.json", 3), ("2.toile", 1), ("2.journal", 1)]
    {
        let time = std::time::SystemTime::now() - day * back;
        File::options().write(true).open(folder.join(name)).and_then(|f| f.set_modified(time)).expect("set");
    }
    let found = only(root.path()).read().expect("read");
    assert!(found.commands.is_empty() && same(restored(found).document(), s.document()));
}

/// Reading takes nothing away: whoever crashes over it finds the same the next time.
#[test]
fn a_crash_while_work_is_restored_leaves_it_for_the_next_time() {
    let root = tempdir().expect("a folder");
    let mut s = session();
    let mut keeper = Keeper::begin(root.path()).expect("begun");
    copy(&mut keeper, &mut s);
    s.apply_alone(Command::RenamePiece { piece: PieceId(1), name: "kept".to_owned() }).expect("renamed");
    drop(keeper);
    for _ in 0..3 {
        let work = only(root.path());
        let mut again = restored(work.read().expect("read"));
        // The restoring window keeps its own folder, too, and dies before its first copy and after it.
        let mut keeper = Keeper::begin(root.path()).expect("begun");
        again.recorder().journal_to(None);
        assert!(same(again.document(), s.document()));
        drop((keeper.copy(&about()), work));
    }
    assert!(same(restored(only(root.path()).read().expect("read")).document(), s.document()));
}
