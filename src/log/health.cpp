#include "log/health.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "log/health_pass.h"
#include "log/health_samples.h"

namespace clsurf {
namespace {

constexpr double period_share = 0.01;  ///< the clock's step may differ from the period by this share
constexpr double moving = 0.01;        ///< [mm] or [deg] least range of a commanded position that moves
constexpr double no_machine = 1e6;     ///< [mm] beyond the travel of any machine

void check_channels(const Log& log, Diagnostics& found) {
    const auto add = [&](Severity severity, const char* text, const char* hint) {
        found.add({severity, "log.missing-channel", Place::of_file(log.name), text, hint});
    };
    const bool measured = log.has(Role::feedback) || log.has(Role::actual);
    if (!log.has(Role::commanded) && !measured) {
        add(Severity::error,
            "neither commanded, feedback nor actual positions have all of x, y and z: nothing can be drawn",
            "name the channels with --mapping or --layout; a log of slow channels is joined to that of a run with clsurf convert --join");
        return;
    }
    if (!log.has(Role::commanded)) add(Severity::note, "no commanded positions (cmd.x, cmd.y, cmd.z)", "");
    if (!measured) add(Severity::note, "no feedback positions: following errors are not known", "");
    if (log.find("line") == nullptr) add(Severity::note, "no channel 'line': lines are found by geometry", "");
}

/// The stated period, or that of the clock if they differ.
double check_period(const Log& log, Diagnostics& found) {
    const double measured = log.measured_period();
    if (measured == 0 || std::abs(measured - log.period) < period_share * log.period) return log.period;
    found.add({Severity::warning,
               "log.period",
               Place::of_file(log.name),
               fmt::format(
                   "the clock steps by {:.6f} s, the stated period is {:.6f} s: speeds are wrong by a factor of {:.4g}",
                   measured, log.period, measured / log.period),
               {}});
    return measured;
}

void check_coarse(const Log& log, double period, Diagnostics& found) {
    if (period <= longest_judged_period) return;
    found.add(
        {Severity::warning, "log.coarse", Place::of_file(log.name),
         fmt::format("a record every {:.4g} ms: marks last some hundredths of a second and do not show", 1e3 * period),
         fmt::format("record every {:g} ms or faster", 1e3 * longest_judged_period)});
}

/// If a layout gives a wrong type or offset, the bytes are positions of any size.
void check_far(const Log& log, const Channel& channel, const ChannelRange& range, Diagnostics& found) {
    constexpr std::array roles{Role::commanded, Role::feedback, Role::actual};
    const bool position = std::any_of(roles.begin(), roles.end(), [&](Role role) {
        return channel.name.starts_with(std::string(prefix_of(role)) + ".");
    });
    const double farthest = std::max(std::abs(range.low), std::abs(range.high));
    if (!position || channel.unit != "mm" || !std::isfinite(farthest) || farthest < no_machine) return;
    found.add({Severity::warning, "log.far", Place::of_file(log.name),
               fmt::format("channel '{}' reaches {:.3g} mm: no machine does", channel.name, farthest),
               "a wrong type, offset, scale or unit in --layout or --mapping?"});
}

void check_ranges(const Log& log, const std::vector<ChannelRange>& ranges, Diagnostics& found) {
    for (std::size_t c = 0; c < ranges.size(); ++c) {
        const Channel& channel = log.channels[c];
        const ChannelRange& range = ranges[c];
        if (range.missing > 0) {
            found.add({Severity::warning,
                       "log.missing-value",
                       Place::of_point(log.name, range.first_missing),
                       fmt::format("channel '{}' has no value at {} of {} points, here for the first time",
                                   channel.name, range.missing, log.records),
                       {}});
        }
        check_far(log, channel, range, found);
        if (range.low != range.high || log.records < 2) continue;
        for (const Role role : {Role::commanded, Role::feedback, Role::actual}) {
            const std::string_view prefix = prefix_of(role);
            if (!channel.name.starts_with(std::string(prefix) + ".")) continue;
            const Channel* commanded =
                log.find(std::string(prefix_of(Role::commanded)) + channel.name.substr(prefix.size()));
            const ChannelRange* given =
                commanded == nullptr ? nullptr : &ranges[static_cast<std::size_t>(commanded - log.channels.data())];
            if (given != nullptr && given->high - given->low > moving) {
                found.add(
                    {Severity::warning,
                     "log.still",
                     Place::of_file(log.name),
                     fmt::format("{} stays at {:g} {} while {} moves over {:.3f} {}: the channel is dead", channel.name,
                                 range.low, channel.unit, commanded->name, given->high - given->low, commanded->unit),
                     {}});
            } else {
                found.add({Severity::note,
                           "log.still",
                           Place::of_file(log.name),
                           fmt::format("axis '{}' does not move: {:g} {} all the time", channel.name, range.low,
                                       channel.unit),
                           {}});
            }
        }
    }
}

}  // namespace

Diagnostics check_health(const Log& log, LineNumber program_lines) {
    Diagnostics found;
    check_channels(log, found);
    if (log.records == 0) {
        found.add({Severity::error, "log.empty", Place::of_file(log.name), "contains no records", {}});
        return found;
    }
    const double period = check_period(log, found);
    const RecordFindings records = check_records(log, period, program_lines);
    found.append(records.diagnostics);
    check_ranges(log, records.ranges, found);
    check_offset(log, found);
    check_quantum(log, found);
    check_coarse(log, period, found);
    check_placeholders(log, found);
    return found;
}

}  // namespace clsurf
