// SPDX-License-Identifier: MIT
#include "design/laws/cascade.hpp"

#include <array>

#include <fmt/format.h>

#include "common/c_text.hpp"
#include "design/certificate.hpp"
#include "design/foc/foc_loop.hpp"

namespace sdre {

void certify_cascade(Design &d)
{
    certify_loop(d, foc_family(d));
}

std::string cascade_summary(const Design &d, const std::string &method)
{
    return fmt::format(" * method     {}, {}\n", law_name(d.drive.law), method) +
           verdict_lines(*d.certificate.loop);
}

Layout gains_layout(const drive_config_t &config)
{
    static_assert(SPEED_DIFFERENCE_COUNTED == 0 && SPEED_DIFFERENCE_TIMED == 1);
    constexpr std::array labels{"counted", "timed"};
    std::string          s;
    for (const NamedConstant &c : law_constants(config)) {
        for (std::size_t n = 0; c.name == "gains" && n < c.parts.size(); n++) {
            s += fmt::format("{{ /* {} */\n", labels.at(n)) +
                 c_indented(constants_text(c.parts[n].parts, {})) + "},\n";
        }
    }
    return {{"gains", c_block("gains", s)}};
}

} // namespace sdre
