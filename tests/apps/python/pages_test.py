"""The examples of docstrings, the README and the notebooks are run as they stand."""

import doctest
import json
import os
import pathlib
import unittest

os.environ.setdefault("MPLBACKEND", "Agg")

import rugosa

HERE = pathlib.Path(os.environ["RUGOSA_SOURCE"]) / "apps/python"


class Pages(unittest.TestCase):
    def run_doctests(self, text, name):
        test = doctest.DocTestParser().get_doctest(text or "", {}, name, name, 0)
        runner = doctest.DocTestRunner()
        runner.run(test)
        self.assertEqual(runner.failures, 0, name)
        return runner.tries

    def test_docstrings(self):
        tries = self.run_doctests(rugosa.__doc__, "rugosa")
        for name in rugosa.__all__:
            self.assertTrue(getattr(rugosa, name).__doc__, f"{name} has no docstring")
            tries += self.run_doctests(getattr(rugosa, name).__doc__, name)
        self.assertGreater(tries, 12)

    def test_readme(self):
        self.assertGreater(self.run_doctests((HERE / "README.md").read_text(), "README.md"), 5)

    def test_stubs_name_everything(self):
        stubs = (HERE / "rugosa/__init__.pyi").read_text()
        for name in rugosa.__all__:
            self.assertRegex(stubs, rf"(class|def) {name}\b")
            thing = getattr(rugosa, name)
            if isinstance(thing, type) and not issubclass(thing, Exception):
                for member in vars(thing):
                    if not member.startswith("_"):
                        self.assertRegex(stubs, rf"def {member}\b|{member}:", f"{name}.{member}")

    def test_notebooks(self):
        notebooks = sorted((HERE / "notebooks").glob("*.ipynb"))
        self.assertEqual(len(notebooks), 3)
        for notebook in notebooks:
            with self.subTest(notebook.name):
                names = {"display": lambda *_: None}
                here = os.getcwd()
                os.chdir(notebook.parent)
                try:
                    for cell in json.loads(notebook.read_text())["cells"]:
                        if cell["cell_type"] == "code":
                            exec(compile("".join(cell["source"]), notebook.name, "exec"), names)
                finally:
                    os.chdir(here)


if __name__ == "__main__":
    unittest.main()
