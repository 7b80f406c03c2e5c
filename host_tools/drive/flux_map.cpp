// SPDX-License-Identifier: MIT
#include "drive/flux_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace sdre {
namespace {

/// Slope of the parabola through three points, at one of them.
double parabola_slope(const std::array<double, 3> &x, const std::array<double, 3> &y, double at)
{
    const double left  = (y[1] - y[0]) / (x[1] - x[0]);
    const double right = (y[2] - y[1]) / (x[2] - x[1]);
    return left + (right - left) / (x[2] - x[0]) * (2.0 * at - x[0] - x[1]);
}

/// Slopes at the points of an axis of three or more; the values are `stride` apart.
void slopes(const std::vector<double> &axis, const double *value, std::size_t stride, double *slope)
{
    const std::size_t n = axis.size();
    for (std::size_t i = 0; i < n; i++) {
        const std::size_t k = std::clamp<std::size_t>(i, 1, n - 2) - 1;
        slope[i * stride]   = parabola_slope(
              {axis[k], axis[k + 1], axis[k + 2]},
              {value[k * stride], value[(k + 1) * stride], value[(k + 2) * stride]}, axis[i]);
    }
}

/// The cell of an axis in which x lies.
std::size_t cell_of(const std::vector<double> &axis, double x)
{
    std::size_t i = 0;
    while (i + 2 < axis.size() && x >= axis[i + 1]) {
        i++;
    }
    return i;
}

/// Weights of value and slope at both ends of a cell of this width, t in 0 .. 1; then the same of the slope at t.
struct Hermite {
    std::array<double, 4> value; ///< left value, left slope, right value, right slope
    std::array<double, 4> slope;
};

Hermite hermite(double t, double width)
{
    const double s = 1.0 - t;
    return {
        {s * s * (1.0 + 2.0 * t), t * s * s * width, t * t * (3.0 - 2.0 * t), -t * t * s * width},
        {-6.0 * t * s / width, s * (1.0 - 3.0 * t), 6.0 * t * s / width, t * (3.0 * t - 2.0)}};
}

double sum(const std::array<double, 4> &d, const std::array<double, 4> &q,
           const std::array<std::array<double, 4>, 4> &corner)
{
    double all = 0.0;
    for (std::size_t i = 0; i < 4; i++) {
        for (std::size_t j = 0; j < 4; j++) {
            all += d[i] * q[j] * corner[i][j];
        }
    }
    return all;
}

/// The grid of an axis from 0 mirrored, and a table over it: rows of values that are even or odd.
std::vector<double> mirrored_axis(const std::vector<double> &iq_A)
{
    std::vector<double> all;
    for (std::size_t j = iq_A.size() - 1; j > 0; j--) {
        all.push_back(-iq_A[j]);
    }
    all.insert(all.end(), iq_A.begin(), iq_A.end());
    return all;
}

std::vector<double> mirrored(const std::vector<double> &value, std::size_t width, double sign)
{
    std::vector<double> all;
    for (std::size_t row = 0; row < value.size(); row += width) {
        for (std::size_t j = width - 1; j > 0; j--) {
            all.push_back(sign * value[row + j]);
        }
        all.push_back(sign > 0.0 ? value[row] : 0.0);
        for (std::size_t j = 1; j < width; j++) {
            all.push_back(value[row + j]);
        }
    }
    return all;
}

} // namespace

FluxSurface::FluxSurface(const std::vector<double> &id_A, const std::vector<double> &iq_A,
                         std::vector<double> value)
    : id_A_(id_A), iq_A_(iq_A), value_(std::move(value)), by_d_(value_), by_q_(value_),
      by_dq_(value_)
{
    const std::size_t width = iq_A_.size();
    for (std::size_t j = 0; j < width; j++) {
        slopes(id_A_, value_.data() + j, width, by_d_.data() + j);
    }
    for (std::size_t row = 0; row < value_.size(); row += width) {
        slopes(iq_A_, value_.data() + row, 1, by_q_.data() + row);
        slopes(iq_A_, by_d_.data() + row, 1, by_dq_.data() + row);
    }
}

