#include "mapping/line_edits.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>

#include <fmt/format.h>

#include "mapping/allowed_motions.h"
#include "mapping/line_shifts.h"
#include "toolpath/toolpath.h"

namespace clsurf {
namespace {

// A bound on the time: about 10^5 points.
constexpr PointIndex sampled_sections = 64;  ///< evenly spaced over the log
constexpr PointIndex sampled_points = 1600;  ///< points
constexpr std::size_t least_run = 5;      ///< moving points of a line, so that its middle is distinct from the next one
constexpr double steps_off = 1.5;         ///< chords by which a point may be off its line
constexpr double least_confidence = 0.5;  ///< least confidence of an aligned point that locates a line
constexpr double explained_share = 0.8;   ///< share of all lines that the edits must explain
constexpr std::size_t most_shifts = 1000;  ///< in total, and at most one for ten lines

class EditFinder {
public:
    EditFinder(const Trajectory& path, const Program& program, const ChannelView& lines, const LineMap& aligned)
        : path_(path), program_(program), lines_(lines), aligned_(aligned) {}

    std::optional<LineEdits> find() {
        collect_ends();
        if (ends_.empty()) return std::nullopt;
        const LineShifts shifts = find_line_shifts(ends_, found_, lines_with_motion());
        if (shifts.unexplained > 1 - explained_share ||
            shifts.sections.size() > std::min(most_shifts, shifts.lines / 10 + 1))
            return std::nullopt;
        LineEdits edits;
        std::int64_t before = 0;
        for (const ShiftedLines& section : shifts.sections) {
            edits.shifts.push_back({section.first, section.shift - before});
            before = section.shift;
        }
        correct(edits, shifts.lead);
        return edits;
    }

private:
    /// A run of moving records with one reported line; found_ has the geometric line of each.
    struct Run {
        LineNumber line = 0;
        std::int64_t begin = 0;
        std::int64_t off_path = 0;  ///< records
    };

    /// If a line is blended with the next one, its end is early by up to half of the shorter of both.
    void collect_ends() {
        Run last, now;
        const auto close = [&](std::int64_t end) {
            if (last.line != 0) {
                const std::int64_t shorter = std::min(now.begin - last.begin, end - now.begin);
                const auto records = static_cast<double>(now.begin - last.begin);
                ends_.push_back({last.line, now.begin, static_cast<double>(shorter) / 2,
                                 static_cast<double>(last.off_path) / records});
            }
            last = now;
        };
        for_moving([&](LineNumber reported, LineNumber at) {
            const auto record = static_cast<std::int64_t>(found_.size());
            found_.push_back(at);
            if (reported != now.line) {
                close(record);
                now = {reported, record, 0};
            }
            now.off_path += at == 0 ? 1 : 0;
        });
        close(static_cast<std::int64_t>(found_.size()));
        std::stable_sort(ends_.begin(), ends_.end(),
                         [](const LineEnd& x, const LineEnd& y) { return x.line < y.line; });
    }

    /// Calls body(reported, aligned) for the moving points; 0: none.
    template <typename Body>
    void for_moving(const Body& body) const {
        // Points that are read at once; results do not depend on it.
        constexpr PointIndex block = 4096;
        std::vector<LineNumber> reported(static_cast<std::size_t>(block)), found(reported.size());
        std::vector<double> x(reported.size()), y(x.size()), z(x.size());
        Vec3 before = path_.count > 0 ? path_.at(0) : Vec3::Zero();
        for (PointIndex begin = 0; begin < path_.count; begin += block) {
            const auto n = static_cast<std::size_t>(std::min(block, path_.count - begin));
            copy_block(lines_, begin, {reported.data(), n}, 0);
            read_aligned(begin, {found.data(), n});
            path_.read(begin, {x.data(), n}, {y.data(), n}, {z.data(), n});
            for (std::size_t i = 0; i < n; ++i) {
                const Vec3 p(x[i], y[i], z[i]);
                if (p != before) body(reported[i], found[i]);
                before = p;
            }
        }
    }

    /// The aligned lines; 0 if the tool is off the program's path, or in the file of a subprogram whose lines the log
    /// counts.
    void read_aligned(PointIndex begin, std::span<LineNumber> out) const {
        aligned_.read(begin, out);
        for (std::size_t i = 0; i < out.size(); ++i) {
            if (aligned_.confidence_at(begin + static_cast<PointIndex>(i)) < least_confidence) out[i] = 0;
        }
        if (program_.motions.file.empty()) return;
        for (std::size_t i = 0; i < out.size(); ++i) {
            if (in_other_file(begin + static_cast<PointIndex>(i))) out[i] = 0;
        }
    }

    [[nodiscard]] std::vector<LineNumber> lines_with_motion() const {
        std::vector<LineNumber> lines;
        for (std::int64_t m = 0; m < program_.motions.size(); ++m) lines.push_back(aligned_.line_of_motion(m));
        std::sort(lines.begin(), lines.end());
        lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
        return lines;
    }

