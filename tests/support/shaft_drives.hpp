// SPDX-License-Identifier: MIT
/// The shipped drive of noc_shaft with other resonances, each with weights of its own.
#pragma once

#include <string>

#include "drive/drive_file.hpp"
#include "shipped_drive.hpp"
#include "temp_dir.hpp"

namespace support {

struct ShaftWeights {
    double      resonance_Hz;
    const char *nosc_Q, *nodo_Q, *shaft_Q, *shaft_nodo_Q; ///< none: as shipped
};

/// Found by a search, as those of the shipped drive.
inline constexpr ShaftWeights shaft_weights[] = {
    {80.0, "0.004901, 4.425e-08, 11.1", "9.667e+07, 3.979e+04, 3.979e+04, 208.9, 7.055, 7.055, 0.0",
     "0.0699, 4777", "4986, 1.226e-06"},
    {220.0, nullptr, nullptr, nullptr, nullptr},
    {400.0, "0.009292, 1.392e-05, 11.1",
     "4.168e+07, 3.601e+06, 3.601e+06, 484.3, 215.8, 215.8, 0.0", "1.176, 250",
     "0.2731, 1.575e-06"},
};

/// Replaces the array of a key in a section of a drive file.
inline void set_array(std::string &text, const std::string &section, const std::string &key,
                      const std::string &numbers)
{
    const std::size_t at    = text.find("\n" + key + " = [", text.find("[" + section + "]"));
    const std::size_t first = text.find('[', at);
    text.replace(first, text.find(']', first) + 1 - first, "[" + numbers + "]");
}

inline std::string shaft_drive_text(const ShaftWeights &w)
{
    std::string       text = read_file(shipped_drive("ipmsm_390w_shaft"));
    const std::string from = "resonance_Hz       = 220.0";
    text.replace(text.find(from), from.size(), "resonance_Hz = " + std::to_string(w.resonance_Hz));
    if (w.nosc_Q != nullptr) {
        set_array(text, "nosc", "Q", w.nosc_Q);
        set_array(text, "nodo", "Q", w.nodo_Q);
        set_array(text, "shaft", "Q", w.shaft_Q);
        set_array(text, "shaft", "nodo_Q", w.shaft_nodo_Q);
    }
    return text;
}

inline sdre::Drive shaft_drive(const ShaftWeights &w)
{
    return sdre::read_drive_text(shaft_drive_text(w), shipped_drive("ipmsm_390w_shaft").string());
}

} // namespace support
