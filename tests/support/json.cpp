// SPDX-License-Identifier: MIT
#include "json.hpp"

#include <ostream>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "temp_dir.hpp"

namespace support {

namespace {

Json converted(const nlohmann::json &value)
{
    if (value.is_null()) {
        return {};
    }
    if (value.is_boolean()) {
        return value.get<bool>();
    }
    if (value.is_number()) {
        return value.get<double>();
    }
    if (value.is_string()) {
        return value.get<std::string>();
    }
    Json result = value.is_array() ? Json::array() : Json::object();
    for (const auto &[key, part] : value.items()) {
        if (value.is_array()) {
            result.add(converted(part));
        } else {
            result.add(key, converted(part));
        }
    }
    return result;
}

void expect(bool right, const std::string &what)
{
    if (!right) {
        throw std::runtime_error("JSON: not " + what);
    }
}

} // namespace

Json Json::array()
{
    Json result;
    result.kind_ = Kind::array;
    return result;
}

Json Json::object()
{
    Json result;
    result.kind_ = Kind::object;
    return result;
}

Json Json::parse(const std::string &text)
{
    return converted(nlohmann::json::parse(text));
}

Json Json::read(const std::filesystem::path &file)
{
    return parse(read_file(file));
}

double Json::number() const
{
    expect(kind_ == Kind::number, "a number");
    return number_;
}

std::string Json::text() const
{
    expect(kind_ == Kind::text, "a text");
    return text_;
}

std::vector<double> Json::numbers() const
{
    expect(kind_ == Kind::array, "an array");
    std::vector<double> values;
    for (const Json &element : elements_) {
        values.push_back(element.number());
    }
    return values;
}

const Json &Json::at(const std::string &key) const
{
    for (const auto &[name, value] : members_) {
        if (name == key) {
            return value;
        }
    }
    throw std::runtime_error("JSON: no key " + key);
}

const Json &Json::at(std::size_t index) const
{
    return elements_.at(index);
}

std::vector<Json>::const_iterator Json::begin() const
{
    expect(kind_ == Kind::array, "an array");
    return elements_.begin();
}

std::vector<Json>::const_iterator Json::end() const
{
    expect(kind_ == Kind::array, "an array");
    return elements_.end();
}

void Json::add(const std::string &key, Json value)
{
    members_.emplace_back(key, std::move(value));
}

bool operator==(const Json &a, const Json &b)
{
    return a.kind_ == b.kind_ && a.number_ == b.number_ && a.text_ == b.text_ &&
           a.elements_ == b.elements_ && a.members_ == b.members_;
}

/// For GoogleTest.
void PrintTo(const Json &value, std::ostream *stream)
{
    switch (value.kind_) {
    case Json::Kind::null:
        *stream << "null";
        break;
    case Json::Kind::boolean:
        *stream << (value.number_ != 0.0 ? "true" : "false");
        break;
    case Json::Kind::number:
        stream->precision(17);
        *stream << value.number_;
        break;
    case Json::Kind::text:
        *stream << '"' << value.text_ << '"';
        break;
    case Json::Kind::array:
    case Json::Kind::object:
        *stream << value.size() << " parts:";
        for (const Json &element : value.elements_) {
            PrintTo(element, &(*stream << ' '));
        }
        for (const auto &[key, part] : value.members_) {
            PrintTo(part, &(*stream << ' ' << key << ": "));
        }
        break;
    }
}

} // namespace support
