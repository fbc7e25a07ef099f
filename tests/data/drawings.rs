//! Drawings made by other programs.

use glam::DVec2;
use toile::io::pattern_file::ReadPattern;
use toile::io::pattern_formats;
use toile::io::{Written, dxf, svg};
use toile::pattern::piece::flattened_loop;
use toile::pattern::{Edge, Pattern, Piece};

fn bytes(name: &str) -> Option<Vec<u8>> {
    crate::bytes(&format!("patterns/{name}"))
}

fn read(name: &str) -> Option<ReadPattern> {
    let bytes = bytes(name)?;
    Some(pattern_formats::read(&bytes, None).unwrap_or_else(|e| panic!("{name}: {e}")))
}

/// Width and height of a closed line as it lies on the table, millimetres.
fn size(piece: &Piece, edges: &[Edge]) -> DVec2 {
    let points: Vec<DVec2> =
        flattened_loop(edges, 1e-5).into_iter().map(|p| piece.pose.plane_from_piece(p)).collect();
    let lower = points.iter().copied().reduce(DVec2::min).expect("a line");
    let upper = points.into_iter().reduce(DVec2::max).expect("a line");
    (upper - lower) * 1000.0
}

/// Names, sizes of the seam line and of the cut line (0 where there is none), millimetres.
type Sizes<'a> = &'a [(&'a str, [f64; 2], [f64; 2])];

fn check_sizes(name: &str, sizes: Sizes<'_>) {
    let Some(read) = read(name) else { return };
    let found: Vec<&str> = read.pattern.pieces.values().map(|p| p.name.as_str()).collect();
    let expected: Vec<&str> = sizes.iter().map(|s| s.0).collect();
    assert_eq!(found, expected, "{name}");
    for (piece, (_, seam, cut)) in read.pattern.pieces.values().zip(sizes) {
        let check = |found: DVec2, wanted: [f64; 2], what: &str| {
            let off = (found - DVec2::from_array(wanted)).abs().max_element();
            assert!(off < 0.5, "{name}, {}: {what} {found} mm, not {wanted:?}", piece.name);
        };
        check(size(piece, &piece.outline), *seam, "seam line");
        assert_eq!(piece.cut_line.is_empty(), *cut == [0.0; 2], "{name}, {}", piece.name);
        if !piece.cut_line.is_empty() {
            check(size(piece, &piece.cut_line), *cut, "cut line");
        }
    }
}

/// Out and in again: the same pieces on the same places, lines within a thousandth of a millimetre.
fn check_again(name: &str, write: fn(&Pattern) -> Written) {
    let Some(once) = read(name) else { return };
    let written = write(&once.pattern);
    assert!(written.left_out.is_empty(), "{name}: {:?}", written.left_out);
    let again = pattern_formats::read(&written.bytes, None).unwrap_or_else(|e| panic!("{name} again: {e}"));
    assert_eq!(once.pattern.pieces.len(), again.pattern.pieces.len(), "{name}");
    for (a, b) in once.pattern.pieces.values().zip(again.pattern.pieces.values()) {
        let place = format!("{name}, {}", a.name);
        assert_eq!(a.name, b.name, "{place}");
        check_lines(&place, a, b);
        assert_eq!((a.lines.len(), a.holes.len()), (b.lines.len(), b.holes.len()), "{place}");
        for (l, m) in a.lines.iter().zip(&b.lines) {
            assert!(near(a.pose.plane_from_piece(l.end), b.pose.plane_from_piece(m.end)), "{place}");
        }
        assert_eq!(a.notches.len(), b.notches.len(), "{place}");
        for (m, n) in a.notches.iter().zip(&b.notches) {
            assert!(m.edge == n.edge && (m.at - n.at).abs() < 1e-3, "{place}: {m:?} {n:?}");
        }
        assert_eq!(a.grainline.is_some(), b.grainline.is_some(), "{place}");
        assert!((a.allowance - b.allowance).abs() < 1e-9, "{place}");
    }
}

fn near(p: DVec2, q: DVec2) -> bool {
    p.distance(q) < 1e-6
}

fn check_lines(place: &str, a: &Piece, b: &Piece) {
    for (what, e, f) in [("seam line", &a.outline, &b.outline), ("cut line", &a.cut_line, &b.cut_line)] {
        assert_eq!(e.len(), f.len(), "{place}: edges of its {what}");
        for (i, (m, n)) in e.iter().zip(f).enumerate() {
            let (p, q) = (a.pose.plane_from_piece(m.start), b.pose.plane_from_piece(n.start));
            assert!(near(p, q), "{place}: {what}, edge {i} starts at {p}, then at {q}");
            assert_eq!(m.smooth, n.smooth, "{place}: {what}, edge {i}");
            let [x, y] = [(a, e), (b, f)].map(|(piece, edges): (&Piece, &Vec<Edge>)| {
                let end = edges[(i + 1) % edges.len()].start;
                let shape = edges[i].shape;
                let middle = toile::pattern::curve::points(edges[i].start, shape, end, &[0.5])[0];
                piece.pose.plane_from_piece(middle)
            });
            assert!(near(x, y), "{place}: the middle of edge {i} of its {what} is at {x}, then at {y}");
        }
    }
}

const MALE_SHIRT: Sizes<'_> = &[
    ("PlacketTop", [197.064, 60.0], [221.206, 80.0]),
    ("CuffInterface", [290.0, 60.0], [0.0; 2]),
    ("CollarBaseInterface", [225.232, 43.0], [0.0; 2]),
    ("CollarBase", [225.232, 43.0], [249.124, 63.003]),
    ("Yoke", [256.708, 114.566], [278.488, 137.05]),
    ("Collar", [290.0, 60.0], [310.0, 80.0]),
    ("BackPanel", [347.5, 685.0], [368.058, 705.028]),
    ("PlacketUnder", [152.064, 30.0], [172.064, 50.0]),
    ("PocketFlap", [90.0, 30.0], [110.0, 50.0]),
    ("ShortSleeve", [522.989, 340.019], [546.451, 360.012]),
    ("CollarTop", [199.066, 70.0], [219.066, 101.636]),
    ("CollarTopInterface", [199.066, 80.0], [0.0; 2]),
    ("PocketRound", [90.0, 180.033], [110.0, 200.039]),
    ("Pocket", [90.0, 170.0], [110.0, 190.244]),
    ("FullSleeve", [522.989, 625.498], [546.451, 647.866]),
    ("FrontPanel", [372.5, 744.0], [393.114, 766.88]),
    ("PocketFlapRound", [90.0, 40.009], [110.0, 60.01]),
];
const T_SHIRT: Sizes<'_> = &[
    ("Detail", [130.0, 185.755], [156.113, 225.264]),
    ("Detail 2", [260.0, 600.0], [270.398, 621.784]),
    ("Detail 3", [260.0, 600.0], [270.398, 622.871]),
    ("Detail 4", [358.311, 604.533], [379.055, 624.526]),
    ("Detail 5", [267.858, 17.565], [287.858, 37.565]),
];

