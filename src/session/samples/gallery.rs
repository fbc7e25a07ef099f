//! Samples without marks: designs with chosen measures, drafted with every piece placed round the body, in a fabric of their own.

use std::sync::Arc;

use crate::body::Mannequin;
use crate::draft::{
    self, Bodice, Bottom, Cape, Collar, Design, Dolman, Dungarees, Fall, Form, Hem, Hood, Kind, Neckline,
    NecklineShape, Opening, Pleats, Shape, Skirt, Sleeve, Top, Trousers, Upper, Waist,
};
use crate::io::sheet;
use crate::pattern::Pattern;
use crate::session::dyes::{Dye, Motif, Print};
use crate::session::samples::draft::finish;
use crate::session::{BodyChoice, Document};

/// Height of the waistband that holds a bow, metres.
pub const SASH: f64 = 0.055;

/// A garment of the gallery: its cut, fabric and colours.
pub struct Garment {
    cut: Cut,
    fabric: &'static str,
    dye: Dye,
}

/// How a garment of the gallery is cut.
enum Cut {
    Design(Box<Design>),
    Dungarees(Dungarees),
    Pleats(Pleats),
    Cape(Cape),
}

fn drawn(design: Design) -> Cut {
    Cut::Design(Box::new(design))
}

impl Cut {
    fn drafted(&self, form: &Form) -> Pattern {
        match self {
            Self::Design(design) => design.drafted(form),
            Self::Dungarees(cut) => draft::dungarees(form, cut),
            Self::Pleats(cut) => draft::pleated_skirt(form, cut),
            Self::Cape(cut) => draft::cape(form, cut),
        }
    }
}

/// A document with `garment` drafted for `body`. Panics where it lacks a landmark, which does not happen: this program builds it.
pub fn document(garment: &Garment, body: &Mannequin) -> Document {
    document_with(garment, body, |_| ())
}

/// The same, with what `add` adds to its pattern.
pub fn document_with(garment: &Garment, body: &Mannequin, add: impl FnOnce(&mut Pattern)) -> Document {
    let form = Form::of(body).expect("a mannequin has its landmarks");
    let body = BodyChoice::Mannequin(body.measurements);
    let mut pattern = garment.cut.drafted(&form);
    add(&mut pattern);
    laid_out(pattern, body, garment.fabric, garment.dye)
}

/// A document with `pattern`, its pieces laid out on the table, beside `body`, in this fabric and dye.
pub fn laid_out(mut pattern: Pattern, body: BodyChoice, fabric: &str, dye: Dye) -> Document {
    finish(&mut pattern);
    sheet::lay_out(&mut pattern);
    let mut document = Document { pattern: Arc::new(pattern), body, ..Document::default() };
    document.fabrics.all = Some(fabric.to_owned());
    document.dyes.all = dye;
    document
}

/// A blouse with a turned-out collar and cuffs.
pub fn blouse() -> Garment {
    let bodice = Bodice { bust_ease: 0.13, hem_ease: 0.10, ..boxy(Hem::Hip) };
    let collar = Collar { height: 0.060, flare: 1.15, fall: None };
    let sleeve = Sleeve { puff: 1.12, cuff: Some(0.05), gather: 1.35, ..sleeve(0.88) };
    let upper = Upper { collar: Some(collar), sleeve: Some(sleeve), ..upper(bodice, close()) };
    Garment { cut: drawn(top(Kind::Collared, upper)), fabric: "polyester", dye: dyed([222, 214, 232]) }
}

/// A roomy top with a hood.
pub fn hoodie() -> Garment {
    let bodice = Bodice { bust_ease: 0.20, hem_ease: 0.12, ..boxy(Hem::Hip) };
    let hood = Hood { above: 0.03, fullness: 0.02 };
    let sleeve = Sleeve { ease: 0.13, cuff: Some(0.05), gather: 1.2, ..sleeve(0.9) };
    let upper = Upper { hood: Some(hood), sleeve: Some(sleeve), ..upper(bodice, close()) };
    Garment { cut: drawn(top(Kind::Hooded, upper)), fabric: "fleece", dye: dyed([92, 112, 104]) }
}

