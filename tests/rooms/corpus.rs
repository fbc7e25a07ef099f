//! Garments of our own: drawn from a seed, drafted to bodies of six sizes, sound as patterns.

use std::collections::{BTreeMap, BTreeSet};

use toile::body::NamedPose;
use toile::cloth;
use toile::draft::{Case, Corpus, Design, Form, Kind, SIZES, Shard};
use toile::io::garmentcode;
use toile::pattern::edit::twists;
use toile::pattern::{CutPattern, Pattern};

/// Sides of a seam that are not gathered are as long as each other to this, metres.
const SEWN: f64 = 1e-3;
/// Gathers are at most so much longer.
const GATHERED: f64 = 2.0;

fn corpus() -> Corpus {
    let poses = vec![NamedPose::A, NamedPose::T];
    Corpus { seed: 1, designs: 500, sizes: SIZES.to_vec(), poses, kinds: Vec::new() }
}

fn shard(text: &str) -> Shard {
    text.parse().expect(text)
}

/// The bodies with their arms half up.
fn forms() -> Vec<Form> {
    SIZES.map(|size| Form::new(&size.measurements(), NamedPose::A).expect(size.name)).into()
}

fn read_back(pattern: &Pattern) -> Pattern {
    let written = garmentcode::write(pattern);
    assert!(written.left_out.is_empty(), "{:?}", written.left_out);
    garmentcode::read(&written.bytes).expect("a pattern")
}

/// Fails where a drafted pattern is not sound.
fn check(name: &str, design: &Design, drafted: &Pattern, edge_length: Option<f64>) {
    let pattern = read_back(drafted);
    let problems = match edge_length {
        Some(edge_length) => cloth::build(&pattern, edge_length).1,
        None => CutPattern::new(&pattern).1,
    };
    let bad: Vec<_> = problems.iter().filter(|p| !p.kind.is_note()).collect();
    assert!(bad.is_empty(), "{name}: {bad:#?}\n{design:#?}");
    assert_eq!(twists(&pattern).seams, [], "{name}");
    let may_gather = may_gather(design);
    for seam in pattern.seams.values() {
        let sides = seam.sides.map(|side| {
            let piece = &pattern.pieces[&side.piece];
            let edge = &piece.outline[side.edge];
            (format!("{} of {}", edge.label.as_deref().unwrap_or("?"), piece.name), side.length(piece))
        });
        let [(one, Some(a)), (other, Some(b))] = sides else { panic!("{name}: a seam to nothing") };
        let gather = a.max(b) / a.min(b);
        let is_even = (a - b).abs() < SEWN;
        assert!(is_even || may_gather && gather < GATHERED, "{name}: {one} {a:.4} m, {other} {b:.4} m");
    }
}

/// Whether the cut asks for a gather anywhere.
fn may_gather(design: &Design) -> bool {
    let text = serde_json::to_string(design).expect("JSON");
    let is_puffed = text.contains("\"puff\":") && !text.contains("\"puff\":1.0");
    is_puffed
        || ["gathered", "levels"].iter().any(|shape| text.contains(&format!("\"{shape}\":")))
        || text.contains("\"cuff\":0")
}

#[test]
fn five_hundred_designs_are_sound_on_every_body() {
    let (corpus, forms) = (corpus(), forms());
    let mut kinds: BTreeMap<Kind, u32> = BTreeMap::new();
    for number in 0..corpus.designs {
        let size = number as usize % SIZES.len();
        let case = Case { number, size: SIZES[size], pose: NamedPose::A };
        let design = corpus.design(&case);
        *kinds.entry(design.kind).or_default() += 1;
        for (other, form) in forms.iter().enumerate() {
            let name = Case { size: SIZES[other], ..case }.name(&design);
            // On one body with triangles as `toile check` makes them.
            let edge_length = (other == size).then_some(0.03);
            check(&name, &design, &design.drafted(form), edge_length);
        }
    }
    assert_eq!(kinds.len(), Kind::ALL.len());
    assert!(kinds.values().all(|&count| count > 20), "{kinds:?}");
}

#[test]
fn designs_differ_and_the_same_seed_gives_the_same_bytes() {
    let form = &forms()[2];
    let bytes = |seed: u64, number: u32| {
        garmentcode::write(&Design::drawn(seed, number, &Kind::ALL).drafted(form)).bytes
    };
    let all: BTreeSet<Vec<u8>> = (0..500).map(|number| bytes(1, number)).collect();
    assert_eq!(all.len(), 500, "distinct designs");
    for number in 0..18 {
        assert_eq!(bytes(7, number), bytes(7, number));
        assert_ne!(bytes(7, number), bytes(8, number));
    }
}

