// SPDX-License-Identifier: MIT
#include "linalg/linalg_checks.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "linalg/eigenvalues.hpp"

namespace sdre {

namespace {

/// A product such as C'WC in double is symmetric to a few 1e-16; anything above this is a typing
/// error.
constexpr double symmetry_tolerance = 1e-12;

/// A negative weight on a state that is coupled to no other cannot come from rounding, however
/// small it is next to the other weights.
Eigen::Index decoupled_negative_entry(const Eigen::MatrixXd &M)
{
    for (Eigen::Index i = 0; i < M.rows(); ++i) {
        if (M(i, i) < 0.0 && (M.row(i).array() != 0.0).count() == 1) {
            return i;
        }
    }
    return -1;
}

/// Cholesky with diagonal pivots until nothing but rounding is left: an accepted M has no eigenvalue below -noise. Much
/// quicker than the eigenvalues, which decide about the rest. M has entries up to 1.
bool has_a_factor(Eigen::MatrixXd M, double noise)
{
    const Eigen::Index n = M.rows();
    for (Eigen::Index step = 0; step < n; step++) {
        Eigen::Index k     = 0;
        const double pivot = M.diagonal().maxCoeff(&k);
        if (!(pivot > 0.1 * noise / static_cast<double>(n))) {
            break;
        }
        const Eigen::VectorXd column = M.col(k) / std::sqrt(pivot);
        for (Eigen::Index j = 0; j < n; j++) {
            M.col(j) -= column * column(j);
        }
        M.row(k).setZero();
        M.col(k).setZero();
    }
    return M.cwiseAbs().maxCoeff() <= 0.1 * noise / static_cast<double>(n);
}

} // namespace

void require_shape(const Eigen::MatrixXd &M, Eigen::Index rows, Eigen::Index cols,
                   const std::string &name)
{
    if (M.rows() != rows || M.cols() != cols) {
        throw InputError(
            fmt::format("{} is {} x {}, must be {} x {}", name, M.rows(), M.cols(), rows, cols));
    }
}

void require_square(const Eigen::MatrixXd &M, const std::string &name)
{
    if (M.rows() == 0 || M.rows() != M.cols()) {
        throw InputError(
            fmt::format("{} is {} x {}, must be square and not empty", name, M.rows(), M.cols()));
    }
}

void require_finite(const Eigen::MatrixXd &M, const std::string &name)
{
    for (Eigen::Index i = 0; i < M.rows(); ++i) {
        for (Eigen::Index j = 0; j < M.cols(); ++j) {
            if (!std::isfinite(M(i, j))) {
                throw InputError(
                    fmt::format("{} has the entry {} in row {}, column {}, must be finite", name,
                                M(i, j), i + 1, j + 1));
            }
        }
    }
}

bool is_symmetric(const Eigen::MatrixXd &M)
{
    const double bound = symmetry_tolerance * M.cwiseAbs().maxCoeff();
    for (Eigen::Index i = 0; i < M.rows(); ++i) {
        for (Eigen::Index j = 0; j < i; ++j) {
            if (std::abs(M(i, j) - M(j, i)) > bound) {
                return false;
            }
        }
    }
    return true;
}

void require_symmetric(const Eigen::MatrixXd &M, const std::string &name)
{
    if (!is_symmetric(M)) {
        throw DesignError(fmt::format("{} is not symmetric", name));
    }
}

std::string semidefinite_defect(const Eigen::MatrixXd &M, const std::string &name)
{
    const double size = M.cwiseAbs().maxCoeff();
    if (size == 0.0) {
        return "";
    }
    if (const Eigen::Index i = decoupled_negative_entry(M); i >= 0) {
        return fmt::format("{} is not positive semidefinite: entry ({}, {}) is {}", name, i + 1,
                           i + 1, M(i, i));
    }
    // Scaled first: an entry of 1e300 would overflow inside the eigenvalue iteration.
    const Eigen::MatrixXd scaled = 0.5 * (M / size + M.transpose() / size);
    const double          noise =
        100.0 * static_cast<double>(M.rows()) * std::numeric_limits<double>::epsilon();
    if (has_a_factor(scaled, noise)) {
        return "";
    }
    const double smallest = eigenvalues(scaled).real().minCoeff();
    if (!(smallest >= -noise)) {
        return fmt::format("{} is not positive semidefinite: smallest eigenvalue {:.6g}", name,
                           smallest * size);
    }
    return "";
}

void require_positive_semidefinite(const Eigen::MatrixXd &M, const std::string &name)
{
    if (const std::string defect = semidefinite_defect(M, name); !defect.empty()) {
        throw DesignError(defect);
    }
}

std::string mode_text(std::complex<double> s)
{
    // Adding 0.0 turns a negative zero into zero.
    if (std::abs(s.imag()) <= 1e-12 * std::abs(s)) {
        return fmt::format("{:.6g}", s.real() + 0.0);
    }
    return fmt::format("{:.6g} {} {:.6g}j", s.real() + 0.0, s.imag() < 0.0 ? '-' : '+',
                       std::abs(s.imag()));
}

float gain_entry(const Eigen::MatrixXd &gain, Eigen::Index row, Eigen::Index column)
{
    const double x = gain(row, column);
    return (std::abs(x) < 1e-12 * gain.norm()) ? 0.0F : static_cast<float>(x);
}

} // namespace sdre
