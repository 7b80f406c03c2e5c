// SPDX-License-Identifier: MIT
#include "design/named_constants.hpp"

#include <cstdint>
#include <cstring>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>

extern "C" {
#include "fields_drive.h"
}

namespace sdre {
namespace {

using Kind = NamedConstant::Kind;

/// Collects what a walk tells.
class Listener {
public:
    Listener()
    {
        open_.emplace_back();
    }

    fields_t walk()
    {
        return fields_told(&callbacks_);
    }

    std::vector<NamedConstant> found() const
    {
        return open_.front().parts;
    }

private:
    static void begin(void *self, const char *name)
    {
        const bool element = name[std::strlen(name) - 1] == ']'; // such as "pair[i]"
        static_cast<Listener *>(self)->open_.push_back({element ? "" : name, Kind::parts, 0.0, {}});
    }

    static void end(void *self)
    {
        std::vector<NamedConstant> &open = static_cast<Listener *>(self)->open_;
        NamedConstant               done = std::move(open.back());
        open.pop_back();
        open.back().parts.push_back(std::move(done));
    }

    static void number(void *self, const char *name, fields_kind_t kind, const void *x)
    {
        NamedConstant c{name != nullptr ? name : "", Kind::number, 0.0, {}};
        switch (kind) {
        case FIELDS_U16:
            c.kind  = Kind::u16;
            c.value = *static_cast<const std::uint16_t *>(x);
            break;
        case FIELDS_I16:
            c.kind  = Kind::i16;
            c.value = *static_cast<const std::int16_t *>(x);
            break;
        case FIELDS_U32:
            c.kind  = Kind::u32;
            c.value = *static_cast<const std::uint32_t *>(x);
            break;
        case FIELDS_FLAG:
            c.kind  = Kind::flag;
            c.value = *static_cast<const bool *>(x) ? 1.0 : 0.0;
            break;
        case FIELDS_FLOAT:
            c.value = static_cast<double>(*static_cast<const float *>(x));
            break;
        }
        static_cast<Listener *>(self)->open_.back().parts.push_back(std::move(c));
    }

    fields_listener_t          callbacks_{this, begin, end, number};
    std::vector<NamedConstant> open_; // from the whole to the innermost structure
};

int words_of(Kind kind)
{
    return kind == Kind::u32 || kind == Kind::number ? 2 : 1;
}

void list(std::string &s, int &word, const std::string &before,
          const std::vector<NamedConstant> &constants)
{
    for (std::size_t n = 0; n < constants.size(); n++) {
        const NamedConstant &c    = constants[n];
        const std::string    name = before + (c.name.empty() ? fmt::format("[{}]", n) : c.name);
        if (c.kind == Kind::parts) {
            list(s, word, c.is_array() ? name : name + ".", c.parts);
        } else {
            s += fmt::format("{} {} {:.9g}\n", word, name, c.value);
            word += words_of(c.kind);
        }
    }
}

} // namespace

bool NamedConstant::is_array() const
{
    return !parts.empty() && parts.front().name.empty();
}

std::vector<NamedConstant> named_constants(const std::function<void(fields_t &)> &walk)
{
    Listener listener;
    fields_t f = listener.walk();
    walk(f);
    return listener.found();
}

std::vector<NamedConstant> law_constants(const drive_config_t &config)
{
    if (config.law->fields == nullptr) {
        throw std::logic_error("a law without a walk over its constants");
    }
    // A walk may write what it read, and a table is constant.
    const auto words = (config.law->constants_chars + sizeof(double) - 1) / sizeof(double);
    const auto copy  = std::make_unique<double[]>(words);
    std::memcpy(copy.get(), config.constants, config.law->constants_chars);
    return named_constants([&](fields_t &f) { config.law->fields(&f, copy.get()); });
}

std::vector<NamedConstant> drive_constants(const drive_config_t &config)
{
    drive_config_t copy = config;
    return named_constants([&](fields_t &f) { fields_drive(&f, &copy); });
}

std::string constants_list(const std::vector<NamedConstant> &constants, int word)
{
    std::string s;
    list(s, word, "", constants);
    return s;
}

} // namespace sdre
