"""Designs arrays of spherical caps whose contact area follows given laws of the load, and compares pipelines.

`rugosa run metainterfaces.ini` runs this script with the settings as JSON on its standard input. It writes
result.json, laws.csv, curves.csv and one folder of `rugosa design` for each law and choice of genes or pipeline.
"""
import csv
import json
import pathlib
import subprocess
import sys

GIVEN = json.load(sys.stdin)
FOLDER = pathlib.Path(GIVEN["folder"])
CAPS = {name.removeprefix("caps."): value for name, value in GIVEN["settings"].items()}


def trials_of(law):
    """The designs of a law: each has a name and its flags."""
    flags = {name: CAPS[name] for name in ("asperities", "pitch", "radius", "heights", "modulus", "nodes", "accuracy")}
    flags["reach-similarity"] = CAPS["similarity"]
    large = law in CAPS["large-laws"].replace(" ", "").split(",")
    if large:
        flags |= {"asperities": CAPS["large-asperities"], "pipeline": CAPS["large-pipeline"]}
    yield "heights", flags
    if CAPS["radii"]:
        flags = {**flags, "radius": "", "radii": CAPS["radii"]}
        yield "heights and radii", flags
        if large:
            yield "heights and radii, genetic", {**flags, "pipeline": "", "variant": "genetic"}


def designed(target, out, flags):
    """The result.json of a design in the folder `out`."""
    command = [GIVEN["program"], "design", "--target", target, "--seed", str(GIVEN["seed"]), "--threads",
               str(GIVEN["threads"]), "--pictures", "off", "--force", "--out", str(out)]
    for name, value in flags.items():
        command += ["--" + name, value] if value else []
    ended = subprocess.run(command, capture_output=True, text=True, check=False)
    if ended.returncode not in (0, 3):
        sys.exit(ended.stderr.strip() or f"{out.name}: rugosa design ended with code {ended.returncode}")
    return json.loads((out / "result.json").read_text())


def row_of(result):
    """The row of a design in laws.csv, except its law and trial."""
    answer = next(iter(result["variants"].values()))
    row = {"model": result["model"], "caps": len(answer["genome"]["asperities"]), "similarity": answer["similarity"],
           "verified": answer["similarity_worst"],
           "bound": min([reason["highest_similarity"] for reason in result["out_of_reach"]], default=1),
           "search_s": answer["search_seconds"], "verification_s": answer["verification"]["seconds"],
           "curves": answer["curves"], "gradients": answer["gradients"]}
    for level in answer.get("tolerance", []):
        row[f"height_rms_mm_{100 * level['error']:.0f}"] = level["height_rms_mm"]
    return row


def write_csv(name, rows):
    with open(FOLDER / name, "w", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def main():
    rows, curves, met = [], [], set()
    for target in GIVEN["targets"]:
        law = pathlib.Path(target).stem
        for trial, flags in trials_of(law):
            out = FOLDER / (law + "-" + trial.replace(",", "").replace(" ", "-"))
            result = designed(target, out, flags)
            met.update({law} if result["summary"]["found"] else ())
            rows.append({"law": law, "trial": trial, **row_of(result)})
            area = result["nominal_area_mm2"]
            for file, curve in (("points.csv", "target"), ("curves.csv", trial)):
                for row in csv.DictReader((out / file).read_text().splitlines()):
                    curves.append({"law": law, "curve": curve, "load_N": area * float(row["x"]),
                                   "area_mm2": area * float(row["y"])})
    write_csv("laws.csv", rows)
    write_csv("curves.csv", curves)
    laws = list(dict.fromkeys(row["law"] for row in rows))
    (FOLDER / "result.json").write_text(json.dumps(
        {**GIVEN["origin"], "laws": [{"law": law} for law in laws], "rows": rows,
         "summary": f"{len(met)} of {len(laws)} laws met"}, indent=1) + "\n")


main()
