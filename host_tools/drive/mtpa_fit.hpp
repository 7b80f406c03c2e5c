// SPDX-License-Identifier: MIT
/// The curve of least current of a machine whose iron saturates, and the curve of a drive that is nearest to it.
#pragma once

#include <vector>

#include "drive/drive_file.hpp"

namespace sdre {

/// 1.5 n_p (psi_d i_q - psi_q i_d)
double torque_Nm(int pole_pairs, const FluxAt &flux, double id_A, double iq_A);

/// Most torque of this current, iq > 0.
struct MtpaPoint {
    double current_A = 0.0;
    double id_A      = 0.0;
    double iq_A      = 0.0;
    double torque_Nm = 0.0;
};
MtpaPoint most_torque(const FluxMap &map, int pole_pairs, double current_A);

/// The least current for a torque, at most this one.
MtpaPoint least_current(const FluxMap &map, int pole_pairs, double torque_Nm, double most_A);

/// d current of a curve (EQ-CURRENT-REF-2); k > 0.
double curve_id_A(const MtpaCurve &curve, double iq_A);

/// How much more current than that point a curve takes for its torque, as a share.
double excess_current(const FluxMap &map, int pole_pairs, const MtpaCurve &curve,
                      const MtpaPoint &at);

/// The largest excess from a quarter of the rated torque to the current limit (EQ-SATURATION-3).
double largest_excess(const FluxMap &map, const Motor &motor, const MtpaCurve &curve);

/// Curves that a law can have.
enum class MtpaForms { exact, second_order, both };

/// The curve with the least largest_excess().
MtpaCurve fit_mtpa(const FluxMap &map, const Motor &motor, MtpaForms forms);

} // namespace sdre
