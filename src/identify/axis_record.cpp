#include "identify/axis_record.h"

#include <algorithm>
#include <cmath>

#include "core/block.h"
#include "log/jump_rule.h"

namespace clsurf {
namespace {

constexpr double gap = 1.5;               ///< periods: records this far apart are not consecutive
constexpr PointIndex piece_size = 32768;  ///< records of a piece

/// Marks the jumps of a channel. `at(i)`: the value of a record.
template <typename At>
void mark_jumps(PointIndex first, std::span<char> joined, PointIndex records, double period, At&& at) {
    const double limit = longest_step(period);
    const auto step = [&](PointIndex i) { return i > 0 && i < records ? at(i) - at(i - 1) : 0.0; };
    for (std::size_t k = 0; k < joined.size(); ++k) {
        const PointIndex i = first + static_cast<PointIndex>(k);
        const double here = step(i);
        if (!(std::abs(here) > limit)) continue;
        const double length = std::abs(here), next = step(i + 1);
        const bool spike = comes_back(here * next, length, std::abs(next));
        if (is_jump(std::abs(step(i - 1)), length, std::abs(next), spike)) joined[k] = 0;
    }
}

}  // namespace

std::vector<PointRange> find_sections(const Log& log, std::span<const ChannelView> channels) {
    std::vector<PointRange> sections;
    const Channel* time = log.find("time");
    std::vector<double> values(static_cast<std::size_t>(block_points));
    std::vector<char> usable(static_cast<std::size_t>(block_points)), joined(static_cast<std::size_t>(block_points));
    double last_time = -INFINITY;
    bool open = false;
    for (PointIndex first = 0; first < log.records; first += block_points) {
        const auto n = static_cast<std::size_t>(std::min(block_points, log.records - first));
        const std::span<double> block(values.data(), n);
        std::fill_n(usable.begin(), n, 1);
        std::fill_n(joined.begin(), n, 1);
        for (const ChannelView& channel : channels) {
            copy_block(channel, first, block);
            for (std::size_t i = 0; i < n; ++i) usable[i] &= static_cast<char>(std::isfinite(block[i]));
            mark_jumps(first, std::span(joined.data(), n), log.records, log.period, [&](PointIndex i) {
                const PointIndex k = i - first;
                return k >= 0 && k < static_cast<PointIndex>(n) ? block[static_cast<std::size_t>(k)] : channel.at(i);
            });
        }
        if (time != nullptr) {
            copy_block(time->values, first, block);
            for (std::size_t i = 0; i < n; ++i) {
                const double step = block[i] - last_time;
                joined[i] &= static_cast<char>(step > 0 && step < gap * log.period);
                last_time = block[i];
            }
        }
        for (std::size_t i = 0; i < n; ++i) {
            const PointIndex point = first + static_cast<PointIndex>(i);
            if (usable[i] != 0 && (!open || joined[i] == 0)) sections.push_back({point, point});
            open = usable[i] != 0;
            if (open) sections.back().last = point;
        }
    }
    return sections;
}

std::vector<PointRange> sample_pieces(std::span<const PointRange> sections, PointIndex most) {
    std::vector<PointRange> pieces;
    PointIndex total = 0;
    for (const PointRange& section : sections) {
        total += section.size();
        for (PointIndex first = section.first; first <= section.last; first += piece_size)
            pieces.push_back({first, std::min(section.last, first + piece_size - 1)});
    }
    if (total <= most) return pieces;
    // A piece is kept if the share of the records before it that were kept is not above that of all records.
    std::vector<PointRange> kept;
    PointIndex before = 0, kept_before = 0;
    for (const PointRange& piece : pieces) {
        if (static_cast<double>(kept_before) * static_cast<double>(total) <=
            static_cast<double>(before) * static_cast<double>(most)) {
            kept.push_back(piece);
            kept_before += piece.size();
        }
        before += piece.size();
    }
    return kept;
}

}  // namespace clsurf
