// SPDX-License-Identifier: MIT
#include "design/named_constants.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "design/constants_text.hpp"
#include "design/law_design.hpp"
#include "emit/emit_image.hpp"
#include "shipped_drive.hpp"

extern "C" {
#include "fields_drive.h"
}

namespace {

/// One drive of each law.
const std::vector<sdre::Design> &designs()
{
    static const std::vector<sdre::Design> all = [] {
        std::vector<sdre::Design> found;
        std::set<const law_t *>   laws;
        for (const char *name :
             {"ipmsm_390w", "ipmsm_390w_speed", "ipmsm_390w_noc_h", "ipmsm_390w_conventional",
              "servo_200w_cdobc", "servo_200w_pid", "ipmsm_390w_pi_foc", "ipmsm_390w_ladrc",
              "ipmsm_390w_shaft", "ipmsm_390w_iron"}) {
            found.push_back(
                sdre::design_drive(sdre::read_drive_file(support::shipped_drive(name))));
            laws.insert(found.back().config.law);
        }
        EXPECT_EQ(laws.size(), 10U);
        return found;
    }();
    return all;
}

/// The constants of a design, free to change.
class Copy {
public:
    explicit Copy(const sdre::Design &design)
        : constants_((design.config.law->constants_chars + 7) / 8), config(design.config)
    {
        const auto *from = static_cast<const unsigned char *>(design.config.constants);
        std::copy(from, from + design.config.law->constants_chars,
                  reinterpret_cast<unsigned char *>(constants_.data()));
        config.constants = constants_.data();
    }

    /// Visits both walks.
    void visit(const fields_listener_t &listener)
    {
        fields_t f = fields_told(&listener);
        fields_drive(&f, &config);
        config.law->fields(&f, constants_.data());
    }

private:
    std::vector<double> constants_;

public:
    drive_config_t config;
};

/// Collects the places of all floats.
struct Places {
    std::vector<std::pair<std::string, float *>> found;
    std::vector<std::string>                     open;

    fields_listener_t listener()
    {
        return {this,
                [](void *self, const char *name) {
                    static_cast<Places *>(self)->open.emplace_back(name);
                },
                [](void *self) { static_cast<Places *>(self)->open.pop_back(); },
                [](void *self, const char *name, fields_kind_t kind, const void *x) {
                    static_cast<Places *>(self)->number(name, kind, x);
                }};
    }

    void number(const char *name, fields_kind_t kind, const void *x)
    {
        if (kind != FIELDS_FLOAT) {
            return;
        }
        std::string full;
        for (const std::string &part : open) {
            full += part + ".";
        }
        full += name != nullptr ? name : "";
        found.emplace_back(full, const_cast<float *>(static_cast<const float *>(x)));
    }
};

} // namespace

/// Zeros are left out: terms beyond a series' order and gains of a position that the drive does not have.
TEST(Constants, NoneThatIsNotFiniteIsAccepted)
{
    const std::vector<float> bad{std::numeric_limits<float>::quiet_NaN(),
                                 std::numeric_limits<float>::infinity(),
                                 -std::numeric_limits<float>::infinity(), 1e30F, -1e30F};
    for (const sdre::Design &design : designs()) {
        Copy   copy(design);
        Places places;
        copy.visit(places.listener());
        ASSERT_EQ(drive_config_check(&copy.config), CTL_OK) << design.drive.name;
        std::set<std::string> accepted;
        for (const auto &[name, place] : places.found) {
            const float kept = *place;
            for (const float x : kept == 0.0F ? std::vector<float>{} : bad) {
                *place = x;
                if (drive_config_check(&copy.config) == CTL_OK) {
                    accepted.insert(name);
                }
            }
            *place = kept;
        }
        std::string all;
        for (const std::string &name : accepted) {
            all += name + " ";
        }
        EXPECT_EQ(all, "") << design.drive.name;
    }
}

TEST(Constants, ListNamesEveryWordOfTheImageAfterItsTexts)
{
    for (const sdre::Design &design : designs()) {
        const std::vector<std::uint16_t> words = sdre::image_words(design);
        std::istringstream               text(sdre::image_list(design));
        std::vector<std::size_t>         at;
        std::vector<double>              values;
        std::set<std::string>            names;
        std::string                      name;
        for (std::size_t word = 0; text >> word >> name >> values.emplace_back();) {
            at.push_back(word);
            EXPECT_TRUE(names.insert(name).second) << name;
        }
        ASSERT_FALSE(at.empty());
        EXPECT_EQ(at.front(), 42U); // drive_image.h
        at.push_back(words.size());
        for (std::size_t n = 0; n + 1 < at.size(); n++) {
            const std::size_t width = at[n + 1] - at[n];
            ASSERT_TRUE(width == 1 || width == 2) << at[n];
            if (width == 1) {
                const auto word = words[at[n]];
                EXPECT_TRUE(values[n] == word || values[n] == static_cast<std::int16_t>(word));
            } else {
                const std::uint32_t bits   = std::uint32_t{words[at[n]]} << 16U | words[at[n] + 1];
                float               number = 0.0F;
                std::memcpy(&number, &bits, sizeof number);
                EXPECT_TRUE(values[n] == bits || static_cast<float>(values[n]) == number) << at[n];
            }
        }
    }
}

TEST(Constants, TextTakesNamesAndKindsFromTheWalk)
{
    using Kind = sdre::NamedConstant::Kind;
    const std::vector<sdre::NamedConstant> constants{
        {"count", Kind::u16, 7.0, {}},
        {"cycles", Kind::u32, 30000.0, {}},
        {"order", Kind::i16, -2.0, {}},
        {"exact", Kind::flag, 1.0, {}},
        {"part",
         Kind::parts,
         0.0,
         {{"gain", Kind::number, 0.5, {}},
          {"row", Kind::parts, 0.0, {{"", Kind::number, 1.0, {}}}}}},
        {"other", Kind::number, 1.0, {}}};

    EXPECT_EQ(sdre::constants_text(constants, {{"other", ""}}),
              ".count = 7U,\n.cycles = 30000UL,\n.order = -2,\n.exact = true,\n.part = {\n"
              "    .gain = 5.00000000e-01f,\n    .row = {  1.00000000e+00f },\n},\n");
    EXPECT_EQ(
        sdre::constants_text({constants[4]}, {{"part.gain", ".gain = 2,\n"}, {"part.row", ""}}),
        ".part = {\n    .gain = 2,\n},\n");
}
