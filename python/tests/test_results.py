"""Results on grids for ParaView."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

import fuge


class Pictures(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def test_pictures(self):
        field = np.arange(6.0).reshape(2, 3)
        path = self.folder / "f.vti"
        fuge.write_results(path, (1.0, 2.0), {"pressure": field, "gap": -field}, origin=(5.0, 6.0))
        text = path.read_bytes()
        self.assertIn(b'"pressure"', text)
        self.assertIn(field.tobytes(), text)
        self.assertIn((-field).tobytes(), text)
        path = self.folder / "f.vtr"
        volume = np.arange(12.0).reshape(2, 2, 3)
        fuge.write_volume(path, (1.0, 2.0), [0.0, 1.0], {"zz": volume})
        self.assertIn(volume.tobytes(), path.read_bytes())
        with self.assertRaisesRegex(fuge.InputError, "gap"):
            fuge.write_results(path, (1.0, 2.0), {"pressure": field, "gap": field.T})
        self.assertRaises(fuge.InputError, fuge.write_results, path, (1.0, 2.0), {})
