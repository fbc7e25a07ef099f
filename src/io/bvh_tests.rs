use super::*;

const ARM: &str = "HIERARCHY
ROOT Hips
{
  OFFSET 0 90 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT LeftArm {
    OFFSET 20.5 40 -1e0
    CHANNELS 3 Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 30 0 0
    }
  }
}
MOTION
Frames: 2
Frame Time: 0.04
0 90 0 0 0 0 90 0 0
1 91 2 0 0 45 0 0 -10
";

#[test]
fn joints_channels_and_frames_are_read() {
    for text in
        [ARM.to_owned(), ARM.replace('\n', "\r\n"), ARM.replace('\n', "\r"), format!("\u{feff}{ARM}\n\n")]
    {
        let clip = read(text.as_bytes()).expect("a motion");
        assert_eq!((clip.channels(), clip.frames(), clip.seconds_per_frame), (9, 2, 0.04));
        let arm = &clip.joints[1];
        assert_eq!(
            (arm.name.as_str(), arm.parent, arm.offset),
            ("LeftArm", Some(0), DVec3::new(20.5, 40.0, -1.0))
        );
        assert_eq!(arm.channels, [2, 0, 1].map(Channel::Rotation));
        assert_eq!(arm.ends, [DVec3::X * 30.0]);
        assert_eq!(clip.values[9..12], [1.0, 91.0, 2.0]);
    }
}

#[test]
fn every_fault_names_its_line() {
    for (from, to, line, words) in [
        ("HIERARCHY", "OCTOPUS", 1, "HIERARCHY"),
        ("ROOT Hips", "JOINT Hips", 2, "ROOT"),
        ("ROOT Hips\n{", "ROOT Hips", 3, "{"),
        ("OFFSET 0 90 0", "OFFSET 0 90", 4, "three numbers"),
        ("OFFSET 0 90 0", "OFFSET 0 ninety 0", 4, "\"ninety\""),
        ("OFFSET 0 90 0", "OFFSET 0 NaN 0", 4, "out of range"),
        ("CHANNELS 3", "CHANNELS 2", 8, "announced"),
        ("CHANNELS 3 Zrotation", "CHANNELS 3 Wrotation", 8, "no channel"),
        ("3 Zrotation Xrotation", "3 Zrotation Zrotation", 8, "twice"),
        ("End Site", "Tail", 9, "End Site"),
        ("MOTION", "ROOT Other", 15, "second ROOT"),
        ("Frames: 2", "Frames: two", 16, "no number"),
        ("Frames: 2", "Frames: 0", 16, "one frame"),
        ("Frames: 2", "Frames: 3", 19, "ends here"),
        ("Frames: 2", "Frames: 1", 19, "still"),
        ("Frame Time: 0.04", "Frame Time: 0", 17, "seconds"),
        ("90 0 0\n1", "90 0\n1", 18, "this one 8"),
        ("90 0 0\n1", "90 0 0 0\n1", 18, "this one more"),
        ("-10\n", "left\n", 19, "\"left\""),
    ] {
        let text = ARM.replacen(from, to, 1);
        assert_ne!(text, ARM, "{from}");
        match read(text.as_bytes()) {
            Err(BvhError::Line { line: found, words: why }) => {
                assert!(found == line && why.contains(words), "{from} -> {to}: line {found}: {why}");
            }
            other => panic!("{from} -> {to}: {other:?}"),
        }
    }
    assert!(matches!(
        read(ARM.replace("Frames: 2", "Frames: 9000000").as_bytes()),
        Err(BvhError::OverLimit(_))
    ));
    let deep = format!("HIERARCHY\nROOT a\n{{\n{}", "JOINT b\n{\n".repeat(500));
    assert!(matches!(read(deep.as_bytes()), Err(BvhError::OverLimit(_))));
    assert!(read(b"").is_err() && read(&[0xff, 0xfe, 0x00]).is_err());
}

/// Cut and changed at any place it is read or refused.
#[test]
fn no_damage_makes_it_panic() {
    for at in 0..ARM.len() {
        let _ = read(&ARM.as_bytes()[..at]);
        for byte in [b'0', b' ', b'\n', b'}', b'-', 0xff] {
            let mut bytes = ARM.as_bytes().to_vec();
            bytes[at] = byte;
            let _ = read(&bytes);
        }
    }
}
