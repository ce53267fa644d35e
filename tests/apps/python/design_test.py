import json
import os
import signal
import threading
import unittest

import numpy
import rugosa

from common import WithFolder, rough_heights

PIPELINE = "shape 6 | score | best 2 | refine lm 6 | best 1"
PRESSURE = numpy.linspace(8e-6, 1.6e-4, 12)
STIFFNESS = 0.3 + 0.8 * numpy.sqrt(PRESSURE / 1.6e-4)


class Design(WithFolder):
    def result(self, *words, pipeline=PIPELINE):
        """The program's result for the same target."""
        (self.folder / "T.csv").write_text(rugosa.Target(PRESSURE, STIFFNESS).to_csv())
        self.rugosa("design", "--target", "T.csv", "--pipeline", pipeline, "--pictures", "off", *words, "--out", "d",
                    code=(0, 3))
        return json.loads((self.folder / "d/result.json").read_text())["variants"]["pipeline"]

    def test_gives_the_bits_of_the_program(self):
        result = self.result("--nodes", 128, "--seed", 5)
        for threads in 1, 2:
            design = rugosa.design(PRESSURE, STIFFNESS, pipeline=PIPELINE, nodes=128, seed=5, threads=threads)
            self.assertEqual(design.similarity, result["similarity"])
            self.assertEqual(design.similarity_worst, result["similarity_worst"])
            self.assertEqual((design.price, design.evaluations), (result["price"], result["curves"]))
            self.assertEqual(design.genome.to_dict()["series"], result["genome"]["series"])

    def test_every_keyword_is_its_flag_on_a_line_and_a_map(self):
        limits = [dict(shortest_wave=0.1), dict(max_slope=1e-3), dict(min_radius=20), dict(max_height=2e-4),
                  dict(max_pressure=1.6e-4), dict(hurst_from=0.7, hurst_to=0.8), dict(gamma_from=1.6, gamma_to=1.7),
                  dict(lambda_from=0.3, lambda_to=0.6), dict(ridges=3), dict(seed=4), dict(evaluations=40),
                  dict(reach_similarity=0.9), dict(noise=1e-6, noise_length=0.1), dict(tilt=1e-5),
                  dict(draws=20), dict(alternatives=2), dict(steps=12), dict(modulus=2), dict(reach=0.7)]
        quick = "shape 2 | score | refine lm 2 | best 1"
        of_lines = [dict(datum=2), dict(kernel="strip", strip_width=0.01), dict(kernel="periodic")]
        for nodes, all_options in (("64", limits + of_lines), ("16x16", limits[::2])):
            for options in all_options:
                with self.subTest(nodes=nodes, **options):
                    flags = [f"--{name.replace('_', '-')}={value}" for name, value in options.items()]
                    result = self.result("--nodes", nodes, "--force", *flags, pipeline=quick)
                    design = rugosa.design(PRESSURE, STIFFNESS, pipeline=quick, nodes=nodes, **options)
                    self.assertEqual(design.genome.to_dict()["series"], result["genome"]["series"])
                    self.assertEqual(design.similarity_worst, result["similarity_worst"])

    def test_the_tolerance_is_that_of_the_program(self):
        result = self.result("--nodes", 64, "--noise-length", 0.1, "--reach-similarity", 0.5)["tolerance"]
        found = rugosa.design(PRESSURE, STIFFNESS, pipeline=PIPELINE, nodes=64, noise_length=0.1,
                              reach_similarity=0.5).tolerance
        self.assertEqual(found["noise_length"], 0.1)
        for name, value in ("noise_rms", "noise_rms_mm"), ("tilt", "tilt_mm"), ("scale", "scale"):
            self.assertEqual([level[name] for level in found["levels"]],
                             [level[value] for level in result["levels"]])
        self.assertGreater(found["levels"][-1]["noise_rms"], 0)

    def test_the_answer_has_its_similarity(self):
        design = rugosa.design(PRESSURE, STIFFNESS, pipeline=PIPELINE, nodes=128, steps=20)
        pressure, stiffness = design.curve.secant_stiffness()
        answered = numpy.interp(PRESSURE[1:-1], pressure, stiffness)
        misfit = numpy.abs(answered / STIFFNESS[1:-1] - 1).max()
        self.assertLessEqual(misfit, 1 - design.similarity + 1e-9)
        again = rugosa.contact(design.heights, design.spacing, steps=20)
        self.assertEqual(len(again), 20)
        self.assertLessEqual(design.similarity_worst, design.similarity)
        self.assertEqual(len(design.trust()["checks"]), len({check["name"] for check in design.trust()["checks"]}))

    def test_progress_is_called_and_its_exception_is_raised(self):
        told = []
        rugosa.design(PRESSURE, STIFFNESS, pipeline=PIPELINE, nodes=64, progress=lambda *a: told.append(a))
        self.assertTrue(any("refine" in path for path, *_ in told))
        self.assertGreater(told[-1][2], 0)

        def fail(*_):
            raise ZeroDivisionError("mine")

        with self.assertRaisesRegex(ZeroDivisionError, "mine"):
            rugosa.design(PRESSURE, STIFFNESS, pipeline=PIPELINE, nodes=64, progress=fail)

    def test_a_2d_design_without_time_for_verification_has_no_lowest_similarity(self):
        design = rugosa.design(PRESSURE, STIFFNESS, nodes=(20, 20), seconds=1e-3)
        self.assertIsNone(design.similarity_worst)
        self.assertIsNone(design.alternatives[0].similarity_refined)
        self.assertFalse(design.found)
        self.assertLess(design.similarity, 1)
        self.assertIn("not verified", repr(design))
        self.assertIn("not verified", design._repr_html_())
        self.assertEqual(len(design.curve), 20)

    def test_plot_shows_the_answer_for_every_quantity(self):
        names = "stiffness", "area", "area-displacement", "load", "interface_stiffness"
        targets = [rugosa.Target([1e-5, 1e-4], [0.1, 0.4], name) for name in names]
        pictures = rugosa.design(target=targets, nodes=64, pipeline="shape 2 | score | best 1").plot()
        self.assertEqual([(len(one.lines), bool(one.get_ylabel())) for one in pictures], [(2, True)] * 5)

    def test_interrupt_gives_the_best_so_far(self):
        begun = threading.Event()
        threading.Thread(target=lambda: (begun.wait(), os.kill(os.getpid(), signal.SIGINT))).start()
        endless = "shape 8 | score | repeat 1000000 { tournament 2 | mutate 0.2 | score | elite 2 } | best 1"
        design = rugosa.design(PRESSURE, STIFFNESS, pipeline=endless, nodes=64, progress=lambda *a: begun.set())
        self.assertTrue(design.interrupted)
        self.assertGreater(design.similarity, -1e3)
        self.assertRaises(KeyboardInterrupt, signal.raise_signal, signal.SIGINT)  # Python has its handler back

    def test_a_target_out_of_reach_is_reported(self):
        design = rugosa.design(PRESSURE, STIFFNESS[::-1], pipeline="shape 2 | score | best 1", nodes=64)
        self.assertTrue(design.out_of_reach)
        self.assertLess(design.bound, 1)
        self.assertFalse(design.found)
        self.assertIn("out of reach", design._repr_html_())

    def test_like_a_profile(self):
        design = rugosa.design(like=rugosa.Profile(rough_heights(), 0.004), pipeline="shape 4 | score | best 1",
                               nodes=64)
        self.assertEqual([t.quantity for t in design.targets], ["stiffness", "area"])
        found = rugosa.design(like=rough_heights(), spacing=0.004, nodes=64, evaluations=30, threads=1)
        self.assertIn("own", found.pipeline)  # the search that the program uses for a scan with contact area
        x = numpy.arange(24)
        relief = rugosa.Surface(0.001 * numpy.cos(0.3 * x[:, None] + 0.2 * x), 0.004)
        on_grid = rugosa.design(like=relief, nodes=(16, 20), pipeline="own 1 | score | best 1", quantity="stiffness")
        self.assertEqual(on_grid.profile.heights.shape, (20, 16))
        both = rugosa.design(PRESSURE, STIFFNESS, target_contact_fraction=numpy.linspace(0.05, 0.5, len(PRESSURE)),
                             pipeline="shape 2 | score | best 1", nodes=64)
        self.assertEqual([t.quantity for t in both.targets], ["stiffness", "area"])
        self.assertRaisesRegex(TypeError, "only one of them", rugosa.design, PRESSURE, PRESSURE, like=[1, 2], spacing=1)

    def test_mistakes(self):
        refused = self.assertRaisesRegex
        refused(rugosa.InputError, "same length", rugosa.design, PRESSURE, STIFFNESS[1:])
        refused(TypeError, "no target", rugosa.design)
        refused(rugosa.UsageError, "unknown stage 'scor'", rugosa.design, PRESSURE, STIFFNESS,
                pipeline="shape 2 | scor")
        self.assertRaises(rugosa.InputError, rugosa.Target, PRESSURE[::-1], STIFFNESS)
        refused(TypeError, "unknown keyword 'kernell'", rugosa.Target.like, rough_heights(), 0.004, kernell="free")


