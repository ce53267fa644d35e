"""Finds the features of a surface that drive its response, from answers to a target and random surfaces that miss it.

`rugosa run features.ini` runs this script with the settings as JSON on its standard input. The script writes result.json,
features.csv, waves.csv, heldout.csv and best/NAME.json to the folder.
"""
import concurrent.futures
import csv
import json
import pathlib
import sys

import numpy
import rugosa

GIVEN = json.load(sys.stdin)
SETTINGS, FOLDER = GIVEN["settings"], pathlib.Path(GIVEN["folder"])
PRESSURE = float(SETTINGS["targets.max-pressure"])
NODES, STEPS = int(SETTINGS["model.nodes"] or 512), int(SETTINGS["model.steps"])
REFINED = " | score | refine lm 33 sharpen=6 | best 1"
OCTAVES = [1, 2, 4, 8, 16, 32, 64]  # waves of L over these and longer
TOLERATED = 0.005  # loss of similarity: half of what an answer of 0.99 misses
LEVELS = {"low": 0, "middle": 0.5, "high": 1}  # of the target's points


def designed(target, pipeline, seed):
    """The genome and the similarity of one start that is refined."""
    found = rugosa.design(target=target, max_pressure=PRESSURE, pipeline=pipeline, seed=seed, threads=1,
                          alternatives=1, nodes=NODES, steps=STEPS)
    return found.genome, found.similarity


def all_designed(target, pipelines):
    """`designed` for each (pipeline, seed), in their order."""
    with concurrent.futures.ThreadPoolExecutor(GIVEN["threads"]) as pool:
        return list(pool.map(lambda one: designed(target, *one), pipelines))


def start_of(number):
    """Every fourth start does not use the target; all other starts are made for it."""
    return "sample 1" if number % 4 == 3 else "shape 1"


def features(genome):
    """Dimensionless numbers of a surface; they are equal for its mirror image."""
    z = numpy.asarray(genome.profile(nodes=NODES).heights)
    n, depth = len(z), z.max() - z
    z_range, middle = depth.max(), (len(z) - 1) / 2
    slope, curvature = numpy.gradient(z) * (n - 1) / z_range, numpy.gradient(numpy.gradient(z)) * (n - 1) ** 2 / z_range
    moments = [numpy.mean(values ** 2) for values in (z - z.mean(), slope * z_range, curvature * z_range)]
    top = int(numpy.argmax(z))
    apart = numpy.abs(numpy.arange(n) - top) >= n / 8
    second = int(numpy.flatnonzero(apart)[numpy.argmax(z[apart])])
    normal = (z - z.mean()) / z.std()
    found = {"highest peak off the middle": abs(top - middle) / (n - 1),
             "deepest valley off the middle": abs(int(numpy.argmin(z)) - middle) / (n - 1),
             "depth of the second peak": depth[second] / z_range,
             "distance of the two peaks": abs(second - top) / (n - 1),
             "mean depth": depth.mean() / z_range, "Rq over the range": z.std() / z_range,
             "skewness": numpy.mean(normal ** 3), "kurtosis": numpy.mean(normal ** 4),
             "log10 of rms slope": 0.5 * numpy.log10(numpy.mean(slope ** 2)),
             "log10 of rms curvature": 0.5 * numpy.log10(numpy.mean(curvature ** 2)),
             "log10 of bandwidth": numpy.log10(moments[0] * moments[2] / moments[1] ** 2)}
    for share in (0.05, 0.1, 0.25, 0.5):
        found[f"share above {share:g} of the range"] = numpy.mean(depth < share * z_range)
    curve = rugosa.contact(genome, nodes=NODES, steps=10)
    for step in (2, 5, 10):
        found[f"contact at {step / 10:g} of the approach"] = curve.contact_fraction[step - 1]
    return found


def ranks(values):
    """Ranks from 1; equal values share their mean rank."""
    order = numpy.unique(values, return_inverse=True)[1]
    count = numpy.bincount(order)
    return (numpy.cumsum(count) - (count - 1) / 2)[order]


def differs(first, second):
    """Whether two samples differ by rank sums: their z-score is beyond 4 (about 1 % for all features together)."""
    both = ranks(numpy.concatenate([first, second]))
    a, b = len(first), len(second)
    deviation = numpy.sqrt(a * b * (a + b + 1) / 12)
    return abs(both[:a].sum() - a * (a + b + 1) / 2) > 4 * deviation


def spread(values):
    return numpy.subtract(*numpy.quantile(values, [0.75, 0.25]))


def rank_correlation(first, second):
    return numpy.corrcoef(ranks(first), ranks(second))[0, 1] if len(first) > 2 else float("nan")


def stiffness(genome, target):
    """log10 of K at the target's first, middle and last point."""
    curve = rugosa.contact(genome, nodes=NODES, steps=STEPS)
    x, y = curve.secant_stiffness()
    points = [target.x[round(level * (len(target.x) - 1))] for level in LEVELS.values()]
    return numpy.log10(numpy.interp(points, numpy.asarray(x) * PRESSURE / curve.pressure[-1], y))


