//! Recordings that come with the program: the figures of paper A, made with the program's own samples.

/// A demo: a recording that comes with the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Demo {
    /// Figure 1: marks on cloth and body, and the wrap.
    Wrapping,
    /// Figure 2: one point dragged, and the whole cloth dragged along the skin as far as a pin lets it.
    Dragging,
    /// Figure 4, left: pins limit what a rewrap moves.
    Rewrapping,
    /// Figure 4, right: another way of wearing the same cloth.
    Rewearing,
    /// Figure 5, left: marks through front and back at once.
    Laser,
    /// Figure 5, right: a scarf.
    Scarf,
    /// Figure 7: three ways to drag, from the same start.
    Modes,
    /// Figure 8: drags along the skin, the last between two pins.
    Pins,
}

impl Demo {
    /// All of them, in the order of the menu.
    pub const ALL: [Self; 8] = [
        Self::Wrapping,
        Self::Dragging,
        Self::Rewrapping,
        Self::Rewearing,
        Self::Laser,
        Self::Scarf,
        Self::Modes,
        Self::Pins,
    ];

    /// Name for the user.
    pub fn name(self) -> &'static str {
        match self {
            Self::Wrapping => "Wrapping by marks",
            Self::Dragging => "A point, or all of it",
            Self::Rewrapping => "Rewrapping within pins",
            Self::Rewearing => "Worn another way",
            Self::Laser => "Laser paint",
            Self::Scarf => "A scarf by one mark",
            Self::Modes => "Three ways to drag",
            Self::Pins => "Dragging between pins",
        }
    }

    /// Number of the paper's figure that shows the same.
    pub fn figure(self) -> &'static str {
        match self {
            Self::Wrapping => "1",
            Self::Dragging => "2",
            Self::Rewrapping | Self::Rewearing => "4",
            Self::Laser | Self::Scarf => "5",
            Self::Modes => "7",
            Self::Pins => "8",
        }
    }

    /// Caption, a sentence or two.
    pub fn tells(self) -> &'static str {
        match self {
            Self::Wrapping => {
                "Marks are painted in pairs, one on a piece and one on the body. Wrap grows the shirt round the body so that they meet."
            }
            Self::Dragging => {
                "One point dragged only stretches the dress there. Dragged along the skin all of the skirt goes round; the pin on the shoulder keeps the drag from going on."
            }
            Self::Rewrapping => {
                "A new pair of marks lays one half of the scarf along the arm. The pins at the neck keep the other half where it is."
            }
            Self::Rewearing => {
                "The scarf is taken off the neck and worn as a sash over one shoulder: one new mark, and Rewrap."
            }
            Self::Laser => {
                "With the laser one stroke marks the front piece and the back piece below it, and another both sides of the body."
            }
            Self::Scarf => "One long mark says where the whole scarf lies.",
            Self::Modes => {
                "The same hand on the same skirt: one point, rigidly through space, and along the skin, which turns the skirt round the body."
            }
            Self::Pins => {
                "The skirt is turned, then pulled up; then two pins on its back keep a drag on the front from going round."
            }
        }
    }

    /// Name of its file in `assets/demos`, without `.jsonl`.
    pub fn file_stem(self) -> &'static str {
        match self {
            Self::Wrapping => "wrapping",
            Self::Dragging => "dragging",
            Self::Rewrapping => "rewrapping",
            Self::Rewearing => "rewearing",
            Self::Laser => "laser",
            Self::Scarf => "scarf",
            Self::Modes => "modes",
            Self::Pins => "pins",
        }
    }

    /// The recording, as JSON lines.
    pub fn recording(self) -> &'static str {
        match self {
            Self::Wrapping => include_str!("../../assets/demos/wrapping.jsonl"),
            Self::Dragging => include_str!("../../assets/demos/dragging.jsonl"),
            Self::Rewrapping => include_str!("../../assets/demos/rewrapping.jsonl"),
            Self::Rewearing => include_str!("../../assets/demos/rewearing.jsonl"),
            Self::Laser => include_str!("../../assets/demos/laser.jsonl"),
            Self::Scarf => include_str!("../../assets/demos/scarf.jsonl"),
            Self::Modes => include_str!("../../assets/demos/modes.jsonl"),
            Self::Pins => include_str!("../../assets/demos/pins.jsonl"),
        }
    }
}
