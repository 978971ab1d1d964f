"""Data lines of meshes in input files of Abaqus and CalculiX: nodes, elements, and labels of any kind."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from fuge.element_faces import element_type
from fuge.errors import FileError
from fuge.formats.keyword import Block, split_items
from fuge.formats.text import LARGEST_LABEL, Reason, label, value

_Row = TypeVar("_Row")


@dataclass(frozen=True, eq=False)
class Run:
    """Labels of nodes or elements in the data lines of a block, and the index of the line of each."""

    block: Block
    labels: NDArray[np.int64]
    lines: NDArray[np.intp]


def read_rows(block: Block, read: Callable[[list[str]], _Row]) -> list[_Row]:
    """What `read` makes of the items of each data line; its Reason becomes an error with the place of the line."""
    rows = []
    for k, line in enumerate(block.lines):
        try:
            rows.append(read(split_items(line)[0]))
        except Reason as reason:
            raise block.refuse(reason, k) from None
    return rows


def read_labels(block: Block, what: str) -> tuple[NDArray[np.int64], NDArray[np.intp]]:
    """All labels of a block, called `what` in errors, and how many there are in each line."""
    labels = plain_labels(block.lines)
    if labels is not None:
        return labels
    rows = read_rows(block, lambda items: [label(item, what) for item in items])
    return np.array(list(chain(*rows)), dtype=np.int64), np.array([len(row) for row in rows], dtype=np.intp)


def plain_labels(lines: Sequence[str]) -> tuple[NDArray[np.int64], NDArray[np.intp]] | None:
    """The labels in lines and how many there are in each, if the lines have nothing else; a comma may be the last."""
    if not lines:
        return np.empty(0, dtype=np.int64), np.empty(0, dtype=np.intp)
    found = _numbers([line[:-1] if line.endswith(",") else line for line in lines], np.int64)
    return found if found and found[0].min() > 0 and found[0].max() <= LARGEST_LABEL else None


def _numbers(lines: Sequence[str], kind: type[np.generic]) -> tuple[NDArray[Any], NDArray[np.intp]] | None:
    """Numbers between the commas of lines, and how many each has; None if there is anything else, or a doubt."""
    counts = np.array([line.count(",") for line in lines]) + 1
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            numbers = np.fromstring(",".join(lines), kind, sep=",")
        except (ValueError, DeprecationWarning):
            return None
    return (numbers, counts) if numbers.size == counts.sum() else None


def read_nodes(block: Block) -> tuple[Run, NDArray[np.float64]]:
    """The nodes of a block and their positions, (nodes, 3); coordinates that are not there are 0."""
    heads, tails = zip(*(line.partition(",")[::2] for line in block.lines))
    labels, coordinates = plain_labels(heads), _numbers(tails, np.float64)
    lines = np.arange(len(heads))
    if labels and coordinates and np.isfinite(coordinates[0]).all():
        numbers, counts = coordinates
        if counts.min() == counts.max() <= 3:
            positions = np.zeros((lines.size, 3))
            positions[:, : counts[0]] = numbers.reshape(lines.size, -1)
            return Run(block, labels[0], lines), positions
    rows = read_rows(block, _node)
    return Run(block, np.array([row[0] for row in rows]), lines), np.array([row[1] for row in rows])


def _node(items: list[str]) -> tuple[int, list[float]]:
    number = label(items[0], "node")
    if any(items[4:]):
        raise Reason(f"more than three coordinates of node {number}")
    given = [value(item) if item else 0.0 for item in items[1:4]]
    return number, given + [0.0] * (3 - len(given))


def read_elements(block: Block, type: str) -> tuple[Run, NDArray[np.intp], NDArray[np.int64]]:
    """The elements of a block, how many nodes each has, and the labels of these, one element after the other.

    An element stands on as many lines as its type needs, or goes on as long as a line ends with a comma.
    """
    labels, counts = read_labels(block, "element or node")
    begins = np.cumsum(counts) - counts
    kind = element_type(type)
    if kind is None:
        continued = [line.endswith(",") for line in block.lines]
        is_first = ~np.array([False, *continued[:-1]])
    else:
        is_first = begins % (kind.nodes + 1) == 0
        if is_first.sum() * (kind.nodes + 1) != labels.size:
            raise _wrong_count(block, type, kind.nodes, labels[begins], counts)
    first = begins[is_first]
    run = Run(block, labels[first], np.flatnonzero(is_first))
    return run, np.diff(first, append=labels.size) - 1, np.delete(labels, first)


def _wrong_count(block: Block, type: str, nodes: int, labels: NDArray[np.int64], counts: NDArray[np.intp]) -> FileError:
    """The error that an element has not as many nodes as its type; `labels` are the first ones of the lines."""
    missing = 0
    for k, count in enumerate(counts):
        if missing == 0:
            element, missing = labels[k], nodes + 1
        missing -= count
        if missing < 0:
            return block.refuse(f"more than {nodes} nodes of element {element} of type {type}", k)
    return block.refuse(f"element {element} has {missing} nodes less than the {nodes} of its type {type}", k)
