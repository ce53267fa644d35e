import gc
import json
import resource
import threading
import time
import unittest

import numpy
import rugosa

from common import WithFolder, rough_heights


class Contact(WithFolder):
    def scan(self, heights, spacing):
        file = self.folder / "scan.txt"
        numpy.savetxt(file, heights, fmt="%.17g")
        return file

    def test_gives_the_bits_of_the_program(self):
        heights, spacing = rough_heights(), 0.004
        self.scan(heights, spacing)
        for kernel in "free", "periodic", "strip":
            self.rugosa("contact", "--profile", "scan.txt", "--spacing", spacing, "--detrend", "none", "--kernel",
                        kernel, "--modulus", 70000, "--poisson", 0.3, "--steps", 30, "--out", "c.csv", "--force")
            csv = numpy.genfromtxt(self.folder / "c.csv", delimiter=",", names=True)
            curve = rugosa.contact(heights, spacing, kernel=kernel, modulus=70000, poisson=0.3, steps=30)
            for column, name in [("displacement_mm", "displacement"), ("pressure_MPa", "pressure"),
                                 ("contact_fraction", "contact_fraction"),
                                 ("tangent_stiffness_MPa_per_mm", "tangent_stiffness"),
                                 ("kkt_residual", "kkt_residual"),
                                 ("interface_stiffness_MPa_per_mm", "interface_stiffness")]:
                numpy.testing.assert_array_equal(getattr(curve, name), csv[column], f"{kernel} {name}")

    def test_answers_as_hertz(self):
        x = (numpy.arange(4097) - 2048) / 4096
        curve = rugosa.contact(-x**2 / 2, 1 / 4096, steps=10, datum=1)
        half_width = numpy.sqrt(4 * curve.pressure / numpy.pi)  # F = pi a^2/(4 R), R = 1, L = 1
        approach = half_width**2 / 2 * (numpy.log(2 / half_width) + 0.5)
        inside = half_width < 0.4
        numpy.testing.assert_allclose(curve.displacement[inside], approach[inside], rtol=2e-3)

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

    def test_gradient_agrees_with_differences(self):
        heights, spacing = rough_heights(64), 0.01
        whole = rugosa.contact(heights, spacing, steps=4, gradient=True)
        self.assertEqual(whole.pressure_gradient.shape, (4, 64))
        for node in 5, 30, 50:
            step = 1e-9
            ends = []
            for sign in -1, 1:
                moved = heights.copy()
                moved[node] += sign * step
                ends.append(rugosa.contact(moved, spacing, steps=4).pressure)
            numpy.testing.assert_allclose(whole.pressure_gradient[:, node], (ends[1] - ends[0]) / (2 * step),
                                          atol=1e-4 * abs(whole.pressure_gradient).max())

    def test_gradient_of_the_contact_fraction_agrees_with_differences(self):
        heights = rough_heights(64)
        whole = rugosa.contact(heights, 0.01, steps=4, area_gradient=True)
        smooth = whole.smooth_contact_fraction  # counted widths are too large by up to 1.5 nodes a spot
        self.assertTrue((smooth > 0).all() and (numpy.diff(smooth) > 0).all())
        self.assertLess(abs(smooth - whole.contact_fraction).max(), 0.15)
        for node in 5, 30, 50:
            ends = []
            for sign in -1, 1:
                moved = heights.copy()
                moved[node] += sign * 1e-9
                ends.append(rugosa.contact(moved, 0.01, steps=4, area_gradient=True).smooth_contact_fraction)
            numpy.testing.assert_allclose(whole.contact_fraction_gradient[:, node], (ends[1] - ends[0]) / 2e-9,
                                          atol=1e-3 * abs(whole.contact_fraction_gradient).max())

    def test_gradient_of_a_genome_is_in_its_genes(self):
        wave = {"A": 0.01, "H": 0.8, "gamma": 1.5, "lambda": 1.0,
                "chromosomes": [{"n": 1, "phases": [0.3]}, {"n": 3, "phases": [1.1]}]}
        genome = rugosa.Genome({"series": [wave]})
        options = {"nodes": 128, "length": 1.0, "steps": 3}
        whole = rugosa.contact(genome, gradient=True, **options)
        for gene in range(len(genome.genes)):
            ends = []
            for sign in -1, 1:
                genes = genome.genes.copy()
                genes[gene] += sign * 1e-7
                ends.append(rugosa.contact(genome.with_genes(genes), **options).pressure)
            numpy.testing.assert_allclose(whole.pressure_gradient[:, gene], (ends[1] - ends[0]) / 2e-7,
                                          atol=1e-4 * abs(whole.pressure_gradient).max())
        self.assertEqual(repr(genome), "<rugosa.Genome of 1 series, 2 chromosomes>")
        with self.assertRaisesRegex(TypeError, "unknown keyword 'step'"):
            rugosa.contact(genome, step=3)
        genes = genome.genes.copy()
        genes[2] = 0.5  # gamma, which is larger than 1
        with self.assertRaisesRegex(rugosa.InputError, "gamma"):
            genome.with_genes(genes)

    def test_an_area_gives_the_bits_of_the_program(self):
        heights = numpy.random.default_rng(3).normal(0, 1e-3, (12, 20))
        numpy.savetxt(self.folder / "map.txt", heights, fmt="%.17g")
        for kernel in "free", "periodic":
            self.rugosa("contact", "--surface", "map.txt", "--spacing", "0.01x0.02", "--detrend", "none", "--kernel", kernel, "--steps", 5,
                        "--out", "c.csv", "--force")
            csv = numpy.genfromtxt(self.folder / "c.csv", delimiter=",", names=True)
            read = rugosa.read(self.folder / "map.txt", spacing=(0.01, 0.02))
            numpy.testing.assert_array_equal(read.heights, heights)
            for given in (heights, (0.01, 0.02)), (read, None), (rugosa.Surface(heights, (0.01, 0.02)), None):
                curve = rugosa.contact(*given, kernel=kernel, steps=5)
                numpy.testing.assert_array_equal(curve.pressure, csv["pressure_MPa"], kernel)
                numpy.testing.assert_array_equal(curve.contact_fraction, csv["contact_fraction"], kernel)

    def test_a_map_has_the_areal_parameters_of_the_program(self):
        heights = numpy.random.default_rng(3).normal(0, 1e-3, (16, 20))
        numpy.savetxt(self.folder / "map.txt", heights, fmt="%.17g")
        self.rugosa("profile", "--surface", "map.txt", "--spacing", "10x20", "--unit", "um", "--out", "m")
        written = json.loads((self.folder / "m/surface.json").read_text())
        read = rugosa.read(self.folder / "map.txt", spacing=(10, 20), unit="um", detrend="line")
        self.assertEqual(read.roughness()["Sq"], written["Sq_mm"])
        self.assertEqual(read.roughness()["Str"], written["Str"])
        again = rugosa.read(self.folder / "m/surface.x3p", surface=True)
        numpy.testing.assert_allclose(again.heights, read.heights, rtol=1e-12, atol=1e-18)

    def test_gradient_on_an_area_agrees_with_differences(self):
        heights = numpy.random.default_rng(4).normal(0, 1e-3, (6, 9))
        whole = rugosa.contact(heights, 0.01, steps=3, gradient=True)
        for node in (1, 2), (4, 7):
            ends = []
            for sign in -1, 1:
                moved = heights.copy()
                moved[node] += sign * 1e-9
                ends.append(rugosa.contact(moved, 0.01, steps=3).pressure)
            gradient = whole.pressure_gradient.reshape(3, *heights.shape)[:, node[0], node[1]]
            numpy.testing.assert_allclose(gradient, (ends[1] - ends[0]) / 2e-9,
                                          atol=1e-4 * abs(whole.pressure_gradient).max())

    def test_a_genome_on_an_area_is_pressed_as_its_heights_are(self):
        wave = {"A": 0.01, "H": 0.8, "gamma": 1.5, "lambda": 1.0,
                "chromosomes": [{"n": 2, "phases": [0.3, 1.2, 2.0]}]}
        genome = rugosa.Genome({"series": [wave]})
        surface = genome.profile((24, 16), (1.0, 0.5))
        self.assertEqual(surface.heights.shape, (16, 24))
        whole = rugosa.contact(genome, nodes=(24, 16), length=(1.0, 0.5), steps=4)
        numpy.testing.assert_array_equal(whole.pressure, rugosa.contact(surface, steps=4).pressure)
        self.assertEqual(surface.row(3).heights.tolist(), surface.heights[3].tolist())

    def test_what_only_a_profile_has_is_refused_on_an_area(self):
        heights = numpy.random.default_rng(4).normal(0, 1e-3, (6, 9))
        for word in "datum", "strip_width", "accuracy":
            with self.assertRaisesRegex(rugosa.InputError, word):
                rugosa.contact(heights, 0.01, **{word: 0.5})
        with self.assertRaisesRegex(rugosa.InputError, "strip"):
            rugosa.contact(heights, 0.01, kernel="strip")
        with self.assertRaisesRegex(rugosa.InputError, "2 x 2 at least"):
            rugosa.contact(heights[:1], 0.01)
        with self.assertRaisesRegex(TypeError, "two spacings"):
            rugosa.contact(heights[0], (0.01, 0.01))
        with self.assertRaisesRegex(rugosa.InputError, "expected one"):
            rugosa.Profile(heights, 0.01)

    def test_filters_of_the_program_are_read_options(self):
        heights = rough_heights() + 1e-3 * (numpy.arange(256) == 99)
        self.scan(heights, 0.004)
        options = {"outliers": "remove", "lambda_s": 0.02, "lambda_c": 0.4}
        flags = [word for name, value in options.items() for word in (f"--{name.replace('_', '-')}", value)]
        self.rugosa("contact", "--profile", "scan.txt", "--spacing", 0.004, *flags, "--out", "c.csv")
        csv = numpy.genfromtxt(self.folder / "c.csv", delimiter=",", names=True)
        read = rugosa.read(self.folder / "scan.txt", spacing=0.004, **options)
        numpy.testing.assert_array_equal(rugosa.contact(read).pressure, csv["pressure_MPa"])
        with self.assertRaisesRegex(rugosa.InputError, "keep or remove"):
            rugosa.read(self.folder / "scan.txt", spacing=0.004, outliers="drop")

    def test_mistakes_are_python_exceptions_with_the_same_words(self):
        heights = rough_heights()
        with self.assertRaisesRegex(rugosa.InputError, "expected"):
            rugosa.contact(heights, 0.004, datum=0.01)
        with self.assertRaisesRegex(ValueError, "kernel"):
            rugosa.contact(heights, 0.004, kernel="fre")
        with self.assertRaisesRegex(TypeError, "unknown keyword 'step'"):
            rugosa.contact(heights, 0.004, step=3)
        with self.assertRaisesRegex(TypeError, "spacing"):
            rugosa.contact(heights)
        with self.assertRaisesRegex(rugosa.InputError, "dimensions"):
            rugosa.contact(heights.reshape(2, 2, -1), 0.004)
        with self.assertRaises(rugosa.InputError):
            rugosa.contact(numpy.full(10, numpy.nan), 0.004)
        with self.assertRaises(rugosa.InputError):
            rugosa.contact(heights, 0.004, poisson=2)
        with self.assertRaises(rugosa.InputError):
            rugosa.contact(heights, 0.004, steps=0)
        (self.folder / "bad.txt").write_text("1\n2\nx\n")
        with self.assertRaisesRegex(rugosa.InputError, "bad.txt, line 3"):
            rugosa.read(self.folder / "bad.txt", spacing=1)

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

    def test_threads_give_the_same_bits_as_one(self):
        alone = [rugosa.contact(rough_heights(seed=s), 0.004).pressure for s in range(8)]
        beside = [None] * 8

        def solve(s):
            beside[s] = rugosa.contact(rough_heights(seed=s), 0.004).pressure

        threads = [threading.Thread(target=solve, args=(s,)) for s in range(8)]
        [t.start() for t in threads]
        [t.join() for t in threads]
        for one, other in zip(alone, beside):
            numpy.testing.assert_array_equal(one, other)

    def test_memory_stays_bounded(self):
        heights = rough_heights(128)
        for _ in range(300):
            rugosa.contact(heights, 0.004, gradient=True)
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        for _ in range(3000):
            rugosa.contact(heights, 0.004, gradient=True)
        self.assertLess(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before, 8 << 10)  # kB; leaks: 60 MB

    def test_shows_itself(self):
        curve = rugosa.contact(rough_heights(), 0.004)
        self.assertIn("<svg", curve._repr_html_())
        self.assertIn("<svg", rugosa.Profile(rough_heights(), 0.004)._repr_html_())
        self.assertIn("data:image/png", rugosa.Surface(rough_heights().reshape(16, 16), 0.004)._repr_html_())


if __name__ == "__main__":
    unittest.main()
