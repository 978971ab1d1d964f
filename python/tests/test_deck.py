"""Decks and the rows of stiffness matrices: links, loads, supports, and what is refused."""

import math
import unittest

import numpy as np

import fuge
from files import InFolder
from fuge.deck import Conditions, DeckCase, DeckLink
from fuge.formats.text import Place, Reason

# Node 1 moves along x and z, node 2 along x, y and z, node 9 is a scalar point.
NODE, DIRECTION = [2, 2, 2, 1, 1, 9], [1, 2, 3, 1, 3, 0]
PLACE = Place("m.inp", 3)


def unit_matrix(node=NODE, direction=DIRECTION, rows=None):
    """Springs of stiffness 1 at degrees of freedom with these names."""
    rows = len(node) if rows is None else rows
    arrays = np.arange(rows + 1, dtype=np.intc), np.arange(rows, dtype=np.intc), np.ones(rows)
    return fuge.StiffnessFile((rows, rows), *arrays, np.array(node, np.intc), np.array(direction, np.intc))


def conditions(*values):
    held = Conditions()
    for node, direction, value in values:
        held.hold((node, direction), value, PLACE)
    return held


def a_deck():
    deck = fuge.Deck()
    deck._links = [
        DeckLink("between", 1, 2, (0.48, 0.6, 0.64), 0.5, play=2.0),
        DeckLink("ground", 2, 0, (0.0, 0.0, 1.0), -1.0, compliance=0.25, limit=3.0),
    ]
    deck._cases = [
        DeckCase("A", conditions((2, 3, 7.0), (9, 0, 2.0), (1, 2, 4.0)), conditions((1, 2, 0.0), (1, 3, 0.125))),
        DeckCase("B", conditions(), conditions((1, 2, 0.0))),
    ]
    return deck


class Rows(InFolder):
    def test_arrays(self):
        deck = a_deck()
        self.assertEqual((deck.link_names, deck.case_names), (["between", "ground"], ["A", "B"]))
        np.testing.assert_array_equal(deck.direction, [[0.48, 0.6, 0.64], [0, 0, 1]])
        np.testing.assert_array_equal([deck.node_a, deck.node_b], [[1, 2], [2, 0]])
        np.testing.assert_array_equal([deck.gap, deck.compliance], [[0.5, -1], [0, 0.25]])
        np.testing.assert_array_equal([deck.play, deck.limit], [[2, math.inf], [math.inf, 3]])
        self.assertEqual(repr(deck), "<Deck: 2 links, 2 load cases: A, B>")
        empty = fuge.Deck()
        self.assertEqual((empty.direction.shape, repr(empty)), ((0, 3), "<Deck: 0 links, 0 load cases>"))

    def test_solved(self):
        """Springs of stiffness 1, by hand: the first link closes, and stops; the second yields, and does not."""
        deck = fuge.Deck()
        deck._links = [
            DeckLink("between", 1, 2, (0.6, 0.0, -0.8), 0.5, play=2.0),
            DeckLink("ground", 9, 0, (0.0, 0.0, 1.0), -1.0, compliance=0.25, limit=3.0),
        ]
        stiffness = unit_matrix([1, 1, 2, 2, 9], [1, 3, 1, 3, 3])
        links = deck.links(stiffness)
        self.assertEqual(links.names, ("between", "ground"))
        body = fuge.Body(stiffness)
        body.set_links(links)
        body.condense()
        cases = body.solve_cases([[0, 0, -1.5, 2.0, 7.0], [0, 0, 2.7, -3.6, 0.25]])
        np.testing.assert_allclose(cases.force, [[1.0, 3.0], [-1.5, 1.0]], rtol=1e-12)
        np.testing.assert_allclose(cases.displacement[0], [-0.6, 0.8, -0.9, 1.2, 4.0], rtol=1e-12)

    def test_loads_and_supports(self):
        deck, stiffness = a_deck(), unit_matrix()
        np.testing.assert_array_equal(deck.loads(stiffness), [[0, 0, 7, 0, 0, 2], [0] * 6])
        other = unit_matrix([*NODE, 1], [*DIRECTION, 2])
        for case, matrix, expected in (0, stiffness, [[4], [0.125]]), (1, stiffness, [[], []]), (1, other, [[6], [0]]):
            np.testing.assert_array_equal(deck.supports(case, matrix), expected)

    def test_refused(self):
        deck = a_deck()
        few = unit_matrix(NODE[3:], DIRECTION[3:])
        for call, arguments, words in (
            (fuge.Deck().links, [unit_matrix()], "no one-way link"),
            (deck.links, [unit_matrix(NODE[:5])], "node has 5 value(s), direction 6"),
            (deck.loads, [unit_matrix(rows=7)], "for 7 row(s)"),
            (deck.links, [unit_matrix([0, 0], [0, 0])], "rows of the matrix have no names"),
            (deck.links, [unit_matrix([3, 3], [1, 1])], "node 3, direction 1 is the name of two rows"),
            (deck.links, [few], "between: the matrix has no row of node 2, direction 1, but A has no support there"),
            (deck.loads, [few], '"m.inp", line 3, A: node 2, direction 3 has a force, but no support and no row'),
            (deck.supports, [0, unit_matrix(NODE[:3], DIRECTION[:3])], "node 1, direction 3 has a displacement, but"),
            (deck.supports, [2, unit_matrix()], "load case 2 is outside 0 .. 1"),
        ):
            with self.subTest(words=words):
                self.refused(words, call, *arguments, error=fuge.InputError)
        deck._links = [DeckLink("across", 1, 0, (0.0, 1.0, 0.0), place=PLACE)]
        words = '"m.inp", line 3, across: no row of the matrix moves it'
        self.refused(words, deck.links, unit_matrix(), error=fuge.InputError)

    def test_eliminated_rows(self):
        """A row that is missing for another reason than a support, such as an equation, must not become the ground."""
        deck, matrix = fuge.Deck(), unit_matrix([17, 30], [1, 3])
        deck._links = [DeckLink("between", 17, 30, (0.0, 1e-16, 1.0), 0.5)]
        reason = "no row of node 17, direction 3, but {} there"
        self.refused(reason.format("no support is"), deck.links, matrix, error=fuge.InputError)
        deck._supports = conditions((17, 3, 0.0))
        self.assertEqual(deck.links(matrix).count, 1)
        both, one = conditions((17, 1, 0.0), (17, 3, 0.0)), conditions((17, 1, 0.0))
        deck._cases = [DeckCase("A", conditions(), both), DeckCase("B", conditions(), one)]
        self.refused(reason.format("B has no support"), deck.links, matrix, error=fuge.InputError)

    def test_conditions(self):
        forces = Conditions()
        for value, step in ((1.0, 1), (2.0, 1), (8.0, 2)):
            forces.add((4, 1), value, PLACE, step)
        self.assertEqual(forces[4, 1].value, 8.0)
        forces.add((4, 1), -3.0, PLACE, 2)
        self.assertEqual(forces[4, 1].value, 5.0)
        held = conditions((4, 1, 0.5), (4, 1, 0.5))
        words = 'by 0.25 in direction 1, but by 0.5 in "m.inp", line 3'
        self.refused(words, held.hold, (4, 1), 0.25, PLACE, error=Reason)
        held.hold((4, 1), 0.25, PLACE, 1)
        self.assertEqual(held[4, 1].value, 0.25)


if __name__ == "__main__":
    unittest.main()
