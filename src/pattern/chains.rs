//! Internal lines that the mesh follows, sampled as chains of points: fold lines, wrinkles and others.

use glam::DVec2;

use crate::geometry::polygon::distance_to_segment;
use crate::pattern::cut::LINE_TOUCHES;
use crate::pattern::{InternalLine, Piece, curve};

/// Distance from a place where lines meet, or from the outline, within which other points of a line are left out, in edge lengths.
const CLEARANCE: f64 = 0.35;
/// Distance within which an end of a line is moved to a point of the outline, in [`LINE_TOUCHES`].
const SNAP: f64 = 2.5;

/// A side of a chain, which an edge of the mesh follows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// Its ends, metres in the piece's own plane.
    pub ends: [DVec2; 2],
    /// Number of the internal line.
    pub line: usize,
    /// Number of the edge of that line.
    pub edge: usize,
}

/// A point of a chain.
#[derive(Clone, Copy, Debug)]
struct Node {
    at: DVec2,
    /// Edge of the line that begins here or goes on here.
    edge: usize,
    /// Whether it stays where points are left out: an end, a corner, or where lines meet.
    stays: bool,
}

/// The links of all lines of `piece` that the mesh must follow, about `edge_length` metres long, shorter in narrow wrinkles. Where
/// lines meet they have a common point. `outline` holds the sides of the sampled closed lines and `inside` tells what they enclose;
/// what is outside is left out.
pub fn links(
    piece: &Piece,
    edge_length: f64,
    outline: &[[DVec2; 2]],
    inside: impl Fn(DVec2) -> bool,
) -> Vec<Link> {
    let lines: Vec<usize> = (0..piece.lines.len()).filter(|&k| piece.lines[k].needs_mesh()).collect();
    let mut chains: Vec<Vec<Node>> =
        lines.iter().map(|&k| sampled(&piece.lines[k], edge_length, outline)).collect();
    for i in 0..chains.len() {
        for j in 0..i {
            let (before, from) = chains.split_at_mut(i);
            meet(&mut before[j], &mut from[0]);
        }
    }
    let mut links = Vec::new();
    for (&line, chain) in lines.iter().zip(&chains) {
        let chain = thinned(chain, spacing(&piece.lines[line], edge_length) * CLEARANCE, outline);
        for pair in chain.windows(2) {
            let ends = [pair[0].at, pair[1].at];
            let is_free = outline.iter().all(|side| crossing(ends, *side).is_none());
            let trims = piece.lines[line].edges[pair[0].edge].trims;
            if ends[0] != ends[1] && inside(ends[0].midpoint(ends[1])) && is_free && trims.needs_mesh() {
                links.push(Link { ends, line, edge: pair[0].edge });
            }
        }
    }
    links
}

/// Length of the links of a line, metres: `edge_length`, or shorter as its narrowest wrinkle needs.
fn spacing(line: &InternalLine, edge_length: f64) -> f64 {
    let wrinkles = line.edges.iter().filter_map(|edge| edge.trims.wrinkle);
    wrinkles.map(|wrinkle| wrinkle.spacing()).fold(edge_length, f64::min)
}

/// Points on a line; its ends are moved to points of the outline that are near.
fn sampled(line: &InternalLine, edge_length: f64, outline: &[[DVec2; 2]]) -> Vec<Node> {
    let spacing = spacing(line, edge_length);
    let mut nodes = Vec::new();
    for (i, edge) in line.edges.iter().enumerate() {
        let end = line.edge_end(i);
        let count = ((curve::exact_length(edge.start, edge.shape, end) / spacing).round() as usize).max(1);
        let fractions: Vec<f64> = (0..count).map(|n| n as f64 / count as f64).collect();
        let points = curve::points(edge.start, edge.shape, end, &fractions);
        nodes.extend(points.into_iter().enumerate().map(|(n, at)| Node { at, edge: i, stays: n == 0 }));
    }
    nodes.push(Node { at: line.end, edge: line.edges.len() - 1, stays: true });
    let count = nodes.len();
    for n in [0, count - 1] {
        let near = outline.iter().map(|side| side[0]);
        let near = near.min_by(|a, b| a.distance(nodes[n].at).total_cmp(&b.distance(nodes[n].at)));
        if let Some(near) = near.filter(|p| p.distance(nodes[n].at) <= SNAP * LINE_TOUCHES) {
            nodes[n].at = near;
        }
    }
    nodes
}

