"""Finds which of the paper's claims hold under which reading of its text, by the paper's experiment with other keys.

`rugosa run readings.ini` runs this script with one argument, the settings as JSON. The script writes result.json,
cells.csv, claims.csv, shares.csv, readings.json and targets/ to the folder. It does not need the module rugosa.
"""
import bisect
import concurrent.futures
import csv
import itertools
import json
import math
import pathlib
import shutil
import statistics
import subprocess
import sys
import time

BEGAN = time.monotonic()
GIVEN = json.loads(sys.argv[1])
SETTINGS, FOLDER = GIVEN["settings"], pathlib.Path(GIVEN["folder"])
CHECKPOINTS, FLAT = FOLDER / "checkpoints", FOLDER / "targets" / "flat.csv"  # the target while the database is built
PRESSURE, QUICK = float(SETTINGS["readings.max-pressure"]), SETTINGS["readings.quick"] == "on"
DATABASES = min(int(SETTINGS["readings.databases"]), 2 if QUICK else 1000)
LENGTH = float(SETTINGS["model.length"] or 0.84942)
# The choices that the text leaves open: keys of paper.ini for each value. The first value is ours.
AXES = {
    "Body": {"free d = L": {}, "free d = 4 L": {"model.datum": 4 * LENGTH}, "strip": {"model.kernel": "strip"},
             "periodic": {"model.kernel": "periodic"}},
    "Algorithm 1 compares": {"K at equal pressures": {}, "K by load step": {"paper.dominance": "step"},
                             "raw tangents": {"paper.dominance": "raw"}},
    "Dominant above": {"0.95": {}, "0.90": {"paper.dominant-above": 0.9}, "0.99": {"paper.dominant-above": 0.99}},
    "CCO reduces": {"parents": {}, "children": {"paper.cco-reduces": "children"}},
    "Phases move within": {"a tenth of the value": {}, "a tenth of 2π": {"paper.phase-of": "turn"}},
    "Sobol's first point": {"skipped": {}, "kept": {"database.first-point": "kept"}},
    "p̄ over p_max": {"0.5": {}, "0.31": {"paper.threshold": 0.31}, "0.405": {"paper.threshold": 0.405},
                     "0.595": {"paper.threshold": 0.595}, "0.69": {"paper.threshold": 0.69}},
}
OURS = (0,) * len(AXES)
TARGETS = ["median", "lower quartile", "upper quartile", "held-out"]
CLAIMS = [one for one in GIVEN["claims"] if one["id"] != "minute"]  # except the claim on the time
SIGNS = {"reproduced": "1", "contradicted": "0", "undecidable": ""}
DESCRIBED = json.dumps([SETTINGS, GIVEN["seed"], GIVEN["origin"]["version"]])


def opened(kept, is_valid):
    """The values of a part, which may have been altered since it was saved."""
    try:
        values = json.loads(kept.read_text() if kept.stat().st_size < 2e7 else "")
        if is_valid(values):
            return values
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError):
        pass
    sys.exit(f"--resume: checkpoints/{kept.name} was altered; remove it, or start again with --force")


def choices_in(reading):
    """The value of each choice in a reading."""
    return {choice: list(values)[v] for v, (choice, values) in zip(reading, AXES.items())}


def part(name, reading, keys, read, is_valid):
    """Runs the paper's experiment under a reading; `read` takes the values from its folder. Saved for --resume."""
    kept, folder = CHECKPOINTS / f"{name}.json", CHECKPOINTS / name
    if not kept.exists():
        model = {key: value for key, value in SETTINGS.items() if key.startswith("model.") and value}
        choices = {key: one for axis, value in choices_in(reading).items() for key, one in AXES[axis][value].items()}
        keys = {"experiment.kind": "paper", "experiment.seed": GIVEN["seed"], **model,
                "paper.max-pressure": PRESSURE, "paper.sweep-points": 5, **choices, **keys}
        folder.mkdir(exist_ok=True)
        (folder / "paper.ini").write_text("".join("[{}]\n{} = {}\n".format(*key.split(".", 1), value)
                                                  for key, value in sorted(keys.items())))
        done = subprocess.run([GIVEN["program"], "run", "paper.ini", "--pictures", "off", "--threads", "1", "--force",
                               "--out", "out"], cwd=folder, capture_output=True, text=True)
        if done.returncode:
            sys.exit(done.stderr.strip())
        whole = folder / "found.json"
        whole.write_text(json.dumps(read(folder / "out")))
        whole.rename(kept)
        shutil.rmtree(folder)
    return opened(kept, is_valid)


