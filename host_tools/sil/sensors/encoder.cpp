// SPDX-License-Identifier: MIT
#include "sil/sensors/encoder.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sdre {
namespace {

const double two_pi = 2.0 * std::acos(-1.0);

// Chosen: the time since an edge before the first one; a speed from it is next to zero.
constexpr double no_edge_s = 1.0;
// As in app_angle.c.
constexpr double gap_max_s = 0.05;
// Chosen: a state of the disc is at most so wide.
constexpr double widest_cnt = 1.5;

} // namespace

QuadratureEncoder::QuadratureEncoder(const SensorSettings &settings, int lines, int pole_pairs,
                                     double period_s, std::uint64_t seed)
    : drive_lines_(lines), pole_pairs_(pole_pairs), period_s_(period_s), seed_(seed)
{
    configure(settings);
}

void QuadratureEncoder::configure(const SensorSettings &settings)
{
    settings_        = settings;
    counts_per_turn_ = 4 * static_cast<std::int64_t>(settings.encoder_lines.value_or(drive_lines_));
    offset_rad_      = settings.encoder_offset_e_rad / pole_pairs_;
    disc_            = EncoderDisc(settings.encoder_disc, counts_per_turn_, seed_);
}

double QuadratureEncoder::shaft_turns(double theta_e_rad) const
{
    const double theta_m = theta_e_rad / pole_pairs_; // EQ-ENCODER-1
    double       shaft   = theta_m + offset_rad_;
    if (settings_.encoder_eccentricity_rad != 0.0) {
        shaft += settings_.encoder_eccentricity_rad * std::sin(theta_m);
    }
    return shaft / two_pi;
}

double QuadratureEncoder::position_cnt(double theta_e_rad) const
{
    return shaft_turns(theta_e_rad) * static_cast<double>(counts_per_turn_);
}

std::int64_t QuadratureEncoder::count_at(double theta_e_rad) const
{
    return disc_.count_at(position_cnt(theta_e_rad));
}

/// Edges that a late count has beyond the one at the end of the path.
std::int64_t QuadratureEncoder::counted_late(const ShaftPath &path, std::int64_t now) const
{
    if (settings_.encoder_count_late_s <= 0.0) {
        return 0;
    }
    const ShaftPath::Point &end = path.points().back();
    return count_at(end.theta_e_rad + end.omega_e_radps * settings_.encoder_count_late_s) - now;
}

/// Whole turns, rounded down.
std::int64_t QuadratureEncoder::turn_of(std::int64_t count) const
{
    const std::int64_t turns = count / counts_per_turn_;
    return turns * counts_per_turn_ > count ? turns - 1 : turns;
}

void QuadratureEncoder::start(double theta_e_rad, double omega_e_radps)
{
    const double before = theta_e_rad - omega_e_radps * period_s_;
    lost_               = 0;
    lost_at_turn_       = turn_of(count_at(theta_e_rad));
    before_             = count_at(before);
    seen_e_rad_         = theta_e_rad;
    lost_for_good_      = 0;
    true_before_        = before_;
    edge_speed_         = omega_e_radps;
    edge_               = omega_e_radps < 0.0 ? before_ + 1 : before_;
    const double rate   = (position_cnt(theta_e_rad) - position_cnt(before)) / period_s_;
    edge_age_s_         = rate == 0.0
                              ? no_edge_s
                              : std::min((position_cnt(before) - disc_.edge_cnt(edge_)) / rate, no_edge_s);
}

void QuadratureEncoder::lose(int counts)
{
    lost_ += counts;
    lost_for_good_ += counts;
}

/// The index is high within the count that begins a turn; it has gone high when that count was entered.
void QuadratureEncoder::note_index(std::int64_t now, Reading &r) const
{
    const bool         forward = now > true_before_;
    const std::int64_t mark    = forward ? counts_per_turn_ * turn_of(now)
                                         : counts_per_turn_ * turn_of(now + counts_per_turn_ - 1);
    const bool         passed  = forward ? mark > true_before_ : mark < true_before_;
    r.raw_count                = now - lost_for_good_ + misread_;
    r.index                    = settings_.encoder_index && passed;
    r.index_count              = mark - lost_for_good_;
}

/// When the shaft passes the edge below a count, in a piece over which it does.
double QuadratureEncoder::edge_time_s(const PathPiece &piece, std::int64_t edge) const
{
    const double at = disc_.edge_cnt(edge);
    return piece.time_s(
        zero_of(piece, [&](double share) { return position_cnt(piece.theta_e_rad(share)) - at; }));
}

