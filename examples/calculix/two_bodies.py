"""Aluminium with a cylindrical face, R = 100 mm, on steel, meshes that do not match: fuge, CalculiX's own methods.

To run in a folder with the .inp files, where CalculiX and this script write theirs. N, mm, s of the processor.
"""

from functools import partial
from math import ceil, inf
from pathlib import Path

import ccx
import numpy as np
import verdict
from slab import block, write

MATERIALS, YOUNG, POISSON = ("ALUMINIUM", "STEEL"), np.array([7e4, 2.1e5]), np.array([0.33, 0.3])
RADIUS, THICKNESS, SIDE = 100.0, 0.1, 10.0
# The bodies overlap in the mesh, because CalculiX's mortar contact does not start from bodies that only touch.
OVERLAP, DEPTH = 1e-5, 4e-3
# Elements up to REACH from the middle, growth of those farther out, and how many times finer the reference is.
SPACING, REACH, GROWTH, FINER = (0.05, 0.07), 0.9, 1.25, 3
MODEL = "pressed", ("SUPPER", "SLOWER")
press_by_calculix = partial(ccx.solve_by_calculix, *MODEL, "UPPEREND")
# CalculiX's methods and their penalties over Young's modulus, 1/mm; 50 is its default.
METHODS = [(method, ratio) for method in ("SURFACE TO SURFACE", "NODE TO SURFACE") for ratio in (5, 50, 500, 5000)]
METHODS += [("MORTAR", inf), ("PGLINMORTAR", inf)]
# What 1 mm and 1 N are; the files in the last units remain.
UNITS = {"m, N": (1e-3, 1.0), "inch,lbf": (1.0 / 25.4, 1.0 / 4.4482216152605), "mm, N": (1.0, 1.0)}
MESH_HEAD = """\
Two elastic bodies, meshes that do not match: stiffness by CalculiX, contact by fuge
                            contact  nodes in     ccx    fuge    force of the  largest pressure
                  unknowns   points   contact     [s]     [s]        half [N]           [N/mm2]"""
METHOD_HEAD = """
The same contact by CalculiX; processor times; differences of pressures over the largest one
  method                 K/E    time incre- itera- nodes in penetration     force    error  pressures
                      [1/mm]     [s]  ments  tions  contact        [mm]       [N]           fuge   fine"""
UNITS_HEAD = """
The same model in other units: force of the half [N]
  units      surface to    the same,  K of mm, N       mortar         fuge   differences
                surface  steel first                                           of forces"""


def write_model(length=1.0, force=1.0, finer=1, order=(0, 1)):
    """In any units. The order of the materials matters to CalculiX's default penalty alone."""
    size = GROWTH, REACH, THICKNESS
    upper = block("UPPER", SIDE, SPACING[0], *size, RADIUS, finer, above=True, shift=-OVERLAP)
    write("pressed_mesh.inp", upper, block("LOWER", SIDE, SPACING[1], *size, parts=finer), unit=length)
    Path("pressed_motion.inp").write_text(f"*BOUNDARY\nUPPEREND, 3, 3, {(OVERLAP - DEPTH) * length:.13E}\n")
    card = "*MATERIAL, NAME={}\n*ELASTIC\n{:.13E}, {}\n*DENSITY\n1.\n"
    cards = [card.format(MATERIALS[k], YOUNG[k] * force / length**2, POISSON[k]) for k in order]
    Path("pressed_material.inp").write_text("".join(cards))


def press_by_fuge(smooth=False, length=1.0, **converted):
    """`smooth`: with the gaps of the cylinder that the linear elements stand for, or with those of their faces."""
    return ccx.solve_by_fuge(*MODEL, ("UPPEREND", (OVERLAP - DEPTH) * length), smooth, **converted)


def profile(solved):
    """Node, x and pressure in front, but for the middle, where CalculiX's mortar methods print no pressure."""
    front = (solved.position[:, 1] == 0.0) & (solved.position[:, 0] > 0.0)
    return solved.node[front], solved.position[front, 0], solved.contact.pressure[front]


