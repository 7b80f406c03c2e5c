// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sil/qualify/map.hpp"

namespace sdre {
namespace {

constexpr int    cell_w   = 44;
constexpr int    cell_h   = 20;
constexpr int    left     = 56; // for the speeds
constexpr int    heading  = 22;
constexpr int    footer   = 20;
constexpr int    gap      = 30;
constexpr double smallest = 0.01; // shown

struct Panel {
    const char *title;
    Ripples MapPoint::*kind;
    double Ripples::*value;
    double           limit;
};

int side_of(const PlaneMap &map)
{
    return static_cast<int>(std::lround(std::sqrt(static_cast<double>(map.points.size()))));
}

/// From white to blue at the limit; red beyond.
std::string colour(double share)
{
    if (!(share <= 1.0)) {
        return "#d7301f";
    }
    const auto mix = [&](double to) {
        return static_cast<int>(std::lround(255.0 - share * (255.0 - to)));
    };
    return fmt::format("#{:02x}{:02x}{:02x}", mix(49), mix(130), mix(189));
}

std::string text(int x, int y, const char *anchor, const std::string &words, bool light = false)
{
    return fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor,
                       light ? " fill=\"#fff\"" : "", words);
}

std::string panel_svg(const PlaneMap &map, const Panel &p, int x0, int y0)
{
    const int   n = side_of(map);
    std::string s = text(x0 + left, y0 + heading - 8, "start",
                         fmt::format("{} [V rms], at most {:.3g}", p.title, p.limit));
    for (int i = 0; i < n; i++) {
        const int y = y0 + heading + (n - 1 - i) * cell_h;
        s += text(x0 + left - 6, y + 14, "end",
                  fmt::format("{:.0f}", map.points[static_cast<std::size_t>(i * n)].speed_e_radps));
        for (int j = 0; j < n; j++) {
            const MapPoint &at    = map.points[static_cast<std::size_t>(i * n + j)];
            const double    value = (at.*p.kind).*p.value;
            const double    share = p.limit > 0.0 ? value / p.limit : 0.0;
            const int       x     = x0 + left + j * cell_w;
            s += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>\n",
                             x, y, cell_w - 1, cell_h - 1, colour(share));
            s += text(x + cell_w / 2, y + 14, "middle",
                      value < smallest ? "0" : fmt::format("{:.2g}", value), share > 0.6);
        }
    }
    return s + text(x0 + left, y0 + heading + n * cell_h + 14, "start",
                    "rad/s electrical, over the torque: generating to motoring");
}

} // namespace

std::string map_svg(const PlaneMap &map)
{
    const int   n        = side_of(map);
    const int   width    = left + n * cell_w + gap;
    const int   height   = heading + n * cell_h + footer + gap;
    const Panel panels[] = {
        {"v_q without noise", &MapPoint::ideal, &Ripples::vq_V, map.ideal_limit.vq_V},
        {"v_d without noise", &MapPoint::ideal, &Ripples::vd_V, map.ideal_limit.vd_V},
        {"v_q on the board", &MapPoint::board, &Ripples::vq_V, map.board_limit.vq_V},
        {"v_d on the board", &MapPoint::board, &Ripples::vd_V, map.board_limit.vd_V}};
    std::string s = fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" "
                                "font-family=\"sans-serif\" font-size=\"11\">\n",
                                2 * width, 2 * height);
    for (int k = 0; k < 4; k++) {
        s += panel_svg(map, panels[k], k % 2 * width, k / 2 * height);
    }
    return s + "</svg>\n";
}

} // namespace sdre
