// SPDX-License-Identifier: MIT
/// Where the shaft was since it was last looked at: the plant's steps, between them a cubic through both ends' angles
/// and speeds.
#pragma once

#include <vector>

namespace sdre {

class ShaftPath {
public:
    struct Point {
        double time_s        = 0.0; ///< since the beginning of the path
        double theta_e_rad   = 0.0; ///< not wrapped
        double omega_e_radps = 0.0;
    };

    /// A path that has led here at a constant speed. Nothing is kept before the first call.
    void lead_to(double theta_e_rad, double omega_e_radps, double duration_s)
    {
        points_.clear();
        points_.push_back({0.0, theta_e_rad - omega_e_radps * duration_s, omega_e_radps});
        points_.push_back({duration_s, theta_e_rad, omega_e_radps});
    }
    /// Starts again at its end.
    void restart()
    {
        points_.front() = {0.0, points_.back().theta_e_rad, points_.back().omega_e_radps};
        points_.resize(1);
    }
    void add(double dt_s, double theta_e_rad, double omega_e_radps)
    {
        if (!points_.empty()) {
            points_.push_back({points_.back().time_s + dt_s, theta_e_rad, omega_e_radps});
        }
    }

    const std::vector<Point> &points() const
    {
        return points_;
    }
    double duration_s() const
    {
        return points_.back().time_s;
    }

private:
    std::vector<Point> points_;
};

} // namespace sdre
