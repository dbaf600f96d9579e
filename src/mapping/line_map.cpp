#include "mapping/line_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <variant>
#include <vector>

#include "core/block.h"

namespace clsurf {
namespace {

PointKind point_kind(MotionKind kind) {
    switch (kind) {
        case MotionKind::rapid: return PointKind::rapid;
        case MotionKind::dwell: return PointKind::idle;
        default: return PointKind::cut;
    }
}

}  // namespace

LineMap::LineMap(const ChannelView& channel, const Program& program, std::shared_ptr<const void> keep_alive,
                 Column<std::uint32_t> motion_of_point)
    : count_(channel.count),
      from_log_(true),
      channel_(channel),
      keep_alive_(std::move(keep_alive)),
      motion_of_point_(std::move(motion_of_point)) {
    index_lines(program);
    index_tools(program);
}

LineMap::LineMap(Column<std::uint32_t> motion_of_point, Column<std::uint8_t> confidence, const Program& program)
    : count_(static_cast<PointIndex>(motion_of_point.size())),
      motion_of_point_(std::move(motion_of_point)),
      confidence_(std::move(confidence)) {
    index_lines(program);
    index_tools(program);
}

namespace {

/// By call: the line of the main program that runs it, directly or through other calls.
std::vector<LineNumber> lines_of_calls(const Motions& motions) {
    std::vector<LineNumber> lines(motions.calls.size() + 1, 0);
    for (std::size_t k = 0; k < motions.calls.size(); ++k) {
        const Call& call = motions.calls[k];
        lines[k + 1] = call.file == 0 ? call.line : lines[call.caller];
    }
    return lines;
}

}  // namespace

/// A motion in another file counts for the line of the main program that called it.
void LineMap::index_lines(const Program& program) {
    const Motions& motions = program.motions;
    const std::size_t lines = std::size_t{program.main().line_count()} + 1;
    kind_of_line_ = Column<PointKind>(lines, PointKind::idle);
    line_of_motion_ = motions.line;
    kind_of_motion_.resize(motions.kind.size());
    first_of_line_ = Column<std::uint32_t>(lines + 1, 0);
    if (!motions.file.empty()) {
        in_main_ = Column<char>(motions.kind.size(), 1);
        const std::vector<LineNumber> line_of_call = lines_of_calls(motions);
        for (std::size_t i = 0; i < motions.kind.size(); ++i) {
            if (motions.file[i] == 0) continue;
            in_main_[i] = 0;
            line_of_motion_[i] = motions.call.empty() ? 0 : line_of_call[motions.call[i]];
        }
    }
    const auto line_of = [&](std::size_t i) { return line_of_motion_[i] < lines ? line_of_motion_[i] : 0; };
    for (std::size_t i = 0; i < motions.kind.size(); ++i) {
        kind_of_motion_[i] = point_kind(motions.kind[i]);
        const LineNumber line = line_of(i);
        if (line == 0) continue;
        kind_of_line_[line] = std::max(kind_of_line_[line], kind_of_motion_[i]);
        ++first_of_line_[line + 1];
    }
    // Counting sort; a line that runs repeatedly (a loop, a subprogram) has several motions.
    for (std::size_t line = 0; line < lines; ++line) first_of_line_[line + 1] += first_of_line_[line];
    by_line_.resize(first_of_line_[lines]);
    Column<std::uint32_t> next = first_of_line_;
    for (std::size_t i = 0; i < motions.kind.size(); ++i) {
        if (const LineNumber line = line_of(i); line != 0) by_line_[next[line]++] = static_cast<std::uint32_t>(i);
    }
}

/// Two tool words before one motion are one change: the second one preselects the next tool.
void LineMap::index_tools(const Program& program) {
    std::map<ToolWord, std::uint32_t> numbers;
    for (const ProgramEvent& event : program.events) {
        const auto* word = std::get_if<ToolWord>(&event.meaning);
        if (word == nullptr) continue;
        const std::uint32_t tool =
            numbers.try_emplace(*word, static_cast<std::uint32_t>(numbers.size() + 1)).first->second;
        if (!tools_.empty() && tools_.back().motion == event.motion) tools_.pop_back();
        if (tools_.empty() || tools_.back().tool != tool) tools_.push_back({event.motion, tool});
    }
}

std::uint32_t LineMap::tool_of(std::int64_t motion) const {
    const auto next = std::upper_bound(tools_.begin(), tools_.end(), motion,
                                       [](std::int64_t m, const ToolChange& t) { return m < t.motion; });
    return next == tools_.begin() ? 0 : std::prev(next)->tool;
}

bool LineMap::on_return(PointIndex point) const {
    const auto next = std::upper_bound(returns_.begin(), returns_.end(), point,
                                       [](PointIndex p, const PointRange& way) { return p < way.first; });
    return next != returns_.begin() && point <= std::prev(next)->last;
}

std::span<const std::uint32_t> LineMap::motions_of(LineNumber line) const {
    if (std::size_t{line} + 1 >= first_of_line_.size()) return {};
    return {by_line_.data() + first_of_line_[line], by_line_.data() + first_of_line_[line + 1]};
}

void LineMap::read(PointIndex begin, std::span<LineNumber> out) const {
    if (out.empty()) return;
    checked_.need(begin, begin + static_cast<PointIndex>(out.size()) - 1);
    if (from_log()) {
        copy_block(channel_, begin, out, 0);
        if (in_main_.empty()) return;
        // A line of a subprogram's own file: the line of the main program that called it.
        for (std::size_t i = 0; i < out.size(); ++i) {
            const std::uint32_t m = motion_of_point_[static_cast<std::size_t>(begin) + i];
            if (m != no_motion && in_main_[m] == 0) out[i] = line_of_motion_[m];
        }
        return;
    }
    const std::uint32_t* motion = motion_of_point_.data() + begin;
    for (std::size_t i = 0; i < out.size(); ++i) { out[i] = motion[i] == no_motion ? 0 : line_of_motion_[motion[i]]; }
}

void LineMap::read_kinds(PointIndex begin, std::span<PointKind> out) const {
    if (out.empty()) return;
    read_kinds_of_lines(begin, out);
    const PointIndex last = begin + static_cast<PointIndex>(out.size()) - 1;
    for (const PointRange& way : returns_) {
        for (PointIndex i = std::max(begin, way.first); i <= std::min(last, way.last); ++i)
            out[static_cast<std::size_t>(i - begin)] = PointKind::rapid;
    }
}

void LineMap::read_kinds_of_lines(PointIndex begin, std::span<PointKind> out) const {
    checked_.need(begin, begin + static_cast<PointIndex>(out.size()) - 1);
    const std::uint32_t* motion = motion_of_point_.empty() ? nullptr : motion_of_point_.data() + begin;
    if (!from_log()) {
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = motion[i] == no_motion ? PointKind::idle : kind_of_motion_[motion[i]];
        return;
    }
    std::array<LineNumber, 1024> lines;
    for (std::size_t done = 0; done < out.size(); done += lines.size()) {
        const std::size_t n = std::min(lines.size(), out.size() - done);
        copy_block(channel_, begin + static_cast<PointIndex>(done), {lines.data(), n}, 0);
        for (std::size_t i = 0; i < n; ++i) {
            const std::uint32_t m = motion == nullptr ? no_motion : motion[done + i];
            // A line that the program does not have is reported by info; here it counts as cutting, so that it is
            // shown.
            out[done + i] = m != no_motion                     ? kind_of_motion_[m]
                            : lines[i] == 0                    ? PointKind::idle
                            : lines[i] >= kind_of_line_.size() ? PointKind::cut
                                                               : kind_of_line_[lines[i]];
        }
    }
}

LineNumber LineMap::line_at(PointIndex point) const {
    LineNumber line = 0;
    read(point, {&line, 1});
    return line;
}

std::int64_t LineMap::motion_at(PointIndex point, LineNumber line) const {
    if (!motion_of_point_.empty()) {
        checked_.need(point);
        const std::uint32_t motion = motion_of_point_[static_cast<std::size_t>(point)];
        return motion == no_motion ? -1 : static_cast<std::int64_t>(motion);
    }
    const std::span<const std::uint32_t> motions = motions_of(line);
    return motions.empty() ? -1 : static_cast<std::int64_t>(motions.front());
}

std::vector<PointRange> LineMap::points_of(LineNumber first, LineNumber last) const {
    std::vector<PointRange> ranges;
    std::array<LineNumber, 4096> lines;
    for (PointIndex begin = 0; begin < count_; begin += static_cast<PointIndex>(lines.size())) {
        const auto n =
            static_cast<std::size_t>(std::min<PointIndex>(static_cast<PointIndex>(lines.size()), count_ - begin));
        read(begin, {lines.data(), n});
        for (std::size_t i = 0; i < n; ++i) {
            if (lines[i] < first || lines[i] > last) continue;
            const PointIndex point = begin + static_cast<PointIndex>(i);
            if (!ranges.empty() && ranges.back().last == point - 1) {
                ranges.back().last = point;
            } else {
                ranges.push_back({point, point});
            }
        }
    }
    return ranges;
}

double LineMap::confidence_at(PointIndex point) const {
    // As in docs/design/predictor.md#6-decide-whether-the-data-allow-a-verdict, An edited program.
    constexpr double edited_confidence = 0.95;  // the text has been edited since the run
    const double least = match_.edited ? edited_confidence : 1.0;
    if (from_log()) return line_at(point) > 0 ? least : 0.0;
    checked_.need(point);
    return least * confidence_[static_cast<std::size_t>(point)] / 255.0;
}

}  // namespace clsurf
