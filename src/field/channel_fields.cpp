#include "field/channel_fields.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/block.h"
#include "log/channel.h"

namespace clsurf {
namespace {

constexpr int after_all_rows = 1000;  ///< report_rank of channels

/// Positions and lines are shown in other ways, and time is a separate field.
bool in_reports(const std::string& name) {
    return !name.starts_with("cmd.") && !name.starts_with("fb.") && !name.starts_with("act.") && name != "time" &&
           name != "line" && name != "program";
}

Column<float> values_of(const Channel& channel, PointRange points) {
    Column<float> values(static_cast<std::size_t>(points.size()));
    for_each_block(points.size(), [&](PointIndex first, PointIndex last) {
        std::array<double, 2048> scratch;
        for (PointIndex begin = first; begin < last; begin += 2048) {
            const auto n = static_cast<std::size_t>(std::min<PointIndex>(2048, last - begin));
            copy_block(channel.values, points.first + begin, {scratch.data(), n});
            for (std::size_t i = 0; i < n; ++i)
                values[static_cast<std::size_t>(begin) + i] = static_cast<float>(scratch[i]);
        }
    });
    return values;
}

}  // namespace

ChannelFields::ChannelFields(const Log& log, std::vector<ChannelClasses> classes)
    : channels_(log.channels), classes_(std::move(classes)), keep_alive_(log.keep_alive) {}

FieldInfo ChannelFields::info_of(const Channel& channel) const {
    FieldInfo info{channel.name, "Channel " + channel.name, FieldUnit(channel.unit), FieldScale::sequential, {}};
    if (in_reports(channel.name)) info.report_rank = after_all_rows;
    const auto named = std::find_if(classes_.begin(), classes_.end(),
                                    [&](const ChannelClasses& c) { return c.channel == channel.name; });
    if (named == classes_.end()) return info;
    info.label = named->label;
    info.classes = named->classes;
    info.class_word = named->class_word;
    return info;
}

std::vector<FieldInfo> ChannelFields::fields() const {
    std::vector<FieldInfo> infos;
    for (const Channel& channel : channels_) infos.push_back(info_of(channel));
    return infos;
}

std::vector<Field> ChannelFields::compute(std::span<const std::string_view> names, PointRange points) const {
    std::vector<Field> computed;
    for (const std::string_view name : names) {
        const auto found =
            std::find_if(channels_.begin(), channels_.end(), [&](const Channel& c) { return c.name == name; });
        computed.push_back({info_of(*found), values_of(*found, points)});
    }
    return computed;
}

}  // namespace clsurf
