"""Fields against closed forms, against each other and against what grids give."""

import unittest
import warnings

import numpy as np

import fuge
from fuge import Field

NU, E = 0.3, 2.0
BODY = {"young": E, "poisson": NU}
SAME = fuge.Layers([0.2, 0.5], E, NU)
FILM = fuge.Layers(0.3, [4.0, 1.0], [0.2, 0.3])


def points(x, y, z):
    """Points from coordinates that are broadcast against each other."""
    return np.stack(np.broadcast_arrays(x, y, z), axis=-1)


def ball(n=9):
    """A round pressure in the middle of n x n cells."""
    i = np.arange(n) - n // 2
    return np.sqrt(np.maximum(9.0 - i**2 - i[:, None] ** 2, 0.0))


def area(nx, ny, spacing):
    """The rectangles of a grid: x, y, width_x, width_y."""
    x, y = np.meshgrid(spacing * np.arange(nx), spacing * np.arange(ny))
    return x.ravel(), y.ravel(), spacing, spacing


class Halfplane(unittest.TestCase):
    def test_strip(self):
        # Uniform pressure p on (-a, a), straight below its middle: zz = -(2 p/pi)(atan(a/z) + a z/(a^2 + z^2)).
        p, a, z = 3.0, 0.5, np.array([[0.1, 1.0, 4.0]])
        tensor = Field.halfplane([0.0], 2 * a, [2 * a * p], poisson=NU).stress(points(0.0, 7.0, z))
        self.assertEqual(tensor.shape, (1, 3, 6))
        wanted = -2 * p / np.pi * (np.arctan(a / z) + a * z / (a**2 + z**2))
        np.testing.assert_allclose(tensor[..., 2], wanted, rtol=1e-13)
        np.testing.assert_allclose(tensor[..., 3:], 0.0, atol=1e-15)
        np.testing.assert_allclose(tensor[..., 1], NU * (tensor[..., 0] + tensor[..., 2]), rtol=1e-14)
        thin = Field.halfplane([0.0], 2 * a, [2 * a * p], poisson=NU, plane_state="stress")
        np.testing.assert_array_equal(thin.stress([0.0, 0.0, 1.0])[1], 0.0)

    def test_grid_and_points(self):
        n, width = 16, 0.25
        x, depth = width * np.arange(n), np.array([0.0, 0.3, 2.0])
        force = np.exp(-((x - 2.0) ** 2))
        grid, cells = Field.halfplane_grid(width, force, **BODY), Field.halfplane(x, width, force, **BODY)
        below = points(x, 0.0, depth[:, None])
        self.assertEqual(grid.grid_stress(depth).shape, (3, n, 6))
        np.testing.assert_allclose(grid.grid_stress(depth), cells.stress(below), rtol=0, atol=1e-13)
        np.testing.assert_allclose(grid.grid_displacement(depth), cells.displacement(below), rtol=0, atol=1e-12)
        np.testing.assert_array_equal(grid.stress(below), cells.stress(below))
        self.assertEqual(grid.largest().value, cells.largest().value)
        periodic = Field.halfplane_grid(width, force, boundary="periodic", poisson=NU)
        np.testing.assert_allclose(periodic.grid_stress(1e3)[0, :, 2], -force.mean() / width, rtol=1e-12)

    def test_symmetric(self):
        x, force, place = np.array([-0.5, 0.5]), np.array([1.0, 1.0]), [0.3, 0.0, 0.7]
        whole = Field.halfplane(x, 1.0, force, plane_state="stress", **BODY)
        half = Field.halfplane(x[1:], 1.0, [2.0], plane_state="stress", symmetric=True, **BODY)
        np.testing.assert_allclose(half.stress(place), whole.stress(place), rtol=1e-13)
        np.testing.assert_allclose(half.displacement(place), whole.displacement(place), rtol=1e-12)


