// SPDX-License-Identifier: MIT
#include "drive/board_file.hpp"

#include <cmath>

#include <fmt/format.h>

#include "drive/shipped_boards.hpp"

namespace sdre {
namespace {

namespace fs = std::filesystem;

// Wide enough for any board, narrow enough that a slipped unit is caught.
constexpr Range  current_A{1e-3, 1e4};
constexpr Range  dc_link_V{1.0, 2e4};
constexpr Range  resistance_Ohm{10.0, 1e7};
constexpr Range  temperature_degC{-40.0, 200.0};
constexpr Range  offset_cnt{1.0, 1e3};
constexpr Range  settle_s{0.0, 2e-5};
constexpr double two_sensors = 2.0; // of a board file that does not tell

std::array<Range, BOARD_FACT_COUNT> allowed_values(const Processor &p)
{
    std::array<Range, BOARD_FACT_COUNT> a{};
    a[BOARD_FACT_PWM_CLOCK_Hz]             = {p.counter_Hz, p.counter_Hz};
    a[BOARD_FACT_GATE_ON_LEVEL]            = {1.0, 1.0}; // no board layer has another
    a[BOARD_FACT_DEAD_TIME_MIN_s]          = {1e-8, 2e-5};
    a[BOARD_FACT_PRECHARGE_s]              = {0.0, 0.5};
    a[BOARD_FACT_DUTY_MAX]                 = {0.5, 1.0};
    a[BOARD_FACT_PULSE_MIN_s]              = {0.0, 2e-5};
    a[BOARD_FACT_CURRENT_RANGE_A]          = current_A;
    a[BOARD_FACT_CURRENT_SENSORS]          = {2.0, 3.0};
    a[BOARD_FACT_RATED_CURRENT_A]          = current_A;
    a[BOARD_FACT_TRIP_CURRENT_A]           = current_A;
    a[BOARD_FACT_DC_LINK_RANGE_V]          = dc_link_V;
    a[BOARD_FACT_RATED_DC_LINK_V]          = dc_link_V;
    a[BOARD_FACT_NTC_RESISTANCE_Ohm]       = resistance_Ohm;
    a[BOARD_FACT_NTC_BETA_K]               = {1e3, 1e4};
    a[BOARD_FACT_NTC_DIVIDER_Ohm]          = resistance_Ohm;
    a[BOARD_FACT_TEMPERATURE_LIMIT_degC]   = temperature_degC;
    a[BOARD_FACT_TEMPERATURE_TRIP_degC]    = temperature_degC;
    a[BOARD_FACT_INVERTER_CURRENT_A]       = current_A;
    a[BOARD_FACT_INVERTER_TIME_CONSTANT_s] = {1e-2, 1e5};
    a[BOARD_FACT_ENCODER_EDGES_Hz]         = {1e3, 1e8};
    a[BOARD_FACT_CHOPPER_ON_V]             = dc_link_V;
    a[BOARD_FACT_CHOPPER_OFF_V]            = dc_link_V;
    a[BOARD_FACT_CHOPPER_RESISTANCE_Ohm]   = {0.1, 1e5};
    a[BOARD_FACT_CHOPPER_POWER_W]          = {0.1, 1e6};
    a[BOARD_FACT_CHOPPER_TIME_CONSTANT_s]  = {1.0, 1e5};
    return a;
}

const char *key_of(int fact)
{
    return board_field_name(static_cast<std::uint16_t>(fact + 1));
}

std::string read_name(TomlReader &t)
{
    constexpr std::size_t longest = 2 * BOARD_NAME_WORDS;
    const std::string     name    = t.text("name");
    if (name.empty() || name.size() > longest ||
        name.find_first_not_of(
            "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") !=
            std::string::npos) {
        t.fail("name", fmt::format("must be 1 .. {} of A-Z a-z 0-9 _ -", longest));
    }
    return name;
}

const Processor *read_processor(TomlReader &t)
{
    const std::string      name = t.text_or("processor", default_processor().name);
    const Processor *const p    = find_processor(name);
    if (p == nullptr) {
        t.fail("processor",
               fmt::format("= \"{}\" is not allowed: must be one of {}", name, processor_names()));
    }
    return p;
}

/// A board without any of these keys has no brake chopper: 0. One of them asks for all.
double read_chopper(TomlReader &t, std::size_t fact, Range allowed)
{
    bool any = false;
    for (int n = BOARD_FACT_CHOPPER_ON_V; n <= BOARD_FACT_CHOPPER_TIME_CONSTANT_s; n++) {
        any = any || t.has(key_of(n));
    }
    return any ? t.number(key_of(static_cast<int>(fact)), allowed) : 0.0;
}

double read_fact(TomlReader &t, std::size_t fact, Range allowed)
{
    if (fact >= BOARD_FACT_CHOPPER_ON_V && fact <= BOARD_FACT_CHOPPER_TIME_CONSTANT_s) {
        return read_chopper(t, fact, allowed);
    }
    const char *key = key_of(static_cast<int>(fact));
    return fact == BOARD_FACT_CURRENT_SENSORS ? t.number_or(key, allowed, two_sensors)
                                              : t.number(key, allowed);
}

/// The first fact must be below the second, or not above it.
void ordered(const TomlReader &t, const BoardFile &b, board_fact_t low, board_fact_t high,
             bool below)
{
    if (b[low] > b[high] || (below && b[low] == b[high])) {
        t.fail(key_of(low), fmt::format("= {:g} is not allowed: must {} {} = {:g}", b[low],
                                        below ? "be below" : "not exceed", key_of(high), b[high]));
    }
}

BoardFile read_board_table(const toml::table &root, const fs::path &file)
{
    TomlReader t(file.string(), "", root);
    const int  schema = t.integer("schema", {0, 1e6});
    if (schema != board_schema) {
        t.fail("schema",
               fmt::format("= {} is not allowed: this tool reads schema {}", schema, board_schema));
    }
    BoardFile b;
    b.file = file.string();
    b.name = read_name(t);
    if (b.name != file.stem().string()) {
        t.fail("name", fmt::format("= \"{}\" is not allowed: must be that of the file", b.name));
    }
    b.processor                                       = read_processor(t);
    const std::array<Range, BOARD_FACT_COUNT> allowed = allowed_values(*b.processor);
    for (std::size_t fact = 0; fact < allowed.size(); fact++) {
        b.facts.at(fact) = read_fact(t, fact, allowed.at(fact));
    }
    b.offset_max_cnt   = t.number_or("current_offset_max_cnt", offset_cnt, b.offset_max_cnt);
    b.current_settle_s = t.number_or("current_settle_s", settle_s, b.current_settle_s);
    t.reject_unknown_keys();
    if (b[BOARD_FACT_CHOPPER_ON_V] > 0.0 && !b.processor->has_chopper_pin) {
        t.fail(key_of(BOARD_FACT_CHOPPER_ON_V),
               fmt::format("is not allowed: {} has no pin for a brake chopper", b.processor->name));
    }
    if (b[BOARD_FACT_CURRENT_SENSORS] != std::floor(b[BOARD_FACT_CURRENT_SENSORS])) {
        t.fail(key_of(BOARD_FACT_CURRENT_SENSORS),
               fmt::format("= {:g} is not allowed: must be 2 or 3", b[BOARD_FACT_CURRENT_SENSORS]));
    }
    ordered(t, b, BOARD_FACT_RATED_CURRENT_A, BOARD_FACT_TRIP_CURRENT_A, true);
    ordered(t, b, BOARD_FACT_TRIP_CURRENT_A, BOARD_FACT_CURRENT_RANGE_A, false);
    ordered(t, b, BOARD_FACT_RATED_DC_LINK_V, BOARD_FACT_DC_LINK_RANGE_V, false);
    if (b[BOARD_FACT_CHOPPER_ON_V] > 0.0) {
        ordered(t, b, BOARD_FACT_CHOPPER_OFF_V, BOARD_FACT_CHOPPER_ON_V, true);
        ordered(t, b, BOARD_FACT_CHOPPER_ON_V, BOARD_FACT_RATED_DC_LINK_V, true);
    }
    ordered(t, b, BOARD_FACT_TEMPERATURE_LIMIT_degC, BOARD_FACT_TEMPERATURE_TRIP_degC, true);
    return b;
}

} // namespace

BoardFile read_board_file(const fs::path &file)
{
    return read_board_table(parse_toml_file(file), file);
}

std::optional<BoardFile> named_board(const std::string &name, const std::string &drive_file)
{
    const std::string file   = name + ".toml";
    const fs::path    beside = fs::path(drive_file).parent_path();
    for (const fs::path &place : {beside / file, beside / ".." / "boards" / file}) {
        std::error_code none;
        if (fs::is_regular_file(place, none)) {
            return read_board_file(place);
        }
    }
    const auto shipped = shipped_board_texts().find(name);
    if (shipped == shipped_board_texts().end()) {
        return {};
    }
    return read_board_table(parse_toml_text(shipped->second, file), file);
}

BoardFile find_board(TomlReader &section, const std::string &drive_file)
{
    const std::string        name  = read_name(section);
    std::optional<BoardFile> board = named_board(name, drive_file);
    if (!board) {
        section.fail("name", no_such_board(name));
    }
    return *board;
}

std::string no_such_board(const std::string &name)
{
    return fmt::format("= \"{}\" is not allowed: there is no {}.toml beside this file, and the "
                       "shipped boards are {}",
                       name, name, shipped_boards());
}

std::string shipped_boards()
{
    std::string names;
    for (const auto &[name, text] : shipped_board_texts()) {
        names += (names.empty() ? "" : ", ") + name;
    }
    return names;
}

} // namespace sdre
