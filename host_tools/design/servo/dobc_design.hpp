// SPDX-License-Identifier: MIT
/// Paper B's disturbance observer and its state feedback, from the specified poles to the sampled
/// recursion.
///
/// With the mechanical speed error x1, the current error x2, the disturbances' values and rates and the q voltage:
///
///     x1' = b x2,  x2' = -a x2 + sum of disturbances - u_qi / L,  b = K_t/J, a = B/J + R/L,
///     K_t = 1.5 n_p flux                                                              EQ-DOBC-4
///     l by coefficient matching of det(sI - F) with the wanted polynomial             EQ-DOBC-5
///     M = e^(F Ts), Phi = int e^(F t) dt, g = Phi E / Ts, h = Phi H                   EQ-DOBC-6
///     k1 = lc^2 L / b, k2 = L (2 lc - a), oscillators L [cos(w Ts/2), sin(w Ts/2)/w] / sinc(w Ts/2)
///                                                                                     EQ-DOBC-7
#pragma once

#include <vector>

#include <Eigen/Core>

#include "drive/drive_file.hpp"

namespace sdre {

/// The motor as paper B's (5) sees it; mechanical speed.
struct ServoPlant {
    double kt_NmpA = 0.0; ///< torque per ampere
    double b       = 0.0; ///< acceleration per ampere [rad/s^2/A]
    double a       = 0.0; ///< sum of the mechanical and the electrical pole [1/s]
    double L_H     = 0.0;
};

ServoPlant servo_plant(const Motor &motor);

/// Coefficients of a polynomial, highest power first.
using Polynomial = std::vector<double>;

struct DobcDesign {
    std::vector<double> oscillators_radps;    ///< angular frequencies
    Polynomial          wanted;               ///< det(sI - F) as it should be
    double              matching_error = 0.0; ///< largest relative error of a recovered coefficient
    Eigen::VectorXd     l;                    ///< observer gains l_2 .. l_(N+6)
    Eigen::MatrixXd     F;                    ///< z' = F z + G x1 + H u_qi, x^ = z + E x1
    Eigen::VectorXd     E;
    Eigen::VectorXd     H;
    double              k1 = 0.0; ///< [V s/rad], mechanical
    double              k2 = 0.0; ///< [V/A]
    Eigen::RowVectorXd  K;        ///< of x^: k2, then the compensation
    Eigen::MatrixXd     M;        ///< x^(k+1) = M x^ + g (x1(k+1) - x1(k)) + h u_qi(k)
    Eigen::VectorXd     g;
    Eigen::VectorXd     h;
};

/// Computed in double (the exponential in extended precision): single precision would spread a sixfold pole
/// by 10 %.
DobcDesign design_dobc(const Motor &motor, const DobcSpec &spec, double ts_s);

} // namespace sdre
