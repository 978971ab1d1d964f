"""Jobs of CalculiX, its tables, and contact of two bodies by fuge and by itself. Times: s of the processor."""

import os
import subprocess
import time
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np

import fuge

# The environment variable CCX may name another command.
COMMAND = os.environ.get("CCX", "ccx")


def run(job, most="unlimited"):
    """The time of a job, at most `most`, and whether it has ended without an error. One without a limit has to."""
    for ending in ("dat", "frd", "sta", "sti", "dof"):
        Path(f"{job}.{ending}").unlink(missing_ok=True)
    before = os.times()
    limited = 'ulimit -t "$0"; exec "$1" -i "$2" >"$2.log" 2>&1'
    ended = subprocess.run(["sh", "-c", limited, str(most), COMMAND, job]).returncode == 0
    if most == "unlimited" and not ended:
        raise SystemExit(f"{COMMAND} -i {job} has failed: see {job}.log")
    return sum(os.times()[2:4]) - sum(before[2:4]), ended


def tables(job, heading):
    """The tables of job.dat whose headings begin so, step by step: node and values on each line; sums have no node."""
    parts = Path(f"{job}.dat").read_text().strip().split("\n\n")
    chosen = [rows for head, rows in zip(parts, parts[1:]) if head.strip().startswith(heading)]
    return [np.loadtxt(rows.splitlines(), ndmin=2) for rows in chosen]


def contact_table(job):
    """The last one of job.frd: node, gap (negative where bodies overlap), two slips, pressure, two shear stresses."""
    text = Path(f"{job}.frd").read_text()
    lines = text[text.rindex("\n -4  CONTACT ") :].split("\n -3")[0].splitlines()
    rows = [line for line in lines if line.startswith(" -1")]
    return np.genfromtxt(rows, delimiter=(3, 10) + 6 * (12,))[:, 1:]


def at_nodes(table, nodes):
    """The values of these nodes in a table; 0 for nodes that it does not have."""
    values = dict(zip(table[:, 0], table[:, 1:]))
    return np.array([values.get(node, np.zeros(table.shape[1] - 1)) for node in nodes])


def count_iterations(job):
    """Increments of a job and its iterations, those of failed attempts included: job.sta."""
    path = Path(f"{job}.sta")
    lines = path.read_text().splitlines()[2:] if path.exists() else []
    rows = [row for row in map(str.split, lines) if len(row) > 3]
    return max((int(row[1]) for row in rows), default=0), sum(int(row[3]) for row in rows)


def solve_by_fuge(model, surfaces, moved=None, smooth=True, unit_length=1.0, unit_force=1.0):
    """Solve the contact of two surfaces of MODEL.inp; the job MODEL_stiffness writes the stiffness of both bodies.

    `moved`: a set of nodes and its displacement along z. What the files say is in `unit_length` and `unit_force`.
    """
    assembling, _ = run(f"{model}_stiffness")
    start = time.process_time()
    stiffness, mesh = fuge.read_stiffness(f"{model}_stiffness.sti"), fuge.read_mesh(f"{model}.inp")
    contact, opposite = (mesh.surface(name, stiffness) for name in surfaces)
    contact, opposite = (replace(surface, node=unit_length * surface.node) for surface in (contact, opposite))
    bodies = fuge.ElasticBodies()
    both = bodies.add(replace(stiffness, value=stiffness.value * (unit_force / unit_length)))
    bodies.add_pair(both, contact, both, opposite, smooth=smooth)
    if moved:
        both.fix(mesh.set_dof(moved[0], 3, stiffness), moved[1])
    found = SimpleNamespace(contact=bodies.solve(), assembling=assembling, solving=time.process_time() - start)
    found.degrees, found.node = stiffness.node.size, mesh.node[found.contact.node]
    found.position = mesh.position[found.contact.node]
    return found


def solve_by_calculix(model, surfaces, supported, method, penalty=None, clearance=None, most=12):
    """Solve MODEL_contact by a method of *CONTACT PAIR, and sum the forces on the set `supported`.

    The penalty is pressure over penetration, None for CalculiX's, infinite for none; the clearance that of *CLEARANCE.
    """
    job, (contact, opposite) = f"{model}_contact", surfaces
    law = "*SURFACE INTERACTION, NAME=LAW\n"
    if penalty != np.inf:
        law += "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n" + (f"{penalty:.13E}\n" if penalty else "")
    law += f"*CONTACT PAIR, INTERACTION=LAW, TYPE={method}\n{contact}, {opposite}\n"
    if clearance is not None:
        law += f"*CLEARANCE, MASTER={opposite}, SLAVE={contact}, VALUE={clearance:.13E}\n"
    Path(f"{model}_law.inp").write_text(law)
    seconds, solved = run(job, most)
    answer = SimpleNamespace(solved=solved, seconds=seconds, iterations=count_iterations(job), table=np.zeros((1, 7)))
    if solved:
        answer.total = tables(job, f"total force (fx,fy,fz) for set {supported} ")[-1][0]
        answer.table = contact_table(job)
    return answer
