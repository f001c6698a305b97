#!/usr/bin/python3
"""Draws frame times that tyndall-sequence printed, a panel a file, into a PNG, and prints a table row for each.

plotSequence.py OUT.png NAME.csv...
"""
import csv
import pathlib
import statistics
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

WAYS = [("full_ms", "in full", "black"), ("objects_ms", "objects named", "tab:blue"), ("detect_ms", "detected", "tab:orange")]


def read(path):
    lines = [line for line in pathlib.Path(path).read_text().splitlines() if not line.startswith("#")]
    return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(lines)]


def main():
    out, *paths = sys.argv[1:]
    figure, panels = plt.subplots(1, len(paths), figsize=(5 * len(paths), 3.6), squeeze=False)
    for axes, path in zip(panels[0], paths):
        rows = read(path)[3:]  # the first compile shaders and fill what is kept
        for column, label, colour in WAYS:
            axes.plot([row["frame"] for row in rows], [row[column] for row in rows], label=label, color=colour)
        medians = [statistics.median(row[column] for row in rows) for column, _, _ in WAYS]
        share = statistics.mean(row["objects_share"] for row in rows)
        error = max(max(row["objects_error"], row["detect_error"]) for row in read(path))
        name = pathlib.Path(path).stem
        print(f"| {name} | {len(rows) + 3} | {share:.0%} | {medians[0]:.0f} | {medians[1]:.0f} | {medians[2]:.0f} | "
              f"{medians[0] / medians[1]:.2f}× | {medians[0] / medians[2]:.2f}× | {error:.1g} |")
        axes.set(title=name, xlabel="frame", ylim=(0, None))
        axes.grid(True, alpha=0.25)
    panels[0][0].set_ylabel("ms")
    panels[0][0].legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(out, dpi=100)


main()
