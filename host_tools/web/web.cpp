// SPDX-License-Identifier: MIT
/// `sdre-sil run` for a page: takes a request and gives an answer, both JSON.
///
///     {"files": true}                         -> {"scenarios": {NAME: file as JSON}, "drives": {..}}
///     {"scenario": NAME, "drive": NAME,       -> {"text", "csv", "fault", "uncertified",
///      "scenario_changes": {KEYS: VALUE, ..},      "scenario_toml", "drive_toml"}
///      "drive_changes": {"nosc.Q": [..], ..}}
///
/// or {"error": one line}. Both TOML texts are what was run: saved as scenario.toml and drive.toml side by side they
/// are the same run for `sdre-sil run scenario.toml`.
#include <filesystem>
#include <sstream>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <toml++/toml.h>

#include "common/errors.hpp"
#include "common/toml_keys.hpp"
#include "common/toml_reader.hpp"
#include "sil/eval/results.hpp"
#include "sil/run/faults.hpp"
#include "sil/run/simulation.hpp"

namespace sdre {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

const fs::path scenarios = "/host_tools/sil/scenarios";
const fs::path drives    = "/firmware/config/drives";

json files_of(const fs::path &directory)
{
    json found = json::object();
    for (const fs::directory_entry &entry : fs::directory_iterator(directory)) {
        if (!entry.is_regular_file()) {
            continue; // the room of the faults
        }
        std::ostringstream text;
        text << toml::json_formatter(parse_toml_file(entry.path()));
        found[entry.path().stem().string()] = json::parse(text.str());
    }
    return found;
}

KeyPath path_of(const std::string &dotted)
{
    KeyPath            path;
    std::istringstream keys(dotted);
    for (std::string key; std::getline(keys, key, '.');) {
        path.push_back(key);
    }
    return path;
}

void change(toml::table &root, const std::string &source, const json &changes)
{
    for (const auto &[dotted, value] : changes.items()) {
        const KeyPath path  = path_of(dotted);
        toml::table  &table = table_of(root, path, source);
        if (value.is_array()) {
            toml::array numbers;
            for (const json &number : value) {
                numbers.push_back(number.get<double>());
            }
            table.insert_or_assign(path.back(), std::move(numbers));
        } else if (value.is_boolean()) {
            table.insert_or_assign(path.back(), value.get<bool>());
        } else if (value.is_number_integer()) {
            table.insert_or_assign(path.back(), value.get<std::int64_t>());
        } else {
            table.insert_or_assign(path.back(), value.get<double>());
        }
    }
}

std::string text_of(const toml::table &table)
{
    std::ostringstream text;
    text << table << '\n';
    return text.str();
}

/// A file with its changes, as text.
std::string changed(const fs::path &file, const json &changes, const char *drive = nullptr)
{
    toml::table root = parse_toml_file(file);
    change(root, file.filename().string(), changes);
    if (drive != nullptr) {
        root.insert_or_assign("drive", drive);
    }
    return text_of(root);
}

json answer(const json &request)
{
    if (request.contains("files")) {
        return {{"scenarios", files_of(scenarios)}, {"drives", files_of(drives)}};
    }
    const auto        name    = request.at("scenario").get<std::string>();
    const fs::path    drive   = drives / (request.at("drive").get<std::string>() + ".toml");
    const std::string drive_t = changed(drive, request.value("drive_changes", json::object()));
    const std::string toml =
        changed(scenarios / (name + ".toml"), request.value("scenario_changes", json::object()),
                "drive.toml");
    const Drive    d = read_drive_text(drive_t, drive.filename().string(), drive.string());
    const Scenario scenario =
        read_scenario_table(parse_toml_text(toml, name), name, "scenario", d, d.law);
    const SimulationResult result = simulate(scenario);
    return {{"text", result_text(scenario, result, measure(scenario, result.trace))},
            {"csv", trace_csv(result.trace)},
            {"fault", result.fault == 0 ? "" : fault_name(result.fault)},
            {"uncertified", fmt::format("{}", fmt::join(result.uncertified, "; "))},
            {"scenario_toml", toml},
            {"drive_toml", drive_t}};
}

} // namespace
} // namespace sdre

/// The answer stays until the next one.
extern "C" const char *sdre_web_answer(const char *request)
{
    static std::string text;
    try {
        text = sdre::answer(nlohmann::json::parse(request)).dump();
    } catch (const std::exception &error) {
        text = nlohmann::json{{"error", error.what()}}.dump();
    }
    return text.c_str();
}
