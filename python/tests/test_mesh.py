"""Meshes: input files of Abaqus and CalculiX, faces of elements, surfaces with their matrix, files for ParaView."""

import re
import tracemalloc
import unittest
from pathlib import Path

import numpy as np

import fuge
from files import InFolder
from fuge.element_faces import face_nodes

NODES = "*NODE, NSET=ALL\n1,0.,0.,0.\n2,1.,0.\n5,1.,1.\n9,0,1\n"
CUBE = "*NODE\n1,0,0\n2,1,0\n3,1,1\n4,0,1\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n"
# Two squares side by side.
SQUARES = (
    "*NODE\n10,0,0\n20,1,0\n30,2,0\n40,0,1\n50,1,1\n60,2,1\n*ELEMENT, TYPE=CPE4, ELSET=BOTH\n1,10,20,50,40\n"
    "2,20,30,60,50\n*NSET, NSET=Ends\n60,10,30\n*NSET, NSET=HELD\n10,40\n*SURFACE, NAME=Top\nBOTH, S3\n"
    "*SURFACE, NAME=LEFT\n1, S4\n"
)
SHELLS = (
    "*NODE\n1,0,0\n2,1,0\n3,1,1\n4,0,1\n5,.5,0\n6,1,.5\n7,.5,1\n8,0,.5\n9,2,0\n*ELEMENT, TYPE=S8R, ELSET=A\n"
    "1,1,2,3,4,5,6,7,8\n*ELEMENT, TYPE=M3D3, ELSET=A\n2,2,9,3\n*ELEMENT, TYPE=CPS4\n3,1,2,3,4\n"
)

