//! The HTML of the fit report.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::fit::MapKind;
use crate::geometry::words::Words;
use crate::ui::fit_page::drawing::drawing;
use crate::ui::fit_page::facts::{Facts, MapFacts};
use crate::ui::fit_page::legend::{legend, minus};
use crate::ui::fit_page::pictures::Picture;
use crate::ui::fit_page::tables;
use crate::ui::fit_page::words::tight_words;
use crate::ui::language::{code, counted, number, said, say, tr};

const STYLE: &str = include_str!("style.css");
/// Content security policy: the page loads nothing, and its style is part of it.
const POLICY: &str = include_str!("policy.txt");

/// The HTML page. `left_out` is the reason why it has no pictures.
pub fn page(facts: &Facts, pictures: &[Picture], left_out: Option<&Words>) -> String {
    let title = say!("{name}: fit report", name = facts.name);
    html! {
        (DOCTYPE)
        html lang=(code().replace('_', "-")) {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="generator" content={ "Toile " (env!("CARGO_PKG_VERSION")) };
                title { (title) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                (header(facts))
                (verdict(facts))
                @if let Some(why) = left_out {
                    p.note { (say!("The pictures are left out: {why}.", why = said(why))) }
                }
                (views(pictures))
                (figures(facts))
                (girths(facts))
                (maps(facts, pictures))
                (pattern(facts))
                (body(facts))
                footer {
                    "Toile " (env!("CARGO_PKG_VERSION")) ". "
                    (tr("Lengths in centimetres, heights above the floor. Of each map 1 % and 99 % of the vertices lie below and above the two values given."))
                }
            }
        }
    }
    .into_string()
}

fn header(facts: &Facts) -> Markup {
    let what = say!(
        "{pieces} on {body}, {triangles} triangles of {mm} mm",
        pieces = counted(facts.outfit.garment.pieces.len(), "1 piece", "{n} pieces"),
        body = tr(&facts.body),
        triangles = facts.report.triangles,
        mm = number(facts.outfit.garment.mean_edge() * 1e3, 0)
    );
    html! {
        header {
            p.kind { (tr("Fit report")) }
            h1 { (facts.name) }
            p.sub { (what) }
        }
    }
}

fn verdict(facts: &Facts) -> Markup {
    html! {
        section.verdict.bad[!facts.problems.is_empty()] {
            @if facts.problems.is_empty() {
                p {
                    strong { (tr("Dressed.")) } " "
                    (tr("All seams are sewn, the cloth lies outside the body and the right way round."))
                }
            } @else {
                p { strong { (tr("Not right yet.")) } }
                ul { @for problem in &facts.problems {
                    li { strong { (said(&problem.place)) } ": " (said(&problem.words)) }
                } }
            }
            @if let Some(tight) = &facts.tight { p { (say!("Tightest: {place}", place = tight_words(tight))) } }
        }
    }
}

fn views(pictures: &[Picture]) -> Markup {
    html! {
        @if pictures.iter().any(|picture| picture.kind.is_none()) {
            section.views { @for picture in pictures.iter().filter(|picture| picture.kind.is_none()) {
                (figure(picture))
            } }
        }
    }
}

fn figure(picture: &Picture) -> Markup {
    let what = picture.kind.map_or_else(|| tr("The garment"), |kind| tr(kind.title()));
    let side = tr(picture.side);
    html! {
        figure {
            img src=(picture.source) width=(picture.size.x) height=(picture.size.y) alt={ (what) ", " (side) };
            figcaption { (side) }
        }
    }
}

/// The key figures of the garment.
fn figures(facts: &Facts) -> Markup {
    let report = &facts.report;
    let closed = facts.seams.iter().filter(|seam| seam.is_closed()).count();
    let weight: f64 = facts.outfit.garment.rest.iter().zip(&facts.outfit.garment.triangle_pieces).fold(
        0.0,
        |sum, ([a, b, c], piece)| {
            let density = facts.outfit.fabrics.get(piece).map_or(0.0, |fabric| fabric.density_kg_per_m2);
            sum + (b - a).perp_dot(c - a).abs() / 2.0 * density
        },
    );
    let pressure = facts.maps.iter().find(|map| map.map.kind == MapKind::Pressure).map(|map| map.map.stats());
    let all: [(String, &str, &str); 5] = [
        (say!("{closed} of {count}", closed, count = facts.seams.len()), "", tr("seams closed")),
        (number(report.strain.stretch_p99 * 100.0, 1), "%", tr("stretched where it is tightest")),
        (minus(&number(report.clearance.median * 1e3, 0)), "mm", tr("off the skin, half of it less")),
        (
            pressure.map_or_else(|| "–".to_owned(), |p| number(p.p99 / 1e3, 2)),
            "kPa",
            tr("on the skin where it presses most"),
        ),
        (number(weight * 1e3, 0), "g", tr("of cloth")),
    ];
    html! {
        section.figures { @for (value, unit, words) in all {
            div { p.value { (value) @if !unit.is_empty() { span { " " (unit) } } } p.weak { (words) } }
        } }
    }
}

fn girths(facts: &Facts) -> Markup {
    html! {
        section {
            h2 { (tr("Garment and body")) }
            @if facts.girths.is_empty() {
                p.weak { (tr("The cloth goes all the way round nowhere that the body is measured.")) }
            } @else {
                p.lead { (tr("Ease is what the pattern has round the body beyond the body's own girth.")) }
                (tables::girths(facts))
            }
            @if !facts.report.openings.is_empty() { (tables::openings(facts)) }
            (tables::strain_causes(&facts.report.strain_causes))
        }
    }
}

fn maps(facts: &Facts, pictures: &[Picture]) -> Markup {
    html! {
        section {
            h2 { (tr("Maps")) }
            @for map in facts.maps.iter().filter(|map| map.map.stats().count > 0) { (map_ui(map, pictures)) }
        }
    }
}

fn map_ui(map: &MapFacts, pictures: &[Picture]) -> Markup {
    let kind = map.map.kind;
    let ((unit, times), digits) = (kind.unit(), kind.digits());
    let stats = map.map.stats();
    let value = |v: f64| format!("{} {unit}", minus(&number(v * times, digits)));
    let words = say!(
        "Median {median}, from {from} to {to}",
        median = value(stats.median),
        from = value(stats.p01),
        to = value(stats.p99)
    );
    html! {
        div.map {
            div.words {
                h3 { (tr(kind.title())) }
                p { (tr(kind.tip())) "." }
                (legend(map))
                p.weak { (words) }
            }
            @for picture in pictures.iter().filter(|picture| picture.kind == Some(kind)) { (figure(picture)) }
        }
    }
}

fn pattern(facts: &Facts) -> Markup {
    html! {
        section {
            h2 { (tr("Pattern and seams")) }
            (drawing(&facts.outfit.source.pattern))
            @if !facts.seams.is_empty() { (tables::seams(facts)) }
        }
        section {
            h2 { (tr("Pieces and fabrics")) }
            (tables::pieces(facts))
            (tables::fabrics(facts))
        }
    }
}

fn body(facts: &Facts) -> Markup {
    html! {
        @if !facts.readings.is_empty() {
            section.together { h2 { (tr("Measures of the body")) } div.columns { (tables::readings(facts)) } }
        }
    }
}
