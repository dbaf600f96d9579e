#include "mapping/line_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "core/block.h"
#include "mapping/alignment.h"
#include "mapping/allowed_motions.h"
#include "mapping/feed_edits.h"
#include "mapping/line_edits.h"
#include "mapping/motion_track.h"
#include "mapping/program_course.h"
#include "mapping/program_lines.h"
#include "mapping/work_offset.h"

namespace clsurf {
namespace {

/// More disagreement than this among the checked points is worth a warning.
constexpr double disagreeing_share = 0.005;
/// Where most points are off, a work offset is looked for.
constexpr double offset_share = 0.5;
constexpr PointIndex least_checked = 10;  ///< points that can tell a foreign log
/// A log of another program, as its hash says, may differ from this one by this much.
constexpr double other_share = 0.05;
/// Runs of points whose middle lies off its line: an edit may have moved the lines behind it.
constexpr double displaced = 0.02;
/// So many that the lines mean nothing where no edit explains them.
constexpr double all_displaced = 0.3;
/// A path that fits although its line numbers do not has no more points off than this.
constexpr double fitting_share = 0.1;
constexpr double sure_confidence = 0.9;  ///< of an aligned point

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
}

LineMap::LineMap(Column<std::uint32_t> motion_of_point, Column<std::uint8_t> confidence, const Program& program)
    : count_(static_cast<PointIndex>(motion_of_point.size())),
      motion_of_point_(std::move(motion_of_point)),
      confidence_(std::move(confidence)) {
    index_lines(program);
}

namespace {

/// By call: the line of the main program that runs it, itself or through others.
std::vector<LineNumber> lines_of_calls(const Motions& motions) {
    std::vector<LineNumber> lines(motions.calls.size() + 1, 0);
    for (std::size_t k = 0; k < motions.calls.size(); ++k) {
        const Call& call = motions.calls[k];
        lines[k + 1] = call.file == 0 ? call.line : lines[call.caller];
    }
    return lines;
}

}  // namespace

/// A motion in a file of its own counts for the line of the main program that called it.
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
    // Counting sort; a line that runs again (a loop, a subprogram) has several motions.
    for (std::size_t line = 0; line < lines; ++line) first_of_line_[line + 1] += first_of_line_[line];
    by_line_.resize(first_of_line_[lines]);
    Column<std::uint32_t> next = first_of_line_;
    for (std::size_t i = 0; i < motions.kind.size(); ++i) {
        if (const LineNumber line = line_of(i); line != 0) by_line_[next[line]++] = static_cast<std::uint32_t>(i);
    }
}

std::span<const std::uint32_t> LineMap::motions_of(LineNumber line) const {
    if (std::size_t{line} + 1 >= first_of_line_.size()) return {};
    return {by_line_.data() + first_of_line_[line], by_line_.data() + first_of_line_[line + 1]};
}

void LineMap::read(PointIndex begin, std::span<LineNumber> out) const {
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
            // A line that the program does not have is judged by info; here it cuts, so that it shows.
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
        const std::uint32_t motion = motion_of_point_[static_cast<std::size_t>(point)];
        return motion == no_motion ? -1 : static_cast<std::int64_t>(motion);
    }
    const std::span<const std::uint32_t> motions = motions_of(line);
    return motions.empty() ? -1 : static_cast<std::int64_t>(motions.front());
}

