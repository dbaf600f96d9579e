#include "repair/points/resample.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/parallel.h"
#include "core/statistics.h"
#include "numeric/polyline.h"
#include "repair/points/end_points.h"
#include "repair/points/new_lines.h"
#include "repair/points/section_spline.h"
#include "repair/spline_lines.h"
#include "toolpath/toolpath.h"

namespace clsurf {
namespace {

constexpr double narrowest = 0.3;   ///< share of the tolerance of lines: least radius of the tube for knots
constexpr double most_used = 0.99;  ///< share, for lines, of the tolerance that remains after rounding
// Without this reserve, a line was once off by 0.0103 instead of 0.01°.
constexpr double most_turned_used = 0.9;  ///< the same for the turn, which is measured at the nearest place of the path
constexpr double finest_share = 0.2;      ///< share of the usual spacing
// One and a half is the middle of one and two times the shortest line.
constexpr double line_reserve = 1.5;  ///< lines are one to two times as long as the shortest permitted one
// A size of portions for threads; results do not depend on it.
constexpr std::int64_t passes_a_piece = 4;
constexpr std::size_t shortest_segment = 3;  ///< motions

struct Spacings {
    double usual = 0;  ///< [mm] median
    double bend = 0;   ///< [1/mm] 98th percentile
};

/// The tolerance of lines minus the chord error of the shortest permitted lines [mm].
double tube_radius(double most, const ResampleRules& rules, const Spacings& spacings) {
    const double shortest = line_reserve * rules.shortest_line,
                 chord = std::max(rules.chord_error, spacings.bend * shortest * shortest / 8);
    return std::max(most - chord, narrowest * most);
}

LineRules line_rules(const ResampleRules& rules, const Spacings& spacings, double rounding, double turn_rounding) {
    const double most = most_used * (rules.tolerance - rounding);
    return {rules.spacing,
            std::max(spacings.usual, rules.spacing),
            rules.shortest_line,
            rules.chord_error,
            most,
            tube_radius(most, rules, spacings),
            most_turned_used * (rules.most_turned - turn_rounding),
            rules.ends};
}

class Resampler {
public:
    Resampler(const Program& program, const ProgrammedSurface& programmed, const LineEditor& editor,
              const ResampleRules& rules, const Spacings& spacings, std::span<const std::uint8_t> needed,
              const Orientation* orientation)
        : motions_(program.motions),
          path_(program.motions, Vec3::Zero()),
          programmed_(programmed),
          editor_(editor),
          splines_(rules.splines && orientation == nullptr && program.motions.rotary.empty()),
          lines_(line_rules(rules, spacings, editor.rounding(), editor.turn_rounding())),
          needed_(needed),
          orientation_(orientation),
          phases_(run_phases(programmed, rules.spacing)) {}

    [[nodiscard]] std::vector<ResampledSegment> run() const {
        std::vector<ProgrammedPass> passes = cut_passes(programmed_);
        if (lines_.ends.first > 0) {
            for (ProgrammedPass& pass : passes) pass = up_to_corners(programmed_, std::move(pass));
        }
        std::vector<std::vector<ResampledSegment>> of_pass(passes.size());
        parallel_for(static_cast<std::int64_t>(passes.size()), passes_a_piece,
                     [&](std::int64_t first, std::int64_t last) {
                         for (auto k = static_cast<std::size_t>(first); k < static_cast<std::size_t>(last); ++k)
                             run_pass(passes[k], of_pass[k]);
                     });
        std::vector<ResampledSegment> segments;
        for (std::vector<ResampledSegment>& mine : of_pass) {
            // Two passes may share a whole line.
            for (ResampledSegment& each : mine)
                if (segments.empty() || each.first > segments.back().last) segments.push_back(std::move(each));
        }
        return segments;
    }

private:
    [[nodiscard]] std::uint32_t motion(PointIndex i) const { return programmed_.motion_of(i); }

