#!/usr/bin/python3
"""Puts frames side by side, and below each the tiles that were drawn anew (--view redrawn) over the dimmed picture.

filmStrip.py OUT.jpg FRAME.png... MASK.png...      as many masks as frames
"""
import sys

import numpy
from PIL import Image

out, *paths = sys.argv[1:]
if len(paths) < 2 or len(paths) % 2:
    sys.exit("filmStrip.py: as many masks as frames, please")
images = [numpy.asarray(Image.open(path).convert("RGB"), dtype=float) for path in paths]
frames, masks = images[: len(images) // 2], images[len(images) // 2 :]
marked = [0.35 * frame + 0.65 * mask * [1, 0.25, 0.1] for frame, mask in zip(frames, masks)]
strip = numpy.vstack([numpy.hstack(frames), numpy.hstack(marked)])
Image.fromarray(strip.clip(0, 255).astype("uint8")).save(out, quality=88)
