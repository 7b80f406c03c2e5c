// SPDX-License-Identifier: MIT
#include "design/constants_text.hpp"

#include <fmt/format.h>

#include "common/c_text.hpp"

namespace sdre {
namespace {

using Kind = NamedConstant::Kind;

std::string value_text(const NamedConstant &c)
{
    switch (c.kind) {
    case Kind::u16:
        return fmt::format("{:.0f}U", c.value);
    case Kind::i16:
        return fmt::format("{:.0f}", c.value);
    case Kind::u32:
        return fmt::format("{:.0f}UL", c.value);
    case Kind::flag:
        return c.value != 0.0 ? "true" : "false";
    case Kind::number:
    case Kind::parts:
        break;
    }
    return c_number(single(c.value));
}

std::string array_text(const NamedConstant &c)
{
    std::vector<float> values;
    for (const NamedConstant &part : c.parts) {
        values.push_back(single(part.value));
    }
    return c_field(c.name, c_list(values.data(), static_cast<int>(values.size())));
}

std::string text(const std::vector<NamedConstant> &constants, const Layout &layout,
                 const std::string &before)
{
    std::string s;
    for (const NamedConstant &c : constants) {
        const std::string name  = before + c.name;
        const auto        other = layout.find(name);
        if (other != layout.end()) {
            s += other->second;
        } else if (c.kind != Kind::parts) {
            s += c_field(c.name, value_text(c));
        } else {
            s += c.is_array() ? array_text(c) : c_block(c.name, text(c.parts, layout, name + "."));
        }
    }
    return s;
}

} // namespace

std::string constants_text(const std::vector<NamedConstant> &constants, const Layout &layout)
{
    return text(constants, layout, "");
}

} // namespace sdre
