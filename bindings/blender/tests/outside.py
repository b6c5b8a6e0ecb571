"""Evaluates an expression with the Python package outside Blender: outside.py EXPRESSION IN.npz OUT.npy

The arrays of IN.npz are variables of the expression, beside `taut` and `np`; where it raises an error of the library, OUT.npy
holds its message.
"""

import sys

import numpy as np
import taut

expression, given, out = sys.argv[1:]
try:
    result = eval(expression, {"taut": taut, "np": np, **np.load(given)})
except taut.Error as error:
    result = str(error)
np.save(out, result)
