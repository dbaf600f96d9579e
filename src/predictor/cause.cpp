#include "predictor/cause.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/not_finite.h"
#include "core/statistics.h"

namespace clsurf {
namespace {

// uneven_spacing, corner_arc_length, corner_cosine, lobes_of_oscillation, share_of_control: the causes of
// docs/predictor.md#output.
constexpr double uneven_spacing = 1.5;       ///< ratio of the programmed steps
constexpr LineNumber most_lines = 10'000;    ///< most lines of a run that are examined
constexpr double corner_arc_length = 0.3;    ///< [mm] over which a corner turns
constexpr float corner_cosine = 0.906F;      ///< cos 25°
constexpr double reversal_arc_length = 0.3;  ///< [mm] around the beginning of the run
constexpr float axis_moves = 0.01F;          ///< share of the feed; less is noise
constexpr float lobe = 0.4F;                 ///< share of the peak that a half-wave must reach
constexpr int lobes_of_oscillation = 3;
constexpr double share_of_control = 0.5;  ///< share of a relief that deviations from the program cause
constexpr double share_of_peak = 0.9;     ///< share of the depth from which on places count as highest
constexpr std::size_t examined = 16;      ///< approximate number of these places that are examined
// LinuxCNC joins up to 101 lines (docs/simulate.md#the-trapezoidal-planner).
constexpr std::int64_t merged =
    110;  ///< number of motions searched before and after that of a point, because a controller may merge so many

/// The largest number of half-waves of the speed about the speed of the neighbours, within one run.
int count_lobes(std::span<const DefectCandidate* const> sites) {
    float peak = 0;
    for (const DefectCandidate* s : sites) {
        const float r = std::abs(s->comparison.residual[index_of(Quantity::speed)]);
        if (r > peak) peak = r;
    }
    int most = 0;
    int lobes = 0;
    int sign = 0;
    std::size_t pass = std::numeric_limits<std::size_t>::max();
    for (const DefectCandidate* s : sites) {
        if (s->pass != pass) {
            pass = s->pass;
            lobes = 0;
            sign = 0;
        }
        const float r = s->comparison.residual[index_of(Quantity::speed)];
        if (!(std::abs(r) >= lobe * peak)) continue;
        const int now = r > 0 ? 1 : -1;
        if (now != sign) ++lobes;
        sign = now;
        most = std::max(most, lobes);
    }
    return most;
}

}  // namespace

std::string_view name_of(Cause cause) {
    switch (cause) {
        case Cause::feed_drop: return "feed_drop";
        case Cause::oscillation: return "oscillation";
        case Cause::lag_step: return "lag_step";
        case Cause::point_spacing: return "point_spacing";
        case Cause::corner: return "corner";
        case Cause::reversal: return "reversal";
        case Cause::pass_end: return "pass_end";
        case Cause::path_tolerance: return "path_tolerance";
    }
    return "";
}

std::string_view description_of(Cause cause) {
    switch (cause) {
        case Cause::feed_drop: return "runs at a different speed than the adjacent passes";
        case Cause::oscillation: return "its speed oscillates about that of the adjacent passes";
        case Cause::lag_step: return "axis lag differs from the adjacent passes";
        case Cause::point_spacing: return "programmed points are spaced differently from the adjacent passes";
        case Cause::corner: return "the programmed path turns here";
        case Cause::reversal: return "an axis reverses here";
        case Cause::pass_end: return "the pass begins or ends here";
        case Cause::path_tolerance:
            return "the controller deviates from the programmed path differently from adjacent passes";
    }
    return "";
}

double CauseFinder::spacing(std::span<const DefectSection> sections) const {
    std::vector<double> steps;
    for (const DefectSection& section : sections) {
        if (section.first_line == 0) continue;
        const LineNumber last = std::min(section.last_line, section.first_line + most_lines);
        for (LineNumber line = section.first_line; line <= last; ++line) {
            if (lines_.kind_of(line) != PointKind::cut) continue;
            for (const std::uint32_t motion : lines_.motions_of(line)) steps.push_back(toolpath_.length(motion));
        }
    }
    return steps.empty() ? 0 : median(steps);
}

bool CauseFinder::spaced_otherwise(const Defect& defect) const {
    const double own = spacing(defect.sections);
    const double beside = spacing(defect.neighbours);
    return own > 0 && beside > 0 && (own > uneven_spacing * beside || beside > uneven_spacing * own);
}

/// Height of the path above the programmed one at a point, along the normal [mm]; NaN: its motion is not known.
double CauseFinder::off_program(PointIndex point) const {
    const std::int64_t motion = lines_.motion_at(point);
    if (motion < 0) return missing<double>;
    const Vec3 at = surface_.positions.absolute(point);
    Vec3 nearest = at;
    double least = std::numeric_limits<double>::infinity();
    const std::int64_t end = std::min(toolpath_.size(), motion + merged + 1);
    for (std::int64_t k = std::max<std::int64_t>(0, motion - merged); k < end; ++k) {
        const Projection found = toolpath_.projection(k, at);
        if (found.distance < least) {
            least = found.distance;
            nearest = toolpath_.at(k, found.fraction);
        }
    }
    return signals_.normal(point).cast<double>().dot(at - nearest);
}

/// Whether most of a relief is not in the program. A relief is the height above the mean of both adjacent passes, so the
/// deviations from the program are compared in the same way: a controller that rounds off a programmed peak is below it at the
/// top, and above it at the bottom. Only the places with the largest relief count.
bool CauseFinder::leaves_program(const Defect& defect, std::span<const DefectCandidate* const> sites) const {
    const auto height = [](const DefectCandidate* s) {
        return static_cast<double>(s->comparison.residual[index_of(Quantity::relief)]);
    };
    std::vector<const DefectCandidate*> highest;
    for (const DefectCandidate* s : sites) {
        if ((defect.pit ? -height(s) : height(s)) >= share_of_peak * defect.depth) highest.push_back(s);
    }
    std::vector<double> shares;
    const std::size_t stride = 1 + highest.size() / examined;
    for (std::size_t k = 0; k < highest.size(); k += stride) {
        const Comparison& c = highest[k]->comparison;
        double beside = 0;
        for (const PathLocation& at : {c.adjacent_left, c.adjacent_right})
            beside += 0.5 * (at.exists() ? off_program(at.nearest()) : missing<double>);
        const double share = (off_program(highest[k]->point) - beside) / height(highest[k]);
        if (std::isfinite(share)) shares.push_back(share);
    }
    return !shares.empty() && median(shares) > share_of_control;
}

bool CauseFinder::turns(const DefectSection& section) const {
    PointIndex behind = section.points.first;
    for (PointIndex i = section.points.first; i <= section.points.last; ++i) {
        while (behind < i && arc_length_.at_least(behind, i, corner_arc_length)) ++behind;
        const float cosine = signals_.feed(behind).dot(signals_.feed(i));
        if (cosine < corner_cosine) return true;
    }
    return false;
}

bool CauseFinder::begins_with_reversal(const DefectSection& section) const {
    PointIndex from = section.points.first;
    while (from > 0 && !arc_length_.at_least(from, section.points.first, reversal_arc_length)) --from;
    const Eigen::Vector3f before = signals_.feed(from);
    PointIndex to = section.points.first;
    while (to < section.points.last && !arc_length_.at_least(section.points.first, to, reversal_arc_length)) ++to;
    const Eigen::Vector3f after = signals_.feed(to);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        if (before[axis] * after[axis] < 0 && std::min(std::abs(before[axis]), std::abs(after[axis])) > axis_moves)
            return true;
    }
    return false;
}

Cause CauseFinder::cause_of(const Defect& defect, std::span<const DefectCandidate* const> sites) const {
    if (defect.quantity == Quantity::relief && leaves_program(defect, sites)) return Cause::path_tolerance;
    if (defect.quantity == Quantity::relief ||
        (defect.quantity != Quantity::normal_deviation && spaced_otherwise(defect)))
        return Cause::point_spacing;
    const auto most_sections = [&](auto&& test) {
        const auto count = std::count_if(defect.sections.begin(), defect.sections.end(), test);
        return 2 * count > static_cast<std::ptrdiff_t>(defect.sections.size());
    };
    if (most_sections([&](const DefectSection& section) { return turns(section); })) return Cause::corner;
    if (defect.quantity == Quantity::normal_deviation) {
        if (most_sections([&](const DefectSection& section) { return begins_with_reversal(section); }))
            return Cause::reversal;
        return Cause::lag_step;
    }
    return count_lobes(sites) >= lobes_of_oscillation ? Cause::oscillation : Cause::feed_drop;
}

}  // namespace clsurf
