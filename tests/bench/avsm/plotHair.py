#!/usr/bin/python3
"""Draws the file that tyndall-hair-bench --csv writes, mean difference of transmittance against the size of the map, into a
PNG: a column for each footprint.

plotHair.py HAIR.csv OUT.png
"""
import csv
import sys
from collections import defaultdict

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

curves = defaultdict(lambda: defaultdict(list))
with open(sys.argv[1], newline="") as file:
    for line in csv.DictReader(file):
        curves[float(line["footprint_mm"])][line["method"]].append((int(line["size"]), float(line["error"])))
figure, all_axes = plt.subplots(1, len(curves), figsize=(4 * len(curves), 4), sharey=True, squeeze=False)
for axes, footprint in zip(all_axes[0], sorted(curves)):
    for method, points in curves[footprint].items():
        axes.plot(*zip(*sorted(points)), "o-", label=method, markersize=4)
    axes.set(xscale="log", yscale="log", xlabel="texels per side", title="to points" if footprint == 0 else f"over {footprint:g} mm")
    axes.axhline(0.02, color="black", linestyle=":")
    axes.grid(True, which="both", alpha=0.25)
all_axes[0][0].set_ylabel("mean |difference of transmittance|")
all_axes[0][0].legend(fontsize=7)
figure.tight_layout()
figure.savefig(sys.argv[2], dpi=110)
