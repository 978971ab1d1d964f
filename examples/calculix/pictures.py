"""Draw doc/calculix.png or doc/calculix_two_bodies.png in the folder of its tables: python pictures.py NAME."""

import sys

import block
import matplotlib
import numpy as np
from matplotlib.figure import Figure

# Known answers are grey lines, and fuge's marks are full, as in all pictures.
KNOWN, FUGE = {"color": "#999999", "linewidth": 2.5}, {"color": "#0072b2", "marker": "o", "linestyle": "none"}
LOOKS = [("#d55e00", "o"), ("#009e73", "s"), ("#cc79a7", "^")]
OTHER, OTHER_TOO, OTHER_THIRD = ({"color": color, "marker": mark, "fillstyle": "none"} for color, mark in LOOKS)
MARKS = {**OTHER_TOO, "linestyle": "none", "markersize": 7.0}
STYLE = {"font.size": 9.4, "axes.titlesize": 9.4, "axes.spines.top": False, "axes.spines.right": False}
STYLE.update({"axes.grid": True, "grid.color": "#e2e2e2", "grid.linewidth": 0.6, "legend.frameon": False})
STYLE.update({"xtick.direction": "in", "ytick.direction": "in", "lines.linewidth": 1.2, "lines.markersize": 4.2})


def panel(axes, title, label, right, low, high, *curves):
    for name, x, y, look in curves:
        axes.plot(x, y, label=name, clip_on=False, **look)
    axes.set(title=title, xlabel="x [mm]", ylabel=label, xlim=(0.0, right), ylim=(low, high))
    axes.legend()


def calculix(left, right):
    x, pressure, gap, soft, soft_gap, stiff, stiff_gap = np.loadtxt("calculix.csv", delimiter=",").T[:7]
    known = np.linspace(0.0, 0.56, 2001)
    hertz = block.PRESSURE * np.sqrt(np.maximum(1.0 - (known / block.WIDTH) ** 2, 0.0))
    curves = ("Hertz, half-plane", known, hertz, KNOWN), ("penalty 5 E/mm", x, soft, OTHER)
    curves += ("penalty 50 E/mm", x, stiff, OTHER_TOO), ("fuge", x, pressure, FUGE)
    panel(left, "Steel block on a rigid plate: pressure", "nodal force / area [N/mm$^2$]", 0.56, 0.0, 185.0, *curves)
    right.axhline(0.0, color="#777777", linewidth=1.0)
    curves = (("CalculiX, penalty 5 E/mm", x, 1e3 * soft_gap, OTHER),)
    curves += ("CalculiX, penalty 50 E/mm", x, 1e3 * stiff_gap, OTHER_TOO), ("fuge", x, 1e3 * gap, FUGE)
    panel(right, "Gap; with penalties the bodies overlap", "gap [µm]", 0.56, -0.16, 0.2, *curves)


def calculix_two_bodies(left, right):
    table, hertz = (np.loadtxt(name, delimiter=",").T for name in ("calculix_two_bodies.csv", "hertz.csv"))
    x, *pressure = table[:, table[0] < 0.62]
    known, fuge = ("Hertz", *hertz, KNOWN), ("fuge", x, pressure[0], FUGE)
    curves = ("penalty 5 E/mm", x, pressure[1], OTHER), ("500 E/mm", x, pressure[3], OTHER_TOO)
    title, label = "Aluminium pressed on steel; CalculiX: surface to surface", "pressure at the nodes [N/mm$^2$]"
    panel(left, title, label, 0.62, 0.0, 235.0, known, *curves, ("5000 E/mm", x, pressure[4], OTHER_THIRD), fuge)
    curves = ("node to surface, 50 E/mm", x, pressure[6], OTHER), ("mortar", x, pressure[9], MARKS)
    panel(right, "CalculiX: node to surface, mortar", "", 0.62, 0.0, 235.0, known, *curves, fuge)
    right.tick_params(labelleft=False)


if __name__ == "__main__":
    matplotlib.rcParams.update(STYLE)
    name = sys.argv[1]
    picture = Figure(figsize=(8.0, 3.7 if name == "calculix" else 3.5), layout="constrained")
    {"calculix": calculix, "calculix_two_bodies": calculix_two_bodies}[name](*picture.subplots(1, 2))
    picture.savefig(f"{name}.png", dpi=200)
