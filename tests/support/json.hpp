// SPDX-License-Identifier: MIT
/// JSON to read and to compare. The templates of the parser's library are compiled in json.cpp
/// only. They took half of the compile time of every test that read a number with them.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

namespace support {

class Json {
public:
    enum class Kind { null, boolean, number, text, array, object };

    Json() = default;
    Json(bool value) : kind_(Kind::boolean), number_(value ? 1.0 : 0.0) {}
    Json(int value) : kind_(Kind::number), number_(value) {}
    Json(double value) : kind_(Kind::number), number_(value) {}
    Json(const char *text) : kind_(Kind::text), text_(text) {}
    Json(std::string text) : kind_(Kind::text), text_(std::move(text)) {}
    Json(const std::vector<double> &values)
        : kind_(Kind::array), elements_(values.begin(), values.end())
    {
    }
    Json(const std::vector<std::string> &texts)
        : kind_(Kind::array), elements_(texts.begin(), texts.end())
    {
    }
    static Json array();
    static Json object();

    static Json parse(const std::string &text);
    static Json read(const std::filesystem::path &file);

    bool is_null() const
    {
        return kind_ == Kind::null;
    }
    double              number() const; ///< throws where something else stands, as all of these do
    std::string         text() const;
    std::vector<double> numbers() const;

    const Json &at(const std::string &key) const;
    const Json &at(std::size_t index) const;
    const Json &operator[](const std::string &key) const
    {
        return at(key);
    }
    const Json &operator[](std::size_t index) const
    {
        return at(index);
    }

    /// Elements of an array or an object.
    std::size_t size() const
    {
        return elements_.size() + members_.size();
    }
    /// In the order of their keys.
    const std::vector<std::pair<std::string, Json>> &items() const
    {
        return members_;
    }
    /// The elements of an array; an object has items() only.
    std::vector<Json>::const_iterator begin() const;
    std::vector<Json>::const_iterator end() const;

    void add(Json element)
    {
        elements_.push_back(std::move(element));
    }
    void add(const std::string &key, Json value);

    friend bool operator==(const Json &a, const Json &b);
    friend void PrintTo(const Json &value, std::ostream *stream);

private:
    Kind                                      kind_   = Kind::null;
    double                                    number_ = 0.0; ///< of a boolean too
    std::string                               text_;
    std::vector<Json>                         elements_;
    std::vector<std::pair<std::string, Json>> members_;
};

} // namespace support