FluxSurface::Local FluxSurface::inside(double id_A, double iq_A) const
{
    const std::size_t i     = cell_of(id_A_, id_A);
    const std::size_t j     = cell_of(iq_A_, iq_A);
    const double      width = id_A_[i + 1] - id_A_[i];
    const double      depth = iq_A_[j + 1] - iq_A_[j];
    const Hermite     d     = hermite((id_A - id_A_[i]) / width, width);
    const Hermite     q     = hermite((iq_A - iq_A_[j]) / depth, depth);

    std::array<std::array<double, 4>, 4> corner{};
    for (std::size_t a = 0; a < 2; a++) {
        for (std::size_t b = 0; b < 2; b++) {
            const std::size_t at         = (i + a) * iq_A_.size() + j + b;
            corner[2 * a][2 * b]         = value_[at];
            corner[2 * a + 1][2 * b]     = by_d_[at];
            corner[2 * a][2 * b + 1]     = by_q_[at];
            corner[2 * a + 1][2 * b + 1] = by_dq_[at];
        }
    }
    return {sum(d.value, q.value, corner), sum(d.slope, q.value, corner),
            sum(d.value, q.slope, corner)};
}

FluxSurface::Local FluxSurface::at(double id_A, double iq_A) const
{
    const double d    = std::clamp(id_A, id_A_.front(), id_A_.back());
    const double q    = std::clamp(iq_A, iq_A_.front(), iq_A_.back());
    Local        edge = inside(d, q);
    edge.value += edge.by_d * (id_A - d) + edge.by_q * (iq_A - q);
    return edge;
}

FluxMap::FluxMap(const std::vector<double> &id_A, const std::vector<double> &iq_A,
                 const std::vector<double> &psi_d_Wb, const std::vector<double> &psi_q_Wb)
    : id_A_(id_A), iq_A_(iq_A), d_(id_A, mirrored_axis(iq_A), mirrored(psi_d_Wb, iq_A.size(), 1.0)),
      q_(id_A, mirrored_axis(iq_A), mirrored(psi_q_Wb, iq_A.size(), -1.0)),
      magnet_Wb_(d_.at(0.0, 0.0).value)
{
}

FluxAt FluxMap::at(double id_A, double iq_A) const
{
    const FluxSurface::Local d = d_.at(id_A, iq_A);
    const FluxSurface::Local q = q_.at(id_A, iq_A);
    return {d.value, q.value, d.by_d, d.by_q, q.by_d, q.by_q};
}

SaturatedMotor::SaturatedMotor(std::shared_ptr<const FluxMap> map, const FluxScale &scale)
    : map_(std::move(map)), scale_(scale), magnet_Wb_(scale.magnet * map_->magnet_Wb()),
      level_(std::sqrt(scale.ld * scale.lq)), skew_(std::sqrt(std::sqrt(scale.ld / scale.lq)))
{
}

SaturatedMotor SaturatedMotor::scaled(const FluxScale &by) const
{
    return {map_, {scale_.magnet * by.magnet, scale_.ld * by.ld, scale_.lq * by.lq}};
}

FluxAt SaturatedMotor::at(double id_A, double iq_A) const
{
    const FluxAt f = map_->at(skew_ * id_A, iq_A / skew_);
    return {magnet_Wb_ + level_ * skew_ * (f.d_Wb - map_->magnet_Wb()),
            level_ / skew_ * f.q_Wb,
            level_ * skew_ * skew_ * f.dd_H,
            level_ * f.dq_H,
            level_ * f.qd_H,
            level_ / (skew_ * skew_) * f.qq_H};
}

std::array<double, 2> by_inductance(const FluxAt &at, double d, double q)
{
    const double det = at.dd_H * at.qq_H - at.dq_H * at.qd_H;
    return {(at.qq_H * d - at.dq_H * q) / det, (at.dd_H * q - at.qd_H * d) / det};
}

} // namespace sdre
