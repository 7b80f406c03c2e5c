// SPDX-License-Identifier: MIT
#include "common/json.hpp"

#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

namespace sdre {

struct JsonWriter {
    static nlohmann::ordered_json written(const Json &value)
    {
        switch (value.kind_) {
        case Json::Kind::null:
            return nullptr;
        case Json::Kind::boolean:
            return value.integer_ != 0;
        case Json::Kind::integer:
            return value.integer_;
        case Json::Kind::number:
            return value.number_;
        case Json::Kind::text:
            return value.text_;
        case Json::Kind::array:
        case Json::Kind::object:
            break;
        }
        const bool             object = value.kind_ == Json::Kind::object;
        nlohmann::ordered_json out =
            object ? nlohmann::ordered_json::object() : nlohmann::ordered_json::array();
        for (std::size_t i = 0; i < value.elements_.size(); i++) {
            if (object) {
                out[value.keys_[i]] = written(value.elements_[i]);
            } else {
                out.push_back(written(value.elements_[i]));
            }
        }
        return out;
    }

    static bool is_pair(const Json &value)
    {
        return value.kind_ == Json::Kind::array && value.elements_.size() == 2 &&
               value.elements_[0].kind_ == Json::Kind::text;
    }
};

Json::Json(std::nullptr_t) {}
Json::Json(bool value) : kind_(Kind::boolean), integer_(value ? 1 : 0) {}
Json::Json(Integer integer) : kind_(Kind::integer), integer_(integer.value) {}
Json::Json(double value) : kind_(Kind::number), number_(value) {}
Json::Json(const char *text) : kind_(Kind::text), text_(text) {}
Json::Json(std::string text) : kind_(Kind::text), text_(std::move(text)) {}

Json::Json(const Json &other)                = default;
Json::Json(Json &&other) noexcept            = default;
Json &Json::operator=(const Json &other)     = default;
Json &Json::operator=(Json &&other) noexcept = default;
Json::~Json()                                = default;

Json::Json(std::initializer_list<Json> values) : kind_(Kind::array)
{
    if (!std::all_of(values.begin(), values.end(), JsonWriter::is_pair)) {
        elements_ = values;
        return;
    }
    kind_ = Kind::object;
    for (const Json &pair : values) {
        (*this)[pair.elements_[0].text_] = pair.elements_[1];
    }
}

Json Json::array()
{
    Json value;
    value.kind_ = Kind::array;
    return value;
}

Json Json::object()
{
    Json value;
    value.kind_ = Kind::object;
    return value;
}

void Json::push_back(Json value)
{
    kind_ = Kind::array;
    elements_.push_back(std::move(value));
}

Json &Json::operator[](const std::string &key)
{
    kind_            = Kind::object;
    const auto found = std::find(keys_.begin(), keys_.end(), key);
    const auto at    = found - keys_.begin();
    if (found == keys_.end()) {
        keys_.push_back(key);
        elements_.emplace_back();
    }
    return elements_[static_cast<std::size_t>(at)];
}

void Json::update(const Json &other)
{
    for (std::size_t i = 0; i < other.keys_.size(); i++) {
        (*this)[other.keys_[i]] = other.elements_[i];
    }
}

std::string Json::text() const
{
    return JsonWriter::written(*this).dump(2) + "\n";
}

} // namespace sdre
