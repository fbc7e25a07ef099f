//! Recordings that come with the program: walks through its tasks, and the figures of paper A, made with the program's own samples.

/// A demo: a recording that comes with the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Demo {
    /// A skirt drafted from a rectangle, sewn, wrapped and draped.
    Drafting,
    /// Trousers let out for a larger hip.
    Fitting,
    /// A pattern from a file, dressed without marks.
    Drawing,
    /// A cloth on a creature.
    Creature,
    /// Sizes and grade rules of a skirt.
    Grading,
    /// A dressed body in other poses.
    Posing,
    /// A coat that becomes a jacket with buttons, topstitching and hems.
    Finishing,
    /// A T-shirt with a graphic, in two colourways.
    Colourways,
    /// A dress on the bias, with allowances and notches, to be laid out on cloth.
    Cutting,
    /// A skirt of a chosen fabric and print, to be exported to Blender.
    Export,
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
    /// All of them, in the order of the menu: the walks, then the figures.
    pub const ALL: [Self; 18] = [
        Self::Drafting,
        Self::Fitting,
        Self::Drawing,
        Self::Creature,
        Self::Grading,
        Self::Posing,
        Self::Finishing,
        Self::Colourways,
        Self::Cutting,
        Self::Export,
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
            Self::Drafting => "Draft a skirt",
            Self::Fitting => "Fit trousers",
            Self::Drawing => "Dress a pattern from a file",
            Self::Creature => "Wrap a creature",
            Self::Grading => "Grade a skirt",
            Self::Posing => "Take another pose",
            Self::Finishing => "Finish a jacket",
            Self::Colourways => "Make two colourways",
            Self::Cutting => "Prepare a dress for cutting",
            Self::Export => "Export to Blender",
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

    /// Whether it walks through a task, instead of showing a figure.
    pub fn is_walk(self) -> bool {
        self.figure().is_none()
    }

    /// Number of the paper's figure that shows the same; None for a walk.
    pub fn figure(self) -> Option<&'static str> {
        Some(match self {
            Self::Drafting
            | Self::Fitting
            | Self::Drawing
            | Self::Creature
            | Self::Grading
            | Self::Posing
            | Self::Finishing
            | Self::Colourways
            | Self::Cutting
            | Self::Export => return None,
            Self::Wrapping => "1",
            Self::Dragging => "2",
            Self::Rewrapping | Self::Rewearing => "4",
            Self::Laser | Self::Scarf => "5",
            Self::Modes => "7",
            Self::Pins => "8",
        })
    }

    /// Caption, a sentence or two.
    pub fn tells(self) -> &'static str {
        match self {
            Self::Drafting => {
                "A rectangle becomes a front: narrower at the waist, wider at the hem, with two darts. A copy is the back. Sides sewn, a mark on each waist, Wrap, Drape."
            }
            Self::Fitting => {
                "On larger hips the trousers are tight. Their pieces are made wider on the table, and the cloth on the body follows at once."
            }
            Self::Drawing => {
                "A pattern with placements comes from a file. Dress suggests marks of its own, wraps, drapes, and takes the first start without a fault."
            }
            Self::Creature => {
                "Any closed mesh is a body. One mark along the middle of the cloth and one along the back say how it lies; Drape lets it hang."
            }
            Self::Grading => {
                "Sizes are chosen, then points get rules: how far they go from size to size. The table shows all sizes nested. What is wrapped is the base size."
            }
            Self::Posing => {
                "Marks, pins and dressed cloth go along when the body moves: arms down, then a step."
            }
            Self::Finishing => {
                "A coat becomes a jacket with buttons and buttonholes, topstitching along its front edges and collar, and hems. Then it is sewn together where its pieces are placed round the body, and the buttons hold it closed."
            }
            Self::Colourways => {
                "A T-shirt of jersey gets a colour, striped sleeves and a graphic. That is kept as a colourway, other colours as a second; by its name each comes back."
            }
            Self::Cutting => {
                "A striped dress gets a seam allowance, hem corners that fit turned up, and notches. The grainline of its skirt is turned to the bias, and the stripes turn with it."
            }
            Self::Export => {
                "The skirt gets a fabric and a colour, front and back a print; then it is wrapped and draped. Blender gets all of that."
            }
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

    /// What a person does next, told in place of the caption when the demo has ended.
    pub fn leads_to(self) -> Option<&'static str> {
        match self {
            Self::Cutting => Some(
                "File › Marker… lays the pieces out on a width of cloth, each by its cutting line and its grainline, and writes that as .pdf, .svg or .dxf.",
            ),
            Self::Export => Some(
                "File › Export… writes it as .glb: cloth and body in metres, with materials, textures and texture coordinates. In Blender it comes in by File › Import › glTF 2.0.",
            ),
            _ => None,
        }
    }

    /// Name of its file in `assets/demos`, without `.jsonl`.
    pub fn file_stem(self) -> &'static str {
        match self {
            Self::Drafting => "drafting",
            Self::Fitting => "fitting",
            Self::Drawing => "drawing",
            Self::Creature => "creature",
            Self::Grading => "grading",
            Self::Posing => "posing",
            Self::Finishing => "finishing",
            Self::Colourways => "colourways",
            Self::Cutting => "cutting",
            Self::Export => "export",
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
            Self::Drafting => include_str!("../../assets/demos/drafting.jsonl"),
            Self::Fitting => include_str!("../../assets/demos/fitting.jsonl"),
            Self::Drawing => include_str!("../../assets/demos/drawing.jsonl"),
            Self::Creature => include_str!("../../assets/demos/creature.jsonl"),
            Self::Grading => include_str!("../../assets/demos/grading.jsonl"),
            Self::Posing => include_str!("../../assets/demos/posing.jsonl"),
            Self::Finishing => include_str!("../../assets/demos/finishing.jsonl"),
            Self::Colourways => include_str!("../../assets/demos/colourways.jsonl"),
            Self::Cutting => include_str!("../../assets/demos/cutting.jsonl"),
            Self::Export => include_str!("../../assets/demos/export.jsonl"),
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
