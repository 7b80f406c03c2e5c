// SPDX-License-Identifier: MIT
/// A drive file to take apart: valid as it comes, every key can be replaced or taken away.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace support {

class DriveText {
public:
    /// Replaces or adds a key; section "" is the top level.
    DriveText &set(const std::string &section, const std::string &key, const std::string &value)
    {
        Entries &entries = section_of(section);
        for (auto &[name, text] : entries) {
            if (name == key) {
                text = value;
                return *this;
            }
        }
        entries.emplace_back(key, value);
        return *this;
    }

    DriveText &erase(const std::string &section, const std::string &key)
    {
        Entries &entries = section_of(section);
        entries.erase(std::remove_if(entries.begin(), entries.end(),
                                     [&](const auto &entry) { return entry.first == key; }),
                      entries.end());
        return *this;
    }

    DriveText &erase_section(const std::string &section)
    {
        sections_.erase(std::remove_if(sections_.begin(), sections_.end(),
                                       [&](const auto &s) { return s.first == section; }),
                        sections_.end());
        return *this;
    }

    /// At the end, still empty.
    DriveText &add_section(const std::string &name)
    {
        sections_.push_back({name, {}});
        return *this;
    }

    /// Turns the order of the keys, and of the sections below the top level, around.
    DriveText &reverse()
    {
        std::reverse(sections_.begin() + 1, sections_.end());
        for (auto &section : sections_) {
            std::reverse(section.second.begin(), section.second.end());
        }
        return *this;
    }

    std::string value(const std::string &section, const std::string &key)
    {
        for (const auto &[name, text] : section_of(section)) {
            if (name == key) {
                return text;
            }
        }
        throw std::runtime_error("no key " + key);
    }

    std::string str() const
    {
        std::string text;
        for (const auto &[section, entries] : sections_) {
            text += section.empty() ? "" : "[" + section + "]\n";
            for (const auto &[key, value] : entries) {
                text += key;
                text += " = " + value + "\n";
            }
        }
        return text;
    }

private:
    using Entries = std::vector<std::pair<std::string, std::string>>;

    Entries &section_of(const std::string &name)
    {
        for (auto &[section, entries] : sections_) {
            if (section == name) {
                return entries;
            }
        }
        throw std::runtime_error("no section " + name);
    }

    std::vector<std::pair<std::string, Entries>> sections_{
        {"", {{"schema", "1"}, {"name", "\"bench\""}}},
        {"motor",
         {{"pole_pairs", "2"},
          {"stator_resistance_Ohm", "2.48"},
          {"d_axis_inductance_H", "0.07498"},
          {"q_axis_inductance_H", "0.11391"},
          {"pm_flux_Wb", "0.193"},
          {"inertia_kgm2", "0.00042"},
          {"viscous_friction_Nms", "0.0001"},
          {"rated_speed_e_radps", "523.0"},
          {"rated_torque_Nm", "1.5"},
          {"max_current_A", "4.0"}}},
        {"inverter",
         {{"dc_link_V", "295.0"},
          {"pwm_frequency_Hz", "5000.0"},
          {"dead_time_s", "3e-6"},
          {"updates_per_period", "1"}}},
        {"encoder", {{"lines", "2500"}}},
        {"nosc", {{"order", "2"}, {"Q", "[2.0, 8.0, 8.5]"}, {"T", "[1e-3, 1.25e-3]"}}},
        {"nodo",
         {{"order", "1"},
          {"Q", "[1.0e8, 1.1e8, 1.2e8, 85.0, 86.0, 90.0]"},
          {"T", "[1e-4, 1.5e-4, 2e-4]"}}}};
};

} // namespace support
