// SPDX-License-Identifier: MIT
#include "sil/qualify/map.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/parallel.hpp"
#include "design/design.hpp"
#include "design/id_reference.hpp"
#include "design/laws/near_optimal.hpp"
#include "design/machine_points.hpp"
#include "design/trip_levels.hpp"
#include "sil/eval/rows.hpp"
#include "sil/eval/settled_noise.hpp"
#include "sil/qualify/plan.hpp"
#include "sil/run/simulation.hpp"

namespace sdre {
namespace {

// Chosen: of the largest q current in steady state; the limit of iq does not act there.
constexpr double iq_share = 0.95;
// Chosen: torque of a law without a d-current reference of its own, of what the machine has.
constexpr double torque_share = 0.85;
constexpr int    tail_periods = 1000;
// Chosen: of the trip speed, where a drive may be commanded that far: noise and overshoot need room.
constexpr double trip_share  = 0.95;
constexpr double board_ratio = 2.0; // chosen: noise at any point, of that at half the rating

Ripples ripples_of(const Trace &trace)
{
    const auto begin =
        trace.end() - std::min<std::ptrdiff_t>(tail_periods, trace.end() - trace.begin());
    const auto rms = [&](const auto &value) {
        return std::sqrt(variance(begin, trace.end(), value));
    };
    return {rms([](const TraceRow &r) { return r.vq_V; }),
            rms([](const TraceRow &r) { return r.vd_V; }),
            rms([](const TraceRow &r) { return r.omega_e_radps; })};
}

Ripples largest(const Ripples &a, const Ripples &b)
{
    return {std::max(a.vq_V, b.vq_V), std::max(a.vd_V, b.vd_V),
            std::max(a.speed_e_radps, b.speed_e_radps)};
}

/// The torque that a drive holds at a speed; share -1 generates all that it can, 1 motors.
double held_torque_Nm(const Design &design, double speed_e_radps, double share)
{
    const Drive &d = design.drive;
    if (const current_ref_config_t *references = current_references(design)) {
        const TrueMotor      motor = true_motor(d, d.motor);
        const OperatingPoint at = loaded_point(id_reference(design, *references), motor, design.l,
                                               speed_e_radps, iq_share * share);
        return d.saturation ? motor.acceleration(at) * d.motor.inertia_kgm2 / d.motor.pole_pairs
                            : torque_Nm(d.motor, at.id_A, at.iq_A);
    }
    const double circle_V = d.inverter.dc_link_V / std::sqrt(3.0);
    return torque_share * share * most_torque(d.motor, speed_e_radps, circle_V).torque_Nm;
}

std::vector<MapPoint> grid(const Drive &d, int per_side)
{
    const double top    = std::min(largest_command_e_radps(d), trip_share * trip_speed_e_radps(d));
    const Design design = design_drive(d);
    std::vector<MapPoint> points;
    for (int i = 0; i < per_side; i++) {
        const double speed = top * i / (per_side - 1);
        for (int j = 0; j < per_side; j++) {
            MapPoint p;
            p.speed_e_radps = speed;
            p.torque_Nm     = held_torque_Nm(design, speed, 2.0 * j / (per_side - 1) - 1.0);
            points.push_back(p);
        }
    }
    return points;
}

/// A run at the point, without noise or on the board. It starts at the rated speed at most, as no drive starts in deep flux
/// weakening. The load comes on a ramp: a drive with all its torque in use takes long to come back to its speed after a step.
Scenario steady_run(const Drive &d, const MapPoint &p, bool ideal)
{
    const double start       = std::min(p.speed_e_radps, d.motor.rated_speed_e_radps);
    const double settling_s  = steady_after_s(d, p.speed_e_radps - start);
    const double friction_Nm = d.motor.viscous_friction_Nms * p.speed_e_radps / d.motor.pole_pairs;
    Scenario     s           = at_speed(d, start, 0.0);
    s.sensors.ideal          = ideal;
    s.speed_reference        = {{0.0, p.speed_e_radps}};
    s.load_ramps             = {{settling_s, 2.0 * settling_s, p.torque_Nm - friction_Nm}};
    s.duration_s             = 3.0 * settling_s + tail_periods * control_period_s(d);
    return s;
}

/// Seeds 1 .. `seeds` on the board, and one run without noise.
void run(const Drive &d, std::vector<MapPoint> &points, int seeds)
{
    const std::size_t    each  = static_cast<std::size_t>(seeds) + 1;
    const Controller     noisy = prepare_controller(steady_run(d, points[0], false));
    const Controller     exact = prepare_controller(steady_run(d, points[0], true));
    std::vector<Ripples> found(points.size() * each);
    std::vector<char>    tripped(found.size(), 0);
    parallel_for(found.size(), [&](std::size_t n) {
        const std::size_t seed   = n % each;
        Scenario          s      = steady_run(d, points[n / each], seed == 0);
        s.seed                   = std::max<std::size_t>(seed, 1);
        const SimulationResult r = simulate(s, seed == 0 ? exact : noisy);
        found[n]                 = ripples_of(r.trace);
        tripped[n]               = r.fault != 0 ? 1 : 0;
    });
    for (std::size_t i = 0; i < points.size(); i++) {
        points[i].ideal = found[i * each];
        for (std::size_t k = 0; k < each; k++) {
            points[i].board = k == 0 ? Ripples{} : largest(points[i].board, found[i * each + k]);
            points[i].faults += tripped[i * each + k];
        }
    }
}

struct Quantity {
    const char *name;
    const char *unit;
    double Ripples::*value;
};

constexpr Quantity quantities[] = {{"v_q", "V", &Ripples::vq_V},
                                   {"v_d", "V", &Ripples::vd_V},
                                   {"speed", "rad/s", &Ripples::speed_e_radps}};

std::string where(const MapPoint &p)
{
    return fmt::format("{:.4g} rad/s, {:.3g} N m", p.speed_e_radps, p.torque_Nm);
}

const MapPoint &worst(const PlaneMap &map, Ripples MapPoint::*kind, double Ripples::*value)
{
    return *std::max_element(
        map.points.begin(), map.points.end(),
        [&](const MapPoint &a, const MapPoint &b) { return (a.*kind).*value < (b.*kind).*value; });
}

std::string line(const PlaneMap &map, const char *what, Ripples MapPoint::*kind)
{
    std::string s = fmt::format("plane of speed and torque, {}: worst rms", what);
    for (const Quantity &q : quantities) {
        const MapPoint &p = worst(map, kind, q.value);
        s += fmt::format("{} {} {:.3g} {} ({})", &q == quantities ? "" : ",", q.name,
                         (p.*kind).*q.value, q.unit, where(p));
    }
    return s + "\n";
}

void judge(const PlaneMap &map, const char *what, Ripples MapPoint::*kind, const Ripples &limit,
           std::vector<std::string> &reasons)
{
    for (const Quantity &q : quantities) {
        const double most  = limit.*q.value;
        const auto   above = [&](const MapPoint &p) { return !((p.*kind).*q.value <= most); };
        const auto   count = std::count_if(map.points.begin(), map.points.end(), above);
        if (most > 0.0 && count > 0) {
            const MapPoint &p = worst(map, kind, q.value);
            reasons.push_back(fmt::format(
                "{}: {} {:.3g} {} rms at {}, at most {:.3g}; above at {} of {} points", what,
                q.name, (p.*kind).*q.value, q.unit, where(p), most, count, map.points.size()));
        }
    }
}

} // namespace

PlaneMap plane_map(const Drive &d, int per_side, int seeds)
{
    const double circle_V = d.inverter.dc_link_V / std::sqrt(3.0);
    MapPoint     half;
    half.speed_e_radps = 0.5 * d.motor.rated_speed_e_radps;
    half.torque_Nm     = 0.5 * d.motor.rated_torque_Nm;

    PlaneMap map;
    map.seeds  = seeds;
    map.points = grid(d, per_side);
    map.points.push_back(half);
    run(d, map.points, seeds);
    half = map.points.back();
    map.points.pop_back();
    map.ideal_limit     = {quiet_voltage_share * circle_V, quiet_voltage_share * circle_V,
                           quiet_speed_share * d.motor.rated_speed_e_radps};
    const double most_V = board_ratio * std::max(half.board.vq_V, half.board.vd_V);
    map.board_limit     = {most_V, most_V, 0.0};
    return map;
}

std::vector<std::string> map_reasons(const PlaneMap &map)
{
    std::vector<std::string> reasons;
    int                      faults = 0;
    for (const MapPoint &p : map.points) {
        faults += p.faults;
    }
    if (faults > 0) {
        reasons.push_back(fmt::format("plane: {} runs trip", faults));
    }
    judge(map, "plane without noise", &MapPoint::ideal, map.ideal_limit, reasons);
    judge(map, "plane on the board", &MapPoint::board, map.board_limit, reasons);
    return reasons;
}

std::string map_text(const PlaneMap &map)
{
    if (map.points.empty()) {
        return "";
    }
    return line(map, "without noise", &MapPoint::ideal) +
           line(map, "on the board", &MapPoint::board);
}

} // namespace sdre
