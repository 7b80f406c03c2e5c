// SPDX-License-Identifier: MIT
#include "sil/verify/records_file.hpp"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/errors.hpp"
#include "common/file_output.hpp"

namespace sdre {
namespace {

using nlohmann::json;

Record read_record(const json &values, const std::string &where, int samples)
{
    Record r;
    if (!values.is_array() || values.size() != r.values.size()) {
        throw InputError(where + " values: must be four lists of samples");
    }
    for (std::size_t k = 0; k < r.values.size(); k++) {
        if (!values[k].is_array() || values[k].size() != static_cast<std::size_t>(samples)) {
            throw InputError(fmt::format("{} values[{}]: must be {} samples, as the programme says",
                                         where, k, samples));
        }
        for (const json &x : values[k]) {
            if (!x.is_number() || !std::isfinite(x.get<double>())) {
                throw InputError(
                    fmt::format("{} values[{}]: a sample is no finite number", where, k));
            }
            r.values[k].push_back(x.get<double>());
        }
    }
    return r;
}

const json &member(const json &object, const char *key, const std::string &where)
{
    if (!object.is_object() || !object.contains(key)) {
        throw InputError(fmt::format("{}: {} is missing", where, key));
    }
    return object.at(key);
}

} // namespace

Records read_records_file(const std::filesystem::path &file, const Drive &drive, const Programme &p)
{
    const std::string name = file.string();
    const json        root = json::parse(read_text_file(file), nullptr, false);
    if (root.is_discarded()) {
        throw InputError(name + ": is not JSON");
    }
    const json &digest = member(root, "digest", name);
    if (digest != drive_digest(drive)) {
        throw InputError(fmt::format("{}: digest {} is of another drive file, {} has {}", name,
                                     digest.dump(), drive.name, drive_digest(drive)));
    }
    Records     records;
    const json &fault = member(root, "fault", name);
    if (fault.is_string()) {
        records.fault = fault.get<std::string>();
        return records;
    }
    const json &shots = member(root, "shots", name);
    if (!shots.is_array() || shots.size() != p.shots.size()) {
        throw InputError(
            fmt::format("{}: shots: must be {}, those of the programme", name, p.shots.size()));
    }
    for (std::size_t k = 0; k < p.shots.size(); k++) {
        const std::string where = fmt::format("{}: shots[{}]", name, k);
        records.shots.push_back(read_record(member(shots[k], "values", where), where, p.samples));
    }
    return records;
}

} // namespace sdre