#[test]
fn dxf_of_valentina_has_its_sizes() {
    check_sizes("valentina-GPL3/MaleShirt_ASTM.dxf", MALE_SHIRT);
    check_sizes("valentina-GPL3/TShirt_test_ASTM.dxf", T_SHIRT);
    // The AAMA files have the pieces in another order, and names in capitals.
    for (name, sizes) in [("MaleShirt_AAMA", MALE_SHIRT), ("TShirt_test_AAMA", T_SHIRT)] {
        let name = format!("valentina-GPL3/{name}.dxf");
        let Some(read) = read(&name) else { return };
        let mut found: Vec<[i64; 4]> =
            read.pattern.pieces.values().map(|p| tenths(size(p, &p.outline), cut_size(p))).collect();
        let mut wanted: Vec<[i64; 4]> = sizes.iter().map(|s| tenths(s.1.into(), s.2.into())).collect();
        found.sort();
        wanted.sort();
        assert_eq!(found.len(), wanted.len(), "{name}");
        for (f, w) in found.iter().zip(&wanted) {
            assert!(
                f.iter().zip(w).all(|(a, b)| (a - b).abs() <= 4),
                "{name}: {f:?} tenths of mm, not {w:?}"
            );
        }
    }
}

fn cut_size(piece: &Piece) -> DVec2 {
    if piece.cut_line.is_empty() { DVec2::ZERO } else { size(piece, &piece.cut_line) }
}

fn tenths(seam: DVec2, cut: DVec2) -> [i64; 4] {
    [seam.x, seam.y, cut.x, cut.y].map(|mm| (mm * 10.0).round() as i64)
}

