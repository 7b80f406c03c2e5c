// SPDX-License-Identifier: MIT
#include "design/speed_form_model.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "design/design.hpp"
#include "design/id_reference.hpp"
#include "linalg/eigenvalues.hpp"
#include "load_response.hpp"
#include "shipped_drive.hpp"

namespace {

struct Case {
    std::string name;
    double      speed_e_radps;
    double      load_Nm;
};

sdre::Design designed(const std::string &name)
{
    return sdre::design_drive(sdre::read_drive_file(support::shipped_drive(name)));
}

const current_ref_config_t &references_of(const sdre::Design &d)
{
    return d.drive.law == sdre::Law::conventional_noc
               ? static_cast<const law_conventional_config_t *>(d.config.constants)
                     ->near_optimal.current_ref
               : static_cast<const law_noc_speed_config_t *>(d.config.constants)
                     ->near_optimal.current_ref;
}

/// The gains that the firmware uses in a steady state, by the powers themselves.
sdre::LoopGains gains_at(const sdre::Design &d, const sdre::OperatingPoint &at)
{
    const double    r  = d.certificate.nodo.series_range_A;
    const double    iq = std::clamp(at.iq_A, -r, r);
    const double    id = std::clamp(at.id_A, -r, r);
    Eigen::MatrixXd L  = Eigen::MatrixXd::Zero(d.nodo.gain[0].rows(), 3);
    for (std::size_t n = 0; n < d.nodo.gain.size(); n++) {
        const std::vector<int> &powers = d.nodo.series.terms[n].powers;
        L += std::pow(iq, powers[0]) * (powers.size() > 1 ? std::pow(id, powers[1]) : 1.0) *
             d.nodo.gain[n];
    }
    return {d.nosc.gain[0], L};
}

} // namespace

/// The oracle is the control core itself on the nonlinear motor: free, loaded, generating and in flux weakening.
TEST(SpeedFormModel, SmallLoadStepIsThatOfTheCore)
{
    constexpr double step_Nm = 0.02;
    for (const Case &c :
         {Case{"ipmsm_390w_speed", 300.0, 0.75}, Case{"ipmsm_390w_speed", 744.0, 1.3},
          Case{"ipmsm_390w_speed", 500.0, -1.5}, Case{"ipmsm_390w_speed", -300.0, 0.5},
          Case{"ipmsm_390w_conventional", 300.0, 0.75},
          Case{"ipmsm_390w_conventional", 744.0, 1.3}}) {
        const sdre::Design          d  = designed(c.name);
        const sdre::IdReference     id = sdre::id_reference(d, references_of(d));
        const support::StepResponse found =
            support::nonlinear_step(d, c.speed_e_radps, c.load_Nm, step_Nm, 0.3);
        EXPECT_FALSE(found.limited) << c.name;
        const sdre::SteadyState s =
            sdre::steady_state(id, d.l, d.l, found.before.omega_e_radps, found.before.iq_A);
        const sdre::LoopGains       gains  = gains_at(d, s.at);
        const sdre::MovingReference moving = sdre::moving_reference(id, d.l, gains.Lambda, s);
        const auto                  expected =
            support::linear_step(sdre::speed_form_model(d.l, d.l, d.drive.nodo.form, gains, s.at,
                                                        sdre::control_period_s(d.drive), &moving),
                                 step_Nm);
        const double dip = -*std::min_element(expected.begin(), expected.end());
        for (std::size_t k = 0; k < expected.size(); k++) {
            EXPECT_NEAR(found.deviation_e_radps[k], expected[k], 0.08 * dip)
                << c.name << " at " << c.speed_e_radps << ", period " << k;
        }
    }
}

/// An observer of the load alone has no d_q^ and d_d^, which would be modes that never settle.
TEST(SpeedFormModel, StatesThatNothingMovesAreLeftOut)
{
    const sdre::Design         speed = designed("ipmsm_390w_speed");
    const sdre::Design         load  = designed("ipmsm_390w_conventional");
    const sdre::OperatingPoint at{300.0, 1.5, -0.4};
    const auto                 model = [&](const sdre::Design &d) {
        return sdre::speed_form_model(d.l, d.l, d.drive.nodo.form, gains_at(d, at), at, 2e-4);
    };
    EXPECT_EQ(model(speed).A.rows(), 11);
    EXPECT_EQ(model(load).A.rows(), 9);
    EXPECT_LT(sdre::spectral_radius(model(load).A), 0.99);
}

/// The estimated load is the load, and the speed has no error.
TEST(SpeedFormModel, LoadEndsInItsEstimate)
{
    const sdre::Design         d = designed("ipmsm_390w_speed");
    const sdre::OperatingPoint at{300.0, 1.5, -0.4};
    const auto m = sdre::speed_form_model(d.l, d.l, d.drive.nodo.form, gains_at(d, at), at, 2e-4);
    const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(11, 11) - m.A;
    const Eigen::VectorXd x    = rest.partialPivLu().solve(m.b_load);
    EXPECT_NEAR(x(0), 0.0, 1e-6);
    EXPECT_NEAR(x(3) / -d.l[3], 1.0, 1e-6);
}
