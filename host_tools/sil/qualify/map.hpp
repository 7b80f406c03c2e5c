// SPDX-License-Identifier: MIT
/// Steady running over the plane of speed and torque. A limit cycle shows here that no step response shows.
#pragma once

#include <string>
#include <vector>

#include "drive/drive_file.hpp"

namespace sdre {

/// rms deviation from the mean over the last thousand periods.
struct Ripples {
    double vq_V          = 0.0;
    double vd_V          = 0.0;
    double speed_e_radps = 0.0;
};

struct MapPoint {
    double  speed_e_radps = 0.0;
    double  torque_Nm     = 0.0; ///< of the motor
    Ripples ideal;               ///< exact sensors, averaged inverter, no dead time: no noise
    Ripples board;               ///< worst of the seeds
    int     faults = 0;          ///< runs that tripped
};

struct PlaneMap {
    int                   seeds = 0;
    std::vector<MapPoint> points; ///< speed by speed, the torque from generating to motoring
    Ripples               ideal_limit;
    Ripples board_limit; ///< twice the noise of v_q or v_d at half the rating; the speed has none
};

/// `per_side` speeds from standstill to the largest command (0.95 of the trip speed at most), with as many torques each, generating to motoring. The largest
/// is that of 0.93 of the q current that the references reach; without such references 0.85 of the machine's. Board runs take seeds 1 .. `seeds`.
PlaneMap plane_map(const Drive &drive, int per_side, int seeds);

/// The points that break a limit, one line each quantity; empty: none.
std::vector<std::string> map_reasons(const PlaneMap &map);

/// The largest values, two lines.
std::string map_text(const PlaneMap &map);

/// v_q and v_d over the plane, without and with the noise of the board, as one SVG element.
std::string map_svg(const PlaneMap &map);

} // namespace sdre
