// SPDX-License-Identifier: MIT
/// tests/data/gains_public.json as drives and matrices.
#pragma once

#include <string>

#include <Eigen/Core>

#include "drive/drive_file.hpp"
#include "json.hpp"
#include "shipped_drive.hpp"

namespace support {

inline Eigen::MatrixXd matrix_of(const Json &rows)
{
    Eigen::MatrixXd M(static_cast<Eigen::Index>(rows.size()),
                      static_cast<Eigen::Index>(rows[0].size()));
    for (Eigen::Index i = 0; i < M.rows(); i++) {
        for (Eigen::Index j = 0; j < M.cols(); j++) {
            M(i, j) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)].number();
        }
    }
    return M;
}

inline Json reference_gains()
{
    return Json::read(std::string(SDRE_TEST_DATA_DIR) + "/gains_public.json");
}

/// The drive of one reference case: its motor and weights, the rest from the shipped file.
inline sdre::Drive drive_of(const std::string &name, const Json &reference)
{
    const bool  servo = name.rfind("servo", 0) == 0;
    sdre::Drive drive =
        sdre::read_drive_file(shipped_drive(servo ? "servo_200w" : "ipmsm_390w_speed"));
    const Json &motor                 = reference.at("motor");
    const Json &weights               = reference.at("weights");
    drive.motor.pole_pairs            = static_cast<int>(motor.at("p").number()) / 2;
    drive.motor.stator_resistance_Ohm = motor.at("Rs").number();
    drive.motor.d_axis_inductance_H   = motor.at("Ld").number();
    drive.motor.q_axis_inductance_H   = motor.at("Lq").number();
    drive.motor.pm_flux_Wb            = motor.at("lam").number();
    drive.motor.inertia_kgm2          = motor.at("J").number();
    drive.motor.viscous_friction_Nms  = motor.at("B").number();
    drive.nosc.order                  = static_cast<int>(reference.at("order").number());
    drive.nodo.order                  = drive.nosc.order;
    for (std::size_t i = 0; i < 3; i++) {
        drive.nosc.Q[i] = weights.at("q")[i].number();
        drive.nodo.T[i] = weights.at("td")[i + 3].number();
    }
    for (std::size_t i = 0; i < 2; i++) {
        drive.nosc.T[i] = weights.at("t")[i].number();
    }
    for (std::size_t i = 0; i < 6; i++) {
        drive.nodo.Q[i] = weights.at("qd")[i].number();
    }
    return drive;
}

/// |found - expected| / |expected|, Frobenius; absolute against `scale` when nothing is expected.
inline double relative_error(const Eigen::MatrixXd &found, const Eigen::MatrixXd &expected,
                             double scale)
{
    const double norm = expected.norm();
    return (found - expected).norm() / (norm > 1e-12 * scale ? norm : scale);
}

} // namespace support
