"""Surface data files, SDF (ISO 25178-71), as text or binary."""

from __future__ import annotations

import re
import struct
from array import array
from itertools import takewhile
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from fuge.formats.rows import height, lines, number, plain_heights, text
from fuge.formats.surface_text import Heights
from fuge.formats.text import Place, Reason, located, quoted, refusal, whole
from fuge.heights import LARGEST

# Those of the standard, and what came before it.
_VERSION = re.compile(rb"[abAB](?:BC-|BCR-|ISO-|NIST|NPL-)")
_TEXT_VERSIONS = (b"aISO-1.0", b"aISO-2.0")
# The header after version, maker and two dates, without the resolution of the heights; and their types.
_BINARY_VERSIONS = {b"bISO-1.0": ("<42xHHddd8x3B", (5, 6, 7)), b"bISO-2.0": ("<42xIIddd8x3B", (3, 4, 5, 6, 7))}
_TYPES = {3: "<f4", 4: "<i1", 5: "<i2", 6: "<i4", 7: "<f8"}
# Some instruments have a longer header, by these two numbers.
_LONGER = struct.pack("<II", 5, 1)

_ENTRY = re.compile(r"[ \t\r]*([^ \t\r=]*)[^=]*=[ \t\r]*([^ \t\r]*)")
_MOST_POINTS = 2**31 - 1


class _Header(NamedTuple):
    """What the header says about the heights, by the names of its entries in lower case."""

    numpoints: int
    numprofiles: int
    xscale: float
    yscale: float
    zscale: float
    compression: int
    checktype: int

    def check(self, most_points: int) -> None:
        """Raise the Reason why the header is impossible, or its heights are not read."""
        nx, ny = self.numpoints, self.numprofiles
        if self.compression or self.checktype:
            raise Reason("compressed heights and check sums are not read: Compression and CheckType must be 0")
        if not 1 <= min(nx, ny) <= max(nx, ny) <= _MOST_POINTS:
            raise Reason(f"NumPoints and NumProfiles must be from 1 to {_MOST_POINTS}")
        if nx * ny > min(_MOST_POINTS, most_points):
            raise Reason(f"{nx} x {ny} heights are more than the file has")
        needed = {"Xscale": nx > 1, "Yscale": ny > 1, "Zscale": True}
        for name, scale in zip(needed, self[2:5]):
            if not 0.0 <= scale <= LARGEST or scale == 0.0 and needed[name]:
                raise Reason(f"{name} = {scale:.7g} must be a length > 0")


def is_sdf(content: bytes) -> bool:
    """Does a file begin with a version of SDF?"""
    return _VERSION.match(content) is not None


def read_sdf(path: str, content: bytes) -> Heights:
    """Heights and spacings in metres: profile j has the heights of points (0, j), (1, j) and so on."""
    version = content[:8]
    if not is_sdf(content):
        raise refusal(path, "an SDF file begins with its version, as aISO-1.0")
    if version in _TEXT_VERSIONS:
        header, heights = _read_text(path, content)
    elif version in _BINARY_VERSIONS:
        with located(path):
            header, heights = _read_binary(content)
    else:
        shown = quoted(version.decode("latin-1"))
        raise refusal(path, f"the version {shown} is not read: save the surface as aISO-1.0 or bISO-1.0")
    nx, ny = header.numpoints, header.numprofiles
    with np.errstate(over="ignore"):
        heights = (heights * header.zscale).reshape(ny, nx)
    return Heights(heights, (header.xscale if nx > 1 else 0.0, header.yscale if ny > 1 else 0.0), unit="m")


def _read_binary(content: bytes) -> tuple[_Header, NDArray[np.float64]]:
    form, types = _BINARY_VERSIONS[content[:8]]
    start = struct.calcsize(form)
    if len(content) < start:
        raise Reason("the file ends within its header")
    *sizes, compression, kind, check = struct.unpack_from(form, content)
    if kind not in types:
        raise Reason(f"DataType = {kind} is unknown: {', '.join(map(str, types))} are read")
    # The number zero, or the digit.
    header = _Header._make((*sizes, compression not in (0, 48), check not in (0, 48)))
    header.check(len(content))
    raw, count = np.dtype(_TYPES[kind]), header.numpoints * header.numprofiles
    if len(content) < start + raw.itemsize * count:
        raise Reason(f"the file ends before the last of {count} heights")
    if len(content) == start + len(_LONGER) + raw.itemsize * count and content.startswith(_LONGER, start):
        start += len(_LONGER)
    stored = np.frombuffer(content, raw, count, start)
    least = np.iinfo(raw).min if raw.kind == "i" else np.finfo(raw).min
    return header, np.where(stored == least, np.nan, stored.astype(np.float64))


def _read_text(path: str, content: bytes) -> tuple[_Header, NDArray[np.float64]]:
    """Read header and heights, each up to an asterisk; line breaks among the heights have no meaning."""
    rest, place = lines(content), Place(path, 1)
    found: dict[str, Any] = dict.fromkeys(_Header._fields, 0)
    heights = array("d")
    header: _Header | None = None
    try:
        next(rest)
        for count, line in rest:
            place = Place(path, count)
            if header is None and line.lstrip(b" \t\r").startswith(b"*"):
                header = _Header(**found)
                header.check(len(content))
            elif header is None:
                _take_entry(text(line), found)
            elif _take_heights(line, heights, header.numpoints * header.numprofiles):
                return header, np.frombuffer(heights)
        if header is None:
            raise Reason("the header must end with a line with *")
        of = f"{len(heights)} of {header.numpoints * header.numprofiles}"
        raise Reason(f"the file ends after {of} heights, without the * that ends them")
    except Reason as reason:
        raise refusal(place, reason) from None


def _take_entry(line: str, found: dict[str, Any]) -> None:
    """Take an entry, name = value, of the header; others than those needed have no meaning here."""
    entry = _ENTRY.match(line)
    name = entry[1].lower() if entry else ""
    if entry and name.endswith("scale") and name in found:
        found[name] = number(entry[2])
    elif entry and name in found:
        found[name] = whole(entry[2])
        if found[name] is None:
            raise Reason(f"{quoted(entry[2])} is not a whole number")


def _take_heights(line: bytes, heights: array[float], count: int) -> bool:
    """Append the heights on a line; is there the asterisk after all of them?"""
    row, ended = plain_heights(line), False
    if row is None:
        words = re.findall(r"[^ \t\r]+", text(line))
        kept = list(takewhile(lambda word: not word.startswith("*"), words))
        row, ended = list(map(height, kept)), len(kept) < len(words)
    heights.fromlist(row)
    if len(heights) > count:
        raise Reason(f"more than {count} heights, the product of NumPoints and NumProfiles")
    if ended and len(heights) < count:
        raise Reason(f"the heights end after {len(heights)} of {count}")
    return ended