/// The last edge of a path: the count before it and its time; the end of the path before where only the counter jumps.
QuadratureEncoder::Jump QuadratureEncoder::last_jump(const ShaftPath &path, std::int64_t now) const
{
    const std::vector<ShaftPath::Point> &points = path.points();
    for (std::size_t n = points.size() - 1; n > 0; n--) {
        const StepPieces pieces = pieces_of(points[n - 1], points[n]);
        for (std::size_t m = pieces.count; m > 0; m--) {
            const PathPiece   &piece  = pieces.piece[m - 1];
            const std::int64_t begins = count_at(piece.theta_e_rad(piece.from));
            if (begins != now) {
                return {begins, edge_time_s(piece, begins < now ? now : now + 1)};
            }
        }
    }
    return {true_before_, 0.0};
}

/// The last edge that the shaft has passed and the speed from there to the one noted before.
void QuadratureEncoder::note_last_edge(const ShaftPath &path, std::int64_t now)
{
    const double per_count   = pole_pairs_ * two_pi / static_cast<double>(counts_per_turn_);
    const double beginning_s = edge_age_s_;
    edge_age_s_ += path.duration_s();
    const Jump   jump    = last_jump(path, now);
    const double since_s = beginning_s + jump.time_s; // the edge before
    if (jump.from == now || since_s <= 0.0) {
        const double most = per_count / edge_age_s_;
        edge_speed_       = std::clamp(edge_speed_, -most, most);
        return;
    }
    const std::int64_t edge       = jump.from < now ? now : now + 1;
    const double       mapped_cnt = disc_.mapped_cnt(edge) - disc_.mapped_cnt(edge_);
    edge_speed_                   = per_count * (static_cast<double>(edge - edge_) + mapped_cnt) /
                  since_s; // EQ-ENCODER-5, EQ-DISC-3
    edge_       = edge;
    edge_age_s_ = path.duration_s() - jump.time_s;
}

void QuadratureEncoder::list_edges(const ShaftPath &path, std::vector<EncoderEdge> &edges) const
{
    edges.clear();
    std::int64_t count = true_before_;
    const auto   step  = [&](std::int64_t to, const PathPiece *piece) {
        const int direction = to > count ? 1 : -1;
        while (count != to) {
            const double time_s =
                piece == nullptr ? 0.0 : edge_time_s(*piece, direction > 0 ? count + 1 : count);
            count += direction;
            edges.push_back({time_s, count - lost_for_good_, direction});
        }
    };
    const std::vector<ShaftPath::Point> &points = path.points();
    step(count_at(points.front().theta_e_rad), nullptr);
    for (std::size_t n = 1; n < points.size(); n++) {
        const StepPieces pieces = pieces_of(points[n - 1], points[n]);
        for (std::size_t m = 0; m < pieces.count; m++) {
            step(count_at(pieces.piece[m].theta_e_rad(pieces.piece[m].to)), &pieces.piece[m]);
        }
    }
}

/// EQ-ENCODER-6: from the last edge on with the speed of the edges, at most a wide count.
double QuadratureEncoder::edge_angle_rad(std::int64_t count, double edge_above_cnt) const
{
    const double per_count = pole_pairs_ * two_pi / static_cast<double>(counts_per_turn_);
    const double beyond =
        edge_above_cnt + std::clamp(edge_speed_ * edge_age_s_ / per_count, -widest_cnt, widest_cnt);
    const double theta =
        per_count * static_cast<double>(count % counts_per_turn_) + per_count * beyond;
    const double wrapped = std::fmod(theta, two_pi);
    return wrapped < 0.0 ? wrapped + two_pi : wrapped;
}

