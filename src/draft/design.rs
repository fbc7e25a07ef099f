//! Designs: a kind of garment and all choices about its cut, drawn at random.

use serde::Serialize;

use crate::draft::band::{Band, waistband};
use crate::draft::bodice::{Armhole, Bodice, Hem, bodice};
use crate::draft::collar::{Collar, collar};
use crate::draft::dolman::{Dolman, dolman};
use crate::draft::form::Form;
use crate::draft::garment::Garment;
use crate::draft::hood::{Hood, hood};
use crate::draft::neckline::Neckline;
use crate::draft::one_shoulder::{OneShoulder, one_shoulder};
use crate::draft::skirt::{CLEARANCE, Shape, Skirt, skirt};
use crate::draft::sleeve::{self, Sleeve};
use crate::draft::trousers::{Trousers, trousers};
use crate::geometry::random::Random;
use crate::pattern::Pattern;

/// Height of the waistband of a skirt that was drawn without one, but whose own upper edge would stretch under its weight, being
/// cut on the bias or gathered, metres.
const LEAST_BAND: f64 = 0.03;

/// Kind of garment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// A boxy top with sleeves that are set in.
    Shirt,
    /// A top without sleeves.
    Vest,
    /// A bodice with darts down to the waist, with or without sleeves.
    Bodice,
    /// A top with raglan sleeves.
    Raglan,
    /// A top whose sleeves are cut in one with it.
    Dolman,
    /// A top with a collar.
    Collared,
    /// A top with a hood.
    Hooded,
    /// A top that hangs from one shoulder.
    OneShoulder,
    StraightSkirt,
    FlaredSkirt,
    CircleSkirt,
    GatheredSkirt,
    GodetSkirt,
    LevelSkirt,
    Trousers,
    Shorts,
    /// A bodice on a skirt.
    Dress,
    /// A bodice on trousers.
    Jumpsuit,
}

impl Kind {
    /// All kinds.
    pub const ALL: [Self; 18] = [
        Self::Shirt,
        Self::Vest,
        Self::Bodice,
        Self::Raglan,
        Self::Dolman,
        Self::Collared,
        Self::Hooded,
        Self::OneShoulder,
        Self::StraightSkirt,
        Self::FlaredSkirt,
        Self::CircleSkirt,
        Self::GatheredSkirt,
        Self::GodetSkirt,
        Self::LevelSkirt,
        Self::Trousers,
        Self::Shorts,
        Self::Dress,
        Self::Jumpsuit,
    ];

    /// Name on the command line and in file names.
    pub fn name(self) -> &'static str {
        match self {
            Self::Shirt => "shirt",
            Self::Vest => "vest",
            Self::Bodice => "bodice",
            Self::Raglan => "raglan",
            Self::Dolman => "dolman",
            Self::Collared => "collared",
            Self::Hooded => "hooded",
            Self::OneShoulder => "one-shoulder",
            Self::StraightSkirt => "straight-skirt",
            Self::FlaredSkirt => "flared-skirt",
            Self::CircleSkirt => "circle-skirt",
            Self::GatheredSkirt => "gathered-skirt",
            Self::GodetSkirt => "godet-skirt",
            Self::LevelSkirt => "level-skirt",
            Self::Trousers => "trousers",
            Self::Shorts => "shorts",
            Self::Dress => "dress",
            Self::Jumpsuit => "jumpsuit",
        }
    }
}

impl std::str::FromStr for Kind {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Self::ALL.into_iter().find(|kind| kind.name() == text).ok_or_else(|| {
            format!("there is no kind {text:?}; there are {}", Self::ALL.map(Self::name).join(", "))
        })
    }
}

/// A bodice with everything sewn to it above the waist.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Upper {
    pub bodice: Bodice,
    pub neckline: Neckline,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sleeve: Option<Sleeve>,
    /// Whether the sleeves are raglan sleeves, which reach up to the neckline.
    pub raglan: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub collar: Option<Collar>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hood: Option<Hood>,
}