std::vector<PointRange> LineMap::points_of(LineNumber line) const {
    std::vector<PointRange> ranges;
    std::array<LineNumber, 4096> lines;
    for (PointIndex begin = 0; begin < count_; begin += static_cast<PointIndex>(lines.size())) {
        const auto n =
            static_cast<std::size_t>(std::min<PointIndex>(static_cast<PointIndex>(lines.size()), count_ - begin));
        read(begin, {lines.data(), n});
        for (std::size_t i = 0; i < n; ++i) {
            if (lines[i] != line) continue;
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
    constexpr double edited_confidence = 0.95;  // the text is not the one that ran
    const double least = match_.edited ? edited_confidence : 1.0;
    if (from_log()) return line_at(point) > 0 ? least : 0.0;
    return least * confidence_[static_cast<std::size_t>(point)] / 255.0;
}

namespace {

/// Part of the aligned points that are farther off than a finishing tolerance.
double off_share(const LineMap& map) {
    constexpr PointIndex looked_at = 10'000;
    const PointIndex stride = std::max<PointIndex>(1, map.count() / looked_at);
    PointIndex off = 0;
    PointIndex all = 0;
    for (PointIndex i = 0; i < map.count(); i += stride, ++all) off += map.confidence_at(i) < sure_confidence ? 1 : 0;
    return all > 0 ? static_cast<double>(off) / static_cast<double>(all) : 0.0;
}

ChannelView view_of(const Column<LineNumber>& lines) {
    return {reinterpret_cast<const std::byte*>(lines.data()),
            sizeof(LineNumber),
            static_cast<PointIndex>(lines.size()),
            ScalarType::u32,
            false,
            1.0,
            0.0};
}

/// Puts the lines of a log and a program together.
class LineMapper {
public:
    LineMapper(const Trajectory& path, const Log& log, const Program& program, ProgramIdentity identity,
               Diagnostics& diagnostics)
        : path_(path), log_(log), program_(program), identity_(identity), diagnostics_(diagnostics) {
        match_.edited = identity == ProgramIdentity::edited || identity == ProgramIdentity::other;
    }

    LineMap by_geometry() {
        LineMap map = align_lines(path_, program_, diagnostics_);
        const double off = off_share(map);
        const bool explained = off > offset_share && note_pose(path_, program_, nullptr, diagnostics_);
        const double foreign_at = identity_ == ProgramIdentity::other ? other_share : offset_share;
        if (identity_ != ProgramIdentity::same && !explained && off > foreign_at)
            match_.foreign = fmt::format("{:.0f} % of its points lie off the programmed path", 100 * off);
        if (off <= offset_share) match_.missing = note_course(path_, log_, program_, map, diagnostics_);
        return finish(std::move(map));
    }

    LineMap by_channel(const Channel& channel, const ProgramLines& own) {
        LineMap map = own.lines ? reported(channel.values, view_of(*own.lines), own.lines)
                                : reported(channel.values, channel.values, log_.keep_alive);
        const double off_line = identity_ == ProgramIdentity::same ? 0.0 : displaced_share(path_, program_, map);
        if (match_.edited || off_line > displaced) {
            if (std::optional<LineMap> moved = look_for_edits(channel, own)) {
                map = std::move(*moved);
            } else if (off_line > all_displaced) {
                if (std::optional<LineMap> found = fitting_geometry()) return finish(std::move(*found));
            }
        }
        const LineAgreement agreement = check_lines(path_, program_, map);
        if (share_of(agreement) > disagreeing_share) note_disagreement(agreement);
        const bool explained = share_of(agreement) > offset_share && note_pose(path_, program_, &map, diagnostics_);
        const double foreign_at = identity_ == ProgramIdentity::other ? other_share : offset_share;
        if (identity_ != ProgramIdentity::same && !explained && agreement.checked >= least_checked &&
            share_of(agreement) > foreign_at) {
            match_.foreign = fmt::format("{:.0f} % of {} checked points lie farther than {} mm from their lines",
                                         100 * share_of(agreement), agreement.checked, agreement.tolerance);
        }
        if (share_of(agreement) <= offset_share) match_.missing = note_course(path_, log_, program_, map, diagnostics_);
        return finish(std::move(map));
    }

private:
    static double share_of(const LineAgreement& a) {
        return a.checked > 0 ? static_cast<double>(a.disagreeing) / static_cast<double>(a.checked) : 0.0;
    }

    LineMap finish(LineMap map) {
        if (match_.edited && match_.foreign.empty())
            note_changed_feeds(path_, log_.period, program_, map, diagnostics_);
        map.set_match(std::move(match_));
        return map;
    }

    /// `numbers`: of the file that runs; `lines`: of the main program.
    LineMap reported(const ChannelView& numbers, const ChannelView& lines, std::shared_ptr<const void> keep_alive) {
        Column<std::uint32_t> motions;
        if (lines_are_ambiguous(program_.motions))
            motions = track_motions(path_, log_, program_, numbers, corner_tolerance(program_));
        return {lines, program_, std::move(keep_alive), std::move(motions)};
    }

    /// The log's lines where they stand in the text that was edited after the run.
    std::optional<LineMap> look_for_edits(const Channel& channel, const ProgramLines& own) {
        Diagnostics of_alignment;
        const LineMap aligned = align_lines(path_, program_, of_alignment);
        if (off_share(aligned) > offset_share) return std::nullopt;
        const ChannelView lines = own.lines ? view_of(*own.lines) : channel.values;
        std::optional<LineEdits> edits = find_line_edits(path_, program_, lines, aligned);
        if (!edits) return std::nullopt;
        if (edits->shifts.empty()) {
            if (match_.edited)
                diagnostics_.add({Severity::note,
                                  "map.edited",
                                  Place::of_file(program_.main().name()),
                                  "no line moved by the edit: the log's line numbers hold",
                                  {}});
            return std::nullopt;
        }
        match_.edited = true;
        diagnostics_.add({Severity::warning,
                          "map.edited",
                          Place::of_file(program_.main().name()),
                          fmt::format("{} since the run; the log's line numbers were moved accordingly", edits->text()),
                          {}});
        auto moved = std::make_shared<const Column<LineNumber>>(std::move(edits->lines));
        if (!own.lines) return reported(view_of(*moved), view_of(*moved), moved);
        // Numbers of the main program are moved, those of other files stay.
        Column<LineNumber> numbers(moved->size());
        copy_block(channel.values, 0, {numbers.data(), numbers.size()}, 0);
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            if (numbers[i] == (*own.lines)[i]) numbers[i] = (*moved)[i];
        }
        return reported(view_of(numbers), view_of(*moved), moved);
    }

    /// Where the log's numbers mean nothing in this program (block numbers, other lines), but its path fits.
    std::optional<LineMap> fitting_geometry() {
        Diagnostics of_alignment;
        LineMap map = align_lines(path_, program_, of_alignment);
        if (off_share(map) > fitting_share) return std::nullopt;
        diagnostics_.add({Severity::warning,
                          "map.line-numbers",
                          Place::of_file(log_.name),
                          "the log's line numbers do not fit the program, its path does: lines are found by geometry",
                          {}});
        match_.edited = true;
        match_.missing = note_course(path_, log_, program_, map, diagnostics_);
        return map;
    }

    void note_disagreement(const LineAgreement& agreement) {
        diagnostics_.add({Severity::warning, "map.disagreement", Place::of_point(log_.name, agreement.worst),
                          fmt::format("{} of {} checked points are farther than {} mm from the line that the log "
                                      "gives them: median {:.4f} mm, worst {:.3f} mm",
                                      agreement.disagreeing, agreement.checked, agreement.tolerance,
                                      agreement.median_distance, agreement.worst_distance),
                          "another program, another version of it, or another work offset?"});
    }

    const Trajectory& path_;
    const Log& log_;
    const Program& program_;
    ProgramIdentity identity_;
    Diagnostics& diagnostics_;
    ProgramMatch match_;
};

}  // namespace

LineMap map_lines(const Trajectory& path, const Log& log, const Program& program, bool use_channel,
                  Diagnostics& diagnostics, ProgramIdentity identity) {
    LineMapper mapper(path, log, program, identity, diagnostics);
    const Channel* channel = use_channel ? log.find("line") : nullptr;
    if (channel == nullptr) return mapper.by_geometry();
    const ProgramLines own = lines_of_program(log, program, diagnostics);
    return own.known ? mapper.by_channel(*channel, own) : mapper.by_geometry();
}

}  // namespace clsurf