def curves_in(folder):
    """K(p) of each genome of the database, as pairs (p, K)."""
    curves = {}
    with open(folder / "database.csv", newline="") as file:
        for row in csv.DictReader(file):
            curves.setdefault(row["id"], []).append((float(row["pressure_MPa"]), float(row["stiffness_MPa_per_mm"])))
    return list(curves.values())


def are_curves(curves):
    """Whether these are the curves of 54 pairs and 5 columns of phases."""
    return len(curves) == 54 * 5 and all(len(curve) > 1 for curve in curves) and all(
        type(x) is float and math.isfinite(x) for curve in curves for p, k in curve for x in (p, k))


def interpolated(curve, p):
    """The curve at p, linear between the points and along the last segments beyond the ends."""
    right = min(max(bisect.bisect(curve, [p]), 1), len(curve) - 1)
    (a, y), (b, z) = curve[right - 1:right + 1]
    return y + (z - y) * (p - a) / (b - a)


def make_targets(body):
    """Smoothed quartiles of the database's curves on a body, and the curve of a genome outside it; their files."""
    curves = part(f"curves-{body}", (body, *OURS[1:]),
                  {"database.pairs": 54, "paper.sweep-points": 0, "target.file": FLAT}, curves_in, are_curves)
    pressures = [PRESSURE * (0.025 + 0.05 * k) for k in range(20)]
    at_pressures = [[interpolated(curve, p) for curve in curves[:100]] for p in pressures]
    lower, median, upper = map(list, zip(*(statistics.quantiles(k, method="inclusive") for k in at_pressures)))
    for k in (lower, median, upper) * 3:
        k[1:-1] = [0.25 * (a + c) + 0.5 * b for a, b, c in zip(k, k[1:], k[2:])]
    to_last = [PRESSURE * (k + 1) / 20 for k in range(20)]
    held_out = [interpolated(curves[53 * 5 + 3], p) for p in to_last]
    files = []
    for name, x, y in zip(TARGETS, (*[pressures] * 3, to_last), (median, lower, upper, held_out)):
        files.append(FOLDER / "targets" / f"{list(AXES['Body'])[body]} {name}.csv".replace(" ", "-"))
        write_csv(files[-1], [{"pressure_MPa": p, "stiffness_MPa_per_mm": k} for p, k in zip(x, y)])
    return files


def verdicts_in(folder):
    """The verdict on each claim and target; the name of a target is empty if there is one number for all."""
    claims = {one["id"]: one for one in json.loads((folder / "result.json").read_text())["claims"]}
    return [{number["on"]: number["verdict"] for number in claims[one["id"]]["numbers"]} for one in CLAIMS]


def are_verdicts(verdicts):
    return len(verdicts) == len(CLAIMS) and all(
        set(one) in ({""}, {"drawn", "held-out"}) and set(one.values()) <= set(SIGNS) for one in verdicts)


def plan():
    """The tasks: reading, database and targets. With quick, and for the pressures p̄, one choice at a time."""
    everything = list(itertools.product(*(range(len(values)) for values in AXES.values())))
    near = [one for one in everything if sum(map(bool, one)) <= 1]
    crossed = near if QUICK else [one for one in everything if one in near or not one[-1]]
    tried = [(one, 0) for one in crossed] + [(OURS, database + 1) for database in range(DATABASES)]
    return [(*one, first) for one in tried for first in (0, 2)]


def cells_of(reading, database, first, files):
    """The cells of two targets: a sign per claim (1 holds, 0 does not, empty: undecidable)."""
    keys = {"database.phases": database, "target.file": files[first], "heldout.file": files[first + 1]}
    verdicts = part("-".join(map(str, (*reading, database, first))), reading, keys, verdicts_in, are_verdicts)
    return [{"reading": reading, "database": database, "target": TARGETS[first + which],
             "holds": [SIGNS[one.get(name, one.get(""))] for one in verdicts]}
            for which, name in enumerate(("drawn", "held-out"))]


def mean(values):
    values = list(values)
    return sum(values) / len(values) if values else None


def percent(share, digits):
    return f"{100 * share:.{max(0, digits - len(str(int(100 * share))))}f} %" if share else "0 %"


