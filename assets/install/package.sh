#!/usr/bin/env bash
# Packs the program: a tarball with bin/ and share/, and on Debian a .deb of the same files.
#
#   assets/install/package.sh [--binary FILE] [--out FOLDER] [--quick]
#
# --binary FILE  the program to pack; without it, the release build is made first
# --out FOLDER   where the packages go: target/install when left out
# --quick        compresses as little as possible, for tests
#
# The same program packs to the same bytes. Prints the path of each package.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
binary='' out=$root/target/install level=9
while [ $# -gt 0 ]; do
    case $1 in
        --binary) binary=$2; shift 2 ;;
        --out) out=$2; shift 2 ;;
        --quick) level=1; shift ;;
        *) sed -n '2,10s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2; exit 2 ;;
    esac
done
if [ -z "$binary" ]; then
    (cd "$root" && cargo build --release --locked)
    binary=${CARGO_TARGET_DIR:-$root/target}/release/toile
fi
[ -x "$binary" ] || { echo "$binary: not a program" >&2; exit 3; }

version=$("$binary" --version | cut -d ' ' -f 2)
machine=$(uname -m)
# Times in the packages: the program's own, so that packing it again gives the same bytes.
export SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(stat -c %Y "$binary")}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out"

# Lays all files out below the folder $1 as below a prefix; $2 is where zsh looks there.
lay_out() {
    local here=$root/assets/install share=$1/share size shell
    install -D -m 755 "$binary" "$1/bin/toile"
    install -D -m 644 -t "$share/applications" "$here/toile.desktop"
    install -D -m 644 -t "$share/mime/packages" "$here/toile.xml"
    install -D -m 644 -t "$share/metainfo" "$here/toile.metainfo.xml"
    install -D -m 644 -t "$share/icons/hicolor/scalable/apps" "$here/icons/toile.svg"
    for size in 48 128 256; do
        install -D -m 644 "$here/icons/toile-$size.png" "$share/icons/hicolor/${size}x$size/apps/toile.png"
    done
    mkdir -p "$share/man/man1"
    "$binary" man --out "$share/man/man1" >/dev/null
    chmod 644 "$share/man/man1"/*
    gzip -9 -n "$share/man/man1"/*
    for shell in bash zsh fish; do
        "$binary" completions "$shell" >"$work/completions-$shell"
    done
    install -D -m 644 "$work/completions-bash" "$share/bash-completion/completions/toile"
    install -D -m 644 "$work/completions-zsh" "$share/zsh/$2/_toile"
    install -D -m 644 "$work/completions-fish" "$share/fish/vendor_completions.d/toile.fish"
    install -D -m 644 -t "$share/doc/toile" "$here/copyright" "$root/README.md"
    install -D -m 644 -t "$share/doc/toile/recipes" "$root/assets/recipes"/*
    install -D -m 644 -t "$share/doc/toile/languages" "$root/assets/languages"/*
}

# What is packed has one owner, one order and one time.
pack_tarball() {
    local name=toile-$version-linux-$machine
    lay_out "$work/$name" site-functions
    tar -C "$work" --sort=name --owner=0 --group=0 --numeric-owner --mtime="@$SOURCE_DATE_EPOCH" -cf - "$name" |
        gzip -n "-$level" >"$work/tarball"
    mv "$work/tarball" "$out/$name.tar.gz"
    echo "$out/$name.tar.gz"
}

# The oldest C library with everything that the program takes from it.
oldest_libc() {
    { grep -ao 'GLIBC_2\.[0-9.]*[0-9]' "$binary" || echo GLIBC_2.17; } | sort -uV | tail -n 1 | cut -d _ -f 2
}

pack_deb() {
    local tree=$work/deb architecture deb
    architecture=$(dpkg --print-architecture)
    deb=toile_${version}_$architecture.deb
    lay_out "$tree/usr" vendor-completions
    mkdir -p "$tree/DEBIAN"
    cat >"$tree/DEBIAN/control" <<CONTROL
Package: toile
Version: $version
Architecture: $architecture
Maintainer: The Toile authors <toile@localhost>
Installed-Size: $(du -sk "$tree/usr" | cut -f 1)
Depends: libc6 (>= $(oldest_libc)), libgcc-s1, libvulkan1, libxkbcommon-x11-0, libx11-xcb1, libxcursor1, libxi6, libxrandr2, libwayland-client0
Recommends: mesa-vulkan-drivers
Section: graphics
Priority: optional
Description: dress a body in cloth
 Draw and sew flat pieces, or import a pattern; paint marks on cloth and body,
 press Wrap, and the cloth grows round the body so that the marks meet. Drape
 it in a fabric, check the fit, carry it to other poses; in a window, or one
 garment or thousands without.
CONTROL
    (cd "$tree" && find usr -type f -print0 | sort -z | xargs -0 md5sum >DEBIAN/md5sums)
    chmod -R u=rwX,go=rX "$tree"
    dpkg-deb --root-owner-group -Zgzip "-z$level" --build "$tree" "$work/$deb" >/dev/null
    mv "$work/$deb" "$out/$deb"
    echo "$out/$deb"
}

pack_tarball
if command -v dpkg-deb >/dev/null; then
    pack_deb
else
    echo "dpkg-deb is missing: no .deb" >&2
fi