/// A top whose raglan sleeves reach up to the neckline.
pub fn raglan() -> Garment {
    let bodice = Bodice { bust_ease: 0.14, hem_ease: 0.10, ..boxy(Hem::Hip) };
    let upper = Upper { raglan: true, sleeve: Some(sleeve(0.55)), ..upper(bodice, round()) };
    Garment { cut: drawn(top(Kind::Raglan, upper)), fabric: "jersey", dye: dyed([196, 92, 70]) }
}

/// A wide top with its sleeves in one piece.
pub fn kimono() -> Garment {
    let cut =
        Dolman { hem: Hem::Hip, ease: 0.18, hem_ease: 0.12, length: 0.42, sleeve_ease: 0.08, depth: 0.08 };
    let neckline = Neckline { shape: NecklineShape::V, width: 0.090, drops: [0.15, 0.03] };
    let design = Design { top: Some(Top::Dolman(cut, neckline)), ..plain(Kind::Dolman) };
    let print = Print { motif: Motif::Dots, repeat_m: 0.05, colour: [226, 206, 160] };
    let dye = Dye { print: Some(print), ..dyed([58, 74, 110]) };
    Garment { cut: drawn(design), fabric: "woven-light", dye }
}

/// A long warm top with a funnel collar.
pub fn tunic() -> Garment {
    let bodice = Bodice { bust_ease: 0.18, hem_ease: 0.16, ..boxy(Hem::Tunic) };
    let collar = Collar { height: 0.075, flare: 1.05, fall: None };
    let upper = Upper { collar: Some(collar), sleeve: Some(sleeve(0.88)), ..upper(bodice, close()) };
    Garment { cut: drawn(top(Kind::Collared, upper)), fabric: "wool", dye: dyed([120, 76, 66]) }
}

/// A fitted bodice on a long skirt of godets.
pub fn gown() -> Garment {
    let bodice = Bodice { short_shoulder: 0.03, ..fitted() };
    let neckline = Neckline { shape: NecklineShape::V, width: 0.095, drops: [0.17, 0.045] };
    let shape = Shape::Godets { ease: 0.06, depth: 0.55, angle: 0.45, middles: true };
    let design = Design {
        top: Some(Top::Cut(upper(bodice, neckline))),
        bottom: Some(Bottom::Skirt(Skirt { shape, length: 0.8 })),
        ..plain(Kind::Dress)
    };
    Garment { cut: drawn(design), fabric: "satin", dye: Dye::default() }
}

/// A bodice on wide trousers.
pub fn jumpsuit() -> Garment {
    let bodice = Bodice { blouse: 0.02, short_shoulder: 0.025, ..fitted() };
    let legs = Trousers {
        length: 1.8,
        hip_ease: 0.09,
        crotch_ease: 0.04,
        knee_ease: 0.15,
        hem_ease: 0.24,
        turn_up: None,
    };
    let neckline = Neckline { shape: NecklineShape::Square, width: 0.095, drops: [0.11, 0.03] };
    let design = Design {
        top: Some(Top::Cut(upper(bodice, neckline))),
        bottom: Some(Bottom::Trousers(legs)),
        ..plain(Kind::Jumpsuit)
    };
    Garment { cut: drawn(design), fabric: "linen", dye: dyed([150, 160, 124]) }
}

/// Narrow trousers of knitted cloth.
pub fn leggings() -> Garment {
    let legs = Trousers {
        length: 1.86,
        hip_ease: 0.02,
        crotch_ease: 0.015,
        knee_ease: 0.025,
        hem_ease: 0.03,
        turn_up: None,
    };
    let design = Design {
        bottom: Some(Bottom::Trousers(legs)),
        waist: Waist { ease: 0.02, band: Some(0.05) },
        ..plain(Kind::Trousers)
    };
    Garment { cut: drawn(design), fabric: "ponte-roma", dye: dyed([52, 54, 62]) }
}

/// Short trousers.
pub fn shorts() -> Garment {
    Garment { cut: drawn(short(0.6, 0.10, None)), fabric: "denim-11oz", dye: Dye::default() }
}

/// Trousers down to the knee, with turn-ups.
pub fn turn_ups() -> Garment {
    Garment { cut: drawn(short(0.97, 0.20, Some(0.05))), fabric: "denim-11oz", dye: Dye::default() }
}