/// Gives two chains a common point wherever they cross, or one ends on the other.
fn meet(one: &mut Vec<Node>, other: &mut Vec<Node>) {
    let mut i = 0;
    while i + 1 < one.len() {
        let mut j = 0;
        while j + 1 < other.len() {
            let (a, b) = ([one[i].at, one[i + 1].at], [other[j].at, other[j + 1].at]);
            let shared = a.iter().any(|p| b.contains(p));
            let found = touching(a, b).filter(|_| !shared);
            if let Some(at) = found {
                put(one, i, at);
                put(other, j, at);
            }
            j += 1;
        }
        i += 1;
    }
}

/// The common point of two segments; an end of one that is near the other counts.
fn touching(a: [DVec2; 2], b: [DVec2; 2]) -> Option<DVec2> {
    let on = |p: DVec2, [c, d]: [DVec2; 2]| distance_to_segment(p, c, d) < LINE_TOUCHES;
    let end = a.into_iter().find(|&p| on(p, b)).or_else(|| b.into_iter().find(|&p| on(p, a)));
    end.or_else(|| crossing(a, b))
}

/// The point in which two segments cross, away from their ends.
fn crossing([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> Option<DVec2> {
    let (u, v) = (b - a, d - c);
    let turn = u.perp_dot(v);
    let (s, t) = ((c - a).perp_dot(v) / turn, (c - a).perp_dot(u) / turn);
    let within = |f: f64, length: f64| f * length > 1e-9 && (1.0 - f) * length > 1e-9;
    (turn != 0.0 && within(s, u.length()) && within(t, v.length())).then(|| a + u * s)
}

/// Makes `at` a point of the chain on its side `i`: an end that is near moves there.
fn put(chain: &mut Vec<Node>, i: usize, at: DVec2) {
    let near = [i, i + 1].into_iter().find(|&n| chain[n].at.distance(at) < LINE_TOUCHES);
    match near {
        Some(n) => (chain[n].at, chain[n].stays) = (at, true),
        None => chain.insert(i + 1, Node { at, edge: chain[i].edge, stays: true }),
    }
}

/// The chain without points that are nearer than `clearance` metres to one that stays, or to the outline.
fn thinned(chain: &[Node], clearance: f64, outline: &[[DVec2; 2]]) -> Vec<Node> {
    let kept = |n: usize| {
        let node = &chain[n];
        let near = |other: &Node| other.stays && other.at.distance(node.at) < clearance;
        let is_near_outline =
            || outline.iter().any(|[a, b]| distance_to_segment(node.at, *a, *b) < clearance);
        node.stays || !(chain.iter().any(near) || is_near_outline())
    };
    (0..chain.len()).filter(|&n| kept(n)).map(|n| chain[n]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::{Edge, Fold, InternalLine, Trims};

    fn line(points: &[(f64, f64)]) -> InternalLine {
        let trims = Trims::from(Fold::pressed(1.0));
        let at = |p: &(f64, f64)| DVec2::new(p.0, p.1);
        let edges =
            points[..points.len() - 1].iter().map(|p| Edge { start: at(p), trims, ..Edge::default() });
        InternalLine { edges: edges.collect(), end: at(&points[points.len() - 1]), ..InternalLine::default() }
    }

    #[test]
    fn lines_that_cross_have_a_common_point_and_no_short_links() {
        let lines = vec![line(&[(0.0, 0.1), (0.2, 0.1)]), line(&[(0.093, 0.0), (0.093, 0.2)])];
        let piece = Piece { lines, ..Piece::default() };
        let links = links(&piece, 0.02, &[], |_| true);
        let at = |line: usize| links.iter().filter(move |l| l.line == line).flat_map(|l| l.ends);
        let common: Vec<DVec2> = at(0).filter(|p| at(1).any(|q| q == *p)).collect();
        assert!(common.len() == 2 && common[0].distance(DVec2::new(0.093, 0.1)) < 1e-12, "{common:?}");
        let long = |l: &Link| l.ends[0].distance(l.ends[1]);
        assert!(links.iter().all(|l| (0.007..0.036).contains(&long(l))), "{links:?}");
        let whole: f64 = links.iter().map(long).sum();
        assert!((whole - 0.4).abs() < 1e-12, "{whole}");
    }
}
