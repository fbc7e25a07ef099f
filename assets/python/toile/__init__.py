"""Dress a body in cloth: the toile program, with NumPy arrays.

Everything is done by the program, which is looked for where the environment variable TOILE says, then on the path. Lengths are in
metres. Options are those of the command line (``toile dress --help``): ``edge_length=0.01`` is ``--edge-length 0.01``,
``drape=True`` is ``--drape``, a list gives the option several times, and None or False leave it out.
"""

from __future__ import annotations

import csv
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
from dataclasses import dataclass, field
from typing import Any, Iterable, Union

import numpy as np

__all__ = [
    "BadInput",
    "FileError",
    "Fit",
    "Garment",
    "Map",
    "Mesh",
    "NotDressed",
    "OverLimit",
    "ToileError",
    "UsageError",
    "dress",
    "fit",
    "program",
    "repose",
]

PathLike = Union[str, "os.PathLike[str]"]

#: File name of the project that :func:`dress` and :func:`repose` save among the results.
PROJECT = "dressed.toile"


class ToileError(Exception):
    """The program failed; the message is what it said."""

    def __init__(self, words: str, exit_code: int) -> None:
        super().__init__(words)
        self.exit_code = exit_code


class NotDressed(ToileError):
    """The garment has faults. ``garment`` is what it came to."""

    def __init__(self, words: str, garment: Garment | None = None) -> None:
        super().__init__(words, 1)
        self.garment = garment


class UsageError(ToileError):
    """An option is unknown or has a value that it does not take."""


class BadInput(ToileError):
    """A file cannot be used."""


class OverLimit(ToileError):
    """The work is more than the program does."""


class FileError(ToileError):
    """A file could not be read or written."""


_ERRORS = {2: UsageError, 3: BadInput, 4: OverLimit, 6: FileError}


@dataclass(frozen=True, eq=False)
class Mesh:
    """A mesh of triangles."""

    #: Positions, metres: (n, 3).
    vertices: np.ndarray
    #: Rows of three indices of vertices: (t, 3).
    triangles: np.ndarray


@dataclass(frozen=True, eq=False)
class Garment(Mesh):
    """A garment on its body."""

    #: Coordinates in the flat pattern, metres: (m, 2). A vertex on a seam has one for each of its pieces.
    flat: np.ndarray
    #: Rows of three indices of ``flat``, for the same triangles: (t, 3).
    flat_triangles: np.ndarray
    #: The rows of ``triangles`` that belong to each piece, by its name.
    pieces: dict[str, np.ndarray]
    #: The body that it is on.
    body: Mesh
    #: The contents of report.json.
    report: dict[str, Any] = field(repr=False)
    #: The folder with the results; view.png is among them if there was a graphics adapter.
    folder: pathlib.Path
    #: The dressed project, for :func:`repose` and :func:`fit`; None if it was not saved.
    project: pathlib.Path | None
    _owner: Any = field(default=None, repr=False)

    @property
    def faults(self) -> list[str]:
        """Why this is no dressed garment; empty when it is."""
        return [f"{fault['place']}: {fault['words']}" for fault in self.report["faults"]]


@dataclass(frozen=True, eq=False)
class Map:
    """A map of a garment: a row for each vertex of each piece that has a value."""

    name: str
    #: Unit of the values, such as "mm" or "%".
    unit: str
    values: np.ndarray
    #: Number of the vertex of each row.
    vertices: np.ndarray
    #: Coordinates in the flat pattern of each row, metres: (n, 2).
    flat: np.ndarray
    #: Name of the piece of each row.
    pieces: np.ndarray
    #: What fit.json says of it: range, statistics, histogram.
    figures: dict[str, Any] = field(repr=False)


@dataclass(frozen=True, eq=False)
class Fit:
    """Maps read off a dressed garment."""

    maps: dict[str, Map]
    #: The contents of fit.json.
    report: dict[str, Any] = field(repr=False)


def program() -> str:
    """The path of the program: what TOILE names, else toile on the path."""
    named = os.environ.get("TOILE") or shutil.which("toile")
    if named is None:
        raise FileNotFoundError("there is no toile on the path; the environment variable TOILE can name the program")
    return named


def dress(
    project: PathLike, out: PathLike | None = None, *, save: bool = True, check: bool = True, **options: Any
) -> Garment:
    """Dresses a project, a pattern or a sample (``sample:tshirt``), as ``toile dress``.

    ``out`` is the folder for the files; without it they are in a temporary one, which lives as long as the garment. With ``save``
    the dressed project is among them. A garment with faults raises :class:`NotDressed`, unless ``check`` is False.
    """
    return _made(["dress", os.fspath(project)], out, save, check, options)


def repose(
    garment: Garment | PathLike, out: PathLike | None = None, *, save: bool = True, check: bool = True, **options: Any
) -> Garment:
    """Carries a dressed garment, or the project at a path, to another pose of its body, as ``toile repose``.

    ``pose="walking"``, ``body="walking.obj"`` or ``joint=["left_elbow=60", ...]`` tell which.
    """
    return _made(["repose", _project_of(garment)], out, save, check, options)


