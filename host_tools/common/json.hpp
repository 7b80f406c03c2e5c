// SPDX-License-Identifier: MIT
/// JSON to be written. The templates of the library that does it are compiled in json.cpp only: every unit that used
/// them took seconds.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace sdre {

/// A value; an object keeps the order in which its keys came. Braces make an object of pairs that begin with a text,
/// and an array of anything else.
class Json {
public:
    Json(std::nullptr_t = nullptr);
    Json(bool value);
    Json(double value);
    Json(const char *text);
    Json(std::string text);
    /// Integers of any kind.
    template <class T, std::enable_if_t<std::is_integral_v<T>, int> = 0>
    Json(T value) : Json(Integer{static_cast<long long>(value)})
    {
    }
    template <class T> Json(const std::optional<T> &value) : Json(value ? Json(*value) : Json()) {}
    template <class T> Json(const std::vector<T> &values) : Json(array())
    {
        for (const T &value : values) {
            push_back(value);
        }
    }
    template <class T> Json(const std::map<std::string, T> &values) : Json(object())
    {
        for (const auto &[key, value] : values) {
            (*this)[key] = value;
        }
    }
    Json(std::initializer_list<Json> values);

    // Out of line: a list of values is long enough without them.
    Json(const Json &other);
    Json(Json &&other) noexcept;
    Json &operator=(const Json &other);
    Json &operator=(Json &&other) noexcept;
    ~Json();

    static Json array();
    static Json object();

    /// To an array; null becomes one.
    void push_back(Json value);

    /// The value of an object's key; null becomes an object, and a new key comes last.
    Json &operator[](const std::string &key);

    /// All keys of another object, with its values.
    void update(const Json &other);

    /// Indented, with a line feed at the end.
    std::string text() const;

private:
    friend struct JsonWriter;
    struct Integer {
        long long value;
    };
    explicit Json(Integer integer);

    enum class Kind { null, boolean, integer, number, text, array, object };

    Kind                     kind_    = Kind::null;
    long long                integer_ = 0;
    double                   number_  = 0.0;
    std::string              text_;
    std::vector<std::string> keys_;     ///< of an object, as many as elements
    std::vector<Json>        elements_; ///< of an array or an object
};

} // namespace sdre
