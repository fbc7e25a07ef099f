//! The tables of the fit report. Lengths are in centimetres.

use maud::{Markup, html};

use crate::body::readings::Reading;
use crate::cloth::Fabric;
use crate::fit::maps::MapStats;
use crate::fit::{Causes, STRAINED, SeamFit};
use crate::geometry::ids::PieceId;
use crate::ui::fit_page::facts::Facts;
use crate::ui::fit_page::legend::minus;
use crate::ui::fit_page::words::smaller_words;
use crate::ui::language::{number, say, signed, tr};

/// The entry where there is no value.
const NONE: &str = "–";
/// Relative difference between the sides of a seam below which they count as equal, not gathered.
const ALIKE: f64 = 0.005;

fn cm(metres: f64) -> String {
    minus(&number(metres * 100.0, 1))
}

fn signed_cm(metres: f64) -> String {
    minus(&signed(metres * 100.0, 1))
}

/// A fraction as a percentage with sign.
fn percent(share: f64) -> String {
    minus(&signed(share * 100.0, 1))
}

fn or_none(value: Option<f64>, words: impl Fn(f64) -> String) -> String {
    value.map_or_else(|| NONE.to_owned(), words)
}

/// The head of a table; its first `words` columns hold text, the others numbers.
fn head(words: usize, columns: &[&str]) -> Markup {
    html! { thead { tr { @for (i, column) in columns.iter().enumerate() {
        th.words[i < words] { (column) }
    } } } }
}

/// Girths of body and garment with the ease, where the cloth goes all the way round.
pub fn girths(facts: &Facts) -> Markup {
    html! {
        table {
            (head(1, &[
                "", tr("Height"), tr("Body"), tr("Pattern"), tr("Ease"), tr("Ease, %"), tr("As worn"), tr("Stretch, %"),
            ]))
            tbody { @for (i, girth) in &facts.girths {
                @let Reading { name, metres, height, .. } = &facts.readings[*i];
                tr {
                    th.words { (tr(name)) }
                    td.weak { (or_none(*height, cm)) }
                    td { (cm(*metres)) }
                    td { (cm(girth.flat)) }
                    td.strong { (signed_cm(girth.flat - metres)) }
                    td { (percent(girth.flat / metres - 1.0)) }
                    td { (cm(girth.worn)) }
                    td { (percent(girth.worn / girth.flat - 1.0)) }
                }
            } }
        }
    }
}

/// The causes of the cloth's strain.
pub fn strain_causes(causes: &Causes) -> Markup {
    let all = [
        (tr("The pattern is small there"), causes.fit),
        (tr("The sides of a seam are unequal"), causes.seam_ease),
        (tr("It did not come to rest"), causes.unconverged),
    ];
    let strained = say!("Strained by more than {percent} %", percent = number(STRAINED * 100.0, 0));
    html! {
        table {
            (head(1, &[&strained, tr("Edges"), tr("At most, %")]))
            tbody { @for (words, strained) in all {
                tr { th.words { (words) } td { (strained.edges) } td { (percent(strained.max)) } }
            } }
        }
        @for smaller in &causes.smaller { p { (smaller_words(smaller)) "." } }
    }
}

/// The body measurements.
pub fn readings(facts: &Facts) -> Markup {
    html! {
        table {
            (head(1, &["", "cm", tr("Height")]))
            tbody { @for Reading { name, metres, height, .. } in &facts.readings {
                tr { th.words { (tr(name)) } td { (cm(*metres)) } td.weak { (or_none(*height, cm)) } }
            } }
        }
    }
}

/// All seams of the pattern.
pub fn seams(facts: &Facts) -> Markup {
    html! {
        table.seams {
            (head(2, &[
                tr("Seam"), tr("Joins"), tr("Lengths"), tr("Gather"), tr("As worn"), tr("Stretch, %"), "",
            ]))
            tbody { @for seam in &facts.seams {
                tr {
                    th.number { (seam.seam.0) }
                    td.words { @for (k, (piece, edge)) in seam.sides.iter().enumerate() {
                        @if k > 0 { span.weak { " " (tr("with")) " " } }
                        (piece) span.weak { " " (say!("edge {edge}", edge)) }
                    } }
                    td { (or_none(seam.flat[0], cm)) span.weak { " / " } (or_none(seam.flat[1], cm)) }
                    td { (or_none(seam.gather(), gather)) }
                    td { (or_none(seam.worn, cm)) }
                    td { (or_none(seam.stretch(), percent)) }
                    td.words.end { @if seam.is_closed() { span.good { (tr("closed")) } } @else { span.bad { (missing(seam)) } } }
                }
            } }
        }
    }
}

