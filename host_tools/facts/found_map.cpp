// SPDX-License-Identifier: MIT
#include "facts/found_map.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

namespace sdre {
namespace {

// Chosen: Newton's method needs four to seven steps.
constexpr int    most_steps = 40;
constexpr double enough     = 1e-10;
// Chosen: a residual that no fit prefers.
constexpr double refused = 3.0;
// Chosen: the measured inductances come in from their mean in so many steps; a fit begins with the result of the one before.
constexpr int approaches = 4;
// Chosen: weight of all numbers but the inductances. Without it, noise of 1 % makes energies without a minimum.
constexpr double modesty = 0.02;
// Places of a20 and a02.
constexpr int d_own = 0;
constexpr int q_own = 3;
// Chosen: as the grid of ipmsm_390w_iron.toml; a cubic piece is then within 0.1 % of the energy's slopes.
constexpr int d_points = 6;
constexpr int q_points = 7;

bool has_empty(const FoundMap &m)
{
    const auto empty = [](const FoundMap::Row &row) {
        return std::any_of(row.begin(), row.end(), [](double l) { return !(l > 0.0); });
    };
    return std::any_of(m.ld_H.begin(), m.ld_H.end(), empty) ||
           std::any_of(m.lq_H.begin(), m.lq_H.end(), empty);
}

template <std::size_t rows> double change_of(const std::array<FoundMap::Row, rows> &all)
{
    double least = all[0][0];
    double most  = all[0][0];
    for (const FoundMap::Row &row : all) {
        const auto [low, high] = std::minmax_element(row.begin(), row.end());
        least                  = std::min(least, *low);
        most                   = std::max(most, *high);
    }
    return most / least - 1.0;
}

template <std::size_t rows> double mean_of(const std::array<FoundMap::Row, rows> &all)
{
    double sum = 0.0;
    for (const FoundMap::Row &row : all) {
        for (const double l : row) {
            sum += l;
        }
    }
    return sum / (rows * COMMISSION_BINS);
}

struct Measured {
    double id_A, iq_A, l_H;
    bool   d; ///< the d inductance
};

std::vector<Measured> list(const FoundMap &m)
{
    const std::array<double, 3> id_A{0.0, -m.bias_A, -2.0 * m.bias_A};
    std::vector<Measured>       all;
    for (std::size_t k = 0; k < COMMISSION_BINS; k++) {
        const double i_A = m.step_A * (static_cast<double>(k) + 0.5);
        all.push_back({-i_A, 0.0, m.ld_H[1][k], true});
        for (std::size_t row = 0; row < id_A.size(); row++) {
            all.push_back({id_A[row], m.iq_A(row, k), m.lq_H[row][k], false});
        }
    }
    return all;
}

/// Fitted over measured inductances, as Eigen's Levenberg-Marquardt method wants it.
struct Residuals {
    using Scalar       = double;
    using InputType    = Eigen::VectorXd;
    using ValueType    = Eigen::VectorXd;
    using JacobianType = Eigen::MatrixXd;
    enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

    FoundIron             start;
    std::vector<Measured> all;
    double                share; ///< of the way from the means to the measured values

    int inputs() const
    {
        return static_cast<int>(start.a.size());
    }
    int values() const
    {
        return static_cast<int>(all.size()) + inputs();
    }
    FoundIron with(const Eigen::VectorXd &a) const
    {
        FoundIron iron = start;
        std::copy(a.data(), a.data() + a.size(), iron.a.begin());
        return iron;
    }
    int operator()(const Eigen::VectorXd &a, Eigen::VectorXd &out) const
    {
        const FoundIron iron = with(a);
        for (std::size_t k = 0; k < all.size(); k++) {
            const Measured &m = all[k];
            const double    l = m.d ? iron.ld_H : iron.lq_H;
            const auto      p = iron.at(m.id_A, m.iq_A);
            out[static_cast<Eigen::Index>(k)] =
                p ? (m.d ? p->dd_H : p->qq_H) / (l + share * (m.l_H - l)) - 1.0 : refused;
        }
        out.tail(a.size()) = modesty * a;
        for (const int own : {d_own, q_own}) {
            out[static_cast<Eigen::Index>(all.size()) + own] = 0.0;
        }
        return 0;
    }
};

/// Fluxes of an energy up to a limit, and beyond it along the radius: EQ-SATURATION-5. Nothing was measured there, and the
/// energy may have no minimum.
class Reach {
public:
    Reach(const FoundIron &iron, double limit_A) : iron_(iron), limit_A_(limit_A) {}

