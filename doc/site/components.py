"""Draw who may use whom: components.py TABLE PICTURE [--check]

TABLE is src/components.txt, PICTURE the SVG that is written. An arrow leads from a component to one that it may use;
arrows that follow from others are left out. With --check nothing is written; the exit status says whether PICTURE is
what TABLE gives.

Components lie in layers, each above all that it may use; those with the same arrows share a frame. The order within the
layers is the one with the fewest crossings that a search from many starts finds.
"""

import itertools
import pathlib
import random
import sys
import textwrap

# What a component holds, in a few words for its box.
HOLDS = {
    "core": "problem, engines, certificate, proofs",
    "elastic": "moduli, cells, fields inside",
    "halfplane": "cells, edges of contact",
    "halfspace": "rectangles",
    "rings": "round bodies",
    "layers": "coated and graded bodies",
    "punches": "Hertz, smooth and round, no grid",
    "fe": "stiffness, pairs, bodies",
    "files": "results for ParaView",
    "facade": "the module fuge",
    "f77": "FORTRAN 77",
    "mpi": "surfaces over MPI",
    "sparse": "CHOLMOD",
}
LIBRARY = {"core", "elastic", "halfplane", "halfspace", "rings", "layers", "punches", "fe", "files"}

BOX_HEIGHT, LAYER_GAP, BOX_GAP, FRAME_PAD, MARGIN = 80, 36, 14, 8, 8
# For a page of 800 pixels: lines of more than LINE_LENGTH letters are broken.
NAME_SIZE, TEXT_SIZE, LINE_HEIGHT, LINE_LENGTH = 14.5, 13.5, 17, 18
STARTS = 20


def read_table(path):
    """The components that each component may use."""
    rows = {}
    for line in path.read_text().splitlines():
        if line.strip() and not line.startswith("#"):
            name, _, used = line.partition(":")
            rows[name.split()[0]] = used.split()
    return {name: set(used) for name, used in rows.items()}


def reachable(arrows, start):
    found, ahead = set(), list(arrows[start])
    while ahead:
        name = ahead.pop()
        if name not in found:
            found.add(name)
            ahead.extend(arrows[name])
    return found


def reduced(may_use):
    """The arrows that do not follow from others."""
    return {name: {used for used in targets
                     if not any(used in reachable(may_use, other) for other in targets - {used})}
            for name, targets in may_use.items()}


def framed(arrows):
    """Folders with the same arrows, in and out, as one node: a tuple of names."""
    users = {name: frozenset(user for user in arrows if name in arrows[user]) for name in arrows}
    groups = {}
    for name in arrows:
        groups.setdefault((frozenset(arrows[name]), users[name]), []).append(name)
    nodes = {name: tuple(group) for group in groups.values() for name in group}
    return {node: {nodes[used] for used in arrows[node[0]]} for node in nodes.values()}


def level_of(arrows, node, known):
    if node not in known:
        known[node] = 1 + max((level_of(arrows, used, known) for used in arrows[node]), default=-1)
    return known[node]


def layered(arrows):
    """Layers from the lowest up, and the arrows from layer to layer: long ones pass through points."""
    levels = {}
    for node in arrows:
        level_of(arrows, node, levels)
    layers = [[node for node in arrows if levels[node] == k] for k in range(max(levels.values()) + 1)]
    steps = []
    for node in sorted(arrows):
        for used in sorted(arrows[node]):
            before = node
            for k in range(levels[node] - 1, levels[used], -1):
                point = ("", node, used, k)
                layers[k].append(point)
                steps.append((before, point))
                before = point
            steps.append((before, used))
    return layers, steps


def crossings(order, steps_below):
    """Crossings of the arrows that lead down from one layer to the next."""
    ends = [(order[upper], order[lower]) for upper, lower in steps_below]
    return sum((a - c)*(b - d) < 0 for (a, b), (c, d) in itertools.combinations(ends, 2))