fn gather(ratio: f64) -> String {
    if ratio < 1.0 + ALIKE { NONE.to_owned() } else { format!("{} : 1", number(ratio, 2)) }
}

/// Why a seam is not closed.
fn missing(seam: &SeamFit) -> String {
    match seam.gap {
        Some(gap) => say!("open by {mm} mm", mm = number(gap * 1e3, 1)),
        None if seam.flat.contains(&None) => tr("one side is not there").to_owned(),
        None => tr("not sewn").to_owned(),
    }
}

/// Fabric, size and strain of each piece.
pub fn pieces(facts: &Facts) -> Markup {
    let spread = |stats: &MapStats, times: f64| {
        let value = |v: f64| minus(&number(v * times, 1));
        if stats.count == 0 {
            NONE.to_owned()
        } else {
            format!("{} … {}", value(stats.p01), value(stats.p99))
        }
    };
    let percents = 100.0;
    let degrees = 180.0 / std::f64::consts::PI;
    let garment = &facts.outfit.garment;
    html! {
        table {
            (head(2, &[
                tr("Piece"), tr("Fabric"), tr("Cloth, dm²"), tr("Area, %"), tr("Warp, %"), tr("Weft, %"), tr("Shear, °"),
            ]))
            tbody { @for (i, (id, name)) in garment.pieces.iter().enumerate() {
                @let change = facts.report.pieces.get(i);
                @let [warp, weft, shear] = facts.strains.each_ref().map(|pieces| &pieces[i].stats);
                tr {
                    th.words { (name) }
                    td.words { (facts.outfit.fabrics.get(id).map_or(NONE, |fabric| tr(&fabric.name))) }
                    td { (number(flat_area(facts, *id) * 100.0, 1)) }
                    td { (or_none(change.map(|change| change.area_change), percent)) }
                    td { (spread(warp, percents)) }
                    td { (spread(weft, percents)) }
                    td { (spread(shear, degrees)) }
                }
            } }
        }
    }
}

/// Flat area of a piece, m².
fn flat_area(facts: &Facts, id: PieceId) -> f64 {
    let garment = &facts.outfit.garment;
    let own = garment.rest.iter().zip(&garment.triangle_pieces).filter(|(_, piece)| **piece == id);
    own.map(|([a, b, c], _)| (b - a).perp_dot(c - a).abs() / 2.0).sum()
}

/// The properties of the garment's fabrics.
pub fn fabrics(facts: &Facts) -> Markup {
    let mut fabrics: Vec<&Fabric> = facts.outfit.fabrics.values().collect();
    fabrics.sort_by(|a, b| a.name.cmp(&b.name));
    fabrics.dedup();
    html! {
        table {
            (head(1, &[
                tr("Fabric"), "g/m²", tr("Warp, N/m"), tr("Weft, N/m"), tr("Shear, N/m"), tr("Bending, µN·m"),
                tr("Thickness, mm"),
            ]))
            tbody { @for fabric in fabrics {
                tr {
                    th.words { (tr(&fabric.name)) }
                    td { (number(fabric.density_kg_per_m2 * 1e3, 0)) }
                    td { (number(fabric.stretch.warp, 0)) }
                    td { (number(fabric.stretch.weft, 0)) }
                    td { (number(fabric.stretch.shear, 0)) }
                    td { (format!("{:.0} / {:.0}", fabric.bending.warp * 1e6, fabric.bending.weft * 1e6)) }
                    td { (number(fabric.thickness_m * 1e3, 2)) }
                }
            } }
        }
    }
}

/// The openings of the garment: hems, neck, cuffs.
pub fn openings(facts: &Facts) -> Markup {
    html! {
        table {
            (head(1, &[tr("Opening"), tr("Height"), tr("As worn"), ""]))
            tbody { @for (i, opening) in facts.report.openings.iter().enumerate() {
                tr {
                    th.words { (i + 1) }
                    td.weak { (cm(opening.height)) }
                    td { (cm(opening.length)) }
                    td.words.end { @if opening.body_through { span.good { (tr("the body passes through")) } }
                        @else { span.weak { (tr("the body does not pass through")) } } }
                }
            } }
        }
    }
}
