"""Run a notebook without Jupyter: `notebook.py FILE` compares what its cells print with the outputs in the file,
`notebook.py FILE --write` puts text and pictures there."""

from __future__ import annotations

import base64
import contextlib
import io
import json
import sys
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")

from matplotlib import pyplot

DOTS_PER_INCH = 64


def text_of(value: str | list[str]) -> str:
    """The text of a notebook's string, which may be a list of lines."""
    return value if isinstance(value, str) else "".join(value)


def pictures() -> list[bytes]:
    """All figures as PNG, in the order in which they were made; they are closed."""
    found = []
    for number in pyplot.get_fignums():
        with io.BytesIO() as file:
            # Without the version of matplotlib, so that the same picture is the same file.
            pyplot.figure(number).savefig(file, format="png", dpi=DOTS_PER_INCH, metadata={"Software": None})
            found.append(file.getvalue())
    pyplot.close("all")
    return found


def run(source: str, names: dict[str, Any]) -> list[dict[str, Any]]:
    """The outputs of a cell: what it prints, and its pictures."""
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        exec(compile(source, "<cell>", "exec"), names)
    outputs: list[dict[str, Any]] = []
    if printed.getvalue():
        lines = printed.getvalue().splitlines(keepends=True)
        outputs.append({"name": "stdout", "output_type": "stream", "text": lines})
    for picture in pictures():
        data = {"image/png": base64.b64encode(picture).decode() + "\n"}
        outputs.append({"data": data, "metadata": {}, "output_type": "display_data"})
    return outputs


def summary(outputs: list[dict[str, Any]]) -> tuple[str, int]:
    """What was printed, and the number of pictures."""
    printed = "".join(text_of(output["text"]) for output in outputs if output["output_type"] == "stream")
    return printed, sum(output["output_type"] == "display_data" for output in outputs)


def main(path: Path, write: bool) -> int:
    """Run all code cells in one namespace; 1 if the output of one of them differs from that in the file."""
    notebook = json.loads(path.read_text(encoding="utf-8"))
    names: dict[str, Any] = {"__name__": "__main__"}
    different = 0
    for cell in notebook["cells"]:
        if cell["cell_type"] != "code":
            continue
        outputs = run(text_of(cell["source"]), names)
        if write:
            cell["outputs"] = outputs
        elif summary(outputs) != summary(cell["outputs"]):
            different += 1
            found, wanted = summary(outputs), summary(cell["outputs"])
            print(f"{text_of(cell['source'])}\n--- gives, with {found[1]} pictures\n{found[0]}")
            print(f"--- instead of, with {wanted[1]} pictures\n{wanted[0]}")
    if write:
        path.write_text(json.dumps(notebook, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    return int(different > 0)


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), "--write" in sys.argv))