def ordered(layers, steps):
    """The layers in the order with the fewest crossings; of those the one with the shortest arrows."""
    place = {node: k for k, layer in enumerate(layers) for node in layer}
    below = [[step for step in steps if place[step[0]] == k] for k in range(len(layers))]
    chance = random.Random(1)
    best, best_cost = None, None
    for _ in range(STARTS):
        trial = [chance.sample(layer, len(layer)) for layer in layers]
        cost, last = total_cost(trial, below), None
        while cost != last:
            last = cost
            for k, layer in enumerate(trial):
                if len(layer) > 6:
                    continue
                for permuted in itertools.permutations(layer):
                    changed = [*trial[:k], list(permuted), *trial[k + 1:]]
                    changed_cost = total_cost(changed, below)
                    if changed_cost < cost:
                        trial, cost = changed, changed_cost
        if best is None or cost < best_cost:
            best, best_cost = trial, cost
    return best


def total_cost(layers, below):
    order = {node: k - 0.5*(len(layer) - 1) for layer in layers for k, node in enumerate(layer)}
    crossed = sum(crossings(order, steps) for steps in below)
    return crossed, sum((order[upper] - order[lower])**2 for steps in below for upper, lower in steps)


def text_width(text, size):
    return 0.58*size*len(text)


def box_lines(component):
    """Lines of name and contents of a component."""
    return component, textwrap.wrap(HOLDS.get(component, ""), LINE_LENGTH, break_on_hyphens=False)


def box_width(component):
    name, contents = box_lines(component)
    # Bold letters are wider.
    return 20 + max(1.2*text_width(name, NAME_SIZE), *(text_width(line, TEXT_SIZE) for line in [*contents, ""]))


def node_width(node):
    if node[0] == "":
        return 8
    boxes = sum(box_width(component) for component in node) + BOX_GAP*(len(node) - 1)
    return boxes + (2*FRAME_PAD if len(node) > 1 else 0)


def placed(layers, steps):
    """The middle of each node: as near to its neighbours as the boxes allow."""
    middle = {}
    for layer in layers:
        right = 0.0
        for node in layer:
            width = node_width(node)
            middle[node] = right + 0.5*width
            right += width + BOX_GAP
    near = {node: [] for node in middle}
    for upper, lower in steps:
        near[upper].append(lower)
        near[lower].append(upper)
    for _ in range(400):
        for layer in layers:
            for node in layer:
                aims = [middle[other] for other in near[node]]
                # The points of a long arrow pull at each other harder, so that it is straight.
                weights = [10.0 if "" == node[0] == other[0] else 1.0 for other in near[node]]
                aim = sum(weight*at for weight, at in zip(weights, aims))/sum(weights)
                middle[node] += 0.5*(aim - middle[node])
            spread(layer, middle)
    return middle


def spread(layer, middle):
    """Move nodes apart that overlap, half the way each."""
    for _ in range(60):
        for left, right in itertools.pairwise(layer):
            room = 0.5*(node_width(left) + node_width(right)) + BOX_GAP
            overlap = room - (middle[right] - middle[left])
            if overlap > 0:
                middle[left] -= 0.5*overlap
                middle[right] += 0.5*overlap


def draw(may_use):
    """The picture as the text of an SVG file."""
    arrows = reduced(may_use)
    layers, steps = layered(framed(arrows))
    layers = ordered(layers, steps)
    middle = placed(layers, steps)
    left = min(middle[node] - 0.5*node_width(node) for node in middle) - MARGIN
    right = max(middle[node] + 0.5*node_width(node) for node in middle) + MARGIN
    pitch = BOX_HEIGHT + 2*FRAME_PAD + LAYER_GAP
    top = {node: MARGIN + FRAME_PAD + (len(layers) - 1 - k)*pitch for k, layer in enumerate(layers) for node in layer}
    middle = {node: x - left for node, x in middle.items()}
    width, height = right - left, len(layers)*pitch - LAYER_GAP + 2*MARGIN
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0f}" height="{height:.0f}" '
             f'viewBox="0 0 {width:.0f} {height:.0f}" font-family="Helvetica, Arial, sans-serif">',
             "<title>Which component may use which: src/components.txt, drawn by doc/site/components.py</title>",
             '<rect width="100%" height="100%" fill="#ffffff"/>',
             '<defs><marker id="tip" viewBox="0 0 10 8" refX="9" refY="4" markerWidth="8" markerHeight="6.4" '
             'orient="auto"><path d="M0,0 L10,4 L0,8 z" fill="#4a5563"/></marker></defs>']
    parts += arrow_paths(steps, middle, top)
    for layer in layers:
        for node in layer:
            if node[0] != "":
                parts += node_shapes(node, middle[node], top[node])
    return "\n".join(parts) + "\n</svg>\n"


