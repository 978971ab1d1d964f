"""Decks of Abaqus and CalculiX: gap elements, supports, steps, and what is refused, with its line."""

import unittest
import warnings

import numpy as np

import fuge
from files import InFolder
from fuge.formats.keyword_deck import read_keyword_deck

# A slash stands for the end of a line. Lines 1 to 5, to 7, to 9, and to 11.
NODES = "** comment/*Node, nset=All/1/2, 3, 4, 0/3, 0, 0, 2/"
ELEMENT = NODES + "*ELEMENT, TYPE=GAPUNI, ELSET=G/7, 1, 2/"
GAPS = ELEMENT + "*GAP, ELSET=g/.5, 0, 0, 2/"
HELD = GAPS + "*BOUNDARY/1, 1, 2/"
SECOND = GAPS + "*ELEMENT, TYPE={}, ELSET=H/8, {}/*GAP, ELSET=H/{}/"
STEP = "*STEP/*STATIC/"
PULSE = "*STEP/*DYNAMIC/*CLOAD, AMPLITUDE=A/1, 3, 2./"


def values(conditions):
    return {dof: condition.value for dof, condition in conditions.items()}


class Decks(InFolder):
    def read(self, text):
        return read_keyword_deck(self.file("m.inp", text.replace("/", "\n")))

    def refuses(self, begin, *lines_and_words):
        """Each of the lines, behind a beginning, with these words."""
        for lines, words in lines_and_words:
            with self.subTest(lines):
                self.refused(words, self.read, begin + lines)

    def cases(self, text):
        """For each case its name, forces and supports."""
        return [(case.name, values(case.loads), values(case.supports)) for case in self.read(text)._cases]

    def test_gaps(self):
        deck = self.read(SECOND.format("GAPUNI", "1, 2/9, 3, 1", "-.25, , , , , 200., 1.e-3"))
        self.assertEqual((deck.link_names, deck.case_names), (["GAPUNI 7", "GAPUNI 8", "GAPUNI 9"], []))
        np.testing.assert_array_equal([deck.node_a, deck.node_b], [[1, 1, 3], [2, 2, 1]])
        np.testing.assert_allclose(deck.direction, [[0, 0, 1], [0.6, 0.8, 0], [0, 0, -1]], rtol=1e-15)
        np.testing.assert_array_equal([deck.gap, deck.compliance], [[0.5, -0.25, -0.25], [0, 0.005, 0.005]])
        self.assertTrue(np.isinf([deck.limit, deck.play]).all())
        path = str(self.folder / "m.inp")
        self.assertEqual((str(deck._links[0]), deck.paths), (f'"{path}", line 9, GAPUNI 7', [path]))

    def test_round_gaps(self):
        """A tube in a tube, tubes beside each other, and an inextensible cable."""
        element = "*ELEMENT, TYPE=GAP{1}, ELSET=E{0}/{0}, 1, {2}/*GAP, ELSET=E{0}/{3}/"
        rows = (1, "CYL", 4, "5.5, 0, 0, 1"), (2, "CYL", 4, "-4, 0, 0, -2"), (3, "SPHER", 3, "2.125")
        deck = self.read(NODES + "4, 3, 4, 7/" + "".join(element.format(*row) for row in rows))
        np.testing.assert_allclose(deck.direction, [[-0.6, -0.8, 0], [0.6, 0.8, 0], [0, 0, -1]], rtol=1e-15)
        np.testing.assert_array_equal(deck.gap, [0.5, 1.0, 0.125])

    def test_steps(self):
        """Loads of a step add up and replace those of an earlier one; OP=NEW begins anew, once in a step."""
        text = GAPS + "*NSET, NSET=B/2, 3/*BOUNDARY/All, 1, 2/3, 3, 3, .5/"
        text += "*STEP, NAME=Dead load/*STATIC/*CLOAD/1, 3, 2./*CLOAD/1, 3, 1/B, 1, -1/*END STEP/"
        text += "*STEP, NAME=dead load/*CLOAD, OP=MOD/1, 3, 7/*BOUNDARY/3, 3, , .25/*STEP/*FREQUENCY/*END STEP/"
        text += STEP + "*CLOAD, OP=NEW/2, 3, 4./*CLOAD, OP=NEW/3, 3, 1/"
        text += "*BOUNDARY, OP=NEW/2, PINNED/*BOUNDARY, OP=NEW/1, zsymm/"
        held = {(node, along): 0.0 for node in (1, 2, 3) for along in (1, 2)}
        expected = [
            ("Dead load", {(1, 3): 3.0, (2, 1): -1.0, (3, 1): -1.0}, {**held, (3, 3): 0.5}),
            ("STEP 2", {(1, 3): 7.0, (2, 1): -1.0, (3, 1): -1.0}, {**held, (3, 3): 0.25}),
            ("STEP 4", {(2, 3): 4, (3, 3): 1}, dict.fromkeys([(2, 1), (2, 2), (2, 3), (1, 3), (1, 4), (1, 5)], 0.0)),
        ]
        self.assertEqual(self.cases(text), expected)
        self.assertEqual(values(self.read(text)._supports), {**held, (3, 3): 0.5})
        self.assertEqual(values(self.read(HELD)._supports), {(1, 1): 0.0, (1, 2): 0.0})

    def test_procedures(self):
        """Steps of other procedures are no cases; those of linear perturbations hand nothing on."""
        perturbations = "FREQUENCY/BUCKLE/STEADY STATE DYNAMICS, DIRECT/Complex Frequency/MODAL DYNAMIC/GREEN"
        perturbations += "/RANDOM RESPONSE/RESPONSE SPECTRUM/SUBSTRUCTURE GENERATE"
        others = "DYNAMIC/NO ANALYSIS/SENSITIVITY/ELECTROMAGNETICS/HEAT TRANSFER"
        for force, procedures in (2.0, f"{perturbations}/FREQ;*DLOAD"), (9.0, others):
            for procedure in procedures.split("/"):
                with self.subTest(procedure):
                    other = f"*STEP/*{procedure.replace(';', '/')}/*CLOAD/1, 3, 9./*END STEP/"
                    cases = self.cases(f"{GAPS}{STEP}*CLOAD/1, 3, 2./*END STEP/{other}{STEP}")
                    self.assertEqual([case[1] for case in cases], [{(1, 3): 2.0}, {(1, 3): force}])
        linear = "*STEP, PERT/*FREQUENCY/*BOUNDARY/3, 1/"
        self.assertEqual(self.cases(GAPS + linear + STEP + PULSE), [("STEP 2", {}, {})])
        self.refuses(GAPS + PULSE, (STEP, 'line 12: *CLOAD: the parameter "AMPLITUDE" is not read: write the values'))

    def test_abbreviations(self):
        text = '*NSET, NSET="left, top"/2/*BOUND, TYP=DISP/"left, top", 1/*STEP, NAM=A, NLG=NO/*STAT, DIR/*CLOA, OP=N/'
        self.assertEqual(self.cases(f'{GAPS}{text}"left, top", 3, 4.'), [("A", {(2, 3): 4.0}, {(2, 1): 0.0})])
        self.refuses(
            GAPS,
            ("*TRANS, NSET=ALL", 'line 10: "TRANS" may be '),
            ("*TRANSF, NSET=ALL", "line 10: *TRANSFORM is not read here"),
            ("*NO TENS", "line 10: *NOTENSION is not read here"),
            ("*FRIC", "line 10: *FRICTION is not read"),
            ("*SPRING, ELSET=G, NONLIN", 'line 10: *SPRING: the parameter "NONLIN" is not read: give one-way springs'),
            ("*BOUNDARY, AMP=A", 'line 10: *BOUNDARY: the parameter "AMP" is not read'),
            ("*STEP, PERT/*STATIC", "line 10: a *STEP with PERTURBATION is not read: contact depends on the whole"),
        )

    def test_harmless(self):
        text = "*HEADING/*PREPRINT, ECHO=NO/*MATERIAL, NAME=STEEL/*ELASTIC/1., .3/*SOLID SECTION, ELSET=E/" + GAPS
        text += "*ELEMENT, TYPE=C3D4, ELSET=E/*MPC/BEAM, 1, 2/*EQUATION/*SPRING, ELSET=E/*RESTART, WRITE/"
        text += "*STEP, INC=10/*VISCO, CETOL=1/*NODE PRINT/U/*EL FILE/S/*OUTPUT, FIELD/*END STEP/"
        self.assertEqual(self.cases(text), [("STEP 1", {}, {})])

    def test_large_displacements(self):
        with self.assertWarnsRegex(fuge.FileWarning, "line 12: NLGEOM has no effect"):
            self.read(GAPS + STEP + "*STEP, NLGEOM/*STATIC")
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.read(GAPS + "*STEP, NLGEOM/*FREQUENCY")

    def test_refused_gaps(self):
        self.refuses(
            ELEMENT,
            ("*GAP, ELSET=G/*STEP", "line 8: *GAP needs one data line, and has 0"),
            ("*GAP, ELSET=G/1/2", "line 8: *GAP needs one data line, and has 2"),
            ("", "GAPUNI 7 has no *GAP"),
            ("*GAP, ELSET=H", 'line 8: *GAP: the element set "H" is not defined'),
            ("*GAP", "line 8: *GAP needs ELSET"),
            ("*GAP, ELSET=G/1/*GAP, ELSET=G/1", "line 11: *GAP: GAPUNI 7 has a *GAP already"),
            ("*ELEMENT, TYPE=MASS, ELSET=M/8, 1/*GAP, ELSET=M/0", "line 11: *GAP: MASS 8 is no gap element"),
        )
        for kind, nodes, line, words in (
            ("GAPUNI", "1, 2", "one", '"one" is not a number'),
            ("GAPUNI", "1, 2", "1,,,,,-5", "the stiffness is negative"),
            ("GAPUNI", "1, 2", "1,,,,,1e-320", "the stiffness is too small"),
            ("GAPUNI", "1, 2", "1,1,0,0,5", "a number in the fifth column is not read"),
            ("GAPUNI", "1, 2", "1,1,0,0,,5,,1", "more than 7 columns"),
            ("GAPUNI", "1, 1", "1", "GAPUNI 8: its nodes coincide"),
            ("GAPCYL", "1, 3", "1", "GAPCYL 8: the direction cosines of its axis are missing"),
            ("GAPCYL", "1, 3", "1,0,0,1", "GAPCYL 8: its nodes coincide, or are on one line"),
            # What the projection leaves is rounding.
            ("GAPCYL", "1, 2", "1,.6,.8", "GAPCYL 8: its nodes coincide, or are on one line"),
        ):
            self.refuses("", (SECOND.format(kind, nodes, line), f"line 13: *GAP: {words}"))

    def test_refused_conditions(self):
        for lines, words in (
            ("1, 2, 2, .5", "*BOUNDARY: node 1 is displaced by 0.5 in direction 2, but by 0 in"),
            ("9, 1", "*BOUNDARY: the deck has no node 9"),
            ("TOP, 1", '*BOUNDARY: the set of nodes "TOP" is not defined'),
            ("2, 11", '*BOUNDARY: direction "11" is outside 1 .. 6'),
            ("2, 3, 1", '*BOUNDARY: last direction "1" is outside 3 .. 6'),
            ("2, 3, 3, x", '*BOUNDARY: "x" is not a number'),
            ("2, 3, 3, 0, 1", "*BOUNDARY: more columns than node, first and last"),
            ("2, PINNED, 3", "*BOUNDARY: more columns than node and name"),
            ("*CLOAD", "*CLOAD is needed in a *STEP"),
            ("*STATIC", "*STATIC is needed in a *STEP"),
            ("*STEP/*VISCO/*BUCKLE", "*BUCKLE: the step has *VISCO already"),
            ("*STEP/*CLOAD, OP=OLD", '*CLOAD: OP="OLD" is not read, only MOD, NEW'),
            ("*STEP/*CLOAD/*CLOAD, OP=NEW", "*CLOAD: OP=NEW belongs to the first"),
            ("*STEP/*CLOAD/1, 3", "*CLOAD: the value is missing"),
            ("*STEP/*CLOAD/9, 3, 1.", "*CLOAD: the deck has no node 9"),
            ("*STEP/*CLOAD/1, 0, 2", '*CLOAD: direction "0" is outside 1 .. 6'),
        ):
            self.refuses(HELD, (lines, f"line {12 + lines.count('/')}: {words}"))

    def test_refused_keywords(self):
        self.refuses(
            GAPS,
            ("*CONTACT PAIR, INTERACTION=I", "line 10: *CONTACTPAIR is not read here: of contact the gap elements are"),
            ("*CONTACT INTERFERENCE", "line 10: *CONTACTINTERFERENCE is not read here"),
            ("*CONNECTOR SECTION, ELSET=G", "line 10: *CONNECTORSECTION is not read, and could change the answer"),
            ("*ELEMENT, TYPE=CONN3D2", 'line 10: elements of type "CONN3D2" are not read here'),
            ("*ELEMENT, TYPE=GAPUNIT", "line 10: elements of type"),
            (
                "*INITIAL CONDITIONS, TYPE=STRESS",
                'line 10: *INITIALCONDITIONS: TYPE="STRESS" is not read, only FIELD',
            ),
            ("*MATERIAL, NAME=TENSION_ONLY1", "line 10: materials for one sign only"),
            ("*PLASTIC", "line 10: *PLASTIC is not read here: materials are linear"),
            ("*RESTART, READ", 'line 10: *RESTART: the parameter "READ" is not read'),
            ("*STEP/*STATIC, RIKS", 'line 11: *STATIC: the parameter "RIKS" is not read'),
            ("*MPC/DIST, 1, 2, 3", 'line 11: *MPC of type "DIST" is not read'),
        )
        for load in "DLOA/TEMPERATURE/FIELD/BASE MOTION/FILM/SLOAD/SWELLING".split("/"):
            self.refuses(GAPS + STEP, (f"*{load}", "is not read: give its forces at nodes by *CLOAD"))


if __name__ == "__main__":
    unittest.main()
