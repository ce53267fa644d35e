import csv
import json
import math
import sys
import threading
import unittest

import numpy
import rugosa

from common import WithFolder

CHILD = """
import json, sys
for line in sys.stdin:
    asked = json.loads(line)
    print(json.dumps({"id": asked["id"], "objectives": [sum(g * g for g in asked["genes"])]}), flush=True)
"""


def sphere(genes):
    return sum(g * g for g in genes.tolist())


def weighted_sum(genes):
    if genes[0] == 1:
        raise ValueError("mesh failed")
    return int(sum(i * g for i, g in enumerate(genes)))


class Engine(WithFolder):
    def test_gives_the_bits_of_the_program(self):
        (self.folder / "f.py").write_text(CHILD)
        self.rugosa("optimise", "--genes", "real:3:-5:5", "--evaluate", f"{sys.executable} f.py", "--minimise",
                    "--evaluations", 600, "--seed", 4, "--out", "o")
        result = json.loads((self.folder / "o/result.json").read_text())
        found = rugosa.optimise(sphere, lower=[-5] * 3, upper=[5] * 3, minimise=True, evaluations=600, seed=4)
        self.assertEqual(found.best.tolist(), result["best"]["genes"])
        self.assertEqual(found.objectives, result["best"]["objectives"])

    def test_batches_give_the_same_bits(self):
        class Batch:
            calls = 0

            def evaluate_batch(self, genes):
                Batch.calls += 1
                return [sphere(row) for row in genes]

        options = {"lower": [-5] * 4, "upper": [5] * 4, "minimise": True, "evaluations": 400}
        one, many = rugosa.optimise(sphere, **options), rugosa.optimise(Batch(), **options)
        numpy.testing.assert_array_equal(one.best, many.best)
        self.assertLess(Batch.calls, 100)

    def test_ask_and_tell_gives_the_bits_of_optimise(self):
        for options in ({"lower": [-5] * 3, "upper": [5] * 3, "variant": "bipop-cma-es"},
                        {"bits": 12}, {"permutation": 7}):
            called = rugosa.optimise(sphere, minimise=True, evaluations=500, seed=3, **options)
            search = rugosa.search(minimise=True, evaluations=500, seed=3, **options)
            batches = 0
            while len(genes := search.ask()):
                self.assertEqual(search.ask().tolist(), genes.tolist())  # still open
                search.tell([sphere(row) for row in genes])
                batches += 1
            found = search.result()
            self.assertGreater(batches, 1)
            self.assertEqual(found.best.tolist(), called.best.tolist())
            self.assertEqual(found.evaluations, called.evaluations)

    def test_a_history_has_every_evaluation(self):
        options = {"permutation": 6, "minimise": True, "evaluations": 200}
        file, other = self.folder / "h.csv", self.folder / "other.csv"
        found = rugosa.optimise(weighted_sum, history=file, **options)
        rows = list(csv.DictReader(file.open()))
        self.assertEqual([int(row["id"]) for row in rows], list(range(1, found.evaluations + 1)))
        for row in rows:
            genes = [int(row[f"x{i}"]) for i in range(1, 7)]
            self.assertEqual(row["failure"], "ValueError: mesh failed" if genes[0] == 1 else "")
            self.assertEqual(row["f1"], "" if genes[0] == 1 else str(sum(i * g for i, g in enumerate(genes))))
        search = rugosa.search(history=other, **options)
        while len(genes := search.ask()):
            search.tell([ValueError("mesh failed") if row[0] == 1 else weighted_sum(row) for row in genes])
        search.result()
        self.assertEqual(other.read_text().replace("mesh", "ValueError: mesh"), file.read_text())
        with self.assertRaisesRegex(rugosa.InputError, "h.csv exists"):
            rugosa.optimise(weighted_sum, history=file, **options)

    def test_a_search_may_be_left_before_its_end(self):
        seen = []

        class Stay:
            name = "stay"

            def __call__(self, genes, fitness, random):
                return numpy.arange(len(fitness))

        for rounds in range(3):
            search = rugosa.search(lower=[0] * 2, upper=[1] * 2, operators=[Stay()], observers=[seen.append],
                                   pipeline="sample 5 | score | repeat 50 { stay | mutate 0.5 | score } | best 1")
            for _ in range(rounds):
                search.tell(search.ask().sum(axis=1))
            if rounds == 2:
                self.assertEqual(search.result().evaluations, 10)
                self.assertEqual(len(search.ask()), 0)
            else:
                search.ask()
                self.assertRaisesRegex(rugosa.InputError, "answers given", search.tell, [1.0])
            del search
        self.assertTrue(seen)

    def test_an_observers_exception_ends_a_search(self):
        def broken(_):
            raise KeyError("mine")

        search = rugosa.search(lower=[0], upper=[1], observers=[broken])
        with self.assertRaisesRegex(KeyError, "mine"):
            while len(genes := search.ask()):
                search.tell(genes[:, 0])

    def test_each_gene_has_its_bounds(self):
        seen = []

        def remember(genes):
            seen.append(genes.copy())
            return 0.0

        rugosa.optimise(remember, lower=[0, 10], upper=[1, 20], evaluations=200)
        seen = numpy.array(seen)
        self.assertTrue((seen >= [0, 10]).all() and (seen <= [1, 20]).all())
        self.assertGreater(seen[:, 1].std(), 1)

    def test_several_objectives_and_violations(self):
        def two(x):
            return (x[0], (1 - x[0]) ** 2), max(0.0, 0.25 - x[0])

        found = rugosa.optimise(two, lower=[0], upper=[1], objectives=2, minimise=True, evaluations=1500)
        first = [objectives[0] for _, objectives in found.front]
        self.assertGreater(len(first), 20)
        self.assertGreaterEqual(min(first), 0.25)
        self.assertEqual(first, sorted(first))

    def test_gradients_refine(self):
        class Bowl:
            def evaluate(self, x):
                return -float((x - 1) @ (x - 1))

            def gradient(self, x):
                return -2 * (x - 1)

        search = {"lower": [-5] * 6, "upper": [5] * 6,
                  "pipeline": "sample 3 | score | best 1 | refine nlopt LD_LBFGS 40 | best 1"}
        self.assertLess(abs(rugosa.optimise(Bowl(), **search).best - 1).max(), 1e-6)
        with self.assertRaisesRegex(ValueError, "needs the problem's gradient"):
            rugosa.optimise(lambda x: self.fail("evaluated"), **search)

    def test_operators_written_in_python(self):
        class Halve:
            name = "halve"

            def __call__(self, genes, fitness, random):
                assert genes.shape == (len(fitness), 2)
                return genes / 2 + random.normal(0, 1e-9, genes.shape)

        class Best:
            name = "two-best"

            def __call__(self, genes, fitness, random):
                return numpy.argsort(fitness)[:2]

        def run():
            return rugosa.optimise(sphere, lower=[1, 1], upper=[5, 5], minimise=True, operators=[Halve(), Best()],
                                   pipeline="sample 8 | score | two-best | repeat 20 { halve | score } | best 1")

        found = run()
        self.assertLess(found.objectives[0], 1e-8)
        self.assertEqual(found.population.shape, (1, 2))
        numpy.testing.assert_array_equal(found.best, run().best)

    def test_operators_return_genomes(self):
        class Returns:
            name = "returns"

            def __init__(self, row):
                self.row = row

            def __call__(self, genes, fitness, random):
                return numpy.array([self.row] * len(genes))

        pipeline = "sample 4 | score | returns | score | repeat 3 { cross order | score } | best 1"
        for row in ([0, 1, 2, 2], [0, 1, 2, 4], [0, 1, 2, -1], [0, 1, 2, 2**32 + 3]):
            with self.assertRaisesRegex(rugosa.InputError, "row 1 is not a genome"):
                rugosa.optimise(lambda tour: 1.0, permutation=4, operators=[Returns(row)], pipeline=pipeline)
        with self.assertRaisesRegex(rugosa.InputError, "row 1 is not a genome"):
            rugosa.optimise(sphere, lower=[0], upper=[1], operators=[Returns([math.nan])],
                            pipeline="sample 4 | returns | score | best 1")

    def test_a_search_may_be_asked_from_several_threads(self):
        search = rugosa.search(lower=[0] * 2, upper=[1] * 2, evaluations=500)

        def work():
            try:
                while len(genes := search.ask()):
                    search.tell(genes.sum(axis=1))
            except rugosa.InputError:  # another thread has answered
                pass

        threads = [threading.Thread(target=work) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertLessEqual(search.result().evaluations, 500)

    def test_observers_see_every_stage(self):
        told = []
        rugosa.optimise(sphere, lower=[0] * 2, upper=[1] * 2, minimise=True, observers=[told.append],
                        pipeline="sample 10 | score | repeat 3 { tournament 2 | mutate 0.5 | score } | best 1")
        scores = [t for t in told if "score" in t["path"]]
        self.assertEqual(len(scores), 4)
        self.assertEqual(scores[-1]["genes"].shape, (10, 2))
        self.assertEqual(scores[-1]["fitness"][0], sphere(scores[-1]["genes"][0]))

    def test_levels_have_prices(self):
        seen = {"coarse": 0, "fine": 0}

        class TwoModels:
            def evaluate(self, genes, level):
                seen[level] += 1
                return sphere(genes) + (0.1 * genes[0] if level == "fine" else 0)

        class Batches:
            def evaluate_batch(self, genes, level):
                return [TwoModels().evaluate(row, level) for row in genes]

        words = dict(lower=[-5] * 3, upper=[5] * 3, minimise=True, levels="coarse:1,fine:18", seed=4,
                     pipeline="sample 30 | score | best 4 | score f1-fine | refine nlopt LN_BOBYQA 180 | best 1")
        found = rugosa.optimise(TwoModels(), **words)
        self.assertEqual(found.price, seen["coarse"] + 18 * seen["fine"])
        self.assertEqual(found.evaluations, seen["coarse"] + seen["fine"])
        self.assertGreater(seen["fine"], 4)
        self.assertEqual(found.level, "fine")
        self.assertAlmostEqual(found.objectives[0], sphere(found.best) + 0.1 * found.best[0], 12)
        self.assertEqual(rugosa.optimise(Batches(), **words).best.tolist(), found.best.tolist())
        search = rugosa.search(**words)
        while len(genes := search.ask()):
            search.tell([TwoModels().evaluate(*one) for one in zip(genes, search.levels)])
        self.assertEqual(search.result().best.tolist(), found.best.tolist())
        for most in 30, 47, 48, 100:  # the price never exceeds the budget
            seen.update(coarse=0, fine=0)
            rugosa.optimise(TwoModels(), evaluations=most, **words)
            self.assertLessEqual(seen["coarse"] + 18 * seen["fine"], most)
        (self.folder / "f.py").write_text("""
import json, sys
for line in sys.stdin:
    asked = json.loads(line)
    x = asked["genes"]
    print(json.dumps({"id": asked["id"], "objectives": [sum(g * g for g in x) + (0.1 * x[0] if asked["level"] == "fine" else 0)]}), flush=True)
""")
        self.rugosa("optimise", "--genes", "real:3:-5:5", "--evaluate", f"{sys.executable} f.py", "--minimise",
                    "--seed", 4, "--levels", words["levels"], "--pipeline", words["pipeline"], "--out", "o")
        result = json.loads((self.folder / "o/result.json").read_text())
        self.assertEqual(result["best"]["genes"], found.best.tolist())
        self.assertEqual((result["price"], result["level"]), (found.price, "fine"))
        for levels, part in (("coarse", "malformed"), ("coarse:2", "price"), ("a:1,a:2", "different"),
                             ("a:1,b:-1", "price"), ("a:1,b:nan", "finite")):
            with self.assertRaisesRegex(rugosa.InputError, part):
                rugosa.optimise(TwoModels(), **(words | dict(levels=levels)))
        with self.assertRaisesRegex(rugosa.InputError, "pipeline"):
            rugosa.optimise(TwoModels(), lower=[0], upper=[1], levels="coarse:1,fine:2")

    def test_failures_of_evaluations(self):
        class Batch:
            def evaluate_batch(self, genes):
                return [None if row[0] > 4 else sphere(row) for row in genes]

        def fails(how):
            return lambda x: how() if x[0] > 4 else sphere(x)

        def raises():
            raise ValueError("mesh failed")

        options = {"lower": [-5] * 2, "upper": [5] * 2, "minimise": True, "evaluations": 600}
        for problem in (fails(raises), fails(lambda: None), fails(lambda: math.nan), Batch()):
            found = rugosa.optimise(problem, **options)
            self.assertLess(found.objectives[0], 1)
            self.assertGreater(found.failures, 0)
            self.assertGreater(found.evaluations, 400)
        few = rugosa.optimise(lambda x: sphere(x) if x[0] < -4 else raises(), max_failures=0.5, **options)
        self.assertIn("evaluations failed; the first: ValueError: mesh failed", few.stopped)
        self.assertIsNotNone(few.best)
        search = rugosa.search(**options)
        while len(genes := search.ask()):
            search.tell([ValueError("odd") if row[0] > 4 else sphere(row) for row in genes])
        self.assertGreater(search.result().failures, 0)
        self.assertRaises(KeyboardInterrupt, rugosa.optimise, fails(lambda: (_ for _ in ()).throw(KeyboardInterrupt)), **options)
        self.assertRaisesRegex(ValueError, "mesh failed", rugosa.optimise, lambda x: raises(), **options)
        self.assertRaisesRegex(rugosa.InputError, "the first: evaluate returned None", rugosa.optimise, lambda x: None,
                               **options)
        self.assertRaisesRegex(rugosa.InputError, "evaluate returned: no array of numbers", rugosa.optimise,
                               lambda x: "3.5", **options)

    def test_mistakes(self):
        def broken(_):
            raise KeyError("mine")

        def refused(error, words, function, lower=0, upper=1, **options):
            self.assertRaisesRegex(error, words, rugosa.optimise, function, lower=[lower], upper=[upper], **options)

        refused(KeyError, "mine", broken)
        refused(rugosa.InputError, "objectives returned", lambda x: [1.0, 2.0])
        refused(rugosa.UsageError, "unknown stage", sphere, pipeline="sampel 3")
        refused(rugosa.InputError, "one of lower and upper", sphere, bits=3)
        refused(rugosa.InputError, "no lower", sphere, lower=1, upper=0)
        refused(rugosa.InputError, "start, row 2, gene 1: 7 is out of range", sphere, start=[[0], [7]])


if __name__ == "__main__":
    unittest.main()
