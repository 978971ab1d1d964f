"""A shaft of 40.005 mm pressed into a hub of 40.000 mm, their meshes not matching: fuge, CalculiX, Lame's formulas.

To run in a folder with the .inp files, where CalculiX and this script write theirs. N, mm.
"""

import ccx
import numpy as np
import verdict
from slab import Slab, write

# Radii of bore, fit and rim, and the interference of the radii.
YOUNG, BORE, FIT, RIM, INTERFERENCE, THICKNESS = 1.96e5, 10.0, 20.0, 30.0, 2.5e-3, 1.0
# The pressure between two hollow cylinders of one material in plane stress.
LAME = YOUNG * INTERFERENCE / FIT / ((FIT**2 + BORE**2) / (FIT**2 - BORE**2) + (RIM**2 + FIT**2) / (RIM**2 - FIT**2))
# Elements of shaft and hub along the quarter, and the order of the elements.
MESHES = [(12, 12, 1), (12, 8, 1), (16, 24, 1), (6, 4, 2), (12, 8, 2), (8, 12, 2)]
MODEL, AREA = ("fit", ("SSHAFT", "SHUB")), FIT * THICKNESS
# CalculiX's method, penalty and clearance.
LAWS = [("SURFACE TO SURFACE",), ("SURFACE TO SURFACE", None, -INTERFERENCE), ("NODE TO SURFACE",), ("MORTAR", np.inf)]
HEAD = """\
  elements            fuge              at nodes      CalculiX, mean pressure [N/mm2]
  shaft  hub        [N/mm2]  error    from     to     surface to  the same,     node to      mortar
                                                      surface  *CLEARANCE     surface"""


def ring(name, count, order, contact, other, above):
    """A quarter of a ring from the radius of its contact surface to that of the other one, four elements across."""
    angle, radius = np.linspace(0.0, 0.5 * np.pi, order * count + 1), np.linspace(contact, other, 4 * order + 1)
    place = radius[:, None] * np.stack([np.sin(angle), np.cos(angle)], axis=-1)[:, None]
    return Slab(name, place, THICKNESS, count, order, above)


def their_pressure(law):
    """That of the force that opens the hub along x."""
    answer = ccx.solve_by_calculix(*MODEL, "HUBFIRST", *law)
    return f"{abs(answer.total[0]) / AREA:12.4f}" if answer.solved else "   no result"


if __name__ == "__main__":
    print(f"Press fit, 40.005 mm in 40.000 mm: Lame's pressure is {LAME:.4f} N/mm2\n{HEAD}")
    for shaft, hub, order in MESHES:
        inner, outer = ("SHAFT", shaft, order, FIT + INTERFERENCE, BORE), ("HUB", hub, order, FIT, RIM)
        write("fit_mesh.inp", ring(*inner, above=False), ring(*outer, above=True))
        # Gaps are those of the round bodies, which is the default.
        contact = ccx.solve_by_fuge(*MODEL).contact
        pressure = contact.force @ contact.direction[:, 0] / AREA
        error = pressure / LAME - 1.0
        line = f"{shaft:7}{hub:5}  {'C3D8' if order == 1 else 'C3D20':5}{pressure:8.4f}{100.0 * error:6.2f} %"
        line += f"{contact.pressure.min():7.3f}{contact.pressure.max():7.3f}"
        print(line + "".join(their_pressure(law) for law in LAWS))
        verdict.compare(error, 5e-3, "the pressure of the fit by Lame")
    verdict.give("against Lame")
