"""Structures with one-way supports: reactions, names, tables, proofs of load cases, and what nothing holds."""

import csv
import itertools
import tempfile
import unittest
import warnings
from pathlib import Path

import numpy as np
from scipy import sparse

import fuge


def beam():
    """Two elements of length 1 and bending stiffness 1; deflection and slope of each of three nodes."""
    element = np.array([[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4.0]])
    stiffness = np.zeros((6, 6))
    stiffness[:4, :4] += element
    stiffness[2:, 2:] += element
    return stiffness


def truss(position, bars):
    """Bars of axial stiffness 1; degrees of freedom dimensions*node + axis."""
    position = np.asarray(position, dtype=float)
    nodes, dimensions = position.shape
    stiffness, dof = np.zeros((nodes * dimensions,) * 2), np.arange(nodes * dimensions).reshape(nodes, dimensions)
    for a, b in bars:
        span = position[b] - position[a]
        ends, h = np.r_[dof[a], dof[b]], np.r_[-span, span] / np.linalg.norm(span)
        stiffness[np.ix_(ends, ends)] += np.outer(h, h) / np.linalg.norm(span)
    return stiffness, position, dof


def standing(shape, held=(), links=(0, 1, 2, 3), direction=(0.0, 0.0, 1.0), named=False):
    """A cube of bars on feet at the corners `links`, which press along `direction`."""
    stiffness, position, dof = shape
    if named:
        columns, rows = np.triu_indices(24)
        first = np.r_[0, np.cumsum(np.arange(24, 0, -1))].astype(np.intc)
        names = np.repeat(np.arange(101, 109), 3).astype(np.intc), np.tile([1, 2, 3], 8).astype(np.intc)
        values = stiffness[rows, columns]
        stiffness = fuge.StiffnessFile((24, 24), first, rows.astype(np.intc), values, *names)
    body, feet = fuge.Body(stiffness), fuge.Links()
    for k in links:
        feet.add_support(dof[k], direction, compliance=0.1, name=f"foot {k}")
    body.fix(list(held))
    body.find_rigid_modes()
    body.set_links(feet)
    return body


CUBE = truss(sorted(itertools.product((0, 1), repeat=3), key=lambda p: p[::-1]), itertools.combinations(range(8), 2))


class Reactions(unittest.TestCase):
    def bodies(self):
        k, band = beam(), np.zeros((4, 6))
        for i in range(4):
            band[i, : 6 - i] = np.diag(k, -i)
        upper = np.array([np.r_[np.zeros(i), band[i, : 6 - i]] for i in (3, 2, 1, 0)])
        yield from (fuge.Body(k), fuge.Body.from_band(band), fuge.Body.from_band(upper, upper=True))
        yield from (
            fuge.Body(kind(part)) for part in (k, np.tril(k)) for kind in (sparse.csc_matrix, sparse.csr_matrix)
        )

    def test_propped_cantilever(self):
        # Fixed at the left, a prop at the right that only presses, 16 downwards in the middle of the span of 2.
        for body in self.bodies():
            prop = fuge.Links()
            prop.add_support(4, 1.0, name="prop")
            body.fix([0, 1])
            body.set_links(prop)
            body.condense()
            loads = np.zeros((3, 6))
            loads[0, [0, 2]], loads[1, 2] = [-7.0, -16.0], 16.0
            cases = body.solve_cases(loads, supports=[[0.0, 0.0], [0.0, 0.0], [-8.0, 0.0]])
            np.testing.assert_allclose(cases.force[:, 0], [5.0, 0.0, 3.0], rtol=1e-11)
            # 11/16 and 3/16 P L, and the load on the support itself; a cantilever; a settlement by 3 EI d/L^3.
            np.testing.assert_allclose(cases.reaction, [[18.0, 6.0], [-16.0, -16.0], [-3.0, -6.0]], rtol=1e-11)
            self.assertEqual(fuge.envelope(cases.reaction).largest_case.tolist(), [0, 0])
            body.set_load(loads[0])
            np.testing.assert_allclose(body.reaction(cases.displacement[0], cases.force[0]), [18.0, 6.0], rtol=1e-11)
        self.assertRaises(fuge.InputError, body.reaction, np.zeros(6), [1.0, 2.0])

    def test_links_between_nodes(self):
        # A node on springs of 100, linked to one that is fixed 5 away: E A/L = 100 takes half of a force along it.
        ends = [0, 1], [2, 3], [0.0, 0.0], [3.0, 4.0]
        links = [fuge.Links() for _ in range(4)]
        links[0].add_member(*ends, area=1.0, modulus=500.0)
        links[1].add_member(*ends, area=1.0, modulus=500.0, kind="compression_only")
        links[2].add_gap([2, 3], [0, 1], [-3.0, -4.0], compliance=0.01)
        links[3].add_gap([0, 1], [2, 3], [3.0, 4.0], gap=9.0, play=9.0, compliance=0.01)  # at its second stop
        for link, sign, prove in zip(links, (-1.0, 1.0, 1.0, -1.0), (False, True, False, True)):
            body = fuge.Body(np.diag([100.0] * 4))
            body.fix([2, 3])
            body.set_links(link)
            body.condense()
            cases = body.solve_cases([[sign * 6.0, sign * 8.0, 0.0, 0.0]], prove=prove)
            np.testing.assert_allclose(np.abs(cases.force), [[5.0]], rtol=1e-12)
            np.testing.assert_allclose(cases.reaction, [[-sign * 3.0, -sign * 4.0]], rtol=1e-12)

    def test_equilibrium(self):
        # Inclined feet, one at a corner that is held along x: part of their forces goes into the supports.
        body = standing(CUBE, held=(0, 1, 4), direction=(1.0, 0.0, 2.0))
        body.condense()
        loads = np.random.default_rng(3).standard_normal((5, 24))
        loads[:, 2::3] -= 4.0
        cases = body.solve_cases(loads)
        feet = np.zeros((5, 24))
        feet[:, [0, 3, 6, 9]], feet[:, [2, 5, 8, 11]] = cases.force / np.sqrt(5.0), 2.0 * cases.force / np.sqrt(5.0)
        supports = np.zeros((5, 24))
        supports[:, [0, 1, 4]] = cases.reaction
        np.testing.assert_allclose((loads + feet + supports) @ fuge.rigid_modes(CUBE[1]), np.zeros((5, 6)), atol=1e-11)
        self.assertGreater(np.abs(cases.reaction).min(axis=1).max(), 0.1)