REFUSED = [
    ("", "there is no *NODE"),
    ("*STEP\n1,2,3\n", "there is no *NODE"),
    (NODES + "5,0.,0.,0.\n", "line 6: node 5 is defined a second time"),
    ("*NODE\n1,0.,nan\n", 'line 2: "nan" is not a finite number'),
    ("*NODE\n1,0.,1e400\n", 'line 2: "1e400" is not a finite number'),
    ("*NODE\nx,0.\n", 'line 2: node "x" is not a whole number'),
    ("*NODE\n1 2, 0.\n", 'line 2: node "1 2" is not a whole number'),
    ("*NODE\n99999999999,0.\n", 'line 2: node "99999999999" is outside 1 ..'),
    ("*NODE\n1,0.,0.,0.,1.\n", "line 2: more than three coordinates"),
    ("*NODE, SYSTEM=C\n1,0.\n", "line 1: SYSTEM = C is not read"),
    (NODES + "*ELEMENT, TYPE=CPS4\n1,1,2,5\n", "line 7: element 1 has more or fewer nodes than the 4 of its type CPS4"),
    (NODES + "*ELEMENT, TYPE=CPS3\n1,1,2,5,9\n", "line 7: element 1 has more or fewer nodes than the 3"),
    (NODES + "*ELEMENT, TYPE=CPS3\n1,1,2,6\n", "line 7: element 1 has the node 6, which is not defined"),
    (NODES + "*ELEMENT, TYPE=CPS3\n1,1,2,5\n1,1,2,9\n", "line 8: element 1 is defined a second time"),
    (NODES + "*ELEMENT, TYPE=MASS\n1\n2\n", "line 7: element 1 has no nodes"),
    (NODES + "*ELEMENT\n1,1,2,5\n", "line 6: *ELEMENT needs TYPE = and a type of at most 16 letters and digits"),
    (NODES + "*ELEMENT, TYPE=CPS3 ELSET=A\n1,1,2,5\n", "line 6: *ELEMENT needs TYPE = and a type"),
    (NODES + "*NSET\n1\n", "line 6: *NSET needs NSET = and a name"),
    (NODES + "*NSET, NSET=A\n1, 4\n", "line 7: node 4 of set A is not defined"),
    (NODES + "*NSET, NSET=A\n1, B\n", 'line 7: the node set "B" is not defined above'),
    (NODES + "*NSET, NSET=A, ELSET=B\n", 'line 6: the element set "B" is not defined above'),
    (NODES + "*ELSET, ELSET=B\n12\n*NSET, NSET=N, ELSET=B\n", "line 7: element 12 of set B is not defined"),
    (NODES + "*NSET, NSET=A, GENERATE\n5, 1\n", "line 7: from 5 to 1"),
    (NODES + "*NSET, NSET=A, GENERATE\n1, 2147483647\n", "line 7: more than 20000000 members"),
    (NODES + "*NSET, NSET=A, GENERATE\n1, 5, 0\n", 'line 7: node "0" is outside'),
    (NODES + "*NSET, NSET=A, GENERATE\n1, 5, 1, 2\n", "line 7: more than a first number, a last one and a step"),
    (NODES + "*NSET, NSET=" + "A" * 81 + "\n1\n", "more than 80 characters"),
    (NODES + "*SURFACE, NAME=A\n7, S1\n", "line 7: element 7 of surface A is not defined"),
    (NODES + "*SURFACE, NAME=A\nB, S1\n", 'line 7: the element set "B" is not defined above'),
    (NODES + "*ELSET, ELSET=A\n*SURFACE, NAME=A\nA\n", 'line 8: the face of "A" is missing'),
    (NODES + "*SURFACE, NAME=A\n7, SX\n", 'line 7: face S "X" is not a whole number'),
    (NODES + "*SURFACE, NAME=A\n7, S7\n", 'line 7: face S "7" is outside 1 .. 6'),
    (NODES + "*SURFACE, NAME=A\n7, E1\n", 'line 7: "E1" is no face: S1 to S6, SPOS and SNEG are read'),
    (NODES + "*SURFACE, NAME=A, TYPE=NODE\n5, 2\n", 'line 7: "2" would be the area of a node'),
    (NODES + "*SURFACE, NAME=A, TYPE=SURE\n", 'line 6: *SURFACE: TYPE = "SURE" is not read'),
    (NODES + "*SURFACE, NAME=A, COMBINE=UNION\nB, C\n", "line 6: COMBINE = is not read here: list its faces"),
    (SHELLS + "*SURFACE, NAME=UP\nA, SPOS\n3, SPOS\n", "line 19: element 3 of type CPS4 has no faces SPOS and SNEG"),
    (NODES + "*NGEN\n1,5\n", "line 6: *NGEN is not read"),
    ("*PART, NAME=P\n" + NODES, "line 1: *PART is not read"),
    (NODES + "*NODEE\n7,0.\n", 'line 6: "*NODEE" is no keyword'),
    ("GRID*, 7\n*, 0.\n", 'line 2: "*" is no keyword of Abaqus or CalculiX, and none stands above'),
    (NODES + "*NOD\n7,0.\n", 'line 6: "NOD" may be NODE or'),
    (NODES + "*NSET, NSET=A, GENERTE\n1,5\n", 'line 6: *NSET: the parameter "GENERTE" is not read'),
    (NODES + "*NSET, NSET=A, NSE=B\n1,5\n", "line 6: *NSET: NSET is given twice"),
    (NODES + "*ELSET, ELSET=A, INPUT=b.txt\n", "line 6: INPUT = is not read here: use *INCLUDE"),
    ("*INCLUDE, INPUT=no_such_file.inp\n", "no_such_file.inp"),
    ("*INCLUDE\n", "line 1: *INCLUDE needs INPUT = and a path"),
    ("*INCLUDE, INPUT=m.inp\n", "line 1: more than 16 files include each other"),
    (NODES + "*INCLUDE, INPUT=.\n", "is a device, a pipe or a folder"),
    ("*NODE,\n*ELEMENT\n", "line 2: the keyword line above ends with a comma"),
]


class Meshes(InFolder):
    def read(self, text):
        return fuge.read_mesh(self.file("m.inp", text))

    def expect(self, found, wanted):
        self.assertEqual([list(row) if np.ndim(row) else row for row in found], list(wanted))

    def refuses(self, status, message, call, *arguments):
        with self.assertRaisesRegex(fuge.InputError, re.escape(message)) as caught:
            call(*arguments)
        self.assertEqual(caught.exception.status, status)


