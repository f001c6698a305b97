#!/usr/bin/python3
"""Draws the table that tyndall-low-rank prints, on standard input: error against the number of terms, into a PNG.

tyndall-low-rank | plotLowRank.py OUT.png
"""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

figure, axes = plt.subplots(figsize=(8, 5))
for line in sys.stdin.read().splitlines()[2:]:
    scene, *errors = [cell.strip() for cell in line.strip("| ").split("|")]
    values = [float(error.rstrip(" %")) for error in errors]
    axes.plot(range(1, len(values) + 1), values, "o-", label=scene)
axes.set(yscale="log", xlabel="terms N", ylabel="rRMSE against tree, %", title="low rank, isotropic medium, 320x180")
axes.axhline(1, color="black", linestyle=":")
axes.grid(True, which="both", alpha=0.25)
axes.legend(fontsize=8)
figure.tight_layout()
figure.savefig(sys.argv[1], dpi=110)
