"""A notebook as a page: its text, its code, and what its cells print and draw."""

import base64
import json


def page(path, name, pages):
    """Title and body; the pictures go to the folder `pages`, with `name` in front."""
    body, pictures = [], 0
    for cell in json.loads(path.read_text())["cells"]:
        source = "".join(cell["source"]).rstrip()
        if cell["cell_type"] == "markdown":
            body.append(source)
            continue
        body.append(f"~~~python\n{source}\n~~~")
        for output in cell["outputs"]:
            if output["output_type"] == "stream":
                body.append("~~~text\n" + "".join(output["text"]).rstrip() + "\n~~~")
            else:
                picture = f"{name}_{pictures}.png"
                (pages/picture).write_bytes(base64.b64decode(output["data"]["image/png"]))
                body.append(f"![Picture {pictures + 1} of the notebook]({picture})")
                pictures += 1
    title, _, rest = "\n\n".join(body).partition("\n")
    return title.lstrip("# "), rest