def write_csv(name, rows):
    with open(FOLDER / name, "w", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def widest(shares):
    """The choice that decides most of a claim, if it moves the share by 0.05: the values with most and fewest."""
    choice, values = max(shares.items(), key=lambda one: max(one[1].values()) - min(one[1].values()))
    high, low = max(values, key=values.get), min(values, key=values.get)
    found = [choice, high, values[high], low, values[low]] if values[high] - values[low] >= 0.05 else [None] * 5
    return dict(zip(("choice", "highest", "highest_share", "lowest", "lowest_share"), found))


def main():
    kept = CHECKPOINTS / "settings.json"
    if not GIVEN["resume"]:
        shutil.rmtree(CHECKPOINTS, ignore_errors=True)
    elif kept.exists() and kept.read_text() != DESCRIBED:
        sys.exit(f"--resume: checkpoints/{kept.name} is of other settings; give those of the interrupted run")
    CHECKPOINTS.mkdir(exist_ok=True)
    (FOLDER / "targets").mkdir(exist_ok=True)
    kept.write_text(DESCRIBED)
    write_csv(FLAT, [{"pressure_MPa": p, "stiffness_MPa_per_mm": 1} for p in (PRESSURE / 2, PRESSURE)])
    with concurrent.futures.ThreadPoolExecutor(GIVEN["threads"]) as pool:
        files = list(pool.map(make_targets, range(len(AXES["Body"]))))
        FLAT.unlink()
        cells = [cell for pair in pool.map(lambda task: cells_of(*task, files[task[0][0]]), plan()) for cell in pair]
    sobol = [cell for cell in cells if cell["database"] == 0]

    def share(claim, among, sign="1"):
        return mean(cell["holds"][claim] == sign for cell in among)

    readings = {one: [cell for cell in sobol if cell["reading"] == one] for one, database, _ in plan() if database == 0}
    held = {one: mean(cell["holds"].count("1") for cell in among) for one, among in readings.items()}
    ranked = sorted(held, key=lambda one: (-held[one], sum(map(bool, one))))
    rows, shares, words = [], [], {}
    for c, claim in enumerate(CLAIMS):
        known = {"claim": c + 1, "place": claim["place"], "says": claim["says"]}
        by_choice = {axis: {value: share(c, [cell for cell in sobol if cell["reading"][a] == v])
                            for v, value in enumerate(values)} for a, (axis, values) in enumerate(AXES.items())}
        rows += [{**known, "choice": axis, "value": value, "share_holds": holds}
                 for axis, values in by_choice.items() for value, holds in values.items()]
        row = {**known, "ours": share(c, readings[OURS]), "best": share(c, readings[ranked[0]]),
               "every": share(c, sobol), "other_phases": share(c, [cell for cell in cells if cell["database"]]),
               **widest(by_choice)}
        shares.append(row)
        unknown = share(c, sobol, "")
        words[claim["id"]] = (f"holds in {percent(row['every'], 3)}"
                              + (f", is undecidable in {percent(unknown, 3)}" if unknown else "")
                              + f" of {len(ranked)} readings on {len(TARGETS)} targets"
                              + (f"; depends most on {row['choice']}: {row['highest']} "
                                 f"{percent(row['highest_share'], 2)}, {row['lowest']} "
                                 f"{percent(row['lowest_share'], 2)}" if row["choice"] else ""))
    write_csv("cells.csv", [{**choices_in(cell["reading"]), "database": cell["database"], "target": cell["target"],
                             **{f"claim_{c + 1}": sign for c, sign in enumerate(cell["holds"])}} for cell in cells])
    write_csv("claims.csv", rows)
    write_csv("shares.csv", shares)

    never, always = ([{key: row[key] for key in ("claim", "place", "says")} for row in shares if row["every"] == every]
                     for every in (0, 1))
    deciding = [row["choice"] for row in shares if 0 < row["every"] < 1]
    drawn = [row["other_phases"] for row in shares if row["other_phases"] is not None]
    best = held[ranked[0]]
    result = {**GIVEN["origin"], "seconds": time.monotonic() - BEGAN, "database_count": DATABASES,
              "claim_count": len(CLAIMS), "target_count": len(TARGETS), "reading_count": len(ranked),
              "ours_hold": held[OURS], "best_hold": best, "worst_hold": held[ranked[-1]],
              "near_best": sum(hold >= best - 0.25 for hold in held.values()),
              "never": never, "always": always, "depend": len(deciding),
              "deciding": [{"choice": axis, "claims": deciding.count(axis)} for axis in AXES if axis in deciding],
              "firm": sum(min(holds, 1 - holds) <= 0.05 for holds in drawn),
              "readings": [{"claims_hold": held[one], **choices_in(one),
                            "differs": [{"choice": axis, "value": value}
                                        for v, (axis, value) in zip(one, choices_in(one).items()) if v]}
                           for one in ranked], "summary": f"most claims hold at once: {best:.3g}"}
    origin = {key: result[key] for key in ("command", "version")}
    (FOLDER / "readings.json").write_text(json.dumps({**origin, "claims": words}, indent=1, ensure_ascii=False) + "\n")
    (FOLDER / "result.json").write_text(json.dumps(result, indent=1) + "\n")


main()