/// A skirt cut from a full circle.
pub fn circle_skirt() -> Garment {
    let print = Print { motif: Motif::Checks, repeat_m: 0.06, colour: [236, 226, 206] };
    let dye = Dye { print: Some(print), ..dyed([172, 62, 60]) };
    Garment { cut: drawn(skirt(Kind::CircleSkirt, Shape::Circle { share: 1.0 }, 0.5)), fabric: "cotton", dye }
}

/// A skirt gathered into its waistband.
pub fn gathered_skirt() -> Garment {
    let shape = Shape::Gathered { ratio: 1.6 };
    Garment {
        cut: drawn(skirt(Kind::GatheredSkirt, shape, 0.6)),
        fabric: "woven-light",
        dye: dyed([206, 150, 92]),
    }
}

/// A skirt of three tiers.
pub fn tiered_skirt() -> Garment {
    let shape = Shape::Levels { ratio: 1.35, count: 3 };
    Garment { cut: drawn(skirt(Kind::LevelSkirt, shape, 0.68)), fabric: "linen", dye: dyed([104, 140, 160]) }
}

/// A child's bodice with short puff sleeves, on a skirt gathered into its waist.
pub fn child_dress() -> Garment {
    let bodice = Bodice { bust_ease: 0.10, hem_ease: 0.06, ..boxy(Hem::Waist) };
    let neckline = Neckline { shape: NecklineShape::Round, width: 0.082, drops: [0.055, 0.018] };
    let sleeve =
        Sleeve { ease: 0.03, hem_ease: 0.06, puff: 1.25, cuff: Some(0.025), gather: 1.2, ..sleeve(0.32) };
    let shape = Shape::Gathered { ratio: 1.45 };
    let design = Design {
        top: Some(Top::Cut(Upper { sleeve: Some(sleeve), ..upper(bodice, neckline) })),
        bottom: Some(Bottom::Skirt(Skirt { shape, length: 0.57 })),
        ..plain(Kind::Dress)
    };
    let print = Print { motif: Motif::Dots, repeat_m: 0.035, colour: [250, 240, 224] };
    let dye = Dye { print: Some(print), ..dyed([206, 84, 96]) };
    Garment { cut: drawn(design), fabric: "cotton", dye }
}

/// Trousers with a bib, and straps over the shoulders.
pub fn dungarees() -> Garment {
    let legs = Trousers {
        length: 1.82,
        hip_ease: 0.10,
        crotch_ease: 0.045,
        knee_ease: 0.14,
        hem_ease: 0.20,
        turn_up: None,
    };
    let cut = Dungarees {
        legs,
        waist_ease: 0.06,
        band: 0.04,
        bib: [0.13, 0.10],
        above_bust: 0.05,
        strap_at: 0.084,
        strap: 0.045,
    };
    Garment { cut: Cut::Dungarees(cut), fabric: "denim-11oz", dye: dyed([74, 98, 138]) }
}

/// A long, roomy coat, buttoned from the collar down.
pub fn coat() -> Garment {
    let opening = Opening { stand: 0.03, buttons: 6, diameter: 0.025, colour: [78, 54, 38] };
    let bodice = Bodice { bust_ease: 0.20, hem_ease: 0.50, opening: Some(opening), ..boxy(Hem::Coat) };
    let collar = Collar { height: 0.065, flare: 1.12, fall: None };
    let sleeve = Sleeve { ease: 0.14, hem_ease: 0.14, ..sleeve(1.0) };
    let upper = Upper { collar: Some(collar), sleeve: Some(sleeve), ..upper(bodice, close()) };
    Garment { cut: drawn(top(Kind::Collared, upper)), fabric: "wool", dye: dyed([176, 142, 104]) }
}

/// A shirt whose collar turns over.
pub fn shirt() -> Garment {
    let bodice = Bodice { bust_ease: 0.14, hem_ease: 0.10, ..boxy(Hem::Hip) };
    let collar =
        Collar { height: 0.030, flare: 1.2, fall: Some(Fall { depth: 0.044, point: 0.012, in_one: false }) };
    let sleeve = Sleeve { cuff: Some(0.06), gather: 1.2, ..sleeve(0.9) };
    let upper = Upper { collar: Some(collar), sleeve: Some(sleeve), ..upper(bodice, close()) };
    Garment { cut: drawn(top(Kind::Collared, upper)), fabric: "cotton", dye: dyed([196, 214, 232]) }
}

