// SPDX-License-Identifier: MIT
#include "common/toml_depth.hpp"

#include <algorithm>
#include <vector>

namespace sdre {
namespace {

/// Behind the string that begins here; one on a single line ends with the line.
std::size_t after_string(const std::string &text, std::size_t at)
{
    const char        quote = text[at];
    const std::string three(3, quote);
    const bool        many = text.compare(at, 3, three) == 0;
    for (std::size_t i = at + (many ? 3 : 1); i < text.size(); i++) {
        if (quote == '"' && text[i] == '\\') {
            i++;
        } else if (many && text.compare(i, 3, three) == 0) {
            const std::size_t end = text.find_first_not_of(quote, i);
            return std::min({end, i + 5, text.size()}); // two more may belong to the text
        } else if (!many && (text[i] == quote || text[i] == '\n')) {
            return i + (text[i] == quote ? 1 : 0);
        }
    }
    return text.size();
}

std::size_t end_of_line(const std::string &text, std::size_t at)
{
    return std::min(text.find('\n', at), text.size());
}

/// Each open bracket keeps the depth of the key before it.
class Nesting {
public:
    void see(char c)
    {
        if (c == '.') {
            depth_++;
        } else if (c == '[' || c == '{') {
            open_.push_back(++depth_);
        } else if ((c == ']' || c == '}') && open_.size() > 1) {
            open_.pop_back();
        } else if (c == ',' || c == '\n') {
            depth_ = open_.back();
        }
    }

    int depth() const
    {
        return depth_;
    }

private:
    std::vector<int> open_{0};
    int              depth_ = 0;
};

} // namespace

long too_deep_line(const std::string &text)
{
    Nesting nesting;
    for (std::size_t at = 0; at < text.size();) {
        const char c = text[at];
        if (c == '"' || c == '\'') {
            at = after_string(text, at);
            continue;
        }
        if (c == '#') {
            at = end_of_line(text, at);
            continue;
        }
        nesting.see(c);
        if (nesting.depth() > toml_depth_max) {
            return 1 + std::count(text.begin(), text.begin() + static_cast<long>(at), '\n');
        }
        at++;
    }
    return 0;
}

} // namespace sdre
