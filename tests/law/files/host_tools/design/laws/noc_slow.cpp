// SPDX-License-Identifier: MIT
#include "design/laws/near_optimal.hpp"

namespace sdre {
namespace {

bool is_for(const Drive &drive)
{
    return drive.law == Law::noc_slow;
}

/// The filter is outside the loop: gains, certificate and verdict are those of noc.
void solve(Design &d)
{
    noc_design.solve(d);
    law_noc_slow_config_t c{};
    c.noc   = *constants_of<law_noc_config_t>(d.config);
    c.share = single(d.drive.command_share);
    keep_constants(d, c);
}

std::string summary(const Design &d)
{
    return residual_line(worst_residual(d)) + controller_line(d.certificate.nosc) +
           observer_line(d.certificate.nodo) + verdict_lines(*d.certificate.loop);
}

std::vector<std::string> mismatches(const Design &d)
{
    return nosc_mismatches(constants_of<law_noc_slow_config_t>(d.config)->noc.near_optimal);
}

Layout layout(const Design &)
{
    return {};
}

} // namespace

const LawDesign noc_slow_design = [] {
    LawDesign d{"law_noc_slow", "law_noc_slow_config_t", is_for, solve, summary, mismatches,
                layout};
    d.weights    = Weights::by_goals;
    d.scheduling = {{"e_iq"}, {"iq"}};
    d.noise_knob = observer_knob("noc_slow");
    return d;
}();

} // namespace sdre
