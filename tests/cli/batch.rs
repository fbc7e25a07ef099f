//! dress with several projects.

use serde_json::Value;

use crate::program::Place;

/// "ball.toile", "sub/ball.toile" with another mesh, and "broken.toile", which is no project.
fn three() -> Place {
    let place = Place::with_ball();
    std::fs::create_dir(place.path("sub")).expect("made");
    let mut project = crate::common::project();
    project.document.settings.edge_length *= 1.5;
    place.save("sub/ball.toile", &project);
    place.write("broken.toile", "{}");
    place
}

fn lines(out: &str) -> Vec<Value> {
    out.lines().map(|line| serde_json::from_str(line).expect("a JSON object a line")).collect()
}

#[test]
fn several_projects_get_a_folder_and_a_line_each() {
    let place = three();
    let done = place.ends(3, "dress ball.toile broken.toile sub/ball.toile --out out");
    let words: Vec<&str> = done.out.lines().collect();
    assert_eq!(words.len(), 3, "{done:#?}");
    assert!(words[0].starts_with("ball: dressed"), "{words:#?}");
    assert!(
        words[2].starts_with("ball-2: ball: dressed"),
        "the folder, too, where that is called otherwise: {words:#?}"
    );
    assert!(words[1].starts_with("broken.toile: failed: broken.toile: "), "{words:#?}");
    assert_eq!(place.names("out"), ["ball", "ball-2"]);
    assert_eq!(place.names("out/ball-2"), ["body.obj", "garment.obj", "report.json"]);
    assert!(!done.err.contains(" of 3"), "standard error is no terminal: {done:#?}");
    assert!(done.err.contains("failed: 1, not dressed: 0; the first of the worst:\n"), "{done:#?}");
}

#[test]
fn a_list_is_read_beside_itself_and_each_verdict_is_an_object() {
    let place = three();
    place.write(
        "sub/list.txt",
        "\u{feff}# two balls\r\n\r\nball.toile\r\n  ../ball.toile  \n# ../broken.toile\n",
    );
    let done = place.ends(0, "dress --list sub/list.txt --out out --json --progress");
    let lines = lines(&done.out);
    assert_eq!(lines.len(), 2, "{done:#?}");
    for (line, folder) in lines.iter().zip(["out/ball", "out/ball-2"]) {
        let report = place.json(&format!("{folder}/report.json"));
        assert_eq!((&line["outcome"], &line["exit_code"]), (&"dressed".into(), &0.into()), "{line}");
        assert_eq!((&line["folder"], &line["resumed"]), (&folder.into(), &false.into()));
        assert_eq!((&line["settled"], &line["seconds"]), (&report["at_rest"], &report["seconds"]["total"]));
        for figure in ["seams", "penetration", "strain", "self_crossings", "faults", "triangles"] {
            assert!(!line[figure].is_null() && line[figure] == report[figure], "{figure}: {line}");
        }
    }
    assert!(lines[0]["triangles"].as_u64() < lines[1]["triangles"].as_u64(), "the one beside the list first");
    assert!(done.err.contains("1 of 2: ball, after 0.0 s\n"), "{done:#?}");
    assert!(done.err.contains("2 of 2: ball-2, after "), "{done:#?}");
}

#[test]
fn the_greatest_exit_code_counts_and_each_says_why() {
    let place = three();
    let done = place.ends(6, "dress broken.toile none.toile ball.toile --out out --json --max-ticks 3");
    let lines = lines(&done.out);
    assert_eq!([0, 1, 2].map(|i| lines[i]["exit_code"].as_u64()), [3, 6, 4].map(Some), "{lines:#?}");
    for (line, words) in lines.iter().zip(["broken.toile: ", "none.toile: ", "after 3 ticks"]) {
        assert_eq!(line["outcome"], "failed");
        assert!(line["error"].as_str().is_some_and(|w| w.contains(words)), "{line}");
    }
    assert!(place.names("out").is_empty(), "what is not whole is not there");
}

