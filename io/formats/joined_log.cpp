#include "io/formats/joined_log.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.h"
#include "io/files/json_value.h"
#include "io/formats/clock_time.h"
#include "io/formats/owned_columns.h"
#include "log/held_values.h"

namespace clsurf::io {
namespace {

constexpr double held_periods = 3;

/// The recording time that a log states; nothing without a date.
std::optional<ClockTime> recorded(const Log& log) {
    if (log.metadata.empty()) return std::nullopt;
    const Json json = parse_bounded(log.metadata);
    if (!json.is_object() || !json.contains("recorded") || !json["recorded"].is_string()) return std::nullopt;
    const std::optional<ClockTime> time = parse_clock(json["recorded"].get<std::string>());
    return time && time->day ? time : std::nullopt;
}

double offset_of(const Log& log, const Log& slow) {
    const std::optional<ClockTime> first = recorded(log), slow_first = recorded(slow);
    for (const auto& [name, time] : {std::pair{&log.name, &first}, std::pair{&slow.name, &slow_first}}) {
        if (!*time)
            throw UsageError(*name + " does not say when it was recorded",
                             "--join-offset S: the time in " + slow.name + " at which " + log.name + " begins");
    }
    return first->since(*slow_first->day) - slow_first->second;
}

}  // namespace

Diagnostics join_log(Log& log, const Log& slow, const JoinRules& rules) {
    const HoldRule rule{rules.offset ? *rules.offset : offset_of(log, slow),
                        rules.age.value_or(held_periods * slow.period)};
    Diagnostics found;
    OwnedColumns columns(log);
    bool any = false, overlaps = false;
    for (const Channel& channel : slow.channels) {
        if (channel.name == "time") continue;
        if (log.find(channel.name) != nullptr) {
            throw InputError(Place::of_file(slow.name),
                             fmt::format("channel '{}' is in {}, too", channel.name, log.name));
        }
        any = true;
        std::vector<double> values = held_values(slow, channel, log, rule);
        const auto missing = std::count_if(values.begin(), values.end(), [](double v) { return std::isnan(v); });
        overlaps = overlaps || missing < log.records;
        if (missing > 0) {
            found.add({Severity::warning,
                       "join.gap",
                       Place::of_file(slow.name),
                       fmt::format("channel '{}' has no value within {:g} s before {} of {} records", channel.name,
                                   rule.age, missing, log.records),
                       {}});
        }
        columns.add(channel.name, channel.unit, std::move(values));
    }
    if (!any) throw InputError(Place::of_file(slow.name), "has no channel but 'time'");
    if (!overlaps) {
        throw InputError(
            Place::of_file(slow.name),
            fmt::format("has no value at any time of {}, which begins {:.3f} s after it and lasts {:.3f} s", log.name,
                        rule.offset, log.records > 0 ? log.time_of(log.records - 1) : 0.0),
            "--join-offset S: the time in " + slow.name + " at which " + log.name + " begins");
    }
    return found;
}

}  // namespace clsurf::io
