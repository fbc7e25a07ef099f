//! B10: constant strain and constant curvature; gradients against differences.

use glam::{DMat3, DVec2, DVec3};
use toile::cloth::Fabric;
use toile::drape::forces::bending::Bending;
use toile::drape::forces::membrane::Membrane;

use super::meshes::{KINDS, flat, near};

fn turned() -> DMat3 {
    DMat3::from_axis_angle(DVec3::new(1.0, 2.0, -0.5).normalize(), 1.1)
}

#[test]
fn a_constant_strain_has_its_energy_on_any_mesh() {
    let fabric = Fabric::isotropic(1000.0, 0.3, 0.0, 0.2);
    let [c11, c22, c12, shear] = fabric.stretch.tangent();
    for kind in KINDS {
        let flat = flat(kind, DVec2::new(0.3, 0.4), [5, 6]);
        let (sx, sy, k) = (1.02, 0.99, 0.013);
        let x = flat.placed(|p| turned() * DVec3::new(sx * p.x + k * p.y, sy * p.y, 0.0));
        let e = [(sy * sy + k * k - 1.0) / 2.0, (sx * sx - 1.0) / 2.0, sx * k];
        let exact = 0.12
            * (c11 * e[0] * e[0] + c22 * e[1] * e[1] + 2.0 * c12 * e[0] * e[1] + shear * e[2] * e[2])
            / 2.0;
        let membrane = Membrane::new(&flat.sheet(), fabric.stretch.tangent(), 1.0);
        near(&format!("{kind:?}"), membrane.energy(&x), exact, 1e-9);
        let mut force = vec![DVec3::ZERO; x.len()];
        membrane.add_gradient(&x, &mut force);
        for (p, f) in flat.points.iter().zip(&force) {
            let inner = p.x > 1e-9 && p.y > 1e-9 && p.x < 0.3 - 1e-9 && p.y < 0.4 - 1e-9;
            assert!(!inner || f.length() < 1e-9, "{kind:?}: {f} N inside");
        }
    }
}

#[test]
fn a_cylinder_bends_with_its_energy_on_any_mesh_in_any_direction() {
    let fabric = Fabric::isotropic(1000.0, 0.3, 2e-5, 0.2);
    for kind in KINDS {
        let flat = flat(kind, DVec2::new(0.4, 0.4), [32, 32]);
        let bending = Bending::new(&flat.sheet(), &fabric.bending);
        for degrees in [0.0, 22.5, 45.0, 67.5, 90.0f64] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let radius = 0.5;
            let x = flat.placed(|p| {
                let (u, v) = (p.x * cos + p.y * sin, p.y * cos - p.x * sin);
                turned() * DVec3::new(radius * (u / radius).sin(), v, radius * (u / radius).cos())
            });
            let exact = 0.16 * 2e-5 / (2.0 * radius * radius);
            near(&format!("{kind:?} at {degrees}°"), bending.energy(&x), exact, 1e-3);
        }
    }
}

#[test]
fn a_saddle_and_a_bowl_bend_as_poisson_says() {
    let fabric = Fabric::isotropic(1000.0, 0.3, 2e-5, 0.2);
    for kind in KINDS {
        let flat = flat(kind, DVec2::new(0.4, 0.4), [16, 16]);
        let bending = Bending::new(&flat.sheet(), &fabric.bending);
        for (across, factor) in [(1.0, 2.6), (-1.0, 1.4)] {
            // Shallow, so that curvature is the second derivative.
            let x = flat.placed(|p| DVec3::new(p.x, p.y, 0.005 * (p.x * p.x + across * p.y * p.y)));
            near(&format!("{kind:?} {across}"), bending.energy(&x), 0.16 * 2e-5 * 1e-4 * factor / 2.0, 1e-6);
        }
    }
}

#[test]
fn an_orthotropic_sheet_bends_along_warp_bias_and_weft_with_their_stiffness() {
    let mut fabric = Fabric::isotropic(1000.0, 0.3, 2e-5, 0.2);
    fabric.bending = toile::cloth::fabric::Bending { warp: 5e-5, bias: 3e-5, weft: 1e-5, poisson: 0.2 };
    let flat = flat(KINDS[3], DVec2::new(0.4, 0.4), [32, 32]);
    let bending = Bending::new(&flat.sheet(), &fabric.bending);
    for (degrees, stiffness) in [(90.0f64, 5e-5), (45.0, 3e-5), (0.0, 1e-5)] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let x = flat.placed(|p| {
            let (u, v) = (p.x * cos + p.y * sin, p.y * cos - p.x * sin);
            DVec3::new((u).sin(), v, u.cos())
        });
        near(&format!("{degrees}°"), bending.energy(&x), 0.16 * stiffness / 2.0, 2e-3);
    }
}

