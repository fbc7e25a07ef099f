//! Files damaged at random: `toile bench trust` reads them, and none may be too much for a reader. `TOILE_MUTATIONS` says how
//! many there are for each; with a hundred thousand this is a campaign of an hour.

use serde_json::Value;

use crate::program::Place;

/// For each reader, where nothing else is said.
const USUAL: u64 = 300;

#[test]
fn damaged_files_are_taken_or_refused_in_words_and_in_time() {
    let place = Place::new();
    let count: u64 = match std::env::var("TOILE_MUTATIONS") {
        Ok(count) => count.parse().expect("TOILE_MUTATIONS is a number"),
        Err(_) => USUAL,
    };
    let ended = place.run(&format!("bench trust --mutations {count} --out kept --json"));
    let rows: Vec<Value> =
        ended.out.lines().map(|line| serde_json::from_str(line).expect("a JSON object a line")).collect();
    for row in &rows {
        for bad in ["panics", "slow", "unclear"] {
            let none = row[bad].as_array().is_some_and(Vec::is_empty);
            assert!(none, "{} {}: {} {}", row["reader"], bad, row[bad], ended.err);
        }
        let [files, taken, refused] =
            ["files", "taken", "refused"].map(|n| row[n].as_u64().expect("a number"));
        assert_eq!((files, taken + refused), (count, count), "{row}");
        // Damage that never matters, or that always ends at the first check, tries nothing.
        assert!(count < 100 || (taken > count / 100 && refused > count / 50), "{row}");
        // The program itself has about a hundred.
        assert!(row["memory"].as_u64().is_none_or(|memory| memory < 1024), "{row}");
    }
    assert_eq!(ended.code, 0, "{ended:#?}");
    assert_eq!(rows.len(), 21, "{:?}", rows.iter().map(|row| &row["reader"]).collect::<Vec<_>>());
    assert!(place.names("kept").is_empty());
}

#[test]
fn one_reader_and_one_file_can_be_asked_for() {
    let place = Place::new();
    let row = |arguments: &str| -> Value {
        let out = place.ends(0, &format!("bench trust --readers sizes --json {arguments}")).out;
        let mut row: Value = serde_json::from_str(&out).expect("one row");
        // These are the machine's.
        ["slowest", "memory"].into_iter().for_each(|name| drop(row[name].take()));
        row
    };
    assert_eq!(row("--mutations 40"), row("--mutations 40 --first 1"), "the same files");
    assert_eq!(row("--mutations 1 --first 30")["files"], 1);
    place.ends_with_words(
        2,
        "bench trust --readers sizes,octopus",
        "there is no reader \"octopus\"; there are obj",
    );
    place.ends_with_words(2, "bench speed --mutations 3", "--mutations");
}
