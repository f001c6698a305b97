#!/usr/bin/python3
"""samples/viewer as a person has it: real keys and mouse (xdotool) on a real X server; every panel is looked at, a light and a view
are dragged, a state is saved and drawn by tyndall-render, a broken file and a drop leave what there is, sizes from tiny to large.

viewer_test.py VIEWER RENDER SCENES [PICTURES]      PICTURES: a folder for what is seen
"""
import json
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy
from PIL import Image

from drop import drop
from window import Window

PANEL = 380  # units of its width
TABS = {"Scene": 30, "Light": 77, "Medium": 129, "Settings": 190, "Cost": 246, "Compare": 298, "Save": 349}


class Viewer(Window):
    """The viewer, with xdotool's hands."""

    def __init__(self, command, pictures, told):
        """told: a file for what it reports."""
        self.pictures, self.told = pictures, told
        super().__init__([command[0], "--debug", *command[1:]], "Tyndall viewer", open(told, "w", encoding="utf-8"))

    def do(self, *words):
        subprocess.run(["xdotool", *map(str, words)], check=True)

    def move(self, x, y):
        self.do("mousemove", "--window", self.window, x, y)

    def click(self, x, y):
        self.move(x, y)
        self.do("click", 1)

    def drag(self, start, end, button=1):
        self.move(*start)
        self.do("mousedown", button)
        for step in range(1, 6):
            self.move(*(round(a + (b - a) * step / 5) for a, b in zip(start, end)))
            time.sleep(0.1)
        self.do("mouseup", button)

    def press(self, key):
        self.do("windowfocus", self.window)
        self.do("key", key)

    def write(self, text):
        self.do("windowfocus", self.window)
        self.do("key", "ctrl+a")
        self.do("type", "--delay", "20", text)
        self.do("key", "Return")

    def look(self, name):
        picture = self.picture()
        if self.pictures:
            Image.fromarray((picture * 255).astype("uint8")).save(self.pictures / f"{name}.png")
        return picture

    def still(self):
        """The picture once there is nothing left to do, and it has been shown."""
        def rests():
            states = [line for line in self.told.read_text().splitlines() if line in ("busy", "at rest")]
            return states and states[-1] == "at rest"
        time.sleep(0.4)
        self.wait("rest", rests)
        time.sleep(0.4)
        return self.picture()


def difference(a, b):
    return float(numpy.abs(a[:-40, PANEL:] - b[:-40, PANEL:]).mean())


def look_at_panels(viewer):
    seen = []
    for name, x in TABS.items():
        viewer.click(x, 18)
        before = seen[-1] if seen else None
        viewer.wait(f"panel {name}", lambda: before is None or numpy.abs(viewer.picture()[40:, :PANEL] - before).mean() > 0.002)
        time.sleep(1)
        seen.append(viewer.look(f"panel-{name}")[40:, :PANEL])
        assert (seen[-1].max(axis=2) > 0.5).mean() > 0.002, f"panel {name} is empty"
    plain = viewer.still()
    viewer.press("F1")
    viewer.wait("help", lambda: difference(viewer.picture(), plain) > 0.02)
    viewer.look("help")
    viewer.press("F1")
    viewer.wait("end of help", lambda: difference(viewer.picture(), plain) < 0.01)


def find_handle(picture):
    """A light's handle: pixels of its ring's colour."""
    ring = numpy.abs(picture[:, PANEL:] - numpy.array([255, 235, 160]) / 255).max(axis=2) < 0.03
    rows, columns = numpy.nonzero(ring[:-60])
    assert len(rows) > 10, "no handle in the picture"
    near = numpy.hypot(rows - rows[0], columns - columns[0]) < 26  # the highest one
    return PANEL + round(columns[near].mean()), round(rows[near].mean())


def drag_view_and_light(viewer):
    start = viewer.still()
    viewer.drag((900, 300), (960, 320))
    viewer.look("turned")
    viewer.wait("turned view", lambda: difference(start, viewer.picture()) > 0.01)
    moved = viewer.still()
    assert difference(start, moved) > 0.01, "the view does not turn"
    x, y = find_handle(moved)
    viewer.drag((x, y), (x + 40, y + 30))
    lit = viewer.still()
    viewer.look("dragged")
    assert difference(moved, lit) > 0.003, "the light does not move"
    viewer.press("ctrl+z")
    viewer.wait("undone drag", lambda: difference(moved, viewer.picture()) < 0.2 * difference(moved, lit))
    undone = viewer.still()
    print(f"view {difference(start, moved):.4f}, light {difference(moved, lit):.4f}, undone {difference(moved, undone):.4f}")
    assert difference(moved, undone) < 0.2 * difference(moved, lit), "the light is not put back"


def save_and_render(viewer, render, folder):
    state = folder / "state.json"
    viewer.press("ctrl+s")
    time.sleep(1)
    viewer.look("save")
    viewer.write(str(state))
    viewer.wait("state", state.exists)
    content = json.loads(state.read_text())
    assert content["version"] == 1 and "eye" in content["camera"], content
    subprocess.run([render, "--state", state, "--out", folder / "state.png"], check=True)
    viewer.press("h")  # the handles
    time.sleep(0.5)
    shown, drawn = viewer.still(), numpy.asarray(Image.open(folder / "state.png")) / 255
    viewer.press("h")
    area = numpy.s_[60:-60, PANEL + 40:-40]
    drawn = numpy.concatenate([numpy.zeros((drawn.shape[0], PANEL, 3)), drawn], axis=1)
    apart = numpy.abs(shown[area] - drawn[area]).max(axis=2)
    print(f"window and tyndall-render: at most {apart.max() * 255:.0f} of 255 apart")
    assert apart.max() < 1.5 / 255  # the window's curve is a shader's


