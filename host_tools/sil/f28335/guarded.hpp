// SPDX-License-Identifier: MIT
/// Write protection of registers: EALLOW, and units without a clock. A register is plain memory. At
/// each look the guard compares it with a copy and restores it.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sil/f28335/findings.hpp"

namespace sdre::f28335 {

class Guard {
public:
    Guard();

    /// Accepts the present values.
    void remember();
    /// Restores and reports forbidden writes since the last remember(), then remembers.
    void check(bool eallow, Findings &findings, double time_s);

private:
    /// A register that needs EALLOW in a region that does not.
    struct Part {
        std::string name;
        std::size_t offset;
        std::size_t bytes;
    };
    struct Region {
        std::string                name;
        unsigned char             *data;
        std::size_t                bytes;
        bool                       eallow;  ///< needs EALLOW
        std::function<bool()>      clocked; ///< empty: always
        std::vector<unsigned char> copy;
        std::vector<Part>          parts;
    };
    static void restore_parts(Region &r, Findings &findings, double time_s);
    void        add(const std::string &name, volatile void *data, std::size_t bytes, bool eallow,
                    const std::function<bool()> &clocked = {});
    void        add_can();
    std::vector<Region> regions_;
};

} // namespace sdre::f28335
