#!/usr/bin/python3
"""Draws bench.json of tyndall-bench: error against time per setup, passes, scaling. SVG and PNG beside the file.

plot.py bench.json [FOLDER]
"""
import json
import sys
from collections import defaultdict
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

sys.dont_write_bytecode = True  # the source tree stays as it is
from report import PROFILES, setup_of  # noqa: E402

COLOURS = {"exact": "black", "profiles": "tab:red", "epipolar": "tab:orange", "fixed": "tab:blue", "half": "tab:cyan",
           "froxels": "tab:purple", "epipolar-march": "tab:green", "tree": "tab:brown", "pyramid": "tab:pink",
           "volumes": "tab:olive", "incremental": "tab:gray"}


def family_of(result):
    return "profiles" if result["family"] in PROFILES else result["family"]


def save(figure, folder, name):
    figure.tight_layout()
    for suffix in ("svg", "png"):
        figure.savefig(folder / f"{name}.{suffix}", dpi=130)
    plt.close(figure)


def file_name(text):
    return "".join(c if c.isalnum() else "-" for c in text)


def draw_curve(axes, title, results):
    curves = defaultdict(list)
    for r in results:
        error = r["errors"]["exact"]["rrmse"]
        if error is not None and error > 0:
            curves[family_of(r)].append((r["ms"]["median"], 100 * error, r["technique"]))
        elif r["family"] == "exact":
            axes.axvline(r["ms"]["median"], color="black", linestyle=":", label="exact")
    for family, points in sorted(curves.items()):
        points.sort()
        ours = family == "profiles"
        axes.plot([p[0] for p in points], [p[1] for p in points], "o-", label=family, color=COLOURS.get(family),
                  linewidth=2.5 if ours else 1.2, markersize=8 if ours else 4, zorder=3 if ours else 2)
        for time, error, technique in points:
            axes.annotate(technique.split(":")[-1], (time, error), fontsize=6, xytext=(3, 3),
                          textcoords="offset points")
    axes.set(xscale="log", yscale="log", xlabel="time, ms (median)", ylabel="rRMSE against exact, %")
    axes.set_title(title, fontsize=9)
    axes.grid(True, which="both", alpha=0.25)
    axes.legend(fontsize=8)


def plot_curve(name, results, subtitle, folder):
    figure, axes = plt.subplots(figsize=(8, 5.5))
    draw_curve(axes, f"{name}\n{subtitle}", results)
    save(figure, folder, "curve-" + file_name(name))


def pass_kind(name):
    words = name.split()
    return " ".join(w for i, w in enumerate(words) if w != "light" and not (i and words[i - 1] == "light")) or name


def timed(results):
    return [r for r in results if any("ms" in p for p in r.get("passes", []))]


def draw_passes(axes, name, rows):
    kinds, colours = [], plt.get_cmap("tab20")
    for y, r in enumerate(rows):
        left, times = 0.0, defaultdict(float)
        for p in r["passes"]:
            times[pass_kind(p["name"])] += p.get("ms", 0)
        for kind, ms in times.items():
            new = kind not in kinds
            if new:
                kinds.append(kind)
            axes.barh(y, ms, left=left, color=colours(kinds.index(kind) % 20), label=kind if new else None)
            left += ms
    axes.set_yticks(range(len(rows)), [r["technique"] for r in rows], fontsize=7)
    axes.invert_yaxis()
    axes.set_xlabel("ms, each pass on its own")
    axes.set_title(name, fontsize=9)
    axes.legend(fontsize=6, ncol=2, loc="center left", bbox_to_anchor=(1, 0.5))


def plot_passes(name, results, folder):
    rows = timed(results)
    if not rows:
        return
    figure, axes = plt.subplots(figsize=(9, 1.5 + 0.32 * len(rows)))
    draw_passes(axes, name, rows)
    save(figure, folder, "passes-" + file_name(name))


def draw_series(axes, name, results, fits):
    lines = defaultdict(list)
    for r in results:
        lines[r["family"] if name == "slices" else r["technique"]].append((r["x"], r["ms"]["median"]))
    exponents = {f["technique"]: f["exponent"] for f in fits if f["series"] == name}
    for technique, points in sorted(lines.items()):
        points.sort()
        label = f"{technique}: x^{exponents[technique]:.2f}" if technique in exponents else technique
        axes.plot([p[0] for p in points], [p[1] for p in points], "o-", label=label)
    labels = {"shadow": "shadow map, texels a side", "image": "pixels", "slices": "slices", "lights": "lights",
              "density": "factor on the medium's density"}
    axes.set(xscale="log", yscale="log", xlabel=labels.get(name, name), ylabel="time, ms (median)")
    axes.set_title(f"scaling: {name} ({results[0]['scene']})", fontsize=9)
    axes.grid(True, which="both", alpha=0.25)
    axes.legend(fontsize=8)


def plot_series(name, results, fits, folder):
    figure, axes = plt.subplots(figsize=(7, 5))
    draw_series(axes, name, results, fits)
    save(figure, folder, "scaling-" + name)


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    source = Path(sys.argv[1])
    folder = Path(sys.argv[2]) if len(sys.argv) == 3 else source.parent
    bench = json.loads(source.read_text())
    finished = [r for r in bench["results"] if "ms" in r]
    machine = bench["machine"]
    curves, series = defaultdict(list), defaultdict(list)
    for r in finished:
        (curves[setup_of(r)] if r["series"] == "curve" else series[r["series"]]).append(r)
    for name, results in curves.items():
        subtitle = f"{machine['processor']}, {machine['cores']} cores, {bench['commit']}\n{results[0]['driver']}"
        plot_curve(name, results, subtitle, folder)
        plot_passes(name, results, folder)
    for name, results in series.items():
        plot_series(name, results, bench.get("scaling") or [], folder)


if __name__ == "__main__":
    main()