class Database(WithFolder):
    def test_answers_queries_as_the_program_does(self):
        file = self.folder / "g.db"
        law = {"series": 2, "ridges": 2, "hurst_from": 0.6, "gamma_to": 1.9, "shortest_wave": 0.1, "seed": 3}
        self.assertEqual(len(rugosa.Database.create(file, 60, nodes=64, steps=10, **law)), 60)
        flags = [f"--{key.replace('_', '-')}={value}" for key, value in law.items()]
        self.rugosa("database", "build", "g.db", "--genomes=60", "--nodes=64", "--steps=10", *flags)  # the same law
        target = rugosa.Target(PRESSURE, STIFFNESS)
        (self.folder / "T.csv").write_text(target.to_csv())
        out = self.rugosa("database", "query", "g.db", "--target", "T.csv", "--best", 3).stdout
        rows = [line.split() for line in out.splitlines()[2:]]
        found = rugosa.Database(file).query(target, 3)
        stiffer = rugosa.Target(target.x * 1000, target.y * 500)  # E 1000 times, all lengths twice
        other = rugosa.Database(file).query([stiffer], 3, nodes=64, steps=10, modulus=1000, length=2 * 0.84942)
        self.assertEqual([each.index for each in other], [each.index for each in found])
        self.assertTrue(all(abs(a.similarity / b.similarity - 1) < 1e-9 for a, b in zip(other, found)))
        self.assertEqual([f"{s.index} {s.similarity:.6f}" for s in found], [f"{r[1]} {r[2]}" for r in rows])

    def test_has_maps(self):
        maps = {"nodes": (20, 16), "length": (0.8, 0.64), "steps": 10}
        stored = rugosa.Database.create(self.folder / "m.db", 20, **maps)
        pressure, stiffness = rugosa.contact(stored.genome(7), **maps).secant_stiffness()
        target = rugosa.Target(pressure[1:9] * 0.01, stiffness[1:9])
        nearest = stored.query(target, 1, **maps)[0]
        self.assertEqual(nearest.index, 7)
        self.assertGreater(nearest.similarity, 0.9)

    def test_interrupt_keeps_what_is_stored(self):
        file = self.folder / "long.db"
        threading.Timer(1, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        self.assertRaises(KeyboardInterrupt, rugosa.Database.create, file, 10_000_000, nodes=256)
        self.assertLess(len(rugosa.Database(file)), 10_000_000)


if __name__ == "__main__":
    unittest.main()
