//! File systems that fail: calls of the C library are answered by a small library of our own.

#![cfg(target_os = "linux")]

use std::process::Command;

use crate::program::{Ended, Place, adapter_required, ended};

/// Every third write is interrupted, and of the others half is written; with `FAIL_SYNC`, nothing reaches the disk.
const SHIM: &str = r#"
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdlib.h>
#include <unistd.h>

ssize_t write(int fd, const void *from, size_t count) {
    static ssize_t (*real)(int, const void *, size_t);
    static int calls;
    if (!real) real = dlsym(RTLD_NEXT, "write");
    if (fd > 2 && getenv("SHORT_WRITES")) {
        if (__atomic_add_fetch(&calls, 1, __ATOMIC_SEQ_CST) % 3 == 0) { errno = EINTR; return -1; }
        if (count > 1) count = (count + 1) / 2;
    }
    return real(fd, from, count);
}
static int synced(int fd, const char *name) {
    int (*real)(int) = dlsym(RTLD_NEXT, name);
    if (getenv("FAIL_SYNC")) { errno = EIO; return -1; }
    return real(fd);
}
int fsync(int fd) { return synced(fd, "fsync"); }
int fdatasync(int fd) { return synced(fd, "fdatasync"); }
"#;

/// Saves the dressed ball as `ball-dressed.toile` with `fault`. None without a C compiler.
fn saved(place: &Place, fault: &str) -> Option<Ended> {
    place.write("shim.c", SHIM);
    let (source, library) = (place.path("shim.c"), place.path("shim.so"));
    let compiled = Command::new("cc")
        .args(["-shared", "-fPIC", "-O1", "-o"])
        .arg(&library)
        .arg(&source)
        .arg("-ldl")
        .status();
    if !compiled.is_ok_and(|status| status.success()) {
        println!("skipped: there is no C compiler");
        return None;
    }
    let mut command = place.command("dress ball.toile --save ball-dressed.toile --out out");
    let output = command.env("LD_PRELOAD", &library).env(fault, "1").output().expect("started");
    Some(ended(output))
}

#[test]
fn what_did_not_reach_the_disk_is_not_called_saved() {
    let place = Place::with_ball();
    place.write("ball-dressed.toile", "the old one");
    let Some(ended) = saved(&place, "FAIL_SYNC") else { return };
    assert_ne!(ended.code, 0, "{ended:#?}");
    assert!(ended.err.contains("os error 5"), "{ended:#?}");
    assert_eq!(place.read("ball-dressed.toile"), "the old one");
    let left = place.names("");
    assert!(left.iter().all(|name| !name.starts_with('.')), "nothing half written is left: {left:?}");
}

#[test]
fn writes_that_are_short_or_interrupted_are_gone_on_with() {
    let place = Place::with_ball();
    let Some(ended) = saved(&place, "SHORT_WRITES") else { return };
    assert_eq!(ended.code, 0, "{ended:#?}");
    let broken = std::fs::read(place.path("ball-dressed.toile")).expect("saved");
    let whole = Place::with_ball();
    whole.run("dress ball.toile --save ball-dressed.toile --out out");
    assert_eq!(broken, std::fs::read(whole.path("ball-dressed.toile")).expect("saved"), "the same bytes");
}

/// A small file system of its own; None where that may not be had.
struct SmallDisk(std::path::PathBuf);

impl SmallDisk {
    fn at(folder: std::path::PathBuf) -> Option<Self> {
        std::fs::create_dir(&folder).expect("made");
        let mut mount = Command::new("mount");
        mount.args(["-t", "tmpfs", "-o", "size=16k", "tmpfs"]).arg(&folder);
        let is_mounted = mount.output().is_ok_and(|done| done.status.success());
        is_mounted.then_some(Self(folder))
    }
}

impl Drop for SmallDisk {
    fn drop(&mut self) {
        Command::new("umount").arg(&self.0).status().expect("started");
    }
}

#[test]
fn a_disk_that_is_really_full_keeps_what_was_on_it() {
    let place = Place::with_ball();
    let Some(disk) = SmallDisk::at(place.path("small")) else {
        println!("skipped: nothing may be mounted here");
        return;
    };
    place.write("small/dressed.toile", "the old one");
    for task in [
        "dress ball.toile --edge-length 0.01 --save small/dressed.toile --out out",
        "dress ball.toile --edge-length 0.01 --out small/out",
        "render ball.toile -o small/ball.png --size 1000x1000",
    ] {
        let ended = if task.starts_with("render") { place.draws(task) } else { place.run(task) };
        if ended.code == 5 {
            assert!(!adapter_required(), "{task}: {ended:#?}");
            println!("no graphics adapter: pictures not tested");
            continue;
        }
        assert_eq!(ended.code, 6, "{task}: {ended:#?}");
        assert!(ended.err.contains("small"), "{task} names the file: {ended:#?}");
        assert_eq!(place.read("small/dressed.toile"), "the old one", "{task}");
        let left = place.names("small");
        assert_eq!(left, ["dressed.toile"], "{task} leaves nothing half written");
    }
    drop(disk);
}
