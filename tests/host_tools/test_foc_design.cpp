// SPDX-License-Identifier: MIT
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "design/foc/foc_design.hpp"
#include "design/foc/foc_loop.hpp"
#include "design/torque.hpp"

namespace {

using namespace sdre;

const double pi = std::acos(-1.0);

Drive shipped(const std::string &name)
{
    return read_drive_file(std::string(SDRE_SOURCE_DIR) + "/firmware/config/drives/ipmsm_390w_" +
                           name + ".toml");
}

const std::vector<std::string> names{"pi_foc", "pi_foc_edges", "ladrc", "ladrc_edges",
                                     "pi_foc_torque"};

/// Speed, iq, id, angle by EQ-MOTOR-2 over one period with the voltage held, Runge-Kutta in steps of 10 us.
struct MotorSim {
    const ReducedParameters &l;
    double                   load_radps2 = 0.0;
    Eigen::Vector4d          x           = Eigen::Vector4d::Zero();

    Eigen::Vector4d slope(const Eigen::Vector4d &s, double v_q, double v_d) const
    {
        const double w = s(0), iq = s(1), id = s(2);
        return {l[1] * iq - l[2] * w + l[11] * id * iq - load_radps2,
                -l[4] * iq - l[5] * w - l[10] * w * id + l[6] * v_q,
                -l[7] * id + l[9] * w * iq + l[8] * v_d, w};
    }
    void period(double v_q, double v_d)
    {
        const double h = 1e-5;
        for (int i = 0; i < 20; i++) {
            const Eigen::Vector4d a = slope(x, v_q, v_d);
            const Eigen::Vector4d b = slope(x + 0.5 * h * a, v_q, v_d);
            const Eigen::Vector4d c = slope(x + 0.5 * h * b, v_q, v_d);
            const Eigen::Vector4d d = slope(x + h * c, v_q, v_d);
            x += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
        }
    }
};

/// More voltage on q in one period, or more speed where that period begins.
struct Kick {
    double vq_V          = 0.0;
    double omega_e_radps = 0.0;
};

/// Speeds of the firmware's law on that motor, from rest at a speed and load, from the kick on.
std::vector<double> firmware_speeds(const Design &d, const ReducedParameters &l, double speed,
                                    double load, const Kick &kick, bool timed,
                                    const torque_command_t *torque = nullptr)
{
    const law_aim_t     aim{nullptr, torque};
    const int           settle = 3000, watched = 60;
    const double        ts = control_period_s(d.drive);
    drive_sample_t      sample{};
    law_state_t         state{};
    law_output_t        out{};
    dq_t                now{0.0F, 0.0F};
    MotorSim            m{l, load};
    std::vector<double> speeds;
    m.x              = {speed, 0.0, 0.0, 0.0};
    sample.dc_link_V = 1e4F; // no limit
    double before    = -speed * ts;
    for (int k = 0; k < settle + watched; k++) {
        const double theta = std::remainder(m.x(3), 2.0 * pi);
        // currents in the frame of the true angle as phases
        const double alpha   = m.x(2) * std::cos(theta) - m.x(1) * std::sin(theta);
        const double beta    = m.x(2) * std::sin(theta) + m.x(1) * std::cos(theta);
        sample.ia_A          = static_cast<float>(alpha);
        sample.ib_A          = static_cast<float>(0.5 * (std::sqrt(3.0) * beta - alpha));
        sample.theta_e_rad   = static_cast<float>(theta);
        sample.omega_e_radps = static_cast<float>((m.x(3) - before) / ts);
        sample.edge_gap_s    = timed ? static_cast<float>(ts) : 0.0F;
        sample.valid         = true;
        before               = m.x(3);
        if (k == 0) {
            d.config.law->reset(&state, &d.config, &sample);
        }
        const law_input_t in{&sample, static_cast<float>(speed), torque != nullptr ? &aim : nullptr,
                             now, 0.0F};
        d.config.law->step(&state, &d.config, &in, &out);
        m.x(0) += k == settle ? kick.omega_e_radps : 0.0;
        if (k >= settle) {
            speeds.push_back(m.x(0));
        }
        const double extra = k == settle ? kick.vq_V : 0.0;
        m.period(static_cast<double>(now.q) + extra, static_cast<double>(now.d));
        now = out.v_V;
    }
    return speeds;
}

/// The difference of two runs against the response of the loop's matrix to this state.
struct Deviation {
    double worst = 0.0, peak = 0.0;
};

Deviation deviation(const BrokenLoop &loop, Eigen::VectorXd s, const std::vector<double> &with,
                    const std::vector<double> &less)
{
    Deviation d;
    for (std::size_t k = 0; k < with.size(); k++) {
        d.worst = std::max(d.worst, std::abs(with[k] - less[k] - s(0)));
        d.peak  = std::max(d.peak, std::abs(s(0)));
        s       = loop.A * s;
    }
    return d;
}

} // namespace

