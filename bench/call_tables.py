"""The tables of what a call takes, from what the programs `choices` and `costs_bodies` have printed."""
import re

from report_text import memory, seconds, short, table

UNITS = {"ms": 1e-3, "MB": 1e6}


def rows_of(text):
    """The cells of each row by its first one, as numbers without units where they are numbers."""
    found = {}
    for line in text.splitlines()[2:]:
        name, *cells = (cell.strip() for cell in line.strip().strip("|").split("|"))
        found[name] = [[_number(part) for part in cell.split(",")] for cell in cells]
    return found


def _number(text):
    match = re.match(r"([-+.\dE]*\d[.\dE+-]*) *(ms|MB)?$", text.strip())
    return float(match[1])*UNITS.get(match[2], 1.0) if match else None


def tables(choices, bodies):
    """The four tables by the names of their places; none without the figures."""
    if not choices or not bodies:
        return {}
    found = rows_of(choices)

    def row(contact, call, key):
        pressure, approach, width, time, held = (cells[0] for cells in found[key])
        errors = "; ".join(short(error) for error in (pressure, approach) if error is not None)
        if width is not None and approach is None:
            errors += f"; half width {short(width)}"
        return [contact, call, errors, seconds(time), memory(held)]

    def time_of(key):
        return seconds(found[key][3][0])

    head = ["contact", "call", "error of the pressure; of the approach", "time", "memory"]
    line = [row("a smooth profile, in one contact", "`fuge_solve_smooth_punch`, no grid", "smooth"),
            row("any gap on equal cells, also rough or periodic", "`fuge_halfplane_operator`, 2^12 cells", "line_12"),
            row("", "2^16 cells", "line_16"), row("", "2^20 cells", "line_20"),
            row("up to some 100 equal cells", "`fuge_halfplane_matrix`, 64 cells", "equal_64"),
            row("edges and corners, few cells", "`fuge_graded_cells`, `fuge_halfplane_matrix`, 70 cells", "graded_64"),
            row("a flat face with corners", "the same, 64 cells", "corner_64")]
    area = [["two quadratic surfaces", "`fuge_hertz_ellipse`", "closed form", "", ""],
            row("a round punch, its profile smooth or of powers", "`fuge_solve_round_punch`, no grid", "round"),
            row("round bodies, any gap", "`fuge_ring_matrix`, 200 rings", "rings_200"),
            row("any gap on a rectangle", "`fuge_halfspace_operator`, 64 x 64 cells", "area_64"),
            row("", "256 x 256 cells", "area_256"), row("", "1024 x 1024 cells", "area_1024"),
            ["a rough surface", "the same, periodic, 1024 x 1024 cells", "[that of the grid](#rough-contact)",
             time_of("rough_1024"), memory(found["rough_1024"][4][0])],
            ["more cells than one machine holds", "`fuge_mpi_halfspace_operator`", "the same", "[mpi.md](mpi.md)", ""]]
    points = [[("n points" if k == 0 else ""), ("`fuge_solve_dense`, " if k == 0 else "") + f"n = {n}",
               short(found[f"matrix_{n}"][0][0]), time_of(f"matrix_{n}")] for k, n in enumerate((50, 200, 800, 2000))]
    costs = "[in multiples of a solve](#what-more-than-a-solution-costs)"
    points += [["one load after the other", "`fuge_solver`, kept from solve to solve", "the same", costs],
               ["every load at which a point joins", "`fuge_load_path`", "the same", costs],
               ["no matrix, but products A f", "an extension of `fuge_operator`; in C `fuge_operator_callback`",
                "the tolerance", "[products](#products-only)"]]
    return {"line_calls": table(head, line, 2), "area_calls": table(head, area, 2),
            "matrix_calls": table(["given", "call", "error of the forces", "time"], points, 2),
            "body_calls": body_table(rows_of(bodies))}


def body_table(bodies):
    head = ["given", "call", "error of the forces", "once", "a solve", "displacements", "memory"]
    calls = "`fuge_sparse_stiffness`, `fuge_condense`; "
    rows = []
    names = ("sparse stiffness matrix, in two dimensions", "", "in three dimensions", "")
    for k, (name, figures) in enumerate(zip(names, bodies.items())):
        body, (once, solve, displaced, errors, held) = figures
        size = re.search(r", (.*)", body)[1]
        if k == 0:
            size = size.replace(" points", " contact points")
        else:
            size = size.replace(" degrees of freedom", " degrees")
        rows.append([name, (calls if k == 0 else "") + size, short(errors[0]), seconds(once[0]), seconds(solve[0]),
                     seconds(displaced[0]), memory(held[0])])
    others = (("two meshes that do not match", "`fuge_solve_bodies`", "[where it goes](#where-the-time-goes)"),
              ("a band or a full matrix", "`fuge_band_stiffness`, `fuge_dense_stiffness`", ""),
              ("files of CalculiX, Abaqus or Nastran", "the command `fuge`", "[command.md](command.md)"))
    rows += [[name, call, "of the mesh", time, "", "", ""] for name, call, time in others]
    return table(head, rows, 2)
