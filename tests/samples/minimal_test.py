#!/usr/bin/python3
"""samples/minimal as a user sees it: shafts, that move; none while Space is down; another size; Escape.

minimal_test.py PROGRAM [PICTURE]      PICTURE: a file for the first
"""
import sys
import time

import numpy
from PIL import Image

from window import Window


def brightness(picture):
    return picture.mean(axis=2)


def main():
    with Window([sys.argv[1]], "Tyndall") as window:
        window.wait("picture", lambda: window.picture().mean() > 0.05)
        if len(sys.argv) > 2:
            Image.fromarray((window.picture() * 255).astype("uint8")).save(sys.argv[2])
        shafts = brightness(window.picture())
        assert shafts.shape == (360, 640), shafts.shape

        window.key("space", True)
        window.wait("picture without shafts", lambda: window.picture().mean() < 0.6 * shafts.mean())
        without = brightness(window.picture())
        window.key("space", False)
        window.wait("picture with shafts", lambda: window.picture().mean() > 0.9 * shafts.mean())

        # The back wall, which is dim and even: the shafts before it are not.
        wall = numpy.s_[125:205, 250:400]
        light = (shafts - without)[wall].mean(axis=0)
        print(f"wall: without shafts {without[wall].mean():.3f} +- {without[wall].std():.3f}, light {light.min():.3f} to {light.max():.3f}")
        assert without[wall].std() < 0.01
        assert light.min() > 0.02 and light.max() > 1.4 * light.min(), light

        first = window.picture()
        time.sleep(1)
        assert numpy.abs(window.picture() - first).max() > 0.1, "nothing moves"

        window.resize(900, 480)
        window.wait("larger picture", lambda: window.picture().shape == (480, 900, 3) and brightness(window.picture())[-20:, -20:].mean() > 0.05)
        assert abs(window.picture().mean() - shafts.mean()) < 0.15 * shafts.mean()

        window.key("Escape", True)
        assert window.exit_status() == 0


if __name__ == "__main__":
    main()
