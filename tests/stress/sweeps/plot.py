#!/usr/bin/env python3
"""Plots sweeps.csv: error and change from picture to picture along a few sweeps, both techniques beside exact.

plot.py sweeps.csv sweeps.png [SWEEP...]
"""
import csv
import sys
from collections import defaultdict

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

SHOWN = [
    "sun, left edge",
    "spot, top right corner",
    "sun, through infinity, right",
    "hard spot, through the wall",
    "lamp, into it and out of it",
    "cascades, through a seam",
]


def read(name):
    """Points by sweep and technique, in the order of the file."""
    curves = defaultdict(list)
    with open(name, newline="") as file:
        for row in csv.DictReader(file):
            point = {key: float(row[key]) for key in ("t", "error", "change", "exact_change")}
            curves[row["sweep"], row["technique"]].append(point)
    return curves


def draw(axes, curves, sweep):
    for technique, colour in (("epipolar", "tab:blue"), ("tree", "tab:green")):
        points = curves[sweep, technique]
        places = [point["t"] for point in points]
        axes.plot(places, [100 * point["error"] for point in points], "-", color=colour, label=f"error, {technique}")
        steps = points[1:]
        excess = [100 * max(point["change"] - point["exact_change"], 0) for point in steps]
        axes.plot(places[1:], excess, ":", color=colour, label=f"jump, {technique}")
    exact = [100 * point["exact_change"] for point in curves[sweep, "epipolar"][1:]]
    axes.plot(places[1:], exact, "-", color="0.7", label="change, exact")
    axes.set_title(sweep, fontsize=9)
    axes.set_xscale("symlog", linthresh=1e-7)
    axes.set_xticks([-1, -1e-3, -1e-6, 0, 1e-6, 1e-3, 1])
    axes.set_yscale("symlog", linthresh=0.1)
    axes.set_ylim(0, 300)
    axes.tick_params(labelsize=7)


def main():
    source, target, *sweeps = sys.argv[1:]
    curves = read(source)
    figure, grid = plt.subplots(2, 3, figsize=(12, 6), sharey=True)
    for axes, sweep in zip(grid.flat, sweeps or SHOWN):
        draw(axes, curves, sweep)
    grid[0][0].legend(fontsize=7)
    for axes in grid[:, 0]:
        axes.set_ylabel("% of the mean", fontsize=8)
    figure.tight_layout()
    figure.savefig(target, dpi=80)


if __name__ == "__main__":
    main()
