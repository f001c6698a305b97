#!/usr/bin/env python3
"""compare.py FOLDER OTHER...: how pictures of tyndall-stress --pictures differ from those of the first folder.

Prints a table: of each run the pictures that are the same bit for bit, and of the others the root mean square error over
the mean, in classes. Exit code 1 if the folders hold other frames.
"""
import array
import collections
import math
import os
import sys

CLASSES = (1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.05)


def read(path):
    values = array.array("f")
    with open(path, "rb") as file:
        values.frombytes(file.read())
    return values


def error(a, b):
    """rRMSE of b beside a; what is infinitesimal beside the largest value counts as nothing."""
    mean = sum(a) / len(a)
    scale = max(mean, 1e-6 * max(a, default=0.0), 1e-30)
    return math.sqrt(sum((x - y) ** 2 for x, y in zip(a, b)) / len(a)) / scale


def main(folders):
    if len(folders) < 2:
        sys.exit(__doc__)
    names = sorted(os.listdir(folders[0]))
    print("| beside " + os.path.basename(os.path.normpath(folders[0])) + " | run | bit for bit | "
          + " | ".join(f"<= {limit:g}" for limit in CLASSES) + " | more | worst |")
    print("|---" * (len(CLASSES) + 5) + "|")
    for folder in folders[1:]:
        if sorted(os.listdir(folder)) != names:
            sys.exit(f"{folder}: has other frames than {folders[0]}")
        same, classes, worst = collections.Counter(), collections.defaultdict(collections.Counter), {}
        for name in names:
            run = name[:-4].split("-", 1)[1]
            a, b = read(os.path.join(folders[0], name)), read(os.path.join(folder, name))
            if a == b:
                same[run] += 1
                continue
            e = error(a, b)
            classes[run][next((i for i, limit in enumerate(CLASSES) if e <= limit), len(CLASSES))] += 1
            worst[run] = max(worst.get(run, (0, "")), (e, name.split("-")[0]))
        for run in sorted(set(same) | set(classes)):
            e, seed = worst.get(run, (0, ""))
            print(f"| {os.path.basename(os.path.normpath(folder))} | {run} | {same[run]} | "
                  + " | ".join(str(classes[run][i]) for i in range(len(CLASSES) + 1))
                  + f" | {e:.2g}" + (f" (seed {seed})" if seed else "") + " |")


if __name__ == "__main__":
    main(sys.argv[1:])
