use super::*;

/// Two wavy sheets of `side` × `side` squares, 1 cm each, one 2 mm above the other.
fn sheets(side: u32, low: f64) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let row = side + 1;
    let place = |layer: u32, i: u32, j: u32| {
        let (x, z) = (f64::from(i) * 0.01, f64::from(j) * 0.01);
        let shake = f64::from((i * 7 + j * 13 + layer * 5) % 11) * 2e-4;
        DVec3::new(x + shake, low + 0.002 * f64::from(layer) + 0.004 * (x * 90.0).sin() * (z * 70.0).cos(), z)
    };
    let all = |layer| (0..row * row).map(move |k| place(layer, k % row, k / row));
    let cells = |layer: u32| {
        let first = layer * row * row;
        let corner = move |k: u32| first + k / side * row + k % side;
        (0..side * side).map(corner).flat_map(move |a| [[a, a + row, a + row + 1], [a, a + row + 1, a + 1]])
    };
    ((0..2).flat_map(all).collect(), (0..2).flat_map(cells).collect())
}

/// The planes of each vertex, sorted.
fn sorted(planes: impl Iterator<Item = (u32, Plane)>) -> Vec<(u32, [f64; 4])> {
    // Which of two features came first changes the last bits.
    let rounded = |x: f64| (x * 1e7).round() / 1e7 + 0.0;
    let values = |Plane { normal, height }: Plane| [normal.x, normal.y, normal.z, height].map(rounded);
    let mut all: Vec<_> = planes.map(|(v, plane)| (v, values(plane))).collect();
    all.sort_by(|(v, a), (w, b)| v.cmp(w).then_with(|| a.partial_cmp(b).expect("numbers")));
    all
}

/// Whether two lists of planes are the same but for rounding.
fn are_same(one: &[(u32, [f64; 4])], other: &[(u32, [f64; 4])]) -> bool {
    let has = |all: &[(u32, [f64; 4])], (v, plane): &(u32, [f64; 4])| {
        let own = all.partition_point(|(w, _)| w < v)..all.partition_point(|(w, _)| w <= v);
        all[own].iter().any(|(_, q)| plane.iter().zip(q).all(|(a, b)| (a - b).abs() < 1e-6))
    };
    one.len() == other.len()
        && one.iter().all(|plane| has(other, plane))
        && other.iter().all(|plane| has(one, plane))
}

/// The planes of every pair of features, found without a tree and without leaving any pair out.
fn brute(this: &Separation) -> Vec<(u32, [f64; 4])> {
    let mut found = Found::default();
    let none = Crossings::default();
    let count = this.cloth.triangles.len() as u32;
    for (s, t) in (0..count).flat_map(|s| (0..count).map(move |t| (s, t))) {
        let [one, other] = [s, t].map(|t| this.cloth.triangles[t as usize]);
        for k in this.cloth.corners_of(s).filter(|&k| !this.joined(&[one[k]], &other)) {
            this.vertex_at([s, t], k, &none, &mut found);
        }
        for (k, m) in this.cloth.sides_of(s).flat_map(|k| this.cloth.sides_of(t).map(move |m| (k, m))) {
            let ends = [this.placed[s as usize].ends(k), this.placed[t as usize].ends(m)];
            if s < t && !this.joined(&ends[0], &ends[1]) {
                this.edges_at([s, t], [k, m], &none, &mut found);
            }
        }
    }
    let obstacle = this.obstacle.as_deref().expect("an obstacle");
    let still = &obstacle.topology;
    for s in 0..count {
        let own = &this.placed[s as usize];
        for other in &obstacle.placed {
            for k in this.cloth.corners_of(s) {
                let seen = features::vertex_and_triangle(own.corners[k], other.corners);
                this.hold(seen, &[own.vertices[k]], own.reach[k], &mut found);
            }
        }
        for &p in &obstacle.positions {
            let seen = features::vertex_and_triangle(p, own.corners).map(turned);
            this.hold(seen, &own.vertices, own.farthest, &mut found);
        }
        for (k, f) in this.cloth.sides_of(s).flat_map(|k| (0..still.edges.len() as u32).map(move |f| (k, f)))
        {
            let seen = features::edges(own.side(k), still.ends(&obstacle.positions, f));
            this.hold(seen, &own.ends(k), own.side_reach(k), &mut found);
        }
    }
    sorted(found.planes.into_iter())
}

/// The planes of each vertex after a detection, sorted.
fn planes_of(this: &Separation) -> Vec<(u32, [f64; 4])> {
    let own = |v: usize| this.starts[v] as usize..this.starts[v + 1] as usize;
    let all =
        (0..this.anchors.len()).flat_map(|v| this.planes[own(v)].iter().map(move |plane| (v as u32, *plane)));
    sorted(all)
}

/// Places of two sheets, one above the other, and their separation from each other and from a third below them: as they are, and with
/// the last column of the lower one sewn to the one before it.
fn stacked() -> (Vec<DVec3>, [Separation; 2]) {
    let (x, triangles) = sheets(9, 0.0);
    let (below, under) = sheets(9, -0.004);
    let adjacency = Adjacency::new(x.len(), &triangles);
    let obstacle = Arc::new(Obstacle::new(&below, &under, &Adjacency::new(below.len(), &under)));
    let rest: Vec<f64> =
        adjacency.edges.iter().map(|e| x[e[0] as usize].distance(x[e[1] as usize])).collect();
    let names = (0..x.len() as u32).map(|v| if v < 100 && v % 10 == 9 { v - 1 } else { v }).collect();
    let made = [None, Some(names)].map(|names| {
        Separation::new(&triangles, &adjacency, (&rest, 0.001), names, Some(Arc::clone(&obstacle)))
    });
    (x, made)
}

#[test]
fn the_planes_are_those_of_all_pairs_of_features() {
    let (x, made) = stacked();
    for mut this in made {
        for reach in [5e-4, 0.003, 0.012] {
            this.detect(&x, |v| reach * (0.5 + 0.5 * (v % 3) as f64), |_| false);
            assert_eq!(this.crossings(), 0);
            let (found, all) = (planes_of(&this), brute(&this));
            assert!(reach < 0.001 || found.len() > 1000, "{reach}: {}", found.len());
            assert!(are_same(&found, &all), "{reach}: {} planes, of all pairs {}", found.len(), all.len());
        }
    }
}

#[test]
fn planes_of_later_detections_are_those_of_all_pairs_too() {
    let (start, made) = stacked();
    for mut this in made {
        let mut x = start.clone();
        let mut looked_at = Vec::new();
        for step in 0..16 {
            // The cloth bends, slides and is crumpled a little.
            for (v, x) in x.iter_mut().enumerate() {
                *x += DVec3::new(1e-4, 2e-4 * (x.z * 60.0).sin(), 5e-5 * ((v * 31 + step * 17) % 7) as f64);
            }
            let before = this.counters.neighbours;
            this.detect(&x, |v| 5e-4 * (1.0 + (v % 3) as f64), |_| false);
            looked_at.push(this.counters.neighbours - before);
            let (found, all) = (planes_of(&this), brute(&this));
            assert!(found.len() > 100, "{step}: {}", found.len());
            assert!(are_same(&found, &all), "{step}: {} planes, of all pairs {}", found.len(), all.len());
        }
        assert!(
            looked_at.iter().any(|groups| groups + 500 < looked_at[0]),
            "all are looked at: {looked_at:?}"
        );
        assert!((1..16).contains(&this.counters.searches), "{:?}", this.counters);
    }
}
