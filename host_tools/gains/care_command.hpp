// SPDX-License-Identifier: MIT
/// The `care` command: one Riccati equation from a JSON file.
///
///     {"A": [[..]], "B": [[..]], "R": [[..]], "Q": [[..]]}      or      {"A": .., "G": .., "Q":
///     ..}
///
/// Matrices are arrays of rows. When B and R are there, they are used and G is ignored; other keys
/// are ignored.
#pragma once

#include <filesystem>
#include <string>

#include <Eigen/Core>

#include "linalg/care.hpp"

namespace sdre {

struct CareProblem {
    Eigen::MatrixXd A;
    Eigen::MatrixXd G; ///< always set: B R^-1 B' rounded to double when the file has B and R
    Eigen::MatrixXd Q;
    Eigen::MatrixXd B; ///< empty when the file has G only
    Eigen::MatrixXd R; ///< empty when the file has G only
};

/// Throws InputError "FILE: key 'B': what is wrong, what is allowed", one line, and DesignError
/// when R is not symmetric positive definite. The remaining assumptions are checked by the solver.
CareProblem read_care_problem(const std::filesystem::path &path);

/// The same for a text in memory; `name` stands for the file in messages.
CareProblem parse_care_problem(const std::string &text, const std::string &name);

/// From B and R when the problem has them, otherwise from G. Throws like solve_care(), but an indefinite Q may have an
/// indefinite X.
CareSolution solve_care_problem(const CareProblem &problem);

/// For people. Ends with a newline.
std::string care_text(const CareSolution &solution);

/// {"X": [[..]], "X_indefinite": .., "relative_residual": .., "closed_loop_eigenvalues": [[re, im], ..]} with as many
/// digits as give every bit back. Ends with a newline.
std::string care_json(const CareSolution &solution);

} // namespace sdre
