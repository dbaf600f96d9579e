#include "log/channel.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/letter_case.h"
#include "core/units.h"

namespace clsurf {
namespace {

constexpr auto table = std::to_array<ChannelInfo>({
    {"cmd.", "mm", "deg", "commanded axis position after interpolation"},
    {"fb.", "mm", "deg", "feedback axis position, motor encoder"},
    {"act.", "mm", "deg", "actual axis position, linear or ring scale"},
    {"line", "", "", "physical line of the program file, from 1; 0: no block is active"},
    {"program", "", "", "index into the log's list of programs"},
    {"time", "s", "", "time since the first record; default: record number times period"},
    {"speed", "mm/min", "", "path speed as the controller reported it"},
    {"speed.", "mm/min", "deg/min", "speed of an axis as the controller reported it"},
    {"acceleration.", "mm/s²", "deg/s²", "acceleration of an axis as the controller reported it"},
    {"override", "%", "", "feed override"},
    {"spindle.speed", "1/min", "", "spindle speed"},
    {"spindle.load", "%", "", "spindle load"},
    {"current.", "A", "", "drive current of an axis"},
    {"load.", "%", "", "drive load of an axis"},
    {"torque.", "N·m", "", "drive torque of an axis"},
});

/// 1 `unit` is `factor` `normal`.
struct Conversion {
    std::string_view unit, normal;
    double factor;
};

constexpr auto conversions = std::to_array<Conversion>({
    {"mm", "mm", 1.0},
    {"in", "mm", mm_per_inch},
    {"inch", "mm", mm_per_inch},
    {"inches", "mm", mm_per_inch},
    {"cm", "mm", 10.0},
    {"m", "mm", 1e3},
    {"um", "mm", 1e-3},
    {"µm", "mm", 1e-3},     // U+00B5, micro sign
    {"μm", "mm", 1e-3},     // U+03BC, Greek mu
    {"\xb5m", "mm", 1e-3},  // micro sign of ISO 8859-1
    {"nm", "mm", 1e-6},
    {"deg", "deg", 1.0},
    {"°", "deg", 1.0},
    {"rad", "deg", deg_per_rad},
    {"mdeg", "deg", 1e-3},
    {"s", "s", 1.0},
    {"min", "s", seconds_per_minute},
    {"ms", "s", 1e-3},
    {"us", "s", 1e-6},
    {"µs", "s", 1e-6},
    {"μs", "s", 1e-6},
    {"\xb5s", "s", 1e-6},
    {"ns", "s", 1e-9},
    {"mm/min", "mm/min", 1.0},
    {"mm/s", "mm/min", seconds_per_minute},
    {"m/min", "mm/min", 1e3},
    {"in/min", "mm/min", mm_per_inch},
    {"deg/min", "deg/min", 1.0},
    {"deg/s", "deg/min", seconds_per_minute},
    {"rad/s", "deg/min", (deg_per_rad * seconds_per_minute)},
    {"mm/s²", "mm/s²", 1.0},
    {"mm/s^2", "mm/s²", 1.0},
    {"m/s²", "mm/s²", 1e3},
    {"m/s^2", "mm/s²", 1e3},
    {"deg/s²", "deg/s²", 1.0},
    {"rad/s²", "deg/s²", deg_per_rad},
});

/// nullptr if the name is unknown to the project.
const ChannelInfo* info_of(std::string_view name) {
    const auto found = std::find_if(table.begin(), table.end(), [&](const ChannelInfo& info) {
        return info.name.ends_with('.') ? name.size() == info.name.size() + 1 && name.starts_with(info.name)
                                        : name == info.name;
    });
    return found == table.end() ? nullptr : &*found;
}

/// The unit of a channel of that name; empty: its own.
std::string_view unit_of(std::string_view name) {
    const ChannelInfo* info = info_of(name);
    if (info == nullptr) return {};
    const bool rotary =
        name.back() >= 'a' && name.back() <= 'c' && info->name.ends_with('.') && !info->rotary_unit.empty();
    return rotary ? info->rotary_unit : info->unit;
}

void normalise_unit(Log& log, Channel& channel) {
    const std::string_view wanted = unit_of(channel.name);
    if (channel.unit.empty()) {
        channel.unit = std::string(wanted);
        return;
    }
    const auto leads_to = [&](const Conversion& c) { return c.normal == wanted; };
    // For example a current in mA or a load in per mille: not used in computations, shown as recorded.
    if (channel.unit == wanted || std::none_of(conversions.begin(), conversions.end(), leads_to)) return;
    const auto found = std::find_if(conversions.begin(), conversions.end(),
                                    [&](const Conversion& c) { return leads_to(c) && c.unit == channel.unit; });
    if (found == conversions.end()) {
        log.diagnostics.add(
            {Severity::warning,
             "log.unit",
             Place::of_file(log.name),
             fmt::format("channel '{}' has the unit '{}', which is not known: its values are read as {}", channel.name,
                         channel.unit, wanted),
             {}});
        return;
    }
    log.diagnostics.add(
        {Severity::note,
         "log.unit",
         Place::of_file(log.name),
         fmt::format("channel '{}' is recorded in {} and read in {}", channel.name, channel.unit, wanted),
         {}});
    channel.values.scale *= found->factor;
    channel.values.bias *= found->factor;
    channel.unit = std::string(wanted);
}

constexpr std::array<std::string_view, 6> axis_names{"x", "y", "z", "a", "b", "c"};

/// Clocks that do not begin with the first record: a time of day, a time since 1970.
void normalise_time_origin(Log& log, Channel& time) {
    if (log.records == 0) return;
    const double origin = time.values.at(0);
    if (!std::isfinite(origin) || origin == 0) return;
    log.diagnostics.add({Severity::note,
                         "log.time-origin",
                         Place::of_point(log.name, 0),
                         fmt::format("the clock begins at {:.6f} s; time is counted from the first record", origin),
                         {}});
    time.values.bias -= origin;
}

}  // namespace

std::span<const ChannelInfo> known_channels() { return table; }

bool is_known_name(std::string_view name) {
    const std::string low = lower_case(name);
    return info_of(low) != nullptr || std::find(axis_names.begin(), axis_names.end(), low) != axis_names.end();
}

std::string normalised_name(std::string_view name) {
    return is_known_name(name) ? lower_case(name) : std::string(name);
}

bool is_position(std::string_view name) {
    // Only positions are lengths.
    const ChannelInfo* info = info_of(name);
    return info != nullptr && info->unit == "mm";
}

void normalise_names(Log& log) {
    for (Channel& channel : log.channels) {
        const std::string name = normalised_name(channel.name);
        if (log.find(name) == nullptr) channel.name = name;
    }
    if (std::any_of(log.channels.begin(), log.channels.end(), [](const Channel& c) { return is_position(c.name); }))
        return;
    std::string taken;
    for (const std::string_view axis : axis_names) {
        const auto found =
            std::find_if(log.channels.begin(), log.channels.end(), [&](const Channel& c) { return c.name == axis; });
        if (found == log.channels.end()) continue;
        taken += (taken.empty() ? "" : ", ") + found->name;
        found->name = "cmd." + std::string(axis);
    }
    if (taken.empty()) return;
    log.diagnostics.add(
        {Severity::note, "log.roles", Place::of_file(log.name),
         fmt::format("the log does not say whether {} are commanded or measured: they are read as commanded", taken),
         "`--mapping` names them: cmd.x, fb.x, act.x"});
}

void normalise_units(Log& log) {
    for (Channel& channel : log.channels) {
        normalise_unit(log, channel);
        if (channel.name == "time") normalise_time_origin(log, channel);
    }
}

}  // namespace clsurf
