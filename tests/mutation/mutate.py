#!/usr/bin/env python3
"""Changes the code in many places, one at a time, and reports which changes (mutants) the tests notice.

    tests/mutation/run [ga] [domain] [apps] [--count N] [--seed S] ...

All mutants are built at once (sites.py), in a copy of the tree. The environment variable RUGOSA_MUTANT chooses one. Each
test first runs without a mutant, which measures its time and the mutants that it reaches. A mutant is then tried on these
tests until one fails: those of the mirrored folder, of the same library, and of libraries above it, the quick ones first.
A mutant is caught if a test fails, crashes or takes far longer than before.
"""

import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading

import sites

ROOT = pathlib.Path(__file__).resolve().parents[2]
WORK = ROOT / ".build-mutation"
HOOK = '#include "tests/mutation/mutant.hpp"\n#line 1\n'
# The test programs of each folder in the order of trying, without [long] and hidden tests. The tests of the Python module
# are files.
PYTHON = "rugosa_python"
PROGRAMS = {"ga": ["tests_ga", "tests_domain", "tests_fuzz", "tests_apps"], "domain": ["tests_domain", "tests_fuzz", "tests_apps"],
            "apps": ["tests_apps", PYTHON]}
SPEC = "~[long]~[.]"
REMARK = re.compile(r"\bprogress\.|\.reserve\(")  # terminal output and reserved memory
MEMORY = 6 << 30  # maximum bytes of a test


def tracked():
    return subprocess.run(["git", "ls-files"], cwd=ROOT, check=True, capture_output=True, text=True).stdout.split()


def sources(scopes, chosen):
    """Files to change: the source files of domain and apps, and every header of ga."""
    for name in tracked():
        top = name.split("/")[0]
        if top in scopes and name.endswith(".hpp" if top == "ga" else ".cpp") and re.search(chosen, name):
            yield name


def equivalents():
    """Mutants known to have no effect: {(file, change): reason}, from lines `file | change | reason`."""
    known = {}
    for line in (ROOT / "tests/mutation/equivalent.txt").read_text().splitlines():
        if line and not line.startswith("#"):
            name, change, reason = (part.strip() for part in line.split(" | "))
            known[name, change] = reason
    return known


def drawn(scopes, count, seed, files=""):
    """`count` mutants, from every file in proportion to its places, and at least one per file."""
    choose = random.Random(seed)
    by_file = {}
    for name in sources(scopes, files):
        found = sites.sites((ROOT / name).read_text(), random.Random(f"{seed} {name}"))
        if found:
            by_file[name] = found
    everything = sum(len(found) for found in by_file.values())
    chosen = []
    for name, found in sorted(by_file.items()):
        share = min(len(found), max(1, round(count * len(found) / everything)))
        chosen += [(name, site) for site in choose.sample(found, share)]
    choose.shuffle(chosen)
    return {number: (name, site) for number, (name, site) in enumerate(chosen, 1) if not REMARK.search(site[3])}


def write_tree(tree, mutants):
    per_file = collections.defaultdict(list)
    for number, (name, site) in mutants.items():
        per_file[name].append((number, site))
    names = set(tracked())
    for old in tree.rglob("*"):
        if old.is_file() and str(old.relative_to(tree)) not in names:
            old.unlink()
    for name in names:
        target = tree / name
        target.parent.mkdir(parents=True, exist_ok=True)
        text = (ROOT / name).read_bytes()
        if name in per_file:
            text = (HOOK + sites.broken(text.decode(), per_file[name])).encode()
        if not target.exists() or target.read_bytes() != text:
            target.write_bytes(text)
            shutil.copymode(ROOT / name, target)