/// The part above the waist.
#[derive(Clone, Copy, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Top {
    Cut(Upper),
    Dolman(Dolman, Neckline),
    OneShoulder(OneShoulder),
}

/// The part below the waist.
#[derive(Clone, Copy, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Bottom {
    Skirt(Skirt),
    Trousers(Trousers),
}

/// The waist of a garment without a bodice; metres.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Waist {
    /// Ease added to the body's waist girth.
    pub ease: f64,
    /// Height of a waistband; None: the upper edge is free.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub band: Option<f64>,
}

/// All choices about a garment, independent of the body that it is drafted for.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Design {
    pub kind: Kind,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub top: Option<Top>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bottom: Option<Bottom>,
    pub waist: Waist,
}

impl Design {
    /// Design number `number` of the corpus with this `seed`; `kinds`, at least one, take turns.
    pub fn drawn(seed: u64, number: u32, kinds: &[Kind]) -> Self {
        let count = kinds.len() as u32;
        // Shifted from round to round, so that every n-th design is not always of the same kinds.
        let kind = kinds[((number + number / count) % count) as usize];
        Self::of_kind(kind, &mut Random::stream(seed, u64::from(number)))
    }

    /// A garment of this kind, with measures drawn within human ranges.
    pub fn of_kind(kind: Kind, random: &mut Random) -> Self {
        let band = if random.chance(0.85) { Some(random.between(0.03, 0.05)) } else { None };
        let waist = Waist { ease: random.between(0.028, 0.045), band };
        let skirt = |skirt: Skirt| (None, Some(Bottom::Skirt(skirt)));
        let (top, bottom) = match kind {
            Kind::Shirt | Kind::Vest | Kind::Raglan | Kind::Collared | Kind::Hooded => {
                (Some(Top::Cut(Upper::loose(kind, random))), None)
            }
            Kind::Bodice => (Some(Top::Cut(Upper::fitted(random))), None),
            Kind::Dolman => (Some(Top::Dolman(Dolman::drawn(random), Neckline::open(random))), None),
            Kind::OneShoulder => (Some(Top::OneShoulder(OneShoulder::drawn(random))), None),
            Kind::StraightSkirt => skirt(Skirt::straight(random)),
            Kind::FlaredSkirt => skirt(Skirt::flared(random)),
            Kind::CircleSkirt => skirt(Skirt::circle(random)),
            Kind::GatheredSkirt => skirt(Skirt::gathered(random)),
            Kind::GodetSkirt => skirt(Skirt::godets(random)),
            Kind::LevelSkirt => skirt(Skirt::levels(random)),
            Kind::Trousers => (None, Some(Bottom::Trousers(Trousers::long(random)))),
            Kind::Shorts => (None, Some(Bottom::Trousers(Trousers::shorts(random)))),
            Kind::Dress => (Some(Top::Cut(Upper::fitted(random))), Some(Bottom::Skirt(Skirt::any(random)))),
            Kind::Jumpsuit => {
                let legs = if random.chance(0.3) { Trousers::shorts } else { Trousers::long };
                let mut upper = Upper::fitted(random);
                // It hangs from the shoulders and must not cut into the crotch.
                upper.bodice.blouse = random.between(0.010, 0.025);
                (Some(Top::Cut(upper)), Some(Bottom::Trousers(legs(random))))
            }
        };
        let gives = |skirt: &Skirt| {
            matches!(skirt.shape, Shape::Circle { .. } | Shape::Gathered { .. } | Shape::Levels { .. })
        };
        let needs_band = matches!(&bottom, Some(Bottom::Skirt(skirt)) if gives(skirt));
        let band = waist.band.or(needs_band.then_some(LEAST_BAND));
        Self { kind, top, bottom, waist: Waist { band, ..waist } }
    }