#[test]
fn what_was_made_from_the_same_is_left() {
    let place = three();
    let run = |arguments: &str| {
        let done = place.ends(0, &format!("dress ball.toile sub/ball.toile --out out --json {arguments}"));
        [0, 1].map(|i| lines(&done.out)[i]["resumed"] == true)
    };
    assert_eq!(run(""), [false, false]);
    let first = place.json("out/ball/report.json");
    assert_eq!(run("--resume"), [true, true]);
    // Neither the number of threads nor the time of the file matters.
    std::fs::copy(place.path("ball.toile"), place.path("copy")).expect("copied");
    std::fs::rename(place.path("copy"), place.path("ball.toile")).expect("renamed");
    assert_eq!(run("--resume --threads 1"), [true, true]);
    assert_eq!(place.json("out/ball/report.json"), first);
    // Bytes and options do, and so does a report that was never written.
    std::fs::copy(place.path("sub/ball.toile"), place.path("ball.toile")).expect("copied");
    assert_eq!(run("--resume"), [false, true]);
    assert_eq!(run("--resume --max-ticks 5000"), [false, false]);
    std::fs::remove_file(place.path("out/ball/report.json")).expect("removed");
    assert_eq!(run("--resume --max-ticks 5000"), [false, true]);
    place.write("out/ball-2/report.json", "{\"made_from\": ");
    assert_eq!(run("--resume --max-ticks 5000"), [true, false]);
    let done = place.ends(0, "dress ball.toile --out out/ball --max-ticks 5000 --resume");
    assert!(done.out.ends_with(" (done before)\n"), "{done:#?}");
    let printed = place.ends(0, "dress ball.toile --out out/ball --max-ticks 5000 --resume --json").out;
    assert_eq!(printed, place.read("out/ball/report.json"));
}

#[cfg(unix)]
#[test]
fn an_interrupted_batch_leaves_whole_results_and_goes_on() {
    let place = Place::with_ball();
    let mut slow = crate::common::project();
    slow.document.settings.edge_length = 0.002;
    place.save("slow.toile", &slow);
    let arguments = "dress ball.toile slow.toile --out out --resume --json";
    let mut child = place.command(arguments).stdout(std::process::Stdio::piped()).spawn().expect("started");
    // Its first line is out when the first is done.
    let mut out = std::io::BufReader::new(child.stdout.take().expect("piped"));
    let mut line = String::new();
    std::io::BufRead::read_line(&mut out, &mut line).expect("a line");
    let kill = std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(kill.is_ok_and(|s| s.success()));
    assert_eq!(child.wait().expect("ended").code(), Some(130));
    assert_eq!(place.names("out"), ["ball"], "of the second nothing");
    slow.document.settings.edge_length = crate::common::project().document.settings.edge_length;
    place.save("slow.toile", &slow);
    let done = place.ends(0, arguments);
    assert_eq!(lines(&done.out).iter().map(|l| l["resumed"] == true).collect::<Vec<_>>(), [true, false]);
}

#[test]
fn wrong_lists_and_options_are_told() {
    let place = Place::with_ball();
    place.write("empty.txt", "# nothing\n\n");
    place.write("letters.txt", [b'a', b'\n', 0xe4, b'\n']);
    place.ends_with_words(3, "dress --list empty.txt --out out", "names no project");
    place.ends_with_words(3, "dress --list letters.txt --out out", "no UTF-8 at byte 2");
    place.ends_with_words(6, "dress --list none.txt --out out", "none.txt");
    place.ends_with_words(2, "dress --list empty.txt --out out --save p.toile", "one project");
    place.ends_with_words(2, "dress ball.toile --out out --save p.toile --resume", "cannot be used with");
    place.ends_with_words(2, "dress --out out", "PROJECT");
    assert_eq!(place.names(""), ["ball.toile", "empty.txt", "letters.txt"]);
}
