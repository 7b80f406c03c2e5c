// SPDX-License-Identifier: MIT
/// tests/data/gains_public.json as drives and matrices.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "drive/drive_file.hpp"
#include "temp_dir.hpp"

namespace support {

inline Eigen::MatrixXd matrix_of(const nlohmann::json &rows)
{
    Eigen::MatrixXd M(static_cast<Eigen::Index>(rows.size()),
                      static_cast<Eigen::Index>(rows[0].size()));
    for (Eigen::Index i = 0; i < M.rows(); i++) {
        for (Eigen::Index j = 0; j < M.cols(); j++) {
            M(i, j) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)].get<double>();
        }
    }
    return M;
}

inline nlohmann::json reference_gains()
{
    return nlohmann::json::parse(read_file(std::string(SDRE_TEST_DATA_DIR) + "/gains_public.json"));
}

inline std::filesystem::path shipped_drive(const std::string &name)
{
    return std::filesystem::path(SDRE_SOURCE_DIR) / "firmware/config/drives" / (name + ".toml");
}

/// The drive of one reference case: its motor and weights, the rest from the shipped file.
inline sdre::Drive drive_of(const std::string &name, const nlohmann::json &reference)
{
    const bool  servo = name.rfind("servo", 0) == 0;
    sdre::Drive drive =
        sdre::read_drive_file(shipped_drive(servo ? "servo_200w" : "ipmsm_390w_speed"));
    const nlohmann::json motor        = reference.at("motor");
    const nlohmann::json weights      = reference.at("weights");
    drive.motor.pole_pairs            = motor.at("p").get<int>() / 2;
    drive.motor.stator_resistance_Ohm = motor.at("Rs").get<double>();
    drive.motor.d_axis_inductance_H   = motor.at("Ld").get<double>();
    drive.motor.q_axis_inductance_H   = motor.at("Lq").get<double>();
    drive.motor.pm_flux_Wb            = motor.at("lam").get<double>();
    drive.motor.inertia_kgm2          = motor.at("J").get<double>();
    drive.motor.viscous_friction_Nms  = motor.at("B").get<double>();
    drive.nosc.order                  = reference.at("order").get<int>();
    drive.nodo.order                  = drive.nosc.order;
    for (std::size_t i = 0; i < 3; i++) {
        drive.nosc.Q[i] = weights.at("q")[i].get<double>();
        drive.nodo.T[i] = weights.at("td")[i + 3].get<double>();
    }
    for (std::size_t i = 0; i < 2; i++) {
        drive.nosc.T[i] = weights.at("t")[i].get<double>();
    }
    for (std::size_t i = 0; i < 6; i++) {
        drive.nodo.Q[i] = weights.at("qd")[i].get<double>();
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
