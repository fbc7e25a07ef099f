//! The body.

use std::sync::Arc;

use crate::contact::Bone;
use crate::session::body::{Body, BodyCache};
use crate::session::carry::carried;
use crate::session::command::Rejection;
use crate::session::document::{Aim, BodyChoice, Document};
use crate::session::edit::{ClothChange, Edit, checks};

/// Strokes on the old body are carried to the new one.
pub fn set(mut document: Document, body: &BodyChoice, bodies: &mut BodyCache) -> Result<Edit, Rejection> {
    checks::body(body)?;
    if document.body == *body {
        return Err(Rejection::new("that is the body already"));
    }
    let to = bodies.body(body)?;
    let mut problems = Vec::new();
    if !document.marks.body.is_empty() {
        let from = bodies.body(&document.body).ok();
        let (marks, lost) = carried(&document.marks, from.as_deref(), &to, body.name());
        document.marks = Arc::new(marks);
        problems = lost;
    }
    document.drop_pins();
    (document.bones, document.aim) = (None, None);
    document.body = body.clone();
    Ok(Edit { problems, ..Edit::new("change the body", document).with(ClothChange::Clear) })
}

/// The same body in another pose; the cloth goes along.
pub fn repose(
    mut document: Document,
    body: &BodyChoice,
    [settle, draft]: [bool; 2],
    bodies: &mut BodyCache,
) -> Result<Edit, Rejection> {
    checks::body(body)?;
    let (from, to) = (bodies.body(&document.body)?, bodies.body(body)?);
    same_triangles((&to, body), (&from, &document.body))?;
    let (marks, problems) = carried(&document.marks, Some(&from), &to, body.name());
    document.marks = Arc::new(marks);
    // Bones drawn by hand stay where the old pose had them.
    document.bones = None;
    document.body = body.clone();
    Ok(Edit {
        problems,
        ..Edit::new("change the pose", document).with(ClothChange::Repose { settle, draft })
    })
}

/// Another body must be the dressed one in another pose.
fn same_triangles(
    (to, other): (&Body, &BodyChoice),
    (from, own): (&Body, &BodyChoice),
) -> Result<(), Rejection> {
    let counts = |body: &Body| (body.surface.mesh.positions.len(), body.surface.mesh.triangles.len());
    if from.surface.mesh.triangles == to.surface.mesh.triangles {
        return Ok(());
    }
    let (is, was) = (counts(to), counts(from));
    let words = match is == was {
        true => "its triangles join other vertices".to_owned(),
        false => format!(
            "it has {} vertices and {} triangles, the dressed one {} and {}",
            is.0, is.1, was.0, was.1
        ),
    };
    Err(Rejection(format!("{} is not {} in another pose: {words}", other.name(), own.name())))
}

/// Another pose of the body, to be led to.
pub fn aim(mut document: Document, body: &BodyChoice, bodies: &mut BodyCache) -> Result<Edit, Rejection> {
    checks::body(body)?;
    let (from, to) = (bodies.body(&document.body)?, bodies.body(body)?);
    same_triangles((&to, body), (&from, &document.body))?;
    document.aim = Some(Arc::new(Aim { from: document.body.clone(), to: body.clone() }));
    Ok(Edit::new("choose a pose", document))
}

/// The body so far on the way to that pose; the cloth goes along.
pub fn towards(
    document: Document,
    share: f64,
    draft: bool,
    bodies: &mut BodyCache,
) -> Result<Edit, Rejection> {
    if !(0.0..=1.0).contains(&share) {
        return Err(Rejection(format!("a share of the way is from 0 to 1, not {share}")));
    }
    let aim = document.aim.clone().ok_or_else(|| Rejection::new("no pose from a file was chosen"))?;
    let body = bodies.between(&aim, share)?;
    repose(document, &body, [false, draft], bodies)
}

/// Bones drawn by the user, or the body's own again.
pub fn set_bones(mut document: Document, bones: Option<&[Bone]>) -> Result<Edit, Rejection> {
    bones.map_or(Ok(()), checks::bones)?;
    document.bones = bones.map(|bones| Arc::new(bones.to_vec()));
    Ok(Edit::new("bones", document))
}
