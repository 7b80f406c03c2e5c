// SPDX-License-Identifier: MIT
// The encoder dies while the shaft turns: the whole application, with motors that are not as believed.
// SDRE_ENCODER=all prints the table of docs/hardware.md.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "sil/board/board_run.hpp"
#include "sil/run/faults.hpp"
#include "sweep.hpp"
#include "temp_dir.hpp"

using namespace sdre;

namespace {

constexpr double dies_s       = 0.1;
constexpr double limit_A      = 4.0;
constexpr double braked       = 60.0; // rad/s
constexpr int    encoder      = static_cast<int>(DRIVE_FAULT_ENCODER);
constexpr double link_e_radps = 1191.0; // EMF of the dc link's upper limit

struct Motor390 {
    std::string name;
    double      inductance = 1.0, inertia = 1.0, flux = 1.0;
    double      saturation = 0.0; ///< share of both inductances that the largest q current takes
};

const std::vector<Motor390> motors{{"as believed"},
                                   {"L x0.7", 0.7},
                                   {"L x0.8", 0.8},
                                   {"L x0.9", 0.9},
                                   {"L x1.2", 1.2},
                                   {"L x1.5", 1.5},
                                   {"J x0.5", 1.0, 0.5},
                                   {"J x1.5", 1.0, 1.5},
                                   {"J x3", 1.0, 3.0},
                                   {"flux x0.8", 1, 1, 0.8},
                                   {"saturation 20 %", 1, 1, 1, 0.2},
                                   {"saturation 40 %", 1, 1, 1, 0.4}};

SaturationMap saturated(const Motor &m, double share)
{
    SaturationMap map;
    map.id_A = {-2.0 * limit_A, 2.0 * limit_A};
    map.iq_A = {-limit_A, 0.0, limit_A};
    for (std::size_t row = 0; row < map.id_A.size(); row++) {
        for (const double left : {1.0 - share, 1.0, 1.0 - share}) {
            map.ld_H.push_back(left * m.d_axis_inductance_H);
            map.lq_H.push_back(left * m.q_axis_inductance_H);
        }
    }
    return map;
}

Scenario scenario(const std::string &drive, const Motor390 &m, double speed, double load_Nm)
{
    const support::TempDir dir;
    Scenario               s = read_scenario_file(dir.write(
                      "s.toml", fmt::format("drive = \"" SDRE_SOURCE_DIR "/firmware/config/drives/{0}.toml\"\n"
                                                          "duration_s = 1.0\ninitial_speed_e_radps = {1}\n[sensors]\n"
                                                          "[[speed_reference]]\ntime_s = 0.0\nvalue_e_radps = {1}\n"
                                                          "[[load_torque]]\ntime_s = 0.0\nvalue_Nm = {2}\n"
                                                          "[plant_scale]\nd_axis_inductance_H = {3}\n"
                                                          "q_axis_inductance_H = {3}\ninertia_kgm2 = {4}\n"
                                                          "pm_flux_Wb = {5}\n[[change]]\ntime_s = {6}\n"
                                                          "set = {{ sensors = {{ encoder_dead = true }} }}\n",
                                            drive, speed, load_Nm, m.inductance, m.inertia, m.flux, dies_s)));
    if (m.saturation > 0.0) {
        s.motor_effects.saturation = saturated(s.drive.motor, m.saturation);
    }
    s.seed = static_cast<std::uint64_t>(1.0 + std::abs(speed) + load_Nm);
    return s;
}

struct Outcome {
    int    fault   = 0;
    bool   ended   = false; ///< the bridge is open or shorts the motor
    bool   shorted = false;
    double speed   = 0.0; ///< at that instant
    double after_s = 0.0;
    double peak_A  = 0.0; ///< until then
};

/// The bridge of a run that has ended: all lower switches on, or open.
Outcome outcome(const Scenario &s)
{
    const BoardResult b = simulate_on_board(s, BoardKind::api);
    Outcome           o;
    o.fault = b.result.fault;
    for (std::size_t k = 0; k < b.ticks.size() && !o.ended; k++) {
        const TraceRow &row = b.result.trace[k];
        if (row.time_s < dies_s) {
            continue;
        }
        o.ended   = o.fault != 0 && row.time_s >= b.result.fault_time_s;
        o.speed   = std::abs(row.omega_e_radps);
        o.after_s = row.time_s - dies_s;
        o.peak_A  = std::max(o.peak_A, row.peak_current_A);
        // A duty ratio acts from the next period on.
        o.shorted = k + 2 < b.ticks.size() && b.ticks[k + 2].bridge_on;
    }
    return o;
}

struct Row {
    int    runs = 0, stopped = 0;
    double fastest = 0.0, latest_s = 0.0, peak_A = 0.0;
};

void expect_safe(const Outcome &o, const std::string &what)
{
    EXPECT_EQ(o.fault, encoder) << what << ": " << fault_name(o.fault);
    EXPECT_TRUE(o.ended) << what;
    EXPECT_EQ(o.shorted, o.speed > link_e_radps) << what << ' ' << o.speed;
    EXPECT_LE(o.peak_A, 1.25 * limit_A) << what;
}

Row row_of(const std::string &drive, const Motor390 &m, const std::vector<double> &speeds,
           const std::vector<double> &loads)
{
    Row row;
    for (const double speed : speeds) {
        for (const double load : loads) {
            const Outcome o = outcome(scenario(drive, m, speed, std::copysign(load, load * speed)));
            expect_safe(o, fmt::format("{} {} {} rad/s {} N m", drive, m.name, speed, load));
            row.runs++;
            row.stopped += o.speed < braked ? 1 : 0;
            row.fastest  = std::max(row.fastest, o.speed);
            row.latest_s = std::max(row.latest_s, o.after_s);
            row.peak_A   = std::max(row.peak_A, o.peak_A);
        }
    }
    return row;
}

bool all()
{
    return std::getenv("SDRE_ENCODER") != nullptr;
}

/// Both directions; loads that drive the shaft, none, and loads that brake it.
const std::vector<double> few_speeds{70.0, -300.0, 850.0};
const std::vector<double> all_speeds{60.0,  -60.0,  80.0,   -100.0, 150.0, -200.0,
                                     300.0, -450.0, -600.0, 850.0,  -850.0};
const std::vector<double> loads{-1.0, 0.0, 1.0};

} // namespace