    std::optional<FoundIron::Point> at(double id_A, double iq_A) const
    {
        const double r_A = std::hypot(id_A, iq_A);
        if (r_A <= limit_A_) {
            return iron_.at(id_A, iq_A);
        }
        const double angle  = std::atan2(iq_A, id_A);
        const auto   here   = edge(angle);
        const auto   before = edge(angle - turn_rad);
        const auto   after  = edge(angle + turn_rad);
        if (!here || !before || !after) {
            return std::nullopt;
        }
        const double more_A = r_A - limit_A_;
        const double along  = here->r_Wb + more_A * here->l_H;
        const double across =
            (limit_A_ * here->t_Wb + more_A * (after->r_Wb - before->r_Wb) / (2.0 * turn_rad) +
             0.5 * more_A * more_A * (after->l_H - before->l_H) / (2.0 * turn_rad)) /
            r_A;
        FoundIron::Point p;
        p.d_Wb = std::cos(angle) * along - std::sin(angle) * across;
        p.q_Wb = std::sin(angle) * along + std::cos(angle) * across;
        return p;
    }

private:
    static constexpr double turn_rad = 1e-4; ///< of the differences: chosen, far above rounding
    static constexpr double step     = 1e-4; ///< of the limit, likewise

    /// At the limit, in the direction of the current: flux along it and across, and its inductance.
    struct Edge {
        double r_Wb, t_Wb, l_H;
    };
    std::optional<Edge> edge(double angle) const
    {
        const double c     = std::cos(angle);
        const double s     = std::sin(angle);
        const double inner = (1.0 - step) * limit_A_;
        const auto   out   = iron_.at(limit_A_ * c, limit_A_ * s);
        const auto   in    = iron_.at(inner * c, inner * s);
        if (!out || !in) {
            return std::nullopt;
        }
        const double r_Wb = c * out->d_Wb + s * out->q_Wb;
        return Edge{r_Wb, c * out->q_Wb - s * out->d_Wb,
                    (r_Wb - c * in->d_Wb - s * in->q_Wb) / (step * limit_A_)};
    }