    /// Lines of the points in the new text. For a deleted line, the geometry gives the present line.
    void correct(LineEdits& edits, PointIndex lead) const {
        edits.lines.resize(static_cast<std::size_t>(path_.count));
        copy_block(lines_, 0, {edits.lines.data(), edits.lines.size()}, 0);
        std::vector<std::int64_t> total{0};
        for (const LineShift& s : edits.shifts) total.push_back(total.back() + s.by);
        for (std::size_t i = 0; i < edits.lines.size(); ++i) {
            LineNumber& line = edits.lines[i];
            const auto point = static_cast<PointIndex>(i);
            if (line == 0 || in_other_file(point)) continue;
            const auto next = std::upper_bound(edits.shifts.begin(), edits.shifts.end(), line,
                                               [](LineNumber l, const LineShift& s) { return l < s.before; });
            if (next != edits.shifts.end() &&
                std::int64_t{line} >= std::int64_t{next->before} + std::min<std::int64_t>(0, next->by)) {
                line = aligned_.line_at(std::clamp<PointIndex>(point + lead, 0, path_.count - 1));
            } else {
                const std::int64_t moved = line + total[static_cast<std::size_t>(next - edits.shifts.begin())];
                line = static_cast<LineNumber>(std::max<std::int64_t>(0, moved));
            }
        }
    }

    [[nodiscard]] bool in_other_file(PointIndex point) const {
        if (program_.motions.file.empty()) return false;
        const std::int64_t motion = aligned_.motion_at(point);
        return motion >= 0 && program_.motions.file[static_cast<std::size_t>(motion)] != 0;
    }

    const Trajectory& path_;
    const Program& program_;
    const ChannelView& lines_;
    const LineMap& aligned_;
    std::vector<LineEnd> ends_;  ///< sorted by line
    Column<LineNumber> found_;   ///< from the geometry, for the moving records
};

/// Checks the middle of each run of points with one line.
class MiddleCheck {
public:
    MiddleCheck(const Toolpath& path, const LineMap& map, double tolerance)
        : path_(path), map_(map), tolerance_(tolerance) {}

    void look_at(PointIndex begin, std::span<const LineNumber> lines, std::span<const double> x,
                 std::span<const double> y, std::span<const double> z) {
        // The first and the last run are truncated by the section.
        std::size_t first = 0;
        bool whole = false;
        std::int64_t before = -1;
        for (std::size_t i = 1; i < lines.size(); ++i) {
            if (lines[i] == lines[i - 1]) continue;
            if (whole && i - first >= least_run && lines[first] != 0) {
                const std::size_t k = first + (i - first) / 2;
                const Vec3 p(x[k], y[k], z[k]);
                const double chord = (p - Vec3(x[k - 1], y[k - 1], z[k - 1])).norm();
                judge(map_.motion_at(begin + static_cast<PointIndex>(k)), before, p, chord);
            }
            before = map_.motion_at(begin + static_cast<PointIndex>(i) - 1);
            first = i;
            whole = true;
        }
    }

    [[nodiscard]] double share() const { return all_ > 0 ? static_cast<double>(off_) / static_cast<double>(all_) : 0; }

private:
    void judge(std::int64_t motion, std::int64_t before, const Vec3& p, double chord) {
        if (motion < 0 || !(chord > 0)) return;
        // Motions that were merged into the line count as the line.
        const bool merged = before >= 0 && before < motion && motion - before <= longest_merge;
        double nearest = path_.projection(motion, p).distance;
        for (std::int64_t m = merged ? before + 1 : motion; m < motion; ++m)
            nearest = std::min(nearest, path_.projection(m, p).distance);
        ++all_;
        off_ += nearest > std::max(tolerance_, steps_off * chord) ? 1 : 0;
    }

    const Toolpath& path_;
    const LineMap& map_;
    double tolerance_;
    std::int64_t all_ = 0, off_ = 0;
};

}  // namespace

double displaced_share(const Trajectory& path, const Program& program, const LineMap& map) {
    const Toolpath toolpath(program.motions, path.count > 0 ? path.at(0) : Vec3::Zero());
    const PointIndex n = std::min(path.count, sampled_points);
    const PointIndex count = n > 0 ? std::min(sampled_sections, path.count / n) : 0;
    std::vector<double> x(static_cast<std::size_t>(n)), y(x.size()), z(x.size());
    std::vector<LineNumber> lines(x.size());
    MiddleCheck check(toolpath, map, corner_tolerance(program));
    for (PointIndex s = 0; s < count; ++s) {
        const PointIndex begin = count == 1 ? 0 : (path.count - n) / (count - 1) * s;
        path.read(begin, x, y, z);
        map.read(begin, lines);
        check.look_at(begin, lines, x, y, z);
    }
    return check.share();
}

std::optional<LineEdits> find_line_edits(const Trajectory& path, const Program& program, const ChannelView& lines,
                                         const LineMap& aligned) {
    return EditFinder(path, program, lines, aligned).find();
}

std::string LineEdits::text() const {
    constexpr std::size_t shown = 3;
    std::string text;
    for (std::size_t i = 0; i < std::min(shown, shifts.size()); ++i) {
        const std::int64_t n = std::abs(shifts[i].by);
        text += fmt::format("{}{} line{} {} before line {}", i > 0 ? ", " : "", n, n == 1 ? "" : "s",
                            shifts[i].by > 0 ? "inserted" : "deleted", shifts[i].before);
    }
    if (shifts.size() > shown) text += fmt::format(" and {} more changes", shifts.size() - shown);
    return text;
}

}  // namespace clsurf
