// SPDX-License-Identifier: MIT
/// One verdict on a whole sampled loop, the same for every law. It checks the slowest mode, the
/// margin at each opening of the loop, and other motors. It also checks the distance of the loop's
/// own noise and load steps from its trip levels.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "design/loop_check.hpp"
#include "design/robust_box.hpp"
#include "design/sampled_model.hpp"
#include "design/shaft_model.hpp"

namespace sdre {

struct Design;

/// Largest time constant of a certified loop. Chosen: who changes a load or a command sees the end of it. The slowest shipped loop,
/// the d current of paper B's laws, has 1.1 s.
constexpr double slowest_mode_s = 2.0;
/// The same of a law that learns harmonics. Chosen: twice the fifty seconds in which noc_h's harmonics are forgotten.
constexpr double learning_mode_s = 100.0;

/// A law's closed loop, linearised, with the tables of the drive and a motor that may be another.
struct LoopFamily {
    /// Names of the places where the loop is opened, one at a time with everything else closed: "q
    /// axis".
    std::vector<std::string> channels;
    /// Loop i is opened at channel i % channels.size(); more than one per channel when the law has
    /// several modes.
    std::function<std::vector<BrokenLoop>(const Motor &motor, const OperatingPoint &at)> loops;
    std::vector<OperatingPoint> points; ///< where stability and margin are judged
    std::vector<OperatingPoint> plane;  ///< where stability is, and of which the worst margins are
    /// The same for other motors, where it is not `loops`.
    std::function<std::vector<BrokenLoop>(const Motor &motor, const OperatingPoint &at)>
        loops_of_others;
    std::vector<OperatingPoint>
        box_points; ///< points where every other motor must be stable; none: other motors are not required
};

/// A quantity that ends the drive when it is too large, and what a healthy drive makes of it.
struct TripMargin {
    std::string name;
    double      limit   = 0.0;
    double      healthy = 0.0; ///< in the same unit
};

struct Channel {
    std::string name;
    LoopCheck   worst; ///< the largest sensitivity, and the largest spectral radius, of all points
    OperatingPoint at; ///< of that sensitivity
};

struct Verdict {
    double               slowest_mode_s  = sdre::slowest_mode_s; ///< allowed at most
    double               spectral_radius = 0.0;                  ///< of all points
    OperatingPoint       radius_at;
    std::vector<Channel> channels;
    std::optional<RobustBox>
        box; ///< EQ-CERT-5, every corner; where the family requires other motors
    std::optional<RobustBox>    alone; ///< the same of one parameter at a time
    std::vector<TripMargin>     trips;
    std::optional<ShaftVerdict> shaft; ///< EQ-CERT-9, of a coupling that is not rigid
};

/// The steady operating point at a speed and a q current. It is on the MTPA curve. Where the dc
/// link cannot hold that, the flux is weakened and the q current reduced. A drive is elsewhere only
/// during a transient.
OperatingPoint held_point(const Design &design, double speed_e_radps, double iq_A);

/// Standstill, rated and largest speed of a command, each without current and with the largest either way. A negative speed
/// is the mirror image of a positive one with the other sign of current.
std::vector<OperatingPoint> verdict_points(const Design &design);

/// Slowly without current, and with the largest at the rated speed; with harmonics at three more below it.
std::vector<OperatingPoint> verdict_box_points(const Design &design);

/// Two loops, opened at v_q and at v_d.
std::vector<BrokenLoop> broken_at_voltages(const Eigen::MatrixXd &A,
                                           const Eigen::MatrixXd &B_voltage,
                                           const Eigen::MatrixXd &C_voltage, double ts_s);

/// Looks everywhere; judges nothing.
Verdict examine(const LoopFamily &family, const Drive &drive);

/// How far the verdict is from holding: the largest of what is found over what is allowed; at most 1 when all holds.
double excess(const Verdict &verdict, double ts_s);

/// One line for each thing that does not hold.
void judge(const Verdict &verdict, double ts_s, std::vector<std::string> &failures);

} // namespace sdre
