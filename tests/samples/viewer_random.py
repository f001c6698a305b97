#!/usr/bin/python3
"""Random keys, clicks, drags, sizes and files for samples/viewer, from a seed, on a real X server. It must live on, report no
OpenGL error and no setting out of range, keep its memory bounded, and end with exit status 0.

viewer_random.py VIEWER RENDER SCENES [--events N] [--seed S]
"""
import argparse
import contextlib
import json
import os
import random
import subprocess
import tempfile
import time
from pathlib import Path

from viewer_test import PANEL, TABS, Viewer

KEYS = ["Tab", "f", "p", "b", "m", "h", "1", "2", "Left", "Right", "F1", "Escape", "w", "a", "s", "d", "q", "e", "ctrl+z", "ctrl+y",
        "ctrl+o", "ctrl+s", "BackSpace", "0", "minus", "period"]
SIZES = [(320, 200), (640, 480), (1280, 720), (900, 300), (160, 160), (1500, 1000)]
MEMORY = 1 << 20  # KiB that it may grow by after its first third


class Player:
    """Makes xdotool's commands, a batch at a time."""

    def __init__(self, viewer, seed):
        self.viewer, self.random = viewer, random.Random(seed)
        self.size = (1280, 720)

    def point(self):
        width, height = self.size
        panel = self.random.random() < 0.6
        x = self.random.randrange(min(PANEL, width)) if panel else self.random.randrange(width)
        return x, self.random.randrange(height)

    def move(self):
        return f"mousemove --window {self.viewer.window} {' '.join(map(str, self.point()))}"

    def event(self):
        r = self.random
        kind = r.choices(["click", "drag", "key", "wheel", "tab", "hold"], [40, 25, 20, 8, 5, 2])[0]
        if kind == "click":
            return [self.move(), f"click {r.choice([1, 1, 1, 1, 3])}"]
        if kind == "drag":
            button = r.choice([1, 1, 1, 2, 3])
            return [self.move(), f"mousedown {button}", self.move(), "sleep 0.03", self.move(), f"mouseup {button}"]
        if kind == "wheel":
            return [self.move(), f"click {r.choice([4, 5])}"]
        if kind == "tab":
            return [f"mousemove --window {self.viewer.window} {r.choice(list(TABS.values()))} 18", "click 1"]
        if kind == "hold":
            key = r.choice("wasdqe")
            return [f"keydown {key}", "sleep 0.2", f"keyup {key}"]
        return [f"key {r.choice(KEYS)}"]

    def play(self, count):
        lines = [f"windowfocus {self.viewer.window}"]
        for _ in range(count):
            lines += self.event() + ["sleep 0.02"]
        subprocess.run(["xdotool", "-"], input="\n".join(lines) + "\n", text=True, check=True)

    def resize(self):
        self.size = self.random.choice(SIZES)
        self.viewer.resize(*self.size)

    def calm(self):
        """Without a dialog, a text that is being typed, or help."""
        for _ in range(3):
            self.viewer.press("Escape")

    def open(self, file):
        self.calm()
        self.viewer.press("ctrl+o")
        time.sleep(0.3)
        self.viewer.write(str(file))

    def save(self, file):
        self.calm()
        self.viewer.press("ctrl+s")
        time.sleep(0.3)
        self.viewer.write(str(file))


def undo_text(player):
    """A name that is typed, another one in its place, and the first one's changes taken back."""
    viewer = player.viewer
    for name in ("a-name-that-is-longer.json", "b"):
        viewer.press("ctrl+s")
        time.sleep(0.3)
        viewer.do("key", "ctrl+a")
        viewer.do("type", "--delay", "20", name)
        for key in ("BackSpace", "BackSpace", "ctrl+z", "ctrl+z", "ctrl+z", "ctrl+y", "ctrl+y", "ctrl+z"):
            viewer.do("key", key)
        viewer.do("type", "--delay", "20", name)
        viewer.press("Escape")
        time.sleep(0.2)
    player.calm()


def memory(process):
    fields = Path(f"/proc/{process.pid}/status").read_text().split()
    return int(fields[fields.index("VmRSS:") + 1])