class Names(unittest.TestCase):
    def test_messages(self):
        for named, dof in ((False, r"freedom \d+"), (True, r"freedom \d+ \(node 10\d, direction \d\)")):
            body = standing(CUBE, held=(0, 1, 4), links=(4,), named=named)
            body.condense()
            up = np.zeros((2, 24))
            up[:, 14] = -1.0, 1.0
            message = f"nothing balances the load: foot 4 opens, and degree of {dof} moves most"
            with self.assertWarnsRegex(
                fuge.CasesWarning, f"1 of 2 load cases failed, 0 have a warning; storm: {message}"
            ):
                cases = body.solve_cases(up, names=["snow", "storm"])
            self.assertEqual((cases.names, cases.links), (("snow", "storm"), ("foot 4",)))
            self.assertEqual(cases.supports, ("101.1", "101.2", "102.2") if named else ("0", "1", "4"))
            self.assertTrue(np.isnan(cases.reaction[1]).all())
            self.assertGreater(body.mechanism(up[1])[14], 0.5)
            self.assertEqual(np.abs(body.mechanism()).max(), 0.0)
        self.assertRaises(fuge.InputError, body.solve_cases, up, names=["snow"])

    def test_errors_name_links(self):
        body = fuge.Body(beam())
        wrong = fuge.Links()
        wrong.add_support(7, 1.0, name="foot 3")
        body.set_links(wrong)
        self.assertRaisesRegex(fuge.InputError, "^foot 3: dof.0. = 7 is not", body.condense)

    def test_motions(self):
        body = standing(CUBE, held=(0, 1, 4))
        body.condense()
        with self.assertWarnsRegex(fuge.CasesWarning, r"motion \d, which moves degree of freedom \d+ most"):
            body.solve_cases(np.zeros((1, 24)))

    def test_idle_links(self):
        body = standing(CUBE, held=(2, 5, 1, 4, 0))
        body.condense()
        loads = np.tile([0.0, 0.0, -1.0], (2, 8))
        with self.assertWarnsRegex(fuge.Warning, "foot 0, foot 1 can never act: supports of the body hold their ends"):
            body.solve_cases(loads)
        with self.assertWarnsRegex(fuge.Warning, "^foot 0 can never act: supports of the body hold its ends"):
            body.solve_cases(loads, supports=[[0.0] * 5, [0.0, -0.1, 0.0, 0.0, 0.0]])


