#!/bin/sh
# Dresses a list on all cores of one machine: as many parts as there are cores, each on a thread of its own. Begun again, it goes
# on where it was.
#   xargs.sh LIST OUT [OPTION of toile dress ...]
# With GNU parallel the second line is:
#   seq "$parts" | parallel --line-buffer toile dress --list "$list" --shard {}/"$parts" --out "$out" --threads 1 --resume "$@"
list=$1 out=$2 parts=${PARTS:-$(nproc)}
shift 2
seq "$parts" | xargs -P "$parts" -I '{}' \
    "${TOILE:-toile}" dress --list "$list" --shard "{}/$parts" --out "$out" --threads 1 --resume "$@"
# xargs ends with 123 where some garment was not dressed: the table tells which and why.
"${TOILE:-toile}" report merge "$out" --out "$out/table.csv"
