"""Finds which of the paper's claims hold under which reading of its text, by the paper's experiment with other keys.

`rugosa run readings.ini` runs this script with one argument, the settings as JSON. The script writes result.json,
cells.csv, claims.csv, shares.csv, readings.json and targets/ to the folder. It does not need the module rugosa.
"""
import bisect
import concurrent.futures
import csv
import hashlib
import itertools
import json
import math
import pathlib
import shutil
import subprocess
import sys
import time

BEGAN = time.monotonic()
GIVEN = json.loads(sys.argv[1])
SETTINGS, FOLDER = GIVEN["settings"], pathlib.Path(GIVEN["folder"])
CHECKPOINTS = FOLDER / "checkpoints"
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


def sealed(name, text):
    """The text of a part with a checksum that also depends on its name and the settings."""
    return hashlib.sha256(f"{DESCRIBED}\n{name}\n{text}".encode()).hexdigest() + "\n" + text


def opened(kept, is_valid):
    """The values of a part. A changed file can be sealed again, so the values are checked, too."""
    try:
        whole = kept.read_text() if kept.stat().st_size < 2e7 else ""
        values = json.loads(whole[65:])
        good = whole == sealed(kept.stem, whole[65:]) and is_valid(values)
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError):
        good = False
    if not good:
        sys.exit(f"--resume: checkpoints/{kept.name} was altered; remove it, or start again with --force")
    return values


def part(name, keys, targets, read, is_valid):
    """Runs the paper's experiment with these keys; `read` takes the values from its folder. Saved for --resume."""
    kept, folder = CHECKPOINTS / f"{name}.json", CHECKPOINTS / name
    if not kept.exists():
        model = {key: value for key, value in SETTINGS.items() if key.startswith("model.") and value}
        keys = {"experiment.kind": "paper", "experiment.seed": GIVEN["seed"], **model,
                "paper.max-pressure": PRESSURE, "paper.sweep-points": 5, **keys, **targets}
        folder.mkdir(exist_ok=True)
        (folder / "paper.ini").write_text("".join("[{}]\n{} = {}\n".format(*key.split(".", 1), value)
                                                  for key, value in sorted(keys.items())))
        done = subprocess.run([GIVEN["program"], "run", "paper.ini", "--pictures", "off", "--threads", "1", "--force",
                               "--out", "out"], cwd=folder, capture_output=True, text=True)
        if done.returncode:
            sys.exit(done.stderr.strip())
        whole = folder / "found.json"
        whole.write_text(sealed(name, json.dumps(read(folder / "out"))))
        whole.rename(kept)
        shutil.rmtree(folder)
    return opened(kept, is_valid)


def all_of(work, items):
    """`work` for each item, in their order."""
    with concurrent.futures.ThreadPoolExecutor(GIVEN["threads"]) as pool:
        return list(pool.map(lambda item: work(*item), items))


def keys_of(reading):
    return {key: value for index, axis in zip(reading, AXES.values())
            for key, value in list(axis.values())[index].items()}


def curves_in(folder):
    """K(p) of each genome of the database, as pairs (p, K)."""
    curves = {}
    with open(folder / "database.csv", newline="") as file:
        for row in csv.DictReader(file):
            curves.setdefault(row["id"], []).append((float(row["pressure_MPa"]), float(row["stiffness_MPa_per_mm"])))
    return list(curves.values())


def are_curves(curves):
    """Whether these are the curves of 54 pairs and 5 columns of phases."""
    return len(curves) == 54 * 5 and all(
        len(curve) > 1 and all(len(point) == 2 and all(type(x) is float and math.isfinite(x) for x in point)
                               for point in curve) for curve in curves)


def interpolated(curve, p):
    """The curve at p, linear between the points and along the last segments beyond the ends."""
    right = min(max(bisect.bisect(curve, [p]), 1), len(curve) - 1)
    (a, y), (b, z) = curve[right - 1:right + 1]
    return y + (z - y) * (p - a) / (b - a)


def quantile(values, share):
    values, place = sorted(values), share * (len(values) - 1)
    low = int(place)
    return values[low] + (place - low) * (values[min(low + 1, len(values) - 1)] - values[low])


