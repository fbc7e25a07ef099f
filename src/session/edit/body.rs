//! Commands that change the body.

use std::sync::Arc;

use crate::body::mannequin::Measurements;
use crate::contact::Bone;
use crate::geometry::mesh::TriMesh;
use crate::geometry::words::words;
use crate::pattern::Problem;
use crate::session::animations::{Animations, Moment};
use crate::session::body::{Body, BodyCache};
use crate::session::body_choice::BodyChoice;
use crate::session::carry::carried;
use crate::session::command::Rejection;
use crate::session::document::{Aim, Document};
use crate::session::edit::{ClothChange, Edit, checks};

/// Changes the body; strokes on the old one are transferred to it.
pub fn set(
    mut document: Document,
    body: &BodyChoice,
    animations: Option<&Arc<Animations>>,
    bodies: &mut BodyCache,
) -> Result<Edit, Rejection> {
    checks::body(body)?;
    if document.body == *body {
        return Err(Rejection(words!("that is the body already")));
    }
    let to = bodies.body(body)?;
    if let Some(animations) = animations {
        same_triangles((animations.mesh(), animations.name()), (&to.surface.mesh, body.name()))?;
    }
    document.drop_pins();
    let problems = replace(&mut document, body, &to, bodies);
    document.animations = animations.cloned();
    Ok(Edit { problems, ..Edit::new(words!("change the body"), document).with(ClothChange::Clear) })
}

/// Changes the measurements of the mannequin in its present pose; the cloth follows.
pub fn resize(
    mut document: Document,
    measurements: Measurements,
    bodies: &mut BodyCache,
) -> Result<Edit, Rejection> {
    let pose = document.body.pose();
    let pose = pose.ok_or_else(|| Rejection(words!("only the mannequin is built to measurements")))?;
    let built = BodyChoice::Mannequin(measurements);
    let body = built.posed(pose).unwrap_or(built);
    checks::body(&body)?;
    if document.body == body {
        return Err(Rejection(words!("that is its size already")));
    }
    let to = bodies.body(&body)?;
    let problems = replace(&mut document, &body, &to, bodies);
    Ok(Edit { problems, ..Edit::new(words!("change the size"), document).with(ClothChange::Resize) })
}

/// Replaces the document's body by `body`, which is `to`. Returns the strokes that were lost.
fn replace(document: &mut Document, body: &BodyChoice, to: &Body, bodies: &mut BodyCache) -> Vec<Problem> {
    let mut problems = Vec::new();
    if !document.marks.body.is_empty() {
        let from = bodies.body(&document.body).ok();
        let (marks, lost) = carried(&document.marks, from.as_deref(), to, body.name());
        document.marks = Arc::new(marks);
        problems = lost;
    }
    (document.bones, document.aim) = (None, None);
    (document.animations, document.moment) = (None, None);
    document.body = body.clone();
    problems
}

/// Changes the pose of the body; the cloth follows.
pub fn repose(
    mut document: Document,
    body: &BodyChoice,
    [settle, draft]: [bool; 2],
    bodies: &mut BodyCache,
) -> Result<Edit, Rejection> {
    checks::body(body)?;
    let (from, to) = (bodies.body(&document.body)?, bodies.body(body)?);
    same_triangles((&to.surface.mesh, body.name()), (&from.surface.mesh, document.body.name()))?;
    let (marks, problems) = carried(&document.marks, Some(&from), &to, body.name());
    document.marks = Arc::new(marks);
    // Bones drawn by hand stay where the old pose had them.
    (document.bones, document.moment) = (None, None);
    document.body = body.clone();
    Ok(Edit {
        problems,
        ..Edit::new(words!("change the pose"), document).with(ClothChange::Repose { settle, draft })
    })
}

/// Rejects a body that does not have the triangles of the present one.
fn same_triangles((to, other): (&TriMesh, &str), (from, own): (&TriMesh, &str)) -> Result<(), Rejection> {
    let counts = |mesh: &TriMesh| (mesh.positions.len(), mesh.triangles.len());
    if from.triangles == to.triangles {
        return Ok(());
    }
    let (is, was) = (counts(to), counts(from));
    let words = match is == was {
        true => words!("its triangles join other vertices"),
        false => words!(
            "it has {vertices} vertices and {triangles} triangles, the dressed one {own_vertices} and {own_triangles}",
            vertices = is.0,
            triangles = is.1,
            own_vertices = was.0,
            own_triangles = was.1
        ),
    };
    Err(Rejection(words!("{other} is not {own} in another pose: {words}", other, own, words)))
}

/// Sets the target pose.
pub fn aim(mut document: Document, body: &BodyChoice, bodies: &mut BodyCache) -> Result<Edit, Rejection> {
    checks::body(body)?;
    let (from, to) = (bodies.body(&document.body)?, bodies.body(body)?);
    same_triangles((&to.surface.mesh, body.name()), (&from.surface.mesh, document.body.name()))?;
    document.aim = Some(Arc::new(Aim { from: document.body.clone(), to: body.clone() }));
    Ok(Edit::new(words!("choose a pose"), document))
}

/// Moves the body to `share` of the way to the target pose; the cloth follows.
pub fn towards(
    document: Document,
    share: f64,
    draft: bool,
    bodies: &mut BodyCache,
) -> Result<Edit, Rejection> {
    if !(0.0..=1.0).contains(&share) {
        return Err(Rejection(words!("a share of the way is from 0 to 1, not {share}", share)));
    }
    let aim = document.aim.clone().ok_or_else(|| Rejection(words!("no pose from a file was chosen")))?;
    let body = bodies.between(&aim, share)?;
    repose(document, &body, [false, draft], bodies)
}

/// Takes animations for the body.
pub fn take_animations(
    mut document: Document,
    animations: &Arc<Animations>,
    bodies: &mut BodyCache,
) -> Result<Edit, Rejection> {
    let own = bodies.surface(&document.body)?;
    same_triangles((animations.mesh(), animations.name()), (&own.mesh, document.body.name()))?;
    (document.animations, document.moment) = (Some(Arc::clone(animations)), None);
    Ok(Edit::new(words!("take animations"), document))
}

/// Moves the body to a moment of its animations, or to rest; the cloth follows.
pub fn animate(
    document: Document,
    at: Option<Moment>,
    draft: bool,
    bodies: &mut BodyCache,
) -> Result<Edit, Rejection> {
    let animations = document.animations.as_ref();
    let animations = animations.ok_or_else(|| Rejection(words!("the body has no animations")))?;
    let body = animations.body(document.body.name(), at).map_err(Rejection)?;
    let mut edit = repose(document, &body, [false, draft], bodies)?;
    edit.document.moment = at;
    Ok(edit)
}

/// Sets bones drawn by the user, or returns to the body's own.
pub fn set_bones(mut document: Document, bones: Option<&[Bone]>) -> Result<Edit, Rejection> {
    bones.map_or(Ok(()), checks::bones)?;
    document.bones = bones.map(|bones| Arc::new(bones.to_vec()));
    Ok(Edit::new(words!("bones"), document))
}
