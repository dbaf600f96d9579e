#include "mapping/program_course.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/column.h"
#include "toolpath/toolpath.h"

namespace clsurf {
namespace {

constexpr double part_of_program = 0.02;  ///< share of motions that may be missing at an end: approach, retract
constexpr double restart_before = 0.1;    ///< share of the motions: a run begins before this …
constexpr double restart_after = 0.9;     ///< … if the previous one came as far as this
constexpr double least_pause = 1.0;       ///< [s]

/// Number of motions with a length before each one, and before the end: a log has no points on the others.
Column<std::uint32_t> count_before(const Program& program, const Vec3& start) {
    const Toolpath path(program.motions, start);
    Column<std::uint32_t> before(static_cast<std::size_t>(path.size()) + 1, 0);
    for (std::int64_t m = 0; m < path.size(); ++m) {
        const auto at = static_cast<std::size_t>(m);
        before[at + 1] = before[at] + (path.length(m) > 0 ? 1 : 0);
    }
    return before;
}

class Course {
public:
    Course(const Log& log, const Program& program, const Vec3& start, Diagnostics& diagnostics)
        : log_(log),
          motions_(static_cast<double>(program.motions.size())),
          before_(count_before(program, start)),
          with_length_(std::max(1.0, static_cast<double>(before_.back()))),
          diagnostics_(diagnostics) {}

    void add(PointIndex point, LineNumber line, std::int64_t motion, PointKind kind, bool moved) {
        if (moved || kind != PointKind::cut || line != line_) {
            end_pause(point);
            pause_begin_ = point;
        }
        line_ = line;
        if (line == 0 || motion < 0 || motion == motion_) return;
        motion_ = motion;
        const double place = before_[static_cast<std::size_t>(motion)] / with_length_;
        if (first_ < 0) {
            first_ = place;
            first_line_ = line;
        }
        last_ = place;
        last_line_ = line;
    }

    void add_runs(const LineMap& map, std::span<const ProgramRun> runs) {
        for (std::size_t k = 1; k < runs.size(); ++k) {
            const LineNumber from = map.line_of_motion(runs[k].first_motion);
            const LineNumber to = map.line_of_motion(runs[k - 1].last_motion);
            const bool whole = static_cast<double>(runs[k].first_motion) <= restart_before * motions_ &&
                               static_cast<double>(runs[k - 1].last_motion) >= restart_after * motions_;
            if (whole) {
                warn("map.runs", runs[k].first,
                     fmt::format("the program begins again at line {}: run {} in this log", from, k + 1),
                     "each run is compared with itself; maps show both: render --points A..B shows one");
                continue;
            }
            std::string left;
            for (const PointRange& tool_return : map.returns()) {
                if (tool_return.last + 1 == runs[k].first)
                    left = fmt::format("the tool leaves the path on line {} at point {}, and ",
                                       map.line_at(tool_return.first), tool_return.first);
            }
            warn("map.restart", runs[k].first,
                 fmt::format("{}the run goes on from line {}: lines {}-{} ran twice", left, from, from, to),
                 "each cut is compared with the passes of its own run; the stop may have left a mark");
        }
    }

    /// The share of the motions that are missing in the log.
    double finish() {
        end_pause(log_.records);
        double missing = 0;
        if (first_ > part_of_program) {
            missing += first_;
            warn("map.begins-inside", 0,
                 fmt::format("the log begins at line {}: {:.0f} % of the program's motions are missing before it",
                             first_line_, first_ * 100));
        }
        if (first_ >= 0 && last_ < 1 - part_of_program - 1 / with_length_) {
            missing += 1 - last_;
            warn("map.ends-early", log_.records - 1,
                 fmt::format("the log ends at line {}: {:.0f} % of the program's motions are missing after it",
                             last_line_, (1 - last_) * 100));
        }
        return missing;
    }

private:
    void end_pause(PointIndex end) {
        if (pause_begin_ < 0 || end <= pause_begin_) return;
        const double seconds = static_cast<double>(end - pause_begin_) * log_.period;
        if (seconds < least_pause) return;
        add_note("map.pause", pause_begin_,
                 fmt::format("the tool stands still for {:.1f} s on line {}", seconds, line_), {});
    }

    void warn(const char* code, PointIndex point, std::string text, std::string hint = {}) {
        diagnostics_.add(
            {Severity::warning, code, Place::of_point(log_.name, point), std::move(text), std::move(hint)});
    }
    void add_note(const char* code, PointIndex point, std::string text, std::string hint) {
        diagnostics_.add({Severity::note, code, Place::of_point(log_.name, point), std::move(text), std::move(hint)});
    }

    const Log& log_;
    double motions_;
    Column<std::uint32_t> before_;  ///< by motion: motions with a length before it
    double with_length_;            ///< of all motions; at least 1
    Diagnostics& diagnostics_;
    LineNumber line_ = 0, first_line_ = 0, last_line_ = 0;
    std::int64_t motion_ = -1;
    double first_ = -1, last_ = -1;  ///< place in the program, 0 … 1; −1: no line yet
    PointIndex pause_begin_ = -1;
};

}  // namespace

double note_course(const Trajectory& path, const Log& log, const Program& program, const LineMap& map,
                   std::span<const ProgramRun> runs, Diagnostics& diagnostics) {
    if (program.motions.size() == 0 || path.count == 0) return 0;
    // Points that are read at once; results do not depend on it.
    constexpr std::size_t block = 4096;
    std::array<LineNumber, block> lines;
    std::array<PointKind, block> kinds;
    std::array<double, block> x, y, z;
    Course course(log, program, path.at(0), diagnostics);
    Vec3 before = path.at(0);
    for (PointIndex begin = 0; begin < path.count; begin += static_cast<PointIndex>(block)) {
        const auto n =
            static_cast<std::size_t>(std::min<PointIndex>(static_cast<PointIndex>(block), path.count - begin));
        map.read(begin, {lines.data(), n});
        map.read_kinds(begin, {kinds.data(), n});
        path.read(begin, {x.data(), n}, {y.data(), n}, {z.data(), n});
        for (std::size_t i = 0; i < n; ++i) {
            const Vec3 p(x[i], y[i], z[i]);
            const PointIndex point = begin + static_cast<PointIndex>(i);
            course.add(point, lines[i], map.motion_at(point, lines[i]), kinds[i], p != before);
            before = p;
        }
    }
    course.add_runs(map, runs);
    return course.finish();
}

}  // namespace clsurf
