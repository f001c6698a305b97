#!/usr/bin/python3
"""Turns bench.json of tyndall-bench into Markdown tables, on standard output.

report.py bench.json
"""
import json
import math
import sys
from collections import defaultdict
from pathlib import Path

PROFILES = ["high", "balanced", "performance"]
MEAN_SCENES = ["nave", "forest", "terrain"]


def setup_of(result):
    name = "{scene} {0}x{1} shadow {shadow_size} {context}".format(*result["size"], **result)
    if result["lights"]:
        name += f" lights {result['lights']}"
    return name if result["density"] == 1 else name + f" density {result['density']:g}"


def number(value, digits=3):
    return "-" if value is None else f"{value:.{digits}g}" if abs(value) < 10 ** digits else f"{value:.0f}"


def percent(value):
    return "-" if value is None else number(100 * value) + " %"


def ratio(value):
    return "-" if value is None else number(value) + "x"


def table(title, columns, rows):
    if not rows:
        return []
    lines = [f"## {title}", "", "| " + " | ".join(columns) + " |", "|" + " --- |" * len(columns)]
    return lines + ["| " + " | ".join(row) + " |" for row in rows] + [""]


def head(bench, finished):
    machine = bench["machine"]
    drivers = sorted({r["driver"] for r in finished})
    runs = sorted({len(r["ms"]["runs"]) for r in finished})
    return [f"- Machine: {machine['processor']}, {machine['cores']} cores, {machine['memory'] / 2 ** 30:.1f} GiB, "
            f"{machine['system']}", *(f"- Driver: {driver}" for driver in drivers),
            f"- Commit: {bench['commit']}, {bench['date']}",
            f"- Medians of {' or '.join(map(str, runs))} runs; errors against exact", ""]


def profiles(curves):
    rows, speedups = [], defaultdict(dict)
    for setup, results in curves.items():
        by_name = {r["technique"]: r for r in results}
        exact = by_name["exact"]["ms"]["median"] if "exact" in by_name else None
        for profile in (p for p in PROFILES if p in by_name):
            r = by_name[profile]
            ms, error = r["ms"]["median"], r["errors"]["exact"]
            speedup = exact / ms if exact else None
            if speedup and r["scene"] in MEAN_SCENES:
                speedups[profile][setup] = speedup
            rows.append([setup, profile, number(exact), number(ms), ratio(speedup), percent(error["rrmse"]),
                         percent(error["p99"]), f"{r['bytes'] / 2 ** 20:.1f}"])
    for profile, values in speedups.items():
        mean = math.exp(sum(map(math.log, values.values())) / len(values))
        scenes = ", ".join(sorted({setup.split()[0] for setup in values}, key=MEAN_SCENES.index))
        rows.append([f"geometric mean: {scenes}", profile, "", "", ratio(mean), "", "", ""])
    return table("Profiles", ["setup", "profile", "exact ms", "ms", "speed-up", "rRMSE", "p99", "MiB"], rows)


def equal_error(bench):
    rows = []
    for r in bench.get("equal_error") or []:
        ms, error = r["ms"], r["rrmse"]
        best = "no one" if r["best_ms"] is None else f"{r['best']}, {number(r['best_ms'])} ms"
        rows.append([r["setup"], r["profile"], r["against"], number(ms), percent(error), best,
                     ratio(r["best_ms"] / ms if r["best_ms"] is not None else None),
                     "all are slower" if r["nearest_rrmse"] is None else f"{r['nearest']}, {percent(r['nearest_rrmse'])}",
                     ratio(r["nearest_rrmse"] / error if r["nearest_rrmse"] is not None and error else None)])
    return table("Speed at equal error", ["setup", "profile", "against", "ms", "rRMSE", "fastest with that rRMSE",
                                          "time", "least rRMSE in that time", "error"], rows)


def scaling(bench):
    rows = [[r["series"], r["technique"], ratio(r["range"]), number(r["first_ms"]), number(r["last_ms"]),
             ratio(r["last_ms"] / r["first_ms"]), f"{r['exponent']:.2f}"] for r in bench.get("scaling") or []]
    return table("Scaling", ["series", "technique", "range", "first ms", "last ms", "growth", "exponent"], rows)


def passes(curves):
    lines = []
    for setup, results in curves.items():
        for r in results:
            if r["technique"] != "high" or "floors" not in r:
                continue
            floors = r["floors"]
            rows = [[p["name"], number(p["ms"]), number(p["floor_ms"]), ratio(p["ms"] / p["floor_ms"])]
                    for p in floors["passes"]]
            rows.append(["sum", number(floors["ms"]), number(floors["floor_ms"]), ratio(floors["ratio"])])
            lines += table(f"Passes of high: {setup}", ["pass", "ms", "floor ms", "ratio"], rows)
    return lines


def beaten_by(result, results):
    """Names of those no slower and no less accurate, and better in one."""
    ms, error = result["ms"]["median"], result["errors"]["exact"]["rrmse"]
    names = []
    for other in results:
        other_ms, other_error = other["ms"]["median"], other["errors"]["exact"]["rrmse"]
        if other_error is None or error is None:
            continue
        if other_ms <= ms and other_error <= error and (other_ms < ms or other_error < error):
            names.append(other["technique"])
    return names


def pareto(curves):
    rows = []
    for setup, results in curves.items():
        by_name = {r["technique"]: r for r in results}
        for profile in (p for p in PROFILES if p in by_name):
            better = beaten_by(by_name[profile], results)
            rows.append([setup, profile, "no" if better else "yes", ", ".join(better)])
    return table("On the Pareto front of time and rRMSE", ["setup", "profile", "on it", "beaten by"], rows)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    bench = json.loads(Path(sys.argv[1]).read_text())
    finished = [r for r in bench["results"] if "ms" in r]
    curves = defaultdict(list)
    for r in finished:
        if r["series"] == "curve":
            curves[setup_of(r)].append(r)
    lines = head(bench, finished) + profiles(curves) + equal_error(bench) + scaling(bench) + passes(curves)
    print("\n".join(lines + pareto(curves)))


if __name__ == "__main__":
    main()
