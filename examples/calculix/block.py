"""A steel block with a cylindrical top, R = 250 mm, on a rigid plate in plane strain: fuge, CalculiX, Hertz.

To run in a folder with the .inp files, where CalculiX and this script write theirs. N, mm, s of the processor.
"""

import time
from pathlib import Path
from types import SimpleNamespace

import ccx
import numpy as np
import verdict
from slab import block, write

import fuge

YOUNG, POISSON, LOAD, RADIUS, THICKNESS = 2.1e5, 0.3, 5.0, 250.0, 0.1  # The load of the half modelled.
WIDTH = np.sqrt(8.0 * LOAD / THICKNESS * RADIUS / (np.pi * YOUNG / (1.0 - POISSON**2)))
PRESSURE = 4.0 * LOAD / THICKNESS / (np.pi * WIDTH)
# Blocks: at least so wide (their half) and high, and their elements over SPACING. Most results are those of the second.
BLOCKS = [(3.75, 1.0), (7.5, 1.0), (15.0, 1.0), (30.0, 1.0), (30.0, 0.5)]
# Elements under the contact, about 15 on its half-width, their growth, and how far from the middle nodes may touch.
SPACING, GROWTH, REACH = 0.025, 1.2, 0.55
# Penalties over Young's modulus, 1/mm. CalculiX advises 5 to 50.
RATIOS = [5.0, 50.0, 500.0, 5000.0]
LAPS = "ccx -i stiffness", "reading stiffness.sti, .dof and model.inp", "condense: the influence matrix", "contact"
PENALTY_HEAD = """
CalculiX's own contact with a penalty K: differences from fuge
     K/E    time incre- itera- nodes in  penetration  approach   displace-  forces     forces, fuge
  [1/mm]     [s]  ments  tions  contact    /approach             ments                 with 1/K too"""
HERTZ_HEAD = f"""
Against Hertz: a ={WIDTH:7.4f} mm, p_0 ={PRESSURE:7.2f} N/mm2
   block  element  half-width     error    pressure     error             all, with
     [a]      [a]        [mm]               [N/mm2]            unknowns     ccx [s]"""


def solve(side, finer):
    """Press a block on the plate. Contact nodes come in pairs of front and back; `place` are their x and z."""
    write("mesh.inp", block("BLOCK", side, SPACING * finer, GROWTH**finer, REACH, THICKNESS, RADIUS))
    assembling, _ = ccx.run("stiffness")
    clock = [time.process_time()]
    stiffness, mesh = fuge.read_stiffness("stiffness.sti"), fuge.read_mesh("model.inp")
    top, dof = mesh.node_set("BLOCKFACE"), mesh.set_dof("BLOCKFACE", 3, stiffness)
    clock.append(time.process_time())
    body = fuge.Body(stiffness)
    body.set_contact(dof, np.full(dof.size, -1.0))  # The forces act downwards.
    influence = body.condense().influence
    clock.append(time.process_time())
    contact = fuge.solve(influence, -mesh.position[top, 2], LOAD)
    found = SimpleNamespace(stiffness=stiffness, influence=influence, contact=contact, force=contact.force)
    found.laps = [assembling, *np.diff([*clock, time.process_time()])]
    found.displacement = body.recover(contact.force)
    found.node, found.place = mesh.node[top], mesh.position[top][:, [0, 2]]
    return found


def node_areas(place):
    """A quarter of each face around, of nodes in pairs of front and back."""
    quarter = 0.25 * THICKNESS * np.linalg.norm(place[2:] - place[:-2], axis=1)
    return np.pad(quarter, (2, 0)) + np.pad(quarter, (0, 2))


def compare_influence(ours):
    """Sizes and times; every other column by a linear step of CalculiX with a unit load, which prints seven digits."""
    sizes = f"{ours.displacement.size:8} degrees of freedom, {ours.node.size} points"
    print(f"Stiffness by CalculiX, contact by fuge\n{sizes}, {np.count_nonzero(ours.force > 0.0)} touch")
    for name, lap in zip([*LAPS, "together"], [*ours.laps, sum(ours.laps)]):
        print(f"{lap:9.4f} s  {name}")
    step = "*STEP\n*STATIC\n*CLOAD, OP=NEW\n{}, 3, -1.\n*NODE PRINT, NSET=BLOCKFACE\nU\n*END STEP\n"
    Path("unit.inp").write_text("*INCLUDE, INPUT=model.inp\n" + "".join(step.format(node) for node in ours.node[::2]))
    seconds, _ = ccx.run("unit")
    printed = np.column_stack([-ccx.at_nodes(table, ours.node)[:, 2] for table in ccx.tables("unit", "displacements")])
    error = np.abs(printed / ours.influence[:, ::2] - 1.0).max()
    asymmetry = np.abs(printed[::2] / printed[::2].T - 1.0).max()
    print(f"{seconds:9.4f} s  ccx -i unit: every other column by a unit load")
    print(f"{'':11}largest relative difference{error:8.1E}, asymmetry of these{asymmetry:8.1E}")
    verdict.compare(error, 6e-7, "the influence matrix of CalculiX")
    verdict.compare(asymmetry, 1.2e-6, "the symmetry of the influence matrix")