    /// The pattern for the body of `form`, with pieces placed round it.
    pub fn drafted(&self, form: &Form) -> Pattern {
        let mut garment = Garment::default();
        let girth = form.measurements.waist + self.waist.ease;
        let mut waist = (girth, form.waist, None);
        match &self.top {
            Some(Top::Cut(upper)) => waist = upper.drafted(&mut garment, form),
            Some(Top::Dolman(cut, neckline)) => dolman(&mut garment, form, cut, neckline),
            Some(Top::OneShoulder(cut)) => one_shoulder(&mut garment, form, cut),
            None => {}
        }
        let (girth, level, hem) = waist;
        let tops = match &self.bottom {
            Some(Bottom::Skirt(cut)) => skirt(&mut garment, form, cut, girth, level),
            Some(Bottom::Trousers(cut)) => trousers(&mut garment, form, cut, girth, level),
            None => return garment.pattern,
        };
        match (hem, self.waist.band) {
            (Some([front, back]), _) => {
                garment.sew(&front, &tops[0]);
                garment.sew(&back, &tops[1]);
            }
            (None, Some(height)) => {
                let plain = Band::plain(height, girth, level);
                // With turn-ups it is sewn as it is placed, and a band nearer to the body than the legs may end up inside them.
                let band = match &self.bottom {
                    Some(Bottom::Trousers(cut)) if cut.turn_up.is_some() => {
                        Band { clearance: CLEARANCE, ..plain }
                    }
                    _ => plain,
                };
                waistband(&mut garment, form, &band, &tops);
            }
            (None, None) => {}
        }
        garment.pattern
    }
}

/// Girth of a hem (metres), its height as placed (metres), and its edges in front and at the back.
type WaistLine = (f64, f64, Option<[crate::draft::garment::Run; 2]>);

impl Upper {
    /// A boxy top of one of the kinds that have a bodice, drawn at random.
    fn loose(kind: Kind, random: &mut Random) -> Self {
        let hem = random.one_of([Hem::Hip, Hem::Hip, Hem::Tunic]);
        let mut bodice = Bodice::boxy(random, hem);
        let close = matches!(kind, Kind::Collared | Kind::Hooded);
        let neckline = if close { Neckline::close(random) } else { Neckline::open(random) };
        let sleeveless = kind == Kind::Vest || close && random.chance(0.3);
        if sleeveless {
            bodice.short_shoulder = random.between(0.015, 0.035);
        }
        Self {
            bodice,
            neckline,
            sleeve: (!sleeveless).then(|| Sleeve::drawn(random, kind == Kind::Shirt)),
            raglan: kind == Kind::Raglan,
            collar: (kind == Kind::Collared).then(|| Collar::drawn(random)),
            hood: (kind == Kind::Hooded).then(|| Hood::drawn(random)),
        }
    }

    /// A bodice down to the waist, with or without sleeves and collar, drawn at random.
    fn fitted(random: &mut Random) -> Self {
        let mut bodice = Bodice::fitted(random);
        let collar = random.chance(0.2).then(|| Collar::drawn(random));
        let neckline = if collar.is_some() { Neckline::close(random) } else { Neckline::open(random) };
        let sleeve = random.chance(0.6).then(|| Sleeve::drawn(random, true));
        if sleeve.is_none() {
            bodice.short_shoulder = random.between(0.015, 0.035);
        }
        Self { bodice, neckline, sleeve, raglan: false, collar, hood: None }
    }

    /// Drafts it; returns its [`WaistLine`].
    fn drafted(&self, garment: &mut Garment, form: &Form) -> WaistLine {
        let armhole = if self.raglan { Armhole::Raglan } else { Armhole::SetIn };
        let trunk = bodice(garment, form, &self.bodice, &self.neckline, armhole);
        match &self.sleeve {
            Some(cut) if self.raglan => sleeve::raglan(garment, form, cut, &trunk),
            Some(cut) => sleeve::set_in(garment, form, cut, &trunk),
            None => {}
        }
        if let Some(cut) = &self.collar {
            collar(garment, form, cut, &trunk);
        }
        if let Some(cut) = &self.hood {
            hood(garment, form, cut, &trunk);
        }
        let girth = form.measurements.waist + self.bodice.hem_ease;
        let level = trunk.hem_height[0].min(trunk.hem_height[1]) - 0.005;
        let hems = [0, 1].map(|side| trunk.hem(garment, side));
        (girth, level, Some(hems))
    }
}
