// SPDX-License-Identifier: MIT
#include "sil/plant/bridge.hpp"

#include <algorithm>
#include <cmath>

namespace sdre {

int Bridge::Terminals::floating_count() const
{
    return static_cast<int>(std::count(floats.begin(), floats.end(), true));
}

/// A leg that opens leaves its current to one of its diodes. A current cannot flow in one phase alone.
void Bridge::note_openings(const Terminals &t, const std::array<double, 3> &i)
{
    int carrying = 0;
    for (std::size_t x = 0; x < 3; x++) {
        if (!t.open[x]) {
            diode_[x] = Diode::none;
        } else if (!was_open_[x]) {
            diode_[x] = i[x] > 0.0 ? Diode::lower : i[x] < 0.0 ? Diode::upper : Diode::none;
        }
        was_open_[x] = t.open[x];
        carrying += !t.open[x] || diode_[x] != Diode::none ? 1 : 0;
    }
    if (carrying < 2) {
        diode_.fill(Diode::none);
    }
}

/// Puts an open leg where its diodes or nothing holds it.
void Bridge::place(Terminals &t, std::size_t x, Diode diode, double floating_V,
                   double dc_link_V) const
{
    const double drop_V = settings_.diode_drop_V;
    t.floats[x]         = diode == Diode::none;
    t.share[x]          = diode == Diode::upper ? 1.0 : 0.0;
    t.v_V[x]            = diode == Diode::upper   ? dc_link_V + drop_V
                          : diode == Diode::lower ? -drop_V
                                                  : floating_V;
}

/// The diode that a floating terminal opens at this voltage.
Bridge::Diode Bridge::diode_at(std::size_t x, double floating_V, double dc_link_V) const
{
    return broken_[x]                                        ? Diode::none
           : floating_V > dc_link_V + settings_.diode_drop_V ? Diode::upper
           : floating_V < -settings_.diode_drop_V            ? Diode::lower
                                                             : Diode::none;
}

/// No phase carries a current. The line EMF alone decides whether two diodes begin to.
void Bridge::place_by_emf(const Circuit &c, Terminals &t)
{
    const double                dc_link_V = c.dc_link.voltage_V();
    const std::array<double, 3> e         = as_array(c.plant.emf_V());
    const auto                  most      = std::minmax_element(e.begin(), e.end());
    // Where the star point is: a closed leg says it, else the lines lie evenly between the rails.
    double star_V = 0.5 * (dc_link_V - *most.first - *most.second);
    for (std::size_t x = 0; x < 3; x++) {
        star_V = t.open[x] ? star_V : t.v_V[x] - e[x];
    }
    for (const auto *extreme : {most.first, most.second}) {
        const auto x = static_cast<std::size_t>(extreme - e.begin());
        diode_[x]    = t.open[x] ? diode_at(x, star_V + e[x], dc_link_V) : Diode::none;
    }
    for (std::size_t x = 0; x < 3; x++) {
        if (t.open[x]) {
            place(t, x, diode_[x], star_V + e[x], dc_link_V);
        }
    }
}

/// EQ-OPEN-1, EQ-OPEN-2: each open leg at the rail of the diode that carries its current, or floating.
void Bridge::place_diodes(const Circuit &c, Terminals &t, const std::array<double, 3> &i)
{
    const double dc_link_V = c.dc_link.voltage_V();
    note_openings(t, i);
    for (std::size_t x = 0; x < 3; x++) {
        if (t.open[x]) {
            place(t, x, diode_[x], 0.0, dc_link_V);
        }
    }
    const int floating = t.floating_count();
    if (floating == 0) {
        return;
    }
    if (floating > 1) {
        place_by_emf(c, t);
    }
    for (std::size_t x = 0; t.floating_count() == 1 && x < 3; x++) {
        if (t.floats[x]) {
            const double floating_V = c.plant.floating_V(t.v_V, x);
            diode_[x]               = diode_at(x, floating_V, dc_link_V);
            place(t, x, diode_[x], floating_V, dc_link_V);
        }
    }
}

/// Over a piece a current is a straight line.
Bridge::Piece Bridge::piece_of(const Circuit &c, const Terminals &t, const std::array<double, 3> &i,
                               double longest_s) const
{
    const std::array<double, 3> rate = as_array(c.plant.phase_current_rate_Aps(clarke(t.v_V)));
    Piece                       piece{longest_s, -1};
    for (std::size_t x = 0; x < 3; x++) {
        if (diode_[x] == Diode::none) {
            continue;
        }
        const double along      = diode_[x] == Diode::lower ? 1.0 : -1.0;
        const double fading_Aps = -along * rate[x];
        if (fading_Aps > 0.0 && along * i[x] < fading_Aps * piece.dt_s) {
            piece = {std::max(0.0, along * i[x] / fading_Aps), static_cast<int>(x)};
        }
    }
    return piece;
}

/// A diode's current has reached zero.
void Bridge::end_current(const Circuit &c, const Terminals &t, std::size_t phase)
{
    diode_[phase] = Diode::none;
    int carrying  = 0;
    for (std::size_t x = 0; x < 3; x++) {
        carrying += !t.open[x] || diode_[x] != Diode::none ? 1 : 0;
    }
    if (carrying < 2) {
        c.plant.clear_current();
    } else {
        c.plant.clear_current(phase);
    }
}

} // namespace sdre
