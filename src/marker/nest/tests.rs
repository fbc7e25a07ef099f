use proptest::prelude::*;

use super::*;

fn rectangle(width: f64, height: f64) -> Vec<DVec2> {
    [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)].map(DVec2::from).to_vec()
}

fn either_way(outline: &[DVec2]) -> Vec<Vec<DVec2>> {
    vec![outline.to_vec(), outline.iter().map(|p| -*p).collect()]
}

fn effort(seconds: f64) -> Effort {
    Effort { seconds, seed: 1 }
}

/// The layout, after it was checked: all parts on the strip, none nearer to another than the gap, by their sides alone.
fn checked(nesting: &Nesting, seconds: f64) -> Layout {
    let layout = nest(nesting, effort(seconds), &Watch::default()).expect("all parts fit");
    assert_eq!(layout.places.len(), nesting.parts.len());
    let outline = |(&shape, place): (&usize, &Place)| -> Vec<DVec2> {
        nesting.shapes[shape][place.turn].iter().map(|&p| p + place.by).collect()
    };
    let outlines: Vec<Vec<DVec2>> = nesting.parts.iter().zip(&layout.places).map(outline).collect();
    for (i, outline) in outlines.iter().enumerate() {
        let on_strip = |p: &DVec2| {
            (-1e-7..=layout.length + 1e-7).contains(&p.x) && (-1e-7..=nesting.width + 1e-7).contains(&p.y)
        };
        assert!(outline.iter().all(on_strip), "part {i} is beyond the strip");
        for (j, other) in outlines[..i].iter().enumerate() {
            if nesting.gap > 0.0 {
                let apart = check::distance(outline, other);
                assert!(apart >= nesting.gap - 1e-7, "parts {i} and {j} are {apart} apart");
            } else {
                assert!(!check::overlap(outline, other, 1e-6), "parts {i} and {j} overlap");
            }
        }
    }
    layout
}

#[test]
fn squares_lie_in_full_columns() {
    for (count, width, gap) in [(30, 1.5, 0.003), (12, 0.6, 0.0), (7, 0.65, 0.01), (1, 0.2, 0.0)] {
        let shapes = vec![either_way(&rectangle(0.2, 0.2))];
        let layout = checked(&Nesting { width, gap, shapes, parts: vec![0; count] }, 0.2);
        let in_column = ((width + gap + 1e-9) / (0.2 + gap)).floor();
        let columns = (count as f64 / in_column).ceil();
        let exact = columns * (0.2 + gap) - gap;
        assert!((layout.length - exact).abs() < 1e-8, "{count} on {width}: {} for {exact}", layout.length);
    }
}

/// A square that is cut in two again and again: all of it can be covered.
#[test]
fn rectangles_that_fill_a_square_nearly_fill_it_again() {
    for seed in 1..4 {
        let mut random = Random::new(seed);
        let mut sizes = vec![DVec2::ONE];
        while sizes.len() < 12 {
            let area = |i: &usize| sizes[*i].element_product();
            let largest = (0..sizes.len()).max_by(|i, j| area(i).total_cmp(&area(j))).expect("one");
            let size = sizes.swap_remove(largest);
            let share = random.between(0.3, 0.7);
            let along = if size.x > size.y { DVec2::X } else { DVec2::Y };
            sizes.push(size * (DVec2::ONE - along * share));
            sizes.push(size * (DVec2::ONE - along * (1.0 - share)));
        }
        let shapes = sizes.iter().map(|size| vec![rectangle(size.x, size.y)]).collect();
        let nesting = Nesting { width: 1.0, gap: 0.0, shapes, parts: (0..sizes.len()).collect() };
        let layout = checked(&nesting, 2.0);
        assert!(layout.length <= 1.0 / 0.95, "seed {seed}: {:.1} %", 100.0 / layout.length);
    }
}

/// Two right-angled triangles make a rectangle, where one may be turned.
#[test]
fn triangles_are_turned_into_each_other() {
    let triangle = [DVec2::ZERO, DVec2::new(0.4, 0.0), DVec2::new(0.0, 0.3)];
    let turned = Nesting { width: 0.3, gap: 0.0, shapes: vec![either_way(&triangle)], parts: vec![0; 8] };
    let layout = checked(&turned, 0.5);
    assert!(layout.length < 1.6 * 1.01, "{}", layout.length);
    let kept = Nesting { shapes: vec![vec![triangle.to_vec()]], ..turned };
    assert!(checked(&kept, 0.5).places.iter().all(|place| place.turn == 0));
}

