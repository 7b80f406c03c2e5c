// SPDX-License-Identifier: MIT
/// Strict reading of a TOML table. Every value is checked, and every key must be known. Each error
/// is one line with file, key, value and the allowed range.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <toml++/toml.h>

namespace sdre {

/// Closed interval of allowed values.
struct Range {
    double lo;
    double hi;
};

/// Parses a file; InputError when it is missing, unreadable or not TOML.
toml::table parse_toml_file(const std::filesystem::path &file);
/// The same of a text; `source` names it in messages.
toml::table parse_toml_text(const std::string &text, const std::string &source);

class TomlReader {
public:
    /// @param where "[motor]" or "" for the top level; used in messages only.
    TomlReader(std::string file, std::string where, const toml::table &table);

    bool        has(const std::string &key) const;
    double      number(const std::string &key, Range allowed);
    double      number(const std::string &key); ///< any finite number; the caller checks it
    double      number_or(const std::string &key, Range allowed, double fallback);
    int         integer(const std::string &key, Range allowed);
    int         integer_or(const std::string &key, Range allowed, int fallback);
    bool        boolean_or(const std::string &key, bool fallback);
    std::string text(const std::string &key);
    std::string text_or(const std::string &key, const std::string &fallback);
    /// An array of numbers whose length is one of the given ones.
    std::vector<double> numbers(const std::string &key, const std::vector<std::size_t> &lengths,
                                Range allowed);
    TomlReader          table(const std::string &key);
    std::optional<TomlReader> table_if(const std::string &key);
    /// An array of tables; empty when the key is missing.
    std::vector<TomlReader> tables(const std::string &key);

    /// Every key in this table, in order (for tables whose keys are names of their own).
    std::vector<std::string> keys() const;
    /// InputError when the table has an unknown key.
    void reject_unknown_keys() const;
    /// Throws InputError about a key of this table: "FILE: [where] key WHAT".
    [[noreturn]] void fail(const std::string &key, const std::string &what) const;

private:
    const toml::node &required(const std::string &key, const std::string &allowed);
    double checked_number(const std::string &key, const toml::node &node, Range allowed) const;

    std::string           file_;
    std::string           where_;
    const toml::table    *table_;
    std::set<std::string> known_;
};

} // namespace sdre
