// SPDX-License-Identifier: MIT
// Time of solve_care() against SLICOT's SB02MD, called as it is, on the Riccati equations of drive files:
//
//     OPENBLAS_NUM_THREADS=1 riccati_benchmark DRIVE.toml..
//
// Both solve the same equation by turns, and the quickest round of each counts: what else the machine does only adds to
// it. Threads of a BLAS make SB02MD slower at these sizes.
#include <algorithm>
#include <chrono>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "design/design.hpp"
#include "drive/drive_file.hpp"

extern "C" void sb02md_(const char *dico, const char *hinv, const char *uplo, const char *scal,
                        const char *sort, const int *n, const double *A, const int *lda,
                        const double *G, const int *ldg, double *Q, const int *ldq, double *rcond,
                        double *wr, double *wi, double *s, const int *lds, double *u,
                        const int *ldu, int *iwork, double *dwork, const int *ldwork, int *bwork,
                        int *info, std::size_t, std::size_t, std::size_t, std::size_t, std::size_t);

namespace {

using sdre::SdreProblem;

constexpr int rounds      = 41;
constexpr int repetitions = 200;

/// Continuous time, direct Hamiltonian, scaled, stable eigenvalues first.
Eigen::MatrixXd slicot(const SdreProblem &p)
{
    const int           n     = static_cast<int>(p.A0.rows());
    const auto          size  = static_cast<std::size_t>(n);
    const int           twice = 2 * n;
    const int           work  = 64 * n;
    Eigen::MatrixXd     A     = p.A0;
    Eigen::MatrixXd     G     = p.G;
    Eigen::MatrixXd     X     = p.Q;
    double              rcond = 0.0;
    int                 info  = 0;
    std::vector<double> wr(2 * size), wi(2 * size), s(4 * size * size), u(4 * size * size);
    std::vector<double> dwork(64 * size);
    std::vector<int>    iwork(2 * size), bwork(2 * size);
    sb02md_("C", "D", "U", "G", "S", &n, A.data(), &n, G.data(), &n, X.data(), &n, &rcond,
            wr.data(), wi.data(), s.data(), &twice, u.data(), &twice, iwork.data(), dwork.data(),
            &work, bwork.data(), &info, 1, 1, 1, 1, 1);
    return info == 0 ? X : Eigen::MatrixXd::Zero(n, n);
}

template <class Call> double microseconds(const Call &call)
{
    const auto start = std::chrono::steady_clock::now();
    for (int k = 0; k < repetitions; k++) {
        call();
    }
    return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start)
               .count() /
           repetitions;
}

void compare(const std::string &name, const SdreProblem &p)
{
    const Eigen::MatrixXd X          = sdre::solve_care(p.A0, p.G, p.Q).X;
    const double          difference = (slicot(p) - X).norm() / X.norm();
    double                here       = std::numeric_limits<double>::infinity();
    double                there      = here;
    for (int k = 0; k < rounds; k++) {
        here  = std::min(here, microseconds([&] { (void)sdre::solve_care(p.A0, p.G, p.Q); }));
        there = std::min(there, microseconds([&] { (void)slicot(p); }));
    }
    fmt::print("{:<32}{:>3}{:>11.1f}{:>11.1f}{:>8.2f}{:>12.1e}\n", name, p.A0.rows(), here, there,
               here / there, difference);
}

} // namespace

int main(int argc, char **argv)
{
    fmt::print("{:<32}{:>3}{:>11}{:>11}{:>8}{:>12}\n", "equation", "n", "here us", "SB02MD us",
               "ratio", "difference");
    for (int i = 1; i < argc; i++) {
        const sdre::Design d = sdre::design_drive(sdre::read_drive_file(argv[i]));
        for (const auto &[name, series] :
             {std::pair("nosc", &d.nosc), std::pair("nodo", &d.nodo)}) {
            if (series->problem.A0.rows() > 0) {
                compare(d.drive.name + " " + name, series->problem);
            }
        }
    }
    return 0;
}
