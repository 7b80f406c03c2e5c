// SPDX-License-Identifier: MIT
/// A machine whose iron saturates in closed form. Its co-energy depends on u = (L_d (i_d + i_m)^2 + L_q i_q^2) / 2 alone. The slope is
/// (1 + b u0) / (1 + b u). Its fluxes are the slopes of that energy, so it has the cross saturation that iron has.
#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>

#include "drive/drive_file.hpp"
#include "shipped_drive.hpp"
#include "temp_dir.hpp"

namespace support {

struct Iron {
    double ld_H = 0.07498, lq_H = 0.11391, magnet_Wb = 0.193;
    double b = 0.3;

    double slope(double id_A, double iq_A) const
    {
        const double i_m = magnet_Wb / ld_H;
        return (1.0 + b * energy(i_m, 0.0)) / (1.0 + b * energy(id_A + i_m, iq_A));
    }
    double psi_d(double id_A, double iq_A) const
    {
        return slope(id_A, iq_A) * (ld_H * id_A + magnet_Wb);
    }
    double psi_q(double id_A, double iq_A) const
    {
        return slope(id_A, iq_A) * lq_H * iq_A;
    }

private:
    double energy(double d_A, double q_A) const
    {
        return 0.5 * (ld_H * d_A * d_A + lq_H * q_A * q_A);
    }
};

/// from, from + step, .. of n points.
inline std::vector<double> even_axis(double from, double step, int n)
{
    std::vector<double> axis;
    for (int i = 0; i < n; i++) {
        axis.push_back(from + step * i);
    }
    return axis;
}

/// One row of iq values per id.
template <typename F>
std::vector<double> over(const std::vector<double> &id_A, const std::vector<double> &iq_A, F f)
{
    std::vector<double> all;
    for (const double d : id_A) {
        for (const double q : iq_A) {
            all.push_back(f(d, q));
        }
    }
    return all;
}

/// Fluxes over two axes.
inline std::vector<double> psi_d(const Iron &iron, const std::vector<double> &id_A,
                                 const std::vector<double> &iq_A)
{
    return over(id_A, iq_A, [&](double d, double q) { return iron.psi_d(d, q); });
}

inline std::vector<double> psi_q(const Iron &iron, const std::vector<double> &id_A,
                                 const std::vector<double> &iq_A)
{
    return over(id_A, iq_A, [&](double d, double q) { return iron.psi_q(d, q); });
}

inline std::string listed(const std::vector<double> &x)
{
    return fmt::format("[{:.12g}]", fmt::join(x, ", "));
}

/// A fine map of ipmsm_390w.
inline const std::vector<double> fine_id_axis = even_axis(-4.4, 0.2, 31);
inline const std::vector<double> fine_iq_axis = even_axis(0.0, 0.15, 31);

/// The shipped drive with that map in its file.
inline sdre::Drive saturated_drive(const Iron                &iron,
                                   const std::vector<double> &id_axis = fine_id_axis)
{
    const auto        file = shipped_drive("ipmsm_390w");
    const std::string text =
        read_file(file) +
        fmt::format("\n[saturation]\nid_A = {}\niq_A = {}\npsi_d_Wb = {}\npsi_q_Wb = {}\n",
                    listed(id_axis), listed(fine_iq_axis),
                    listed(psi_d(iron, id_axis, fine_iq_axis)),
                    listed(psi_q(iron, id_axis, fine_iq_axis)));
    return sdre::read_drive_text(text, "drive.toml", file.string());
}

} // namespace support
