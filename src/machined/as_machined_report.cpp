#include "machined/as_machined_report.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/block_portions.h"
#include "core/not_finite.h"
#include "core/statistics.h"
#include "machined/across_feed.h"
#include "machined/scallop.h"

namespace clsurf {
namespace {

// A bound on the time. The median of 10,000 independent samples has a standard error of 1.3 % of their standard deviation.
constexpr PointIndex scallop_places = 10'000;
// passes_aside, mark_tolerance, agreement, agreement_share: docs/formed.md#definitions.
constexpr double passes_aside = 6.5;  ///< step-overs per side of a mark's profile: most pairs miss a mark of two passes
constexpr double mark_within = 1.0;   ///< step-overs: largest distance of a mark from the middle
constexpr double coarse_spread = 0.001;   ///< [mm] sections of an even surface differ by less
constexpr double certain_share = 0.5;     ///< share of a depth: largest spread of its reference level
constexpr double mark_tolerance = 0.25;   ///< share of a mark's depth: tolerance of contact points about the form
constexpr double agreement = 0.002;       ///< [mm] between the depth of a pass alone and the as-machined one …
constexpr double agreement_share = 0.3;   ///< … or this share of it
constexpr std::size_t fewest_pairs = 2;   ///< fewest pairs in a mark's profile …
constexpr std::size_t fewest_pieces = 4;  ///< … or pieces of one pair

/// The usual value around the middle of a row, and its uncertainty.
struct Level {
    double value = missing<double>, spread = 0;
};

Level level_of(std::vector<double> values) {
    const Spread spread = robust_spread(values);
    return {spread.median, spread.deviation};
}

/// The usual value in the middle of a row: the median of means of two values at equal distances on both sides, so that an even
/// change across the row cancels. If these scatter by more than `coarse`, only every second pass counts, because it has the
/// direction of the middle one. If a border leaves too few of them, the level is the median of all known values; NaN if these
/// are also too few.
Level usual(const std::vector<double>& row, double coarse) {
    std::vector<double> means;
    std::vector<double> alike;
    std::vector<double> known;
    const std::size_t middle = row.size() / 2;
    for (std::size_t k = 0; k < row.size(); ++k) {
        if (std::isfinite(row[k])) known.push_back(row[k]);
        const double mean = 0.5 * (row[k] + row[row.size() - 1 - k]);
        if (k >= middle || !std::isfinite(mean)) continue;
        means.push_back(mean);
        if ((middle - k) % 2 == 0) alike.push_back(mean);
    }
    Level middle_level;
    if (means.size() >= fewest_pairs) {
        middle_level = level_of(means);
        if (middle_level.spread > coarse && alike.size() >= fewest_pairs) middle_level = level_of(alike);
    } else if (known.size() >= fewest_pieces) {
        middle_level = level_of(known);
    }
    return middle_level;
}

/// Whether the depth in the as-machined surface is what the pass alone would leave.
bool agree(double as_machined, double alone) {
    return std::abs(as_machined - alone) <= std::max(agreement, agreement_share * alone);
}

double median_or_none(std::vector<double> heights) { return heights.empty() ? 0 : median(heights); }

/// Adds the note to a mark, by the depth that its pass alone would leave.
AsMachinedMark with_note(AsMachinedMark mark, const Defect& defect) {
    const double alone = std::abs(defect.depth);
    if (!std::isfinite(mark.depth) || mark.note != MarkNote::none || agree(mark.depth, alone)) return mark;
    mark.note = !defect.pit && mark.depth < alone ? MarkNote::cut_away : MarkNote::other_passes;
    return mark;
}

}  // namespace

AsMachinedMark mark_depth(std::span<const double> deviation, double step, double step_over, bool pit) {
    const auto piece = static_cast<std::size_t>(std::max(1.0, std::round(step_over / step)));
    std::vector<double> levels;
    for (std::size_t first = 0; first + piece <= deviation.size(); first += piece) {
        const auto part = deviation.subspan(first, piece);
        const bool known = std::all_of(part.begin(), part.end(), [](double v) { return std::isfinite(v); });
        const auto [low, high] = std::minmax_element(part.begin(), part.end());
        levels.push_back(known ? (pit ? *low : *high) : missing<double>);
    }
    const double middle = 0.5 * static_cast<double>(deviation.size() - 1);
    double most = missing<double>;
    for (std::size_t k = 0; k < deviation.size(); ++k) {
        if (!std::isfinite(deviation[k]) || std::abs(static_cast<double>(k) - middle) * step > mark_within * step_over)
            continue;
        if (!std::isfinite(most) || (pit ? deviation[k] < most : deviation[k] > most)) most = deviation[k];
    }
    const Level usual_level = usual(levels, coarse_spread);
    if (!std::isfinite(usual_level.value) || !std::isfinite(most)) return {missing<double>, MarkNote::unknown_form};
    const double depth = std::max(0.0, pit ? usual_level.value - most : most - usual_level.value);
    if (usual_level.spread > coarse_spread && usual_level.spread > certain_share * depth)
        return {missing<double>, MarkNote::uneven_passes};
    return {depth, MarkNote::none};
}

Form::Of form_about_mark(const AsMachinedSurface& as_machined, PointIndex point) {
    // Contact points with the mark subtracted still have the normals of the marked program.
    if (as_machined.knows_program() && !as_machined.marks().at(point).isZero(0)) return Form::Of::program;
    // A form of the program includes programmed marks that were not found, so a form of the contacts is better where there is
    // one. If the measured passes are the programmed ones, the contacts are the only form.
    return as_machined.follows_surface() ? Form::Of::contacts : Form::Of::contacts_and_program;
}

std::string_view name_of(MarkNote note) {
    switch (note) {
        case MarkNote::none: return "";
        case MarkNote::unknown_form: return "unknown_form";
        case MarkNote::uneven_passes: return "uneven_passes";
        case MarkNote::cut_away: return "cut_away";
        case MarkNote::other_passes: return "other_passes";
    }
    return "";
}

std::vector<double> scallop_heights(const ClSurface& surface, const Signals& signals, const CuttingTool& tool,
                                    const PointRange& points) {
    std::vector<double> heights;
    if (tool.kind != ToolKind::ball) return heights;
    const double ball = tool.radius;
    const Adjacency& neighbours = surface.neighbours;
    const PointIndex stride = std::max<PointIndex>(1, signals.size() / scallop_places);
    for (PointIndex i = (points.first + stride - 1) / stride * stride; i <= points.last; i += stride) {
        const Vec3 here = contact_at(surface, signals, tool, i);
        if (signals[i].zone < Zone::near_end || !here.allFinite()) continue;
        const Vec3 feed = signals.feed(i).cast<double>();
        for (const Side side : {Side::left, Side::right}) {
            if (!neighbours.has(side, i)) continue;
            const PointIndex j = neighbours.neighbour(side, i);
            Vec3 apart = contact_at(surface, signals, tool, j) - here;
            apart -= apart.dot(feed) * feed;
            const double chord = apart.norm();
            const double turn = (signals.normal(j) - signals.normal(i)).cast<double>().dot(apart);
            const double height = cusp_height(ball, chord, turn);
            if (std::isfinite(height)) heights.push_back(height);
        }
    }
    return heights;
}

double usual_scallop(const AsMachinedSurface& as_machined, const Signals& signals) {
    return median_or_none(scallop_heights(as_machined.surface(), signals, as_machined.tool(), {0, signals.size() - 1}));
}

namespace {

AsMachinedMark mark_of(const AsMachinedSurface& as_machined, const Signals& signals, const Defect& defect) {
    const AcrossFeed across = across_feed(as_machined, signals, defect.point);
    if (!across.known) return {missing<double>, MarkNote::unknown_form};
    const double step = across.step_over / steps_per_pass;
    const ProfileRow row{across.at - passes_aside * across.step_over * across.direction, across.direction, step,
                         static_cast<std::int64_t>(2 * passes_aside * steps_per_pass) + 1};
    const Form::Of of = form_about_mark(as_machined, defect.point);
    const std::vector<double> deviations =
        deviations_along(as_machined, as_machined, row, of, mark_tolerance * std::abs(defect.depth)).deviation;
    return with_note(mark_depth(deviations, step, across.step_over, defect.pit), defect);
}

}  // namespace

AsMachinedReport measure_as_machined(const AsMachinedSurface& as_machined, const Signals& signals,
                                     const QualityReport& report, const AsMachinedSurface* commanded,
                                     const std::vector<double>* scallops, const ForgetBlocks& forget) {
    AsMachinedReport result;
    result.marks.assign(report.defects.size(), AsMachinedMark{missing<double>, MarkNote::unknown_form});
    if (as_machined.surface().step_over <= 0) return result;
    result.roughness =
        measure_roughness({as_machined, as_machined, commanded}, roughness_places(as_machined, signals), forget);
    result.scallop = scallops != nullptr ? median_or_none(*scallops) : usual_scallop(as_machined, signals);
    for_each_at_once(report.defects.size(), forget,
                     [&](std::size_t k) { result.marks[k] = mark_of(as_machined, signals, report.defects[k]); });
    return result;
}

}  // namespace clsurf
