// SPDX-License-Identifier: MIT
#include "design/servo/dobc_design.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "linalg/c2d.hpp"

namespace sdre {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using LongMatrix = extended::Matrix;
using LongVector = extended::Vector;

Polynomial product(const Polynomial &p, const Polynomial &q)
{
    Polynomial out(p.size() + q.size() - 1, 0.0);
    for (std::size_t i = 0; i < p.size(); i++) {
        for (std::size_t j = 0; j < q.size(); j++) {
            out[i + j] += p[i] * q[j];
        }
    }
    return out;
}

/// sum += factor * p * s^power
void add(Polynomial &sum, const Polynomial &p, double factor, int power)
{
    const std::size_t from = sum.size() - p.size() - static_cast<std::size_t>(power);
    for (std::size_t i = 0; i < p.size(); i++) {
        sum[from + i] += factor * p[i];
    }
}

std::complex<double> value(const Polynomial &p, std::complex<double> s)
{
    std::complex<double> out = 0.0;
    for (const double c : p) {
        out = out * s + c;
    }
    return out;
}

/// Product of s^2 + w_k^2 over all oscillators but `left_out`.
Polynomial oscillator_product(const std::vector<double> &w, std::size_t left_out)
{
    Polynomial p{1.0};
    for (std::size_t k = 0; k < w.size(); k++) {
        if (k != left_out) {
            p = product(p, {1.0, 0.0, w[k] * w[k]});
        }
    }
    return p;
}

/// The poles that the preset puts where.
Polynomial wanted_polynomial(const DobcSpec &spec, const std::vector<double> &w)
{
    const bool printed = spec.preset == DobcPreset::printed;
    const int  fast    = 1 + spec.polynomial_order + (printed ? 2 * static_cast<int>(w.size()) : 0);
    Polynomial p{1.0};
    for (int i = 0; i < fast; i++) {
        p = product(p, {1.0, spec.observer_pole_1ps});
    }
    for (std::size_t j = 0; !printed && j < w.size(); j++) {
        p = product(p, {1.0, 2.0 * spec.oscillator_damping_1ps, w[j] * w[j]});
    }
    return p;
}

/// EQ-DOBC-5: two gains per oscillator from the residues of D / (s^N P) at +-i w, the polynomial's from the series
/// of D / P at 0.
VectorXd matched_gains(const Polynomial &D, const std::vector<double> &w, int N, double a)
{
    VectorXd l(static_cast<Index>(1 + 2 * w.size()) + N);
    l(0) = a - D[1];
    for (std::size_t j = 0; j < w.size(); j++) {
        const std::complex<double> s(0.0, w[j]);
        std::complex<double>       others = std::pow(s, N);
        for (std::size_t k = 0; k < w.size(); k++) {
            others *= (k == j) ? 1.0 : w[k] * w[k] - w[j] * w[j];
        }
        const std::complex<double> v     = -value(D, s) / others;
        l(static_cast<Index>(1 + 2 * j)) = v.imag() / w[j];
        l(static_cast<Index>(2 + 2 * j)) = v.real();
    }
    const Polynomial    P = oscillator_product(w, w.size());
    std::vector<double> q;
    for (int i = 0; i < N; i++) {
        const auto n   = static_cast<std::size_t>(i);
        double     sum = D[D.size() - 1 - n];
        for (std::size_t k = 1; k <= n && k < P.size(); k++) {
            sum -= P[P.size() - 1 - k] * q[n - k];
        }
        q.push_back(sum / P.back());
        l(l.size() - 1 - i) = -q.back();
    }
    return l;
}

/// det(sI - F) of these gains, written out by cofactors of the first column.
Polynomial recovered_polynomial(const VectorXd &l, const std::vector<double> &w, int N, double a)
{
    Polynomial       sum(static_cast<std::size_t>(l.size()) + 1, 0.0);
    const Polynomial P = oscillator_product(w, w.size());
    add(sum, P, 1.0, N + 1);
    add(sum, P, a - l(0), N);
    for (std::size_t j = 0; j < w.size(); j++) {
        const Polynomial P_j = oscillator_product(w, j);
        add(sum, P_j, -l(static_cast<Index>(1 + 2 * j)), N + 1);
        add(sum, P_j, -l(static_cast<Index>(2 + 2 * j)), N);
    }
    for (int i = 0; i < N; i++) {
        add(sum, P, -l(l.size() - N + i), N - 1 - i);
    }
    return sum;
}

double largest_relative_error(const Polynomial &found, const Polynomial &wanted)
{
    double worst = 0.0;
    for (std::size_t i = 0; i < wanted.size(); i++) {
        worst = std::max(worst, std::abs(found[i] - wanted[i]) / std::abs(wanted[i]));
    }
    return worst;
}

MatrixXd error_matrix(const VectorXd &l, const std::vector<double> &w, int N, double a)
{
    const Index n = l.size();
    MatrixXd    F = MatrixXd::Zero(n, n);
    F(0, 0)       = -a;
    for (std::size_t j = 0; j < w.size(); j++) {
        const auto i = static_cast<Index>(1 + 2 * j);
        F(0, i)      = 1.0;
        F(i, i + 1)  = 1.0;
        F(i + 1, i)  = -w[j] * w[j];
    }
    const Index first = n - N;
    if (N > 0) {
        F(0, first) = 1.0;
    }
    for (Index i = first; i + 1 < n; i++) {
        F(i, i + 1) = 1.0;
    }
    F.col(0) += l;
    return F;
}

/// Periods to the power of how many times a state is a rate: what brings all entries of F to the order of one.
LongVector rate_scale(std::size_t oscillators, int N, long double ts_s)
{
    LongVector  scale(static_cast<Index>(1 + 2 * oscillators) + N);
    const Index first = scale.size() - N;
    scale(0)          = 1.0L;
    for (Index i = 1; i < first; i += 2) {
        scale(i)     = ts_s;
        scale(i + 1) = ts_s * ts_s;
    }
    for (Index i = first; i < scale.size(); i++) {
        scale(i) = scale(i == first ? 0 : i - 1) * ts_s;
    }
    return scale;
}

/// EQ-DOBC-6. The entries of F span twenty orders of magnitude. Without the scale M is off by up to
/// 2e-6, relative. Extended precision is needed for the same reason.
void sample(DobcDesign &d, int N, double ts_s)
{
    const Index       n     = d.F.rows();
    const long double ts    = static_cast<long double>(ts_s);
    const LongVector  scale = rate_scale(d.oscillators_radps.size(), N, ts);
    const LongMatrix  into  = scale.asDiagonal();
    const LongMatrix  back  = scale.cwiseInverse().asDiagonal();
    const LongMatrix  F     = into * d.F.cast<long double>() * back;
    const auto        over  = c2d(F, LongMatrix::Identity(n, n), ts);
    const LongMatrix  Phi   = back * over.Gamma * into;
    d.M                     = (back * over.Phi * into).cast<double>();
    d.g                     = (Phi * d.E.cast<long double>() / ts).cast<double>();
    d.h                     = (Phi * d.H.cast<long double>()).cast<double>();
}

/// EQ-DOBC-7. The voltage is held: its value in the middle of the period is what an oscillator needs. The printed law
/// takes the value at the start.
Eigen::RowVectorXd compensation(const DobcDesign &d, const DobcSpec &spec, double L_H, double ts_s)
{
    Eigen::RowVectorXd K = Eigen::RowVectorXd::Zero(d.l.size());
    K(0)                 = d.k2;
    for (std::size_t j = 0; j < d.oscillators_radps.size(); j++) {
        const double half = 0.5 * d.oscillators_radps[j] * ts_s;
        const auto   i    = static_cast<Index>(1 + 2 * j);
        const bool   lead = spec.preset == DobcPreset::repaired;
        K(i)              = lead ? L_H * std::cos(half) * half / std::sin(half) : L_H;
        K(i + 1)          = lead ? L_H * half / d.oscillators_radps[j] : 0.0;
    }
    if (spec.polynomial_order > 0) {
        K(d.l.size() - spec.polynomial_order) = L_H;
    }
    return K;
}

} // namespace

