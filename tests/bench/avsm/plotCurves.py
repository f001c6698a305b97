#!/usr/bin/python3
"""Draws the file that tyndall-avsm-bench --curves writes, transmittance against depth of single texels, into a PNG: a column per
texel, and rows of methods of one kind beside the product of all segments.

plotCurves.py CURVES.csv OUT.png [SCENE…]
"""
import csv
import sys
from collections import defaultdict

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

ROWS = [("fitted insertion", ("avsm fitted 4", "avsm fitted 8", "avsm fitted 12")),
        ("insertion", ("avsm sorted 8", "avsm in order 8", "avsm sorted 12")),
        ("rivals", ("deep 0.01", "opacity 32", "fourier 16", "moments 6"))]
STEPS_WANTED = 1e-3  # of depth: what a zoom shows at least


def read(path, scenes):
    curves = defaultdict(lambda: defaultdict(list))
    with open(path, newline="") as file:
        for line in csv.DictReader(file):
            if not scenes or line["scene"] in scenes:
                point = float(line["depth"]), float(line["transmittance"])
                curves[line["scene"], line["texel"]][line["method"]].append(point)
    return curves


def range_of(points):
    """The depths between which the product changes, with a tenth on either side."""
    first, last = points[0][1], points[-1][1]
    inside = [depth for depth, passed in points if abs(passed - first) > 1e-4 and abs(passed - last) > 1e-4]
    if not inside:
        return 0, 1
    margin = max(0.1 * (inside[-1] - inside[0]), 10 * STEPS_WANTED)
    return max(inside[0] - margin, 0), min(inside[-1] + margin, 1)


curves = read(sys.argv[1], sys.argv[3:])
figure, grid = plt.subplots(len(ROWS), len(curves), figsize=(4.6 * len(curves), 3.3 * len(ROWS)), squeeze=False)
for column, ((scene, texel), methods) in enumerate(curves.items()):
    for row, (title, names) in enumerate(ROWS):
        axes = grid[row][column]
        axes.plot(*zip(*methods["product"]), color="black", linewidth=2.5, alpha=0.35, label="product")
        for name in names:
            if name in methods:
                axes.plot(*zip(*methods[name]), linewidth=1, label=name)
        axes.set_xlim(*range_of(methods["product"]))
        axes.set_ylim(-0.02, 1.05)
        axes.grid(True, alpha=0.25)
        axes.legend(fontsize=7)
        if row == 0:
            axes.set_title(f"{scene}, texel {texel}", fontsize=9)
        if column == 0:
            axes.set_ylabel(f"{title}: transmittance")
        if row == len(ROWS) - 1:
            axes.set_xlabel("depth")
figure.tight_layout()
figure.savefig(sys.argv[2], dpi=100)
