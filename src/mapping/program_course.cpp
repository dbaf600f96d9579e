#include "mapping/program_course.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace clsurf {
namespace {

constexpr double part_of_program = 0.02;     ///< motions that may be missing at an end: approach, retract
constexpr double begins_again_before = 0.1;  ///< of the motions: here a run begins …
constexpr double begins_again_after = 0.9;   ///< … after one that came as far as this
constexpr double least_pause = 1.0;          ///< [s]

class Course {
public:
    Course(const Log& log, const Program& program, Diagnostics& diagnostics)
        : log_(log), motions_(static_cast<double>(program.motions.size())), diagnostics_(diagnostics) {}

    void add(PointIndex point, LineNumber line, std::int64_t motion, PointKind kind, bool moved) {
        if (moved || kind != PointKind::cut || line != line_) {
            end_pause(point);
            still_since_ = point;
        }
        line_ = line;
        if (line == 0 || motion < 0 || motion == motion_) return;
        motion_ = motion;
        const double place = static_cast<double>(motion) / motions_;
        if (first_ < 0) {
            first_ = place;
            first_line_ = line;
        }
        if (place >= begins_again_after) far_ = true;
        if (place <= begins_again_before && far_) {
            far_ = false;
            ++runs_;
            add_note("map.runs", point,
                     fmt::format("the program begins again at line {}: run {} in this log", line, runs_),
                     "passes of several runs overlap in a map");
        }
        last_ = place;
        last_line_ = line;
    }

    /// The share of the motions that the log does not have.
    double finish() {
        end_pause(log_.records);
        double missing = 0;
        if (first_ > part_of_program) {
            missing += first_;
            warn("map.begins-inside", 0,
                 fmt::format("the log begins at line {}: {:.0f} % of the program's motions are missing before it",
                             first_line_, first_ * 100));
        }
        if (first_ >= 0 && last_ < 1 - part_of_program - 1 / motions_) {
            missing += 1 - last_;
            warn("map.ends-early", log_.records - 1,
                 fmt::format("the log ends at line {}: {:.0f} % of the program's motions are missing after it",
                             last_line_, (1 - last_) * 100));
        }
        return missing;
    }

private:
    void end_pause(PointIndex end) {
        if (still_since_ < 0 || end <= still_since_) return;
        const double seconds = static_cast<double>(end - still_since_) * log_.period;
        if (seconds < least_pause) return;
        add_note("map.pause", still_since_,
                 fmt::format("the tool stands still for {:.1f} s on line {}", seconds, line_), {});
    }

    void warn(const char* code, PointIndex point, std::string text) {
        diagnostics_.add({Severity::warning, code, Place::of_point(log_.name, point), std::move(text), {}});
    }
    void add_note(const char* code, PointIndex point, std::string text, std::string hint) {
        diagnostics_.add({Severity::note, code, Place::of_point(log_.name, point), std::move(text), std::move(hint)});
    }

    const Log& log_;
    double motions_;
    Diagnostics& diagnostics_;
    LineNumber line_ = 0, first_line_ = 0, last_line_ = 0;
    std::int64_t motion_ = -1;
    double first_ = -1, last_ = -1;  ///< place in the program, 0 … 1; −1: no line yet
    bool far_ = false;               ///< this run came near the end
    int runs_ = 1;
    PointIndex still_since_ = -1;
};

}  // namespace

double note_course(const Trajectory& path, const Log& log, const Program& program, const LineMap& map,
                   Diagnostics& diagnostics) {
    if (program.motions.size() == 0 || path.count == 0) return 0;
    constexpr std::size_t block = 4096;
    std::array<LineNumber, block> lines;
    std::array<PointKind, block> kinds;
    std::array<double, block> x, y, z;
    Course course(log, program, diagnostics);
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
    return course.finish();
}

}  // namespace clsurf
