// SPDX-License-Identifier: MIT
#include "design/noc_h/harmonic_design.hpp"

#include <algorithm>
#include <cmath>

#include "common/parallel.hpp"
#include "design/noc_h/harmonic_rows.hpp"
#include "design/sampled_observer.hpp"
#include "linalg/linalg_checks.hpp"

namespace sdre {
namespace {

using namespace harmonic_rows;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Chosen: gains half-way between two nodes are within 1 % of the exact ones, 7 % where edges come to be trusted.
constexpr int nodes_in_table = NODO_HARMONIC_NODES_MAX;

const double half_pi = std::acos(0.0);

// Chosen: what was learned below the limit is gone 60 ms after it is passed.
constexpr double leak_fast_1ps = 50.0;
constexpr double turn_max      = static_cast<double>(NODO_HARMONIC_TURN_MAX);

double leak_1ps(const HarmonicSpec &spec, double phi)
{
    return phi < turn_max ? spec.leak_1ps : leak_fast_1ps;
}

Index rows_of(const Drive &drive)
{
    return n_base + 2 * static_cast<Index>(harmonic_pairs(drive).size());
}

double weight_of(const nodo_harmonic_order_t &pair, const HarmonicSpec &spec)
{
    const auto has = [&pair](double order) { return static_cast<float>(order) == pair.order; };
    switch (pair.channel) {
    case NODO_HARMONIC_SENSOR:
        return spec.sensor_weight;
    case NODO_HARMONIC_TORQUE:
        return spec.cogging_weight;
    default:
        return std::any_of(spec.voltage.begin(), spec.voltage.end(), has)
                   ? spec.voltage_weight
                   : spec.cogging_voltage_weight;
    }
}

/// Where the first element of a pair enters: a disturbance, or none for the sensors.
Index target_row(nodo_harmonic_channel_t channel)
{
    return channel == NODO_HARMONIC_TORQUE      ? d_omega
           : channel == NODO_HARMONIC_VOLTAGE_Q ? d_q
                                                : d_d;
}

Index first_row(std::size_t pair)
{
    return n_base + 2 * static_cast<Index>(pair);
}

/// Rows and columns of d_w' removed when it has no weight: it would be an unweighted integrator.
std::vector<Index> kept_rows(const Drive &drive)
{
    std::vector<Index> rows;
    for (Index i = 0; i < rows_of(drive); i++) {
        if (i != slope || drive.harmonics.slope_weight > 0.0) {
            rows.push_back(i);
        }
    }
    return rows;
}

MatrixXd full_rows(const MatrixXd &kept, const std::vector<Index> &rows, Index n)
{
    MatrixXd out = MatrixXd::Zero(n, kept.cols());
    for (std::size_t i = 0; i < rows.size(); i++) {
        out.row(rows[i]) = kept.row(static_cast<Index>(i));
    }
    return out;
}

// Chosen by simulation: while the motor accelerates, the speed between two edges is not yet that of the next ones. With
// 2 the current overshoots its limit by 14 % in a start of the shipped servo, with 8 by 5 %.
constexpr double counts_for_edges = 8.0;

HarmonicNode solve_node(const ReducedParameters &l, const Drive &drive, double w)
{
    const double             ts   = control_period_s(drive);
    const std::vector<Index> rows = kept_rows(drive);
    const ObserverModel      full = harmonic_model(l, drive, w);
    const VectorXd           Q    = harmonic_weights(drive, w)(rows);
    const Vector3d           T(drive.nodo.T[0], drive.nodo.T[1], angle_weight(drive, w));

    const SampledObserverGain gain = solve_sampled_observer(sampled_observer(
        full.A0(rows, rows), full.dA(rows, rows), full.C(Eigen::all, rows), Q, T, ts));
    const Index               n    = full.A0.rows();
    return {w, full_rows(gain.K0, rows, n), full_rows(gain.K1, rows, n),
            std::max(gain.riccati_residual, gain.stein_residual)};
}

void fill_table(const HarmonicDesign &design, const Drive &drive, double largest_speed,
                double iq_max_A, nodo_harmonic_gains_t &t)
{
    const double ts    = control_period_s(drive);
    const auto   pairs = harmonic_pairs(drive);
    t.n_pairs          = static_cast<int16_t>(pairs.size());
    t.n_nodes          = static_cast<int16_t>(design.nodes.size());
    t.iq_max_A         = static_cast<float>(iq_max_A);
    t.nodes_per_root =
        static_cast<float>(static_cast<double>(design.nodes.size() - 1) / std::sqrt(largest_speed));
    t.keep      = static_cast<float>(std::exp(-drive.harmonics.leak_1ps * ts));
    t.keep_fast = static_cast<float>(std::exp(-leak_fast_1ps * ts));
    std::copy(pairs.begin(), pairs.end(), t.pair);
    for (std::size_t k = 0; k < design.nodes.size(); k++) {
        const HarmonicNode &node = design.nodes[k];
        for (Index row = 0; row < node.K0.rows(); row++) {
            // rows differ by 1e12 and more: what is noise depends on the row
            for (Index column = 0; column < 3; column++) {
                t.gain[row][k][column]     = gain_entry(node.K0.row(row), 0, column);
                t.gain[row][k][column + 3] = gain_entry(node.K1.row(row), 0, column);
            }
        }
    }
}

} // namespace

std::vector<nodo_harmonic_order_t> harmonic_pairs(const Drive &drive)
{
    const HarmonicSpec                &spec = drive.harmonics;
    std::vector<nodo_harmonic_order_t> pairs;
    const auto add = [&pairs](nodo_harmonic_channel_t channel, double order) {
        pairs.push_back({channel, static_cast<float>(order)});
    };
    for (const double order : spec.sensor) {
        add(NODO_HARMONIC_SENSOR, -order);
    }
    for (const double order : spec.voltage) {
        add(NODO_HARMONIC_VOLTAGE_Q, order);
        add(NODO_HARMONIC_VOLTAGE_D, order);
    }
    for (const double order : spec.cogging) {
        const double turns = order * drive.motor.slots / drive.motor.pole_pairs;
        add(NODO_HARMONIC_TORQUE, turns);
        if (spec.cogging_voltage_weight > 0.0) {
            add(NODO_HARMONIC_VOLTAGE_Q, turns);
        }
    }
    return pairs;
}

ObserverModel harmonic_model(const ReducedParameters &l, const Drive &drive, double w)
{
    const auto          pairs = harmonic_pairs(drive);
    const Index         n     = rows_of(drive);
    const ObserverModel base  = nodo_model(l, NodoForm::encoder);
    ObserverModel       model{MatrixXd::Zero(n, n), MatrixXd::Zero(n, n), {}, MatrixXd::Zero(3, n)};
    model.A0.topLeftCorner(7, 7) = base.A0; // EQ-HARMONIC-5
    model.dA.topLeftCorner(7, 7) = base.dA;
    model.C.leftCols(7)          = base.C;
    model.A0(iq, id) -= l[10] * w;
    model.A0(id, iq) += l[9] * w;
    model.A0(d_omega, slope) = 1.0;
    for (std::size_t i = 0; i < pairs.size(); i++) {
        const Index  a    = first_row(i);
        const double turn = static_cast<double>(pairs[i].order) * w;
        const double leak = leak_1ps(drive.harmonics, std::abs(turn) * control_period_s(drive));
        model.A0.block(a, a, 2, 2) << -leak, -turn, turn, -leak;
        if (pairs[i].channel == NODO_HARMONIC_SENSOR) {
            model.C(0, a + 1) = model.C(1, a) = 1.0;
        } else {
            // a acts where its constant does: in the derivative of w, iq or id, three rows below
            model.A0(target_row(pairs[i].channel) + 3, a) = 1.0;
        }
    }
    return model;
}

VectorXd harmonic_weights(const Drive &drive, double w)
{
    const auto          pairs = harmonic_pairs(drive);
    const HarmonicSpec &spec  = drive.harmonics;
    VectorXd            Q     = VectorXd::Zero(rows_of(drive));
    std::copy(drive.nodo.Q.begin(), drive.nodo.Q.end(), Q.begin());
    Q(slope)           = spec.slope_weight;
    const double share = std::min(1.0, std::pow(w / spec.weight_speed_e_radps, 2));
    for (std::size_t i = 0; i < pairs.size(); i++) { // EQ-HARMONIC-6
        const double phi =
            std::abs(static_cast<double>(pairs[i].order)) * w * control_period_s(drive);
        const double fade = phi < turn_max ? std::pow(std::cos(half_pi * phi / turn_max), 2) : 0.0;
        Q.segment(first_row(i), 2).setConstant(share * fade * weight_of(pairs[i], spec));
    }
    return Q;
}

double angle_weight(const Drive &drive, double w)
{ // without an edge in a period, edge times have no information: the angle is then within a count
    const double ts       = control_period_s(drive);
    const double count    = count_e_rad(drive);
    const double counted  = std::max(count * count / 12.0 * ts, drive.nodo.T[2]);
    const double by_edges = std::clamp((w * ts / count - 1.0) / (counts_for_edges - 1.0), 0.0, 1.0);
    return std::pow(counted, 1.0 - by_edges) * std::pow(drive.nodo.T[2], by_edges);
}

HarmonicDesign design_harmonics(const ReducedParameters &l, const Drive &drive,
                                double largest_speed, double iq_max_A)
{
    HarmonicDesign design;
    design.nodes.resize(nodes_in_table);
    parallel_for(nodes_in_table, [&](std::size_t k) {
        const double root = static_cast<double>(k) / (nodes_in_table - 1);
        design.nodes[k]   = solve_node(l, drive, largest_speed * root * root);
    });
    design.table = std::make_shared<nodo_harmonic_gains_t>();
    fill_table(design, drive, largest_speed, iq_max_A, *design.table);
    return design;
}

} // namespace sdre