def make_targets(body):
    """Smoothed quantiles of the database's curves on a body, and the curve of a genome outside it; their files."""
    label = list(AXES["Body"])[body]
    flat = FOLDER / "targets" / "flat.csv"
    flat.write_text(f"pressure_MPa,stiffness_MPa_per_mm\n{PRESSURE / 2},1\n{PRESSURE},1\n")
    curves = part(f"curves-{body}", {**keys_of((body, *OURS[1:])), "database.pairs": 54, "paper.sweep-points": 0},
                  {"target.file": flat}, curves_in, are_curves)
    files = []
    for name, share in zip(TARGETS, (0.5, 0.25, 0.75, None)):
        if share is None:
            x = [PRESSURE * (k + 1) / 20 for k in range(20)]
            y = [interpolated(curves[53 * 5 + 3], p) for p in x]
        else:
            x = [PRESSURE * (0.025 + 0.05 * k) for k in range(20)]
            y = [quantile([interpolated(curve, p) for curve in curves[:100]], share) for p in x]
            for _ in range(3):
                y[1:-1] = [0.25 * (a + c) + 0.5 * b for a, b, c in zip(y, y[1:], y[2:])]
        files.append(FOLDER / "targets" / f"{label} {name}.csv".replace(" ", "-"))
        files[-1].write_text("pressure_MPa,stiffness_MPa_per_mm\n" + "".join(f"{a!r},{b!r}\n" for a, b in zip(x, y)))
    return files


def verdicts_in(folder):
    """The verdict on each claim and target; the name of a target is empty if there is one number for all."""
    claims = {one["id"]: one for one in json.loads((folder / "result.json").read_text())["claims"]}
    return [{number["on"]: number["verdict"] for number in claims[one["id"]]["numbers"]} for one in CLAIMS]


def are_verdicts(verdicts):
    return len(verdicts) == len(CLAIMS) and all(
        set(one) in ({""}, {"drawn", "held-out"}) and all(verdict in SIGNS for verdict in one.values())
        for one in verdicts)


def plan():
    """Pairs of a reading and a database. With quick, and for the pressures p̄, one choice at a time."""
    everything = list(itertools.product(*(range(len(values)) for values in AXES.values())))
    near = [one for one in everything if sum(map(bool, one)) <= 1]
    crossed = near if QUICK else [one for one in everything if one in near or not one[-1]]
    return [(one, 0) for one in crossed] + [(OURS, database + 1) for database in range(DATABASES)]


def tried(reading, database, files):
    """The cells of a reading: on each target a sign per claim (1 holds, 0 does not, empty: undecidable)."""
    cells = []
    for half in (0, 2):
        targets = {"target.file": files[half], "heldout.file": files[half + 1]}
        verdicts = part("-".join(map(str, (*reading, database, half))),
                        {**keys_of(reading), "database.phases": database}, targets, verdicts_in, are_verdicts)
        for which, name in enumerate(("drawn", "held-out")):
            cells.append({"reading": reading, "database": database, "target": TARGETS[half + which],
                          "holds": [SIGNS[one.get(name, one.get(""))] for one in verdicts]})
    return cells


def mean(values):
    values = list(values)
    return sum(values) / len(values) if values else None


def percent(share, digits):
    return f"{100 * share:.{max(0, digits - len(str(int(100 * share))))}f} %" if share else "0 %"