class Halfspace(unittest.TestCase):
    def test_points_and_grid(self):
        nx, ny, spacing, depth = 6, 4, 0.5, np.array([0.2, 1.5])
        cells = area(nx, ny, spacing)
        x, y = (values.reshape(ny, nx) for values in cells[:2])
        force = 1.0 + x * y
        grid, rectangles = (
            Field.halfspace_grid(spacing, spacing, force, **BODY),
            Field.halfspace(*cells, force.ravel(), **BODY),
        )
        below = points(x, y, depth[:, None, None])
        wanted = rectangles.stress(below)
        self.assertEqual(grid.grid_stress(depth).shape, (2, ny, nx, 6))
        np.testing.assert_allclose(grid.grid_stress(depth), wanted, rtol=0, atol=1e-12 * np.abs(wanted).max())
        wanted = rectangles.displacement(below)
        np.testing.assert_allclose(grid.grid_displacement(depth), wanted, rtol=0, atol=1e-12 * np.abs(wanted).max())
        np.testing.assert_array_equal(grid.displacement(below), wanted)

    def test_far_below(self):
        # Boussinesq: zz = -3 F/(2 pi z^2) straight below.
        stress = Field.halfspace([0.0], [0.0], 0.1, 0.1, [2.0], poisson=NU).stress([0.0, 0.0, 100.0])
        self.assertAlmostEqual(stress[2] * 2 * np.pi * 100.0**2 / (3 * 2.0), -1.0, delta=1e-5)

    def test_symmetric(self):
        whole = Field.halfspace([-0.5, 0.5], [0.0, 0.0], 1.0, 1.0, [1.0, 1.0], **BODY)
        half = Field.halfspace([0.5], [0.0], 1.0, 1.0, [2.0], symmetric_x=True, **BODY)
        place = [0.2, 0.3, 0.4]
        np.testing.assert_allclose(half.stress(place), whole.stress(place), rtol=1e-12, atol=1e-15)
        np.testing.assert_allclose(half.displacement(place), whole.displacement(place), rtol=1e-12)

    def test_rings(self):
        # One disc: zz straight below is -p (1 - z^3/(a^2 + z^2)^(3/2)).
        z = np.array([0.5, 2.0])
        disc = Field.rings([0.0, 1.0], [np.pi], **BODY)
        stress = disc.stress(points(0.0, 0.0, z))
        np.testing.assert_allclose(stress[:, 2], -(1 - z**3 / (1 + z**2) ** 1.5), rtol=1e-12)
        np.testing.assert_allclose(stress[:, 0], stress[:, 1], rtol=1e-12)
        wanted = fuge.ring_displacement([0.0, 1.0], [np.pi], fuge.plane_modulus(E, NU), 0.5)
        self.assertAlmostEqual(disc.displacement([0.5, 0.0, 0.0])[2], float(wanted), delta=1e-12)