#[test]
fn shards_make_up_the_whole() {
    let corpus = corpus();
    let named = |case: &Case| (case.number, case.size.name, case.pose.name());
    let whole: BTreeSet<_> = corpus.cases(shard("1/1")).iter().map(named).collect();
    assert_eq!(whole.len(), 500 * 6 * 2);
    let parts: Vec<Vec<Case>> = (1..=7).map(|i| corpus.cases(shard(&format!("{i}/7")))).collect();
    assert_eq!(parts.iter().map(Vec::len).sum::<usize>(), whole.len());
    assert_eq!(parts.iter().flatten().map(named).collect::<BTreeSet<_>>(), whole);
    for bad in ["0/3", "4/3", "1", "a/b", "1/0"] {
        assert!(bad.parse::<Shard>().is_err(), "{bad}");
    }
}

#[test]
fn a_small_shard_has_every_kind_size_and_pose() {
    let corpus = corpus();
    let cases = corpus.cases(shard("3/60"));
    let kinds: BTreeSet<Kind> = cases.iter().map(|case| corpus.design(case).kind).collect();
    let bodies: BTreeSet<_> = cases.iter().map(|case| (case.size.name, case.pose.name())).collect();
    assert_eq!((cases.len(), kinds.len(), bodies.len()), (100, 18, 12));
}

/// Whether an edge is `label` or, on a side of the body, "label left".
fn is_called(own: &str, label: &str) -> bool {
    own.strip_prefix(label).is_some_and(|rest| rest.is_empty() || rest.starts_with(' '))
}

#[test]
fn garments_have_ease() {
    for (form, size) in forms().iter().zip(SIZES) {
        let m = size.measurements();
        for number in 0..90 {
            let design = Design::drawn(3, number, &Kind::ALL);
            let pattern = design.drafted(form);
            let length = |label: &str| -> f64 {
                let edges = pattern.pieces.values().flat_map(|piece| {
                    let own =
                        |i: &usize| piece.outline[*i].label.as_deref().is_some_and(|l| is_called(l, label));
                    (0..piece.outline.len()).filter(own).map(|i| piece.exact_edge_length(i))
                });
                edges.sum()
            };
            let name = format!("{number} {} {}", design.kind.name(), size.name);
            let band = length("band seam");
            assert!(band == 0.0 || (0.02..0.06).contains(&(band - m.waist)), "{name}: band {band}");
            let neck = length("neck");
            let is_open = design.kind == Kind::OneShoulder;
            assert!(neck == 0.0 || is_open || neck > m.neck + 0.03, "{name}: neck {neck}");
            let collar = length("collar edge");
            assert!(collar == 0.0 || collar > m.neck + 0.02, "{name}: collar {collar}");
        }
    }
}

#[test]
fn pieces_stand_round_the_body_and_arms_decide_about_sleeves() {
    let size = SIZES[2].measurements();
    let [half_up, level] = [NamedPose::A, NamedPose::T].map(|pose| Form::new(&size, pose).expect("a form"));
    assert!(half_up.arm.fall() > 0.5 && level.arm.fall().abs() < 0.1);
    let design = Design::drawn(1, 0, &[Kind::Shirt]);
    for form in [half_up, level] {
        let pattern = design.drafted(&form);
        for piece in pattern.pieces.values() {
            let pose = piece.placement.expect("placed");
            let is_front = piece.name.contains("front");
            assert_eq!(pose.translation.z > 0.0, is_front, "{}", piece.name);
            // Their outer sides look away from the body.
            assert_eq!(piece.signed_area() > 0.0, is_front, "{}", piece.name);
            let turned = (pose.rotation * glam::DVec3::X).y.abs() > 0.4;
            assert_eq!(turned, piece.name.starts_with("sleeve") && form.arm.fall() > 0.5, "{}", piece.name);
        }
        assert_eq!(twists(&read_back(&pattern)).seams, []);
    }
}

#[test]
fn skirts_that_would_give_at_the_waist_have_a_waistband() {
    for number in 0..60 {
        for kind in [Kind::CircleSkirt, Kind::GatheredSkirt, Kind::LevelSkirt] {
            let design = Design::drawn(1, number, &[kind]);
            assert!(design.waist.band.is_some_and(|height| height >= 0.03), "{number} {}", kind.name());
        }
    }
    let is_free = |number| Design::drawn(1, number, &[Kind::StraightSkirt]).waist.band.is_none();
    assert!((0..60).any(is_free), "others may have none");
}
