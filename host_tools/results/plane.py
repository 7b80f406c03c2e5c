# SPDX-License-Identifier: MIT
"""Steady running over speed and torque, the map of `sdre-sil qualify`, as recorded figures.

A point is a list: speed [rad/s] and torque [N m], then v_q [V], v_d [V] and speed [rad/s] rms. The
three are there without noise first, then on the board. `limits` has six in this order; zero: none.
"""

KINDS = ("ideal", "board")
QUANTITIES = {"vq": "vq_V", "vd": "vd_V", "speed": "speed_e_radps"}
COLUMNS = [(kind, name) for kind in KINDS for name in QUANTITIES]
FIRST = 2  # of COLUMNS in a point
DIGITS = 4


def rounded(value):
    return float(f"{value:.{DIGITS}g}")


def recorded(found):
    """The figures that are kept of qualify's JSON."""
    points = [
        [
            rounded(x)
            for x in (
                point["speed_e_radps"],
                point["torque_Nm"],
                *(point[kind][QUANTITIES[name]] for kind, name in COLUMNS),
            )
        ]
        for point in found["points"]
    ]
    limits = [rounded(found[f"{kind}_limit"][QUANTITIES[name]]) for kind, name in COLUMNS]
    plane = {"limits": limits, "points": points}
    worst = {f"{kind}_{name}": largest(plane, kind, name)[0] for kind, name in COLUMNS}
    shares = {f"{kind}_within": within(plane, kind) for kind in KINDS}
    return {"plane": plane, "worst": worst | shares}


def column(plane, kind, name):
    """The values of all points, and their limit."""
    at = COLUMNS.index((kind, name))
    return [point[FIRST + at] for point in plane["points"]], plane["limits"][at]


def largest(plane, kind, name):
    """The largest value, and the point that has it."""
    values, _ = column(plane, kind, name)
    worst = max(range(len(values)), key=values.__getitem__)
    return values[worst], plane["points"][worst]


def within(plane, kind):
    """Share of the points that keep every limit [%]."""
    columns = [column(plane, kind, name) for name in QUANTITIES]
    good = sum(
        all(values[i] <= limit for values, limit in columns if limit > 0)
        for i in range(len(plane["points"]))
    )
    return 100 * good / len(plane["points"])


def fields(plane):
    """Named values of a cell."""
    found = {f"{kind}_within": within(plane, kind) for kind in KINDS}
    for kind, name in COLUMNS:
        value, point = largest(plane, kind, name)
        found[f"{kind}_{name}"] = value
        found[f"{kind}_{name}_at"] = f"{point[0]:.0f} rad/s, {point[1]:.1f} N m"
        found[f"{kind}_{name}_most"] = column(plane, kind, name)[1]
    return found
