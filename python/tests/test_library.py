"""Messages where libraries are missing, and errors and results that are pickled."""

import os
import pickle
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import fuge
from fuge import _library


def run(code, folder):
    """The output of a new Python that looks for the libraries in `folder`."""
    environment = {**os.environ, "FUGE_LIBRARY_DIR": str(folder)}
    return subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True)


class Libraries(unittest.TestCase):
    def test_no_library(self):
        with tempfile.TemporaryDirectory() as folder:
            result = run("import fuge", folder)
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("ImportError", result.stderr)
        self.assertIn("pip", result.stderr)

    def test_without_cholmod(self):
        code = (
            "import fuge, numpy as np\n"
            "one = np.ones(1, dtype=np.intc)\n"
            "body = fuge.Body(fuge.CompressedColumns((1, 1), np.array([0, 1]), 0 * one, 2 * np.ones(1)))\n"
            "body.set_contact([0], [1.0])\n"
            "print(body.condense().influence)\n"
            "bodies = fuge.ElasticBodies()\n"
            "try:\n"
            "    bodies.solve(sparse=True)\n"
            "except fuge.UnsupportedError as error:\n"
            "    print(error.status.name, error.message)\n"
        )
        with tempfile.TemporaryDirectory() as folder:
            library = _library._path("fuge").resolve()
            os.symlink(library, Path(folder) / _library._path("fuge").name)
            result = run(code, folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stdout, r"\[\[0.5\]\]\nERR_UNSUPPORTED .*CHOLMOD")

    def test_handle_without_its_function(self):
        code = (
            "import ctypes\n"
            "from fuge._calls import Handle\n"
            "try:\n"
            "    Handle('ghost', 'fuge_ghost_free', ctypes.c_void_p())\n"
            "except (AttributeError, ImportError):\n"
            "    print('refused')\n"
        )
        result = run(code, _library._path("fuge").parent)
        self.assertEqual(result.stdout, "refused\n")
        self.assertEqual(result.stderr, "")


class Pickles(unittest.TestCase):
    def test_errors_and_warnings(self):
        for kind, status in ((fuge.MatrixError, -9), (fuge.NotUniqueWarning, 2)):
            found = pickle.loads(pickle.dumps(kind("why", fuge.Status(status))))
            self.assertIs(type(found), kind)
            self.assertEqual((found.message, found.status), ("why", status))

    def test_results(self):
        contact = pickle.loads(pickle.dumps(fuge.solve([[1.0]], [0.0], 1.0)))
        self.assertEqual(contact.info.status, fuge.Status.DONE)


if __name__ == "__main__":
    unittest.main()
