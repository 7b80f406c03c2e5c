// SPDX-License-Identifier: MIT
/// noc_iron on the simulated board with motors whose iron saturates, beside noc on the same motors.
#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "iron.hpp"
#include "sil/eval/metrics.hpp"
#include "sil/run/simulation.hpp"
#include "sweep.hpp"

namespace {

struct Worst {
    double settled_ms      = 0.0;
    double dip_e_radps     = 0.0;
    double overshoot_radps = 0.0;
    double voltage_noise   = 0.0;
    double d_A_per_s       = 0.0; ///< estimated disturbances of the currents
};

sdre::Scenario scenario(const char *name, const sdre::Drive &drive)
{
    sdre::Scenario s = sdre::read_scenario_file(
        std::string(SDRE_SOURCE_DIR "/host_tools/sil/scenarios/") + name + ".toml",
        support::shipped_drive("ipmsm_390w_iron"));
    s.drive = drive;
    return s;
}

Worst worst_of(const char *name, const sdre::Drive &drive, int seeds)
{
    Worst                  worst;
    const sdre::Controller controller = sdre::prepare_controller(scenario(name, drive));
    for (int seed = 1; seed <= seeds; seed++) {
        sdre::Scenario s                 = scenario(name, drive);
        s.seed                           = static_cast<std::uint64_t>(seed);
        const sdre::SimulationResult run = sdre::simulate(s, controller);
        EXPECT_EQ(run.fault, 0) << name;
        const auto          all  = sdre::measure(s, run.trace);
        const sdre::Metrics step = all.back();
        worst.settled_ms  = std::max(worst.settled_ms, 1e3 * step.settling_time_s.value_or(1.0));
        worst.dip_e_radps = std::max(worst.dip_e_radps, step.dip_e_radps);
        worst.overshoot_radps = std::max(worst.overshoot_radps, step.overshoot_e_radps);
        worst.voltage_noise   = std::max(worst.voltage_noise, all.front().effort.vq_noise_V);
        worst.d_A_per_s =
            std::max({worst.d_A_per_s, std::abs(step.d_q_hat), std::abs(step.d_d_hat)});
    }
    return worst;
}

sdre::Drive with_law(sdre::Drive drive, sdre::Law law)
{
    drive.law = law;
    return drive;
}

/// The 390 W motor with the inductances of [motor] at the limit and `factor` times them without current.
sdre::Drive unsaturated_times(double factor, double b)
{
    support::Iron iron;
    iron.ld_H *= factor;
    iron.lq_H *= factor;
    iron.b            = b;
    sdre::Drive drive = support::saturated_drive(iron);
    drive.position.reset();
    return drive;
}

} // namespace

/// Limits: the worst of 20 seeds in docs/theory/references.md and a period more.
TEST(IronLaw, LoadStepSettlesWithTheIronInTheFile)
{
    struct Case {
        sdre::Drive drive;
        double      settled_ms, dip, noise_V, without_ms;
    };
    const sdre::Drive shipped = sdre::read_drive_file(support::shipped_drive("ipmsm_390w_iron"));
    const Case        cases[] = {
               {shipped, 6.2, 5.1, 6.9, 8.4},
               {with_law(unsaturated_times(1.0, 0.45), sdre::Law::noc_iron), 6.8, 5.1, 6.8, 9.0},
               {with_law(unsaturated_times(1.5, 0.3), sdre::Law::noc_iron), 7.0, 5.8, 10.1, 12.4},
               {with_law(unsaturated_times(1.5, 0.0), sdre::Law::noc_iron), 9.0, 5.9, 10.1, 12.4}};
    for (const Case &c : cases) {
        const int   seeds = support::swept(6, 1);
        const Worst iron  = worst_of("board_load_step", c.drive, seeds);
        const Worst plain = worst_of("board_load_step", with_law(c.drive, sdre::Law::noc), seeds);
        EXPECT_LE(iron.settled_ms, c.settled_ms);
        EXPECT_LE(iron.dip_e_radps, c.dip);
        EXPECT_LE(iron.voltage_noise, c.noise_V);
        EXPECT_LE(iron.d_A_per_s, 10.0); // the map leaves nothing to them
        EXPECT_GE(plain.settled_ms,
                  support::swept(1.0, 0.9) * c.without_ms); // one seed is not the worst
    }
}

/// From standstill, through a reversal, into flux weakening and braking: no trip. With 1.5 times the inductance the motor has no
/// torque for board_weakening_load.
TEST(IronLaw, OtherRunsEndAtTheirSpeed)
{
    struct Case {
        sdre::Drive drive;
        bool        weak;
    };
    for (const Case &c :
         {Case{sdre::read_drive_file(support::shipped_drive("ipmsm_390w_iron")), false},
          Case{with_law(unsaturated_times(1.5, 0.3), sdre::Law::noc_iron), true}}) {
        for (const std::string name : {"board_speed_step", "board_reversal", "board_flux_weakening",
                                       "board_regeneration", "board_weakening_load"}) {
            const sdre::Scenario         s   = scenario(name.c_str(), c.drive);
            const sdre::SimulationResult run = sdre::simulate(s);
            EXPECT_EQ(run.fault, 0) << name;
            const sdre::Metrics last = sdre::measure(s, run.trace).back();
            EXPECT_LT(last.peak_current_A, 4.4) << name;
            EXPECT_LT(last.overshoot_e_radps, c.weak ? 4.0 : 1.2) << name;
            EXPECT_EQ(last.settling_time_s.has_value(), !c.weak || name != "board_weakening_load");
        }
    }
}
