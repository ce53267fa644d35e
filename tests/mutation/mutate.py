#!/usr/bin/env python3
"""Breaks the code in many places, one at a time, and asks which breaks the tests notice.

    tests/mutation/run [ga] [domain] [apps] [--count N] [--seed S] [--jobs J] [--out FILE]

All breaks are built at once (see sites.py), in a copy of the tree under .build-mutation, and chosen one after the other by
the environment variable RUGOSA_MUTANT. A break is caught when a test fails, crashes or takes far longer than it did.
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
import subprocess
import sys
import time

import sites

ROOT = pathlib.Path(__file__).resolve().parents[2]
WORK = ROOT / ".build-mutation"
TREE, BUILD = WORK / "tree", WORK / "build"

# Which test programs look at a folder, the quickest first; each skips what is slow and what no break could change.
PROGRAMS = {"ga": ["tests_ga"], "domain": ["tests_domain", "tests_apps"], "apps": ["tests_apps"]}
HOOK = """#pragma once
#include <cstdlib>
/// Whether this break is the one that is tried.
inline bool rugosa_mutant(int id) {
    static const char* const given = std::getenv("RUGOSA_MUTANT");
    static const int active = given ? std::atoi(given) : 0;
    return id == active;
}
"""


def tracked():
    return subprocess.run(["git", "ls-files"], cwd=ROOT, check=True, capture_output=True, text=True).stdout.split()


def sources(scopes):
    """Files to break: what is compiled of domain and apps, every header of ga. Words of pages are no logic."""
    for name in tracked():
        top = name.split("/")[0]
        if top in scopes and name.endswith(".hpp" if top == "ga" else ".cpp"):
            yield name


def drawn(scopes, count, seed):
    """`count` breaks, from every file in proportion to its places, at least one a file while they last."""
    choose = random.Random(seed)
    by_file = {}
    for name in sources(scopes):
        found = sites.sites((ROOT / name).read_text(), random.Random(f"{seed} {name}"))
        if found:
            by_file[name] = found
    everything = sum(len(found) for found in by_file.values())
    chosen = []
    for name, found in sorted(by_file.items()):
        share = min(len(found), max(1, round(count * len(found) / everything)))
        chosen += [(name, site) for site in choose.sample(found, share)]
    choose.shuffle(chosen)
    return {number: place for number, place in enumerate(chosen, 1)}


def write_tree(mutants):
    per_file = collections.defaultdict(list)
    for number, (name, site) in mutants.items():
        per_file[name].append((number, site))
    for name in tracked():
        target = TREE / name
        target.parent.mkdir(parents=True, exist_ok=True)
        text = (ROOT / name).read_bytes()
        if name in per_file:
            text = sites.broken(text.decode(), per_file[name]).encode()
        if not target.exists() or target.read_bytes() != text:
            target.write_bytes(text)
            shutil.copymode(ROOT / name, target)


def build(targets, mutants, jobs):
    """Builds; breaks that the compiler refuses are taken out until it is content."""
    (WORK / "mutant.hpp").write_text(HOOK)
    if not (BUILD / "CMakeCache.txt").exists():
        subprocess.run(["cmake", "-S", TREE, "-B", BUILD, "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG",
                        f"-DCMAKE_CXX_FLAGS=-include {WORK / 'mutant.hpp'} -w"], check=True, stdout=subprocess.DEVNULL)
    while True:
        done = subprocess.run(["cmake", "--build", BUILD, "--parallel", str(jobs), "--target", *targets, "--", "-k"] +
                              (["0"] if (BUILD / "build.ninja").exists() else []), capture_output=True, text=True)
        if done.returncode == 0:
            return mutants
        output = done.stdout + done.stderr
        bad_lines = {(match[1], int(match[2])) for match in re.finditer(re.escape(str(TREE)) + r"/([\w/.]+):(\d+):", output)}
        refused = set()
        for number, (name, site) in mutants.items():
            text = (ROOT / name).read_text()
            first, last = text.count("\n", 0, site[0]) + 1, text.count("\n", 0, site[1]) + 1
            if any((name, line) in bad_lines for line in range(first, last + 1)):
                refused.add(number)
        if not refused:
            sys.exit("tests/mutation: the build fails without a break at fault:\n" + output[-3000:])
        print(f"{len(refused)} breaks do not compile and are left out", file=sys.stderr)
        mutants = {number: place for number, place in mutants.items() if number not in refused}
        write_tree(mutants)


def run(program, spec, number, limit):
    """Name of the test that fails, or None when all pass."""
    environment = dict(os.environ, RUGOSA_MUTANT=str(number), OMP_NUM_THREADS="1")
    try:
        done = subprocess.run([BUILD / "tests" / program, "--abort", "-#", spec], env=environment, timeout=limit,
                              capture_output=True, text=True, errors="replace", cwd=WORK)
    except subprocess.TimeoutExpired:
        return "too long"
    if done.returncode == 0:
        return None
    names = re.search(r"-{79}\n(.+?)\n(?:  .*\n)*-{79}", done.stdout)
    return names[1] if names else f"ended with {done.returncode}"


def near_tests(name, program):
    """The tests of the mirrored folder, as Catch2 names them by file, or nothing."""
    folder = ROOT / "tests" / pathlib.Path(name).parent
    if program != "tests_" + name.split("/")[0]:
        return None
    files = sorted(folder.glob("*.cpp")) if folder.is_dir() else []
    return ",".join(f"[#{file.stem}]~[long]~[.]" for file in files) or None


def tried(number, name, limits):
    for program in PROGRAMS[name.split("/")[0]]:
        near = near_tests(name, program)
        for spec in ([near] if near else []) + ["~[long]~[.]"]:
            caught = run(program, spec, number, limits[program])
            if caught:
                return caught
    return None


def explained():
    """Reasons why a break changes nothing that could be noticed, by file and change: tests/mutation/equivalent."""
    reasons = {}
    for line in (pathlib.Path(__file__).parent / "equivalent").read_text().splitlines():
        if line and not line.startswith("#"):
            name, change, reason = line.split(" | ")
            reasons[name, change] = reason
    return reasons


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scopes", nargs="*", default=[], metavar="ga|domain|apps")
    parser.add_argument("--count", type=int, default=450, help="breaks to draw, over all scopes")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--out", type=pathlib.Path, default=WORK / "report.json")
    given = parser.parse_args()
    scopes = given.scopes or ["ga", "domain", "apps"]
    if unknown := set(scopes) - PROGRAMS.keys():
        sys.exit(f"tests/mutation: '{unknown.pop()}' given, expected ga, domain or apps")

    mutants = drawn(scopes, given.count, given.seed)
    write_tree(mutants)
    targets = sorted({program for scope in scopes for program in PROGRAMS[scope]})
    mutants = build(targets, mutants, given.jobs)
    limits = {}
    for program in targets:
        start = time.monotonic()
        if failed := run(program, "~[long]~[.]", 0, 3600):
            sys.exit(f"tests/mutation: without any break '{failed}' fails")
        limits[program] = 30 + 4 * given.jobs * (time.monotonic() - start)

    results, reasons = [], explained()
    with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
        waiting = {pool.submit(tried, number, name, limits): number for number, (name, _) in mutants.items()}
        for done in concurrent.futures.as_completed(waiting):
            number = waiting[done]
            name, (start, _, _, change) = mutants[number]
            line = (ROOT / name).read_text().count("\n", 0, start) + 1
            reason = None if done.result() else reasons.get((name, change))
            results.append({"file": name, "line": line, "change": change, "caught_by": done.result(), "equivalent": reason})
            print(f"{len(results)} of {len(mutants)}: {name}:{line}: {change[:90]}: {done.result() or reason or 'SURVIVED'}",
                  flush=True)
    results.sort(key=lambda result: (result["file"], result["line"]))
    given.out.write_text(json.dumps(results, indent=1))
    for scope in scopes:
        mine = [result for result in results if result["file"].startswith(scope + "/")]
        caught = sum(result["caught_by"] is not None for result in mine)
        same = sum(result["equivalent"] is not None for result in mine)
        print(f"{scope}: {caught} of {len(mine)} caught, {same} equivalent ({100 * (caught + same) / max(1, len(mine)):.1f} %)")


main()