def extent(node, top):
    """Upper and lower end of a node, the frame included."""
    pad = FRAME_PAD if len(node) > 1 and node[0] != "" else 0
    return top[node] - pad, top[node] + BOX_HEIGHT + pad


def ports(nodes, steps, middle, side):
    """Where each arrow leaves (side 0) or reaches (side 1) a node: in the order of their other ends."""
    at = {}
    for node in nodes:
        mine = sorted((step for step in steps if step[side] == node), key=lambda step: middle[step[1 - side]])
        span = 0.0 if node[0] == "" else 0.5*node_width(node)
        for k, step in enumerate(mine):
            at[step] = middle[node] + span*((k + 0.5)/len(mine) - 0.5)
    return at


def arrow_paths(steps, middle, top):
    leaves = ports(middle, steps, middle, 0)
    reaches = ports(middle, steps, middle, 1)
    following = {step[0]: step for step in steps if step[0][0] == ""}
    parts = []
    for step in steps:
        if step[0][0] == "":
            continue
        upper, lower = step
        y = extent(upper, top)[1]
        path = f"M{leaves[step]:.1f},{y:.1f}"
        while True:
            x, end = reaches[step], extent(lower, top)[0]
            bend = 0.5*(y + end)
            start = leaves[step]
            path += f" C{start:.1f},{bend:.1f} {x:.1f},{bend:.1f} {x:.1f},{end:.1f}"
            if lower[0] != "":
                break
            y = extent(lower, top)[1]
            path += f" L{x:.1f},{y:.1f}"
            step = following[lower]
            lower = step[1]
        parts.append(f'<path d="{path}" fill="none" stroke="#4a5563" stroke-width="1.4" marker-end="url(#tip)"/>')
    return parts


def node_shapes(node, x, y):
    parts = []
    width = node_width(node)
    begin = x - 0.5*width
    if len(node) > 1:
        parts.append(f'<rect x="{begin:.1f}" y="{y - FRAME_PAD:.1f}" width="{width:.1f}" '
                     f'height="{BOX_HEIGHT + 2*FRAME_PAD}" rx="8" fill="#f3f5f8" stroke="#9aa5b1" '
                     'stroke-dasharray="4 3"/>')
        begin += FRAME_PAD
    for name in node:
        parts += box_shapes(name, begin, y)
        begin += box_width(name) + BOX_GAP
    return parts


def box_shapes(component, begin, y):
    width = box_width(component)
    fill = "#dcecf7" if component in LIBRARY else "#fbe9d0"
    parts = [f'<rect x="{begin:.1f}" y="{y:.1f}" width="{width:.1f}" height="{BOX_HEIGHT}" rx="5" '
             f'fill="{fill}" stroke="#4a5563"/>']
    name, contents = box_lines(component)
    looks = [(name, f'font-size="{NAME_SIZE}" font-weight="bold"')]
    looks += [(text, f'font-size="{TEXT_SIZE}" fill="#333333"') for text in contents]
    first = y + 0.5*(BOX_HEIGHT - LINE_HEIGHT*(len(looks) - 1)) + 5
    for k, (text, look) in enumerate(looks):
        parts.append(f'<text x="{begin + 0.5*width:.1f}" y="{first + LINE_HEIGHT*k:.1f}" text-anchor="middle" '
                     f'{look}>{text}</text>')
    return parts


def main():
    table, picture = (pathlib.Path(name) for name in sys.argv[1:3])
    text = draw(read_table(table))
    if sys.argv[3:] != ["--check"]:
        picture.write_text(text)
    elif not picture.exists() or picture.read_text() != text:
        sys.exit(f"{picture} is not what {table} gives: run\n  python3 doc/site/components.py {table} {picture}")


if __name__ == "__main__":
    main()
