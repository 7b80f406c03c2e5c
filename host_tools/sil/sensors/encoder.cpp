// SPDX-License-Identifier: MIT
#include "sil/sensors/encoder.hpp"

#include <algorithm>
#include <cmath>

namespace sdre {
namespace {

const double two_pi = 2.0 * std::acos(-1.0);

// Chosen: the age of an edge that nobody has seen; a speed from it is next to zero.
constexpr double no_edge_s = 1.0;

} // namespace

QuadratureEncoder::QuadratureEncoder(const SensorSettings &settings, int lines, int pole_pairs,
                                     double period_s)
    : drive_lines_(lines), pole_pairs_(pole_pairs), period_s_(period_s)
{
    configure(settings);
}

void QuadratureEncoder::configure(const SensorSettings &settings)
{
    settings_        = settings;
    counts_per_turn_ = 4 * static_cast<std::int64_t>(settings.encoder_lines.value_or(drive_lines_));
}

double QuadratureEncoder::shaft_turns(double theta_e_rad) const
{
    const double theta_m = theta_e_rad / pole_pairs_; // EQ-ENCODER-1
    double       shaft   = theta_m + settings_.encoder_offset_e_rad / pole_pairs_;
    if (settings_.encoder_eccentricity_rad != 0.0) {
        shaft += settings_.encoder_eccentricity_rad * std::sin(theta_m);
    }
    return shaft / two_pi;
}

std::int64_t QuadratureEncoder::counts_of(double turns) const
{
    // Further away a double has no single counts; a plant that runs away gets there before its run ends.
    constexpr double furthest = 0x1p53;
    const double     counts   = std::floor(turns * static_cast<double>(counts_per_turn_));
    return std::abs(counts) < furthest ? static_cast<std::int64_t>(counts) : 0;
}

void QuadratureEncoder::start(double theta_e_rad, double omega_e_radps)
{
    lost_          = 0;
    lost_at_turn_  = std::floor(shaft_turns(theta_e_rad));
    before_        = counts_of(shaft_turns(theta_e_rad - omega_e_radps * period_s_));
    lost_for_good_ = 0;
    true_before_   = before_;
    edge_speed_    = omega_e_radps;
    edge_          = omega_e_radps < 0.0 ? before_ + 1 : before_;
    edge_age_s_    = omega_e_radps == 0.0
                         ? no_edge_s
                         : since_edge_s(theta_e_rad - omega_e_radps * period_s_, omega_e_radps);
}

void QuadratureEncoder::lose(int counts)
{
    lost_ += counts;
    lost_for_good_ += counts;
}

/// The index is high within the count that begins a turn; it has gone high when that count was entered.
void QuadratureEncoder::note_index(std::int64_t now, Reading &r)
{
    const auto turn_below = [this](std::int64_t count) {
        const std::int64_t rest = count % counts_per_turn_;
        return count - (rest < 0 ? rest + counts_per_turn_ : rest);
    };
    const bool         forward = now > true_before_;
    const std::int64_t mark    = forward ? turn_below(now) : turn_below(now + counts_per_turn_ - 1);
    const bool         passed  = forward ? mark > true_before_ : mark < true_before_;
    r.raw_count                = now - lost_for_good_;
    r.index                    = settings_.encoder_index && passed;
    r.index_count              = mark - lost_for_good_;
    true_before_               = now;
}

/// How long ago the shaft passed the edge of its count, at the speed it has now.
double QuadratureEncoder::since_edge_s(double theta_e_rad, double omega_e_radps) const
{
    const double counts = static_cast<double>(counts_per_turn_);
    const double step_s = 1e-3 * period_s_; // short enough for a straight line
    const double now    = counts * shaft_turns(theta_e_rad);
    const double rate = (now - counts * shaft_turns(theta_e_rad - omega_e_radps * step_s)) / step_s;
    const double beyond = rate >= 0.0 ? now - std::floor(now) : std::floor(now) + 1.0 - now;
    return rate == 0.0 ? period_s_ : std::min(beyond / std::abs(rate), period_s_);
}

void QuadratureEncoder::time_edges(const Reading &r, double since_edge_s, bool forward)
{
    const double per_count = pole_pairs_ * two_pi / static_cast<double>(counts_per_turn_);
    edge_age_s_ += period_s_;
    if (r.count == before_) {
        const double most = per_count / edge_age_s_;
        edge_speed_       = std::clamp(edge_speed_, -most, most);
        return;
    }
    const std::int64_t edge = forward ? r.count : r.count + 1;
    edge_speed_             = per_count * static_cast<double>(edge - edge_) /
                  (edge_age_s_ - since_edge_s); // EQ-ENCODER-5
    edge_       = edge;
    edge_age_s_ = since_edge_s;
}

/// EQ-ENCODER-6: from the last edge on with the speed of the edges, but within the count.
double QuadratureEncoder::edge_angle_rad(std::int64_t count) const
{
    const double per_count = pole_pairs_ * two_pi / static_cast<double>(counts_per_turn_);
    const double beyond    = std::clamp(
           static_cast<double>(edge_ - count) + edge_speed_ * edge_age_s_ / per_count, 0.0, 1.0);
    const double theta =
        per_count * static_cast<double>(count % counts_per_turn_) + per_count * beyond;
    const double wrapped = std::fmod(theta, two_pi);
    return wrapped < 0.0 ? wrapped + two_pi : wrapped;
}

QuadratureEncoder::Reading QuadratureEncoder::read(double theta_e_rad, double omega_e_radps)
{
    const double turns = shaft_turns(theta_e_rad);
    const double turn  = std::floor(turns);
    if (settings_.encoder_index && turn != lost_at_turn_) {
        lost_ = 0;
    }
    lost_at_turn_ = turn;

    Reading            r;
    const std::int64_t now = counts_of(turns);
    note_index(now, r);
    r.count = now - lost_; // EQ-ENCODER-2

    // EQ-ENCODER-3 in whole half counts, so that the wrap is exact.
    const std::int64_t half_turn = 2 * counts_per_turn_;
    std::int64_t       half_counts =
        ((2 * r.count + 1) * static_cast<std::int64_t>(pole_pairs_)) % half_turn;
    half_counts += half_counts < 0 ? half_turn : 0;
    r.theta_e_rad = two_pi * static_cast<double>(half_counts) / static_cast<double>(half_turn);

    const auto per_turn = static_cast<double>(counts_per_turn_);
    r.omega_e_radps     = pole_pairs_ * static_cast<double>(r.count - before_) * two_pi /
                      (per_turn * period_s_); // EQ-ENCODER-4
    time_edges(r, since_edge_s(theta_e_rad, omega_e_radps), omega_e_radps >= 0.0);
    if (settings_.encoder_edge_time) {
        r.omega_e_radps = edge_speed_;
        r.theta_e_rad   = edge_angle_rad(r.count);
    }
    before_ = r.count;
    return r;
}

} // namespace sdre
