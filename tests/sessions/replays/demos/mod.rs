//! The demos that come with the program, and what each must show.
//!
//! `TOILE_BLESS=1 cargo test --test sessions replays` plays their scripts anew and writes the recordings.

mod scripts;
mod stage;
mod walks;

use std::fs;
use std::path::{Path, PathBuf};

use toile::session::demos::Demo;
use toile::session::recording::{Recording, machine};
use toile::session::replay::Replay;

fn path(demo: Demo) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("assets/demos/{}.jsonl", demo.file_stem()))
}

/// Plays the script of `demo`, which says itself whether it shows what it should, and holds the recording against it.
fn check(demo: Demo) {
    let mut stage = scripts::play(demo);
    assert_eq!(stage.faults(), [""; 0], "{demo:?} ends badly");
    let played = stage.session.recording();
    if std::env::var_os("TOILE_BLESS").is_some() {
        return fs::write(path(demo), played).expect("written");
    }
    let text = fs::read_to_string(path(demo)).expect("read");
    assert!(text == demo.recording(), "{demo:?}: build again after a blessing");
    let recording = Recording::parse(&text).unwrap_or_else(|e| panic!("{demo:?}: {e}"));
    assert_eq!(recording.project.problem(), None);
    let commands: Vec<_> = recording.commands.iter().map(|(.., command)| command.clone()).collect();
    let again = Recording::parse(&played).expect("a recording");
    if recording.machine != machine() {
        return println!("{demo:?}: made on {}, this is {}: not compared", recording.machine, machine());
    }
    assert_eq!(commands, again.commands.into_iter().map(|(.., command)| command).collect::<Vec<_>>());
    if played == text {
        // To the last hash: playing it once more would show nothing new.
        return;
    }
    let mut replay = Replay::new(recording);
    replay.run().unwrap_or_else(|e| panic!("{demo:?}: {e}"));
    assert!(replay.hashes_compared() > 1);
}

macro_rules! demos {
    ($($name:ident: $demo:ident),+ $(,)?) => {
        $(#[test]
        fn $name() {
            check(Demo::$demo);
        })+
    };
}

demos! {
    a_skirt_is_drafted_sewn_and_draped: Drafting,
    trousers_are_let_out_for_larger_hips: Fitting,
    a_pattern_of_a_file_is_dressed: Drawing,
    a_creature_gets_a_cloak: Creature,
    a_skirt_gets_sizes: Grading,
    cloth_goes_along_to_other_poses: Posing,
    a_jacket_gets_buttons_stitches_and_hems: Finishing,
    a_shirt_gets_two_colourways: Colourways,
    a_dress_is_prepared_for_cutting: Cutting,
    a_skirt_is_made_for_blender: Export,
    the_shirt_is_wrapped_by_its_marks: Wrapping,
    all_of_the_shirt_follows_the_hand_but_for_its_pin: Dragging,
    a_rewrap_moves_only_what_pins_let_it: Rewrapping,
    the_scarf_is_worn_another_way: Rewearing,
    the_laser_marks_front_and_back: Laser,
    one_mark_lays_the_scarf: Scarf,
    only_surface_dragging_turns_the_skirt: Modes,
    two_pins_keep_a_drag_from_going_round: Pins,
}