def build(tree, folder, targets, mutants, jobs):
    """Builds. Mutants that do not compile are removed, and remembered for the next run."""
    memory = folder / "refused.json"
    refused_before = {tuple(one) for one in json.loads(memory.read_text())} if memory.exists() else set()
    mutants = {number: (name, site) for number, (name, site) in mutants.items() if (name, site[3]) not in refused_before}
    write_tree(tree, mutants)
    if not (folder / "CMakeCache.txt").exists():
        subprocess.run(["cmake", "-S", tree, "-B", folder, "-DCMAKE_CXX_FLAGS_RELEASE=-O1", "-DCMAKE_CXX_FLAGS=-w",
                        f"-DPython_EXECUTABLE={sys.executable}"],
                       check=True, stdout=subprocess.DEVNULL)
    while True:
        done = subprocess.run(["cmake", "--build", folder, "--parallel", str(jobs), "--target", *targets, "--", "-k"] +
                              (["0"] if (folder / "build.ninja").exists() else []), capture_output=True, text=True)
        if done.returncode == 0:
            return mutants
        output = done.stdout + done.stderr
        bad_lines = {(match[1], int(match[2]))
                     for match in re.finditer(r"^(?:" + re.escape(str(tree)) + r"/|\.\./)([\w/.]+):(\d+):\d+: error", output, re.M)}
        refused = set()
        for number, (name, site) in mutants.items():
            text = (ROOT / name).read_text()
            first, last = text.count("\n", 0, site[0]) + 1, text.count("\n", 0, site[1]) + 1
            if any((name, line) in bad_lines for line in range(first, last + 1)):
                refused.add(number)
        if not refused:
            sys.exit("tests/mutation: the build fails, and not because of a mutant:\n" + output[-3000:])
        print(f"{len(refused)} mutants do not compile and are left out", file=sys.stderr)
        refused_before |= {(mutants[number][0], mutants[number][1][3]) for number in refused}
        memory.write_text(json.dumps(sorted(refused_before)))
        mutants = {number: place for number, place in mutants.items() if number not in refused}
        write_tree(tree, mutants)


