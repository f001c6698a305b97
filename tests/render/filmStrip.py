#!/usr/bin/python3
"""Puts frames side by side, and below each the tiles that were drawn anew (--view redrawn) over the dimmed picture; or, with
--rows, in so many rows as they are, no wider than 2400 pixels.

filmStrip.py OUT.jpg FRAME.png... MASK.png...      as many masks as frames
filmStrip.py OUT.jpg --rows N IMAGE.png...         images of one size, row by row
"""
import sys

import numpy
from PIL import Image

out, *paths = sys.argv[1:]
rows = 2
plain = paths[:1] == ["--rows"]
if plain:
    rows, paths = int(paths[1]), paths[2:]
if len(paths) < rows or len(paths) % rows:
    sys.exit("filmStrip.py: " + ("as many images in each row" if plain else "as many masks as frames") + ", please")
images = [numpy.asarray(Image.open(path).convert("RGB"), dtype=float) for path in paths]
across = len(images) // rows
if not plain:
    images[across:] = [0.35 * f + 0.65 * m * [1, 0.25, 0.1] for f, m in zip(images, images[across:])]
strip = numpy.vstack([numpy.hstack(images[across * row : across * (row + 1)]) for row in range(rows)])
result = Image.fromarray(strip.clip(0, 255).astype("uint8"))
if plain and result.width > 2400:
    result = result.resize((2400, round(result.height * 2400 / result.width)))
result.save(out, quality=88)
