// SPDX-License-Identifier: MIT
/// Argument checks shared by the matrix equation solvers. Every message is one line and starts with
/// the name of the matrix.
#pragma once

#include <complex>
#include <string>

#include <Eigen/Core>

namespace sdre {

/// InputError unless M is rows x cols.
void require_shape(const Eigen::MatrixXd &M, Eigen::Index rows, Eigen::Index cols,
                   const std::string &name);

/// InputError unless M is square and not empty.
void require_square(const Eigen::MatrixXd &M, const std::string &name);

/// InputError when an entry is NaN or infinite.
void require_finite(const Eigen::MatrixXd &M, const std::string &name);

/// True when |M - M'| <= 1e-12 max|M| entry by entry. M must be square.
bool is_symmetric(const Eigen::MatrixXd &M);

/// DesignError "<name> is not symmetric". M must be square.
void require_symmetric(const Eigen::MatrixXd &M, const std::string &name);

/// "<name> is not positive semidefinite: .." or an empty text when it is. Eigenvalues that are
/// negative only by the rounding of the entries pass. M must be square, symmetric and finite.
std::string semidefinite_defect(const Eigen::MatrixXd &M, const std::string &name);

/// DesignError when there is such a defect.
void require_positive_semidefinite(const Eigen::MatrixXd &M, const std::string &name);

/// "1.5", "-2e-06" or "0.25 + 3j": a mode as it appears in messages.
std::string mode_text(std::complex<double> s);

/// One entry of a gain for the firmware. Entries that are zero in exact arithmetic come out of the solvers as rounding
/// noise; they become zero.
float gain_entry(const Eigen::MatrixXd &gain, Eigen::Index row, Eigen::Index column);

} // namespace sdre
