//! The section of sizes: the size run, the shown size, and the grade rules of selected points.

use egui::accesskit::Role;
use egui::{Button, Grid, Key, RichText, TextEdit, WidgetInfo};
use glam::DVec2;

use crate::pattern::edit::PatternEdit;
use crate::pattern::grading::READY_SIZES;
use crate::pattern::{GradeRule, Piece, RulePoint, SizeRun};
use crate::session::Command;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::language::{said, say, tr};
use crate::ui::panels::context::{PanelContext, problem_row};
use crate::ui::panels::fields::length_field;
use crate::ui::pattern_pane::line_points::points_of;
use crate::ui::pattern_pane::nests::{SizeView, size_colour};

/// Most seams that are told.
const MOST_TOLD: usize = 6;

/// State of the section between frames.
#[derive(Debug, Default)]
pub struct SizesPanel {
    /// The names being typed, and those they are to replace.
    typed: Option<(Vec<String>, String)>,
    /// Why what was typed last is no size run.
    wrong: Option<String>,
    /// A copied rule, by the grain of its piece.
    copied: Option<GradeRule>,
}

fn ask(edit: PatternEdit) -> Ask {
    Ask::Do(Command::EditPattern { edits: vec![edit], anew: false })
}

impl SizesPanel {
    /// Draws the section.
    pub fn ui(&mut self, ui: &mut egui::Ui, told: &PanelContext<'_>, asks: &mut Asks) {
        let sizes = &told.document.pattern.sizes;
        if sizes.is_empty() {
            let words = tr("None yet. With sizes, points get rules that say how far they move in each.");
            ui.add(egui::Label::new(RichText::new(words).color(told.palette.weak).size(12.5)).wrap());
            ready_ui(ui, sizes, tr("Choose sizes…"), asks);
            return;
        }
        shown_ui(ui, told, asks);
        self.run_ui(ui, told, asks);
        ui.separator();
        self.rule_ui(ui, told, asks);
        problems_ui(ui, told, asks);
    }

    /// The names of the sizes as text, and the choice of the base.
    fn run_ui(&mut self, ui: &mut egui::Ui, told: &PanelContext<'_>, asks: &mut Asks) {
        let sizes = &told.document.pattern.sizes;
        let (of, text) = self.typed.get_or_insert_with(|| (sizes.names.clone(), sizes.names.join(", ")));
        if *of != sizes.names {
            (*of, *text) = (sizes.names.clone(), sizes.names.join(", "));
        }
        let label = ui.label(RichText::new(tr("Names")).color(told.palette.weak).size(12.5));
        let field = ui.add(TextEdit::singleline(text).desired_width(f32::INFINITY)).labelled_by(label.id);
        let tip = tr("Names from small to large, with commas between; Enter takes them");
        let field = field.on_hover_text(tip);
        let given_up = ui.input(|i| i.key_pressed(Key::Escape));
        if field.lost_focus() && !given_up && *text != sizes.names.join(", ") {
            self.wrong = match typed(text, sizes) {
                Ok(new) => {
                    asks.push(ask(PatternEdit::SetSizes { sizes: new }));
                    None
                }
                Err(words) => Some(words),
            };
        } else if !field.has_focus() && self.wrong.is_none() {
            *text = sizes.names.join(", ");
        }
        if let Some(words) = &self.wrong {
            ui.add(egui::Label::new(RichText::new(words).color(told.palette.error).size(12.5)).wrap());
        }
        ui.horizontal_wrapped(|ui| {
            ready_ui(ui, sizes, tr("Change…"), asks);
            ui.menu_button(say!("Base {size}", size = sizes.base_name()), |ui| {
                for (base, name) in sizes.names.iter().enumerate() {
                    let tip = tr("What is drawn is this size from now on");
                    let text = say!("{size} is the base", size = name);
                    if ui.selectable_label(base == sizes.base, text).on_hover_text(tip).clicked() {
                        asks.push(ask(PatternEdit::SetSizes { sizes: SizeRun { base, ..sizes.clone() } }));
                        ui.close();
                    }
                }
            });
            let tip = tr("Remove all sizes and their rules");
            if ui.small_button(tr("Remove sizes")).on_hover_text(tip).clicked() {
                asks.push(ask(PatternEdit::SetSizes { sizes: SizeRun::default() }));
            }
        });
    }

