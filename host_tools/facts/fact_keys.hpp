// SPDX-License-Identifier: MIT
/// Keys of a data sheet, one per fact: quantity, definition, unit. `line_to_line_resistance_mOhm`,
/// `ke_line_to_line_rms_V_per_krpm`, `rated_current_A_rms`, `inertia_kgcm2`.
#pragma once

#include <string>
#include <vector>

#include <toml++/toml.h>

namespace sdre {

enum class Connection { unsaid, phase, line_to_line };
enum class Amplitude { unsaid, peak, rms };

struct Fact {
    std::string quantity;         ///< "resistance", "rated_speed": a name of quantity_names()
    double      si         = 0.0; ///< in SI units, as it is meant: not yet per phase or peak
    Connection  connection = Connection::unsaid;
    Amplitude   amplitude  = Amplitude::unsaid;
    bool        electrical = false; ///< a speed of the field
    std::string text;               ///< "inertia_kgcm2 = 0.83", for comments and complaints
};

/// All facts of a machine.
struct Facts {
    std::string       source; ///< file, for complaints
    std::string       name;   ///< of the drive, "" when not given
    std::string       regeneration;
    std::string       board;      ///< of the board file, "" when not given
    std::string       drive_file; ///< that will be written; board files are looked for beside it
    bool              edge_times = true;
    std::vector<Fact> facts;

    /// The facts about a quantity, in the order in which they were given.
    std::vector<Fact> of(const std::string &quantity) const;
    bool              has(const std::string &quantity) const;
};

/// One key and its number. InputError in one line when the key is not understood or the number not allowed.
Fact parse_fact(const std::string &source, const std::string &key, double value);

/// A table of facts. InputError in one line on anything that is not understood.
Facts parse_facts(const std::string &source, const toml::table &table);

/// Every quantity with its units, one line each, for --help and messages.
std::string quantity_names();

} // namespace sdre
