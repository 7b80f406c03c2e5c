// SPDX-License-Identifier: MIT
/// Invariant subspace of the scaled Hamiltonian from an ordered Schur form, then Newton steps, all
/// in long double (extended.hpp says why). The Schur form finds the solution whatever the starting
/// point; the Newton steps remove what its orthogonal transformations lost to the size of X.
#include "linalg/riccati.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include <Eigen/Jacobi>
#include <Eigen/LU>
#include <Eigen/QR>
#include <fmt/format.h>

#include "common/errors.hpp"
#include "linalg/extended.hpp"
#include "linalg/linalg_checks.hpp"

namespace sdre::extended {

namespace {

constexpr Scalar double_rounding = std::numeric_limits<double>::epsilon();
// Measured on the benchmark set: residual below 1e-15 (2e-13 in case 2.2), backward error below
// 1e-16. Random systems with 1e8 between A and G X reach a residual of 3e-10.
constexpr double residual_bound       = 1e-8;
constexpr Scalar backward_error_bound = 1e-14L;

struct Problem {
    Matrix        A;
    ControlWeight weight;
    Matrix        Q;
};

Matrix residual(const Problem &p, const Matrix &X)
{
    const Matrix XA = X * p.A;
    return XA + XA.transpose() - p.weight.quadratic(X) + p.Q; // EQ-CARE-1
}

Scalar relative_residual(const Problem &p, const Matrix &X)
{
    const Scalar size =
        2 * (p.A.transpose() * X).norm() + p.weight.quadratic(X).norm() + p.Q.norm();
    return size > 0 ? residual(p, X).norm() / size : Scalar(0); // EQ-CARE-2
}

/// The relative change of the entries of A, G and Q that explains the residual. Where the terms of
/// X G X cancel it stays small while EQ-CARE-2 grows: no double matrix G says more about X then.
Scalar backward_error(const Problem &p, const Matrix &X)
{
    const Matrix size  = X.cwiseAbs();
    const Matrix AX    = p.A.cwiseAbs().transpose() * size;
    const Matrix terms = AX + AX.transpose() + size * p.weight.G.cwiseAbs() * size + p.Q.cwiseAbs();
    const Scalar norm  = terms.norm();
    return norm > 0 ? residual(p, X).norm() / norm : Scalar(0);
}

/// Powers of two d such that x = diag(d) z brings rows and columns of the Hamiltonian to similar
/// size. In z the equation keeps its form with A_ij d_j/d_i, G_ij/(d_i d_j), Q_ij d_i d_j and X_ij
/// d_i d_j, exactly.
Vector balancing(const Problem &p)
{
    const Eigen::Index n = p.A.rows();
    const Matrix       A = p.A.cwiseAbs();
    const Matrix       G = p.weight.G.cwiseAbs();
    const Matrix       Q = p.Q.cwiseAbs();
    Vector             d = Vector::Ones(n);
    for (int sweep = 0; sweep < 60; ++sweep) {
        for (Eigen::Index i = 0; i < n; ++i) {
            Scalar column = 0;
            Scalar row    = 0;
            for (Eigen::Index j = 0; j < n; ++j) {
                column += Q(j, i) * d(j) * d(i) + (j != i ? A(j, i) * d(i) / d(j) : 0);
                row += G(i, j) / (d(i) * d(j)) + (j != i ? A(i, j) * d(j) / d(i) : 0);
            }
            if (column > 0 && row > 0) {
                // The diagonal entries move with the square of d: the fourth root does not
                // overshoot.
                d(i) *= std::sqrt(std::sqrt(row / column));
            }
        }
    }
    return d.unaryExpr([](Scalar v) { return std::exp2(std::round(std::log2(v))); });
}

Problem scaled(const Problem &p, const Vector &d)
{
    const Vector inv = d.cwiseInverse();
    Problem      s;
    s.A        = inv.asDiagonal() * p.A * d.asDiagonal();
    s.weight.G = inv.asDiagonal() * p.weight.G * inv.asDiagonal();
    if (p.weight.F.size() > 0) {
        s.weight.F = inv.asDiagonal() * p.weight.F;
    }
    s.Q = d.asDiagonal() * p.Q * d.asDiagonal();
    return s;
}

Matrix hamiltonian(const Problem &p)
{
    const Eigen::Index n = p.A.rows();
    Matrix             H(2 * n, 2 * n);
    H << p.A, -p.weight.G, -p.Q, -p.A.transpose();
    return H;
}

/// Exchanges the neighbouring eigenvalues k and k + 1 of the triangular factor.
void swap_neighbours(SchurForm &s, Eigen::Index k)
{
    const Eigen::Index             size   = s.T.rows();
    const Complex                  first  = s.T(k, k);
    const Complex                  second = s.T(k + 1, k + 1);
    Eigen::JacobiRotation<Complex> rotation;
    rotation.makeGivens(s.T(k, k + 1), second - first);
    s.T.rightCols(size - k).applyOnTheLeft(k, k + 1, rotation.adjoint());
    s.T.topRows(k + 2).applyOnTheRight(k, k + 1, rotation);
    s.U.applyOnTheRight(k, k + 1, rotation);
    s.T(k, k)         = second;
    s.T(k + 1, k + 1) = first;
    s.T(k + 1, k)     = 0;
}

/// Schur form of H with the half of the spectrum of smaller real part first.
SchurForm stable_first(const Matrix &H)
{
    SchurForm                 s    = schur_form(H);
    const Eigen::Index        size = H.rows();
    std::vector<Eigen::Index> rank(static_cast<std::size_t>(size));
    std::iota(rank.begin(), rank.end(), Eigen::Index(0));
    std::stable_sort(rank.begin(), rank.end(), [&](Eigen::Index a, Eigen::Index b) {
        return s.T(a, a).real() < s.T(b, b).real();
    });
    std::vector<Eigen::Index> chosen(rank.begin(), rank.begin() + size / 2);
    std::sort(chosen.begin(), chosen.end());
    for (std::size_t target = 0; target < chosen.size(); ++target) {
        for (Eigen::Index k = chosen[target]; k > static_cast<Eigen::Index>(target); --k) {
            swap_neighbours(s, k - 1);
        }
    }
    return s;
}

/// How far [A - sI, W] is from losing rank, between 0 and 1 and blind to the size of the columns of
/// W and to the scaling of single states: 0 means that the mode s is not connected to W.
Scalar hautus_margin(const Matrix &A, const Matrix &W, Complex s)
{
    const Eigen::Index n = A.rows();
    ComplexMatrix      M(n, 2 * n);
    M << A.cast<Complex>(), W.cast<Complex>();
    M.leftCols(n).diagonal().array() -= s;
    for (Eigen::Index i = 0; i < n; ++i) {
        const Scalar size = A.row(i).norm() + std::abs(s);
        if (size > 0) {
            M.row(i) /= Complex(size);
        }
    }
    const Scalar floor =
        M.rightCols(n).colwise().norm().maxCoeff() * std::numeric_limits<Scalar>::epsilon();
    for (Eigen::Index j = n; j < 2 * n && floor > 0; ++j) {
        M.col(j) /= Complex(std::max(floor, Scalar(M.col(j).norm())));
    }
    const Eigen::ColPivHouseholderQR<ComplexMatrix> qr(M.adjoint());
    const Scalar                                    largest = std::abs(qr.matrixQR()(0, 0));
    return largest > 0 ? std::abs(qr.matrixQR()(n - 1, n - 1)) / largest : Scalar(0);
}

std::string unstabilisable_text(Complex s)
{
    return fmt::format("(A,B) is not stabilisable: mode at s = {} cannot be moved",
                       mode_text(std::complex<double>(s)));
}

/// The mode with Re s >= 0 that the input reaches least.
struct WeakestMode {
    Complex s{0, 0};
    Scalar  margin = 1;
};

WeakestMode weakest_unstable_mode(const Problem &p)
{
    const ComplexVector modes = eigenvalues(p.A);
    WeakestMode         weakest;
    for (const Complex &s : modes) {
        if (s.real() < 0 || s.imag() < 0) {
            continue;
        }
        const Scalar margin = hautus_margin(p.A, p.weight.G, s);
        if (margin < weakest.margin) {
            weakest = {s, margin};
        }
    }
    return weakest;
}

void require_stabilisable(const Problem &p)
{
    const WeakestMode weakest = weakest_unstable_mode(p);
    if (weakest.margin <= Scalar(4 * p.A.rows()) * double_rounding) {
        throw DesignError(unstabilisable_text(weakest.s));
    }
}

/// For G, Q >= 0 the Hamiltonian has an eigenvalue on the axis exactly when a mode of A on the axis
/// is out of reach of the input or out of sight of Q; the smaller margin tells which.
void require_no_axis_eigenvalue(const Problem &p, const Matrix &H, const ComplexVector &spectrum)
{
    Complex s;
    if (!find_axis_eigenvalue(H, spectrum, s)) {
        return;
    }
    const std::string axis = fmt::format(
        "Hamiltonian has eigenvalues on the imaginary axis (s = {}): no stabilising solution",
        mode_text(std::complex<double>(s)));
    constexpr Scalar lost  = 1e-6L;
    const Scalar     reach = hautus_margin(p.A, p.weight.G, s);
    const Scalar     sight = hautus_margin(p.A.transpose(), p.Q, std::conj(s));
    if (reach < lost && reach <= sight) {
        throw DesignError(unstabilisable_text(s) + "; " + axis);
    }
    if (sight < lost) {
        throw DesignError(
            fmt::format("(A,Q) is not detectable: mode at s = {} is not weighted by Q; {}",
                        mode_text(std::complex<double>(s)), axis));
    }
    throw DesignError(axis);
}

/// For failures behind the checks above: names the assumption when one is nearly broken.
[[noreturn]] void refuse(const Problem &balanced, const std::string &reason)
{
    constexpr Scalar  nearly_lost = 1e-9L;
    const WeakestMode weakest     = weakest_unstable_mode(balanced);
    if (weakest.margin < nearly_lost) {
        throw DesignError(unstabilisable_text(weakest.s) + " to working precision; " + reason);
    }
    throw DesignError("no acceptable solution: " + reason);
}

/// X from the basis [U1; U2] of the stable subspace: X = U2 U1^-1.
Matrix subspace_solution(const Problem &p, const SchurForm &s)
{
    const Eigen::Index  n  = p.A.rows();
    const ComplexMatrix U1 = s.U.topLeftCorner(n, n);
    const ComplexMatrix U2 = s.U.bottomLeftCorner(n, n);
    const ComplexMatrix Xt = U1.transpose().fullPivLu().solve(U2.transpose());
    const Matrix        X  = symmetric_part(Xt.real());
    if (!X.allFinite()) {
        refuse(p, "the stable subspace of the Hamiltonian has no solution");
    }
    return X;
}

/// Newton-Kleinman corrections until the residual stops falling.
Matrix refined(const Problem &p, Matrix X)
{
    Scalar best = residual(p, X).norm();
    for (int step = 0; step < 20 && best > 0; ++step) {
        const LyapunovSolver closed_loop(p.A - p.weight.G * X);
        const Matrix         candidate = X + closed_loop.solve(residual(p, X));
        const Scalar         norm      = residual(p, candidate).norm();
        if (!(norm < best)) {
            break;
        }
        X    = candidate;
        best = norm;
    }
    return X;
}

} // namespace

Matrix ControlWeight::quadratic(const Matrix &X) const
{
    if (F.size() == 0) {
        return X * G * X;
    }
    const Matrix FX = F.transpose() * X;
    return FX.transpose() * FX;
}

ControlWeight control_weight(const Eigen::MatrixXd &B, const Eigen::MatrixXd &R)
{
    require_square(R, "R");
    if (B.rows() == 0 || B.cols() != R.rows()) {
        throw InputError(fmt::format("B is {} x {}, must have {} columns like R and not be empty",
                                     B.rows(), B.cols(), R.rows()));
    }
    require_finite(B, "B");
    require_finite(R, "R");
    require_symmetric(R, "R");

    // Cholesky by hand: the pivots decide whether R is positive definite to the digits of a double.
    const Eigen::Index m = R.rows();
    Matrix             L = Matrix::Zero(m, m);
    for (Eigen::Index j = 0; j < m; ++j) {
        const Scalar diagonal = R(j, j);
        const Scalar pivot    = diagonal - L.row(j).head(j).squaredNorm();
        if (!(pivot > Scalar(m) * double_rounding * diagonal)) {
            throw DesignError("R is not positive definite");
        }
        L(j, j) = std::sqrt(pivot);
        for (Eigen::Index i = j + 1; i < m; ++i) {
            const Scalar entry = (Scalar(R(i, j)) + Scalar(R(j, i))) / 2;
            L(i, j)            = (entry - L.row(i).head(j).dot(L.row(j).head(j))) / L(j, j);
        }
    }
    ControlWeight weight;
    weight.F =
        L.triangularView<Eigen::Lower>().solve(Matrix(B.transpose().cast<Scalar>())).transpose();
    weight.G = symmetric_part(weight.F * weight.F.transpose());
    return weight;
}

namespace {

/// Checks every assumption on A and Q, those on the weight being checked by who made it.
Problem checked_problem(const Eigen::MatrixXd &A, const ControlWeight &weight,
                        const Eigen::MatrixXd &Q)
{
    require_square(A, "A");
    require_shape(Q, A.rows(), A.cols(), "Q");
    require_finite(A, "A");
    require_finite(Q, "Q");
    require_symmetric(Q, "Q");
    if (weight.G.rows() != A.rows()) {
        throw InputError(
            fmt::format("B has {} rows, A has {}: must be equal", weight.G.rows(), A.rows()));
    }
    return {A.cast<Scalar>(), weight, symmetric_part(Q.cast<Scalar>())};
}

/// Stabilising X of the balanced problem.
Matrix stabilising_solution(const Problem &p)
{
    require_stabilisable(p);
    const Matrix H = hamiltonian(p);
    if (!H.allFinite()) {
        throw DesignError("the entries of A, G and Q are too far apart for the arithmetic");
    }
    require_no_axis_eigenvalue(p, H, eigenvalues(H));
    return refined(p, subspace_solution(p, stable_first(H)));
}

/// Throws unless the closed loop is stable. Returns its eigenvalues.
Eigen::VectorXcd stable_closed_loop(const Problem &balanced, const Matrix &X)
{
    const Eigen::VectorXcd modes =
        sorted_eigenvalues(eigenvalues(balanced.A - balanced.weight.G * X));
    const std::complex<double> slowest = modes(modes.size() - 1);
    if (!(slowest.real() < 0.0)) {
        refuse(balanced,
               fmt::format("the closed loop has an eigenvalue at s = {}", mode_text(slowest)));
    }
    return modes;
}

/// The double X that is returned, not a better one, must solve and stabilise.
CareResult solve_and_verify(const Problem &p)
{
    const Vector  d        = balancing(p);
    const Problem balanced = scaled(p, d);
    const Matrix  Xb       = stabilising_solution(balanced);
    const Vector  inv      = d.cwiseInverse();

    CareResult result;
    result.X          = inv.asDiagonal() * Xb * inv.asDiagonal();
    result.solution.X = result.X.cast<double>();
    if (!result.solution.X.allFinite()) {
        throw DesignError("the solution of the Riccati equation exceeds the range of a double");
    }
    const Matrix rounded              = result.solution.X.cast<Scalar>();
    result.solution.relative_residual = static_cast<double>(relative_residual(p, rounded));
    if (!(result.solution.relative_residual <= residual_bound &&
          backward_error(p, rounded) <= backward_error_bound)) {
        refuse(balanced,
               fmt::format("the relative residual is {:.3g}", result.solution.relative_residual));
    }
    stable_closed_loop(balanced, d.asDiagonal() * rounded * d.asDiagonal());
    result.solution.closed_loop_eigenvalues = stable_closed_loop(balanced, Xb);
    return result;
}

/// An indefinite Q (cross weights shifted into A give one) may still have a stabilising X >= 0. It
/// is solved then, and named as the reason when it is not.
CareResult solve_verified(const Problem &p)
{
    const std::string defect = semidefinite_defect(p.Q.cast<double>(), "Q");
    if (defect.empty()) {
        return solve_and_verify(p);
    }
    CareResult result;
    try {
        result = solve_and_verify(p);
    } catch (const DesignError &error) {
        throw DesignError(defect + "; " + error.what());
    }
    if (!semidefinite_defect(result.solution.X, "X").empty()) {
        throw DesignError(defect + ", and neither is the stabilising solution");
    }
    return result;
}

} // namespace

CareResult solve_verified_care(const Eigen::MatrixXd &A, const Eigen::MatrixXd &G,
                               const Eigen::MatrixXd &Q)
{
    require_square(A, "A");
    require_shape(G, A.rows(), A.cols(), "G");
    require_finite(G, "G");
    require_symmetric(G, "G");
    require_positive_semidefinite(G, "G");
    ControlWeight weight;
    weight.G = symmetric_part(G.cast<Scalar>());
    return solve_verified(checked_problem(A, weight, Q));
}

CareResult solve_verified_care(const Eigen::MatrixXd &A, const Eigen::MatrixXd &B,
                               const Eigen::MatrixXd &R, const Eigen::MatrixXd &Q)
{
    return solve_verified(checked_problem(A, control_weight(B, R), Q));
}

} // namespace sdre::extended

namespace sdre {

Eigen::MatrixXd control_weight(const Eigen::MatrixXd &B, const Eigen::MatrixXd &R)
{
    const Eigen::MatrixXd G = extended::control_weight(B, R).G.cast<double>();
    if (!G.allFinite()) {
        throw DesignError("B R^-1 B' exceeds the range of a double");
    }
    return G;
}

CareSolution solve_care(const Eigen::MatrixXd &A, const Eigen::MatrixXd &G,
                        const Eigen::MatrixXd &Q)
{
    return extended::solve_verified_care(A, G, Q).solution;
}

CareSolution solve_care(const Eigen::MatrixXd &A, const Eigen::MatrixXd &B,
                        const Eigen::MatrixXd &R, const Eigen::MatrixXd &Q)
{
    return extended::solve_verified_care(A, B, R, Q).solution;
}

} // namespace sdre