/// EQ-NODO-CURRENT-1 to 3. No motor leaves the bridge open beyond 100 rad/s, and each row stops nearly all.
TEST(EncoderLost, AnyMotorIsBrakedAndTheEncoderIsNamed)
{
    if (all()) {
        fmt::print("| motor | runs | below 60 rad/s | fastest | latest | peak |\n");
        fmt::print("|---|---:|---:|---:|---:|---:|\n");
    }
    for (const Motor390 &m : support::swept_each(motors, 3)) {
        const Row r = row_of("ipmsm_390w", m, all() ? all_speeds : few_speeds, loads);
        EXPECT_LE(r.fastest, 110.0) << m.name;
        EXPECT_GE(r.stopped, r.runs - r.runs / 5) << m.name;
        if (all()) {
            fmt::print("| {} | {} | {} | {:.0f} rad/s | {:.0f} ms | {:.1f} A |\n", m.name, r.runs,
                       r.stopped, r.fastest, 1e3 * r.latest_s, r.peak_A);
        }
    }
}

/// A law without an estimate of the angle: the bridge opens, as below 1191 rad/s nothing charges the dc link.
TEST(EncoderLost, OtherLawsOpenAtOnceAndNameTheEncoder)
{
    for (const char *drive : {"ipmsm_390w_noc_h", "ipmsm_390w_noc_h_edges"}) {
        for (const Motor390 &m : support::swept_each(motors, 6)) {
            const Outcome o = outcome(scenario(drive, m, -300.0, -1.0));
            expect_safe(o, fmt::format("{} {}", drive, m.name));
            EXPECT_LE(o.after_s, 3e-3) << drive << ' ' << m.name;
        }
    }
}