class Files(Meshes):
    def test_common_core(self):
        self.file("part.inp", "** included\n*Element, type=CPS4R, elset=Body\n 7, 1, 2,\n5, 9\n")
        mesh = self.read(
            "*HEADING\n1, 2, *no keyword\n" + NODES + "*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1e5, 0.3\n** comment\n"
            "*INCLUDE, INPUT=part.inp\n*ELEMENT, TYPE=B31\n8, 1,5\n*NSET, NSET=Side\n5, 2, 5\n9,\n*NSET, NSET=EVEN,\n"
            " GENERATE\n1, 9, 4\n*NSET, NSET=BOTH\nside, 1\n*Elset, Elset=MORE\n8, BODY\n"
            "*SURFACE, NAME=Top, TYPE=ELEMENT\nBODY, S3\n7, s2\n7,S3\n*SURFACE, NAME=POINTS, TYPE=NODE\nEVEN\n*STEP\n"
            "*CLOAD\n5,3,-1.\n"
        )
        self.expect(mesh.node, [1, 2, 5, 9])
        self.expect(mesh.position, [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
        self.expect(mesh.element, [7, 8])
        self.expect([mesh.first, mesh.connection], [[0, 4, 6], [0, 1, 2, 3, 0, 2]])
        self.assertEqual([mesh.element_type(k) for k in (0, 1)], ["CPS4R", "B31"])
        self.assertRaises(fuge.InputError, mesh.element_type, 2)
        self.assertEqual(mesh.node_sets, ["ALL", "SIDE", "EVEN", "BOTH", "POINTS"])
        self.assertEqual((mesh.element_sets, mesh.surfaces), (["BODY", "MORE"], ["TOP"]))
        wanted = [[0, 1, 2, 3], [2, 1, 3], [0, 2, 3], [2, 1, 3, 0], [0, 2, 3]]
        self.expect([mesh.node_set(name.lower()) for name in mesh.node_sets], wanted)
        self.expect(mesh.element_set("More"), [1, 0])
        self.expect(mesh.faces("top"), [[2, 3] + 6 * [-1], [1, 2] + 6 * [-1]])
        names, option = "ALL, SIDE, EVEN, BOTH, POINTS", fuge.Status.ERR_OPTION
        self.refuses(option, f'the mesh has no set of nodes "BODY", it has {names}', mesh.node_set, "BODY")
        self.refuses(option, 'the mesh has no surface "BOTTOM", it has TOP', mesh.faces, "BOTTOM")
        self.assertEqual([Path(path).name for path in mesh.paths], ["m.inp", "part.inp"])
        self.assertEqual(repr(mesh), f"<Mesh: 4 nodes, 2 elements B31, CPS4R, node sets {names}, surfaces TOP>")

    def test_refused(self):
        for text, reason in REFUSED:
            with self.subTest(reason):
                self.refused(reason, self.read, text)

    def test_abbreviations(self):
        mesh = self.read(
            NODES + "*ELEM, TY=CPS4, ELS=E\n7,1,2,5,9\n*NSE, NS=A, GEN\n1,5,2\n*ELS, ELSET=B\n7\n"
            "*SURF, NAM=S, TYP=ELEM\nB,S1\n*SURFACE, NAME=P, TYPE=N\n5\n"
        )
        self.assertEqual((mesh.node_sets, mesh.element_sets, mesh.surfaces), (["ALL", "A", "P"], ["E", "B"], ["S"]))
        self.expect(mesh.node_set("a"), [0, 2])

    def test_numbers_plain_and_not(self):
        # The same lines are read at once where they are plain, and else one by one.
        plain = self.read("*NODE\n1, 1e3, -2.5\n+7,.5,3.\n*NSET, NSET=A\n7,1,\n")
        for lines in ("1, 1d3, -2.5\n7,.5,3.\n", "1, 1.+3, -2.5,\n7,.5,3.,\n", "1, 1e3, -2.5, , \n7,.5,3.\n"):
            mesh = self.read(f"*NODE\n{lines}*NSET, NSET=B\n1\n*NSET, NSET=A\n7,1\n")
            self.expect(mesh.position, plain.position.tolist())
            self.expect(mesh.node_set("a"), [1, 0])
        self.expect(self.read("*NODE\n2, , 3\n").position, [[0, 3, 0]])

    def test_members_before_and_after(self):
        triangles = "*ELEMENT, TYPE=CPS3, ELSET=A\n7,9,1,2\n8,2,5,9\n"
        mesh = self.read(
            "*NSET, NSET=EARLY\n9, 2\n" + NODES + triangles + "*NSET, NSET=N, ELSET=a\n"
            "*ELSET, ELSET=G, GENERATE\n8,20\n*NSET, NSET=LAST, ELSET=G\n*NSET, NSET=LAST\n1\n"
        )
        wanted = [[3, 1], [3, 0, 1, 2], [1, 2, 3, 0]]
        self.expect([mesh.node_set(name) for name in ("early", "n", "last")], wanted)

    def test_sets_that_name_each_other(self):
        # They would double at each line, and a range must not take memory.
        round = "*NSET, NSET=A\nB, B\n*NSET, NSET=B\nA, A\n"
        surface = "*SURFACE, NAME=S\nE, S1\n*NSET, NSET=N, ELSET=E\n"
        range = "*NSET, NSET=C, GENERATE\n1, 20000000\n*NSET, NSET=D\nC\n"
        tracemalloc.start()
        mesh = self.read(
            NODES
            + "*NSET, NSET=A\n5, 1\n*NSET, NSET=B\n2\n"
            + round * 60
            + "*NSET, NSET=B\n9,A\n"
            + range * 500
            + "*ELEMENT, TYPE=CPS3, ELSET=E\n7,1,2,5\n"
            + surface * 200
        )
        self.assertLess(tracemalloc.get_traced_memory()[1], 2**24)
        tracemalloc.stop()
        sets = [mesh.node_set(name) for name in "abdn"]
        self.expect(sets, [[2, 0, 1], [1, 2, 0, 3], [0, 1, 2, 3], [0, 1, 2]])
        self.expect(mesh.faces("s")[:, :2], [[0, 1]])


class Faces(Meshes):
    def test_solids(self):
        # Each face looks outwards, with the middles of its sides between its corners, and each edge is on two faces.
        tetrahedron = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
        wedge = [*tetrahedron[:3], [0, 0, 1], [1, 0, 1], [0, 1, 1]]
        cube = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]
        edges = {4: "01 12 20 03 13 23", 6: "01 12 20 34 45 53 03 14 25", 8: "01 12 23 30 45 56 67 74 04 15 26 37"}
        for corners, (linear, quadratic) in zip((tetrahedron, wedge, cube), ((4, 10), (6, 15), (8, 20))):
            ends = [[int(a), int(b)] for a, b in edges[linear].split()]
            x = np.array(corners + np.mean(np.array(corners, dtype=float)[ends], axis=1).tolist())
            faces = [face_nodes(f"C3D{quadratic}R", k) for k in range(1, 8)]
            faces = [face for face in faces if face]
            self.assertEqual(len(faces), {4: 4, 6: 5, 8: 6}[linear])
            self.assertEqual(
                [face_nodes(f"C3D{linear}", k + 1) for k in range(len(faces))],
                [face[: len(face) // 2] for face in faces],
            )
            for face in faces:
                around = face[: len(face) // 2]
                normal = np.cross(x[around[1]] - x[around[0]], x[around[2]] - x[around[0]])
                self.assertGreater(normal @ (x[around[0]] - x.mean(0)), 0.0)
                middles = (x[around] + x[around[1:] + around[:1]]) / 2
                np.testing.assert_array_equal(x[face[len(around) :]], middles)
            used = [node for face in faces for node in face if node >= linear]
            self.assertEqual(sorted(used), sorted(2 * list(range(linear, quadratic))))

    def test_sides_of_shells(self):
        mesh = self.read(SHELLS + "*SURFACE, NAME=UP\nA, Spos\n*SURFACE, NAME=DOWN\nA, SNEG\n")
        self.expect(mesh.faces("up"), [[0, 1, 2, 3, 4, 5, 6, 7], [1, 8, 2] + 5 * [-1]])
        self.expect(mesh.faces("down"), [[0, 3, 2, 1, 7, 6, 5, 4], [1, 2, 8] + 5 * [-1]])

    def test_faces_that_look_inside(self):
        for type, right, wrong in (
            ("CPE4", "1,2,3,4", "4,3,2,1"),
            ("CAX3", "1,2,3", "1,3,2"),
            ("C3D4", "1,2,3,5", "1,3,2,5"),
            ("C3D6", "1,2,4,5,6,8", "5,6,8,1,2,4"),
            ("C3D8", "1,2,3,4,5,6,7,8", "5,6,7,8,1,2,3,4"),
        ):
            text = f"{CUBE}*ELEMENT, TYPE={type}\n9,{{}}\n*SURFACE, NAME=SKIN\n9, S1\n9, S2\n9, S3\n"
            self.assertEqual(len(self.read(text.format(right)).faces("skin")), 3)
            reason = 'surface "skin": face S1 of element 9 looks into the element'
            self.refuses(fuge.Status.ERR_MESH, reason, self.read(text.format(wrong)).faces, "skin")
        mesh = self.read(NODES + "*ELEMENT, TYPE=CPS3, ELSET=T\n3,1,2,5\n*SURFACE, NAME=A\nT, S4\n")
        reason = 'surface "A": element 3 of type CPS3 has no face S4, or its faces are not known'
        self.refuses(fuge.Status.ERR_ELEMENT, reason, mesh.faces, "A")


class WithMatrix(Meshes):
    # Nodes 10 and 40 of the squares are held, node 60 along x; the rows of the others are in disorder.
    NODE, DIRECTION = [60, 20, 20, 50, 50, 30, 30], [2, 1, 2, 2, 1, 1, 2]

    def matrix(self, node, direction):
        n = len(node)
        identity = np.arange(n + 1, dtype=np.intc)
        return fuge.StiffnessFile((n, n), identity, identity[:n], np.ones(n), np.array(node), np.array(direction))

    def test_surface_and_set(self):
        mesh, stiffness = self.read(SQUARES), self.matrix(self.NODE, self.DIRECTION)
        surface = mesh.surface("top", stiffness, 2)
        self.expect(surface.node, [[0, 0], [1, 0], [2, 0], [0, 1], [1, 1], [2, 1]])
        self.expect(surface.face[:, :3], [[4, 3, -1], [5, 4, -1]])
        self.expect(surface.dof, [[-1, -1], [1, 2], [5, 6], [-1, -1], [4, 3], [-1, 0]])
        self.assertIsNone(mesh.surface("top", None, 2).dof)
        for name, direction, wanted in (("ends", 2, [0, 6]), ("Ends", 1, [5]), ("HELD", 1, []), ("ENDS", 6, [])):
            self.expect(mesh.set_dof(name, direction, stiffness), wanted)

    def test_refused(self):
        mesh, node, direction = self.read(SQUARES), np.array(self.NODE), np.array(self.DIRECTION)
        option, dof = fuge.Status.ERR_OPTION, fuge.Status.ERR_DOF
        for name, count, node, direction, status, reason in (
            ("MIDDLE", 2, node, direction, option, 'no surface "MIDDLE"'),
            ("TOP", 4, node, direction, option, "dimensions = 4"),
            ("TOP", 3, node, direction, fuge.Status.ERR_ELEMENT, "element 1 of type CPE4 is none of 3 dimensions"),
            ("TOP", 2, node, direction[:6], fuge.Status.ERR_SIZE, "direction has the shape (6,)"),
            ("TOP", 2, 0 * node, 0 * direction, dof, "have no names"),
            ("TOP", 2, [*node, 60], [*direction, 2], dof, "are node 60, direction 2"),
            ("TOP", 2, node + 1, direction, dof, "no row of any node of the mesh, such as"),
            ("TOP", 2, [*node, 70], [*direction, 2], dof, "node 40 has no row in the stiffness matrix, which has rows"),
            ("LEFT", 2, node, direction, dof, "none of them moves"),
        ):
            with self.subTest(reason):
                self.refuses(status, reason, mesh.surface, name, self.matrix(node, direction), count)
        stiffness = self.matrix(self.NODE, self.DIRECTION)
        self.refuses(option, 'no set of nodes "TOP"', mesh.set_dof, "TOP", 1, stiffness)
        self.refuses(option, "direction = 7", mesh.set_dof, "ENDS", 7, stiffness)

    def test_shells_in_contact(self):
        # Two plates, the upper one pressed on the lower one by 0.5 at each of its nodes.
        text = "*NODE\n1,0,0,{z}\n2,1,0,{z}\n3,1,1,{z}\n4,0,1,{z}\n*ELEMENT, TYPE={type}, ELSET=E\n1,1,2,3,4\n"
        text += "*SURFACE, NAME=UP\nE, SPOS\n*SURFACE, NAME=DOWN\nE, SNEG\n"
        lower, upper = self.read(text.format(z=0, type="S4R")), self.read(text.format(z=0.25, type="M3D4"))
        stiffness = self.matrix(np.repeat([1, 2, 3, 4], 3), np.tile([1, 2, 3], 4))
        for name, status in (("down", None), ("up", fuge.Status.ERR_MESH)):
            bodies = fuge.ElasticBodies()
            below, above = bodies.add(stiffness), bodies.add(stiffness)
            above.set_load(np.tile([0.0, 0.0, -0.5], 4))
            bodies.add_pair(above, upper.surface(name, stiffness), below, lower.surface("up", stiffness))
            if status is None:
                contact = bodies.solve(sparse=False)
                # Springs of 1: the gap 0.25 closes, and each plate carries half of what is left.
                np.testing.assert_allclose(contact.force, 0.125, rtol=1e-12)
                np.testing.assert_allclose(contact.initial_gap, 0.25)
            else:
                self.refuses(status, "normals to the same side", bodies.solve)


class Arrays(Meshes):
    def test_arrays_and_pictures(self):
        x, elements = [[0, 0], [1, 0], [1, 1], [0, 1], [2, 0]], [[0, 1, 2, 3], [1, 4, 2, -1]]
        mesh = fuge.Mesh.from_arrays(x, elements, ["cpe4", "CPE3"])
        self.assertEqual((mesh.position.shape, mesh.element_type(0)), ((5, 3), "CPE4"))
        both = fuge.join_meshes([mesh, mesh])
        self.expect(both.first, [0, 4, 7, 11, 14])
        self.expect(both.connection[7:], [5, 6, 7, 8, 6, 9, 7])
        self.expect(both.node[4:6], [5, 1])
        path = self.folder / "m.vtu"
        both.write(path)
        both.write(path, {"displacement": np.ones((10, 2)), "gap": np.arange(10)}, {"body": [0, 0, 1, 1]})
        text = path.read_bytes()
        for name in (b'"displacement"', b'"gap"', b'"body"', b'NumberOfPoints="10" NumberOfCells="4"'):
            self.assertIn(name, text)
        self.refuses(fuge.Status.ERR_SIZE, "the field 'gap'", both.write, path, {"gap": np.arange(7)})
        self.refuses(fuge.Status.ERR_SIZE, "no meshes", fuge.join_meshes, [])
        wrong = (([[0]], "CPE4"), ([[0, 1, 9]], "CPE3"), ([[0, -1, 1, 2]], "CPE3"), ([[0, 1, 2]], ["CPE3"] * 2))
        for element, type in wrong:
            self.assertRaises(fuge.InputError, fuge.Mesh.from_arrays, np.eye(3), element, type)

    def test_types_in_pictures(self):
        path = self.folder / "m.vtu"
        # The third node of a beam shows how it is turned: the cell has 16 bytes, for two nodes.
        self.read(NODES + "*ELEMENT, TYPE=B31\n17,1,2,9\n").write(path)
        values = path.read_bytes().split(b'encoding="raw">\n_')[1]
        self.expect(np.frombuffer(values[8 + 4 * 24 :][:24], dtype="<i8"), [16, 0, 1])
        self.read(NODES).write(path)
        mesh = self.read(NODES + "*ELEMENT, TYPE=CPS3\n7,1,2,5\n*ELEMENT, TYPE=SPRING1\n18,5\n")
        reason = 'element 18 has the type "SPRING1", which VTK does not have'
        self.refuses(fuge.Status.ERR_ELEMENT, reason, mesh.write, path)


if __name__ == "__main__":
    unittest.main()
