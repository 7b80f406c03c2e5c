// SPDX-License-Identifier: MIT
/// The virtual drive of `sdre-sil serve` for a page: takes a request and gives an answer, both JSON.
///
///     {"drive": FILE, "seed": 1}       -> {"name"}     off and on
///     {"run_s": S, "wall_s": S,        -> {"time_s",   simulated time, 20 ms later at most
///      "frames": ["0104..", ..]}          "frames": ["0104..", ..]}   Modbus RTU, whole, in hexadecimal
///     {"control": "load 1.2"}          -> as the control port answers (sil/served/control.hpp)
///
/// or {"error": one line}.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/errors.hpp"
#include "sil/served/control.hpp"
#include "sil/served/motor_record.hpp"
#include "sil/served/serial_bus.hpp"
#include "sil/served/served_f28335.hpp"

namespace sdre {
namespace {

using nlohmann::json;

constexpr double most_s =
    0.02; // chosen: what is late by more is left out, as in sil/serve/server.cpp
constexpr std::uint8_t unit = 1;

struct Served {
    explicit Served(const Drive &d, std::uint64_t seed) : drive(d, seed) {}

    ServedF28335 drive;
    MotorRecord  record;
    SerialBus    bus;
    Pace         pace;
};

std::unique_ptr<Served> served; // the registers of the device exist once

Octets octets_of(const std::string &hex)
{
    Octets octets;
    for (std::size_t n = 0; n + 1 < hex.size(); n += 2) {
        octets.push_back(static_cast<std::uint8_t>(std::stoul(hex.substr(n, 2), nullptr, 16)));
    }
    return octets;
}

std::string hex_of(const Octets &octets)
{
    std::string hex;
    for (const std::uint8_t octet : octets) {
        hex += fmt::format("{:02x}", octet);
    }
    return hex;
}

json run(const json &request)
{
    json answers = json::array();
    for (const json &frame : request.value("frames", json::array())) {
        served->bus.push({0, 0, unit, octets_of(frame.get<std::string>())});
    }
    const double wanted_s = request.at("run_s").get<double>();
    const double end_s    = served->drive.time_s() + std::min(wanted_s, most_s);
    served->pace.slip(std::max(wanted_s - most_s, 0.0));
    served->pace.note(request.at("wall_s").get<double>(), served->drive.time_s());
    while (served->drive.time_s() < end_s) {
        served->drive.period();
        served->record.note(served->drive);
        served->bus.step(served->drive, [&](const BusRequest &, const Octets &answer) {
            if (!answer.empty()) {
                answers.push_back(hex_of(answer));
            }
        });
    }
    return {{"time_s", served->drive.time_s()}, {"frames", answers}};
}

std::string answer(const json &request)
{
    if (request.contains("drive")) {
        served.reset();
        served = std::make_unique<Served>(read_drive_file(request.at("drive").get<std::string>()),
                                          request.value("seed", std::uint64_t{1}));
        return json{{"name", served->drive.drive().name}}.dump();
    }
    if (!served) {
        throw InputError("no drive is open");
    }
    if (request.contains("control")) {
        return control_answer(request.at("control").get<std::string>(), served->drive,
                              served->record, {served->pace, std::nullopt});
    }
    return run(request).dump();
}

} // namespace
} // namespace sdre

/// The answer stays until the next one.
extern "C" const char *sdre_drive_answer(const char *request)
{
    static std::string text;
    try {
        text = sdre::answer(nlohmann::json::parse(request));
    } catch (const std::exception &error) {
        text = nlohmann::json{{"error", error.what()}}.dump();
    }
    return text.c_str();
}
