"""Surfaces in files of instruments, which the package SurfaceTopography reads where it is installed."""

from __future__ import annotations

import os
import re
from typing import Any

import numpy as np

from fuge.errors import FileError, Status
from fuge.formats.surface_text import METRES, Heights
from fuge.formats.text import PathLike, quoted_path

# What formats are called, and their first bytes; those of archives by the ending of the file.
_SIGNATURES = {
    "a Digital Surf file (sur)": rb"DIGITAL SURF|DSCOMPRESSED",
    "a Keyence file (vk3, vk4, vk6, vk7)": rb"VK[3467]",
    "a Keyence file (zon)": rb"KPK0",
    "a Gwyddion file (gwy)": rb"GWYP",
    "an Alicona file (al3d)": rb"AliconaImaging",
    "a Zygo file (dat)": rb"\x88\x1b\x03",
    "a Wyko file (opd)": rb"\x01\x00Directory",
    "a Bruker file (opdx)": rb"VCA DATA",
    "an Olympus file (oir)": rb"OLYMPUSRAWFORMAT",
    "an HDF5 file, as Zygo writes them (datx)": rb"\x89HDF\r\n\x1a\n",
}
_ARCHIVES = {".x3p": "an x3p file (ISO 25178-72)", ".plux": "a Sensofar file (plux)"}

# A file that is not text has a byte among the first that no text has.
_EXAMINED = 4096
_CONTROL = re.compile(rb"[\x00-\x08\x0e-\x19\x1b-\x1f]")

# SurfaceTopography takes files for these that no signature tells from others.
_GUESSED = {"asc", "xyz", "hgt", "nms"}


def failure(path: PathLike, reason: str) -> FileError:
    """The error that a file cannot be used, for a reason that begins with a verb."""
    return FileError(f"{quoted_path(path)} {reason}", Status.ERR_FILE)


def instrument_format(path: PathLike, content: bytes) -> str:
    """What a file is that is not text, with its article, such as "an x3p file"; empty for text.

    FileError for text in UTF-16, and for other archives.
    """
    # Its header is text of one or two bytes a letter.
    if content[:80].replace(b"\0", b"").lstrip(b"\xff\xfe").startswith(b"fileformat = bcr"):
        return "a BCR file (bcr, bcrf)"
    if content.startswith(b"PK\x03\x04"):
        ending = os.path.splitext(os.fspath(path))[1].lower()
        if ending not in _ARCHIVES:
            raise failure(path, "is a ZIP archive: unpack it and pass the file of heights in it")
        return _ARCHIVES[ending]
    # Text may begin with the same letters.
    if not _CONTROL.search(content, 0, _EXAMINED):
        return ""
    if content.startswith((b"\xff\xfe", b"\xfe\xff")):
        raise failure(path, "is text in UTF-16: save it as plain text or UTF-8")
    names = (name for name, signature in _SIGNATURES.items() if re.match(signature, content))
    return next(names, "a binary file")


def _topography(path: PathLike, name: str) -> tuple[Any, tuple[str, ...]]:
    """The default channel of a file, as SurfaceTopography reads it, and which one that is."""
    try:
        import SurfaceTopography
    except ImportError as reason:
        remedy = "fuge reads it where SurfaceTopography is installed: pip install 'fuge[surfaces]'"
        raise failure(path, f"is {name}: {remedy} ({reason})") from None
    try:
        with SurfaceTopography.open_topography(os.fspath(path)) as reader:
            known = reader.format() not in _GUESSED
            channels, topography = [channel.name for channel in reader.channels], reader.topography()
            channel = reader.default_channel.name
    except Exception as reason:
        # Where no reader takes the file, the message has what each of its dozens of readers says.
        detected = type(reason).__name__ != "CannotDetectFileFormat"
        cause = str(reason) if detected else "is it broken or cut off?"
        raise failure(path, f"is {name}, but SurfaceTopography does not read it: {cause}") from None
    if not known:
        raise failure(path, f"is {name} of an unknown format")
    return topography, (f"of its channels {', '.join(channels)} {channel} is read",) if len(channels) > 1 else ()


def read_instrument(path: PathLike, name: str) -> Heights:
    """Heights and spacings in metres, or as they stand if the file has no unit; `name` by :func:`instrument_format`."""
    topography, header = _topography(path, name)
    if topography.dim != 2 or not topography.is_uniform:
        raise failure(path, f"is {name}: it has a profile or scattered points, no heights on a grid")
    unit = topography.unit
    if unit is not None and unit not in METRES:
        raise failure(path, f"is {name}: its unit is {unit!r}, no length: read it with SurfaceTopography")
    scale = METRES.get(unit, 1.0)
    # Heights are masked where nothing was measured, and the first index counts along x.
    measured = topography.heights()
    if hasattr(measured, "filled"):
        measured = measured.astype(np.float64).filled(np.nan)
    heights = scale * np.asarray(measured, dtype=np.float64)
    spacing_x, spacing_y = (scale * float(size) for size in topography.pixel_size)
    if not 0.0 < min(spacing_x, spacing_y) <= max(spacing_x, spacing_y) < np.inf:
        raise failure(path, f"is {name}: its spacings, {spacing_x:.7g} and {spacing_y:.7g}, are no lengths")
    unit = None if unit is None else "m"
    return Heights(np.ascontiguousarray(heights.T), (spacing_x, spacing_y), unit=unit, header=header)
