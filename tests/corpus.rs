//! Garments of our own: drawn from a seed, drafted to six bodies, read back from the files they are written to.

use std::collections::BTreeSet;

use serde_json::Value;
use toile::body::NamedPose;
use toile::cloth;
use toile::draft::{Case, Corpus, Design, Form, Kind, SIZES, Shard};
use toile::io::garmentcode;
use toile::pattern::Pattern;

/// Seams whose sides differ by more are gathered, metres.
const ALIKE: f64 = 0.001;
/// No seam is gathered by more.
const MOST_GATHERED: f64 = 2.6;
/// Edge length of cloth, metres.
const EDGE_LENGTH: f64 = 0.02;

fn whole(designs: u32) -> Corpus {
    let poses = vec![NamedPose::A, NamedPose::T];
    Corpus { seed: 7, designs, sizes: SIZES.to_vec(), poses, kinds: Vec::new() }
}

/// Every design once, with its pattern as its file holds it.
fn read_back(designs: u32) -> Vec<(String, Design, Form, Pattern)> {
    let corpus = whole(designs);
    let cases = corpus.cases(Shard::default());
    let case = |case: &Case| {
        let design = corpus.design(case);
        let name = case.name(&design);
        let form = Form::new(&case.size.measurements(), case.pose).expect("there is such a mannequin");
        let written = garmentcode::write(&design.drafted(&form));
        let pattern = garmentcode::read(&written.bytes).unwrap_or_else(|e| panic!("{name}: {e}"));
        (name, design, form, pattern)
    };
    cases[..designs as usize].iter().map(case).collect()
}

/// Labels of the edges of a seam and their lengths, metres.
fn sides(pattern: &Pattern) -> impl Iterator<Item = ([String; 2], [f64; 2])> {
    pattern.seams.values().map(|seam| {
        let of = |k: usize| &pattern.pieces[&seam.sides[k].piece];
        let edge = |k: usize| seam.sides[k].first_edge().edge;
        let label = |k: usize| of(k).outline[edge(k)].label.clone().unwrap_or_default();
        let length = |k: usize| seam.sides[k].length(of(k)).expect("it is there");
        ([label(0), label(1)], [length(0), length(1)])
    })
}

/// Whether the design gathers seams between edges called so.
fn gathers(design: &Value, labels: &[String; 2]) -> bool {
    let has = |name: &str| labels.iter().any(|label| label.starts_with(name));
    let sleeve = &design["top"]["cut"]["sleeve"];
    let shape = &design["bottom"]["skirt"]["shape"];
    let is_full = shape.get("gathered").is_some() || shape.get("levels").is_some();
    has("cuff top")
        || has("cap") && sleeve["puff"].as_f64().is_some_and(|puff| puff > 1.0)
        || has("waist") && is_full
}

#[test]
fn every_kind_is_drawn_and_the_same_seed_gives_the_same_bytes() {
    let kinds: BTreeSet<Kind> = (0..18).map(|k| Design::drawn(3, k, &Kind::ALL).kind).collect();
    assert_eq!(kinds.len(), Kind::ALL.len());
    let form = Form::new(&SIZES[2].measurements(), NamedPose::T).expect("a mannequin");
    for number in 0..18 {
        let bytes = |seed| garmentcode::write(&Design::drawn(seed, number, &Kind::ALL).drafted(&form)).bytes;
        assert!(bytes(3) == bytes(3) && bytes(3) != bytes(4), "{number}");
    }
}

#[test]
fn shards_make_up_the_whole() {
    let corpus = whole(7);
    let name = |case: &Case| case.name(&corpus.design(case));
    let all: Vec<String> = corpus.cases(Shard::default()).iter().map(name).collect();
    assert_eq!(all.len(), 7 * 12);
    assert_eq!(all.iter().collect::<BTreeSet<_>>().len(), 7 * 12);
    let shards = (1..=5).map(|i| format!("{i}/5").parse().expect("a shard"));
    let mut parts: Vec<String> =
        shards.flat_map(|shard| corpus.cases(shard)).map(|case| name(&case)).collect();
    let mut sorted = all.clone();
    parts.sort();
    sorted.sort();
    assert_eq!(parts, sorted);
    for wrong in ["0/4", "5/4", "4", "a/b", "1/0", ""] {
        assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
    }
}

#[test]
fn designs_are_drawn_well() {
    for (name, design, form, pattern) in read_back(72) {
        let (garment, problems) = cloth::build(&pattern, EDGE_LENGTH);
        assert!(problems.is_empty(), "{name}: {problems:?}");
        assert!(garment.triangles.len() > 500, "{name}");
        assert!(pattern.pieces.values().all(|piece| piece.placement.is_some()), "{name}");
        let choices = serde_json::to_value(design).expect("JSON");
        for (labels, [a, b]) in sides(&pattern) {
            let words = format!("{name}: {labels:?} {a:.4} {b:.4}");
            match gathers(&choices, &labels) {
                true => assert!(a.max(b) / a.min(b) < MOST_GATHERED, "{words}"),
                false => assert!((a - b).abs() < ALIKE, "{words}"),
            }
        }
        fits(&name, &form, &pattern);
    }
}

/// Openings are larger than what they lie round.
fn fits(name: &str, form: &Form, pattern: &Pattern) {
    let girth = |label: &str| -> f64 {
        let edges = pattern.pieces.values().flat_map(|piece| {
            (0..piece.outline.len())
                .map(move |i| (piece.outline[i].label.as_deref(), piece.exact_edge_length(i)))
        });
        edges.filter(|(own, _)| own.is_some_and(|own| own.starts_with(label))).map(|(_, length)| length).sum()
    };
    let neck = girth("neck");
    // A neckline of one side, as of raglan fronts, is not all of it: sleeves have the rest under the same name.
    assert!(neck == 0.0 || neck > form.measurements.neck + 0.04, "{name}: neck {neck:.3}");
    let band = girth("band top");
    assert!(band == 0.0 || band > form.measurements.waist + 0.02, "{name}: waistband {band:.3}");
}
