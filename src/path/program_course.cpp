#include "path/program_course.h"

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
    Course(const Log& log, const Program& program, const LineMap& map, Diagnostics& diagnostics)
        : log_(log), map_(map), motions_(static_cast<double>(program.motions.size())), diagnostics_(diagnostics) {}

    void add(PointIndex point, LineNumber line, PointKind kind, bool moved) {
        if (moved || kind != PointKind::cut || line != line_) {
            end_pause(point);
            still_since_ = point;
        }
        if (line == line_ || line == 0) {
            line_ = line;
            return;
        }
        line_ = line;
        // A loop runs its lines again and again: the first time counts.
        const auto motions = map_.motions_of(line);
        if (motions.empty()) return;
        const double place = static_cast<double>(motions.front()) / motions_;
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
                     "passes of several runs lie on each other in a map");
        }
        last_ = static_cast<double>(motions.back()) / motions_;
        last_line_ = line;
    }

    void finish() {
        end_pause(log_.records);
        if (first_ > part_of_program) {
            add_note("map.begins-inside", 0,
                     fmt::format("the log begins at line {}, with {:.0f} % of the program's motions before it",
                                 first_line_, first_ * 100),
                     {});
        }
        if (first_ >= 0 && last_ < 1 - part_of_program - 1 / motions_) {
            add_note("map.ends-early", log_.records - 1,
                     fmt::format("the log ends at line {}, with {:.0f} % of the program's motions after it", last_line_,
                                 (1 - last_) * 100),
                     {});
        }
    }

private:
    void end_pause(PointIndex end) {
        if (still_since_ < 0 || end <= still_since_) return;
        const double seconds = static_cast<double>(end - still_since_) * log_.period;
        if (seconds < least_pause) return;
        add_note("map.pause", still_since_,
                 fmt::format("the tool stands still for {:.1f} s on line {}", seconds, line_), {});
    }

    void add_note(const char* code, PointIndex point, std::string text, std::string hint) {
        diagnostics_.add({Severity::note, code, Place::of_point(log_.name, point), std::move(text), std::move(hint)});
    }

    const Log& log_;
    const LineMap& map_;
    double motions_;
    Diagnostics& diagnostics_;
    LineNumber line_ = 0, first_line_ = 0, last_line_ = 0;
    double first_ = -1, last_ = -1;  ///< place in the program, 0 … 1; −1: no line yet
    bool far_ = false;               ///< this run came near the end
    int runs_ = 1;
    PointIndex still_since_ = -1;
};

}  // namespace

void note_course(const Trajectory& path, const Log& log, const Program& program, const LineMap& map,
                 Diagnostics& diagnostics) {
    if (program.motions.size() == 0 || path.count == 0) return;
    constexpr std::size_t block = 4096;
    std::array<LineNumber, block> lines;
    std::array<PointKind, block> kinds;
    std::array<double, block> x, y, z;
    Course course(log, program, map, diagnostics);
    Vec3 before = path.at(0);
    for (PointIndex begin = 0; begin < path.count; begin += static_cast<PointIndex>(block)) {
        const auto n =
            static_cast<std::size_t>(std::min<PointIndex>(static_cast<PointIndex>(block), path.count - begin));
        map.read(begin, {lines.data(), n});
        map.read_kinds(begin, {kinds.data(), n});
        path.read(begin, {x.data(), n}, {y.data(), n}, {z.data(), n});
        for (std::size_t i = 0; i < n; ++i) {
            const Vec3 p(x[i], y[i], z[i]);
            course.add(begin + static_cast<PointIndex>(i), lines[i], kinds[i], p != before);
            before = p;
        }
    }
    course.finish();
}

}  // namespace clsurf