/// A part goes into the bay of another, and not into a bay that is too narrow for it and the gap.
#[test]
fn bays_are_used_where_they_are_wide_enough() {
    let horseshoe: Vec<DVec2> =
        [(0.0, 0.0), (0.5, 0.0), (0.5, 0.2), (0.2, 0.2), (0.2, 0.4), (0.5, 0.4), (0.5, 0.6), (0.0, 0.6)]
            .map(DVec2::from)
            .to_vec();
    let nesting = |gap: f64| Nesting {
        width: 0.6,
        gap,
        shapes: vec![vec![horseshoe.clone()], vec![rectangle(0.25, 0.15)]],
        parts: vec![0, 1],
    };
    assert!((checked(&nesting(0.01), 0.1).length - 0.5).abs() < 1e-9, "it is in the bay");
    assert!(checked(&nesting(0.03), 0.1).length > 0.5, "the bay is too narrow");
}

#[test]
fn the_same_seed_gives_the_same_bits_on_any_number_of_threads() {
    let parts: Vec<usize> = (0..12).map(|i| i % 3).collect();
    let shapes = vec![
        either_way(&[(0.0, 0.0), (0.3, 0.05), (0.25, 0.3), (0.1, 0.12)].map(DVec2::from)),
        either_way(&rectangle(0.2, 0.13)),
        either_way(&[(0.0, 0.0), (0.2, 0.0), (0.1, 0.35)].map(DVec2::from)),
    ];
    let nesting = Nesting { width: 0.7, gap: 0.002, shapes, parts };
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| checked(&nesting, 0.3))
    };
    let [one, four] = [on(1), on(4)];
    assert_eq!(one, four);
    assert!(one.length <= one.plain_length);
}

#[test]
fn what_is_too_wide_is_told_with_the_width_it_needs() {
    let shapes = vec![vec![rectangle(0.1, 0.1)], vec![rectangle(0.1, 0.9), rectangle(0.9, 0.8)]];
    let nesting = Nesting { width: 0.7, gap: 0.0, shapes, parts: vec![0, 1] };
    assert_eq!(
        nest(&nesting, effort(0.1), &Watch::default()),
        Err(NoLayout::TooWide { shape: 1, needs: 0.8 })
    );
    let fits = Nesting { width: 0.8, ..nesting };
    assert_eq!(checked(&fits, 0.1).places[1].turn, 1, "in the way in which it fits");
    assert_eq!(
        nest(&Nesting { parts: vec![], ..fits }, effort(0.1), &Watch::default()).map(|layout| layout.length),
        Ok(0.0)
    );
}

#[test]
fn crossing_and_containment_are_seen() {
    let square = rectangle(0.2, 0.2);
    let moved = |by: (f64, f64)| -> Vec<DVec2> { square.iter().map(|p| *p + DVec2::from(by)).collect() };
    assert!((check::distance(&square, &moved((0.25, 0.0))) - 0.05).abs() < 1e-12);
    assert_eq!(check::distance(&square, &moved((0.1, 0.1))), 0.0);
    let inner: Vec<DVec2> = square.iter().map(|p| *p * 0.5 + 0.05).collect();
    assert_eq!(check::distance(&square, &inner), 0.0);
    assert!(check::overlap(&square, &inner, 1e-6) && check::overlap(&square, &square, 1e-6));
    assert!(
        !check::overlap(&square, &moved((0.2, 0.0)), 1e-6)
            && !check::overlap(&square, &moved((0.2, 0.1)), 1e-6)
    );
    let cross =
        [rectangle(0.6, 0.1), rectangle(0.1, 0.6).iter().map(|p| *p + DVec2::new(0.25, -0.25)).collect()];
    assert!(check::overlap(&cross[0], &cross[1], 1e-6), "no corner of either is in the other");
}

/// A star-shaped outline: radii round a middle, so that it does not cross itself.
fn star(radii: &[f64]) -> Vec<DVec2> {
    let turn = std::f64::consts::TAU / radii.len() as f64;
    radii.iter().enumerate().map(|(i, r)| DVec2::from_angle(turn * i as f64 + 0.1) * *r).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn any_outlines_lie_apart(
        stars in prop::collection::vec(prop::collection::vec(0.03_f64..0.2, 3..12), 2..7),
        gap in prop_oneof![Just(0.0), 0.0005_f64..0.02],
    ) {
        let shapes: Vec<_> = stars.iter().map(|radii| either_way(&star(radii))).collect();
        let parts = (0..shapes.len()).flat_map(|i| [i, i]).collect();
        let nesting = Nesting { width: 0.6, gap, shapes, parts };
        let layout = checked(&nesting, 0.05);
        prop_assert!(layout.length <= layout.plain_length + 1e-9);
    }
}