TEST(FocDesign, CurrentGainsCancelThePoleAtTheBandwidth)
{
    for (const std::string &name : names) {
        const Drive        d = shipped(name);
        const Design       x = design_drive(d);
        const foc_config_t c = foc_constants(d, x.l);
        const double       w = 2.0 * pi * d.cascade.current_bandwidth_Hz;
        EXPECT_NEAR(static_cast<double>(c.q.kp_V_per_A), w * 0.11391, 1e-4);
        EXPECT_NEAR(static_cast<double>(c.d.kp_V_per_A), w * 0.07498, 1e-4);
        EXPECT_NEAR(static_cast<double>(c.q.ki_tick), w * 2.48 * 2e-4, 1e-6);
        EXPECT_NEAR(static_cast<double>(c.q.ki_per_kp), 2.48 / 0.11391 * 2e-4, 1e-8);
        EXPECT_NEAR(static_cast<double>(c.id_min_A), -0.193 / 0.07498, 1e-6);
        EXPECT_TRUE(x.certificate.passed()) << name;
    }
}

/// The largest phase margin of the loop 1/s, lag T_s, PI lies at its crossover 1 / (a T_s): asin((a^2 - 1) / (a^2 + 1)).
TEST(FocDesign, SpeedGainsAreTheSymmetricalOptimum)
{
    for (const bool edges : {false, true}) {
        const Drive  d      = shipped(edges ? "pi_foc_edges" : "pi_foc");
        const Design x      = design_drive(d);
        const double a      = d.cascade.symmetrical_optimum_a;
        const auto  &c      = *constants_of<law_pi_foc_config_t>(x.config);
        const double loop_s = 1.0 / (2.0 * pi * d.cascade.current_bandwidth_Hz);
        const double lag[2] = {loop_s + 0.5e-3, loop_s + (edges ? 0.1e-3 : 0.5e-3)};
        for (int mode = 0; mode < 2; mode++) {
            const double kp   = static_cast<double>(c.gains[mode].kp_1ps);
            const double ti   = 2e-4 / static_cast<double>(c.gains[mode].ki_per_kp);
            const auto   loop = [&](double w) {
                const std::complex<double> s(0.0, w);
                return kp * (1.0 + 1.0 / (s * ti)) / (s * (1.0 + s * lag[mode]));
            };
            const double crossover = 1.0 / (a * lag[mode]);
            EXPECT_NEAR(std::abs(loop(crossover)), 1.0, 1e-5);
            EXPECT_NEAR(pi + std::arg(loop(crossover)), std::asin((a * a - 1.0) / (a * a + 1.0)),
                        1e-5);
            EXPECT_LT(std::arg(loop(0.9 * crossover)), std::arg(loop(crossover)));
            EXPECT_LT(std::arg(loop(1.1 * crossover)), std::arg(loop(crossover)));
        }
    }
}

/// Difference of two runs of the firmware's law on the nonlinear motor, against the matrix that is certified.
TEST(FocDesign, CertifiedLoopIsTheFirmwareOnTheMotor)
{
    std::vector<Drive> drives;
    for (const std::string &name : names) {
        drives.push_back(shipped(name));
    }
    for (const char *name : {"pi_foc", "pi_foc_edges"}) {
        drives.push_back(shipped(name));
        drives.back().name += " with a load observer";
        drives.back().cascade.load_observer_radps = 300.0;
    }
    for (const Drive &drive : drives) {
        const std::string &name = drive.name;
        const Design       x    = design_drive(drive);
        for (const bool timed : {false, true}) {
            if (timed && !x.drive.encoder.edge_times) {
                continue;
            }
            for (const double load : {0.0, 5000.0}) {
                const double speed = 200.0;
                // Where the law brings it: torque against load and friction on the MTPA curve.
                double iq = 0.0;
                for (int i = 0; i < 60; i++) {
                    iq = (load + x.l[2] * speed) / (x.l[1] + x.l[11] * mtpa_id_A(x.l, iq));
                }
                const auto       mode = timed ? SPEED_DIFFERENCE_TIMED : SPEED_DIFFERENCE_COUNTED;
                const BrokenLoop loop =
                    foc_loops(x, x.drive.motor, {speed, iq, mtpa_id_A(x.l, iq)}, mode)[1];
                const auto with = firmware_speeds(x, x.l, speed, load, {5.0, 0.0}, timed);
                const auto less = firmware_speeds(x, x.l, speed, load, {-5.0, 0.0}, timed);

                const Deviation off = deviation(loop, 10.0 * loop.B, with, less);
                EXPECT_LE(off.worst, 0.02 * off.peak)
                    << name << (timed ? " timed" : "") << " " << load;
            }
        }
    }
}