    /// The rule of the selected points in numbers.
    fn rule_ui(&mut self, ui: &mut egui::Ui, told: &PanelContext<'_>, asks: &mut Asks) {
        let pattern = &*told.document.pattern;
        let points = selected(told);
        let first = points.first().and_then(|at| Some((*at, &**pattern.pieces.get(&at.piece)?)));
        let Some((point, piece)) = first.filter(|(at, piece)| piece.place_of(at).is_some()) else {
            let words = tr("Select points (Edit points) to see and set their rules.");
            ui.add(egui::Label::new(RichText::new(words).color(told.palette.weak).size(12.5)).wrap());
            return;
        };
        let is_own = piece.rule_of(&point).is_some();
        ui.label(heading(piece, point, points.len() - 1));
        let Some(rule) = told.nests.rule(point) else { return };
        let seen = rule.by_grain(piece.grain());
        if let Some(new) = rule_grid(ui, told, &seen, is_own) {
            asks.push(set(told, &points, Some(&new)));
        }
        ui.horizontal_wrapped(|ui| {
            let tip = tr("Keep this rule to give it to other points");
            if ui.small_button(tr("Copy rule")).on_hover_text(tip).clicked() {
                self.copied = Some(seen.clone());
            }
            let fits = self
                .copied
                .as_ref()
                .filter(|copied| copied.problem(pattern.sizes.len(), pattern.sizes.base).is_none());
            for (text, tip, map) in PASTES {
                let button = ui.add_enabled(fits.is_some(), Button::new(tr(text)).small());
                if button.on_hover_text(tr(tip)).on_disabled_hover_text(tr("Copy a rule first")).clicked()
                    && let Some(copied) = fits
                {
                    asks.push(set(told, &points, Some(&copied.mapped(map))));
                }
            }
            let has_rule = |at: &RulePoint| pattern.pieces.get(&at.piece)?.rule_of(at);
            let has_any = points.iter().any(|at| has_rule(at).is_some());
            let clear = ui.add_enabled(has_any, Button::new(tr("Clear rule")).small());
            if clear.on_hover_text(tr("Remove the rules of the selected points")).clicked() {
                asks.push(set(told, &points, None));
            }
        });
    }
}

/// The points whose rules are shown and set: the selected ones, or where there are none those of selected internal lines.
fn selected(told: &PanelContext<'_>) -> Vec<RulePoint> {
    let points: Vec<RulePoint> = told.selection.all_points().collect();
    if !points.is_empty() {
        return points;
    }
    let lines = told.selection.lines.iter();
    lines.flat_map(|line| points_of(&told.document.pattern, *line)).collect()
}

/// Whose rule is shown: that of a point, for so many `more`.
fn heading(piece: &Piece, RulePoint { line, point, .. }: RulePoint, more: usize) -> String {
    let (piece, number) = (&piece.name, point + 1);
    match (line.map(|line| line + 1), more) {
        (None, 0) => say!("Rule of {piece}, point {number}", piece, number),
        (None, more) => say!("Rule of {piece}, point {number} and {more} more", piece, number, more),
        (Some(line), 0) => say!("Rule of {piece}, line {line}, point {number}", piece, line, number),
        (Some(line), more) => {
            say!("Rule of {piece}, line {line}, point {number} and {more} more", piece, line, number, more)
        }
    }
}

/// Ways to give a copied rule to other points: text, tip, and what becomes of a displacement across and along the grain.
type Paste = (&'static str, &'static str, fn(DVec2) -> DVec2);

