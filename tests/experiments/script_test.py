"""Experiments that are Python scripts."""

import os
import pathlib
import subprocess
import unittest

from common import PROGRAM, WithFolder

EXPERIMENT = pathlib.Path(os.environ["RUGOSA_SOURCE"]) / "experiments/metainterfaces/metainterfaces.ini"


class Scripts(WithFolder):
    def test_without_python_there_is_one_line(self):
        done = subprocess.run([PROGRAM, "run", str(EXPERIMENT)], cwd=self.folder, capture_output=True, text=True,
                              env={"PATH": "/nonexistent"})
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr.count("\n"), 1)
        self.assertIn("python3", done.stderr)


if __name__ == "__main__":
    unittest.main()
