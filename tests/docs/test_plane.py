# SPDX-License-Identifier: MIT
"""Figures and picture of a map whose worst points are known."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "host_tools/results"))

import plane
from plane_picture import BEYOND, colour, svg


def point(speed, torque, ideal, board):
    def of(values):
        return dict(zip(plane.QUANTITIES.values(), values, strict=True))

    return {
        "speed_e_radps": speed,
        "torque_Nm": torque,
        "ideal": of(ideal),
        "board": of(board),
    }


FOUND = {
    "ideal_limit": {"vq_V": 0.2, "vd_V": 0.2, "speed_e_radps": 0.02},
    "board_limit": {"vq_V": 20.0, "vd_V": 20.0, "speed_e_radps": 0.0},
    "points": [
        point(0.0, -2.0, (0.01, 0.01, 0.001), (3.0, 2.0, 0.3)),
        point(0.0, 2.0, (0.02, 0.01, 0.001), (21.0, 22.0, 0.1)),
        point(900.0, -1.0, (0.3, 0.01, 0.001), (10.0, 6.0, 0.1)),
        point(900.0, 1.0, (0.02, 0.01, 0.03), (9.0, 20.0, 0.1)),
    ],
}


class Plane(unittest.TestCase):
    def test_worst_and_shares(self):
        worst = plane.recorded(FOUND)["worst"]
        self.assertEqual([worst[f"ideal_{name}"] for name in plane.QUANTITIES], [0.3, 0.01, 0.03])
        self.assertEqual([worst[f"board_{name}"] for name in plane.QUANTITIES], [21.0, 22.0, 0.3])
        self.assertEqual((worst["ideal_within"], worst["board_within"]), (50, 75))

    def test_cells_tell_where(self):
        cells = plane.fields(plane.recorded(FOUND)["plane"])
        self.assertEqual(cells["ideal_vq_at"], "900 rad/s, -1.0 N m")
        self.assertEqual(cells["board_vd_at"], "0 rad/s, 2.0 N m")
        self.assertEqual(cells["board_vd_most"], 20.0)

    def test_picture_shows_what_is_beyond(self):
        # Two of the values without noise, two on the board, and the scale's own.
        self.assertEqual(svg(plane.recorded(FOUND)["plane"]).count(BEYOND), 5)
        self.assertEqual(colour(float("nan")), BEYOND)
        self.assertEqual(len({colour(share) for share in (0.0, 0.01, 0.1, 1.0)}), 4)


if __name__ == "__main__":
    unittest.main()
