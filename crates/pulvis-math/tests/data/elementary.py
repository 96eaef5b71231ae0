"""Reference values of the elementary functions: python3 elementary.py > elementary.csv

Each value is the sum of two doubles, the nearest one and what it leaves, from 60 digits of mpmath. Arguments are
random over the range in which simulations call the function, and near the places where it is hard to compute.
"""

import random

import mpmath as mp

mp.mp.dps = 60
DRAW = random.Random(20261126)
POINTS = 25


def between(low, high):
    return lambda: DRAW.uniform(low, high)


def decades(low, high, signed=False):
    sign = (lambda: DRAW.choice([-1.0, 1.0])) if signed else (lambda: 1.0)
    return lambda: sign() * 10.0 ** DRAW.uniform(low, high)


ANGLES = [0.5, 1.0, 3.141592653589793, 1.5707963267948966, 6.283185307179586, 355.0, 1e5, 6381956970095103.0 * 2.0**797]
FUNCTIONS = {
    "sin": (mp.sin, [between(-7, 7), decades(-8, 6, True)], ANGLES),
    "cos": (mp.cos, [between(-7, 7), decades(-8, 6, True)], ANGLES),
    "tan": (mp.tan, [between(-7, 7), decades(-8, 6, True)], ANGLES),
    "asin": (mp.asin, [between(-1, 1)], [1.0, -1.0, 0.5, 0.9999999999999999, 1e-9]),
    "acos": (mp.acos, [between(-1, 1)], [-1.0, 0.5, 0.9999999999999999, 1e-9]),
    "atan": (mp.atan, [between(-5, 5), decades(-8, 8, True)], [1.0]),
    "sinh": (mp.sinh, [between(-20, 20), decades(-8, 0, True)], [1.0]),
    "cosh": (mp.cosh, [between(-20, 20), decades(-8, 0, True)], [1.0]),
    "tanh": (mp.tanh, [between(-20, 20), decades(-8, 0, True)], [1.0, 0.2]),
    "asinh": (mp.asinh, [between(-20, 20), decades(-8, 8, True)], [1.0, 0.3]),
    "exp": (mp.exp, [between(-20, 20), between(-700, 700)], [1.0, -1.0, 1e-12]),
    "exp_m1": (mp.expm1, [between(-20, 20), decades(-12, 0, True)], [1.0, -1e-9]),
    "ln": (mp.log, [between(0.5, 2), decades(-300, 300)], [0.9999999999999999, 1.0000000000000002, 0.8]),
    "ln_1p": (mp.log1p, [between(-0.9, 5), decades(-12, 12)], [1.0, -1e-9]),
    "log10": (mp.log10, [between(0.5, 2), decades(-300, 300)], [2.0, 0.9999999999999999]),
    "cbrt": (mp.cbrt, [decades(-300, 300)], [2.0, 0.5]),
}
OF_TWO = {
    "atan2": (mp.atan2, [(between(-5, 5), between(-5, 5)), (decades(-9, 9, True), decades(-9, 9, True))]),
    "hypot": (mp.hypot, [(between(-5, 5), between(-5, 5)), (decades(-9, 9, True), decades(-9, 9, True))]),
    "powf": (
        lambda x, y: mp.mpf(x) ** mp.mpf(y),
        [
            (decades(-12, 0), lambda: 1.0 / 3.0),
            (decades(-12, 0), lambda: DRAW.choice([0.25, 1.5, 0.2, 2.5])),
            (between(0.9, 1.1), between(-500, 500)),
            (decades(-8, 8), between(-20, 20)),
        ],
    ),
}


def row(name, arguments, value):
    nearest = float(value)
    rest = float(value - mp.mpf(nearest))
    print(",".join([name] + [repr(float(a)) for a in arguments] + ([""] if len(arguments) == 1 else []) + [repr(nearest), repr(rest)]))


print("function,x,y,nearest,rest")
for name, (exact, draws, special) in FUNCTIONS.items():
    for x in special + [draw() for draw in draws for _ in range(POINTS)]:
        row(name, [x], exact(mp.mpf(x)))
for name, (exact, draws) in OF_TWO.items():
    for draw_x, draw_y in draws:
        for _ in range(POINTS):
            x, y = draw_x(), draw_y()
            row(name, [x, y], exact(mp.mpf(x), mp.mpf(y)))