class Test:
    """A test case, or a file of Python tests: its build, program, name and source file, and its measured processor time
    and reached mutants."""

    def __init__(self, folder, program, name, file):
        self.folder, self.program, self.name, self.file = folder, program, name, file
        self.seconds, self.reached = 0.0, set()

    def command(self):
        if self.program == PYTHON:
            return [sys.executable, self.file]
        return [self.folder / "tests" / self.program, re.sub(r"([\\,\[])", r"\\\1", self.name)]

    def run(self, number, limit, reached=os.devnull):
        """(why it fails or None, processor seconds), for one mutant."""
        environment = dict(os.environ, RUGOSA_MUTANT=str(number), RUGOSA_MUTANTS_REACHED=reached, OMP_NUM_THREADS="1",
                           PYTHONPATH=str(self.folder / "python"), PYTHONDONTWRITEBYTECODE="1",
                           RUGOSA=str(self.folder / "rugosa"), RUGOSA_SOURCE=str(ROOT))
        with tempfile.TemporaryDirectory() as folder:
            process = subprocess.Popen(["prlimit", f"--cpu={int(limit) + 1}", f"--as={MEMORY}", *self.command()],
                                       env=environment, cwd=folder, start_new_session=True, stdin=subprocess.DEVNULL,
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            stuck = threading.Timer(60 + 20 * limit, lambda: os.killpg(process.pid, signal.SIGKILL))
            stuck.start()  # a mutant may also wait for ever
            _, status, usage = os.wait4(process.pid, 0)
            stuck.cancel()
        code = os.waitstatus_to_exitcode(status)
        why = None if code == 0 else "too long" if code in (-signal.SIGXCPU, -signal.SIGKILL) else f"code {code}"
        return why, usage.ru_utime + usage.ru_stime


def measured(folder, program, jobs, chosen, limit):
    """All tests of a program within the time limit, each run without a mutant. Repeated only after a new build."""
    path = next((folder / "python/rugosa").glob("_rugosa*.so")) if program == PYTHON else folder / "tests" / program
    tests, memory, built = [], folder / f"{program}.measured.json", path.stat().st_mtime_ns
    kept = json.loads(memory.read_text()) if memory.exists() else {}
    if kept.get("built") == built and kept["chosen"] == chosen:
        for name, file, seconds, reached in kept["tests"]:
            tests.append(Test(folder, program, name, pathlib.Path(file)))
            tests[-1].seconds, tests[-1].reached = seconds, set(reached)
        return tests
    if program == PYTHON:
        tests = [Test(folder, program, file.stem, file) for file in sorted((ROOT / "tests/apps/python").glob("*_test.py"))
                 if re.search(chosen, file.stem)]
    for file in sorted((ROOT / "tests" / program.removeprefix("tests_")).rglob("*.cpp")):
        listed = subprocess.run([path, "-#", "--list-test-names-only", f"[#{file.stem}]{SPEC}"], capture_output=True, text=True)
        tests += [Test(folder, program, name, file) for name in listed.stdout.splitlines() if name and re.search(chosen, file.stem)]

    def measure(test):
        with tempfile.NamedTemporaryFile("r") as log:
            why, test.seconds = test.run(-1, limit, log.name)
            test.reached = {int(line) for line in log}
        if why:
            print(f"'{test.name}' fails without a mutant ({why}); it is left out", file=sys.stderr, flush=True)
        return None if why else test

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        tests = [test for test in pool.map(measure, tests) if test]
    memory.write_text(json.dumps({"built": built, "chosen": chosen, "tests": [
        [test.name, str(test.file), test.seconds, sorted(test.reached)] for test in tests]}))
    return tests


def tried(number, name, tests, limit):
    """The test that catches a mutant, or None, and the number of tests tried."""
    folder = ROOT / "tests" / pathlib.Path(name).parent
    candidates = sorted((test for test in tests if number in test.reached),
                        key=lambda test: (test.file.parent != folder, PROGRAMS[name.split("/")[0]].index(test.program), test.seconds))
    spent, runs = 0.0, 0
    for test in candidates:
        if spent + test.seconds > limit:
            continue
        why, seconds = test.run(number, 5 + 5 * test.seconds)
        spent, runs = spent + seconds, runs + 1
        if why:
            return f"{test.name} ({why})", runs
    return None, runs


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scopes", nargs="*", default=[], metavar="ga|domain|apps")
    parser.add_argument("--count", type=int, default=450, help="number of mutants to draw")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--limit", type=float, default=60, help="maximum processor seconds of tests per mutant (60)")
    parser.add_argument("--out", type=pathlib.Path, default=WORK / "report.json")
    parser.add_argument("--again", type=pathlib.Path, metavar="REPORT", help="try only the survivors there, with the same draw")
    parser.add_argument("--files", default="", metavar="REGEX", help="change only files whose name matches")
    parser.add_argument("--tests", default="", metavar="REGEX", help="only tests of source files whose name matches")
    given = parser.parse_args()
    scopes = given.scopes or ["ga", "domain", "apps"]
    if unknown := set(scopes) - PROGRAMS.keys():
        sys.exit(f"tests/mutation: '{unknown.pop()}' is unknown; give ga, domain or apps")

    mutants = drawn(scopes, given.count, given.seed, given.files)
    targets = sorted({program for scope in scopes for program in PROGRAMS[scope]})
    mutants = build(WORK / "tree", WORK / "build", targets, mutants, given.jobs)
    known = equivalents()
    same = [number for number, (name, site) in mutants.items() if (name, site[3]) in known]
    for name, site in sorted(mutants.pop(number) for number in same):
        print(f"not tried, has no effect: {name}: {site[3]}: {known[name, site[3]]}")
    os.nice(max(0, 10 - os.nice(0)))
    before = json.loads(given.again.read_text()) if given.again else []
    survived = {(result["file"], result["change"]) for result in before if not result["caught_by"]}
    waiting = {number: place for number, place in mutants.items() if not before or (place[0], place[1][3]) in survived}
    tests = {program: measured(WORK / "build", program, given.jobs, given.tests, given.limit) for program in targets}
    for program, them in tests.items():
        print(f"{program}: {len(them)} tests, {sum(test.seconds for test in them):.0f} s", flush=True)

    results = [result for result in before if result["caught_by"] and (result["file"], result["change"]) not in known]

    def one(number):
        name, site = waiting[number]
        caught, runs = tried(number, name, sum((tests[p] for p in PROGRAMS[name.split("/")[0]]), []), given.limit)
        results.append({"file": name, "line": (ROOT / name).read_text().count("\n", 0, site[0]) + 1, "change": site[3], "caught_by": caught, "tests": runs})
        print(f"{len(results)} of {len(mutants)}: {name}:{results[-1]['line']}: {site[3][:120]}: "
              f"{caught or f'SURVIVED {runs} tests'}", flush=True)
        given.out.write_text(json.dumps(sorted(results, key=lambda one: (one["file"], one["line"])), indent=1))

    with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
        list(pool.map(one, sorted(waiting)))  # in random order, so that an interrupted run is a smaller draw
    for scope in scopes:
        mine = [result for result in results if result["file"].startswith(scope + "/")]
        caught = sum(result["caught_by"] is not None for result in mine)
        print(f"{scope}: {caught} of {len(mine)} caught ({100 * caught / max(1, len(mine)):.1f} %)")


main()