/// EQ-ENCODER-8: an edge alone in four periods is in the middle of its own; among more the count is read as
/// EQ-APP-ANGLE-5 says. Should edges be timed from the next reading on, they follow this one.
void QuadratureEncoder::read_counts(Reading &r, std::int64_t now)
{
    const double       per_count = pole_pairs_ * two_pi / static_cast<double>(counts_per_turn_);
    const std::int64_t turned    = r.count - before_;
    edge_age_s_                  = std::min(edge_age_s_ + period_s_, no_edge_s);
    if (turned == 0) {
        r.edge_gap_s = std::min(std::max(edge_age_s_, edge_gap_s_), gap_max_s);
        r.band_e_rad = 0.5 * per_count;
    } else {
        edge_gap_s_  = edge_age_s_ - 0.5 * period_s_;
        edge_age_s_  = 0.5 * period_s_;
        edge_        = turned > 0 ? now : now + 1;
        edge_speed_  = r.omega_e_radps;
        r.band_e_rad = 0.25 * per_count;
    }
    if (std::abs(turned) == 1) {
        r.band_e_rad  = 0.0;
        edge_speed_   = static_cast<double>(turned) * per_count / edge_gap_s_;
        r.theta_e_rad = edge_angle_rad(r.count, turned > 0 ? 0.0 : 1.0);
        r.edge_gap_s  = edge_gap_s_;
        r.edge_age_s  = edge_age_s_;
    }
}

QuadratureEncoder::Reading QuadratureEncoder::read(double theta_e_rad, double omega_e_radps)
{
    ShaftPath path;
    path.lead_to(theta_e_rad, omega_e_radps, period_s_);
    return read(path);
}

QuadratureEncoder::Reading QuadratureEncoder::read(const ShaftPath          &path,
                                                   std::vector<EncoderEdge> &edges)
{
    const ShaftPath &shown = seen(path);
    list_edges(shown, edges);
    return read_path(shown);
}

QuadratureEncoder::Reading QuadratureEncoder::read(const ShaftPath &path)
{
    return read_path(seen(path));
}

/// A dead encoder's shaft stands where it was read last.
const ShaftPath &QuadratureEncoder::seen(const ShaftPath &path)
{
    if (!settings_.encoder_dead) {
        seen_e_rad_ = path.points().back().theta_e_rad;
        return path;
    }
    standing_.lead_to(seen_e_rad_, 0.0, path.duration_s());
    return standing_;
}

QuadratureEncoder::Reading QuadratureEncoder::read_path(const ShaftPath &path)
{
    const double       theta_e_rad = path.points().back().theta_e_rad;
    const std::int64_t now         = count_at(theta_e_rad);
    const std::int64_t turn        = turn_of(now);
    if (settings_.encoder_index && turn != lost_at_turn_) {
        lost_ = 0;
    }
    lost_at_turn_ = turn;

    const std::int64_t late = counted_late(path, now);
    Reading            r;
    note_index(now, r);
    r.raw_count += late;
    r.count = now - lost_ + misread_ + late; // EQ-ENCODER-2

    // EQ-ENCODER-3 in whole half counts, so that the wrap is exact.
    const std::int64_t half_turn = 2 * counts_per_turn_;
    std::int64_t       half_counts =
        ((2 * r.count + 1) * static_cast<std::int64_t>(pole_pairs_)) % half_turn;
    half_counts += half_counts < 0 ? half_turn : 0;
    r.theta_e_rad = two_pi * static_cast<double>(half_counts) / static_cast<double>(half_turn);

    const auto per_turn = static_cast<double>(counts_per_turn_);
    r.omega_e_radps     = pole_pairs_ * static_cast<double>(r.count - before_) * two_pi /
                      (per_turn * period_s_); // EQ-ENCODER-4
    if (settings_.encoder_edge_time) {
        const double before_s = edge_age_s_ + path.duration_s();
        note_last_edge(path, now);
        r.omega_e_radps = edge_speed_;
        r.edge_gap_s    = std::min(std::max(edge_age_s_, edge_gap_s_), gap_max_s);
        if (edge_age_s_ <= period_s_) {
            r.theta_e_rad =
                edge_angle_rad(r.count, static_cast<double>(edge_ - now) + disc_.mapped_cnt(edge_));
            edge_gap_s_               = std::min(before_s - edge_age_s_, gap_max_s);
            r.edge_gap_s              = edge_gap_s_;
            r.edge_age_s              = edge_age_s_;
            const std::int64_t places = std::gcd(counts_per_turn_, std::int64_t{16});
            r.edge_of_pattern         = // EQ-ENCODER-FORM-4
                1 + static_cast<int>((((edge_ + late) % places) + places) % places);
        } else { // no edge in this period: within the count
            r.band_e_rad = pole_pairs_ * two_pi / (2.0 * per_turn);
        }
    } else {
        read_counts(r, now);
    }
    true_before_ = now;
    before_      = r.count;
    return r;
}

} // namespace sdre
