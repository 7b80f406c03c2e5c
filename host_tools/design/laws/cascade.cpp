// SPDX-License-Identifier: MIT
#include "design/laws/cascade.hpp"

#include <fmt/format.h>

#include "design/certificate.hpp"
#include "design/foc/foc_loop.hpp"

namespace sdre {
namespace {

std::string axis_block(const char *name, const foc_axis_t &a)
{
    return c_block(name, c_field("kp_V_per_A", a.kp_V_per_A) + c_field("ki_tick", a.ki_tick) +
                             c_field("ki_per_kp", a.ki_per_kp));
}

} // namespace

void certify_cascade(Design &d)
{
    certify_loop(d, foc_family(d));
}

std::string cascade_summary(const Design &d, const std::string &method)
{
    return fmt::format(" * method     {}, {}\n", law_name(d.drive.law), method) +
           verdict_lines(*d.certificate.loop);
}

std::string cascade_blocks(const foc_config_t &foc, const speed_difference_config_t &speed)
{
    return c_block("foc", axis_block("d", foc.d) + axis_block("q", foc.q) +
                              c_field("current_max_A", foc.current_max_A) +
                              c_field("iq_max_A", foc.iq_max_A) + c_field("mtpa_A", foc.mtpa_A) +
                              c_field("id_min_A", foc.id_min_A) +
                              c_field("voltage_share", foc.voltage_share) +
                              c_field("weakening_A_per_V", foc.weakening_A_per_V)) +
           c_block("speed", c_field("periods", speed.periods) +
                                c_field("inv_span_1ps", speed.inv_span_1ps) +
                                c_field("edge_gap_max_s", speed.edge_gap_max_s));
}

} // namespace sdre