#[test]
fn dxf_of_clo_has_its_sizes_in_inches_and_millimetres() {
    let none = [0.0; 2];
    check_sizes("clo-dxf/clo-box.dxf", &[("Pattern2D_4937", [118.2067 * 25.4, 78.83235 * 25.4], none)]);
    check_sizes(
        "clo-dxf/clo-pattern.dxf",
        &[
            ("11", [255.826, 703.217], none),
            ("Pattern2D_768516", [154.81, 16.0], none),
            ("7", [256.437, 729.032], none),
            ("Pattern2D_768527", [186.299, 16.0], none),
            ("36", [408.969, 172.963], none),
            ("37", [255.826, 703.217], none),
            ("Pattern2D_768528", [154.81, 16.0], none),
            ("38", [256.437, 729.032], none),
            ("39", [408.969, 172.963], none),
        ],
    );
    let Some(read) = read("clo-dxf/clo-pattern.dxf") else { return };
    let count = |f: fn(&Piece) -> usize| read.pattern.pieces.values().map(|p| f(p)).sum::<usize>();
    assert_eq!((count(|p| p.notches.len()), count(|p| p.lines.len())), (18, 37));
    assert!(read.pattern.pieces.values().all(|p| p.grainline.is_some()));
}

#[test]
fn dxf_goes_out_and_in_again_unchanged() {
    for name in [
        "valentina-GPL3/MaleShirt_ASTM.dxf",
        "valentina-GPL3/MaleShirt_AAMA.dxf",
        "valentina-GPL3/TShirt_test_ASTM.dxf",
        "valentina-GPL3/TShirt_test_AAMA.dxf",
        "clo-dxf/clo-box.dxf",
        "clo-dxf/clo-pattern.dxf",
    ] {
        check_again(name, dxf::write);
    }
}

/// The SVG beside a DXF holds the same pieces; their names are not in it.
#[test]
fn svg_of_valentina_has_the_sizes_of_its_dxf() {
    for (name, sizes) in [("MaleShirt", MALE_SHIRT), ("TShirt_test", T_SHIRT)] {
        let name = format!("valentina-GPL3/{name}.svg");
        let Some(read) = read(&name) else { return };
        let mut wanted: Vec<(DVec2, DVec2)> = sizes.iter().map(|s| (s.1.into(), s.2.into())).collect();
        for piece in read.pattern.pieces.values() {
            let (seam, cut) = (size(piece, &piece.outline), cut_size(piece));
            let off = |w: &(DVec2, DVec2)| (seam - w.0).abs().max((cut - w.1).abs()).max_element();
            let best = (0..wanted.len()).min_by(|&i, &j| off(&wanted[i]).total_cmp(&off(&wanted[j])));
            let best = wanted.swap_remove(best.expect("no more pieces than in the DXF"));
            assert!(off(&best) < 0.5, "{name}, {}: {seam} {cut} mm, not {best:?}", piece.name);
        }
        assert!(wanted.is_empty(), "{name}: missing {wanted:?}");
    }
}

/// The boxes of the same paths in the JSON beside each SVG.
#[test]
fn svg_of_freesewing_has_its_sizes() {
    let none = [0.0; 2];
    check_sizes(
        "freesewing/brian.svg",
        &[
            ("brian.back", [302.74, 620.0], none),
            ("brian.front", [302.74, 620.0], none),
            ("library.sleeve", [469.69, 640.0], none),
        ],
    );
    check_sizes(
        "freesewing/sandy.svg",
        &[("sandy.skirt", [742.09, 742.09], none), ("sandy.waistband", [896.62, 80.0], none)],
    );
    check_sizes(
        "freesewing/teagan.svg",
        &[
            ("teagan.front", [281.13, 611.27], none),
            ("teagan.back", [281.13, 611.27], none),
            ("teagan.sleeve", [344.63, 207.22], none),
        ],
    );
}

#[test]
fn svg_goes_out_and_in_again_unchanged() {
    for name in [
        "valentina-GPL3/MaleShirt.svg",
        "valentina-GPL3/TShirt_test.svg",
        "valentina-GPL3/MaleShirt_ASTM.dxf",
        "clo-dxf/clo-pattern.dxf",
        "freesewing/brian.svg",
        "freesewing/sandy.svg",
        "freesewing/teagan.svg",
    ] {
        check_again(name, svg::write);
    }
}
