// SPDX-License-Identifier: MIT
#include "common/toml_keys.hpp"

#include <fmt/format.h>

#include "common/errors.hpp"

namespace sdre {
namespace {

[[noreturn]] void refuse(const std::string &source, const KeyPath &path, const char *why)
{
    throw InputError(fmt::format("{}: {} {}", source, fmt::join(path, "."), why));
}

/// The entry of an array of tables that a number names.
toml::node *entry_of(toml::array &array, const std::string &key)
{
    if (key.empty() || key.size() > 6 || key.find_first_not_of("0123456789") != std::string::npos) {
        return nullptr;
    }
    return array.get(static_cast<std::size_t>(std::stoul(key)));
}

} // namespace

toml::table &table_of(toml::table &root, const KeyPath &path, const std::string &source)
{
    toml::node *node = &root;
    for (std::size_t i = 0; i + 1 < path.size(); i++) {
        if (toml::table *table = node->as_table()) {
            node = &table->emplace<toml::table>(path[i]).first->second;
        } else if (toml::array *array = node->as_array()) {
            node = entry_of(*array, path[i]);
        } else {
            node = nullptr;
        }
        if (node == nullptr) {
            refuse(source, path, "leads nowhere: an array has no such entry, count from 0");
        }
    }
    if (node->as_table() == nullptr) {
        refuse(source, path, "leads nowhere: what holds its last key is no table");
    }
    return *node->as_table();
}

} // namespace sdre
