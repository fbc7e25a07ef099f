//! `toile repose`: carries the dressed garment to other poses of its body.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use crate::body::pose::anatomy::JointAngle;
use crate::cli::arguments::{InputOptions, Repose};
use crate::cli::failure::Failure;
use crate::cli::graphics::Graphics;
use crate::cli::report::Report;
use crate::cli::seconds::{Begun, Seconds};
use crate::cli::{dress_one, files, formats, input, interrupt, output, report, run};
use crate::io::joints;
use crate::session::{BodyChoice, Command, Notice, Session, project_file};
use crate::sim::StartChoice;

/// Carries the garment to each pose in turn, always from the dressed one. A pose that fails a check gives the exit code.
pub fn repose(arguments: &Repose) -> Result<(), Failure> {
    let several = count(arguments) > 1;
    if several && arguments.save.is_some() {
        return Err(Failure::Usage("--save takes one pose, not several".to_owned()));
    }
    if arguments.usd {
        return Err(Failure::Usage("--usd is of frames: give --sequence or --motion".to_owned()));
    }
    if arguments.textures.is_asked() {
        let words = "--textures, --atlas and --no-trims are of frames: give --sequence or --motion";
        return Err(Failure::Usage(words.to_owned()));
    }
    let start = Begun::now();
    let input = input::load(&arguments.project, &InputOptions::default())?;
    let poses = poses(arguments, &input.project.document.body)?;
    let mut session = run::opened(input.project, &arguments.project)?;
    let mut seconds = Seconds { load: start.seconds(), ..Seconds::default() };
    dress_first(&mut session, arguments, &mut seconds)?;
    let dressed = session.project();
    let mut graphics = Graphics::default();
    graphics.open();
    let (mut failures, all) = (Vec::new(), poses.len());
    for (i, (pose, from)) in poses.into_iter().enumerate() {
        let path = Path::new(&from);
        interrupt::check()?;
        let folder = if several { numbered(&arguments.out, i, path) } else { arguments.out.clone() };
        if arguments.drape && i > 0 {
            session = run::opened(dressed.clone(), &arguments.project)?;
        }
        let name = format!("{} on {}", input.name, files::name_of(path));
        let carried = one(&mut session, pose, path, arguments, seconds.clone());
        let mut report =
            report::report(&mut session, &name, Some((&arguments.picture, &mut graphics)), carried?)?;
        report.inputs = input.files.iter().cloned().chain([from.clone()]).collect();
        report.finish(&folder, start)?;
        let verdict = report.verdict()?;
        output::say(&match (arguments.json, several) {
            (true, _) => printed(&report, several)?,
            (false, true) => verdict.to_string(),
            (false, false) => verdict.summary(),
        });
        failures.extend(verdict.failure());
    }
    if let Some(path) = &arguments.save {
        project_file::save(path, &session.project()).map_err(|e| input::project_failure(path, e))?;
    }
    match failures.pop() {
        None => Ok(()),
        Some(_) if several => Err(Failure::not_dressed(failures.len() + 1, all)),
        Some(failure) => Err(failure),
    }
}

/// The number of poses that are given.
fn count(arguments: &Repose) -> usize {
    let Repose { bodies, poses, joints, joint_files, .. } = arguments;
    // `--joint` turns joints of the pose that `--pose` names, so both together count as one.
    let by_hand = joint_files.len() + usize::from(!joints.is_empty());
    bodies.len() + if by_hand > 0 { by_hand } else { poses.len() }
}

