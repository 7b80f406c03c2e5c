# SPDX-License-Identifier: MIT
"""The map of plane.py as SVG: a panel for each quantity, without noise on the left and on the board
on the right. The colour is the logarithm of the share of the limit."""

import math

from plane import column

TITLES = {
    ("ideal", "vq"): "v_q, without noise",
    ("board", "vq"): "v_q, on the board",
    ("ideal", "vd"): "v_d, without noise",
    ("board", "vd"): "v_d, on the board",
    ("ideal", "speed"): "speed, without noise",
}
UNITS = {"vq": "V", "vd": "V", "speed": "rad/s"}
PANEL = (300, 190)  # width and height of the plane itself
PITCH = (400, 270)
ORIGIN = (56, 34)
DECADES = 3  # of colours below the limit
STOPS = ((255, 255, 217), (127, 205, 187), (29, 145, 192), (8, 29, 88))  # chosen: light is little
BEYOND = "#d7301f"
SCALE_STEPS = 40


def colour(share):
    """The fill of a cell with this share of the limit."""
    if not share <= 1:
        return BEYOND
    place = 1 + math.log10(max(share, 10**-DECADES)) / DECADES
    part = place * (len(STOPS) - 1)
    first = min(int(part), len(STOPS) - 2)
    mixed = (
        a + (part - first) * (b - a) for a, b in zip(STOPS[first], STOPS[first + 1], strict=True)
    )
    return "#" + "".join(f"{round(x):02x}" for x in mixed)


def rectangle(left, top, right, bottom, fill):
    """Whole corners: neighbours leave no gap."""
    x, y = round(left), round(top)
    size = f'width="{round(right) - x}" height="{round(bottom) - y}"'
    return f'<rect x="{x}" y="{y}" {size} fill="{fill}"/>'


def text(x, y, words, anchor="start", more=""):
    return f'<text x="{round(x)}" y="{round(y)}" text-anchor="{anchor}"{more}>{words}</text>'


def edges(places):
    """Borders between neighbours; the first and the last place are borders themselves."""
    inner = [(a + b) / 2 for a, b in zip(places, places[1:], strict=False)]
    return [places[0], *inner, places[-1]]


def panel(plane, kind, name, x0, y0):
    """One quantity over torque (across) and speed (upwards)."""
    values, limit = column(plane, kind, name)
    points = plane["points"]
    side = math.isqrt(len(points))
    speeds = edges([point[0] for point in points[::side]])
    most_Nm = max(abs(point[1]) for point in points)
    width, height = PANEL

    def across(torque):
        return x0 + width * (torque + most_Nm) / (2 * most_Nm)

    def up(speed):
        return y0 + height * (1 - speed / speeds[-1])

    lines = [
        text(x0, y0 - 10, f"{TITLES[kind, name]}: rms, at most {limit:.3g} {UNITS[name]}"),
        rectangle(x0, y0, x0 + width, y0 + height, "#eee"),
    ]
    for i in range(side):
        row = points[i * side : (i + 1) * side]
        at = [across(x) for x in edges([point[1] for point in row])]
        top, bottom = up(speeds[i + 1]), up(speeds[i])
        for j in range(side):
            fill = colour(values[i * side + j] / limit)
            lines.append(rectangle(at[j], top, at[j + 1], bottom, fill))
    for speed in (points[0][0], points[len(points) // 2][0], points[-1][0]):
        lines.append(text(x0 - 6, up(speed) + 4, f"{speed:.0f}", "end"))
    for torque in (-most_Nm, 0, most_Nm):
        lines.append(text(across(torque), y0 + height + 16, f"{torque:.3g}", "middle"))
    lines.append(text(x0 + width / 2, y0 + height + 32, "torque [N m]", "middle"))
    turned = f' transform="rotate(-90 {x0 - 40} {y0 + height / 2})"'
    lines.append(text(x0 - 40, y0 + height / 2, "speed [rad/s el.]", "middle", turned))
    return lines


def scale(x0, y0):
    """The colours of the shares."""
    width = PANEL[0] / SCALE_STEPS
    lines = [text(x0, y0 - 10, "share of the limit")]
    for i in range(SCALE_STEPS):
        fill = colour(10 ** (DECADES * ((i + 0.5) / SCALE_STEPS - 1)))
        lines.append(rectangle(x0 + i * width, y0, x0 + (i + 1) * width, y0 + 18, fill))
    for decade in range(DECADES + 1):
        place = x0 + PANEL[0] * decade / DECADES
        lines.append(text(place, y0 + 34, f"{10.0 ** (decade - DECADES):g}", "middle"))
    return [
        *lines,
        rectangle(x0, y0 + 60, x0 + 18, y0 + 78, BEYOND),
        text(x0 + 26, y0 + 74, "beyond"),
    ]


def svg(plane):
    """The whole picture."""
    lines = []
    for place, (kind, name) in enumerate(TITLES):
        x0, y0 = ORIGIN[0] + place % 2 * PITCH[0], ORIGIN[1] + place // 2 * PITCH[1]
        lines += panel(plane, kind, name, x0, y0)
    lines += scale(ORIGIN[0] + PITCH[0], ORIGIN[1] + 2 * PITCH[1])
    size = f"0 0 {2 * PITCH[0]} {3 * PITCH[1]}"
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{size}" '
    head += 'font-family="sans-serif" font-size="12" shape-rendering="crispEdges">'
    white = rectangle(0, 0, 2 * PITCH[0], 3 * PITCH[1], "#fff")
    return "\n".join([head, white, *lines, "</svg>"]) + "\n"