/// The same of runs to a torque: with a free shaft, and at the speed limit.
TEST(FocDesign, CertifiedTorqueLoopsAreTheFirmwareOnTheMotor)
{
    Drive drive = shipped("pi_foc_torque");
    for (const double observer : {0.0, 300.0}) {
        drive.cascade.load_observer_radps = observer;
        const Design x                    = design_drive(drive);
        const auto  &c                    = *constants_of<law_pi_foc_config_t>(x.config);
        ASSERT_TRUE(x.config.torques);
        EXPECT_TRUE(x.certificate.passed());
        for (const bool timed : {false, true}) {
            for (const bool limited : {false, true}) {
                const auto   mode  = timed ? SPEED_DIFFERENCE_TIMED : SPEED_DIFFERENCE_COUNTED;
                const double speed = 200.0, accel = 5000.0; // of 0.7 of the rated torque
                const Motor  motor = limited ? drive.motor : with_load_of_its_own(drive.motor);
                const auto   l     = reduced_parameters(motor);
                const double load  = accel - l[2] * speed;
                const double left  = (observer > 0.0 ? l[2] * speed : accel) /
                                    static_cast<double>(c.gains[mode].kp_1ps);
                torque_command_t command{static_cast<float>(accel / (l[3] * 1.5)), 1000.0F};
                if (limited) {
                    command = {1.2F, static_cast<float>(speed + left)};
                }
                double iq = 0.0;
                for (int i = 0; i < 60; i++) {
                    iq = accel / (l[1] + l[11] * mtpa_id_A(x.l, iq));
                }
                const BrokenLoop loop =
                    foc_loops(x, drive.motor, {speed, iq, mtpa_id_A(x.l, iq)}, mode,
                              limited ? FocRun::limit : FocRun::torque)[1];
                EXPECT_EQ(loop.shaft_mode > 0.0, !limited);
                const auto run = [&](const Kick &kick) {
                    return firmware_speeds(x, l, speed, load, kick, timed, &command);
                };
                const Deviation by_V =
                    deviation(loop, 10.0 * loop.B, run({5.0, 0.0}), run({-5.0, 0.0}));
                const Deviation by_w = deviation(loop, Eigen::VectorXd::Unit(loop.A.rows(), 0),
                                                 run({0.0, 0.5}), run({0.0, -0.5}));
                EXPECT_LE(by_V.worst, 0.02 * by_V.peak) << observer << timed << limited;
                EXPECT_LE(by_w.worst, 0.02 * by_w.peak) << observer << timed << limited;
            }
        }
    }
}

TEST(FocDesign, TheCertificateHasTheLoopsOfATorque)
{
    Drive drive = shipped("pi_foc_torque");
    EXPECT_EQ(foc_family(design_drive(drive)).loops(drive.motor, {200.0, 1.0, -0.2}).size(), 18U);
    drive.torque.reset();
    EXPECT_EQ(foc_family(design_drive(drive)).loops(drive.motor, {200.0, 1.0, -0.2}).size(), 6U);
}

TEST(FocDesign, LadrcHasADoubleObserverPole)
{
    const Design x    = design_drive(shipped("ladrc_edges"));
    const auto  &g    = constants_of<law_ladrc_config_t>(x.config)->gains[SPEED_DIFFERENCE_TIMED];
    const double beta = std::exp(-x.drive.cascade.observer_radps * 2e-4);
    const double gw   = static_cast<double>(g.observer.gain_w);
    const double gf   = static_cast<double>(g.observer.gain_f_1ps);
    // Error of the prediction: z^2 - (2 - gw - gf Ts) z + (1 - gw) = (z - beta)^2.
    EXPECT_NEAR(2.0 - gw - gf * 2e-4, 2.0 * beta, 1e-6);
    EXPECT_NEAR(1.0 - gw, beta * beta, 1e-6);
}

TEST(FocDesign, TooFastIsRefused)
{
    Drive d                        = shipped("pi_foc");
    d.cascade.current_bandwidth_Hz = 900.0;
    const Certificate current      = design_drive(d).certificate;
    EXPECT_FALSE(current.passed());
    d                               = shipped("pi_foc");
    d.cascade.symmetrical_optimum_a = 1.1;
    EXPECT_FALSE(design_drive(d).certificate.passed());
    d                          = shipped("ladrc");
    d.cascade.controller_radps = 3000.0;
    d.cascade.observer_radps   = 6000.0;
    EXPECT_FALSE(design_drive(d).certificate.passed());
}

/// No alias at the trip speed, whatever the control rate.
TEST(FocDesign, SpeedWindowFitsTheTripSpeed)
{
    Drive d                     = shipped("pi_foc");
    d.motor.rated_speed_e_radps = 3000.0;
    const auto c                = speed_difference_constants(d, 1e-3);
    EXPECT_EQ(c.periods, 1);
    d.motor.rated_speed_e_radps = 300.0;
    EXPECT_EQ(speed_difference_constants(d, 1e-3).periods, 5);
    EXPECT_EQ(speed_difference_constants(d, 0.0).periods, 1);
}
