// SPDX-License-Identifier: MIT
/// Flux linkages of a machine whose iron saturates, over both currents.
///
///     psi_d(i_d, i_q), psi_q(i_d, i_q): cubic between the points of a grid, with continuous slopes     EQ-SATURATION-1
///     psi_d(i_d, -i_q) = psi_d(i_d, i_q),  psi_q(i_d, -i_q) = -psi_q(i_d, i_q)
///     d psi_d / d i_q = d psi_q / d i_d, as the iron stores energy                                     EQ-SATURATION-2
///
/// Beyond the grid the slopes of its edge hold.
#pragma once

#include <array>
#include <memory>
#include <vector>

namespace sdre {

/// Flux linkages at a current, and their slopes: the incremental inductances. dq_H is d psi_d / d i_q.
struct FluxAt {
    double d_Wb = 0.0;
    double q_Wb = 0.0;
    double dd_H = 0.0;
    double dq_H = 0.0;
    double qd_H = 0.0;
    double qq_H = 0.0;
};

/// One quantity over a grid of currents.
class FluxSurface {
public:
    /// `value` has a row of iq values per id. Both axes increase and have three points at least.
    FluxSurface(const std::vector<double> &id_A, const std::vector<double> &iq_A,
                std::vector<double> value);

    struct Local {
        double value, by_d, by_q;
    };
    Local at(double id_A, double iq_A) const;

private:
    Local inside(double id_A, double iq_A) const;

    std::vector<double> id_A_, iq_A_;
    std::vector<double> value_, by_d_, by_q_, by_dq_;
};

class FluxMap {
public:
    /// One row of iq values per id; iq begins with 0, and psi_q is 0 there. psi_d has the magnet's flux in it.
    FluxMap(const std::vector<double> &id_A, const std::vector<double> &iq_A,
            const std::vector<double> &psi_d_Wb, const std::vector<double> &psi_q_Wb);

    FluxAt at(double id_A, double iq_A) const;
    /// psi_d without current.
    double magnet_Wb() const
    {
        return magnet_Wb_;
    }
    const std::vector<double> &id_A() const
    {
        return id_A_;
    }
    const std::vector<double> &iq_A() const
    {
        return iq_A_;
    }

private:
    std::vector<double> id_A_, iq_A_;
    FluxSurface         d_, q_;
    double              magnet_Wb_ = 0.0;
};

/// Factors of the machine that the map is of.
struct FluxScale {
    double magnet = 1.0;
    double ld     = 1.0;
    double lq     = 1.0;
};

/// A map with other inductances and another magnet. Its iron stores energy too. With a = sqrt(ld lq) and b = (ld / lq)^(1/4):
///
///     psi_d = magnet + a b (psi_d(b i_d, i_q / b) - psi_d(0, 0)),  psi_q = a / b psi_q(b i_d, i_q / b)
class SaturatedMotor {
public:
    SaturatedMotor(std::shared_ptr<const FluxMap> map, const FluxScale &scale = {});

    FluxAt at(double id_A, double iq_A) const;
    double magnet_Wb() const
    {
        return magnet_Wb_;
    }
    /// The same with further factors.
    SaturatedMotor scaled(const FluxScale &by) const;

private:
    std::shared_ptr<const FluxMap> map_;
    FluxScale                      scale_;
    double                         magnet_Wb_;
    double                         level_; ///< a
    double                         skew_;  ///< b
};

/// A flux linkage that changes so takes these d, q currents along: the inverse of the incremental inductances times it.
std::array<double, 2> by_inductance(const FluxAt &at, double d, double q);

} // namespace sdre