def fit(garment: Garment | PathLike, maps: Iterable[str] = ("all",), **options: Any) -> Fit:
    """Reads maps off a dressed garment, or off the project at a path, as ``toile fit``: ``ease``, ``strain``, ``all``, ..."""
    with tempfile.TemporaryDirectory(prefix="toile-") as folder:
        report = json.loads(
            _run(["fit", _project_of(garment), "--out", folder, "--json", *_words({"map": list(maps), **options})])
        )
        read = [_map(pathlib.Path(folder), figures) for figures in report["maps"]]
    return Fit(maps={one.name: one for one in read}, report=report)


def _project_of(garment: Garment | PathLike) -> str:
    if not isinstance(garment, Garment):
        return os.fspath(garment)
    if garment.project is None:
        raise ValueError("this garment's project was not saved: dress it with save=True")
    return os.fspath(garment.project)


def _made(
    task: list[str], out: PathLike | None, save: bool, check: bool, options: dict[str, Any]
) -> Garment:
    owner = tempfile.TemporaryDirectory(prefix="toile-") if out is None else None
    folder = pathlib.Path(owner.name if owner else os.fspath(out))  # type: ignore[arg-type]
    words = [*task, "--out", os.fspath(folder), "--json", *_words(options)]
    project = folder / PROJECT if save else None
    if project is not None:
        folder.mkdir(parents=True, exist_ok=True)
        words += ["--save", os.fspath(project)]
    faulty: NotDressed | None = None
    try:
        text = _run(words)
    except NotDressed as error:
        faulty = error
        text = (folder / "report.json").read_text(encoding="utf-8")
    garment = _garment(folder, project, json.loads(text), owner)
    if faulty is not None and check:
        raise NotDressed(str(faulty), garment)
    return garment


def _words(options: dict[str, Any]) -> list[str]:
    """Options as they are typed."""
    words: list[str] = []
    for name, value in options.items():
        option = "--" + name.replace("_", "-")
        for one in value if isinstance(value, (list, tuple)) else [value]:
            if one is True:
                words.append(option)
            elif one is not None and one is not False:
                words.append(f"{option}={os.fspath(one) if isinstance(one, os.PathLike) else one}")
    return words


def _run(words: list[str]) -> str:
    """Standard output of the program; its failure as an exception."""
    done = subprocess.run([program(), *words], stdin=subprocess.DEVNULL, capture_output=True, check=False)
    if done.returncode == 0:
        return done.stdout.decode("utf-8")
    said = done.stderr.decode("utf-8", "replace").strip()
    told = [line.removeprefix("toile: ").removeprefix("error: ") for line in said.splitlines() if line]
    failures = [line for line in said.splitlines() if line.startswith(("toile: ", "error: "))]
    last = failures[-1].split(": ", 1)[1] if failures else " ".join(told)
    if done.returncode == 1:
        raise NotDressed(last)
    raise _ERRORS.get(done.returncode, ToileError)(last or "it ended without a word", done.returncode)


def _garment(folder: pathlib.Path, project: pathlib.Path | None, report: dict[str, Any], owner: Any) -> Garment:
    vertices, flat, corners, pieces = _obj(folder / "garment.obj")
    body, _, body_corners, _ = _obj(folder / "body.obj")
    return Garment(
        vertices=vertices,
        triangles=corners[:, :, 0],
        flat=flat,
        flat_triangles=corners[:, :, 1],
        pieces=pieces,
        body=Mesh(vertices=body, triangles=body_corners[:, :, 0]),
        report=report,
        folder=folder,
        project=project,
        _owner=owner,
    )


def _obj(path: pathlib.Path) -> tuple[np.ndarray, np.ndarray, np.ndarray, dict[str, np.ndarray]]:
    """Vertices, flat coordinates, corners (t, 3, 2: vertex and flat coordinate, from 0), and triangles by piece."""
    vertices: list[list[str]] = []
    flat: list[list[str]] = []
    corners: list[list[int]] = []
    begins: list[tuple[str, int]] = []
    with open(path, encoding="utf-8") as lines:
        for line in lines:
            kind, _, rest = line.rstrip("\n").partition(" ")
            if kind == "v":
                vertices.append(rest.split()[:3])
            elif kind == "vt":
                flat.append(rest.split()[:2])
            elif kind == "o":
                begins.append((rest, len(corners)))
            elif kind == "f":
                for corner in rest.split():
                    vertex, _, other = corner.partition("/")
                    other = other.partition("/")[0]
                    corners.append([int(vertex) - 1, int(other) - 1 if other else -1])
    ends = [first for _, first in begins[1:]] + [len(corners)]
    pieces = {name: np.arange(first // 3, end // 3) for (name, first), end in zip(begins, ends)}
    return (
        np.array(vertices, dtype=np.float64).reshape(-1, 3),
        np.array(flat, dtype=np.float64).reshape(-1, 2),
        np.array(corners, dtype=np.int64).reshape(-1, 3, 2),
        pieces,
    )


def _map(folder: pathlib.Path, figures: dict[str, Any]) -> Map:
    name = figures["map"]
    # The file is named as the option is, with hyphens.
    path = folder / f"{name.replace('_', '-')}.csv"
    with open(path, encoding="utf-8", newline="") as lines:
        rows = list(csv.reader(lines))[1:]
    return Map(
        name=name,
        unit=figures["unit"],
        values=np.array([row[-1] for row in rows], dtype=np.float64),
        vertices=np.array([row[3] for row in rows], dtype=np.int64),
        flat=np.array([row[1:3] for row in rows], dtype=np.float64).reshape(-1, 2),
        pieces=np.array([row[0] for row in rows], dtype=object),
        figures=figures,
    )