def solve_meshes():
    """By fuge: with faces as they are, and with the finer mesh, beside Hertz's half-plane, a table for the picture."""
    write_model(finer=FINER)
    fine = press_by_fuge(smooth=True)
    write_model()
    ours, smooth = press_by_fuge(), press_by_fuge(smooth=True)
    print(MESH_HEAD)
    for name, solved in {"faces as meshed": ours, "smooth": smooth, "smooth, fine": fine}.items():
        force = solved.contact.force
        line = f"  {name:15}{solved.degrees:9}{force.size:9}{np.count_nonzero(force > 0.0):9}{solved.assembling:10.2f}"
        print(f"{line}{solved.solving:8.3f}{force.sum():16.5f}{profile(solved)[2].max():18.2f}")
    total = fine.contact.force.sum()
    load = 2.0 * total / THICKNESS
    width = np.sqrt(4.0 * load * RADIUS / np.pi * np.sum((1.0 - POISSON**2) / YOUNG))
    pressure = 2.0 * load / (np.pi * width)
    print(f"Hertz for the force of the fine mesh: p_0 ={pressure:7.2f} N/mm2, half-width{width:7.4f} mm")
    verdict.compare(ours.contact.force.sum() / total - 1.0, 1e-2, "the force on the finer mesh")
    verdict.compare(profile(fine)[2].max() / pressure - 1.0, 1e-2, "the pressure of Hertz")
    angle = np.linspace(0.0, 0.5 * np.pi, 401)
    np.savetxt("hertz.csv", np.column_stack([width * np.sin(angle), pressure * np.cos(angle)]), "%.6e", ",")
    return ours, fine


def compare_methods(ours, fine):
    """CalculiX's methods one after the other, also as a table for the picture; seconds of its mortar contact."""
    (node, x, own), force = profile(ours), ours.contact.force.sum()
    _, fine_x, fine_pressure = profile(fine)
    reference = np.interp(x, fine_x, fine_pressure), fine_pressure.max()
    seconds, touching = ours.assembling + ours.solving, np.count_nonzero(own > 0.0)
    line = f"{METHOD_HEAD}\n  fuge{seconds:32.2f}{touching:23}{force:22.5f}"
    print(f"{line}{verdict.difference(own, *reference):23.3f}")
    columns, times = [x, own], {}
    for method, ratio in METHODS:
        answer = press_by_calculix(method, ratio * YOUNG[0])
        line = f"  {method:18}{'hard' if ratio == inf else f'{ratio}.':>10}{answer.seconds:8.2f}"
        line += "{:7}{:7}".format(*answer.iterations)
        gap, pressure = ccx.at_nodes(answer.table, node)[:, [0, 3]].T
        columns.append(pressure)
        times[method] = answer.seconds
        if not answer.solved:
            print(f"{line}   no result")
            continue
        touching, their_force = pressure > 0.0, -answer.total[2]
        error, apart = their_force / force - 1.0, verdict.difference(pressure, own)
        line += f"{np.count_nonzero(touching):9}{-gap[touching].min():12.1E}{their_force:10.5f}"
        line += f"{round(100.0 * error, 2) + 0.0:7.2f} %{apart:7.3f}"
        print(f"{line}{verdict.difference(pressure, *reference):7.3f}")
        # Mortar contact, without penalty, is the same discrete problem; penalties tend to a force near by.
        if method == "MORTAR":
            verdict.compare(error, 1e-5, "the force by mortar contact")
            verdict.compare(apart, 2e-3, "the pressures by mortar contact")
        elif ratio == 5000:
            verdict.compare(error, 1e-3, "the force that penalties tend to")
    np.savetxt("calculix_two_bodies.csv", np.column_stack(columns), "%.6e", ",")
    return times["MORTAR"]


def compare_units(ours, most_mortar):
    """By CalculiX's default penalty, also with steel first; by the number it is in mm and N; by mortar contact."""
    print(UNITS_HEAD)
    for name, (length, force) in UNITS.items():
        write_model(length, force)
        again = press_by_fuge(length=length).contact.force / force
        theirs = [press_by_calculix("SURFACE TO SURFACE", penalty) for penalty in (None, 50.0 * YOUNG[0])]
        theirs.append(press_by_calculix("MORTAR", inf, most=most_mortar))
        write_model(length, force, order=(1, 0))
        theirs.insert(1, press_by_calculix("SURFACE TO SURFACE"))
        forces = (f"{-own.total[2] / force:13.5f}" if own.solved else "    no result" for own in theirs)
        apart = verdict.difference(again, ours.contact.force)
        print(f"  {name:8}{''.join(forces)}{again.sum():13.5f}{apart:14.1E}")
        verdict.compare(apart, 1e-10, "the forces in other units")
    for name, (length, force) in list(UNITS.items())[:2]:
        again = press_by_fuge(length=length, unit_length=length, unit_force=force).contact.force / force
        apart = verdict.difference(again, ours.contact.force)
        print(f"  fuge, from files in mm and N converted to {name}: forces differ by{apart:8.1E}")
        verdict.compare(apart, 1e-12, "the forces in converted units")


if __name__ == "__main__":
    ours, fine = solve_meshes()
    compare_units(ours, ceil(3.0 * compare_methods(ours, fine)))
    verdict.give("against Hertz and mortar contact of CalculiX")
