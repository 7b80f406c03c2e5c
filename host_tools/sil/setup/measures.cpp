// SPDX-License-Identifier: MIT
#include "sil/setup/measures.hpp"

#include <set>

#include <fmt/format.h>

#include "sil/setup/metric_names.hpp"
#include "sil/setup/sorted_times.hpp"

namespace sdre {

namespace {

constexpr Range time_range_s{0.0, 1e4};
constexpr Range duration_range_s{1e-3, 1e4};
constexpr Range band_range_e_radps{1e-9, 1e5};
constexpr Range paper_range{-1e9, 1e9};

std::map<std::string, double> read_paper(TomlReader t)
{
    std::map<std::string, double> paper;
    for (const std::string &key : t.keys()) {
        if (!is_metric_name(key)) {
            t.fail(key, "is not the name of a metric");
        }
        paper[key] = t.number(key, paper_range);
    }
    return paper;
}

/// Published values for the present law: `paper` is for the scenario's own law, `paper_of` names
/// others.
std::map<std::string, double> read_published(TomlReader &entry, Law law, Law own)
{
    std::map<std::string, double> published;
    if (std::optional<TomlReader> paper = entry.table_if("paper")) {
        published = read_paper(*paper);
    }
    if (law != own) {
        published.clear();
    }
    if (std::optional<TomlReader> others = entry.table_if("paper_of")) {
        for (const std::string &name : others->keys()) {
            if (!is_law_name(name) || name == law_name(own)) {
                others->fail(name, "is not the name of another law than the scenario's");
            }
            const std::map<std::string, double> values = read_paper(others->table(name));
            if (name == law_name(law)) {
                published = values;
            }
        }
    }
    return published;
}

} // namespace

std::vector<Measure> read_measures(TomlReader &t, Law law, Law own)
{
    std::vector<Measure>  measures;
    std::set<std::string> names;
    for (TomlReader &entry : t.tables("measure")) {
        Measure m;
        m.name         = entry.text("name");
        m.time_s       = entry.number("time_s", time_range_s);
        m.band_e_radps = entry.number("band_e_radps", band_range_e_radps);
        if (entry.has("tail_s")) {
            m.tail_s = entry.number("tail_s", duration_range_s);
        }
        m.paper = read_published(entry, law, own);
        entry.reject_unknown_keys();
        if (!names.insert(m.name).second) {
            entry.fail("name", fmt::format("= \"{}\" is used twice", m.name));
        }
        measures.push_back(m);
    }
    require_sorted(t, "measure", measures);
    return measures;
}

} // namespace sdre
