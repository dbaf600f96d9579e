#include "log/turns.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/block.h"
#include "core/column.h"
#include "core/counted.h"
#include "core/units.h"

namespace clsurf {
namespace {

constexpr double end_rounding = 1e-3;  // [deg] of positions at both ends of a turn
constexpr double longest_rest = 90;    // [deg] a larger step per period cannot be distinguished from a wrap
constexpr double still = 0.05;         // [deg] noise of an axis at rest at the wrap
constexpr double longest_wrap = 2;     // largest ratio of a wrap to the steps before and after it

/// The same step in the shorter direction [deg].
double wrapped_step(double step) { return std::remainder(step, deg_per_turn); }

/// Statistics of a channel over some records.
struct TurnSummary {
    double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
    PointIndex wraps = 0, first_wrap = -1;

    void append(const TurnSummary& next) {
        low = std::min(low, next.low);
        high = std::max(high, next.high);
        if (wraps == 0) first_wrap = next.first_wrap;
        wraps += next.wraps;
    }
    [[nodiscard]] bool is_modulo() const { return wraps > 0 && high - low <= deg_per_turn + end_rounding; }
};

bool is_wrap(double last_step, double step, double next_step) {
    const double rest = std::abs(wrapped_step(step));
    if (!(std::abs(step) > deg_per_turn / 2) || !(rest < longest_rest)) return false;
    const double beside = std::max(std::abs(wrapped_step(last_step)), std::abs(wrapped_step(next_step)));
    return rest <= std::max(still, longest_wrap * beside);
}

TurnSummary summarise(const ChannelView& channel, PointIndex first, PointIndex end) {
    const PointIndex begin = std::max<PointIndex>(0, first - 2);
    std::vector<double> values(static_cast<std::size_t>(std::min(channel.count, end + 1) - begin));
    copy_block(channel, begin, values);
    TurnSummary summary;
    const auto step = [&](std::size_t i) { return i > 0 && i < values.size() ? values[i] - values[i - 1] : 0.0; };
    for (auto i = static_cast<std::size_t>(first - begin); i < static_cast<std::size_t>(end - begin); ++i) {
        summary.low = std::min(summary.low, values[i]);
        summary.high = std::max(summary.high, values[i]);
        if (!is_wrap(step(i - 1), step(i), step(i + 1))) continue;
        if (summary.wraps++ == 0) summary.first_wrap = begin + static_cast<PointIndex>(i);
    }
    return summary;
}

/// The channels of one axis in all roles, commanded first.
struct AxisChannels {
    char letter = 'a';
    std::vector<Channel*> channels;
    TurnSummary summary;  ///< of the first channel that wraps
};

std::vector<AxisChannels> rotary_axes(Log& log) {
    std::vector<AxisChannels> axes;
    for (const char letter : {'a', 'b', 'c'}) {
        AxisChannels axis{letter, {}, {}};
        for (const Role role : {Role::commanded, Role::feedback, Role::actual}) {
            const std::string name = fmt::format("{}.{}", prefix_of(role), letter);
            const auto found = std::ranges::find(log.channels, name, &Channel::name);
            if (found != log.channels.end()) axis.channels.push_back(&*found);
        }
        if (!axis.channels.empty()) axes.push_back(std::move(axis));
    }
    return axes;
}

void look_for_wraps(std::vector<AxisChannels>& axes, PointIndex records) {
    std::vector<const ChannelView*> views;
    for (const AxisChannels& axis : axes)
        for (const Channel* channel : axis.channels) views.push_back(&channel->values);
    std::vector<std::vector<TurnSummary>> blocks(static_cast<std::size_t>((records + block_points - 1) / block_points));
    // The channels of a record are adjacent in memory: a block of all of them is read while it is in the cache.
    for_each_block(records, [&](PointIndex first, PointIndex end) {
        for (const ChannelView* view : views)
            blocks[static_cast<std::size_t>(first / block_points)].push_back(summarise(*view, first, end));
    });
    std::size_t view = 0;
    for (AxisChannels& axis : axes) {
        for (std::size_t c = 0; c < axis.channels.size(); ++c, ++view) {
            TurnSummary all;
            for (const std::vector<TurnSummary>& block : blocks) all.append(block[view]);
            if (all.is_modulo() && !axis.summary.is_modulo()) axis.summary = all;
        }
    }
}

/// Unwrapped columns of positions, and the previous owner of the log's data.
struct TurnColumns {
    std::vector<Column<double>> numbers;
    std::vector<Column<std::int64_t>> counts;
    std::shared_ptr<const void> before;

    /// Adds the unwrapped positions of a channel. The first one is within half a turn of `start`; NaN: it is
    /// unchanged.
    ChannelView add(const ChannelView& channel, double start) {
        Column<double> positions(static_cast<std::size_t>(channel.count));
        copy_block(channel, 0, positions);
        double last = start;
        for (double& position : positions) {
            if (!std::isfinite(position)) continue;
            if (std::isfinite(last)) position = last + wrapped_step(position - last);
            last = position;
        }
        const double counts_of_turn = deg_per_turn / channel.scale;
        // Integer counts stay integers: the rounding of positions is determined from them.
        if (channel.type < ScalarType::f32 && std::abs(counts_of_turn - std::round(counts_of_turn)) < 1e-6) {
            Column<std::int64_t>& column = counts.emplace_back(positions.size());
            std::ranges::transform(positions, column.begin(), [&](double position) {
                return static_cast<std::int64_t>(std::llround((position - channel.bias) / channel.scale));
            });
            return view(column.data(), ScalarType::i64, channel, channel.scale, channel.bias);
        }
        return view(numbers.emplace_back(std::move(positions)).data(), ScalarType::f64, channel, 1, 0);
    }

private:
    static ChannelView view(const void* data, ScalarType type, const ChannelView& like, double scale, double bias) {
        return {static_cast<const std::byte*>(data), sizeof(double), like.count, type, false, scale, bias};
    }
};

double first_finite(const ChannelView& channel) {
    for (PointIndex point = 0; point < channel.count; ++point)
        if (std::isfinite(channel.at(point))) return channel.at(point);
    return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

void count_turns_on(Log& log) {
    std::vector<AxisChannels> axes = rotary_axes(log);
    if (axes.empty()) return;
    look_for_wraps(axes, log.records);
    if (std::ranges::none_of(axes, [](const AxisChannels& axis) { return axis.summary.is_modulo(); })) return;
    const auto columns = std::make_shared<TurnColumns>();
    for (const AxisChannels& axis : axes) {
        if (!axis.summary.is_modulo()) continue;
        // If an axis is at rest at the end of a turn, roles may begin at opposite ends of it.
        const double start = first_finite(axis.channels.front()->values);
        for (Channel* channel : axis.channels) channel->values = columns->add(channel->values, start);
        log.diagnostics.add(
            {Severity::note,
             "log.modulo",
             Place::of_point(log.name, axis.summary.first_wrap),
             fmt::format("axis {} counts within one turn and wraps {}, first here: its positions are unwrapped",
                         axis.letter, counted(axis.summary.wraps, "time")),
             {}});
    }
    columns->before = log.keep_alive;
    log.keep_alive = columns;
}

}  // namespace clsurf
