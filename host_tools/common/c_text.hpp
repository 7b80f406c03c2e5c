// SPDX-License-Identifier: MIT
/// Pieces of C initialisers; every float has nine digits, which round-trip single precision.
#pragma once

#include <string>
#include <vector>

namespace sdre {

/// "1.25000000e+00f"
std::string c_number(float x);

/// ".name = value,\n"
std::string c_field(const std::string &name, float value);
std::string c_field(const std::string &name, int value);
std::string c_field(const std::string &name, const std::string &value);

/// "{ 1.0e+00f, .. }", numbers in columns of sixteen.
std::string c_list(const float *values, int count);

/// "/* label */ { .. },\n"
std::string c_row(const std::string &label, const float *values, int count);

/// ".name = {\n", the text four columns further, "},\n"
std::string c_block(const std::string &name, const std::string &text);

/// Every line of the text four columns further.
std::string c_indented(const std::string &text);

/// "static const type name = {\n", the text, "};\n\n"
std::string c_object(const std::string &type, const std::string &name, const std::string &text);

} // namespace sdre