def compare_penalty(ratio, ours):
    """A line of the table; forces and gaps."""
    # CalculiX's smooth spring pulls a little across wide gaps; the last number is the reach of its search.
    Path("penalty.inp").write_text(f"*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n{ratio * YOUNG}, 1.e-6, 1.\n")
    seconds, _ = ccx.run("contact")
    body, plate = ccx.tables("contact", "displacements")
    (gap,), (pressure,) = ccx.tables("contact", "relative contact"), ccx.tables("contact", "contact stress")
    gap, pressure = (ccx.at_nodes(table, ours.node)[:, 0] for table in (gap, pressure))
    # CalculiX takes areas from the deformed surface.
    area = node_areas(ours.place + ccx.at_nodes(body, ours.node)[:, [0, 2]])
    force, approach = pressure * area, ours.contact.approach
    # A penalty is a spring on each node: with it fuge gives what CalculiX gives, at any penalty.
    springs = fuge.solve(ours.influence, -ours.place[:, 1], LOAD, compliance=1.0 / (ratio * YOUNG * area))
    with_springs = verdict.difference(force, springs.force)
    rows = np.arange(ours.displacement.size), ours.stiffness.direction - 1
    field = verdict.difference(ccx.at_nodes(body, ours.stiffness.node)[rows], ours.displacement)
    line = f"{ratio:7.0f}.{seconds:8.2f}" + "{:7}{:7}".format(*ccx.count_iterations("contact"))
    line += f"{np.count_nonzero(gap < 0.0):9}{-gap.min() / approach:13.1E}{-plate[0, 3] / approach - 1.0:10.1E}"
    print(f"{line}{field:12.1E}{verdict.difference(force, ours.force):8.1E}{with_springs:17.1E}")
    verdict.compare(force.sum() / LOAD - 1.0, 1e-5, "the sum of the forces of CalculiX")
    verdict.compare(with_springs, 1e-5, "the forces with the springs of CalculiX")
    return force, gap


def compare_penalties(ours):
    """Also calculix.csv for the picture: x, pressures and gaps of the nodes in front."""
    print(PENALTY_HEAD)
    answers = [compare_penalty(ratio, ours) for ratio in RATIOS]
    errors = [verdict.difference(force, ours.force) for force, _ in answers]
    verdict.hold(np.all(np.diff(errors) < 0.0) and 9.0 <= errors[-2] / errors[-1] <= 11.0, "errors falling like 1/K")
    verdict.hold(np.all((answers[-1][1] < 0.0) == (ours.force > 0.0)), "the nodes that touch in CalculiX")
    columns = [(force / node_areas(ours.place), gap) for force, gap in [(ours.force, ours.contact.gap), *answers]]
    np.savetxt("calculix.csv", np.vstack([ours.place[:, 0], *columns]).T[::2], "%.6e", ",")


def compare_hertz(block, side, finer):
    """p**2 = p_0**2 (1 - x**2/a**2) nearest to the pressures of all but the two outermost nodes; errors of a, p_0."""
    inside = slice(np.count_nonzero(block.force > 0.0) - 4)
    pressure = (block.force / node_areas(block.place))[inside]
    slope, square = np.polyfit(block.place[inside, 0] ** 2, pressure**2, 1)
    width, pressure = np.sqrt(-square / slope), np.sqrt(square)
    errors = width / WIDTH - 1.0, pressure / PRESSURE - 1.0
    line = f"{side / WIDTH:8.1f}{SPACING * finer / WIDTH:9.4f}{width:12.4f}{100.0 * errors[0]:8.2f} %"
    line += f"{pressure:12.4f}{100.0 * errors[1]:8.2f} %"
    print(f"{line}{block.displacement.size:10}{sum(block.laps):12.2f}")
    return errors


if __name__ == "__main__":
    ours = solve(*BLOCKS[1])
    compare_influence(ours)
    compare_penalties(ours)
    print(HERTZ_HEAD)
    errors = [compare_hertz(solve(*size), *size) for size in BLOCKS]
    verdict.compare(errors[-1][0], 2e-3, "the half-width of Hertz")
    verdict.compare(errors[-1][1], 2e-3, "the pressure of Hertz")
    verdict.give("as CalculiX with springs, and Hertz")
