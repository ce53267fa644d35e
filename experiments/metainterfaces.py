"""Designs arrays of spherical caps whose contact area follows given laws of the load, and compares pipelines.

`rugosa run metainterfaces.ini` runs this script with one argument, the settings as JSON. The script writes
result.json, laws.csv, curves.csv and one folder of `rugosa design` for each law and choice of genes or pipeline.
"""
import csv
import json
import pathlib
import subprocess
import sys

GIVEN = json.loads(sys.argv[1])
SETTINGS, FOLDER = GIVEN["settings"], pathlib.Path(GIVEN["folder"])
FLAGS = ["pitch", "radius", "heights", "modulus", "nodes", "accuracy"]
LARGE = SETTINGS["caps.large-laws"].replace(" ", "").split(",")


def designed(target, name, flags):
    """The result.json of a design, and its folder."""
    out = FOLDER / name
    command = [GIVEN["program"], "design", "--target", target, "--seed", str(GIVEN["seed"]), "--threads",
               str(GIVEN["threads"]), "--pictures", "off", "--force", "--out", str(out)] + flags
    ended = subprocess.run(command, capture_output=True, text=True, check=False)
    if ended.returncode not in (0, 3):
        sys.exit(ended.stderr.strip() or f"{name}: rugosa design ended with code {ended.returncode}")
    return json.loads((out / "result.json").read_text()), out


def flags_of(law):
    """The flags of the array of a law."""
    given = {name: SETTINGS["caps." + name] for name in FLAGS}
    given["asperities"] = SETTINGS["caps.large-asperities" if law in LARGE else "caps.asperities"]
    given["reach-similarity"] = SETTINGS["caps.similarity"]
    return given


def trials_of(law):
    """The designs of a law by name: flags that replace those of the array."""
    search = {"pipeline": SETTINGS["caps.large-pipeline"]} if law in LARGE else {}
    trials = {"heights": search}
    if SETTINGS["caps.radii"]:
        radii = {"radius": "", "radii": SETTINGS["caps.radii"]}
        trials["heights and radii"] = {**search, **radii}
        if law in LARGE:
            trials["heights and radii, genetic"] = {"variant": "genetic", **radii}
    return trials


def row_of(law, trial, result):
    """The row of a design in laws.csv."""
    answer = next(iter(result["variants"].values()))
    row = {"law": law, "trial": trial, "model": result["model"], "caps": len(answer["genome"]["asperities"]),
           "similarity": answer["similarity"], "verified": answer["similarity_worst"],
           "bound": min([reason["highest_similarity"] for reason in result["out_of_reach"]], default=1),
           "search_s": answer["search_seconds"], "verification_s": answer["verification"]["seconds"],
           "curves": answer["curves"], "gradients": answer["gradients"]}
    for level in answer.get("tolerance", []):
        row[f"height_rms_mm_{100 * level['error']:.0f}"] = level["height_rms_mm"]
    return row


def curves_of(law, trial, result, folder):
    """The rows of a design in curves.csv."""
    area = result["nominal_area_mm2"]
    for file, curve in (("points.csv", "target"), ("curves.csv", trial)):
        with open(folder / file, newline="") as table:
            for row in csv.DictReader(table):
                yield {"law": law, "curve": curve, "load_N": area * float(row["x"]),
                       "area_mm2": area * float(row["y"])}


def write_csv(name, rows):
    with open(FOLDER / name, "w", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def main():
    rows, curves = [], []
    for target in GIVEN["targets"]:
        law = pathlib.Path(target).stem
        for trial, changes in trials_of(law).items():
            flags = {**flags_of(law), **changes}
            given = [word for name, value in flags.items() if value for word in ("--" + name, value)]
            result, folder = designed(target, law + "-" + trial.replace(",", "").replace(" ", "-"), given)
            rows.append(row_of(law, trial, result))
            curves += curves_of(law, trial, result, folder)
    write_csv("laws.csv", rows)
    write_csv("curves.csv", curves)
    laws = list(dict.fromkeys(row["law"] for row in rows))
    required = float(SETTINGS["caps.similarity"])
    met = sum(any((row["verified"] or -1) >= required for row in rows if row["law"] == law) for law in laws)
    result = {**GIVEN["origin"], "laws": [{"law": law} for law in laws], "rows": rows,
              "summary": f"{met} of {len(laws)} laws met"}
    (FOLDER / "result.json").write_text(json.dumps(result, indent=1) + "\n")


main()
