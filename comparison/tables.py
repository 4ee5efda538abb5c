# SPDX-License-Identifier: GPL-3.0-or-later
"""The tables of a comparison, computed from the CSV files that `ga_symmetry compare` wrote."""
import csv
import os
from collections import defaultdict
from statistics import mean, median


def read_csv(folder, name):
    """The rows of a file as dictionaries of texts."""
    with open(os.path.join(folder, name), newline="") as file:
        return list(csv.DictReader(file))


def percent(share, digits=1):
    return f"{100 * share:.{digits}f} %"


def ratio(value):
    return f"{value:.2f}" if value < 10 else f"{value:.0f}"


def scores(folder):
    """One dictionary a method, numbers as numbers, in the order in which the methods were named."""
    return [{key: text if key == "method" else float(text) for key, text in row.items()}
            for row in read_csv(folder, "methods.csv")]


def is_automatic(method):
    return method.endswith("-auto")


def summary(all_scores):
    """Where the joint search stands against the methods of others that were given as much as it."""
    lines = []
    for joint in (s for s in all_scores if s["method"] in ("joint", "joint-auto")):
        rivals = [s for s in all_scores if is_automatic(s["method"]) == is_automatic(joint["method"])
                  and not s["method"].startswith("joint")]
        if not rivals:
            continue

        def ahead(is_ahead):
            return ", ".join(s["method"] for s in rivals if is_ahead(s)) or "none"

        lines.append(f"{joint['method']}: mean error {joint['mean']:.4f}, corr {percent(joint['corr'])}, "
                     f"{joint['seconds']:.2f} s. Lower mean error: {ahead(lambda s: s['mean'] < joint['mean'])}. "
                     f"Higher corr: {ahead(lambda s: s['corr'] > joint['corr'])}. "
                     f"Faster: {ahead(lambda s: s['seconds'] < joint['seconds'])}.")
    return lines


def accuracy(all_scores):
    """(head, rows): every method over all meshes."""
    return (["method", "mean error", "corr", "mesh rate", "coverage", "involution", "seconds (median)"],
            [[s["method"], f"{s['mean']:.4f}", percent(s["corr"]), percent(s["mesh_rate"], 0), percent(s["coverage"]),
              percent(s["involution"]), f"{s['seconds']:.2f}"] for s in all_scores])


def mesh_errors(folder, all_scores):
    """(head, rows): mean error on each mesh, over seeds and repeats."""
    errors = defaultdict(list)
    for run in read_csv(folder, "runs.csv"):
        errors[run["mesh"], run["method"]].append(float(run["mean"]))
    names = [s["method"] for s in all_scores]
    return (["mesh"] + names,
            [[mesh] + [f"{mean(errors[mesh, n]):.3f}" if (mesh, n) in errors else "" for n in names]
             for mesh in dict.fromkeys(key[0] for key in errors)])


def duration_turns(folder):
    """What the searches of pairs took: {all samples?: {(error, search, quality): [row]}}, each row with numbers and
    the ratio to naive search in the same turn. Every mesh has a small and a large number of samples."""
    data = read_csv(folder, "durations.csv")
    counts = defaultdict(set)
    for row in data:
        counts[row["mesh"]].add(int(row["samples"]))
    turns = {False: defaultdict(list), True: defaultdict(list)}
    naive = 0
    for row in data:
        seconds, samples = float(row["seconds"]), int(row["samples"])
        naive = seconds if row["search"] == "naive" else naive  # it opens each turn
        turn = {"samples": samples, "ms": 1e3 * seconds, "ratio": seconds / naive, "reached": row["reached"] == "yes",
                "evaluations": float(row["evaluations"] or 0), "generations": int(row["generations"] or 0)}
        for large in (False, True):
            if samples == (max if large else min)(counts[row["mesh"]]):
                turns[large][row["error"], row["search"], float(row["quality"])].append(turn)
    return turns


def quality_text(quality):
    return f"within {100 * quality:.0f} %" if quality else "optimum"


