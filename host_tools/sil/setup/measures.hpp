// SPDX-License-Identifier: MIT
/// Measures of a run, and the published values for them.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/toml_reader.hpp"
#include "drive/drive_file.hpp"

namespace sdre {

struct Measure {
    std::string name;
    double      time_s =
        0.0; ///< the event; the window ends at the next measure or at the end of the run
    double band_e_radps = 0.0; ///< settled when the speed stays this close to the final reference
    std::map<std::string, double> paper; ///< published for this drive's law, by metric name
    std::optional<double>         tail_s =
        std::nullopt; ///< the steady part; the window's last fifth unless given
};

/// The [[measure]] entries. Published values are those of `law`; a scenario's own law is `own`.
std::vector<Measure> read_measures(TomlReader &t, Law law, Law own);

} // namespace sdre
