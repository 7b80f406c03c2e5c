// SPDX-License-Identifier: MIT
// The digest decides whether compiled gains belong to a drive: a forgotten key runs another drive's gains.
#include <filesystem>
#include <optional>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/errors.hpp"
#include "drive/drive_file.hpp"
#include "shipped_drive.hpp"
#include "temp_dir.hpp"

namespace {

/// A number of a file, and the file with a little more or less in its place.
struct Change {
    std::string              line;
    std::vector<std::string> texts;
};

Change change_at(const std::string &text, const std::string &line, std::size_t at,
                 const std::string &number)
{
    const bool                whole = number.find_first_of(".e") == std::string::npos;
    const double              old   = std::stod(number);
    Change                    change{line, {}};
    const std::vector<double> others =
        whole ? std::vector<double>{old + 1.0, old - 1.0}
              : std::vector<double>{1.01 * old + 1e-3, 0.99 * old, 1.01 * old};
    for (const double x : others) {
        std::string other = text;
        other.replace(at, number.size(), fmt::format(whole ? "{:.0f}" : "{:.12e}", x));
        change.texts.push_back(other);
    }
    return change;
}

/// All numbers that are values of keys, apart from the schema.
std::vector<Change> changes(const std::string &text)
{
    const std::regex    key(R"((?:^|\n)(?!schema)\w+ *=([^"#\n]*))");
    const std::regex    number(R"(-?\d[\d.]*(?:e[+-]?\d+)?)");
    std::vector<Change> all;
    for (auto k = std::sregex_iterator(text.begin(), text.end(), key); k != std::sregex_iterator();
         ++k) {
        const std::string values = (*k)[1];
        for (auto n = std::sregex_iterator(values.begin(), values.end(), number);
             n != std::sregex_iterator(); ++n) {
            all.push_back(change_at(text, k->str(),
                                    static_cast<std::size_t>(k->position(1) + n->position()),
                                    n->str()));
        }
    }
    return all;
}

/// The digest of the first text whose values are in range.
std::optional<std::string> digest_of(const std::vector<std::string> &texts)
{
    for (const std::string &text : texts) {
        try {
            return sdre::drive_digest(sdre::read_drive_text(text, "changed"));
        } catch (const sdre::InputError &) {
            continue;
        }
    }
    return std::nullopt;
}

/// Without the sections that no table depends on: what is known of the disc and of the shaft. `tune` and the certificate read them.
std::string without_sections_beside(const std::string &text)
{
    std::istringstream lines(text);
    std::string        kept;
    bool               beside   = false;
    const bool         of_shaft = text.find("law = \"noc_shaft\"") != std::string::npos;
    for (std::string line; std::getline(lines, line);) {
        if (line.rfind('[', 0) == 0) {
            beside = line.rfind("[encoder.disc]", 0) == 0 ||
                     (line.rfind("[mechanics]", 0) == 0 && !of_shaft);
        }
        kept += beside ? "" : line + "\n";
    }
    return kept;
}

} // namespace

TEST(DriveDigest, SeesEveryNumberOfEveryShippedDrive)
{
    for (const auto &file :
         std::filesystem::directory_iterator(support::shipped_drive("any").parent_path())) {
        if (file.path().stem() == "ipmsm_390w_paper") {
            continue; // three of its six T do not act
        }
        const std::string text   = without_sections_beside(support::read_file(file.path()));
        const std::string digest = sdre::drive_digest(sdre::read_drive_text(text, "shipped"));
        std::size_t       seen   = 0;
        for (const Change &change : changes(text)) {
            const std::optional<std::string> other = digest_of(change.texts);
            EXPECT_NE(other.value_or(""), digest) << file.path() << change.line;
            seen += other ? 1U : 0U;
        }
        EXPECT_GT(seen, 15U) << file.path();
        EXPECT_GE(seen + 1, changes(text).size()) << file.path(); // noc_h takes one order only
    }
}
