#!/usr/bin/python3
"""Draws report.json of tests/gpu.sh: curves.png, run time against error; passes.png; growth.png, scaling and reuse.

plots.py FOLDER
"""
import json
import os
import sys
from collections import defaultdict
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

sys.dont_write_bytecode = True  # the source tree stays as it is
HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / "bench")]  # in a bundle it lies here
from plot import draw_curve, draw_passes, draw_series, timed  # noqa: E402
from report import PROFILES, setup_of  # noqa: E402

COLUMNS = 3
RIVALS = ("shipping", "research")
WAYS = [("full_ms", "in full", "black"), ("objects_ms", "objects named", "tab:blue"), ("detect_ms", "detected", "tab:orange")]
WARM_UP = 3  # frames that compile, and fill what is kept


def save(figure, who, file):
    """Beside the file and renamed: never half a picture."""
    software = "SOFTWARE DRIVER, no GPU: " if who["software"] else ""
    figure.suptitle(f"{software}{who['driver']}\n{who['processor']}, {who['cores']} cores; commit {who['commit']}", fontsize=10)
    figure.tight_layout(rect=(0, 0, 1, 0.97))
    unfinished = file.with_suffix(".new.png")
    figure.savefig(unfinished, dpi=80)
    plt.close(figure)
    os.replace(unfinished, file)


def panels(count, width, height):
    rows = (count + COLUMNS - 1) // COLUMNS
    figure, axes = plt.subplots(rows, min(count, COLUMNS), figsize=(width * min(count, COLUMNS), height * rows + 0.6), squeeze=False)
    flat = list(axes.flat)
    for unused in flat[count:]:
        unused.axis("off")
    return figure, flat


def curves(who, setups, file):
    drawn = [(name, results) for name, results in setups.items() if any(r["group"] in RIVALS for r in results)]
    if not drawn:
        return
    figure, axes = panels(len(drawn), 6.5, 5)
    for panel, (name, results) in zip(axes, drawn):
        draw_curve(panel, name, results)
    save(figure, who, file)


def passes(who, setups, file):
    drawn = []
    for name, results in setups.items():
        rows = timed([r for r in results if r["technique"] in PROFILES and "calls" in r])
        if rows:
            drawn.append((name, rows))
    if not drawn:
        return
    figure, axes = plt.subplots(len(drawn), 1, figsize=(13, 2.6 * len(drawn) + 0.6), squeeze=False)
    for panel, (name, rows) in zip(axes.flat, drawn):
        draw_passes(panel, name, rows)
    save(figure, who, file)


def draw_sequence(axes, sequence):
    frames = sequence["frames"][WARM_UP:]
    for column, label, colour in WAYS:
        axes.plot([f["frame"] for f in frames], [f[column] for f in frames], label=label, color=colour)
    axes.set(xlabel="frame", ylabel="ms", ylim=(0, None))
    axes.set_title(f"reuse: {sequence['what'].rsplit(', profile', maxsplit=1)[0]}", fontsize=9)
    axes.grid(True, alpha=0.25)
    axes.legend(fontsize=8)


def growth(who, series, fits, sequences, file):
    sequences = [s for s in sequences if len(s["frames"]) > WARM_UP]
    count = len(series) + len(sequences)
    if count == 0:
        return
    figure, axes = panels(count, 6.5, 4.6)
    for panel, (name, results) in zip(axes, series.items()):
        draw_series(panel, name, results, fits)
    for panel, sequence in zip(axes[len(series):], sequences):
        draw_sequence(panel, sequence)
    save(figure, who, file)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = Path(sys.argv[1])
    report = json.loads((folder / "report.json").read_text())
    bench = report.get("bench", {})
    setups, series = defaultdict(list), defaultdict(list)
    for r in bench.get("results", []):
        if "ms" in r:
            (setups[setup_of(r)] if r["series"] == "curve" else series[r["series"]]).append(r)
    who = report["who"]
    curves(who, setups, folder / "curves.png")
    passes(who, setups, folder / "passes.png")
    growth(who, series, bench.get("scaling") or [], report.get("sequences", []), folder / "growth.png")


if __name__ == "__main__":
    main()
