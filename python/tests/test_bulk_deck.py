"""Decks of Nastran: each card, in each form, and what is refused, with its line."""

import os
import time
import tracemalloc
import unittest

import numpy as np

from files import InFolder
from fuge.formats.bulk_deck import read_bulk_deck
from fuge.formats.force_table import find_one_way_law
from fuge.formats.text import Reason

# Lines 1 to 5: nodes, and a gap of its own kind.
NODES = "GRID,1\nGRID,2,,3.,4.,0.\nGRID,3,,0.,0.,2.\n"
GAP = NODES + "CGAP,7,9,1,2\nPGAP,9,.5,0.,1000.\n"
# Lines 6 and 7, of load sets 1 and 2.
FORCES = GAP + "FORCE,1,1,,1.,0.,0.,1.\nFORCE,2,2,,1.,0.,0.,1.\n"
# Ten lines, and a load set that may follow.
HELD = "SUBCASE 1\nLOAD = 3\nSPC = 4\nBEGIN BULK\n" + GAP + "SPC1,4,1,1\n"


def in_fields(*fields, width=8):
    """A line of fixed fields, the first of eight columns."""
    return f"{fields[0]:<8}" + "".join(f"{field:>{width}}" for field in fields[1:]) + "\n"


def values(conditions):
    return {f"{node}.{direction}": value.value for (node, direction), value in conditions.items()}