def middle(turns, column):
    return median(turn[column] for turn in turns)


def ratio_text(turns):
    """Of searches that stop at a limit most of the time the ratio is more than that."""
    return ("> " if mean(t["reached"] for t in turns) < 0.5 else "") + ratio(middle(turns, "ratio"))


def durations(turns):
    """(head, rows) for one number of samples."""
    rows = []
    for (error, search, quality), group in turns.items():
        work = middle(group, "evaluations")
        rows.append([search, error, quality_text(quality), f"{middle(group, 'ms'):.2f}", ratio_text(group),
                     f"{work / 1000:.0f}" if work else "",
                     f"{middle(group, 'generations'):.0f}" if search == "genetic" else "",
                     percent(mean(t["reached"] for t in group), 0)])
    return (["search", "error", "quality", "ms (median)", "ratio to naive", "thousand pairs evaluated, at most",
             "generations (median)", "reached it"], rows)


def sample_count(turns):
    """Samples on each side, median over the meshes."""
    return median(turn["samples"] for group in turns.values() for turn in group)


def convergence_generation(best):
    """The first generation within 5 % of the whole fall to the last, as convergence_generation in durations.h."""
    near = best[-1] + 0.05 * (best[0] - best[-1])
    return next(g for g, value in enumerate(best) if value <= near)


def pair_generations(folder):
    """(head, rows): the pair-wise genetic algorithm with its settings."""
    logs = defaultdict(list)
    for row in read_csv(folder, "generations.csv"):
        if row["z"]:
            logs[row["search"], int(row["regions"]), float(row["z"]), row["mesh"], row["seed"]].append(row)
    groups = defaultdict(list)
    for (error, regions, z, _, _), log in logs.items():
        best = [float(row["best"]) for row in log]
        converged = convergence_generation(best)
        threshold = float(log[0]["success_threshold"])
        groups[error, regions, z].append({
            "converged": converged, "ms": 1e3 * float(log[converged]["seconds"]),
            "gap": best[-1] / float(log[0]["optimum"]) - 1, "diversity": float(log[-1]["diversity"]),
            "success": next((g for g, value in enumerate(best) if value <= threshold), None)})
    rows = []
    for (error, regions, z), runs in sorted(groups.items()):
        succeeded = [run["success"] for run in runs if run["success"] is not None]
        rows.append([error, str(regions), f"{z:.2f}", f"{middle(runs, 'converged'):.0f}", f"{middle(runs, 'ms'):.1f}",
                     percent(middle(runs, "gap"), 0), percent(len(succeeded) / len(runs), 0),
                     f"{median(succeeded):.0f}" if succeeded else "-", f"{middle(runs, 'diversity'):.2f}"])
    return (["error", "regions", "z", "convergence generation", "ms until then", "above the optimum at the end",
             "reaches the fitness of the given pair", "in generation", "diversity at the end"], rows)


def method_generations(folder, all_scores):
    """(head, rows): the genetic searches among the methods, as a user runs them."""
    runs = defaultdict(list)
    for row in read_csv(folder, "runs.csv"):
        # joint-zoomout starts with the very search of joint.
        if row["generations"] and int(row["generations"]) > 1 and not row["method"].startswith("joint-zoomout"):
            count, converged, seconds = int(row["generations"]), int(row["convergence_generation"]), float(
                row["search_seconds"])
            runs[row["method"]].append({"count": count, "converged": converged, "seconds": seconds,
                                        "until": seconds * (converged + 1) / count,
                                        "diversity": float(row["diversity"])})
    rows = [[name, f"{middle(group, 'count'):.0f}", f"{middle(group, 'converged'):.0f}",
             f"{middle(group, 'seconds'):.2f}", f"{middle(group, 'until'):.2f}", f"{middle(group, 'diversity'):.2f}"]
            for name, group in runs.items()]
    return (["method", "generations", "convergence generation", "search, s", "of it until convergence, s",
             "diversity at the end"], rows)
