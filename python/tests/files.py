"""Files in a folder of their own, and what is refused."""

import tempfile
import unittest
from pathlib import Path

import fuge


class InFolder(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def file(self, name, content):
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    def refused(self, words, call, *arguments, error=fuge.FileError, **options):
        """The message with which a call is refused; it has these words."""
        with self.assertRaises(error) as caught:
            call(*arguments, **options)
        self.assertIn(words, str(caught.exception))
        return str(caught.exception)