class Tables(unittest.TestCase):
    def setUp(self):
        self.solver = fuge.Solver(np.diag([1.0, 1.0]))
        self.solver.set_gap([0.0, 1.0])
        self.solver.set_load(1.0)

    def test_cases(self):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            cases = self.solver.solve_cases(load=[3.0, -1.0], names=['a, "b"', "c"])
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "cases.csv"
            cases.write(path)
            with open(path, encoding="utf-8", newline="") as file:
                rows = list(csv.DictReader(file))
            self.assertRaisesRegex(fuge.FileError, "cannot be written", cases.write, Path(folder) / "none" / "x.csv")
        self.assertEqual([row["case"] for row in rows], ['a, "b"'] * 2 + ["c"] * 2)
        self.assertEqual([row["link"] for row in rows], ["point 0", "point 1"] * 2)
        self.assertEqual([row["state"] for row in rows], ["contact", "contact", "failed", "failed"])
        self.assertEqual([float(row["force"]) for row in rows[:2]], cases.force[0].tolist())
        table = cases.envelope_table()
        self.assertEqual(len(set(table)), 9)
        self.assertEqual(table.rows()[0][:5], ("point 0", 2.0, 'a, "b"', 2.0, 'a, "b"'))
        self.assertRaises(fuge.CallOrderError, cases.table, "reactions")
        self.assertRaises(fuge.InputError, cases.table, "forces")

    def test_reactions(self):
        body = standing(CUBE, held=(0, 1, 4))
        body.condense()
        cases = body.solve_cases(np.tile([0.0, 0.0, -1.0], (2, 8)), names=["x", "y"])
        self.assertEqual(
            [row[:2] for row in cases.table("reactions").rows()[2:5]], [("x", "4"), ("y", "0"), ("y", "1")]
        )
        np.testing.assert_array_equal(cases.table("reactions")["reaction"], cases.reaction.ravel())
        self.assertEqual(list(cases.envelope_table("reactions"))[:2], ["support", "smallest_reaction"])

    def test_proof(self):
        self.solver.set_gap([0.0, 1.0], [np.inf, 0.5])
        before = self.solver.solve()
        with self.assertWarns(fuge.CasesWarning):
            cases = self.solver.solve_cases([[0.0, 1.0], [np.nan, 1.0], [0.0, 0.3]], [[3.0], [1.0], [1.0]], prove=True)
        self.assertIsNone(cases.proof[1])
        for k, exact in ((0, [2.0, 1.0]), (2, [0.65, 0.35])):
            self.assertTrue(np.all(np.abs(cases.force[k] - exact) <= cases.proof[k].force_bound))
            self.assertLess(cases.proof[k].force_bound.max(), 1e-13)
        np.testing.assert_array_equal(cases.table()["force_bound"][[0, 1]], cases.proof[0].force_bound)
        # The problem is what it was, its prescribed motions too.
        np.testing.assert_array_equal(self.solver.solve().force, before.force)
        self.solver.set_approach(2.0)
        np.testing.assert_allclose(self.solver.solve_cases(load=[3.0], prove=True).force, [[3.0, 2.0]], rtol=1e-13)
        self.assertEqual(self.solver.solve().approach, 2.0)
        body = standing(CUBE, held=(0, 1, 4))
        body.condense()
        plain, proved = (body.solve_cases(np.tile([0.0, 0.0, -1.0], (1, 8)), prove=prove) for prove in (False, True))
        self.assertTrue(np.all(np.abs(proved.force - 2.0) <= proved.proof[0].force_bound + 1e-12))
        np.testing.assert_allclose(proved.displacement, plain.displacement, atol=1e-12)


class Stability(unittest.TestCase):
    def test_sentences(self):
        slides, turns = (
            "nothing holds the structure along {}: it slides",
            "nothing keeps the structure from turning about {}",
        )
        flat = truss([[0, 0], [1, 0], [0, 1], [1, 1]], [(0, 1), (0, 2), (1, 3), (2, 3)])
        for case, wanted in [
            ((CUBE, (0, 1, 4)), []),
            ((CUBE, (1, 4)), [slides.format("x")]),
            ((CUBE,), [slides.format("x"), slides.format("y"), turns.format("z")]),
            ((CUBE, (0, 1, 4), (0, 1)), [turns.format("x")]),
            ((CUBE, (2, 5, 8), (0, 1), (1.0, 1.0, 0.0)), [slides.format("(0.71, -0.71, 0)")]),
            ((flat, (0, 2), (0, 1), (0.0, 1.0)), ["nothing holds a mechanism that moves degree of freedom 4 most"]),
        ]:
            body = standing(*case)
            found = body.check_stability(*case[0][1:])
            with self.subTest(wanted):
                self.assertEqual([sentence.replace("(-0.71, 0.71,", "(0.71, -0.71,") for sentence in found], wanted)
            for u in found.values():
                np.testing.assert_allclose(case[0][0] @ u, np.zeros(u.size), atol=1e-10)
                np.testing.assert_allclose(u[list(case[1] if len(case) > 1 else ())], 0.0, atol=1e-10)
                self.assertAlmostEqual(np.abs(u).max(), 1.0)
        self.assertRaises(fuge.InputError, body.check_stability, np.zeros((1, 2)), [[0, 99]])


class Words(unittest.TestCase):
    def test_repr(self):
        body = standing(CUBE, held=(0, 1, 4))
        condensed = body.condense()
        bodies = fuge.ElasticBodies()
        bodies.add(beam())
        for item, words in [
            (body, "<Body: 24 degrees of freedom, 3 of them fixed, 4 links>"),
            (body._links, "<Links: foot 0, foot 1, foot 2, foot 3>"),
            (condensed, "<Condensed: 4 contact points, 3 rigid modes>"),
            (fuge.Solver(np.eye(2)), "<Solver: 2 points, 1 motions, DenseOperator(n=2)>"),
            (fuge.envelope([[1.0, 2.0]]), "<Envelope: 2 columns, 1 to 2>"),
            (bodies, "<ElasticBodies: 1 bodies of 6 degrees of freedom>"),
            (fuge.ContactPairs(), "<ContactPairs: 0 points, 0 nodes without an opposite face>"),
            (fuge.Surface([[0.0, 0.0], [1.0, 0.0]], [[0, 1]]), "<Surface: 2 nodes, 1 faces, rigid>"),
        ]:
            self.assertEqual(repr(item), words)


if __name__ == "__main__":
    unittest.main()
