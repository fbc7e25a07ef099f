"""Dresses patterns on a Ray cluster: ray_dress.py OUT PATTERN...

Needs ray, and the package of assets/python; the program must be on each machine.
"""

import pathlib
import sys

import ray

import toile


@ray.remote(num_cpus=1)
def dressed(pattern: str, out: str) -> dict:
    """The figures of one garment, or why it is none; a task never fails."""
    try:
        garment = toile.dress(pattern, out=out, threads=1, no_picture=True, check=False)
    except toile.ToileError as error:
        return {"pattern": pattern, "error": str(error)}
    return {"pattern": pattern, "faults": len(garment.faults), "strain": garment.report["strain"]["p99"]}


if __name__ == "__main__":
    folder, patterns = pathlib.Path(sys.argv[1]), sys.argv[2:]
    ray.init()
    tasks = [dressed.remote(pattern, str(folder / pathlib.Path(pattern).stem)) for pattern in patterns]
    for row in ray.get(tasks):
        print(row)
