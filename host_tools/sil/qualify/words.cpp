// SPDX-License-Identifier: MIT
#include "sil/qualify/words.hpp"

#include <fmt/format.h>

namespace sdre {
namespace {

std::string share_words(const char *what, const MotorShare &m)
{
    return m.count == 0 ? ""
                        : fmt::format("{}: {} of {} good, {:.1f} %", what, m.good, m.count,
                                      100.0 * m.share());
}

} // namespace

std::string settling_words(const TrialResult &r)
{
    return r.settling_time_s ? fmt::format("{:.2f}", 1e3 * *r.settling_time_s) : "never";
}

std::string verdict_words(const TrialResult &r)
{
    return !r.reasons.empty() ? fmt::format("{}", fmt::join(r.reasons, ", "))
           : r.faults > 0     ? "good, trips"
                              : "good";
}

std::string motors_words(const Qualification &q)
{
    return share_words("R, L, flux +-30 %, J x0.5 .. 2", q.motors);
}

std::string wide_motors_words(const Qualification &q)
{
    return share_words("R, L, flux +-50 %, J x0.5 .. 3 (for information)", q.wide);
}

} // namespace sdre
