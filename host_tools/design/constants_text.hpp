// SPDX-License-Identifier: MIT
/// C initialisers of named constants.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "design/named_constants.hpp"

namespace sdre {

/// Text of single members instead of the usual one. The key is the full name, as in "nodo.gain". Empty text leaves the
/// member zero.
using Layout = std::map<std::string, std::string>;

/// ".name = value,\n" for each number, a block for each structure, a list for each array.
std::string constants_text(const std::vector<NamedConstant> &constants, const Layout &layout);

} // namespace sdre
