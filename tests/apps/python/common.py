"""What the tests of the Python module share."""

import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy

PROGRAM = os.environ["RUGOSA"]  # the program, which must answer to the bit what the module does


def rough_heights(nodes=256, seed=1):
    """A random walk, mm."""
    return numpy.cumsum(numpy.random.default_rng(seed).normal(0, 1e-4, nodes))


class WithFolder(unittest.TestCase):
    """A test with an empty folder of its own, self.folder."""

    def setUp(self):
        kept = tempfile.TemporaryDirectory()
        self.addCleanup(kept.cleanup)
        self.folder = pathlib.Path(kept.name)

    def rugosa(self, *words, code=(0,)):
        done = subprocess.run([PROGRAM, *map(str, words)], cwd=self.folder, capture_output=True, text=True)
        self.assertIn(done.returncode, code, done.stderr)
        return done
