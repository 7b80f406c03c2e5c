// SPDX-License-Identifier: MIT
#include "common/toml_reader.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/file_output.hpp"
#include "common/toml_depth.hpp"

namespace sdre {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Range  any{-infinity, infinity};

std::string must_be(const char *what, Range allowed)
{
    return allowed.hi == infinity
               ? fmt::format("must be {}", what)
               : fmt::format("must be {} in {:g} .. {:g}", what, allowed.lo, allowed.hi);
}

/// A value as it stands in the file, on one line.
std::string shown(const toml::node &node)
{
    std::ostringstream text;
    node.visit([&](const auto &value) { text << value; });
    std::string s = text.str();
    std::replace(s.begin(), s.end(), '\n', ' ');
    return s;
}

} // namespace

toml::table parse_toml_file(const std::filesystem::path &file)
{
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) {
        throw InputError(fmt::format("{}: no such file", file.string()));
    }
    return parse_toml_text(read_text_file(file), file.string());
}

toml::table parse_toml_text(const std::string &text, const std::string &source)
{
    if (const long line = too_deep_line(text)) {
        throw InputError(fmt::format("{}:{}: nested deeper than {} tables and arrays: give fewer "
                                     "dots and brackets",
                                     source, line, toml_depth_max));
    }
    try {
        return toml::parse(text);
    } catch (const toml::parse_error &e) {
        std::string what(e.description());
        for (char &c : what) {
            c = (c == '\n' || c == '\r') ? ' ' : c;
        }
        throw InputError(
            fmt::format("{}:{}: not valid TOML: {}", source, e.source().begin.line, what));
    }
}

TomlReader::TomlReader(std::string file, std::string where, const toml::table &table)
    : file_(std::move(file)), where_(std::move(where)), table_(&table)
{
}

void TomlReader::fail(const std::string &key, const std::string &what) const
{
    throw InputError(
        fmt::format("{}: {}{}{} {}", file_, where_, where_.empty() ? "" : " ", key, what));
}

bool TomlReader::has(const std::string &key) const
{
    return table_->contains(key);
}

const toml::node &TomlReader::required(const std::string &key, const std::string &allowed)
{
    known_.insert(key);
    const toml::node *node = table_->get(key);
    if (node == nullptr) {
        fail(key, fmt::format("is missing: {}", allowed));
    }
    return *node;
}

double TomlReader::checked_number(const std::string &key, const toml::node &node,
                                  Range allowed) const
{
    double x = 0.0;
    if (const auto *whole = node.as_integer()) {
        x = static_cast<double>(whole->get());
    } else if (const auto *real = node.as_floating_point()) {
        x = real->get();
    } else {
        fail(key,
             fmt::format("= {} is not allowed: {}", shown(node), must_be("a number", allowed)));
    }
    if (!std::isfinite(x) && allowed.hi == infinity) {
        fail(key, fmt::format("= {:g} is not allowed: must be finite", x));
    }
    if (!std::isfinite(x) || x < allowed.lo || x > allowed.hi) {
        fail(key, fmt::format("= {:g} is not allowed: must be in {:g} .. {:g}", x, allowed.lo,
                              allowed.hi));
    }
    return x;
}

double TomlReader::number(const std::string &key, Range allowed)
{
    return checked_number(key, required(key, must_be("a number", allowed)), allowed);
}

double TomlReader::number(const std::string &key)
{
    return checked_number(key, required(key, must_be("a number", any)), any);
}

double TomlReader::number_or(const std::string &key, Range allowed, double fallback)
{
    known_.insert(key);
    return has(key) ? number(key, allowed) : fallback;
}

int TomlReader::integer(const std::string &key, Range allowed)
{
    const toml::node &node = required(key, must_be("a whole number", allowed));
    if (!node.is_integer()) {
        fail(key, fmt::format("= {} is not allowed: {}", shown(node),
                              must_be("a whole number", allowed)));
    }
    return static_cast<int>(checked_number(key, node, allowed));
}

int TomlReader::integer_or(const std::string &key, Range allowed, int fallback)
{
    known_.insert(key);
    return has(key) ? integer(key, allowed) : fallback;
}

bool TomlReader::boolean_or(const std::string &key, bool fallback)
{
    known_.insert(key);
    if (!has(key)) {
        return fallback;
    }
    const toml::node &node = required(key, "must be true or false");
    if (!node.is_boolean()) {
        fail(key, "must be true or false");
    }
    return *node.value<bool>();
}

std::string TomlReader::text(const std::string &key)
{
    const toml::node &node = required(key, "must be a string");
    if (!node.is_string()) {
        fail(key, "must be a string");
    }
    return *node.value<std::string>();
}

std::string TomlReader::text_or(const std::string &key, const std::string &fallback)
{
    known_.insert(key);
    return has(key) ? text(key) : fallback;
}

std::vector<double> TomlReader::numbers(const std::string              &key,
                                        const std::vector<std::size_t> &lengths, Range allowed)
{
    const toml::array *array     = required(key, "must be an array of numbers").as_array();
    bool               length_ok = false;
    std::string        choices;
    for (std::size_t n : lengths) {
        length_ok = length_ok || (array != nullptr && array->size() == n);
        choices += fmt::format("{}{}", choices.empty() ? "" : " or ", n);
    }
    if (!length_ok) {
        fail(key, fmt::format("must be an array of {} numbers", choices));
    }
    std::vector<double> values;
    for (std::size_t i = 0; i < array->size(); i++) {
        values.push_back(checked_number(fmt::format("{}[{}]", key, i), *array->get(i), allowed));
    }
    return values;
}

TomlReader TomlReader::table(const std::string &key)
{
    const toml::table *inner = required(key, "must be a table").as_table();
    if (inner == nullptr) {
        fail(key, "must be a table");
    }
    return {file_, fmt::format("[{}]", key), *inner};
}

std::optional<TomlReader> TomlReader::table_if(const std::string &key)
{
    known_.insert(key);
    return has(key) ? std::optional<TomlReader>(table(key)) : std::nullopt;
}

std::vector<TomlReader> TomlReader::tables(const std::string &key)
{
    known_.insert(key);
    std::vector<TomlReader> readers;
    if (!has(key)) {
        return readers;
    }
    const toml::array *array = required(key, "must be an array of tables").as_array();
    if (array == nullptr) {
        fail(key, fmt::format("must be an array of tables, written [[{}]]", key));
    }
    for (std::size_t i = 0; i < array->size(); i++) {
        const toml::table *inner = array->get(i)->as_table();
        if (inner == nullptr) {
            fail(key, fmt::format("must be an array of tables, written [[{}]]", key));
        }
        readers.emplace_back(file_, fmt::format("[[{}]] number {}:", key, i + 1), *inner);
    }
    return readers;
}

std::vector<std::string> TomlReader::keys() const
{
    std::vector<std::string> names;
    for (const auto &[key, node] : *table_) {
        names.emplace_back(key.str());
    }
    return names;
}

void TomlReader::reject_unknown_keys() const
{
    for (const std::string &key : keys()) {
        if (known_.count(key) == 0) {
            std::string allowed;
            for (const std::string &name : known_) {
                allowed += (allowed.empty() ? "" : ", ") + name;
            }
            fail(key, fmt::format("is not a known key; allowed: {}", allowed));
        }
    }
}

} // namespace sdre