class Decks(InFolder):
    def setUp(self):
        super().setUp()
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)

    def read(self, content, part=""):
        self.file("part", part)
        self.file("deck", content)
        return read_bulk_deck("deck")

    def cases(self, content, part=""):
        return [(case.name, values(case.loads), values(case.supports)) for case in self.read(content, part)._cases]

    def refuse(self, content, words, part=""):
        with self.subTest(content):
            self.refused(words, self.read, content, part)

    def test_gap_in_all_forms(self):
        rest = in_fields("CGAP", 7, 9, 1, 2)
        large = in_fields("GRID*", 2, "", "3.", "4.", width=16) + in_fields("*", "0.", width=16)
        for content, place in [
            (GAP + "ENDDATA\nCGAP,8,9,1,3\n", '"deck", line 4'),
            (in_fields("$ x") + "GRID           1\n" + large + rest + "PGAP*,9,.5,0.,1.+3\n*\n", '"deck", line 5'),
            (NODES + "include 'part' $ gap\n", '"part", line 2'),
            (NODES.replace("\n", "\r\n") + " INCLUDE = part\r\nenddata\r\nCGAP,8,9,1,2\r\n", '"part", line 2'),
        ]:
            with self.subTest(content):
                deck = self.read(content, "PGAP,9,.5,,1.0D3 $ rigid enough\nCGAP    7       9       1       2\n")
                self.assertEqual((deck.link_names, deck.case_names), (["CGAP 7"], []))
                self.assertEqual([deck.node_a, deck.node_b, deck.gap, deck.compliance], [1, 2, 0.5, 1e-3])
                self.assertEqual([deck.play, deck.limit], [np.inf, np.inf])
                np.testing.assert_allclose(deck.direction, [[0.6, 0.8, 0.0]], rtol=1e-15)
                self.assertEqual(str(deck._links[0].place), place)
                self.assertEqual(deck.paths, ["deck", "part"] if "part" in place else ["deck"])

    def test_directions(self):
        deck = self.read(
            NODES + "CGAP,1,9,1,2,,,,0\nCGAP,2,9,1,2,,,,5\nCGAP,3,8,1,2,,,,FLIP\nCGAP,9,,1,3\nPGAP,9,-.25\n"
            "PGAP,8,AUTO,,AUTO,,.1\nCORD2R,5,,0.,0.,0.,0.,0.,1.\n,0.,2.,1.\n" + NODES + "PGAP,9,-.25\n"
        )
        wanted = [[1, 0, 0], [0, 1, 0], [-0.6, -0.8, 0], [0, 0, 1]]
        np.testing.assert_allclose(deck.direction, wanted, atol=1e-15)
        np.testing.assert_allclose(deck.gap, [-0.25, -0.25, 5.0, -0.25], rtol=1e-15)
        self.assertEqual(list(deck.compliance), [0.0] * 4)

    def test_springs(self):
        deck = self.read(
            NODES + "CBUSH1D,1,10,1,3\nCBUSH1D,2,20,2,,0\nCBUSH1D,3,30,1,2\nPBUSH1D,10,4.\n,SPRING,TABLE,6\n"
            "PBUSH1D,20\n,SPRING,8\n,DAMPER,TABLE,4\nPBUSH1D,30,7.\n"
            "TABLED1,6\n,-1.,0.,.5,0.,1.,2.,1.5,4.\n,2.,4.,ENDT\n"
            "TABLED1,8\n,-3.,-8.,-1.,0.,2.,0.,ENDT\n"
        )
        self.assertEqual(deck.link_names, ["CBUSH1D 1", "CBUSH1D 2"])
        np.testing.assert_array_equal(deck.direction, [[0, 0, -1], [1, 0, 0]])
        np.testing.assert_array_equal([deck.node_a, deck.node_b], [[1, 2], [3, 0]])
        np.testing.assert_array_equal([deck.gap, deck.compliance], [[0.5, 1.0], [0.25, 0.25]])
        np.testing.assert_array_equal(deck.limit, [4.0, np.inf])

    def test_laws(self):
        for x, y, law in [
            ([-1, 0, 1], [0, 0, 4], (True, 0, 0.25, np.inf)),
            # A strut under a preload, which gives way.
            ([-2, -1, 0.5, 2], [-3, -3, 0, 0], (False, -0.5, 0.5, 3)),
            # Six digits are on a line.
            ([-1, 0.1, 0.4333333, 0.7666667], [0, 0, 1e-3, 2e-3], (True, 0.1, 333.33333, np.inf)),
            ([-1e-9, 0.5e-9, 1e-9], [0, 0, 4e150], (True, 0.5e-9, 0.125e-159, np.inf)),
        ]:
            np.testing.assert_allclose(find_one_way_law(np.array(x), np.array(y)), law, rtol=1e-5)
        for x, y, words in [
            ([0, 1], [0, 1], "three points"),
            ([0, 1, 1], [0, 0, 1], "x = 1 follows x = 1"),
            ([-1, 0, 1], [-1, 0, 1], "no force at two points"),
            ([-1, 0, 1], [0, 0, 0], "no force at two points"),
            ([-1, 0, 1, 2], [0, 0, 1, 3], "rise on one line"),
            ([-1, 0, 1, 2], [0, 0, 1, 0.5], "rise on one line"),
            ([-1, 0, 0.5, 2], [0, 0, 0.25, 1.75], "rise on one line"),
            ([-1, 0, 1e-300], [0, 0, 1e300], "rise on one line"),
        ]:
            with self.assertRaisesRegex(Reason, words):
                find_one_way_law(np.array(x, float), np.array(y, float))

    def test_cases(self):
        content = (
            "SOL 101\nDIAG 8,\n 14\nCEND\nTITLE = T,\nSUBTITLE = of all\nSET 1 = 1,2,\n 3\nspc = 5\nMPC = 8\nSUBC 10\n"
            "  LOAD=3\n DISP(PLOT) = 1\n ANALYSIS = STATICS\nSUBCASE 20 $ the other\n LABEL = LOAD = 9\n SUBTI = s\n"
            " SPC = 1\n MPC = 8\n LOAD = 4\n OUTPUT(XYPLOT)\n XTITLE = a\nbegin  bulk\n" + GAP + "GRID,40,,,,,,3\n"
            "FORCE,3,1,,2.,0.,3.,-1.\nFORCE,3,1,0,1.,1.,0.,0.\nFORCE,3,1,,1.,,1.\nMOMENT,2,2,,5.,0.,0.,1.\n"
            "LOAD,4,2.,3.,3,.5,2\nSPC,1,1,12,.25,2,3\nSPC1,6,3,1,THRU,3\nSPC1,7,1,3\nSPCADD,5,6,7\nSPCD,3,3,3,.125\n"
            "SPCD,3,3,3,.125\nSPC,1,3,3,1.\nPLOAD4,9,1,2.\nPARAM,POST,-1\nPARAM,LGDISP,-1\nCHEXA,1,1,1,2,3\n"
        )
        common = {"40.3": 0.0, "1.3": 0.0, "2.3": 0.0}
        first = {**common, "3.3": 0.125, "3.1": 0.0}
        second = {"40.3": 0.0, "1.2": 0.25, "1.1": 0.25, "2.3": 0.0, "3.3": 0.75}
        wanted = [
            ("SUBCASE 10", {"1.2": 7.0, "1.3": -2.0, "1.1": 1.0}, first),
            ("LOAD = 9 (SUBCASE 20)", {"1.2": 42.0, "1.3": -12.0, "1.1": 6.0, "2.6": 5.0}, second),
        ]
        self.assertEqual(self.cases(content), wanted)
        self.assertEqual(self.read(content).case_names[0], "SUBCASE 10")
        self.assertEqual(values(self.read(content)._supports), {**common, "3.3": 0.0, "3.1": 0.0})
        self.assertEqual(self.cases(content.replace("LABEL", "TITLE"))[1][0], "s (SUBCASE 20)")

    def test_cases_of_other_decks(self):
        load = "FORCE,8,1,,2.,0.,0.,1.\n"
        loaded = {"1.3": 2.0}
        for content, part, case in [
            # Bulk data alone, and what all subcases select without SUBCASE.
            (GAP + load + "SPC1,3,1,2\n", "", (loaded, {"2.1": 0.0})),
            (f"LOAD = 8\nBEGIN BULK\n{GAP}{load}{load.replace('8', '9')}SPC1,3,1,2\n", "", (loaded, {})),
            (FORCES.replace("FORCE,2", "FORCE,1") + "LOAD,5,1.,2.,1\nSPC1,3,1,2\nSPCADD,6,3\n", "",
             ({"1.3": 2.0, "2.3": 2.0}, {"2.1": 0.0})),
            ("SUBCASE 1\nINCLUDE 'part' $ sets\nBEGIN BULK\n" + FORCES + "SPC1,7,1,2\n", "LOAD = 2\nSPC = 7\n",
             ({"2.3": 1.0}, {"2.1": 0.0})),
            ("INCLUDE 'part'\n" + GAP, f"SUBCASE 1\nLOAD = 8\nBEGIN BULK\n{load}", (loaded, {})),
            # Scalar points in ranges of supports: those that exist.
            (GAP + load + "SPC1,3,0,2,THRU,13\nSPC1,3,1,2,THRU,13\nSPOINT,10,30\nSPOINT,12,THRU,20\n", "",
             (loaded, {"10.0": 0.0, "12.0": 0.0, "13.0": 0.0, "2.1": 0.0, "3.1": 0.0})),
            (HELD.replace("LOAD = 3\n", ""), "", ({}, {"1.1": 0.0})),
        ]:  # fmt: skip
            with self.subTest(content):
                self.assertEqual(self.cases(content, part), [("SUBCASE 1", *case)])
        self.assertEqual(self.cases(GAP + "SPC1,3,1,2\n"), [])

    def test_continuations(self):
        fixed = in_fields("LOAD", 5, "2.", *["1.", 1] * 3).rstrip("\n")
        free = "LOAD,5,2.,1.,1,1.,1,1.,1,"
        last = in_fields("+L1", "3.", 2)
        for content in [
            *(fixed + marker + "\n" + last for marker in ("+L1", "+l1", " L1", "QL1")),
            fixed + "+L1\n$\n" + in_fields("*L1", "3.", 2, width=16),
            *(fixed + f"+L1\n{begin}" + last[1 + len("L1") :] for begin in ("+  ", "   ")),
            free + "+L1\n+L1,3.,2\n",
            free + "+L1\n,3.,2\n",
        ]:
            with self.subTest(content):
                self.assertEqual(self.cases(FORCES + content)[0][1], {"1.3": 6.0, "2.3": 6.0})
        apart = "the continuation +L1 does not follow its card: put it directly"
        self.refuse(FORCES + fixed + "+L1\nSPC1,3,1,2\n" + last, "line 10: " + apart)
        self.refuse(FORCES + free + "+L2\n+L1,3.,2\n", "line 9: " + apart)
        self.refuse("+L1,2\n", "line 1: the continuation +L1")
        self.refuse(",2\n", "line 1: the line continues a card, but there is none above")

    def test_refused_after_a_gap(self):
        for card, words in [
            ("=,=,2,==", "line 6: replication by = and *( is not read"),
            ("*(1),2", "line 6: replication by"),
            ("CGAP  9        6       1       3", 'line 6: the name "CGAP  9" has a blank'),
            ("CGAP\t8\t9", "line 6: tabs between fixed fields"),
            ("SPC1,7,2,1,2,3,1,2,3,1", "line 6: there are more than 8 fields"),
            ("SPC1,3,1,2,THRU,3,1", 'line 6, SPC1 3: "1" stands behind the end of THRU'),
            ("SPOINT,3,THRU,5,7", 'line 6, SPOINT 3: "7" stands behind the end of THRU'),
            ("SPC1,3,1,3,THRU,2", 'line 6, SPC1 3: end of THRU "2" is outside 3'),
            ("GRID,8\n,SPRING", 'line 6, GRID 8: there is no field 9, but "SPRING" stands there'),
            ("GRID,1,,1.", "line 6, GRID 1: the node is defined a second time"),
            ("GRDSET,,,,,,,123", "line 6, GRDSET : defaults of CP, CD and PS"),
            ("CGAP,8,9,1,4", "line 6: CGAP 8: the deck has no GRID 4"),
            ("CGAP,7,9,1,3", "line 6, CGAP 7: the element is defined a second time"),
            ("PGAP,9", "line 6, PGAP 9: the property is defined a second time"),
            ("CGAP,8,9,1,1", "line 6, CGAP 8: GA and GB are the same node"),
            ("CGAP,8,9,1", "line 6, CGAP 8: the GB is missing"),
            ("CGAP,8,9,1,x", 'line 6, CGAP 8: GB "X" is not a whole number'),
            ("CGAP,8,5,1,3", "line 6: CGAP 8: the deck has no PGAP 5"),
            ("GRID,5,,3.,4.,1.-9\nCGAP,8,9,2,5", "line 7: CGAP 8: its nodes coincide"),
            ("CGAP,8,9,1,3,,,,4", "line 6: CGAP 8: CID = 4 is no CORD2R of the deck"),
            ("CORD2R,4,,0.,0.,0.,0.,0.,1.\n,0.,0.,2.\nCGAP,8,9,1,3,,,,4", "CID = 4: its three points are"),
            ("CORD2R,4,1,0.,0.,0.,0.,0.,1.\n,1.,0.,2.\nCGAP,8,9,1,3,,,,4", "another reference system than 0"),
            ("GRID,5,2,1.,4.,1.\nCGAP,8,9,1,5", "CGAP 8: GRID 5 has the coordinate system CP = 2"),
            ("GRID,5,2,1.,4.,1.\nPGAP,8,AUTO\nCGAP,8,,1,5,,,,0", "GRID 5 has the coordinate system CP = 2"),
            ("GRID,5,,1.,4.,1.,2\nCGAP,8,9,1,5", "GRID 5 has the displacement system CD = 2"),
            ("PGAP,8,0.,5.", "line 6, PGAP 8: the preload F0 is not read"),
            ("PGAP,8,0.,,-5.", "line 6, PGAP 8: KA is negative"),
            ("PGAP,8,0.,,5.,1.", "line 6, PGAP 8: KB, the stiffness of the open gap"),
            ("PGAP,8,0.,,5.,,.2,.3", "line 6, PGAP 8: MU1 is not zero: fuge has no friction"),
            ("PGAP,8,0.,,5.,,,,STICK", "line 6, PGAP 8: MU2 is not zero"),
            ("PGAP,8,zero", 'line 6, PGAP 8: U0: "ZERO" is not a number'),
            ("CBUSH1D,1,10,1,3", "line 6: CBUSH1D 1: the deck has no PBUSH1D 10"),
            ("CBUSH1D,1,10,1,3\nPBUSH1D,10\n,SPRING,TABLE,6", "line 6: CBUSH1D 1: the deck has no TABLED1 6"),
            ("CBUSH1D,1,10,1,3\nPBUSH1D,10\n,SPRING,6\nTABLED1,6\n,-1.,-1.,0.,0.,1.,1.,ENDT", "TABLED1 6: a one-way"),
            ("CBUSH1D,1,10,1\nPBUSH1D,10\n,SPRING,6\nTABLED1,6\n,-1.,0.,0.,0.,1.,1.,ENDT", "to the ground needs CID"),
            ("TABLED1,6,LOG", "line 6, TABLED1 6: a logarithmic axis is not read"),
            ("TABLED1,6,,,1", "line 6, TABLED1 6: field 4 is 1: tables go on"),
            ("PBUSH1D,10\n,GENER,,3", "line 6, PBUSH1D 10: GENER"),
            *((f"{name},10,3", f"line 6, {name} 10: contact and springs of this kind are not read")
              for name in ("PBUSHT", "PELAST", "BCTABLE", "BCONECT", "BLSEG")),
            ("MATS1,7,3,NLELAST", "line 6, MATS1 7: materials that depend on the strain"),
            *((name, f"line 6, {name} : the card could change the answer") for name in ("SUPORT", "MATHE", "GIRD")),
            ("PARAM,LGDISP,1", "line 6, PARAM LGDISP: LGDISP = 1: fuge is linear"),
            ("PARAM,CDITER,10", "contact by SUPORT and MPC is not read"),
            ("PARAM,INREL,-2", "inertia relief is not read"),
            ("PARAM,NOSUCH,1", "the parameter NOSUCH could change the answer"),
            ("BEGIN SUPER=1", "line 6: the name"),
            ("include no_such", 'line 6: the included file "no_such" cannot be opened'),
            ("include 'no_such", "line 6: INCLUDE needs a path in quotes"),
            ("include 'deck'", "line 6: more than 16 files include each other"),
            # Bulk data alone: all sets of loads, and all of supports, must belong to one.
            ("FORCE,3,1,,1.,1.\nGRAV,2,,9.81,0.,0.,-1.", "line 7: the set 2 is another one than 3"),
            ("FORCE,1,1,,1.,1.\nSPC,3,2,1\nSPCD,2,2,1,.5", "line 8: the set 2 is another one than 1"),
            ("FORCE,1,1,,1.,1.\nLOAD,5,1.,2.,2", "line 6: the set 1 is another one than 5"),
            ("SPC1,3,1,2\nSPCADD,6,3\nSPC,4,2,1", "line 8: the set 4 is another one than 6"),
        ]:  # fmt: skip
            self.refuse(GAP + card + "\n", words)

    def test_refused_loads(self):
        force = "FORCE,3,1,,1.,1.\n"
        for cards, words in [
            ("", 'deck", line 1: SUBCASE 1 selects the loads LOAD = 3, which the deck does not have'),
            ("FORCE,3,1,,1.", "line 11, FORCE 3: the direction N1, N2, N3 has the length zero"),
            ("FORCE,3,1,2,1.,1.", "line 11, FORCE 3: CID = 2"),
            ("FORCE,3,8,,1.,1.", "line 11: the deck has no GRID 8"),
            ("GRID,8,,,,,1\nFORCE,3,8,,1.,1.", "line 12: GRID 8 has the displacement system CD = 1: loads are"),
            ("FORCE,3,1,,1.,one", 'line 11, FORCE 3: N1: "ONE" is not a number'),
            *((f"{name},3,1,2.", f"line 11: {name} of the load set 3 is not read: give its forces at nodes by FORCE")
              for name in ("PLOAD4", "SPCR", "PLOADE1", "FORCDST", "GMLOAD", "FORCEAX", "TEMPP3")),
            ("LOAD,3,1.,2.,6", "line 11: the deck has no loads of the set 6"),
            ("LOAD,3,1.,2.,6\nLOAD,3,1.,2.,6", "line 12, LOAD 3: the sum is defined a second time"),
            (force + "LOAD,3,1.,2.,3", "the set 3 has loads of its own and is a sum"),
            (force + "SPCADD,4,3", "the set 4 has supports of its own and is a sum"),
            ("SPCD,3,2,1,.5", "line 11: node 2 is not held in direction 1"),
            ("SPCD,3,1,1,.5\nSPCD,3,1,1,.25", "line 12: node 1 is displaced by 0.25 in direction 1, but by 0.5"),
            ("SPCD,5,1,1,.5\nSPCD,6,1,1,.5\nLOAD,3,1.,1.,5,1.,6", "displaced in direction 1 by another set"),
            ("SPC,4,1,1,.5", "line 11: node 1 is displaced by 0.5 in direction 1, but by 0"),
            ("SPC,4,1,17,.5", 'line 11, SPC 4: "17" is no list of directions'),
            ("SPC,4,8,1\n" + force, "line 11: the deck has no GRID 8"),
            ("SPC1,4,1,8,THRU,9\n" + force, "line 11: the deck has none of the nodes"),
        ]:  # fmt: skip
            self.refuse(HELD + cards + "\n", words)
        self.refuse(HELD.replace("SPC1", "SPC1,5"), "selects the supports SPC = 4, which the deck does not have")

    def test_refused_case_control(self):
        for lines, words in [
            ("SUBCASE 1\nSUBCASE 1", "line 2: subcase 1 is defined twice"),
            ("SUBCASE x", 'line 1: subcase "X" is not a whole number'),
            ("MPC = 3\nSUBCASE 1\nSUBCASE 2\nMPC = 4", "line 3: subcase 2 has other equations, MPC, than"),
            *((line, f"line 1: {line.partition(' ')[0]} is not read: give each load case as a SUBCASE")
              for line in ("SUBCOM 1", "REPC 2", "STEP 1", "BOLTLD = 1", "P2G = LOADS", "DLOAD = 1", "BCONTACT = 3",
                           "LOADSET = 1", "BEGIN SUPER=1", "METHOD = 1", "LAOD = 1", "SOL 101")),
            ("TEMP(LOAD) = 1", "line 1: TEMP is not read"),
            ("NLPARM(LGDISP) = 1", "line 1: NLPARM is not read"),
            ("ANALYSIS = HEAT", "line 1: ANALYSIS is not read"),
            ("PARAM,LGDISP,1", "line 1: LGDISP = 1: fuge is linear"),
            ("SUBCASE 1\nCEND", "line 1: SUBCASE above CEND could change the answer"),
        ]:  # fmt: skip
            self.refuse(f"{lines}\nBEGIN BULK\n{GAP}", words)
        self.refuse("BEGIN BULK SUPER=2\n" + GAP, "line 1: superelements")
        self.refuse("BEGIN BULK\nENDDATA\n" + GAP, '"deck": there is no bulk data')
        self.refuse("INCLUDE 'part'\nBEGIN BULK\n" + GAP, '"part", line 1: subcase "X" is not', "SUBCASE x\n")
        self.assertEqual(self.read(f"TEMP(INIT) = 1\nNLPARM = 1\nBEGIN BULK\n{GAP}").link_names, ["CGAP 7"])

    def test_short_deck_of_many_points(self):
        tracemalloc.start()
        self.addCleanup(tracemalloc.stop)
        begin = time.perf_counter()
        held = self.read(GAP + "SPC1,3,2,2,THRU,60000000\n")._supports
        self.assertEqual(values(held), {"2.2": 0.0, "3.2": 0.0})
        self.refuse(GAP + "SPC1,3,0,1,THRU,60000000\nSPOINT,1,THRU,60000000\n", "line 6: THRU names more than 100000")
        self.assertLess(tracemalloc.get_traced_memory()[1], 1e6)
        self.assertLess(time.perf_counter() - begin, 1.0)


if __name__ == "__main__":
    unittest.main()
