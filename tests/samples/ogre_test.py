#!/usr/bin/python3
"""samples/ogre on an X server.

ogre_test.py PROGRAM window       what a user sees: shafts in both viewports, another size, Space, Escape
ogre_test.py PROGRAM exact        the shafts against Technique::Exact, on the same maps; what reuse keeps against a frame in full
ogre_test.py PROGRAM identical    OGRE's own picture, frame by frame, is what it is without the effect
"""
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy

from window import Window

SMALL = ["--width", "320", "--height", "180"]


def run(program, *options):
    done = subprocess.run([program, *SMALL, *map(str, options)], check=True, stdout=subprocess.PIPE, text=True)
    print(" ".join(map(str, options)), "->", done.stdout.strip())
    return done.stdout


def inscatter(path):
    with open(path, "rb") as file:
        width, height = map(int, file.readline().split())
        return numpy.frombuffer(file.read(), numpy.float32).reshape(height, width, 4)[..., :3].astype(float)


def test_exact(program, folder):
    frames = 12
    shafts, full, exact = (folder / name for name in ("shafts", "full", "exact"))
    redrawn = run(program, "--frames", frames, "--inscatter", shafts)
    run(program, "--frames", frames, "--inscatter", full, "--no-reuse")
    run(program, "--frames", frames, "--inscatter", exact, "--exact")
    got, wanted = inscatter(shafts), inscatter(exact)
    error = numpy.sqrt(((got - wanted) ** 2).mean()) / wanted.mean()
    print(f"rRMSE against exact {error:.4f}")
    assert wanted.mean() > 0.01 and wanted.std() > 0.2 * wanted.mean(), "no shafts to compare"
    assert error < 0.024, error  # that of profile high on the nave
    assert (got == inscatter(full)).all(), "what reuse kept is not what the frame in full has"
    assert float(redrawn.split()[-1]) < 0.3, "nothing was kept of the last frame"


def test_identical(program, folder):
    frames = 100
    lines = {}
    for mode in ("off", "outputs", "shafts"):
        run(program, "--frames", frames, "--viewports", 2, "--mode", mode, "--digests", folder / mode)
        lines[mode] = (folder / mode).read_text(encoding="utf-8").splitlines()
        assert len(lines[mode]) == frames
    assert len(set(lines["off"])) == frames, "nothing moves"
    assert lines["outputs"] == lines["off"], "OGRE's own picture has changed"
    assert not set(lines["shafts"]) & set(lines["off"]), "the shafts are not in OGRE's picture"


def test_window(program, _):
    with Window([program, "--viewports", "2", "--width", "640", "--height", "240"], "Tyndall in OGRE") as window:
        window.wait("picture", lambda: window.picture()[:, :310].mean() > 0.1 and window.picture()[:, 330:].mean() > 0.1)
        shafts = window.picture()
        window.key("space", True)
        window.wait("picture without shafts", lambda: window.picture().mean() < 0.85 * shafts.mean())
        without = window.picture()
        window.key("space", False)
        window.wait("picture with shafts", lambda: window.picture().mean() > 0.9 * shafts.mean())
        for half in (numpy.s_[:, :320], numpy.s_[:, 320:]):
            light = (shafts - without)[half]
            print(f"light {light.mean():.3f} +- {light.std():.3f}")
            assert light.mean() > 0.02 and light.std() > 0.02
        window.resize(900, 400)
        window.wait("larger picture", lambda: window.picture().shape == (400, 900, 3) and window.picture()[-40:, -60:].mean() > 0.05)
        assert abs(window.picture().mean() - shafts.mean()) < 0.2 * shafts.mean()
        window.key("Escape", True)
        assert window.exit_status() == 0


def main():
    program, name = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        {"window": test_window, "exact": test_exact, "identical": test_identical}[name](program, Path(folder))


if __name__ == "__main__":
    main()
