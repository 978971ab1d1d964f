"""Data lines of meshes in input files of Abaqus and CalculiX: nodes, elements, and labels of any kind."""

from __future__ import annotations

import re
import warnings
from collections.abc import Callable, Sequence
from itertools import chain
from typing import Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from fuge.element_faces import element_type
from fuge.formats.keyword import Block, split_items
from fuge.formats.text import LARGEST_LABEL, Reason, label, located, value

_BLANK = re.compile(r",\s+,")

_Row = TypeVar("_Row")


class Labels(NamedTuple):
    """Labels in the data lines of a block, and the index of the line of each."""

    block: Block
    numbers: NDArray[np.int64]
    lines: NDArray[np.intp]


def read_rows(block: Block, read: Callable[[list[str]], _Row]) -> list[_Row]:
    """What `read` makes of the items of each data line; its Reason becomes an error with the place of the line."""
    rows = []
    for k, line in enumerate(block.lines):
        with located(block.where(k)):
            rows.append(read(split_items(line)[0]))
    return rows


def plain_labels(lines: Sequence[str]) -> tuple[NDArray[np.int64], NDArray[np.intp]] | None:
    """The labels in lines, and how many each has, if the lines have nothing else; a comma may be the last letter."""
    found = _numbers([line[:-1] if line.endswith(",") else line for line in lines], np.int64)
    return found if found and found[0].min() > 0 and found[0].max() <= LARGEST_LABEL else None


def _numbers(lines: Sequence[str], kind: type[np.generic]) -> tuple[NDArray[Any], NDArray[np.intp]] | None:
    """Numbers between the commas of lines, and how many each has; None if there is anything else."""
    counts = np.array([line.count(",") for line in lines], dtype=np.intp) + 1
    text = ",".join(lines)
    # numpy makes a number of blanks.
    if _BLANK.search(text):
        return None
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            numbers = np.fromstring(text, kind, sep=",")
        except (ValueError, DeprecationWarning):
            return None
    return (numbers, counts) if 0 < numbers.size == counts.sum() else None


def read_nodes(block: Block) -> tuple[Labels, NDArray[np.float64]]:
    """The nodes of a block and their positions, (nodes, 3); coordinates that are not there are 0."""
    lines = np.arange(len(block.lines))
    labels, numbers = plain_labels([line.partition(",")[0] for line in block.lines]), _numbers(block.lines, np.float64)
    if labels and numbers and np.all(np.isfinite(numbers[0])) and 2 <= numbers[1].min() == numbers[1].max() <= 4:
        positions = numbers[0].reshape(lines.size, -1)[:, 1:]
        return Labels(block, labels[0], lines), np.pad(positions, ((0, 0), (0, 3 - positions.shape[1])))
    rows = read_rows(block, _node)
    return Labels(block, np.array([row[0] for row in rows]), lines), np.array([row[1] for row in rows])


def _node(items: list[str]) -> tuple[int, list[float]]:
    number = label(items[0], "node")
    if any(items[4:]):
        raise Reason(f"more than three coordinates of node {number}")
    return number, [value(item) if item else 0.0 for item in [*items[1:4], "", "", ""][:3]]


def read_elements(block: Block, type: str) -> tuple[Labels, NDArray[np.intp], NDArray[np.int64]]:
    """The elements of a block, how many nodes each has, and the labels of these, one element after the other.

    An element stands on as many lines as its type needs, or goes on as long as a line ends with a comma.
    """
    plain = plain_labels(block.lines)
    if plain is None:
        rows = read_rows(block, lambda items: [label(item, "element or node") for item in items])
        plain = np.array(list(chain(*rows))), np.array([len(row) for row in rows])
    numbers, counts = plain
    ends = np.cumsum(counts)
    nodes = element_type(type)[1]
    if not nodes:
        is_last = np.array([not line.endswith(",") for line in block.lines])
        is_last[-1] = True
        first = np.append(0, ends[is_last][:-1])
        wrong = first[np.diff(first, append=numbers.size) < 2]
        reason = "no nodes"
    else:
        first = np.arange(0, numbers.size, nodes + 1)
        wrong = first[~np.isin(first + nodes + 1, ends)]
        reason = f"more or fewer nodes than the {nodes} of its type {type}"
    if wrong.size:
        k = int(np.searchsorted(ends, wrong[0], side="right"))
        raise block.refuse(f"element {numbers[wrong[0]]} has {reason}", k)
    labels = Labels(block, numbers[first], np.searchsorted(ends, first, side="right"))
    return labels, np.diff(first, append=numbers.size) - 1, np.delete(numbers, first)
