#pragma once
// LineMap: the program line of each logged point.
//
// If the log has a line channel, it is used as it is and checked against the geometry. A kernel
// reports the line of its planner, which leads the axes by a few records, changes at the beginning of a
// blend and is the last of the merged lines, so the check allows the line before as well.
// If the log has none, log and program are aligned in order (mapping/alignment.h).

#include <memory>
#include <span>
#include <vector>

#include "core/block_fill.h"
#include "core/channel_view.h"
#include "core/column.h"
#include "core/diagnostic.h"
#include "core/point.h"
#include "log/log.h"
#include "mapping/program_match.h"
#include "program/program.h"
#include "toolpath/trajectory.h"

namespace clsurf {

/// The activity at a point, as far as the program defines it.
enum class PointKind : std::uint8_t {
    idle,  ///< no block, a dwell, or before the first motion
    rapid,
    cut,  ///< line, arc or spline at feed
};

class LineMap {
public:
    /// Lines from the log's channel. `motion_of_point`: from track_motions(), if a line has several motions; else
    /// empty.
    LineMap(const ChannelView& channel, const Program& program, std::shared_ptr<const void> keep_alive,
            Column<std::uint32_t> motion_of_point = {});
    /// Lines from an alignment: a motion per point (no_motion: none) and a confidence of 0 … 255.
    LineMap(Column<std::uint32_t> motion_of_point, Column<std::uint8_t> confidence, const Program& program);

    static constexpr std::uint32_t no_motion = 0xffffffffu;

    [[nodiscard]] bool from_log() const { return from_log_; }
    [[nodiscard]] PointIndex count() const { return count_; }

    /// Lines of points [begin, begin + out.size()), in the main program: for points in another file, the line that
    /// called it; 0: none.
    void read(PointIndex begin, std::span<LineNumber> out) const;
    /// The kinds of these points. Domain as read().
    void read_kinds(PointIndex begin, std::span<PointKind> out) const;
    [[nodiscard]] LineNumber line_at(PointIndex point) const;
    /// Motions of a line of the main program, and of other files that it called, in the order in which they run.
    [[nodiscard]] std::span<const std::uint32_t> motions_of(LineNumber line) const;
    /// The kind of a line: cut if one of its motions cuts, else rapid if one is rapid, else idle.
    [[nodiscard]] PointKind kind_of(LineNumber line) const {
        return line < kind_of_line_.size() ? kind_of_line_[line] : PointKind::idle;
    }

    /// The motion of a point; −1: none. With lines of a channel: the motion that the run of the line has reached.
    [[nodiscard]] std::int64_t motion_at(PointIndex point) const { return motion_at(point, line_at(point)); }
    /// The same if the line of the point is known.
    [[nodiscard]] std::int64_t motion_at(PointIndex point, LineNumber line) const;

    /// Every run of consecutive points with that line, in order. O(points).
    [[nodiscard]] std::vector<PointRange> points_of(LineNumber line) const { return points_of(line, line); }
    /// The same with the lines `first` … `last`.
    [[nodiscard]] std::vector<PointRange> points_of(LineNumber first, LineNumber last) const;

    /// The line of a motion, as in read(). Domain: a motion of the program.
    [[nodiscard]] LineNumber line_of_motion(std::int64_t motion) const {
        return line_of_motion_[static_cast<std::size_t>(motion)];
    }
    /// The tool of a motion: equal numbers, equal tools. O(log tool changes).
    [[nodiscard]] std::uint32_t tool_of(std::int64_t motion) const;
    [[nodiscard]] bool one_tool() const { return tools_.size() < 2; }

    /// Points off the program's path, on a return to the point of continuation (mapping/program_runs.h), in order. They
    /// are rapids, whatever line the log gives them.
    [[nodiscard]] const std::vector<PointRange>& returns() const { return returns_; }
    void set_returns(std::vector<PointRange> returns) { returns_ = std::move(returns); }
    [[nodiscard]] bool on_return(PointIndex point) const;

    /// Confidence in the line of a point, 0 … 1, by its source: a log's line is certain unless the program was
    /// edited. confidences() adds the agreement with the geometry.
    [[nodiscard]] double confidence_at(PointIndex point) const;

    /// Source of the map: the numbers of a channel (from_log()), a motion and a confidence per point; empty: none.
    [[nodiscard]] const ChannelView& channel() const { return channel_; }
    [[nodiscard]] const Column<std::uint32_t>& point_motions() const { return motion_of_point_; }
    [[nodiscard]] const Column<std::uint8_t>& confidences() const { return confidence_; }

    /// Whether the log belongs to the program.
    [[nodiscard]] const ProgramMatch& match() const { return match_; }
    void set_match(ProgramMatch match) { match_ = std::move(match); }

    /// For a map whose source is in a file: blocks are checked when they are read.
    void check_when_read(BlockFillPointer checked) { checked_ = std::move(checked); }

private:
    struct ToolChange {
        std::int64_t motion = 0;  ///< the first with the tool
        std::uint32_t tool = 0;
    };

    void index_lines(const Program& program);
    void index_tools(const Program& program);
    void read_kinds_of_lines(PointIndex begin, std::span<PointKind> out) const;

    PointIndex count_ = 0;
    ProgramMatch match_;
    bool from_log_ = false;
    ChannelView channel_;
    std::shared_ptr<const void> keep_alive_;
    BlockFillPointer checked_;
    Column<std::uint32_t> motion_of_point_;  ///< empty: each line has one motion, or none
    Column<std::uint8_t> confidence_;
    Column<LineNumber> line_of_motion_;  ///< in the main program
    Column<char> in_main_;               ///< by motion: it is in the main file; empty: all are
    Column<PointKind> kind_of_motion_;
    Column<PointKind> kind_of_line_;       ///< by line number
    Column<std::uint32_t> first_of_line_;  ///< by line number: index in by_line_ of its first motion
    Column<std::uint32_t> by_line_;        ///< motions sorted by line
    std::vector<ToolChange> tools_;        ///< in order
    std::vector<PointRange> returns_;
};

}  // namespace clsurf
