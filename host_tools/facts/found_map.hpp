// SPDX-License-Identifier: MIT
/// The inductances over both currents that a commissioning measured, and the iron that they show.
///
///     W(x, y), x = psi_d - magnet, y = psi_q; i_d = dW/dx, i_q = dW/dy                        EQ-SATURATION-4
///     W = a20 x^2 + a30 x^3 + a40 x^4 + (a02 + a12 x + a22 x^2) y^2 + (a04 + a14 x + a24 x^2) y^4 + a06 y^6
///
/// The inductances are the inverse of the second derivatives. The ten numbers are fitted to twenty inductances. One energy
/// for both fluxes gives both cross terms, though only the q waves ran beside a d current (EQ-SATURATION-2).
#pragma once

#include <array>
#include <optional>
#include <string>

extern "C" {
#include "commission_types.h"
}

namespace sdre {

/// Incremental inductances [H] in the middle of each bin of current.
struct FoundMap {
    using Row = std::array<double, COMMISSION_BINS>;

    double             step_A = 0.0; ///< width of a bin without the other current; 0: not measured
    double             bias_A = 0.0;
    std::array<Row, 2> ld_H{}; ///< d current > 0 and < 0, without q current
    std::array<Row, 3> lq_H{}; ///< d current 0, -bias_A, -2 bias_A

    bool measured() const
    {
        return step_A > 0.0;
    }
    /// Current that was reached.
    double most_A() const
    {
        return step_A * COMMISSION_BINS;
    }
    /// Middle of a bin of q current beside -row bias_A of d current: all vectors end on one circle, EQ-COMMISSION-20.
    double iq_A(std::size_t row, std::size_t bin) const;
    /// Largest over smallest inductance of an axis, less 1; the larger one of both axes.
    double change() const;
};

/// The map in henry. Without a measurement, or with an empty bin, it is not measured.
FoundMap found_map(const commission_map_t &map, const commission_result_t &found);

/// EQ-SATURATION-4, its numbers in shares of the scales.
struct FoundIron {
    std::array<double, 10> a{0.5}; ///< a20, a30, a40, a02, a12, a22, a04, a14, a24, a06
    double                 scale_A = 1.0;
    double                 ld_H    = 1.0;
    double                 lq_H    = 1.0;
    double                 misfit  = 0.0; ///< rms of fitted over measured inductance, less 1

    struct Point {
        double d_Wb = 0.0; ///< without the magnet's
        double q_Wb = 0.0;
        double dd_H = 0.0;
        double qq_H = 0.0;
    };
    /// Nothing where the energy has no minimum.
    std::optional<Point> at(double id_A, double iq_A) const;
};

/// Fits a map that is measured.
FoundIron fit_iron(const FoundMap &map);

/// The table [saturation] of the iron up to a current limit [A], with the magnet's flux [Wb]. Empty where the fit does not reach so far.
std::string saturation_table(const FoundIron &iron, double magnet_Wb, double limit_A,
                             const std::string &how);

} // namespace sdre