const PASTES: [Paste; 3] = [
    ("Paste rule", "Give the copied rule to the selected points", |by| by),
    ("Mirrored across", "Paste it mirrored across the grain: left becomes right", |by| {
        DVec2::new(0.0 - by.x, by.y)
    }),
    ("Mirrored along", "Paste it mirrored along the grain: up becomes down", |by| {
        DVec2::new(by.x, 0.0 - by.y)
    }),
];

/// The request that gives all of `points` a rule, seen by the grain; None removes theirs.
fn set(told: &PanelContext<'_>, points: &[RulePoint], rule: Option<&GradeRule>) -> Ask {
    let rules = points.iter().filter_map(|at| {
        let piece = told.document.pattern.pieces.get(&at.piece)?;
        Some((*at, rule.map(|rule| rule.from_grain(piece.grain()))))
    });
    ask(PatternEdit::SetRules { rules: rules.collect() })
}

/// A row for each size with the displacement across and along the grain. Returns the rule with a newly entered number.
fn rule_grid(
    ui: &mut egui::Ui,
    told: &PanelContext<'_>,
    seen: &GradeRule,
    is_own: bool,
) -> Option<GradeRule> {
    let sizes = &told.document.pattern.sizes;
    let unit = told.now.unit;
    let mut new = None;
    Grid::new("grade rule").num_columns(3).spacing([6.0, 3.0]).show(ui, |ui| {
        for heading in ["", "Across", "Along"] {
            ui.label(RichText::new(tr(heading)).color(told.palette.weak).size(12.5));
        }
        ui.end_row();
        let even = ui.label(RichText::new(tr("Each step")).size(12.5));
        let even = even.on_hover_text(tr("The same step from every size to the next"));
        let step = step_of(seen, sizes);
        for axis in 0..2 {
            if let Some(to) = length_field(ui, ("step", axis), &even, step[axis], unit) {
                let mut by = step;
                by[axis] = to;
                let mut rule = GradeRule::even(by, sizes.len(), sizes.base);
                // The other direction may have steps of different length: they stay.
                for (size, at) in rule.0.iter_mut().enumerate() {
                    at[1 - axis] = seen.at(size)[1 - axis];
                }
                new = Some(rule);
            }
        }
        ui.end_row();
        for (size, name) in sizes.names.iter().enumerate() {
            let ink = size_colour(told.palette, size, sizes.len());
            if size == sizes.base {
                ui.label(RichText::new(name).strong());
                ui.label(RichText::new(tr("base")).color(told.palette.weak).size(12.5));
                ui.end_row();
                continue;
            }
            let label = ui.label(RichText::new(name).strong().color(ink));
            for axis in 0..2 {
                if let Some(to) = length_field(ui, ("rule", size, axis), &label, seen.at(size)[axis], unit) {
                    let mut rule = seen.clone();
                    if let Some(by) = rule.0.get_mut(size) {
                        by[axis] = to;
                        new = Some(rule);
                    }
                }
            }
            ui.end_row();
        }
    });
    if !is_own && !seen.is_still() {
        let words = tr("It follows the points beside it; a number gives it a rule of its own.");
        ui.add(egui::Label::new(RichText::new(words).color(told.palette.weak).size(12.5)).wrap());
    }
    new
}

/// The step from the base to the next size.
fn step_of(seen: &GradeRule, sizes: &SizeRun) -> DVec2 {
    match sizes.base + 1 < sizes.len() {
        true => seen.at(sizes.base + 1),
        false => -seen.at(sizes.base.saturating_sub(1)),
    }
}

/// The size run that was typed, with the same base where it is among the names, else the one in its place.
fn typed(text: &str, old: &SizeRun) -> Result<SizeRun, String> {
    let names: Vec<String> =
        text.split(',').map(|name| name.trim().to_owned()).filter(|name| !name.is_empty()).collect();
    if names.is_empty() {
        return Err(tr("a size run has at least one name; Remove takes all sizes away").to_owned());
    }
    let base = names.iter().position(|name| name == old.base_name());
    let base = base.unwrap_or_else(|| old.base.min(names.len() - 1));
    let sizes = SizeRun { names, base };
    sizes.problem().map_or(Ok(sizes), |why| Err(said(&why)))
}