class Contacts(unittest.TestCase):
    """Fields of what a solve returns."""

    def test_line(self):
        # McEwen: on the axis zz = -p0/sqrt(1 + z^2), xx = -p0 ((1 + 2 z^2)/sqrt(1 + z^2) - 2 z).
        contact = fuge.solve_smooth_punch(lambda x: (x**2 / 2, x), -3.0, 3.0, 1.0, np.pi / 4)
        self.assertAlmostEqual(contact.half_width, 1.0, delta=1e-13)
        z = np.array([0.0, 0.3, 0.786, 2.0])
        root = np.sqrt(1 + z**2)
        stress = contact.field(poisson=NU).stress(points(0.0, 0.0, z)) / 0.5
        np.testing.assert_allclose(stress[:, 0], -((1 + 2 * z**2) / root - 2 * z), atol=1e-13)
        np.testing.assert_allclose(stress[:, 2], -1 / root, atol=1e-13)
        # The largest Tresca stress is 0.6006 p0 at the depth 0.786 a.
        peak = contact.field(poisson=NU).largest("tresca")
        self.assertEqual((peak.location, peak.layer, peak.cell), ("inside", None, None))
        self.assertAlmostEqual(peak.value / 0.5, 0.6006, delta=1e-4)
        self.assertAlmostEqual(peak.place[2], 0.786, delta=1e-3)
        n = 100
        x = (np.arange(n) - (n - 1) / 2) * 0.03
        force = 0.03 * contact.pressure(x)
        found = Field.halfplane(x, 0.03, force, "hat", poisson=NU).largest("tresca")
        self.assertAlmostEqual(found.value, peak.value, delta=1e-3)
        half = Field.halfplane(x[n // 2 :], 0.03, 2 * force[n // 2 :], "hat", poisson=NU, symmetric=True)
        self.assertAlmostEqual(half.largest("tresca").value, found.value, delta=1e-12)
        grid = fuge.solve(fuge.HalfplaneOperator(n, 0.03, 1.0, "hat"), x**2 / 2, np.pi / 4).field(poisson=NU)
        self.assertAlmostEqual(grid.largest("tresca").value, peak.value, delta=1e-3)
        self.assertEqual(repr(grid), "<Field: line of 100 cells>")

    def test_area(self):
        n, spacing = 65, 0.01
        x = spacing * (np.arange(n) - n // 2)
        contact = fuge.solve(fuge.HalfspaceOperator(n, n, spacing, spacing, 115e3), np.add.outer(x**2, x**2) / 20, 50.0)
        hertz = fuge.hertz_ellipse(10.0, 10.0, 115e3, 50.0)
        field = contact.field(young=210e3, poisson=NU)
        peak = field.largest()
        self.assertAlmostEqual(peak.value / hertz.peak_pressure, 0.620, delta=2e-3)
        self.assertAlmostEqual(peak.place[2] / hertz.semi_axis_x, 0.481, delta=5e-3)
        np.testing.assert_allclose(field.stress(peak.place), peak.tensor, atol=1e-9 * peak.value)
        flat = fuge.solve(
            fuge.HalfspaceOperator(n, n, spacing, spacing, 115e3), np.add.outer(x**2, x**2).ravel() / 20, 50.0
        )
        self.assertEqual(flat.field(poisson=NU).grid_stress(0.1).shape, (1, n, n, 6))
        # On rigid bodies the surface moves as its operator says, for a body of this modulus.
        operator = fuge.HalfspaceOperator(n, n, spacing, spacing, fuge.plane_modulus(210e3, NU), "centre")
        moved = field.grid_displacement(0.0)[0, ..., 2]
        np.testing.assert_allclose(moved, operator @ contact.force, rtol=1e-10)
        px, py = (values.ravel() for values in np.meshgrid(x, x))
        quarter = (px >= 0) & (py >= 0)
        weight = np.where(px > 0, 2.0, 1.0) * np.where(py > 0, 2.0, 1.0) * contact.force.ravel()
        part = Field.halfspace(
            px[quarter], py[quarter], spacing, spacing, weight[quarter], poisson=NU, symmetric_x=True, symmetric_y=True
        )
        self.assertAlmostEqual(part.largest().value / peak.value, 1.0, delta=1e-6)

    def test_round(self):
        contact = fuge.solve_round_powers([0.5], [2.0], 3.0, 1.0, load=4.0 / 3.0)
        hertz = fuge.hertz_ellipse(1.0, 1.0, 1.0, 4.0 / 3.0)
        field = contact.field(**BODY)
        self.assertAlmostEqual(field.largest().value / hertz.peak_pressure, 0.620, delta=1e-3)
        np.testing.assert_allclose(field.stress(points(0.0, 0.0, [0.0, 1.0]))[:, 3:], 0.0, atol=1e-12)
        self.assertEqual(field.displacement(points([0.0, 1.0], 0.0, 0.5)).shape, (2, 3))
        radius = np.linspace(0.0, 1.0, 41)
        resultant = -2 * np.pi / 3 * np.diff((1 - radius**2) ** 1.5)
        self.assertAlmostEqual(Field.rings(radius, resultant, poisson=NU).largest().value, 0.62, delta=0.01)
        # The field keeps what it needs of the contact.
        contact.close()
        self.assertEqual(field.largest().location, "inside")

    def test_singular(self):
        x = (np.arange(40) + 0.5) / 20 - 1
        contact = fuge.solve(fuge.halfplane_matrix(x, 0.05, 1.0, "mean"), 0.0, 1.0)
        peak = Field.halfplane(x, 0.05, contact.force, poisson=NU).largest()
        self.assertEqual(peak.location, "singular")
        self.assertTrue(np.isinf(peak.value) and np.isnan(peak.tensor).all())
        cone = fuge.solve_round_powers([1.0], [1.0], 10.0, 1.0, load=1.0)
        self.assertEqual(cone.field(poisson=NU).largest().location, "singular")

    def test_layers(self):
        x = 0.05 * (np.arange(64) - 31.5)
        contact = fuge.solve(fuge.LayeredHalfplaneOperator(64, 0.05, FILM), x**2 / 2, 0.2)
        wanted = Field.halfplane_grid(0.05, contact.force, layers=FILM)
        np.testing.assert_array_equal(contact.field().grid_stress([0.1, 0.5]), wanted.grid_stress([0.1, 0.5]))
        self.assertEqual(repr(contact.field()), "<Field: line of 64 cells on layers>")
        gap = np.add.outer(x[::4] ** 2, x[::2] ** 2)
        contact = fuge.solve(fuge.LayeredHalfspaceOperator(32, 16, 0.1, 0.2, FILM), gap / 2, 0.2)
        self.assertEqual(len(contact.field().interfaces()), 2)
        with self.assertRaisesRegex(fuge.InputError, "layers have moduli of their own"):
            contact.field(poisson=0.3)


class Layered(unittest.TestCase):
    def test_no_layers(self):
        force, depth = ball()[:, :7], [0.0, 0.4]
        for boundary in ("free", "periodic", "periodic_x", "periodic_y"):
            layered = Field.halfspace_grid(0.2, 0.3, force, boundary, layers=SAME)
            wanted = Field.halfspace_grid(0.2, 0.3, force, boundary, **BODY)
            np.testing.assert_array_equal(layered.grid_stress(depth), wanted.grid_stress(depth))
            np.testing.assert_allclose(layered.grid_displacement(depth), wanted.grid_displacement(depth), atol=1e-14)
        for boundary in ("free", "periodic"):
            layered = Field.halfplane_grid(0.2, force[0], boundary=boundary, layers=SAME)
            wanted = Field.halfplane_grid(0.2, force[0], boundary=boundary, **BODY)
            tensor = wanted.grid_stress(depth)
            np.testing.assert_allclose(layered.grid_stress(depth), tensor, atol=1e-14 * np.abs(tensor).max())
            np.testing.assert_allclose(layered.grid_displacement(0.4), wanted.grid_displacement(0.4), atol=1e-14)

    def test_no_depths(self):
        field = Field.halfspace_grid(0.2, 0.2, ball(), "periodic", layers=FILM)
        self.assertEqual(field.grid_displacement([]).shape, (0, 9, 9, 3))
        self.assertEqual(
            Field.halfspace(*area(9, 9, 0.2), ball().ravel(), layers=FILM).stress(np.empty((0, 3))).shape, (0, 6)
        )

    def test_interface(self):
        field = Field.halfspace_grid(0.2, 0.2, ball(), layers=FILM)
        above, under = field.grid_stress([0.3, 0.3], below=[False, True])
        np.testing.assert_allclose(above[..., 2:5], under[..., 2:5], atol=1e-10)
        self.assertGreater(above[4, 4, 0], under[4, 4, 0])
        surface, interface = field.interfaces()
        self.assertEqual((surface.depth, surface.shear, interface.depth), (0.0, 0.0, 0.3))
        self.assertEqual(interface.cell_above, (4, 4))
        self.assertAlmostEqual(interface.tension_above, above[4, 4, 0], delta=1e-9)
        shear = np.hypot(above[..., 3], above[..., 4])
        self.assertAlmostEqual(interface.shear, shear.max(), delta=1e-9)
        self.assertAlmostEqual(shear[interface.cell_of_shear], shear.max(), delta=1e-9)
        (only,) = Field.halfspace_grid(0.2, 0.2, ball(), layers=SAME).interfaces()
        self.assertEqual(only.tension_above, only.tension_below)
        self.assertEqual(len(Field.halfplane_grid(0.2, ball()[4], layers=FILM).interfaces()), 2)

    def test_points(self):
        force, cells = ball(), area(9, 9, 0.2)
        x, y = (values.reshape(9, 9) for values in cells[:2])
        grid, rectangles = (
            Field.halfspace_grid(0.2, 0.2, force, layers=FILM),
            Field.halfspace(*cells, force.ravel(), layers=FILM),
        )
        found = rectangles.stress(points(x, y, 0.3), below=True)
        np.testing.assert_allclose(found, grid.grid_stress(0.3, below=True)[0], atol=1e-10)
        found = rectangles.displacement(points(x, y, 0.5))
        np.testing.assert_allclose(found, grid.grid_displacement(0.5)[0], atol=1e-10)
        grid = Field.halfplane_grid(0.2, force[4], layers=FILM)
        line = Field.halfplane(x[0], 0.2, force[4], layers=FILM)
        below = points(x[0], 0.0, [[0.0], [0.3]])
        np.testing.assert_allclose(line.stress(below), grid.grid_stress([0.0, 0.3]), atol=1e-10)
        np.testing.assert_allclose(line.displacement(below[1]), grid.grid_displacement(0.3)[0], atol=1e-10)

    def test_largest(self):
        field = Field.halfspace_grid(0.2, 0.2, ball(), layers=FILM)
        peak = field.largest()
        stress = field.grid_stress([0.0, 0.1, 0.3, 0.3, 0.6, 1.0], below=np.arange(6) == 3)
        self.assertGreaterEqual(peak.value, fuge.von_mises(stress).max() * (1 - 1e-9))
        self.assertAlmostEqual(peak.value, float(fuge.von_mises(peak.tensor)), delta=1e-12 * peak.value)
        self.assertIn(peak.layer, (0, 1))
        np.testing.assert_allclose(peak.place[:2], [0.2 * peak.cell[1], 0.2 * peak.cell[0]])
        line = Field.halfplane_grid(0.2, ball()[4], boundary="periodic", layers=FILM).largest("tresca")
        self.assertGreater(line.value, 0.0)
        self.assertEqual(len(line.cell), 1)


class Refusals(unittest.TestCase):
    def refuses(self, words, call, kind=fuge.InputError):
        with self.assertRaisesRegex(kind, words):
            call()

    def test_places(self):
        field = Field.halfplane([0.0], 1.0, [1.0], poisson=NU)
        with self.assertRaises(fuge.InputError) as caught:
            field.stress([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]])
        self.assertEqual(caught.exception.status, fuge.Status.ERR_GRID)
        self.assertRegex(caught.exception.message, r"points\[1, 2\] = -1")
        self.refuses(r"points\[2\] = -1", lambda: field.stress([0.0, 0.0, -1.0]))
        self.refuses(r"points has the shape \(4, 2\), but must have \(4, 3\)", lambda: field.stress(np.zeros((4, 2))))
        self.refuses("must have", lambda: field.stress(1.0))
        self.refuses("Young's modulus", lambda: field.displacement([0.0, 0.0, 1.0]))
        self.refuses("not that of a grid", lambda: field.grid_stress(1.0), fuge.UnsupportedError)
        self.refuses("without layers", field.interfaces, fuge.UnsupportedError)
        self.refuses("measure", lambda: field.largest("mises"))
        self.refuses("closed", lambda: (field.close(), field.largest()), fuge.CallOrderError)

    def test_periodic(self):
        for field in (
            Field.halfplane_grid(1.0, np.ones(3), boundary="periodic", poisson=NU),
            Field.halfspace_grid(1.0, 1.0, np.ones((3, 3)), "periodic_x", poisson=NU),
        ):
            self.refuses("below the centres", lambda: field.stress([0.0, 0.0, 1.0]), fuge.UnsupportedError)
            self.refuses("periodic grid", field.largest, fuge.UnsupportedError)

    def test_bodies(self):
        force = np.ones(2)
        self.refuses("force", lambda: Field.halfplane([0.0], 1.0, force, poisson=NU))
        self.refuses("Poisson's ratio", lambda: Field.halfplane([0.0, 1.0], 1.0, force))
        self.refuses("leave out", lambda: Field.halfplane([0.0, 1.0], 1.0, force, layers=FILM, plane_state="stress"))
        self.refuses("'hat'", lambda: Field.halfplane_grid(1.0, force, "hat", layers=FILM))
        self.refuses("layers must be Layers", lambda: Field.halfplane_grid(1.0, force, layers=2e5), TypeError)
        rigid = Field.halfspace_grid(0.2, 0.2, ball(), layers=fuge.Layers(0.3, [1.0, np.inf], 0.3))
        self.refuses("rigid base", lambda: rigid.grid_stress(0.5))
        self.refuses("below must hold booleans", lambda: rigid.grid_stress(0.3, below=1), TypeError)
        self.refuses("below has the shape", lambda: rigid.grid_stress([0.0, 0.3], below=[True] * 3))

    def test_contacts(self):
        self.refuses("Field.halfplane", lambda: fuge.solve(np.eye(2), 0.0, 1.0).field(poisson=NU))
        half_plane = fuge.HalfplaneOperator(8, 1.0, 1.0)
        operator = fuge.CallbackOperator(8, lambda f: half_plane @ f)
        operator.set_auxiliary(half_plane)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", fuge.GridWarning)
            contact = fuge.solve(operator, 0.0, 1.0)
            area = fuge.solve(fuge.HalfspaceOperator(4, 4, 1.0, 1.0, 1.0), 0.0, 1.0)
        self.refuses("only close to", lambda: contact.field(poisson=NU), fuge.UnsupportedError)
        self.refuses("in no plane", lambda: area.field(poisson=NU, plane_state="stress"))


class Measures(unittest.TestCase):
    def test_tension_and_shear(self):
        tensor = np.zeros((2, 6))
        tensor[0, 0] = 3.0
        tensor[1, 5] = 2.0
        np.testing.assert_allclose(fuge.von_mises(tensor), [3.0, 2 * np.sqrt(3)], rtol=1e-14)
        np.testing.assert_allclose(fuge.tresca(tensor), [3.0, 4.0], rtol=1e-14)
        np.testing.assert_allclose(fuge.mean_stress(tensor), [1.0, 0.0], atol=1e-15)
        np.testing.assert_allclose(fuge.principal_stresses(tensor), [[3, 0, 0], [2, 0, -2]], atol=1e-14)
        self.assertEqual(fuge.von_mises(tensor[0]).shape, ())
        self.assertRaises(fuge.InputError, fuge.von_mises, np.zeros((6, 2)))


if __name__ == "__main__":
    unittest.main()