def collected(name, target):
    """Answers that differ from each other, as many random surfaces that miss, and the number of starts."""
    wanted, good = int(SETTINGS["features.answers"]), float(SETTINGS["features.similarity"])
    answers, profiles, starts, batch = [], [], 0, 16
    while len(answers) < wanted and starts < int(SETTINGS["features.starts"]):
        pipelines = [(start_of(k) + REFINED, GIVEN["seed"] + k) for k in range(starts, starts + batch)]
        for genome, similarity in all_designed(target, pipelines):
            z = numpy.asarray(genome.profile(nodes=NODES).heights)
            new = all(1 - max(numpy.corrcoef(z, other)[0, 1], numpy.corrcoef(z[::-1], other)[0, 1]) >=
                      float(SETTINGS["features.difference"]) for other in profiles)
            if similarity >= good and new and len(answers) < wanted:
                answers.append((genome, similarity))
                profiles.append(z)
        starts += batch
    blind = [("sample 1 | score | best 1", GIVEN["seed"] + k) for k in range(2 * len(answers))]
    misses = [one for one in all_designed(target, blind) if one[1] < good][:len(answers)]
    return answers, misses, starts


def held_out(target):
    """Similarities of new starts refined by the phases of long waves only: the shortest wave that is needed."""
    count = int(SETTINGS["features.held-out"])

    def refined(genes, first):
        return [s for _, s in all_designed(target, [(f"{start_of(k)} | score | refine lm 50 sharpen=8{genes} | best 1",
                                                     GIVEN["seed"] + first + k) for k in range(count)])]
    chosen_on, checked_on = 1000000, 2000000
    free = numpy.array(refined("", chosen_on))
    octave = next((o for o in OCTAVES if numpy.median(free - refined(f" genes=longer-{o}", chosen_on)) <= TOLERATED),
                  OCTAVES[-1])
    rows = {"all phases": refined("", checked_on), "needed phases": refined(f" genes=longer-{octave}", checked_on),
            "other phases": refined(f" genes=shorter-{octave}", checked_on)}
    loss = numpy.sort(numpy.subtract(rows["all phases"], rows["needed phases"]))
    # The median lies between these two order statistics in 95 % of samples (normal approximation).
    half = 0.98 * numpy.sqrt(count)
    low, high = loss[max(0, int(count / 2 - half))], loss[min(count - 1, int(count / 2 + half))]
    return octave, rows, float(low), float(high)


def write_csv(name, rows):
    with open(FOLDER / name, "w", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]) if rows else ["target"], lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def main():
    table, waves, held, summaries = [], [], [], []
    for file in GIVEN["targets"]:
        target, name = rugosa.Target.read(file), pathlib.Path(file).stem
        answers, misses, starts = collected(name, target)
        if not misses:
            sys.exit(f"features: no answer to {file} in {starts} starts; lower features.similarity")
        groups = [[features(genome) for genome, _ in group] for group in (answers, misses)]
        levels = numpy.array([stiffness(genome, target) for genome, _ in misses])
        for feature in groups[0][0]:
            of_answers, of_misses = ([one[feature] for one in group] for group in groups)
            narrow = spread(of_answers) / spread(of_misses) < 0.67 if spread(of_misses) > 0 else False
            row = {"target": name, "feature": feature,
                   "kind": "shared" if narrow else "shifted" if differs(of_answers, of_misses) else "open",
                   "answers_median": numpy.median(of_answers), "answers_quartiles": spread(of_answers),
                   "misses_median": numpy.median(of_misses), "misses_quartiles": spread(of_misses)}
            row.update({f"rank_correlation_{level}": rank_correlation(of_misses, levels[:, k])
                        for k, level in enumerate(LEVELS)})
            table.append(row)
        octave, rows, low, high = held_out(target)
        held += [{"target": name, "phases": phases, "similarity": s} for phases, all_s in rows.items() for s in all_s]
        waves += [{"target": name, "phases": phases, "median": numpy.median(all_s),
                   "lower_quartile": numpy.quantile(all_s, 0.25), "reached": numpy.mean(numpy.array(all_s) >= 0.99)}
                  for phases, all_s in rows.items()]
        best = max(answers, key=lambda one: one[1])[0]
        (FOLDER / "best").mkdir(exist_ok=True)
        (FOLDER / "best" / f"{name}.json").write_text(json.dumps(best.to_dict()) + "\n")
        summaries.append({"name": name, "answers": len(answers), "misses": len(misses), "starts": starts,
                     "needed_octave": octave, "loss_low": low, "loss_high": high,
                     "enough": high <= TOLERATED, "not_enough": low > TOLERATED})
    write_csv("features.csv", table)
    write_csv("waves.csv", waves)
    write_csv("heldout.csv", held)
    result = {**GIVEN["origin"], "targets": summaries, "summary": f"{len(table)} rows of features.csv"}
    (FOLDER / "result.json").write_text(json.dumps(result, indent=1) + "\n")


main()
