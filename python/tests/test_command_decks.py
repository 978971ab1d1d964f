"""The command with one-way links: a cantilever against a calculation by hand, from three kinds of files."""

import re
import unittest
from pathlib import Path

from test_command import DATA, CommandCase, cells, words

CANTILEVER = DATA / "cantilever"
PCH, STI = f"--stiffness {CANTILEVER}/beam.pch", f"--stiffness {CANTILEVER}/beam.sti"
LINKS = f"--links {CANTILEVER}/links.csv"
TABLES = f"{LINKS} --cases {CANTILEVER}/cases.csv --supports {CANTILEVER}/supports.csv"
NASTRAN = f"--deck {CANTILEVER}/beam.bdf {PCH}"
CALCULIX = f"--deck {CANTILEVER}/beam.inp {STI}"

GRIDS = "GRID,1\nGRID,2,,1.\nGRID,3,,2.\nGRID,4,,3.\nGRID,5,,4.\nGRID,15,,4.,-1.,,,123\nSPC1,1,26,1\n"
FILES = {
    # A case without supports that a force pulls up has no equilibrium; the other one is solved.
    "loose.bdf": f"SUBCASE 1\n LOAD = 1\nSUBCASE 2\n LOAD = 1\n SPC = 1\nBEGIN BULK\n{GRIDS}"
    "CGAP,7,8,15,5,,,,\nPGAP,8,.5\nFORCE,1,5,,3.,0.,1.,0.\n",
    # A case that holds its only link at both ends: the link moves with its supports.
    "held.bdf": f"SUBCASE 1\n LOAD = 1\n SPC = 3\nSUBCASE 2\n LOAD = 1\n SPC = 1\nBEGIN BULK\n{GRIDS}"
    "SPC,2,5,2,.25\nSPCADD,3,1,2\nCGAP,7,8,15,5,,,,\nPGAP,8,.5\nFORCE,1,4,,3.,0.,1.,0.\n",
    "wrong.bdf": "GRID,1\nPGAP,8,.5,,,,,.3\n",
    # A cable that yields.
    "rope.csv": "5,0,0,1,0,0,,0,2,rope\n",
    "pull.csv": "5.2,3\n",
}

REFUSED = (
    (f"--deck wrong.bdf {PCH}", 'wrong.bdf", line 2, PGAP 8: MU1 is not zero', 3),
    (f"--deck {DATA}/blocks/lower.inp {STI}", "no one-way link: the deck has no CGAP", 2),
    (f"{LINKS} {STI}", "no load case: the deck has no SUBCASE", 2),
    (f"{TABLES} --stiffness @beam_stiffness.mtx", "has rows without names: give the node and the direction of each", 2),
    (f"{NASTRAN} --field a.vtu", "--field a.vtu needs --mesh", 2),
    (f"{TABLES} {STI} --gap gap.mtx", "--gap needs another problem than --deck and --links", 2),
    (f"{NASTRAN} --output {CANTILEVER}/beam.bdf", "beam.bdf: the same file as of --deck", 2),
    (f"{NASTRAN} --reactions {CANTILEVER}/beam.pch", "beam.pch: the same file as of --stiffness", 2),
    (f"{LINKS} --cases {CANTILEVER}/cases.csv --stiffness {DATA}/blocks/lower.sti", "has no row of node", 3),
)


class Decks(CommandCase):
    FILES = FILES

    def test_tables(self):
        for name, arguments, field in (
            ("deck_nastran", NASTRAN, ""),
            ("deck_calculix", CALCULIX, ""),
            ("deck_tables", f"{TABLES} {STI} --floats", "deck_tables_field"),
        ):
            with self.subTest(name):
                found = self.table(*words(arguments), "--field", "field.csv", "--reactions", "reactions.csv")
                self.assert_table(found, name)
                if field:
                    self.assert_table(Path("field.csv").read_text(), field)
                # The clamp carries what the links do not.
                rows = cells(Path("reactions.csv").read_text())[1:]
                self.assertEqual([row[:2] for row in rows[:2]], [["1", "2"], ["1", "6"]])
                self.assertAlmostEqual(float(rows[0][2]), 0.046875, 12)
                self.assertAlmostEqual(float(rows[1][2]), 0.1875, 12)

    def test_long_table_and_proof(self):
        found = self.table(*words(CALCULIX), "--long", "--prove")
        lines = [line for line in found.splitlines() if line[0] != "#"]
        self.assertEqual(lines[0], "case,link,force,gap,state,force_bound,gap_bound,proved")
        self.assertEqual(len(lines), 1 + 3 * 2)
        self.assertRegex(lines[1], r"^STEP 1,GAPUNI 55, +2\.9531.*,contact, +\d\.\d+E-01\d, .*,yes$")

    def test_pictures(self):
        self.table(*words(f"{CALCULIX} --field deck.vtu --plot deck.png"))
        self.assertIn(b'Name="displacement 3, STEP 3"', Path("deck.vtu").read_bytes())
        self.assertTrue(Path("deck.png").exists())

    def test_added_cases(self):
        found = self.table(*words(f"{NASTRAN} --cases {CANTILEVER}/cases.csv"))
        pattern = "# case 4: pressed\n.*# case 5: lifted\n.*CGAP 55,15,5, *2[.]9531.*,contact, .*,contact, "
        self.assertTrue(re.search(pattern, found, re.DOTALL), found)

    def test_warnings_of_decks(self):
        Path("large.inp").write_text((CANTILEVER / "beam.inp").read_text().replace("*STEP", "*STEP, NLGEOM", 1))
        for option, code in (("", 0), (" --strict", 5)):
            found, _, errors = self.run_command(*words(f"--deck large.inp {STI}{option}"))
            self.assertEqual(found, code, errors)
            self.assertRegex(errors, "^fuge: warning: .large.inp., line 3[0-9]: NLGEOM has no effect")

    def test_failed_cases(self):
        done = r"# case 2: SUBCASE 2\n# status: 0, done.*CGAP 7,15,5,"
        held = rf"# case 1: SUBCASE 1\n# status: 0, done.*{done} *0[.]0+E.000, *7[.]50+E-001,open"
        failed = rf"# case 1: SUBCASE 1\n# status: -10,.*{done},,failed, *0[.]0"
        for arguments, code, table, message in (
            (f"--deck held.bdf {PCH}", 0, held, "^$"),
            (f"--deck loose.bdf {PCH}", 4, failed, "1 of 2 load cases failed; SUBCASE 1: .*CGAP 7 opens.*node 5, d"),
            (f"--links rope.csv --cases pull.csv {PCH}", 4, "rope,5,0,,,failed,,,,\n", "rope gives way.*2 moves"),
        ):
            with self.subTest(arguments):
                found, output, errors = self.run_command(*words(arguments))
                self.assertEqual(found, code, errors)
                self.assertTrue(re.search(table, output, re.DOTALL), output)
                self.assertRegex(errors, message)

    def test_refusals(self):
        self.assert_refusals(REFUSED)


if __name__ == "__main__":
    unittest.main()