    /// Whether the line to end k of a pass may be rewritten as a whole.
    [[nodiscard]] bool editable(const ProgrammedPass& pass, std::size_t k) const {
        const std::uint32_t m = motion(pass.ends[k]);
        return (needed_.empty() || needed_[m] != 0) && editor_.editable(m) &&
               programmed_.ends_motion(pass.ends[k - 1]) && motion(pass.ends[k - 1]) + 1 == m &&
               (orientation_ == nullptr || may_be_divided(m));
    }

    [[nodiscard]] bool may_be_divided(std::uint32_t m) const {
        return orientation_->divisible(m) && (lines_.most_turned > 0 || !orientation_->turns(m));
    }

    void run_pass(const ProgrammedPass& pass, std::vector<ResampledSegment>& segments) const {
        const std::vector<std::uint8_t> creases = creases_of(pass);
        std::size_t begin = 0;  // index of the end where the section begins
        for (std::size_t k = 1; k < pass.ends.size(); ++k) {
            const bool may = editable(pass, k);
            const bool goes_on =
                k == begin + 1 ||
                (may && motions_.line[motion(pass.ends[k])] == motions_.line[motion(pass.ends[k - 1])] + 1 &&
                 creases[k - 1] == 0);
            if (may && goes_on) continue;
            add(pass, begin, k - 1, segments);
            begin = may ? k - 1 : k;
        }
        add(pass, begin, pass.ends.size() - 1, segments);
    }

    /// Marks ends of a pass where it turns by more than the corner angle within a spacing: at a corner, or in a crease that the
    /// program follows by lines as short as the crease is narrow. One entry per end.
    [[nodiscard]] std::vector<std::uint8_t> creases_of(const ProgrammedPass& pass) const {
        const std::size_t n = pass.ends.size();
        const double reach = 0.5 * lines_.spacing;
        const OldSegment old = old_segment(pass, 0, n - 1);
        std::vector<std::uint8_t> creases(n, 0);
        for (std::size_t k = 1; k + 1 < n; ++k) {
            const Vec3 before = old.points[k] - old.at(old.arc_length[k] - reach),
                       after = old.at(old.arc_length[k] + reach) - old.points[k];
            creases[k] = before.dot(after) < std::cos(least_corner_angle) * before.norm() * after.norm() ? 1 : 0;
        }
        return creases;
    }

    [[nodiscard]] OldSegment old_segment(const ProgrammedPass& pass, std::size_t begin, std::size_t end) const {
        OldSegment old;
        for (std::size_t k = begin; k <= end; ++k) {
            const Vec3 p = path_.end(motion(pass.ends[k]));
            old.arc_length.push_back(old.points.empty() ? 0 : old.arc_length.back() + (p - old.points.back()).norm());
            old.points.push_back(p);
            old.motion.push_back(motion(pass.ends[k]));
        }
        return old;
    }

    /// Adds the section between two ends of a pass, which do not change.
    void add(const ProgrammedPass& pass, std::size_t begin, std::size_t end,
             std::vector<ResampledSegment>& segments) const {
        if (end < begin + shortest_segment) return;
        const OldSegment old = old_segment(pass, begin, end);
        if (old.length() < lines_.spacing) return;
        std::vector<AlignedPoint> aligned_points =
            aligned_points_between(programmed_, phases_, pass.ends[begin], pass.ends[end], old.length());
        fix_end_points(aligned_points, old.length(), begin == 0, end + 1 == pass.ends.size(), lines_.ends);
        std::optional<TurningSegment> turning;
        if (turns(old)) turning.emplace(old, *orientation_, aligned_points, lines_);
        ResampledSegment segment{motion(pass.ends[begin + 1]), motion(pass.ends[end]), {}};
        const SmoothCurve curve(old, aligned_points, lines_);
        for (const NewPlace& place : new_lines(old, smooth(old, curve, aligned_points), aligned_points, lines_,
                                               turning ? &*turning : nullptr)) {
            segment.points.push_back(place.position);
            if (turning)
                segment.angles.push_back(turning->words(place));
            else if (!motions_.rotary.empty())
                segment.angles.push_back(standing(segment.last));
        }
        if (splines_) segment.spline = spline_of(old, curve, segment.first);
        // With --splines the user wants fewer blocks: if no spline saves any, there must not be more lines than before.
        if (splines_ && !segment.spline && segment.points.size() + 1 > old.points.size()) return;
        if (segment.spline || !stays(old, segment)) segments.push_back(std::move(segment));
    }

