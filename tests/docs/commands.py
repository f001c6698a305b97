#!/usr/bin/python3
"""Runs every block of commands (```sh, ```bash) of every page, from top to bottom, in a copy of the project of its own.

commands.py [--root DIR] [--build DIR] [--slow] [PAGE...]

Each page gets a fresh copy in which build/ is a link to the build of --build. A block under <!-- slow: 4 min --> runs with --slow
only; the run says which it left out. Exit status 1 if a block failed.
"""
import argparse
import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from pages import NOT_OURS, Page, pages

SHELLS = {"sh": ["sh", "-eu"], "bash": ["bash", "-eu", "-o", "pipefail"]}
LONG = 120  # seconds after which a block should be marked as slow


def copy_project(root, build, folder):
    """Without what is built; `folder` must not exist."""
    shutil.copytree(root, folder, symlinks=True, ignore=lambda _, names: [n for n in names if NOT_OURS.match(n)])
    if build:
        (folder / "build").symlink_to(build)


def run_block(block, folder, cache):
    """Exit status, seconds, what it printed."""
    begin = time.monotonic()
    done = subprocess.run(SHELLS[block.language] + ["-c", block.text], cwd=folder, stdin=subprocess.DEVNULL,
                          env={**os.environ, "XDG_CACHE_HOME": str(cache)}, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, errors="replace", check=False)
    return done.returncode, time.monotonic() - begin, done.stdout


def run_page(page, name, folder, cache, slow):
    """Names of the blocks that failed and that were left out."""
    failed, left = [], []
    for block in page.blocks:
        if block.language not in SHELLS:
            continue
        place = f"{name}:{block.line}"
        if block.slow and not slow:
            left.append(f"{place} ({block.slow})")
            continue
        status, seconds, output = run_block(block, folder, cache)
        note = "" if block.slow or seconds < LONG else ": long, mark it as slow if it always is"
        print(f"{'ok    ' if status == 0 else 'FAILED'} {place} {seconds:.1f} s{note}", flush=True)
        if status != 0:
            failed.append(place)
            print("".join("    " + line + "\n" for line in block.text.splitlines()))
            print("".join("  | " + line + "\n" for line in output.splitlines()[-20:]), end="")
            print(f"  exit status {status}", flush=True)
    return failed, left


def main():
    parser = argparse.ArgumentParser(description="Runs every block of commands of every page.")
    parser.add_argument("--root", type=Path, default=Path(__file__).resolve().parents[2])
    parser.add_argument("--build", type=Path, help="the build that pages find as build/")
    parser.add_argument("--slow", action="store_true", help="also blocks that are marked as slow")
    parser.add_argument("pages", nargs="*", metavar="PAGE", help="such as samples/README.md; all if none is named")
    given = parser.parse_args()
    root, build = given.root.resolve(), given.build and given.build.resolve()
    chosen = [root / page for page in given.pages] or pages(root)
    failed, left = [], []
    with tempfile.TemporaryDirectory(prefix="tyndall-pages-") as scratch:
        for number, path in enumerate(chosen):
            folder = Path(scratch) / str(number)
            copy_project(root, build, folder)
            more = run_page(Page(path), path.relative_to(root), folder, Path(scratch) / "cache", given.slow)
            failed += more[0]
            left += more[1]
            shutil.rmtree(folder)
    for place in left:
        print(f"left out: {place}")
    print(f"{len(chosen)} pages, {len(failed)} blocks failed, {len(left)} left out" + (" (--slow runs them)" if left else ""))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