def check_state(render, file, scenes):
    """A state that was saved is one that tyndall-render takes, whatever was done to it."""
    state = json.loads(file.read_text())
    state["picture"].update(width=16, height=16, supersample=1, msaa=1)
    state["maps"]["shadowSize"] = 32
    state["scene"] = str(scenes / "projector.glb")  # small
    state["camera"] = {"eye": [0, 1, 3], "target": [0, 1, 0]}
    small = file.with_suffix(".small.json")
    small.write_text(json.dumps(state))
    command = [render, "--state", small, "--out", file.with_suffix(".png")]
    drawn = subprocess.run(command, capture_output=True, text=True, check=False)
    assert drawn.returncode == 0, f"a saved state is refused: {drawn.stderr}"


@contextlib.contextmanager
def telling(told):
    """What the viewer reported is printed where anything goes wrong."""
    try:
        yield
    except BaseException:
        lines = [line for line in told.read_text(errors="replace").splitlines() if line not in ("busy", "at rest")]
        print("\n".join(["the viewer reported:", *lines[-80:]]), flush=True)
        raise


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("viewer")
    parser.add_argument("render")
    parser.add_argument("scenes", type=Path)
    parser.add_argument("--events", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    viewer_path, render, scenes = str(Path(options.viewer).resolve()), str(Path(options.render).resolve()), options.scenes.resolve()
    files = [scenes / f"{name}.glb" for name in ("projector", "cage", "pendulum", "smoke", "stage", "nave-glass")]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) / "a/b/c/d/e/f"  # from which no click comes far
        folder.mkdir(parents=True)
        os.environ["XDG_CONFIG_HOME"] = name
        os.chdir(folder)
        broken = folder / "broken.glb"
        broken.write_bytes(files[0].read_bytes()[:5000])
        start = folder / "start.json"
        start.write_text(json.dumps({"version": 1, "scene": str(files[0]), "maps": {"shadowSize": 256},
                                     "profile": "performance", "picture": {"exposureStops": 0}}))
        told = folder / "told.txt"
        with telling(told), Viewer([viewer_path, str(start)], None, told) as viewer:
            viewer.wait("picture", lambda: viewer.picture()[:, PANEL:].mean() > 0.01)
            player = Player(viewer, options.seed)
            undo_text(player)
            batch, begin, early, most = 50, time.monotonic(), 0, 0
            for number in range(0, options.events, batch):
                player.play(min(batch, options.events - number))
                assert viewer.process.poll() is None, f"it has ended with {viewer.process.returncode}"
                choice = player.random.random()
                if choice < 0.2:
                    player.resize()
                elif choice < 0.35:
                    player.open(player.random.choice([*files, broken, folder / "none.glb"]))
                elif choice < 0.55:
                    state = folder / f"state-{number}.json"
                    player.save(state)
                    time.sleep(1)
                    if state.exists():  # not while nothing is loaded, or hidden under another dialog
                        check_state(render, state, scenes)
                elif choice < 0.6:
                    player.open(start)
                used = memory(viewer.process)
                if number < options.events / 3:
                    early = max(early, used)
                most = max(most, used)
                if number % 500 == 0:
                    print(f"{number} events, {time.monotonic() - begin:.0f} s, {used / 1024:.0f} MiB", flush=True)
            assert most < early + MEMORY, f"{early} KiB in the first third, {most} KiB at most"
            viewer.resize(640, 480)
            player.calm()
            viewer.do("windowfocus", viewer.window)
            viewer.press("ctrl+q")
            status = viewer.exit_status()
        lines = [line for line in told.read_text().splitlines() if line not in ("busy", "at rest")]
        said = [line for line in lines if line.startswith("said: ")]
        lines = [line for line in lines if line not in said]
        rules = [line for line in said if "must be" in line and ".glb" not in line]
        print(f"{options.events} events, seed {options.seed}: exit status {status}, at most {most / 1024:.0f} MiB, "
              f"{len(said)} mistakes told")
        assert not lines, "on standard error:\n" + "\n".join(lines[:60])
        assert not rules, "a setting was out of range:\n" + "\n".join(rules)
        assert status == 0


if __name__ == "__main__":
    main()