/// A list of the size runs that are offered.
fn ready_ui(ui: &mut egui::Ui, sizes: &SizeRun, text: &str, asks: &mut Asks) {
    ui.menu_button(text, |ui| {
        for ready in READY_SIZES {
            let run = ready.run();
            if ui.selectable_label(*sizes == run, tr(ready.title)).clicked() {
                asks.push(ask(PatternEdit::SetSizes { sizes: run }));
                ui.close();
            }
        }
    });
}

/// The sizes as buttons in their colours: a click shows one, whose points are then moved.
fn shown_ui(ui: &mut egui::Ui, told: &PanelContext<'_>, asks: &mut Asks) {
    let sizes = &told.document.pattern.sizes;
    let SizeView { nested, .. } = told.sizes;
    let shown = told.sizes.of(&told.document.pattern).unwrap_or(sizes.base);
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 2.0;
        for (size, name) in sizes.names.iter().enumerate() {
            let is_base = size == sizes.base;
            let text = RichText::new(name);
            let text = if is_base { text.strong() } else { text.color(size_colour(told.palette, size, sizes.len())) };
            let tip = match is_base {
                true => tr("The base size, in which the pattern is drawn"),
                false => tr("Show this size: points that are moved then (Edit points) get rules; with Shift the same step in all sizes"),
            };
            let button = ui.selectable_label(size == shown, text).on_hover_text(tip);
            let words = say!("Show size {size}", size = name);
            button.widget_info(|| WidgetInfo::selected(Role::Button, true, size == shown, words.clone()));
            if button.clicked() {
                asks.push(Ask::ShowSizes(SizeView { nested, shown: (!is_base).then_some(size) }));
            }
        }
    });
    let mut all = nested;
    if ui.checkbox(&mut all, tr("Draw all sizes")).on_hover_text(tr("Nested outlines on the table")).changed()
    {
        asks.push(Ask::ShowSizes(SizeView { nested: all, ..told.sizes }));
    }
}

/// What cannot be cut, and seams whose sides grow apart.
fn problems_ui(ui: &mut egui::Ui, told: &PanelContext<'_>, asks: &mut Asks) {
    for problem in &told.nests.problems {
        let words = said(&problem.in_words());
        problem_row(ui, told.palette.error, &words, None, asks);
    }
    let pattern = &*told.document.pattern;
    let (unit, mut told_of) = (told.now.unit, 0);
    for (id, seam) in &pattern.seams {
        let apart = || told.nests.growth.iter().filter(|growth| growth.seam == *id);
        if apart().next().is_none() || told_of == MOST_TOLD {
            continue;
        }
        told_of += 1;
        let each: Vec<String> =
            apart().map(|growth| format!("{} {}", growth.size, unit.number(growth.change))).collect();
        let words = say!(
            "{seam}: the first side outgrows the second ({unit}): {each}",
            seam = crate::ui::pattern_pane::seam_words(pattern, seam),
            unit = unit.sign(),
            each = each.join(", ")
        );
        problem_row(ui, told.palette.warning, &words, None, asks);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn typed_names_become_a_run_with_the_old_base() {
        let old = SizeRun::new(["S", "M", "L"], "M").expect("a run");
        let new = typed(" XS, S,M , L,", &old).expect("a run");
        assert_eq!((new.names.join(" "), new.base), ("XS S M L".to_owned(), 2));
        assert_eq!(typed("36, 38", &old).expect("a run").base, 1, "the one in its place");
        assert!(typed("S, S", &old).expect_err("twice").contains("two sizes S"));
        assert!(typed(" , ", &old).is_err());
    }
}