def write_csv(name, header, rows):
    with open(FOLDER / name, "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([header, *rows])


def widest(shares):
    """The choice that decides most of a claim, if it moves the share by 0.05: the values with most and fewest."""
    choice, values = max(shares.items(), key=lambda one: max(one[1].values()) - min(one[1].values()))
    high, low = max(values, key=values.get), min(values, key=values.get)
    return [choice, high, values[high], low, values[low]] if values[high] - values[low] >= 0.05 else [None] * 5


def main():
    kept = CHECKPOINTS / "settings.json"
    if not GIVEN["resume"]:
        shutil.rmtree(CHECKPOINTS, ignore_errors=True)
    elif kept.exists() and kept.read_text() != DESCRIBED:
        sys.exit(f"--resume: checkpoints/{kept.name} is of other settings; give those of the interrupted run")
    CHECKPOINTS.mkdir(exist_ok=True)
    (FOLDER / "targets").mkdir(exist_ok=True)
    kept.write_text(DESCRIBED)
    files = all_of(make_targets, [(body,) for body in range(len(AXES["Body"]))])
    (FOLDER / "targets" / "flat.csv").unlink()
    found = all_of(tried, [(reading, database, files[reading[0]]) for reading, database in plan()])
    cells, claims = [cell for one in found for cell in one], CLAIMS
    sobol = [cell for cell in cells if cell["database"] == 0]

    def share(claim, among, sign="1"):
        return mean(cell["holds"][claim] == sign for cell in among)

    held = {}
    for cell in sobol:
        held.setdefault(cell["reading"], []).append(cell["holds"].count("1"))
    ranked = sorted(held, key=lambda one: (-mean(held[one]), sum(map(bool, one))))
    rows, shares, words, deciding = [], [], {}, {}
    for c, claim in enumerate(claims):
        by_choice = {axis: {value: share(c, [cell for cell in sobol if cell["reading"][a] == v])
                            for v, value in enumerate(values)} for a, (axis, values) in enumerate(AXES.items())}
        known = [c + 1, claim["place"], claim["says"]]
        rows += [[*known, axis, *one] for axis, values in by_choice.items() for one in values.items()]
        every, open_in = share(c, sobol), share(c, sobol, "")
        ours, best = (share(c, [cell for cell in sobol if cell["reading"] == one]) for one in (OURS, ranked[0]))
        drawn = share(c, [cell for cell in cells if cell["database"]])
        decider = widest(by_choice)
        shares.append([*known, ours, best, every, drawn, *decider])
        words[claim["id"]] = (f"holds in {percent(every, 3)}"
                              + (f", is undecidable in {percent(open_in, 3)}" if open_in else "")
                              + f" of {len(ranked)} readings on {len(TARGETS)} targets"
                              + (f"; depends most on {decider[0]}: {decider[1]} {percent(decider[2], 2)}, "
                                 f"{decider[3]} {percent(decider[4], 2)}" if decider[0] else ""))
        if decider[0] and 0 < every < 1:
            deciding[decider[0]] = deciding.get(decider[0], 0) + 1
    write_csv("cells.csv", [*AXES, "database", "target", *(f"claim_{c + 1}" for c in range(len(claims)))],
              [[*(list(values)[v] for v, values in zip(cell["reading"], AXES.values())), cell["database"],
                cell["target"], *cell["holds"]] for cell in cells])
    write_csv("claims.csv", ["claim", "place", "says", "choice", "value", "share_holds"], rows)
    write_csv("shares.csv", ["claim", "place", "says", "ours", "best", "every", "other_phases", "choice", "highest",
                             "highest_share", "lowest", "lowest_share"], shares)

    def of(condition):
        return [{"claim": row[0], "place": row[1], "says": row[2]} for row in shares if condition(row[5])]

    readings = [{"claims_hold": mean(held[one]),
                 **{axis: list(values)[v] for v, (axis, values) in zip(one, AXES.items())},
                 "differs": [{"choice": axis, "value": list(values)[v]}
                             for v, (axis, values) in zip(one, AXES.items()) if v]} for one in ranked]
    best = readings[0]["claims_hold"]
    result = {**GIVEN["origin"], "seconds": time.monotonic() - BEGAN, "database_count": DATABASES,
              "claim_count": len(claims), "target_count": len(TARGETS), "reading_count": len(ranked),
              "ours_hold": mean(held[OURS]), "best_hold": best, "worst_hold": readings[-1]["claims_hold"],
              "near_best": sum(one["claims_hold"] >= best - 0.25 for one in readings),
              "never": of(lambda every: every == 0), "always": of(lambda every: every == 1),
              "depend": len(of(lambda every: 0 < every < 1)),
              "deciding": [{"choice": axis, "claims": deciding[axis]} for axis in AXES if axis in deciding],
              "firm": sum(row[6] is not None and min(row[6], 1 - row[6]) <= 0.05 for row in shares),
              "readings": readings, "summary": f"most claims hold at once: {best:.3g}"}
    origin = {key: result[key] for key in ("command", "version")}
    (FOLDER / "readings.json").write_text(json.dumps({**origin, "claims": words}, indent=1, ensure_ascii=False) + "\n")
    (FOLDER / "result.json").write_text(json.dumps(result, indent=1) + "\n")


main()
