// SPDX-License-Identifier: MIT
#include "sil/verify/detections.hpp"

#include <fmt/format.h>

#include "common/parallel.hpp"

namespace sdre {
namespace {

constexpr std::size_t   unchanged  = believed_count;
constexpr double        changed_by = 2.0;
constexpr int           more       = 10;
constexpr std::uint64_t first_seed = 1000000; // beyond those of any expectation

/// A value and where it goes.
struct Change {
    std::size_t value;
    double      by;
};

std::vector<Change> changes()
{
    std::vector<Change> all{{unchanged, 0.0}};
    for (std::size_t k = 0; k < believed_count; k++) {
        all.push_back({k, changed_by});
        if (k != static_cast<std::size_t>(Believed::friction)) {
            all.push_back({k, -changed_by});
        }
    }
    return all;
}

std::string name_of(const Change &c)
{
    return c.value == unchanged
               ? "none"
               : fmt::format("{} {}", believed_name(static_cast<Believed>(c.value)),
                             c.by > 0.0 ? "+" : "-");
}

} // namespace

std::vector<Detection> run_detections(const Drive &d, const Programme &p, int machines,
                                      const RehearsalCounts &counts)
{
    const Expectation      expectation(d, p, counts);
    const Controller       controller = controller_of(d);
    std::vector<Detection> detections;
    std::uint64_t          seed = first_seed;
    for (const Change &change : changes()) {
        const int              count = change.value == unchanged ? more * machines : machines;
        std::vector<Judgement> judged(static_cast<std::size_t>(count));
        parallel_for(judged.size(), [&](std::size_t k) {
            Difference x = draw_difference(seed + k);
            if (change.value != unchanged) {
                x[change.value] = change.by;
            }
            judged[k] =
                expectation.judge(rehearse(machine_on_bench(d, x, seed + k), controller, p));
        });
        seed += judged.size();
        Detection t{name_of(change), count};
        for (const Judgement &j : judged) {
            t.outside += j.within() ? 0 : 1;
            t.tripped += j.fault ? 1 : 0;
            t.named += !j.within() && !j.fault && j.cause == change.value ? 1 : 0;
        }
        detections.push_back(t);
    }
    return detections;
}

std::string detections_text(const Drive &d, const std::vector<Detection> &detections)
{
    std::string text = fmt::format("{}: one value changed by twice its uncertainty\n{:<18}{:>10}"
                                   "{:>10}{:>10}{:>10}\n",
                                   d.name, "change", "machines", "outside", "named", "tripped");
    for (const Detection &t : detections) {
        text += fmt::format("{:<18}{:>10}{:>10}{:>10}{:>10}\n", t.what, t.machines, t.outside,
                            t.named, t.tripped);
    }
    return text;
}

} // namespace sdre