    const FoundIron &iron_;
    double           limit_A_;
};

std::string row_of(const std::vector<double> &row)
{
    return fmt::format("{:.5f}", fmt::join(row, ", "));
}

} // namespace

double FoundMap::change() const
{
    return std::max(change_of(ld_H), change_of(lq_H));
}

FoundMap found_map(const commission_map_t &map, const commission_result_t &found)
{
    FoundMap m;
    for (std::size_t k = 0; k < COMMISSION_BINS; k++) {
        for (std::size_t row = 0; row < m.ld_H.size(); row++) {
            m.ld_H[row][k] = double(found.ld_H.value) * map.ld[row][k] / COMMISSION_MAP_ONE;
        }
        for (std::size_t row = 0; row < m.lq_H.size(); row++) {
            m.lq_H[row][k] = double(found.lq_H.value) * map.lq[row][k] / COMMISSION_MAP_ONE;
        }
    }
    m.step_A = has_empty(m) ? 0.0 : double(map.step_A);
    m.bias_A = double(COMMISSION_MAP_BIAS * map.step_A);
    return m;
}

double FoundMap::iq_A(std::size_t row, std::size_t bin) const
{
    const double most =
        std::sqrt(std::pow(most_A(), 2) - std::pow(static_cast<double>(row) * bias_A, 2));
    return most * (static_cast<double>(bin) + 0.5) / COMMISSION_BINS;
}

FoundIron fit_iron(const FoundMap &map)
{
    using Slopes                    = Eigen::NumericalDiff<Residuals, Eigen::Central>;
    const std::vector<Measured> all = list(map);
    FoundIron                   iron;
    iron.scale_A  = map.most_A();
    iron.ld_H     = mean_of(map.ld_H);
    iron.lq_H     = mean_of(map.lq_H);
    iron.a[q_own] = 0.5 * iron.lq_H / iron.ld_H;
    Eigen::VectorXd a(iron.a.size());
    std::copy(iron.a.begin(), iron.a.end(), a.data());
    for (int step = 1; step <= approaches; step++) {
        Slopes residuals(Residuals{iron, all, double(step) / approaches});
        Eigen::LevenbergMarquardt<Slopes> search(residuals);
        search.minimize(a);
        iron = residuals.with(a);
    }
    double sum = 0.0;
    for (const Measured &m : all) {
        const auto p = iron.at(m.id_A, m.iq_A);
        sum += std::pow(p ? (m.d ? p->dd_H : p->qq_H) / m.l_H - 1.0 : refused, 2);
    }
    iron.misfit = std::sqrt(sum / double(all.size()));
    return iron;
}

std::optional<FoundIron::Point> FoundIron::at(double id_A, double iq_A) const
{
    const auto [a20, a30, a40, a02, a12, a22, a04, a14, a24, a06] = a;

    // u, w: x and y over scale_A ld_H and scale_A lq_H; the energy over scale_A^2 ld_H.
    const double id    = id_A / scale_A;
    const double iq    = iq_A / scale_A;
    const double ratio = lq_H / ld_H;
    double       u     = id;
    double       w     = iq;
    for (int step = 0; step < most_steps; step++) {
        const double w2    = w * w;
        const double two   = a02 + a12 * u + a22 * u * u; // of w^2
        const double four  = a04 + a14 * u + a24 * u * u; // of w^4
        const double two_u = a12 + 2.0 * a22 * u;
        const double far_u = a14 + 2.0 * a24 * u;
        const double d = 2.0 * a20 * u + 3.0 * a30 * u * u + 4.0 * a40 * u * u * u + two_u * w2 +
                         far_u * w2 * w2 - id;
        const double q =
            (2.0 * two * w + 4.0 * four * w * w2 + 6.0 * a06 * w * w2 * w2) / ratio - iq;
        const double duu =
            2.0 * a20 + 6.0 * a30 * u + 12.0 * a40 * u * u + 2.0 * a22 * w2 + 2.0 * a24 * w2 * w2;
        const double dww = (2.0 * two + 12.0 * four * w2 + 30.0 * a06 * w2 * w2) / ratio;
        const double duw = 2.0 * two_u * w + 4.0 * far_u * w * w2;
        const double det = duu * dww - duw * duw / ratio;
        if (!(duu > 0.0 && dww > 0.0 && det > 0.0)) {
            return std::nullopt;
        }
        if (std::abs(d) + std::abs(q) < enough) {
            return Point{u * scale_A * ld_H, w * scale_A * lq_H, ld_H * dww / det,
                         lq_H * duu / det};
        }
        u -= (dww * d - duw * q) / det;
        w -= (duu * q - duw * d / ratio) / det;
    }
    return std::nullopt;
}

std::string saturation_table(const FoundIron &iron, double magnet_Wb, double limit_A,
                             const std::string &how)
{
    std::vector<double> id_A, iq_A;
    for (int i = 0; i < d_points; i++) {
        id_A.push_back(limit_A * (double(i) / (d_points - 1) - 1.0));
    }
    for (int j = 0; j < q_points; j++) {
        iq_A.push_back(limit_A * j / (q_points - 1));
    }
    std::string d_text, q_text;
    for (const double id : id_A) {
        std::vector<double> d, q;
        for (const double iq : iq_A) {
            const auto p = Reach(iron, limit_A).at(id, iq);
            if (!p) {
                return "";
            }
            d.push_back(magnet_Wb + p->d_Wb);
            q.push_back(p->q_Wb);
        }
        d_text += "    " + row_of(d) + ",\n";
        q_text += "    " + row_of(q) + ",\n";
    }
    return fmt::format("[saturation] # {}\nid_A = [{:.9g}]\niq_A = [{:.9g}]\npsi_d_Wb = [ # a row "
                       "of iq per id\n{}]\npsi_q_Wb = [\n{}]\n\n",
                       how, fmt::join(id_A, ", "), fmt::join(iq_A, ", "), d_text, q_text);
}

} // namespace sdre
