//! Paper B's mass-spring net against triangles of constant strain.

use glam::{DVec2, DVec3};
use toile::cloth::Fabric;
use toile::drape::forces::limits::StrainLimits;
use toile::drape::solver::settle::SettleSettings;
use toile::drape::{Elastic, Scene};

use super::meshes::{Flat, KINDS, Kind, flat, near, scene, settled};

/// Parallelogram of equilateral triangles with sides of 2 cm.
fn equilateral() -> Flat {
    let mut cloth = flat(Kind::Diagonal, DVec2::splat(0.2), [10, 10]);
    // The diagonals become the short ones.
    cloth.points.iter_mut().for_each(|p| *p = DVec2::new(p.x - 0.5 * p.y, 0.75f64.sqrt() * p.y));
    cloth
}

#[test]
fn a_net_of_equilateral_triangles_pulls_as_they_do() {
    let cloth = equilateral();
    let sheet = cloth.sheet();
    let fabric = Fabric::isotropic(1000.0, 1.0 / 3.0, 0.0, 0.2);
    // Any small strain: what differs is of its square.
    let x = cloth.placed(|p| DVec3::new(p.x + 2e-5 * p.x + 1e-5 * p.y, p.y - 3e-5 * p.y * (1.0 + p.x), 0.0));
    let forces = [Elastic::of_springs(&sheet, &fabric), Elastic::new(&sheet, &fabric, 1.0)].map(|elastic| {
        let mut force = vec![DVec3::ZERO; x.len()];
        elastic.add_gradient(&x, &mut force);
        force
    });
    let most = forces[1].iter().map(|f| f.length()).fold(0.0, f64::max);
    for (net, triangles) in forces[0].iter().zip(&forces[1]) {
        assert!(net.distance(*triangles) < 1e-3 * most, "{net} and {triangles} of {most}");
    }
}

/// Young's modulus over that of the fabric, and Poisson's ratio, of a strip pulled by a thousandth with free sides.
fn pulled(kind: Kind, elastic: impl Fn(&toile::drape::Sheet, &Fabric) -> Elastic) -> (f64, f64) {
    let size = DVec2::new(0.2, 0.4);
    let cloth = flat(kind, size, [10, 20]);
    let fabric = Fabric::isotropic(1000.0, 0.3, 0.0, 0.2);
    let ends = cloth.picked(|p| p.y < 1e-9 || p.y > size.y - 1e-9);
    let mut scene: Scene = scene(&cloth, &fabric, ends);
    scene.gravity = DVec3::ZERO;
    scene.elastic = elastic(&scene.sheet, &fabric);
    let settings = SettleSettings { scale: 1.0, ..SettleSettings::default() };
    let x = settled(&scene, &[], &settings, cloth.placed(|p| DVec3::new(p.x, 1.001 * p.y, 0.0)));
    let mut force = vec![DVec3::ZERO; x.len()];
    scene.elastic.add_gradient(&x, &mut force);
    let top = cloth.points.iter().zip(&force).filter(|(p, _)| p.y > size.y - 1e-9);
    let pull: f64 = top.map(|(_, f)| f.y).sum();
    // Away from the ends, which are held as wide as they are.
    let width = |side: f64| {
        let on_side = cloth
            .points
            .iter()
            .zip(&x)
            .filter(|(p, _)| (p.x - side).abs() < 1e-9 && (p.y - 0.2).abs() < 0.05);
        let (sum, count) = on_side.fold((0.0, 0.0), |(s, n), (_, x)| (s + x.x, n + 1.0));
        sum / count
    };
    let narrower = 1.0 - (width(size.x) - width(0.0)) / size.x;
    (pull / (size.x * 1000.0 * 1e-3), narrower / 1e-3)
}

/// The triangles have the fabric's stiffness on every mesh; the net is up to a fifth too soft or too stiff, and its Poisson's ratio
/// is anything from nearly none to a half. (The ends are held wide, which makes a strip of ν = 0.3 a little stiffer.)
#[test]
fn triangles_pull_alike_on_any_mesh_and_a_net_as_it_is_cut() {
    for kind in KINDS {
        let (stiffness, poisson) = pulled(kind, |sheet, fabric| Elastic::new(sheet, fabric, 1.0));
        near(&format!("{kind:?}: triangles"), stiffness, 1.02, 0.02);
        near(&format!("{kind:?}: triangles' ν"), poisson, 0.3, 0.05);
        let (stiffness, poisson) = pulled(kind, Elastic::of_springs);
        assert!((0.78..1.22).contains(&stiffness), "{kind:?}: net {stiffness}");
        assert!((0.04..0.55).contains(&poisson), "{kind:?}: net's ν {poisson}");
    }
}

#[test]
fn a_nets_hessian_is_its_gradients_slope() {
    let cloth = flat(Kind::Jittered, DVec2::splat(0.1), [3, 3]);
    let net = StrainLimits::net(&cloth.sheet(), 1000.0);
    let place = |p: DVec2| DVec3::new(0.97 * p.x, 1.02 * p.y, 0.1 * p.x * p.y);
    let x = cloth.placed(place);
    let count = x.len();
    let mut hessian = vec![glam::DMat3::ZERO; count * count];
    net.hessian(&x, true, |[a, b], block| {
        let at = |i: u32, j: u32| i as usize * count + j as usize;
        hessian[at(a, a)] += block;
        hessian[at(b, b)] += block;
        hessian[at(a, b)] -= block;
        hessian[at(b, a)] -= block;
    });
    let gradient = |x: &[DVec3]| {
        let mut gradient = vec![DVec3::ZERO; count];
        net.add_gradient(x, &mut gradient);
        gradient
    };
    let step = 1e-6;
    for (v, axis) in (0..count).flat_map(|v| [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| (v, axis))) {
        let moved = |by: f64| {
            let mut there = x.clone();
            there[v] += axis * by;
            gradient(&there)
        };
        for (w, (high, low)) in moved(step).into_iter().zip(moved(-step)).enumerate() {
            let slope = (high - low) / (2.0 * step);
            let told = hessian[w * count + v] * axis;
            assert!(slope.distance(told) < 1e-3 * 1000.0, "{w} by {v}: {slope} and {told}");
        }
    }
}