    /// The section as a spline, if the dialect has one that takes fewer blocks than the old lines.
    [[nodiscard]] std::optional<Nurbs> spline_of(const OldSegment& old, const SmoothCurve& curve,
                                                 std::int64_t first) const {
        if (!editor_.may_be_spline(first, old.points)) return std::nullopt;
        std::optional<Nurbs> spline = section_spline(old, curve, lines_);
        if (spline && blocks_of_spline(*spline, editor_.spline_form()) + 1 >= old.points.size()) spline.reset();
        return spline;
    }

    [[nodiscard]] bool turns(const OldSegment& old) const {
        return orientation_ != nullptr && std::any_of(old.motion.begin() + 1, old.motion.end(),
                                                      [&](std::int64_t m) { return orientation_->turns(m); });
    }

    /// The angles of a section in which no axis turns.
    [[nodiscard]] LineAngles standing(std::int64_t m) const {
        return {motions_.rotary[static_cast<std::size_t>(m)].vec(), m};
    }

    /// Whether the points are already the old ones.
    [[nodiscard]] static bool stays(const OldSegment& old, const ResampledSegment& segment) {
        if (segment.points.size() + 1 != old.points.size()) return false;
        for (std::size_t k = 0; k < segment.points.size(); ++k) {
            if ((segment.points[k] - old.points[k + 1]).norm() > 1e-3) return false;
        }
        return true;
    }

    const Motions& motions_;
    Toolpath path_;
    const ProgrammedSurface& programmed_;
    const LineEditor& editor_;
    bool splines_;
    LineRules lines_;
    std::span<const std::uint8_t> needed_;  ///< one entry per motion, or empty
    const Orientation* orientation_;
    Phases phases_;
};

Spacings spacings_of(const Program& program, const ProgrammedSurface& programmed) {
    const Toolpath path(program.motions, Vec3::Zero());
    std::vector<double> lengths, bends;
    for (const ProgrammedPass& pass : cut_passes(programmed)) {
        for (std::size_t k = 1; k < pass.ends.size(); ++k) {
            const std::uint32_t m = programmed.motion_of(pass.ends[k]);
            lengths.push_back(path.length(m));
            if (k + 1 == pass.ends.size() || k < 2) continue;
            const std::uint32_t after = programmed.motion_of(pass.ends[k + 1]);
            // Rounding makes short lines seem to bend.
            if (path.length(m) > 0.05 && path.length(after) > 0.05)
                bends.push_back(three_point_curvature(path.begin(m), path.end(m), path.end(after)));
        }
    }
    return {lengths.empty() ? 0 : quantile_below(lengths, 0.5), bends.empty() ? 0 : quantile_below(bends, 0.98)};
}

double fitting(const Spacings& spacings, double chord_error) {
    const double by_bend = spacings.bend > 0 ? std::sqrt(8 * chord_error / spacings.bend) : spacings.usual;
    return spacings.usual > 0 ? std::clamp(by_bend, finest_share * spacings.usual, spacings.usual) : by_bend;
}

}  // namespace

double fitting_spacing(const Program& program, const ProgrammedSurface& programmed, double chord_error) {
    return fitting(spacings_of(program, programmed), chord_error);
}

double usual_spacing(const Program& program, const ProgrammedSurface& programmed) {
    return spacings_of(program, programmed).usual;
}

std::vector<ResampledSegment> resample(const Program& program, const ProgrammedSurface& programmed,
                                       const LineEditor& editor, const ResampleRules& wanted,
                                       std::span<const std::uint8_t> needed, const Orientation* orientation) {
    const Spacings spacings = spacings_of(program, programmed);
    ResampleRules rules = wanted;
    if (rules.spacing <= 0) rules.spacing = fitting(spacings, rules.chord_error);
    if (rules.spacing <= 0 || rules.tolerance <= editor.rounding()) return {};
    return Resampler(program, programmed, editor, rules, spacings, needed, orientation).run();
}

}  // namespace clsurf
