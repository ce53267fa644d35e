"""The experiment `readings`, a script on the program: shares, resuming and refusals."""

import collections
import csv
import json
import os
import pathlib
import signal
import subprocess
import time
import unittest

from common import PROGRAM, WithFolder

EXPERIMENT = pathlib.Path(os.environ["RUGOSA_SOURCE"]) / "experiments/readings/readings.ini"
COARSE = ["run", EXPERIMENT, "--pictures", "off", "--set", "readings.quick=on", "--set", "readings.databases=1",
          "--nodes", "16", "--steps", "4"]


class Readings(WithFolder):
    def table(self, name):
        with open(self.folder / name, newline="") as file:
            return list(csv.DictReader(file))

    def test_choices_are_tried_one_at_a_time(self):
        self.rugosa(*COARSE, "--out", "r")
        cells = self.table("r/cells.csv")
        # Ours, each other value of each choice, and another database, on four targets each.
        self.assertEqual(len(cells), 4 * (1 + 3 + 2 + 2 + 1 + 1 + 1 + 4 + 1))
        held = collections.defaultdict(list)
        for cell in cells:
            for column, sign in cell.items():
                if column.startswith("claim_") and cell["database"] == "0" and cell["Body"] == "strip":
                    held[column.removeprefix("claim_")].append(sign == "1")
        rows = [row for row in self.table("r/claims.csv") if row["value"] == "strip"]
        self.assertEqual(len(rows), len(held))
        for row in rows:
            self.assertAlmostEqual(float(row["share_holds"]), sum(held[row["claim"]]) / 4)
        result = json.loads((self.folder / "r/result.json").read_text())
        self.assertEqual(len(result["readings"]), 15)
        self.assertEqual(result["kind"], "readings")
        self.assertTrue((self.folder / "r/targets/strip-median.csv").exists())
        self.assertFalse((self.folder / "r/checkpoints").exists())

        # A run that was interrupted is resumed to the same tables, but not under other settings.
        run = subprocess.Popen([PROGRAM, *map(str, COARSE), "--out", "s"], cwd=self.folder, stdout=subprocess.DEVNULL)
        while len(list(self.folder.glob("s/checkpoints/0-*.json"))) < 3:
            time.sleep(0.02)
        run.send_signal(signal.SIGTERM)
        self.assertEqual(run.wait(), 130)
        refused = self.rugosa(*COARSE, "--seed", "9", "--out", "s", "--resume", code=(2,))
        self.assertEqual(refused.stderr.count("\n"), 1)
        folder = self.folder / "s/checkpoints"  # forged parts are refused, too
        for forged in (folder / "curves-1.json", next(folder.glob("0-*.json"))):
            good = forged.read_text()
            values = json.loads(good)
            for bad in ([], 3, values[1:], [[3]] * len(values), [{"<script>": "reproduced"}] * len(values),
                        [{"": "maybe"}] * len(values), [[[0.5, "x"]] * 20] * len(values)):
                forged.write_text(json.dumps(bad))
                refused = self.rugosa(*COARSE, "--out", "s", "--resume", code=(2,))
                self.assertEqual(refused.stderr.count("\n"), 1)
                self.assertIn("was altered", refused.stderr)
            forged.write_text(good)
        self.rugosa(*COARSE, "--out", "s", "--resume")
        for name in ("cells.csv", "claims.csv", "shares.csv"):
            self.assertEqual((self.folder / "s" / name).read_bytes(), (self.folder / "r" / name).read_bytes())

    def test_what_the_readings_try_is_refused(self):
        refused = self.rugosa(*COARSE, "--kernel", "strip", "--out", "t", code=(2,))
        self.assertIn("model.kernel", refused.stderr)

    def test_without_python_there_is_one_line(self):
        done = subprocess.run([PROGRAM, *map(str, COARSE)], cwd=self.folder, capture_output=True, text=True,
                              env={"PATH": "/nonexistent"})
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr.count("\n"), 1)
        self.assertIn("python3", done.stderr)


if __name__ == "__main__":
    unittest.main()
