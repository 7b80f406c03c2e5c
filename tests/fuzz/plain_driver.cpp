// SPDX-License-Identifier: MIT
/// Inputs without libFuzzer: the seeds as they are, then changed at random, the same way every time.
///
///     fuzz_NAME [-runs=N] [-max_total_time=SECONDS] FILE_OR_DIRECTORY..
///
/// An input that ends the program is left in the working directory as crash-NAME. The options are libFuzzer's.
#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size);

namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest = 8192; // of an input

std::string crash_name;
std::string input;

/// Words that break readers of numbers and of structure.
const std::array<std::string, 24> words  = {"nan",
                                            "-inf",
                                            "1e309",
                                            "-1e-320",
                                            "0",
                                            "-0.0",
                                            "99999999999999999999",
                                            "-9223372036854775808",
                                            "true",
                                            "\"\"",
                                            "[",
                                            "]",
                                            "{",
                                            "}",
                                            "[[",
                                            "]]",
                                            "=",
                                            "\"",
                                            "\n",
                                            "\0",
                                            "#",
                                            "\\u0000",
                                            "1_0",
                                            "1979-05-27"};
const std::array<std::string, 8>  floats = {
     std::string("\x7F\xC0\0\0", 4), std::string("\xFF\xC0\0\0", 4),
     std::string("\x7F\x80\0\0", 4), std::string("\xFF\x80\0\0", 4),
     std::string("\0\0\0\1", 4),     std::string("\x7F\x7F\xFF\xFF", 4),
     std::string("\x80\0\0\0", 4),   std::string("\x41\0\0\0", 4)};

class Changer {
public:
    /// A seed after one to eight changes.
    std::string changed(const std::vector<std::string> &seeds)
    {
        std::string s = seeds[below(seeds.size())];
        for (std::size_t n = 1 + below(8); n > 0; n--) {
            change(s, seeds);
        }
        s.resize(std::min(s.size(), longest));
        return s;
    }

private:
    std::size_t below(std::size_t n)
    {
        return n == 0 ? 0 : static_cast<std::size_t>(random_() % n);
    }
    void change(std::string &s, const std::vector<std::string> &seeds)
    {
        const std::size_t at     = below(s.size() + 1);
        const std::size_t length = std::min(1 + below(16), s.size() - at);
        switch (below(9)) {
        case 0:
            s.insert(at, 1, static_cast<char>(random_()));
            break;
        case 1:
            s.erase(at, length);
            break;
        case 2:
            s.insert(at, s.substr(below(s.size()), 1 + below(64)));
            break;
        case 3:
            s.replace(at, length, words[below(words.size())]);
            break;
        case 4:
            s.replace(at, std::min<std::size_t>(4, s.size() - at), floats[below(floats.size())]);
            break;
        case 5:
            number(s, at);
            break;
        case 6: {
            const std::string &other = seeds[below(seeds.size())];
            s.insert(at, other.substr(below(other.size() + 1), 1 + below(200)));
            break;
        }
        default:
            if (at < s.size()) {
                s[at] = static_cast<char>(s[at] ^ (1 << below(8)));
            }
        }
    }
    /// The next number of a text becomes something else.
    void number(std::string &s, std::size_t at)
    {
        const std::size_t begin = s.find_first_of("0123456789", at);
        if (begin != std::string::npos) {
            const std::size_t end = s.find_first_not_of("0123456789.eE+-", begin);
            s.replace(begin, std::min(end, s.size()) - begin, words[below(words.size())]);
        }
    }

    std::mt19937_64 random_{1}; // its numbers are the same everywhere
};

/// A seed, or all below a directory.
void add(std::vector<std::string> &seeds, const fs::path &path)
{
    std::vector<fs::path> files = {path};
    if (fs::is_directory(path)) {
        files.assign(fs::recursive_directory_iterator(path), fs::recursive_directory_iterator{});
        files.erase(std::remove_if(files.begin(), files.end(),
                                   [](const fs::path &file) { return fs::is_directory(file); }),
                    files.end());
        std::sort(files.begin(), files.end()); // the same order everywhere
    }
    for (const fs::path &file : files) {
        std::ifstream stream(file, std::ios::binary);
        seeds.emplace_back(std::istreambuf_iterator<char>(stream),
                           std::istreambuf_iterator<char>());
    }
}

void keep_input()
{
    std::ofstream(crash_name, std::ios::binary) << input;
}

void run(const std::string &bytes)
{
    input = bytes;
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t *>(input.data()), input.size());
}

} // namespace

// Callback of the sanitizers: called before they end the program.
extern "C" void __sanitizer_set_death_callback(void (*callback)()) __attribute__((weak));

int main(int argc, char **argv)
{
    using Clock = std::chrono::steady_clock;
    std::vector<std::string> seeds;
    long                     runs    = 1000;
    long                     seconds = 0;
    crash_name                       = "crash-" + fs::path(argv[0]).filename().string();
    for (int i = 1; i < argc; i++) {
        const std::string argument = argv[i];
        if (argument.rfind("-runs=", 0) == 0) {
            runs = std::atol(argument.c_str() + 6);
        } else if (argument.rfind("-max_total_time=", 0) == 0) {
            seconds = std::atol(argument.c_str() + 16);
            runs    = std::numeric_limits<long>::max();
        } else if (argument[0] != '-') {
            add(seeds, argument);
        }
    }
    std::signal(SIGABRT, [](int) { keep_input(); });
    if (__sanitizer_set_death_callback != nullptr) {
        __sanitizer_set_death_callback(keep_input);
    }
    for (const std::string &seed : seeds) {
        run(seed);
    }
    Changer    changer;
    const auto start = Clock::now();
    long       n     = 0;
    while (n < runs && (seconds == 0 || Clock::now() - start < std::chrono::seconds(seconds))) {
        run(changer.changed(seeds));
        n++;
    }
    fmt::print("{} seeds, {} changed: none ended the program\n", seeds.size(), n);
    return 0;
}