def is_red(viewer):
    """Whether the line at the bottom tells of a mistake."""
    return (numpy.abs(viewer.picture()[-30:, PANEL:] - numpy.array([255, 140, 120]) / 255).max(axis=2) < 0.1).sum() > 30


def open_broken(viewer, folder, scenes):
    """By dialog, and dropped: a line says why, and the old scene stays. Then one that is whole is dropped."""
    before = viewer.still()
    broken = folder / "broken.glb"
    broken.write_text("glTF, but no more")
    viewer.press("ctrl+o")
    time.sleep(1)
    viewer.write(str(broken))
    viewer.wait("message", lambda: is_red(viewer))
    viewer.look("broken")
    assert difference(before, viewer.still()) < 0.001, "the old scene does not stay"
    missing = folder / "missing.json"
    missing.write_text(json.dumps({"version": 1, "scene": "gone.glb"}))
    drop(viewer.window, missing, 800, 400)
    time.sleep(1)
    viewer.wait("message of the state", lambda: is_red(viewer))
    assert difference(before, viewer.still()) < 0.001, "the old scene does not stay"
    drop(viewer.window, Path(scenes).resolve() / "projector.glb", 800, 400)
    viewer.wait("dropped scene", lambda: not is_red(viewer) and difference(before, viewer.picture()) > 0.02)
    viewer.still()
    viewer.look("dropped")


def compare(viewer):
    """A wipe between two ways, and a pixel looked at closely."""
    def is_edge(picture, x):
        return numpy.abs(numpy.median(picture[200:500, x - 1:x + 1], axis=(0, 1)) - numpy.array([255, 235, 160]) / 255).max() < 0.05

    viewer.click(TABS["Compare"], 18)
    one = viewer.still()
    viewer.click(17, 41)
    viewer.wait("wipe", lambda: difference(one, viewer.picture()) > 0.0005)
    middle = PANEL + 450
    assert is_edge(viewer.still(), middle), "no edge of the wipe in the middle"
    viewer.drag((middle, 600), (middle - 250, 600))
    wiped = viewer.still()
    viewer.look("wiped")
    assert is_edge(wiped, middle - 250), "the wipe is not dragged"
    viewer.press("m")
    viewer.move(middle, 400)
    viewer.wait("magnifier", lambda: difference(wiped, viewer.picture()) > 0.005)
    time.sleep(0.5)
    viewer.look("compare")
    viewer.press("m")
    viewer.press("ctrl+z")
    viewer.wait("end of the wipe", lambda: difference(one, viewer.picture()) < 0.0005)


def change_sizes(viewer):
    for width, height in ((320, 200), (3840, 2160), (1280, 720)):
        viewer.resize(width, height)
        viewer.wait("size", lambda: viewer.picture().shape[:2] == (height, width))
        left = min(PANEL, round(0.6 * width)) + 4
        viewer.wait("picture", lambda: viewer.picture()[10:-60, left:].mean() > 0.02)
        time.sleep(0.5)
        viewer.look(f"size-{width}x{height}")


def rest(viewer):
    """Nothing is done once the error is known."""
    def ticks():
        fields = Path(f"/proc/{viewer.process.pid}/stat").read_text().rsplit(")", 1)[1].split()
        return int(fields[11]) + int(fields[12])
    viewer.wait("rest", lambda: [ticks(), time.sleep(2)][0] == ticks())


def refused(program, without=None, **more):
    """It says on the terminal why there is no window, and ends."""
    environment = {**{key: value for key, value in os.environ.items() if key != without}, **more}
    ended = subprocess.run([program], env=environment, capture_output=True, text=True, check=False)
    print(ended.stderr.strip())
    assert ended.returncode == 1 and re.fullmatch(r"tyndall-viewer: no window.*\n", ended.stderr), ended


def main():
    program, render, scenes = sys.argv[1:4]
    pictures = Path(sys.argv[4]) if len(sys.argv) > 4 else None
    if pictures:
        pictures.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        os.environ["XDG_CONFIG_HOME"] = name
        start = folder / "start.json"
        start.write_text(json.dumps({"version": 1, "scene": f"{Path(scenes).resolve()}/stage.glb", "profile": "performance",
                                     "maps": {"shadowSize": 512}}))
        with Viewer([program, start], pictures, folder / "told.txt") as viewer:
            viewer.wait("picture", lambda: viewer.picture()[:, PANEL:].mean() > 0.05)
            look_at_panels(viewer)
            drag_view_and_light(viewer)
            save_and_render(viewer, render, folder)
            compare(viewer)
            open_broken(viewer, folder, scenes)
            change_sizes(viewer)
            rest(viewer)
            viewer.press("ctrl+q")
            assert viewer.exit_status() == 0
        strange = [line for line in (folder / "told.txt").read_text().splitlines()
                   if line not in ("busy", "at rest") and not line.startswith("said: ")]
        assert not strange, "\n".join(strange)
        with Viewer([program, f"{scenes}/forest.glb"], pictures, folder / "closed.txt") as viewer:  # closed while it loads
            viewer.press("ctrl+q")
            assert viewer.exit_status() == 0
    refused(program, without="DISPLAY")
    refused(program, MESA_GL_VERSION_OVERRIDE="2.1")


if __name__ == "__main__":
    main()
