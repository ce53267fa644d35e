import gc
import json
import resource
import threading
import time
import unittest

import numpy
import rugosa

from common import WithFolder, rough_heights


def genome_of(*chromosomes):
    return rugosa.Genome({"series": [{"A": 0.01, "H": 0.8, "gamma": 1.5, "lambda": 1.0, "chromosomes": chromosomes}]})


class Contact(WithFolder):
    def test_gives_the_bits_of_the_program(self):
        spacing = 0.004
        self.save(rough_heights())
        heights = rugosa.read(self.folder / "scan.txt", spacing=spacing).heights  # prepared as by the program
        for kernel in "free", "periodic", "strip":
            csv = self.curve("--profile", "scan.txt", "--spacing", spacing, "--kernel", kernel, "--modulus", 70000,
                             "--poisson", 0.3, "--steps", 30)
            curve = rugosa.contact(heights, spacing, kernel=kernel, modulus=70000, poisson=0.3, steps=30,
                                   resolution="on")
            self.assertEqual(len(csv.dtype.names), 10)
            for column in csv.dtype.names:
                name = column.removesuffix("_MPa_per_mm").removesuffix("_MPa").removesuffix("_mm")
                numpy.testing.assert_array_equal(getattr(curve, name), csv[column], f"{kernel} {name}")

    def test_a_material_is_its_constants_and_no_band_comes_unless_requested(self):
        heights = rough_heights()
        steel = rugosa.contact(heights, 0.004, material="steel")
        numbers = rugosa.contact(heights, 0.004, modulus=210000, poisson=0.3)
        numpy.testing.assert_array_equal(steel.pressure, numbers.pressure)
        self.assertEqual(steel.contact_fraction_low.size, 0)
        self.assertRaises(rugosa.InputError, rugosa.contact, heights, 0.004, material="stel")

    def test_arrays_are_views_that_outlive_the_curve(self):
        curve = rugosa.contact(rough_heights(), 0.004)
        pressure = curve.pressure
        self.assertTrue(numpy.shares_memory(pressure, curve.pressure))
        self.assertFalse(pressure.flags.writeable)
        kept = pressure.copy()
        del curve
        gc.collect()
        [rugosa.contact(rough_heights(seed=s), 0.004) for s in range(20)]
        numpy.testing.assert_array_equal(pressure, kept)

    def check_gradient(self, given, moved, gradient, value, columns, step):
        """Columns of a gradient against central differences of `value` after moving each by `step`."""
        for column in columns:
            ends = [value(moved(given, column, sign * step)) for sign in (-1, 1)]
            numpy.testing.assert_allclose(gradient[:, column], (ends[1] - ends[0]) / (2 * step),
                                          atol=1e-3 * abs(gradient).max())

    def test_gradients_agree_with_differences(self):
        def raised(heights, node, by):
            moved = heights.copy()
            moved.flat[node] += by
            return moved

        line, area = rough_heights(64), numpy.random.default_rng(4).normal(0, 1e-3, (6, 9))
        for heights, nodes in (line, (5, 30, 50)), (area, (11, 43)):
            pressed = rugosa.contact(heights, 0.01, steps=4, gradient=True)
            self.check_gradient(heights, raised, pressed.pressure_gradient,
                                lambda h: rugosa.contact(h, 0.01, steps=4).pressure, nodes, 1e-9)
        pressed = rugosa.contact(line, 0.01, steps=4, area_gradient=True)
        self.check_gradient(line, raised, pressed.contact_fraction_gradient,
                            lambda h: rugosa.contact(h, 0.01, steps=4, area_gradient=True).smooth_contact_fraction,
                            (5, 30, 50), 1e-9)

    def test_gradient_of_a_genome_is_in_its_genes(self):
        genome = genome_of({"n": 1, "phases": [0.3]}, {"n": 3, "phases": [1.1]})
        options = {"nodes": 128, "length": 1.0, "steps": 3}

        def changed(given, gene, by):
            genes = given.genes.copy()
            genes[gene] += by
            return given.with_genes(genes)

        self.check_gradient(genome, changed, rugosa.contact(genome, gradient=True, **options).pressure_gradient,
                            lambda g: rugosa.contact(g, **options).pressure, range(len(genome.genes)), 1e-7)
        self.assertRaisesRegex(rugosa.InputError, "gamma", changed, genome, 2, -1)  # which is larger than 1

    def test_a_map_gives_the_bits_of_the_program(self):
        heights = numpy.random.default_rng(3).normal(0, 1e-3, (12, 20))
        self.save(heights, "map.txt")
        for kernel in "free", "periodic":
            csv = self.curve("--surface", "map.txt", "--spacing", "0.01x0.02", "--kernel", kernel, "--steps", 5)
            read = rugosa.read(self.folder / "map.txt", spacing=(0.01, 0.02))  # prepared as by the program
            as_given = rugosa.read(self.folder / "map.txt", spacing=(0.01, 0.02), detrend="none")
            numpy.testing.assert_array_equal(as_given.heights, heights)
            flat = read.heights
            for given in (flat, (0.01, 0.02)), (read, None), (rugosa.Surface(flat, (0.01, 0.02)), None):
                curve = rugosa.contact(*given, kernel=kernel, steps=5)
                numpy.testing.assert_array_equal(curve.pressure, csv["pressure_MPa"], kernel)
                numpy.testing.assert_array_equal(curve.contact_fraction, csv["contact_fraction"], kernel)

    def test_a_map_has_the_areal_parameters_of_the_program(self):
        heights = numpy.random.default_rng(3).normal(0, 1e-3, (16, 20))
        self.save(heights, "map.txt")
        self.rugosa("profile", "--surface", "map.txt", "--spacing", "10x20", "--unit", "um", "--out", "m")
        written = json.loads((self.folder / "m/surface.json").read_text())
        read = rugosa.read(self.folder / "map.txt", spacing=(10, 20), unit="um")
        self.assertEqual(read.roughness()["Sq"], written["Sq_mm"])
        self.assertEqual(read.roughness()["Str"], written["Str"])
        again = rugosa.read(self.folder / "m/surface.x3p", surface=True)
        numpy.testing.assert_allclose(again.heights, read.heights, rtol=1e-12, atol=1e-18)

    def test_a_genome_on_a_2d_grid_has_the_curve_of_its_heights(self):
        genome = genome_of({"n": 2, "phases": [0.3, 1.2, 2.0]})
        surface = genome.profile((24, 16), (1.0, 0.5))
        self.assertEqual(surface.heights.shape, (16, 24))
        whole = rugosa.contact(genome, nodes=(24, 16), length=(1.0, 0.5), steps=4)
        numpy.testing.assert_array_equal(whole.pressure, rugosa.contact(surface, steps=4).pressure)
        self.assertEqual(surface.row(3).heights.tolist(), surface.heights[3].tolist())

    def test_filters_of_the_program_are_read_options(self):
        heights = rough_heights() + 1e-3 * (numpy.arange(256) == 99)
        self.save(heights)
        options = {"outliers": "remove", "lambda_s": 0.02, "lambda_c": 0.4}
        flags = [word for name, value in options.items() for word in (f"--{name.replace('_', '-')}", value)]
        csv = self.curve("--profile", "scan.txt", "--spacing", 0.004, *flags)
        read = rugosa.read(self.folder / "scan.txt", spacing=0.004, **options)
        numpy.testing.assert_array_equal(rugosa.contact(read).pressure, csv["pressure_MPa"])

    def test_every_keyword_is_its_flag_on_a_line_and_a_map(self):
        self.save(rough_heights(64))
        gaps = numpy.random.default_rng(3).normal(0, 1e-3, (12, 20))
        self.save(gaps, "map.txt")
        gaps[4, 7] = numpy.nan
        self.save(gaps, "gaps.txt")
        layered = dict(kernel="periodic", layer="0.05:10:0.3")
        models = [{}, dict(kernel="periodic"), dict(modulus=70000), dict(modulus=2, poisson=0.4), dict(material="steel"),
                  dict(steps=7), dict(reach=0.4), dict(tolerance=1e-4), dict(solver="nested"),
                  layered, dict(layered, base="rigid"), dict(to_pressure=1e-3), dict(pressures="1e-4,1e-3"),
                  dict(hardness=0.02), dict(accuracy=0.01), dict(resolution="on", steps=3), dict(threads=1)]
        of_lines = [dict(datum=3), dict(kernel="strip", strip_width=0.02)]
        scans = [dict(unit="um"), dict(detrend="mean"), dict(lambda_s=0.03), dict(lambda_c=0.15)]
        spiked = numpy.random.default_rng(4).normal(0, 1e-3, (24, 20))
        spiked[9:11, 7] += 0.05
        self.save(spiked, "spiked.txt")
        of_maps = [dict(surface="gaps.txt", fill=True), dict(surface="gaps.txt", fill=True, max_filled=0.1),
                   dict(surface="spiked.txt", outliers="remove")]
        read_here = {"unit", "detrend", "lambda_s", "lambda_c", "outliers", "row", "fill", "max_filled"}
        tried = set()

        def compare(kind, file, spacing, options):
            options = dict(options)
            file = options.pop("surface", file)
            flags = [f"--{name.replace('_', '-')}" + ("" if value is True else f"={value}")
                     for name, value in options.items()]
            csv = self.curve(f"--{kind}", file, "--spacing", str(spacing).strip("()").replace(", ", "x"), *flags)
            of_file = {name: value for name, value in options.items() if name in read_here}
            read = rugosa.read(self.folder / file, spacing=spacing, **of_file)
            curve = rugosa.contact(read, **{name: value for name, value in options.items() if name not in of_file})
            numpy.testing.assert_array_equal(curve.pressure, csv["pressure_MPa"], f"{kind} {options}")
            numpy.testing.assert_array_equal(curve.contact_fraction, csv["contact_fraction"], f"{kind} {options}")
            tried.update(options)

        for options in models + of_lines + scans + [dict(outliers="remove")]:
            compare("profile", "scan.txt", 0.004, options)
        compare("profile", "map.txt", 0.004, dict(row=3))
        for options in models + scans + of_maps:
            compare("surface", "map.txt", (0.01, 0.02), options)
        flags = {word[2:].replace("-", "_") for word in self.rugosa("contact", "--help").stdout.split()
                 if word.startswith("--") and word[2:].replace("-", "").isalpha()}
        others = {"genome", "profile", "surface", "out", "report", "force", "spacing", "nodes", "length", "help", "friction",
                  "quiet", "verbose", "seed"}
        self.assertEqual(flags - others - tried, set())

    def test_one_pressure_and_a_list_of_layers_are_taken(self):
        line = rough_heights(64)
        one = rugosa.contact(line, 0.01, pressures=[1e-3])
        self.assertEqual(one.pressure.shape, (1,))
        given = dict(kernel="periodic", base="rigid", pressures=[1e-3, 2e-3])
        text = rugosa.contact(line, 0.01, layer="0.1:2:0.3", **given)
        listed = rugosa.contact(line, 0.01, layer=[(0.1, 2, 0.3)], **given)
        numpy.testing.assert_array_equal(text.displacement, listed.displacement)
        rugosa.contact(line, 0.01, layer=["0.1:2:0.3", (0.2, 1, 0.4)], **given)

    def test_a_map_is_solved_within_an_accuracy(self):
        heights = numpy.random.default_rng(3).normal(0, 1e-3, (12, 20))
        exact = rugosa.contact(heights, 0.01)
        within = rugosa.contact(heights, 0.01, accuracy=0.05)
        numpy.testing.assert_allclose(within.pressure[-1], exact.pressure[-1], rtol=0.05)
        self.assertNotEqual(within.account, "")

    def test_mistakes_raise_exceptions(self):
        heights = rough_heights()
        refused = self.assertRaisesRegex
        refused(rugosa.InputError, "datum", rugosa.contact, heights, 0.004, datum=0.01)
        refused(ValueError, "kernel", rugosa.contact, heights, 0.004, kernel="fre")
        refused(TypeError, "unknown keyword 'step'", rugosa.contact, heights, 0.004, step=3)
        refused(TypeError, "spacing", rugosa.contact, heights)
        refused(rugosa.InputError, "dimensions", rugosa.contact, heights.reshape(2, 2, -1), 0.004)
        genome = genome_of({"n": 1, "phases": [0.3]})
        for bad in "x", [[1, 2], [3]], [1j, 2], {}, numpy.array([1j, 2]), numpy.array(["1", "2"]):
            for call in (lambda a: rugosa.contact(a, 1), lambda a: rugosa.Profile(a, 1), lambda a: rugosa.Surface(a, 1),
                         lambda a: rugosa.Target(a, [1, 2]), lambda a: rugosa.Target.like(a, 1),
                         lambda a: rugosa.design(a, [1, 2]), lambda a: rugosa.design(like=a, spacing=1),
                         lambda a: rugosa.design([1, 2], target_contact_fraction=a), genome.with_genes,
                         lambda a: rugosa.optimise(lambda x: a, lower=[0], upper=[1]),
                         lambda a: rugosa.optimise(lambda x: 1.0, lower=a, upper=[1])):
                refused(rugosa.InputError, r"^[^\n]*; give real numbers, in rows of one length$", call, bad)
        refused(rugosa.InputError, "evaluate returned None", rugosa.optimise, lambda x: None, lower=[0], upper=[1])
        (self.folder / "bad.txt").write_text("1\n2\nx\n")
        refused(rugosa.InputError, "bad.txt, line 3", rugosa.read, self.folder / "bad.txt", spacing=1)

    def test_other_threads_run_while_it_solves(self):
        ticks, done = [], threading.Event()

        def tick():
            while not done.is_set():
                ticks.append(time.monotonic())
                time.sleep(1e-3)

        thread = threading.Thread(target=tick)
        thread.start()
        begin = time.monotonic()
        rugosa.contact(rough_heights(4096), 0.001, steps=40, solver="nested")
        end = time.monotonic()
        done.set()
        thread.join()
        self.assertTrue(any(begin < t < end for t in ticks))

    def test_memory_stays_bounded(self):
        heights = rough_heights(128)
        for _ in range(300):
            rugosa.contact(heights, 0.004, gradient=True)
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        for _ in range(3000):
            rugosa.contact(heights, 0.004, gradient=True)
        self.assertLess(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before, 8 << 10)  # kB; leaks: 60 MB

    def test_objects_have_pictures(self):
        curve = rugosa.contact(rough_heights(), 0.004)
        self.assertIn("<svg", curve._repr_html_())
        self.assertIn("<svg", rugosa.Profile(rough_heights(), 0.004)._repr_html_())
        self.assertIn("data:image/png", rugosa.Surface(rough_heights().reshape(16, 16), 0.004)._repr_html_())


if __name__ == "__main__":
    unittest.main()