#[test]
fn turning_and_moving_cost_nothing() {
    let fabric = Fabric::isotropic(1000.0, 0.3, 2e-5, 0.2);
    let flat = flat(KINDS[3], DVec2::new(0.4, 0.4), [8, 8]);
    let x = flat.placed(|p| turned() * p.extend(0.0) + DVec3::splat(100.0));
    assert!(Bending::new(&flat.sheet(), &fabric.bending).energy(&x).abs() < 1e-18);
    assert!(Membrane::new(&flat.sheet(), fabric.stretch.tangent(), 0.1).energy(&x) < 1e-18);
}

/// Central differences of the energy along `way` against the gradient, and of the gradient against the Hessian.
#[test]
fn gradient_and_hessian_are_those_of_the_energy() {
    let mut fabric = Fabric::isotropic(800.0, 0.25, 2e-5, 0.2);
    fabric.stretch.weft = 300.0;
    let flat = flat(KINDS[3], DVec2::new(0.4, 0.4), [3, 3]);
    let sheet = flat.sheet();
    let x = flat.placed(|p| {
        DVec3::new(p.x * 0.98 + 0.2 * p.y * p.y, 1.03 * p.y, (7.0 * p.x + 3.0 * p.y).sin() * 0.03)
    });
    let way: Vec<DVec3> = (0..x.len())
        .map(|i| DVec3::new((i as f64).sin(), (2.0 * i as f64).cos(), (3.0 * i as f64).sin()))
        .collect();
    for compression in [1.0, 0.1] {
        let membrane = Membrane::new(&sheet, fabric.stretch.tangent(), compression);
        let moved = |t: f64| -> Vec<DVec3> { x.iter().zip(&way).map(|(x, w)| *x + *w * t).collect() };
        let gradient = |x: &[DVec3]| {
            let mut g = vec![DVec3::ZERO; x.len()];
            membrane.add_gradient(x, &mut g);
            g
        };
        let t = 1e-6;
        let slope: f64 = gradient(&x).iter().zip(&way).map(|(g, w)| g.dot(*w)).sum();
        near("slope", (membrane.energy(&moved(t)) - membrane.energy(&moved(-t))) / (2.0 * t), slope, 1e-6);
        let mut product = vec![DVec3::ZERO; x.len()];
        membrane.hessian(&x, true, |e, k, l, block| {
            let (a, b) = (sheet.triangles[e][k] as usize, sheet.triangles[e][l] as usize);
            product[a] += block * way[b];
            if k != l {
                product[b] += block.transpose() * way[a];
            }
        });
        let (ahead, behind) = (gradient(&moved(t)), gradient(&moved(-t)));
        for i in 0..x.len() {
            let numeric = (ahead[i] - behind[i]) / (2.0 * t);
            assert!(
                (numeric - product[i]).length() < 1e-4 * (1.0 + numeric.length()),
                "{numeric} {}",
                product[i]
            );
        }
    }
}

/// Stress never falls while strain rises: the relaxed energy stays convex and once differentiable.
#[test]
fn softened_compression_is_continuous_and_carries_its_share() {
    let fabric = Fabric::isotropic(1000.0, 0.3, 0.0, 0.2);
    let flat = flat(KINDS[0], DVec2::new(1.0, 1.0), [1, 1]);
    let soft = Membrane::new(&flat.sheet(), fabric.stretch.tangent(), 0.05);
    let energy = |sx: f64, sy: f64| soft.energy(&flat.placed(|p| DVec3::new(sx * p.x, sy * p.y, 0.0)));
    // Pressed both ways: a twentieth. Pulled one way with the other free to wrinkle: Young's modulus.
    let e: f64 = (0.98f64 * 0.98 - 1.0) / 2.0;
    near("pressed", energy(0.98, 0.98), 0.05 * 1000.0 / 0.7 * e * e, 1e-9);
    let slope = |s: f64| (energy(1.02, s + 1e-6) - energy(1.02, s - 1e-6)) / 2e-6;
    for i in 0..200 {
        let s = 0.97 + 0.0003 * f64::from(i);
        let (low, high) = (slope(s), slope(s + 0.0003));
        assert!(high >= low - 1e-6 && high - low < 0.0003 * 1500.0, "{s}: {low} {high}");
    }
}
