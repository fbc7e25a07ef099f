//! A scarf: one long strip laid round the neck, its ends hanging down in front.

use glam::{DVec2, DVec3};

use super::draft::{Outline, sheet, standing};
use super::form::Form;
use super::strokes::Strokes;
use crate::pattern::Pattern;
use crate::wrap::Marks;

/// Length and width, metres. A wider strip has to stretch round the neck.
const SIZE: DVec2 = DVec2::new(1.70, 0.13);

/// Pattern and marks of the scarf.
pub fn scarf(form: &Form) -> (Pattern, Marks) {
    let half = SIZE / 2.0;
    let mut piece = Outline::from(-half)
        .line("long lower", DVec2::new(half.x, -half.y))
        .line("end right", half)
        .line("long upper", DVec2::new(-half.x, half.y))
        .line("end left", -half)
        .piece("scarf");
    // Laid across the nape, its outer side to the back: the wearer's left is at -x.
    let nape = form.mark("neck_back");
    piece.placement = Some(standing(DVec3::new(0.0, nape.y, nape.z - 0.2), std::f64::consts::PI));
    let mut pattern = Pattern::default();
    let ids: Vec<_> = sheet(vec![vec![piece]]).into_iter().map(|p| pattern.add_piece(p)).collect();
    let path = path(form);
    let middle = path[path.len() / 2];
    let reach = half.x - 0.01;
    let body = form.part(&path, middle, -reach, reach);
    let mut strokes = Strokes::default();
    strokes.pair(ids[0], DVec2::new(-reach, 0.0), DVec2::new(reach, 0.0), body);
    (pattern, strokes.finish())
}

/// Stroke from the wearer's left front up over the breast and the shoulder, round the nape, and down the right front.
fn path(form: &Form) -> Vec<DVec3> {
    let (nape, neck) = (form.mark("neck_back"), form.mark("neck_side_left"));
    let shoulder = form.shoulder(neck.x + 0.030);
    let behind = |x: f64| form.skin(x, nape.y - 0.03, -1.0).unwrap_or(nape);
    let mut left =
        form.upright(form.mark("bust_point_left").x, form.mark("crotch").y - 0.20, shoulder.y - 0.045, 1.0);
    for next in [shoulder, behind(0.03), behind(0.0)] {
        let last = left[left.len() - 1];
        left.extend(form.straight(last, next).into_iter().skip(1));
    }
    let right: Vec<DVec3> = left.iter().rev().skip(1).map(|p| DVec3::new(-p.x, p.y, p.z)).collect();
    left.extend(right);
    left
}
