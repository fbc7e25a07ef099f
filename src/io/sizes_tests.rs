use super::*;

const TABLE: &str = "size,height,Bust,waist (mm),Upper_arm [in]
36, 168, 84, 660, 10.5

\"38, long\",176,88,700,
";

fn why(text: &str) -> String {
    read(text.as_bytes()).expect_err("refused").to_string()
}

#[test]
fn sizes_are_read_in_their_units_and_the_rest_follows() {
    for text in [TABLE.to_owned(), TABLE.replace('\n', "\r\n"), format!("\u{feff}{TABLE},,,,\n")] {
        let sizes = read(text.as_bytes()).expect("a table");
        assert_eq!(sizes.iter().map(|size| size.name.as_str()).collect::<Vec<_>>(), ["36", "38, long"]);
        let Measurements { height, bust, waist, upper_arm, .. } = sizes[0].measurements;
        for (is, was) in [(height, 1.68), (bust, 0.84), (waist, 0.66), (upper_arm, 0.2667)] {
            assert!((is - was).abs() < 1e-12, "{is} {was}");
        }
        let m = sizes[1].measurements;
        let upper_arm = Measurements::completed(|name| (name == "bust").then_some(0.88)).upper_arm;
        assert!((m.waist - 0.7).abs() < 1e-12 && m.upper_arm == upper_arm, "an empty cell is left out");
        assert!(chosen(&sizes, "38, long").is_ok_and(|size| size.checked().is_ok()));
        assert!(chosen(&sizes, "38, LONG").is_ok_and(|size| size.name == "38, long"), "whatever its case");
        let why = chosen(&sizes, "40").expect_err("no such size").to_string();
        assert_eq!(why, "there is no size \"40\" in it; there are 36, 38, long");
    }
    let semicolons = read("Größe;bust;hip cm\nS;88,5;94\n".as_bytes()).expect("a table");
    assert!((semicolons[0].measurements.bust - 0.885).abs() < 1e-12);
    let tabs = read(b"name\tbust\nS\t88.5\n").expect("a table");
    assert_eq!(tabs[0].measurements.bust, semicolons[0].measurements.bust);
}

#[test]
fn every_fault_names_its_row_and_column() {
    for (text, words) in [
        ("", "empty"),
        ("\n \n", "empty"),
        ("size,bust\n", "no size below"),
        ("size\n36\n", "row 1, column 2: there is no measurement; there are height, bust"),
        (
            "size,bust,inseam\n36,84,70\n",
            "row 1, column 3: there is no measurement \"inseam\"; there are height, bust",
        ),
        ("size,bust (furlong)\n36,84\n", "row 1, column 2: \"furlong\" is no unit"),
        ("size,bust\n3\u{7}6,84\n36,85\n", "row 3, column 1: the size 36 is there twice"),
        ("size,bust,BUST mm\n36,84,70\n", "row 1, column 3: the measurement bust is there twice"),
        ("size,bust\n36,84\n\n38,wide\n", "row 4, column 2 (bust): \"wide\" is no length in cm"),
        ("size,bust mm\n36,-840\n", "row 2, column 2 (bust mm): \"-840\" is no length in mm"),
        ("size,bust m\n36,84\n", "is no length in m"),
        ("size,bust\n36,NaN\n", "is no length"),
        (
            "size,bust\n36,88,94\n",
            "row 2, column 3: there is no measurement at the head of this cell, \"94\"",
        ),
        ("size,bust\n,88\n", "row 2, column 1: a size without a name"),
        ("size,bust\n36,88\n36,89\n", "row 3, column 1: the size 36 is there twice"),
    ] {
        let why = why(text);
        assert!(why.contains(words), "{text:?}: {why}");
    }
    assert!(read(b"size,bust\n36,\xff\n").expect_err("no text").to_string().contains("byte 14"));
    let many: String = (0..=MOST_SIZES).map(|i| format!("{i},90\n")).collect();
    assert!(matches!(read(format!("size,bust\n{many}").as_bytes()), Err(SizesError::OverLimit(_))));
}

#[test]
fn a_size_out_of_range_is_refused_with_the_range() {
    let sizes = read(b"size,height,bust\n36,168,84\n60,168,190\n").expect("a table");
    assert!(sizes[0].checked().is_ok());
    let why = sizes[1].checked().expect_err("too wide").to_string();
    assert!(
        why.starts_with("row 3, column 3 (bust): size 60: bust is 190.0 cm; a mannequin can be built with "),
        "{why}"
    );
    let narrow =
        read(b"size,waist\nx,40\n").expect("a table")[0].checked().expect_err("too narrow").to_string();
    assert!(narrow.starts_with("row 2, column 2 (waist): size x: waist is 40.0 cm"), "{narrow}");
    let follows = read(b"size,bust,hip\nx,94,60\n").expect("a table")[0].clone();
    let why = Size { given: Vec::new(), ..follows }.checked().expect_err("too narrow").to_string();
    assert!(why.starts_with("row 2: size x, what follows from its other measurements: "), "{why}");
}

#[test]
fn no_damage_makes_it_panic() {
    for at in 0..TABLE.len() {
        let _ = read(&TABLE.as_bytes()[..at]);
        for byte in [b',', b'"', b'\n', b'0', 0xff] {
            let mut bytes = TABLE.as_bytes().to_vec();
            bytes[at] = byte;
            let _ = read(&bytes);
        }
    }
}