/// A shirt with short sleeves and a collar in one piece, which turns over at a fold.
pub fn camp_shirt() -> Garment {
    let bodice = Bodice { bust_ease: 0.18, hem_ease: 0.16, ..boxy(Hem::Hip) };
    let fall = Fall { depth: 0.046, point: 0.014, in_one: true };
    let collar = Collar { height: 0.026, flare: 1.3, fall: Some(fall) };
    let sleeve = Sleeve { hem_ease: 0.14, ..sleeve(0.35) };
    let upper = Upper { collar: Some(collar), sleeve: Some(sleeve), ..upper(bodice, close()) };
    Garment { cut: drawn(top(Kind::Collared, upper)), fabric: "linen", dye: dyed([206, 120, 92]) }
}

/// A skirt of knife pleats all round, on a waistband.
pub fn pleated_skirt() -> Garment {
    let cut = Pleats {
        count: 6,
        depth: 0.045,
        angle: 150_f64.to_radians(),
        waist_ease: 0.035,
        hip_ease: -0.01,
        band: 0.04,
        length: 0.6,
    };
    Garment { cut: Cut::Pleats(cut), fabric: "polyester", dye: dyed([70, 84, 110]) }
}

/// A skirt gathered into a wide waistband, without its bow.
pub fn sash_skirt() -> Garment {
    let shape = Shape::Gathered { ratio: 1.5 };
    let waist = Waist { ease: 0.035, band: Some(SASH) };
    let design = Design { waist, ..skirt(Kind::GatheredSkirt, shape, 0.58) };
    Garment { cut: drawn(design), fabric: "cotton", dye: dyed([58, 74, 110]) }
}

/// A cape over shoulders and arms, closed at the throat.
pub fn cape() -> Garment {
    let cut = Cape { neckline: close(), length: 0.49, cover: 0.8, closing: 0.05, open: 0.11 };
    Garment { cut: Cut::Cape(cut), fabric: "wool", dye: dyed([112, 44, 52]) }
}

fn plain(kind: Kind) -> Design {
    Design { kind, top: None, bottom: None, waist: Waist { ease: 0.035, band: Some(0.04) } }
}

fn top(kind: Kind, upper: Upper) -> Design {
    Design { top: Some(Top::Cut(upper)), ..plain(kind) }
}

/// Short trousers down to the level `length`, with this ease at the hem and turn-ups of this height, metres.
fn short(length: f64, hem_ease: f64, turn_up: Option<f64>) -> Design {
    let legs = Trousers { length, hip_ease: 0.09, crotch_ease: 0.035, knee_ease: 0.0, hem_ease, turn_up };
    Design { bottom: Some(Bottom::Trousers(legs)), ..plain(Kind::Shorts) }
}

fn skirt(kind: Kind, shape: Shape, length: f64) -> Design {
    Design { bottom: Some(Bottom::Skirt(Skirt { shape, length })), ..plain(kind) }
}

fn upper(bodice: Bodice, neckline: Neckline) -> Upper {
    Upper { bodice, neckline, sleeve: None, raglan: false, collar: None, hood: None }
}

fn boxy(hem: Hem) -> Bodice {
    Bodice {
        hem,
        bust_ease: 0.12,
        hem_ease: 0.10,
        waist_dart: 0.0,
        bust_dart: false,
        centre_seams: [false, false],
        blouse: 0.0,
        short_shoulder: 0.0,
        opening: None,
    }
}

fn fitted() -> Bodice {
    Bodice { bust_ease: 0.06, hem_ease: 0.045, waist_dart: 0.026, bust_dart: true, ..boxy(Hem::Waist) }
}

/// A sleeve of this share of the arm's length.
fn sleeve(length: f64) -> Sleeve {
    Sleeve { length, ease: 0.10, hem_ease: 0.09, puff: 1.0, cuff: None, gather: 1.0, turn_up: None }
}

fn round() -> Neckline {
    Neckline { shape: NecklineShape::Round, width: 0.092, drops: [0.10, 0.03] }
}

fn close() -> Neckline {
    Neckline { shape: NecklineShape::Round, width: 0.083, drops: [0.085, 0.024] }
}

/// Plain cloth of this colour, sRGB.
pub fn dyed(colour: [u8; 3]) -> Dye {
    Dye { colour: Some(colour), ..Dye::default() }
}
