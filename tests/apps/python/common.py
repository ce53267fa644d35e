"""Helpers of the tests of the Python module."""

import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy

PROGRAM = os.environ["RUGOSA"]  # the program, which must give the same bits as the module


def rough_heights(nodes=256, seed=1):
    """A random walk, mm."""
    return numpy.cumsum(numpy.random.default_rng(seed).normal(0, 1e-4, nodes))


class WithFolder(unittest.TestCase):
    """A test with an empty folder, self.folder."""

    def setUp(self):
        kept = tempfile.TemporaryDirectory()
        self.addCleanup(kept.cleanup)
        self.folder = pathlib.Path(kept.name)

    def rugosa(self, *words, code=(0,)):
        done = subprocess.run([PROGRAM, *map(str, words)], cwd=self.folder, capture_output=True, text=True)
        self.assertIn(done.returncode, code, done.stderr)
        return done

    def curve(self, *words):
        """The columns of the program's curve."""
        self.rugosa("contact", *words, "--out", "c.csv", "--force")
        return numpy.genfromtxt(self.folder / "c.csv", delimiter=",", names=True)

    def save(self, heights, name="scan.txt"):
        numpy.savetxt(self.folder / name, heights, fmt="%.17g")