ServoPlant servo_plant(const Motor &m) // EQ-DOBC-4
{
    ServoPlant p;
    p.kt_NmpA = 1.5 * m.pole_pairs * m.pm_flux_Wb;
    p.b       = p.kt_NmpA / m.inertia_kgm2;
    p.a = m.viscous_friction_Nms / m.inertia_kgm2 + m.stator_resistance_Ohm / m.q_axis_inductance_H;
    p.L_H = m.q_axis_inductance_H;
    return p;
}

DobcDesign design_dobc(const Motor &motor, const DobcSpec &spec, double ts_s)
{
    const ServoPlant p  = servo_plant(motor);
    const int        N  = spec.polynomial_order;
    const double     lc = spec.controller_pole_1ps;

    DobcDesign d;
    for (const double order : spec.harmonics_per_turn) {
        d.oscillators_radps.push_back(order * spec.design_speed_e_radps / motor.pole_pairs);
    }
    const std::vector<double> &w = d.oscillators_radps;
    d.wanted                     = wanted_polynomial(spec, w);
    d.l                          = matched_gains(d.wanted, w, N, p.a);
    d.matching_error = largest_relative_error(recovered_polynomial(d.l, w, N, p.a), d.wanted);
    d.F              = error_matrix(d.l, w, N, p.a);
    d.E              = -d.l / p.b;
    d.H              = VectorXd::Zero(d.l.size());
    d.H(0)           = -1.0 / p.L_H;
    d.k1             = lc * lc * p.L_H / p.b;
    d.k2             = p.L_H * (2.0 * lc - p.a);
    d.K              = compensation(d, spec, p.L_H, ts_s);
    sample(d, N, ts_s);
    return d;
}

} // namespace sdre
