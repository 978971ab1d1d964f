"""Tables: columns with names, for pandas and for files."""

from __future__ import annotations

import csv
from typing import Any, Dict

import numpy as np
from numpy.typing import NDArray

from fuge.formats.text import PathLike, refusal


class Table(Dict[str, "NDArray[Any]"]):
    """Columns of equal length by their names; ``pandas.DataFrame(table)`` makes a data frame of it."""

    def rows(self) -> list[tuple[Any, ...]]:
        """The rows, as tuples of Python's numbers and strings."""
        return list(zip(*(column.tolist() for column in self.values())))

    def write(self, path: PathLike) -> None:
        """Write comma-separated values with a heading; numbers have all their digits.

        Raises
        ------
        FileError
            The file cannot be written.
        """
        try:
            # Names of files that are not UTF-8 keep their bytes.
            with open(path, "w", encoding="utf-8", errors="surrogateescape", newline="") as file:
                writer = csv.writer(file, lineterminator="\n")
                writer.writerow(self)
                writer.writerows(self.rows())
        except OSError as failure:
            raise refusal(path, f"cannot be written: {failure.strerror}") from None

    def __repr__(self) -> str:
        rows = len(next(iter(self.values()), np.empty(0)))
        return f"<Table: {rows} rows of {', '.join(self)}>"