/// The poses that are given, each with its name: body files, named poses, joint files and joints.
fn poses(arguments: &Repose, dressed: &BodyChoice) -> Result<Vec<(BodyChoice, String)>, Failure> {
    let mut poses: Vec<(BodyChoice, String)> = Vec::new();
    for path in &arguments.bodies {
        poses.push((posed(path, arguments)?, path.display().to_string()));
    }
    let has_joints = !arguments.joints.is_empty() || !arguments.joint_files.is_empty();
    if has_joints && arguments.poses.len() > 1 {
        let words = "--joint turns the joints of one pose: name one with --pose, not several";
        return Err(Failure::Usage(words.to_owned()));
    }
    let mut base = dressed.clone();
    for &pose in &arguments.poses {
        let body = dressed.in_named_pose(pose);
        let words = "its body is from a file: only the mannequin takes a pose by name (--pose)";
        let body = body.ok_or_else(|| Failure::input(&arguments.project, words))?;
        match has_joints {
            true => base = body,
            false => poses.push((body, pose.name().to_owned())),
        }
    }
    for path in &arguments.joint_files {
        let angles = joints::read(&files::read(path)?).map_err(|e| Failure::input(path, e))?;
        poses.push((turned(&base, &angles, path)?, path.display().to_string()));
    }
    if !arguments.joints.is_empty() {
        poses.push((turned(&base, &arguments.joints, &arguments.project)?, "joints".to_owned()));
    }
    Ok(poses)
}

/// The mannequin of `base` with joints turned; `path` is for errors.
fn turned(base: &BodyChoice, angles: &[JointAngle], path: &Path) -> Result<BodyChoice, Failure> {
    let words = "its body is from a file: only the mannequin has joints to turn (--joint)";
    let (Some(anatomy), Some(pose)) = (base.anatomy(), base.pose()) else {
        return Err(Failure::input(path, words));
    };
    let pose = anatomy.with(&pose, angles).map_err(|why| Failure::input(path, why))?;
    base.posed(pose).ok_or_else(|| Failure::input(path, words))
}

fn printed(report: &Report, several: bool) -> Result<String, Failure> {
    if several { report.json_line() } else { report.json() }
}

/// The folder of the pose number `i`, such as "out/03-walk4" for the fourth pose, of the file "walk4.obj".
fn numbered(out: &Path, i: usize, path: &Path) -> PathBuf {
    out.join(format!("{i:02}-{}", files::name_of(path)))
}

fn posed(path: &Path, arguments: &Repose) -> Result<BodyChoice, Failure> {
    let body = formats::body(path, &files::read(path)?, arguments.body_file)?;
    if !body.is_usable() {
        let faults: Vec<&str> = body.problems.iter().map(|p| p.words.as_str()).collect();
        return Err(Failure::input(path, faults.join("; ")));
    }
    Ok(BodyChoice::Imported { name: files::name_of(path), mesh: Arc::new(body.mesh) })
}

/// Dresses a project without dressed cloth as `toile dress` would.
pub fn dress_first(session: &mut Session, arguments: &Repose, seconds: &mut Seconds) -> Result<(), Failure> {
    if session.snapshot().is_dressed() {
        return Ok(());
    }
    output::complain(&format!("{}: not dressed yet: dressing it first", arguments.project.display()));
    let choice = StartChoice { only: None, draped: arguments.drape };
    dress_one::dress_by(session, &arguments.project, choice, seconds)?;
    run::to_rest(session, arguments.max_ticks, seconds)
}

/// Carries the cloth to `pose` and writes the results; `path` is for errors.
fn one(
    session: &mut Session,
    pose: BodyChoice,
    path: &Path,
    arguments: &Repose,
    mut seconds: Seconds,
) -> Result<Seconds, Failure> {
    let start = Instant::now();
    if session.document().body != pose {
        carry(session, pose, path, arguments.settle)?;
        seconds.repose = Some(start.elapsed().as_secs_f64());
        run::to_rest(session, arguments.max_ticks, &mut seconds)?;
    }
    if arguments.drape {
        run::drape(session, path, arguments.max_ticks, &mut seconds)?;
    }
    Ok(seconds)
}

/// Begins to carry the cloth to `pose`.
fn carry(session: &mut Session, pose: BodyChoice, path: &Path, settle: bool) -> Result<(), Failure> {
    let command = Command::Repose { body: pose, settle, draft: false };
    session.apply_alone(command).map_err(|why| Failure::input(path, why))?;
    for notice in session.update() {
        if let Notice::Failed { words, .. } = notice {
            return Err(Failure::input(path, words));
        }
    }
    Ok(())
}
