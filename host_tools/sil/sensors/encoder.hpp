// SPDX-License-Identifier: MIT
/// Incremental encoder with a quadrature counter (x4) on the motor's shaft.
///
///     shaft = theta_m + offset_e / n_p + eccentricity sin(theta_m)             EQ-ENCODER-1
///     count = edges of the disc below 4 lines shaft / 2 pi - lost              EQ-ENCODER-2
///     theta_e = n_p (count + 1/2) 2 pi / (4 lines), wrapped to [0, 2 pi)       EQ-ENCODER-3
///     omega_e = n_p (count - count before) 2 pi / (4 lines Ts)                 EQ-ENCODER-4
/// With the times of the last edges of this period and of the one before them:
///     omega_e = n_p (edge - edge before) 2 pi / (4 lines (t_edge - t_edge before))  EQ-ENCODER-5
///
/// A period without an edge keeps the speed of EQ-ENCODER-5, but at most one count in the time since the edge.
/// Without times, an edge alone in four periods is in the middle of its period; EQ-ENCODER-5, 6 use that (EQ-ENCODER-8).
/// An edge's time is the one at which the shaft passes it.
///
/// With encoder_count_late_s the count is that of a later instant. An edge between the two instants is counted, but not timed.
#pragma once

#include <cstdint>
#include <vector>

#include "sil/plant/shaft_path.hpp"
#include "sil/sensors/encoder_disc.hpp"
#include "sil/sensors/path_pieces.hpp"
#include "sil/setup/board_settings.hpp"

namespace sdre {

/// The shaft has passed from one count to the next.
struct EncoderEdge {
    double       time_s    = 0.0; ///< since the reading before
    std::int64_t count     = 0;   ///< of a plain counter (Reading::raw_count), after the edge
    int          direction = 1;   ///< 1: the count rose, -1: it fell
};

class QuadratureEncoder {
public:
    struct Reading {
        std::int64_t count       = 0; ///< since the start, not wrapped
        double       theta_e_rad = 0.0;
        int          edge_of_pattern =
            0; ///< place of the edge that theta_e_rad rests on, 1 .. 16 (EQ-ENCODER-FORM-4)
        double edge_gap_s =
            0.0; ///< time between the last two edges, or since the last one when that is longer
        double       edge_age_s    = 0.0; ///< since the edge that theta_e_rad rests on
        double       band_e_rad    = 0.0; ///< the angle is this near; 0: a measurement
        double       omega_e_radps = 0.0;
        std::int64_t raw_count     = 0;     ///< what a plain counter shows: never put right
        bool         index         = false; ///< the mark was passed since the read before
        std::int64_t index_count   = 0;     ///< raw_count at the mark
    };

    /// @param lines of the drive file, unless the settings name others.
    /// @param seed of the disc's jitter
    QuadratureEncoder(const SensorSettings &settings, int lines, int pole_pairs, double period_s,
                      std::uint64_t seed = 1);

    /// Changes in flight; the counter keeps what it has lost.
    void configure(const SensorSettings &settings);
    /// The counter as if the shaft had turned at this speed before the start.
    void start(double theta_e_rad, double omega_e_radps);
    /// The counter misses this many counts, now. An index mark puts it right.
    void lose(int counts);

    /// The next reading is off by this many counts; the counter itself is not.
    void misread(int counts)
    {
        misread_ = counts;
    }

    /// Call at every sample, with the shaft's path since the one before.
    Reading read(const ShaftPath &path);
    /// The same, and every edge since the reading before. Where the counter jumps (a change of the settings), its edges
    /// are at the beginning.
    Reading read(const ShaftPath &path, std::vector<EncoderEdge> &edges);
    /// Once per period, for a shaft that got here at this speed.
    Reading read(double theta_e_rad, double omega_e_radps = 0.0);

private:
    struct Jump {
        std::int64_t from;
        double       time_s;
    };
    double           shaft_turns(double theta_e_rad) const;
    std::int64_t     count_at(double theta_e_rad) const;
    std::int64_t     counted_late(const ShaftPath &path, std::int64_t now) const;
    std::int64_t     turn_of(std::int64_t count) const;
    Reading          read_path(const ShaftPath &path);
    const ShaftPath &seen(const ShaftPath &path);
    void             note_index(std::int64_t now, Reading &r) const;
    double           position_cnt(double theta_e_rad) const;
    double           edge_time_s(const PathPiece &piece, std::int64_t edge) const;
    Jump             last_jump(const ShaftPath &path, std::int64_t now) const;
    void             note_last_edge(const ShaftPath &path, std::int64_t now);
    void             list_edges(const ShaftPath &path, std::vector<EncoderEdge> &edges) const;
    void             read_counts(Reading &r, std::int64_t now);
    double           edge_angle_rad(std::int64_t count, double edge_above_cnt) const;

    SensorSettings settings_;
    int            drive_lines_;
    double         pole_pairs_;
    double         period_s_;
    std::uint64_t  seed_;
    std::int64_t   counts_per_turn_ = 0;
    double         offset_rad_      = 0.0; ///< of the disc on the shaft
    EncoderDisc    disc_{{}, 4, 1};
    std::int64_t   before_        = 0;
    std::int64_t   lost_          = 0;
    std::int64_t   lost_for_good_ = 0; ///< by a counter that the index does not put right
    std::int64_t   misread_       = 0;
    double         seen_e_rad_    = 0.0; ///< where the shaft was read last
    ShaftPath      standing_;            ///< there: what a dead encoder sees
    std::int64_t   true_before_  = 0;
    std::int64_t   lost_at_turn_ = 0;   ///< whole turns when they were last lost or read
    std::int64_t   edge_         = 0;   ///< the last edge, as the true count above it
    double         edge_age_s_   = 0.0; ///< since that edge, at the last reading
    double         edge_gap_s_   = 0.0; ///< between the last two edges
    double         edge_speed_   = 0.0; ///< EQ-ENCODER-5, electrical
};

} // namespace sdre
