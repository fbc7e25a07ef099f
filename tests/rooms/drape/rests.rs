//! B6, B8: cloth that hangs.

use glam::{DVec2, DVec3};
use toile::cloth::Fabric;
use toile::drape::solver::settle::SettleSettings;

use super::meshes::{Kind, flat, near, scene, settled};

#[test]
fn b6_a_limp_strip_hangs_in_a_catenary() {
    for (length, sag) in [(1.05, 0.139304), (1.2, 0.292344), (2.0, 0.796388)] {
        let strip = flat(Kind::Diagonal, DVec2::new(length, 0.05), [60, 1]);
        let pinned = strip.picked(|p| p.x < 1e-9 || p.x > length - 1e-9);
        let scene = scene(&strip, &Fabric::isotropic(1e5, 0.0, 0.0, 0.2), pinned);
        let start = |p: DVec2| {
            let s = 2.0 * p.x / length - 1.0;
            DVec3::new((s + 1.0) / 2.0, -sag * (1.0 - s * s), p.y)
        };
        let x = settled(&scene, &[], &SettleSettings::default(), strip.placed(start));
        let lowest = x.iter().map(|x| -x.y).fold(0.0, f64::max);
        near(&format!("length {length}"), lowest, sag, 1e-3);
    }
}

#[test]
fn b8_a_hanging_sheet_stretches_by_its_own_weight() {
    for (load, longer, top) in
        [(0.01, 0.00495097, 0.00985387), (0.05, 0.0238607, 0.0466805), (0.1, 0.0457977, 0.0880339)]
    {
        let cells = 60;
        let strip = flat(Kind::Alternating, DVec2::new(0.2, 1.0), [4, cells]);
        let pinned = strip.picked(|p| p.y > 1.0 - 1e-9);
        let scene = scene(&strip, &Fabric::isotropic(0.2 * 10.0 / load, 0.0, 0.0, 0.2), pinned);
        let x = settled(&scene, &[], &SettleSettings::default(), strip.placed(|p| p.extend(0.0)));
        let lowest = x.iter().map(|x| -x.y).fold(f64::MIN, f64::max);
        near(&format!("lengthening at {load}"), lowest, longer, 1e-4);
        // Of the two highest rows of cells, to the top.
        let strain = |row: u32| {
            let in_row = |t: &&usize| {
                let y = strip.triangles[**t].iter().map(|&v| strip.points[v as usize].y).sum::<f64>() / 3.0;
                (y * f64::from(cells)) as u32 == cells - 1 - row
            };
            let all: Vec<usize> = (0..strip.triangles.len()).collect();
            let row: Vec<f64> = all
                .iter()
                .filter(in_row)
                .map(|&t| {
                    let [e, _, _] = scene.elastic.membrane.strain(t, &x);
                    (1.0 + 2.0 * e).sqrt() - 1.0
                })
                .collect();
            row.iter().sum::<f64>() / row.len() as f64
        };
        near(&format!("strain at the top at {load}"), 1.5 * strain(0) - 0.5 * strain(1), top, 1e-3);
    }
}
