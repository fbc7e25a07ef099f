//! Standard error holds what the program has to say, and nothing that libraries mutter.

use crate::program::{Place, adapter_required, ended};

#[test]
fn without_a_display_or_a_folder_for_one_nothing_is_complained_of() {
    let place = Place::with_ball();
    let run = |backend: Option<&str>| {
        let mut command = place.command("render ball.toile -o ball.png --size 64x64");
        command.env_remove("WGPU_BACKEND").envs(backend.map(|name| ("WGPU_BACKEND", name)));
        ended(command.output().expect("started"))
    };
    if run(Some("vulkan")).code == 5 {
        assert!(!adapter_required(), "there is no adapter");
        println!("skipped: without Vulkan, the libraries of OpenGL are tried, and complain");
        return;
    }
    let ended = run(None);
    assert_eq!((ended.code, ended.err.as_str()), (0, ""), "{}", ended.out);
}

#[test]
fn what_is_asked_for_is_all_that_is_on_standard_output() {
    let place = Place::with_ball();
    for task in [
        "dress ball.toile --out out --json",
        "check ball.toile --json",
        "bench trust --readers joints --json",
    ] {
        let ended = place.run(task);
        let parts = serde_json::Deserializer::from_str(&ended.out).into_iter::<serde_json::Value>();
        let parts = parts.collect::<Result<Vec<_>, _>>();
        assert!(parts.is_ok_and(|parts| parts.len() == 1), "{task}: {ended:#?}");
    }
    let ended = place.ends(0, "export ball.toile -o ball.svg");
    assert_eq!(ended.out, "", "{ended:#?}");
}
