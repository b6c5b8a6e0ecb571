"""Colours, in linear RGB: a ramp for distances, a colour for each cell."""

import numpy as np


def _linear(hexes):
    srgb = np.array([[int(text[i : i + 2], 16) / 255 for i in (0, 2, 4)] for text in hexes.split()])
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


#: From the sources, light, to the farthest place, dark.
RAMP = _linear("fff1d6 fdc98d f98e6b d9587a 973d8b 352a75")
#: What no source reaches.
UNREACHED = _linear("8a8d94")[0]

_CELLS = _linear("e8a33d 3f7fb5 d9587a 4ea394 8d5fa8 c7ce5c e2704a 5b6bb8 f2c9a0 7fb069 b04f6f 6fb7d6")


def ramp(shares):
    """The colours of numbers in [0, 1]: (n, 3)."""
    stops = np.linspace(0, 1, len(RAMP))
    return np.stack([np.interp(shares, stops, RAMP[:, channel]) for channel in range(3)], axis=1)


def cell(number):
    """The colour of a cell: twelve that differ, and then darker ones, round and round."""
    turn, place = divmod(number, len(_CELLS))
    return _CELLS[place] * (1.0, 0.6, 0.35)[turn % 3]
