// SPDX-License-Identifier: MIT
#include "common/c_text.hpp"

#include <fmt/format.h>

namespace sdre {

std::string c_number(float x)
{
    return fmt::format("{:.8e}f", static_cast<double>(x));
}

std::string c_field(const std::string &name, const std::string &value)
{
    return fmt::format(".{} = {},\n", name, value);
}

std::string c_field(const std::string &name, float value)
{
    return c_field(name, c_number(value));
}

std::string c_field(const std::string &name, int value)
{
    return c_field(name, std::to_string(value));
}

std::string c_list(const float *values, int count)
{
    std::string s = "{";
    for (int i = 0; i < count; i++) {
        s += fmt::format("{}{:>16}", i == 0 ? " " : ", ", c_number(values[i]));
    }
    return s + " }";
}

std::string c_row(const std::string &label, const float *values, int count)
{
    return fmt::format("/* {:<5} */ {},\n", label, c_list(values, count));
}

std::string c_indented(const std::string &text)
{
    std::string s;
    bool        line_begins = true;
    for (const char c : text) {
        s += line_begins && c != '\n' ? "    " : "";
        s += c;
        line_begins = c == '\n';
    }
    return s;
}

std::string c_block(const std::string &name, const std::string &text)
{
    return "." + name + " = {\n" + c_indented(text) + "},\n";
}

std::string c_object(const std::string &type, const std::string &name, const std::string &text)
{
    return "static const " + type + " " + name + " = {\n" + c_indented(text) + "};\n\n";
}

} // namespace sdre
