"""Tables of links, supports and load cases."""

import math
import unittest
from pathlib import Path

import numpy as np

from files import InFolder
from fuge.deck import Deck
from fuge.formats.bulk_deck import read_bulk_deck

INF = math.inf
DATA = Path(__file__).resolve().parents[2] / "examples" / "data" / "cantilever"


class Tables(InFolder):
    def setUp(self):
        super().setUp()
        self.deck = Deck()

    def read(self, kind, content):
        """Add a table to the deck."""
        getattr(self.deck, f"read_{kind}")(self.file("table", content))

    def link(self, content):
        """Name, nodes, direction and law of the only link of a table."""
        self.deck = Deck()
        self.read("links", content)
        (link,) = self.deck._links
        return (link.name, link.node_a, link.node_b, link.direction, link.gap, link.play, link.compliance, link.limit)

    def refuse(self, kind, content, words):
        with self.subTest(content):
            before = (repr(self.deck), list(self.deck.paths))
            self.refused(words, self.read, kind, content)
            self.assertEqual((repr(self.deck), self.deck.paths), before)

    def test_links(self):
        self.read("links", "# comment\nnode_a;node_b;x;y;z;gap\n1;0;0;3;4;.5\n\n2;3;0;0;-2;;1;8;20;rope\n,,,\n")
        self.read("links", "4 5 1 0 0 0 -1 0 -1\n")
        self.assertEqual(self.deck.link_names, ["link 1", "rope", "link 1"])
        np.testing.assert_array_equal([self.deck.node_a, self.deck.node_b], [[1, 2, 4], [0, 3, 5]])
        np.testing.assert_allclose(self.deck.direction, [[0, 0.6, 0.8], [0, 0, -1], [1, 0, 0]], rtol=1e-15)
        laws = [self.deck.gap, self.deck.play, self.deck.compliance, self.deck.limit]
        np.testing.assert_array_equal(laws, [[0.5, 0, 0], [INF, 1, INF], [0, 0.125, 0], [INF, 20, INF]])
        self.assertEqual([link.place.line for link in self.deck._links], [3, 5, 1])
        self.assertEqual(self.deck.paths, [str(self.folder / "table")] * 2)

    def test_columns(self):
        x = (1.0, 0.0, 0.0)
        for content, link in [
            # A stiffness without a play, and another order.
            ("node_a,node_b,x,y,z,gap,stiffness\n1,2,1,0,0,.5,8\n", ("link 1", 1, 2, x, 0.5, INF, 0.125, INF)),
            ("NAME\tx\ty\tz\tnode_b\tnode_a\nspring 1\t2\t0\t0\t2\t1\n", ("spring 1", 1, 2, x, 0.0, INF, 0.0, INF)),
            # A tab is one separator: the gap is blank.
            ("1\t2\t1\t0\t0\t\t3\t8\t\t\n", ("link 1", 1, 2, x, 0.0, 3.0, 0.125, INF)),
            ("1, 2, 1e200, 0, 0, .5,, 8, 9, spring 1 ! left\r\n", ("spring 1", 1, 2, x, 0.5, INF, 0.125, 9.0)),
            ("1;\t2;1e-200;0;0;;;;;spring#1\n", ("spring#1", 1, 2, x, 0.0, INF, 0.0, INF)),
            # Names in quotes have separators and blanks.
            ('1,2,1,0,0,0,-1,0,-1,"left; # \ttop"\n', ('"left; # \ttop"', 1, 2, x, 0.0, INF, 0.0, INF)),
            ('1 2 1 0 0 0 -1 0 -1 "left, top" # x', ('"left, top"', 1, 2, x, 0.0, INF, 0.0, INF)),
        ]:
            with self.subTest(content):
                self.assertEqual(self.link(content), link)

    def test_refused_links(self):
        for content, words in [
            ("node_a,node_b\n", 'table": there is no link: lines node_a, node_b, x, y, z, .. are needed'),
            ("node_a,node_b\nold,0,0,1,0\n1,2,0,1,0\n", 'line 2: node_a "old" is not a whole number'),
            ("node_a,node_b,x,y,z,gap,spring\n1,2,0,1,0,0,8\n", 'line 1: there is no column "spring": columns are'),
            ("node_a,node_b,x,y,z,gap,Gap\n1,2,0,1,0,0,8\n", 'line 1: two columns have the name "gap"'),
            ("node_a,node_b,x,y,z,stiffness\n1,2,0,1,0,8,9\n", "line 2: there are more columns than node_a, node_b"),
            ("node_a,node_b,x,y,stiffness\n1,2,0,1,0\n", "line 2: z: the value is missing"),
            (",0,0,1,0\n", 'line 1: there is no column ""'),
            ("1,0,0,0,0\n", "line 1: the direction x, y, z has the length zero"),
            ("1,0,0,1\n", "line 1: z: the value is missing"),
            ("1,1,0,1,0\n", "line 1: node_a and node_b are the same"),
            ("1,2,0,1,0\n-1,2,0,1,0", 'line 2: node_a "-1" is outside 0'),
            ("1,2,0,1,0,nan\n", 'line 1: gap: "nan" is not a finite number'),
            ("1,2,0,1,0,,,-4\n", "line 1: the stiffness is negative"),
            ("1,2,0,1,0,,-2\n", "line 1: play and limit must not be negative"),
            ("1,2,0,1,0,,,,,a,b\n", "line 1: there are more columns"),
            ('1,2,0,1,0,0,-1,0,-1,"left, top\n', "line 1: there are more columns"),
            ("1 2,0,1,0\n", 'line 1: node_a "1 2" is not a whole number'),
        ]:  # fmt: skip
            self.refuse("links", content, words)

    def test_supports_and_cases(self):
        self.read("supports", "node,held\n3,xZ\n4,26,.5\n")
        self.read("cases", "row,dead load,wind\n17.3,-1.5,2\n17.10,0,1e3\n")
        self.read("cases", "5.1 3\n")
        self.read("cases", '"node.direction";"dead; live";\n1.1;2\n')
        self.assertEqual(self.deck.case_names, ["dead load", "wind", "case 3", '"dead; live"'])
        wind = {dof: load.value for dof, load in self.deck._cases[1].loads.items()}
        self.assertEqual(wind, {(17, 3): 2.0, (17, 10): 1000.0})
        held = {(3, 1): 0.0, (3, 3): 0.0, (4, 2): 0.5, (4, 6): 0.5}
        # Supports are those of the model, and of the cases that are there and that follow.
        self.read("supports", "displacement directions node\n.25 y 3\n")
        self.read("cases", "row,,b\n1.1,2,3\n")
        self.assertEqual(self.deck.case_names[4:], ["case 5", "b"])
        for supports in (self.deck._supports, *(case.supports for case in self.deck._cases)):
            self.assertEqual({dof: support.value for dof, support in supports.items()}, {**held, (3, 2): 0.25})
        self.refuse("supports", "4,y,.25\n", 'table", line 1: node 4 is displaced by 0.25 in direction 2, but by 0.5')
        self.assertEqual(self.deck._supports[4, 2].value, 0.5)

    def test_supports_of_a_deck(self):
        deck = read_bulk_deck(DATA / "beam.bdf")
        for kind in ("cases", "links"):
            getattr(deck, f"read_{kind}")(DATA / f"{kind}.csv")
        self.assertEqual(deck.link_names, ["CGAP 55", "CBUSH1D 33", "support", "cable"])
        for law in (deck.direction, deck.gap, deck.compliance, deck.play, deck.limit):
            np.testing.assert_array_equal(law[:2], law[2:])
        first, added = deck._cases[0], deck._cases[3]
        self.assertEqual((added.name, first.supports.keys()), ("pressed", added.supports.keys()))
        self.assertEqual(first.loads[5, 2].value, added.loads[5, 2].value)

    def test_refused_cases_and_supports(self):
        for kind, content, words in [
            ("cases", "row,a\n", "there are no forces"),
            ("cases", "17,3,2\n", 'line 1: a node and a direction are needed first, like 17.3, not "17"'),
            ("cases", "row,a,b\n17.3,2\n", "line 2: 1 force(s), but 2 load case(s)"),
            ("cases", "row\ta\tb\n17.3\t\t2\n", "line 2: the value is missing"),
            ("cases", "row,a\n17.3,2,3\n", "line 2: more forces than the 1 load case(s)"),
            ("cases", "row,a,a\n17.3,2,3\n", 'line 1: two columns have the name "a"'),
            ("cases", "1.1,2\n1.2,x\n", 'line 2: "x" is not a number'),
            ("cases", "1.1;2,5\n", "line 1: commas and semicolons on one line"),
            ("cases", "1.1,2\n1.1,2\n", 'table", line 2: a second line for node 1, direction 1'),
            ("cases", "row\nx\n1.1,2\n", "line 2: a force for each load case is needed"),
            ("cases", "row,a\nsum,a\n1.1,2\n", "line 2: a node and a direction"),
            ("supports", "1;x;0,5\n", "line 1: commas and semicolons on one line"),
            ("supports", "node\nleft,x\n1,x\n", 'line 2: node "left"'),
            ("supports", "node\n", "there is no support"),
            ("supports", "node,value\n1,x\n", 'line 1: there is no column "value"'),
            ("supports", "1,q\n", 'line 1: "q" is no list of directions'),
            ("supports", "1\n", 'line 1: "" is no list of directions'),
            ("supports", "1,x,0,0\n", "line 1: there are more columns than node, directions, displacement"),
            ("supports", "1,x\n1,xy,2\n", "line 2: node 1 is displaced by 2 in direction 1"),
        ]:
            self.refuse(kind, content, words)


if __name__ == "__main__":
    unittest.main()
