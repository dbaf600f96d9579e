#include "machined/as_machined_report.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/not_finite.h"
#include "core/parallel.h"
#include "core/statistics.h"
#include "machined/scallop.h"

namespace clsurf {
namespace {

constexpr double steps_per_pass = 200;  ///< a cusp's tip is then met to a hundredth of its height
constexpr std::size_t patches_wanted = 24;
constexpr PointIndex scallop_places = 10'000;
constexpr double profile_cutoffs = 6;  ///< five sampling lengths and half of one at both ends
constexpr double patch_cutoffs = 2;    ///< side of a patch
constexpr int lines_across = 6;        ///< through a patch
constexpr double passes_aside = 6.5;  ///< of a mark's profile: a mark of two passes leaves most pairs of it as they are
constexpr double mark_within = 1.0;   ///< step-overs from the middle that the mark lies in
constexpr double coarse_spread = 0.001;  ///< [mm] by which pieces of an even surface do not differ
constexpr double certain_share = 0.5;    ///< of a depth: spread of the level that it is measured from
constexpr double mark_tolerance = 0.25;  ///< of a mark's depth: so far contact points may lie from the form about it
constexpr double agreement = 0.002;      ///< [mm] between the depth of a pass alone and the as-machined one …
constexpr double agreement_share = 0.3;  ///< … or this share of it
constexpr double normal_mad = 1.4826;    ///< standard deviation over median absolute deviation of a normal distribution
constexpr std::size_t fewest_pairs = 2;  ///< of a mark's profile …
constexpr std::size_t fewest_pieces = 4;  ///< … or pieces of one

/// Deviations of a row of a map that begins at `from`; `tolerance` as of Form.
std::vector<double> row_of(const AsMachinedSurface& as_machined, const Vec2& from, const Vec2& along, double step,
                           std::int64_t count, double tolerance = 0) {
    const MapFrame frame{from, along, step, count, 1};
    const Form form(as_machined, frame.bounds(0, 0, count, 1), tolerance);
    std::vector<double> row;
    map_deviation(as_machined, form, frame, [&](std::int64_t, std::span<float> z) { row.assign(z.begin(), z.end()); });
    return row;
}

/// Across the feed in the plane, and the step-over as it is seen from above: on a slope it is shorter.
struct Across {
    Vec2 at = Vec2::Zero(), direction = Vec2::UnitY();
    double step_over = 0;
    bool known = false;
};

Across across_at(const AsMachinedSurface& as_machined, const Signals& signals, PointIndex point) {
    Across a;
    const Eigen::Vector3f feed = signals.feed(point);
    const Vec3 contact = as_machined.contact(point);
    const Vec2 flat = feed.head<2>().cast<double>();
    if (!contact.allFinite() || !feed.allFinite() || flat.norm() < 0.1) return a;
    a.at = contact.head<2>();
    a.direction = Vec2(-flat.y(), flat.x()).normalized();
    // The direction across that lies in the surface.
    const Vec3 in_surface = signals.normal(point).cross(feed).cast<double>();
    a.step_over = as_machined.surface().step_over *
                  std::clamp(in_surface.head<2>().norm() / std::max(in_surface.norm(), 1e-9), 0.2, 1.0);
    a.known = true;
    return a;
}

/// From the lowest place to the highest [mm] on lines across the feed through a square: cells of a map meet the tip of a
/// cusp within a tenth of its height only, and these within a hundredth.
double height_across(const AsMachinedSurface& as_machined, const Form& form, const Box2& box, const Across& across) {
    const Vec2 along(across.direction.y(), -across.direction.x());
    const double side = box.sizes().x();
    const double step = across.step_over / steps_per_pass;
    // The whole square where the feed runs along a side of it, else the circle in it.
    constexpr double along_side = 0.99;
    const bool whole = std::max(std::abs(along.x()), std::abs(along.y())) > along_side;
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (int line = 0; line < lines_across; ++line) {
        const double off = ((line + 0.5) / lines_across - 0.5) * side;
        const double half = along_side * (whole ? 0.5 * side : std::sqrt(0.25 * side * side - off * off));
        const MapFrame frame{box.center() + off * along - half * across.direction, across.direction, step,
                             static_cast<std::int64_t>(2 * half / step) + 1, 1};
        map_deviation(as_machined, form, frame, [&](std::int64_t, std::span<float> z) {
            for (const float value : z) {
                if (!std::isfinite(value)) continue;
                low = std::min(low, static_cast<double>(value));
                high = std::max(high, static_cast<double>(value));
            }
        });
    }
    return high > low ? high - low : 0;
}

/// Of a square about a place.
AreaHeights square_heights(const AsMachinedSurface& as_machined, const Form& form, const Box2& box,
                           const Across& across, double& unknown) {
    std::vector<float> cells;
    const auto unknown_cells = static_cast<double>(
        map_deviation(as_machined, form, frame_of(box, as_machined.usual_cell()),
                      [&](std::int64_t, std::span<float> z) { cells.insert(cells.end(), z.begin(), z.end()); }));
    AreaHeights heights = area_heights(cells);
    if (heights.cells > 0) heights.sz = std::max(heights.sz, height_across(as_machined, form, box, across));
    const double cut = unknown_cells + static_cast<double>(heights.cells);
    unknown = cut > 0 ? unknown_cells / cut : 1;
    return heights;
}

/// Evenly spaced points of cut passes that can be compared, by number.
std::vector<PointIndex> spread_points(const Signals& signals) {
    std::vector<PointIndex> found;
    const auto count = signals.size();
    const auto inner = [&](PointIndex i) { return signals[i].zone >= Zone::near_end && signals.normal(i).allFinite(); };
    for (std::size_t k = 0; k < patches_wanted; ++k) {
        const auto first =
            static_cast<PointIndex>(static_cast<double>(count) * static_cast<double>(k) / patches_wanted);
        const auto end =
            static_cast<PointIndex>(static_cast<double>(count) * static_cast<double>(k + 1) / patches_wanted);
        // From the middle of its share on, so that patches do not crowd where a pass begins.
        const PointIndex middle = (first + end) / 2;
        PointIndex i = middle;
        while (i < end && !inner(i)) ++i;
        if (i == end) {
            i = first;
            while (i < middle && !inner(i)) ++i;
            if (i == middle) continue;
        }
        found.push_back(i);
    }
    return found;
}

/// What is usual about the middle of a row, and how far it is certain.
struct Level {
    double value = missing<double>, spread = 0;
};

/// The median, and how far the values scatter about it (1.4826 times the median absolute deviation).
Level level_of(std::vector<double> values) {
    Level middle_level{median(values), 0};
    for (double& value : values) value = std::abs(value - middle_level.value);
    middle_level.spread = normal_mad * median(values);
    return middle_level;
}

/// The value that is usual in the middle of a row: of means of two as far from it on either side, so that
/// what changes evenly across the row drops out. Where they scatter by more than `coarse`, only those of
/// every second pass, which runs like the one in the middle. At a border, where there are too few of these,
/// of all values that are known; NaN where those are too few.
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

/// Whether the depth in the as-machined surface is that of the pass alone, as far as both are known.
bool agree(double as_machined, double alone) {
    return std::abs(as_machined - alone) <= std::max(agreement, agreement_share * alone);
}

/// What there is to say of a mark whose pass alone would leave `alone` mm.
AsMachinedMark with_note(AsMachinedMark mark, const Defect& defect) {
    const double alone = std::abs(defect.depth);
    if (!std::isfinite(mark.depth) || mark.note != MarkNote::none || agree(mark.depth, alone)) return mark;
    mark.note = !defect.pit && mark.depth < alone ? MarkNote::cut_away : MarkNote::other_passes;
    return mark;
}

}  // namespace

AsMachinedProfile measure_profile(const AsMachinedSurface& as_machined, const Vec2& from, const Vec2& to) {
    AsMachinedProfile profile;
    const double length = (to - from).norm();
    const double spacing =
        as_machined.surface().step_over > 0 ? as_machined.surface().step_over : 20 * as_machined.usual_cell();
    const auto pieces = static_cast<std::int64_t>(std::max(1.0, std::ceil(length * steps_per_pass / spacing)));
    profile.step = length / static_cast<double>(pieces);
    profile.deviation = row_of(as_machined, from, (to - from) / length, profile.step, pieces + 1);
    std::size_t run = 0;
    for (std::size_t k = 0; k < profile.deviation.size(); ++k) {
        run = std::isfinite(profile.deviation[k]) ? run + 1 : 0;
        if (run > profile.count) {
            profile.count = run;
            profile.first = k + 1 - run;
        }
    }
    profile.roughness = roughness_of(std::span(profile.deviation).subspan(profile.first, profile.count), profile.step,
                                     cutoff_for(as_machined.surface().step_over));
    return profile;
}

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

double usual_scallop(const AsMachinedSurface& as_machined, const Signals& signals) {
    if (as_machined.tool().kind != ToolKind::ball) return 0;
    const double ball = as_machined.tool().radius;
    const Adjacency& neighbours = as_machined.surface().neighbours;
    const PointIndex stride = std::max<PointIndex>(1, signals.size() / scallop_places);
    std::vector<double> heights;
    for (PointIndex i = 0; i < signals.size(); i += stride) {
        const Vec3 here = as_machined.contact(i);
        if (signals[i].zone < Zone::near_end || !here.allFinite()) continue;
        const Vec3 feed = signals.feed(i).cast<double>();
        for (const Side side : {Side::left, Side::right}) {
            if (!neighbours.has(side, i)) continue;
            const PointIndex j = neighbours.neighbour(side, i);
            Vec3 apart = as_machined.contact(j) - here;
            apart -= apart.dot(feed) * feed;
            const double chord = apart.norm();
            const double turn = (signals.normal(j) - signals.normal(i)).cast<double>().dot(apart);
            if (!std::isfinite(turn) || !(chord > 0) || chord >= 2 * ball) continue;
            const double curvature = turn / (chord * chord);  // > 0: normals spread, the surface is convex
            if (curvature * ball <= -1) continue;             // the ball would gouge: no closed form
            heights.push_back(
                scallop_height(ball, chord, curvature != 0 ? 1 / curvature : std::numeric_limits<double>::infinity()));
        }
    }
    return heights.empty() ? 0 : median(heights);
}

namespace {

/// What is measured at one place after the other.
struct PlaceMeter {
    const AsMachinedSurface& as_machined;
    const Signals& signals;
    double cutoff;

    /// Nothing measured: its profile has no length.
    [[nodiscard]] RoughPatch patch(PointIndex point) const {
        RoughPatch patch;
        const Across across = across_at(as_machined, signals, point);
        if (!across.known) return patch;
        patch.point = point;
        patch.contact = as_machined.contact(point);
        const Vec2 half = 0.5 * profile_cutoffs * cutoff * across.direction;
        patch.profile = measure_profile(as_machined, across.at - half, across.at + half).roughness;
        const Vec2 corner = Vec2::Constant(0.5 * patch_cutoffs * cutoff);
        const Box2 box(across.at - corner, across.at + corner);
        const Form form(as_machined, box);
        patch.area = square_heights(as_machined, form, box, across, patch.unknown);
        return patch;
    }

    [[nodiscard]] AsMachinedMark mark(const Defect& defect) const {
        const Across across = across_at(as_machined, signals, defect.point);
        if (!across.known) return {missing<double>, MarkNote::unknown_form};
        const double step = across.step_over / steps_per_pass;
        const auto count = static_cast<std::int64_t>(2 * passes_aside * steps_per_pass) + 1;
        const Vec2 from = across.at - passes_aside * across.step_over * across.direction;
        const std::vector<double> row =
            row_of(as_machined, from, across.direction, step, count, mark_tolerance * std::abs(defect.depth));
        return with_note(mark_depth(row, step, across.step_over, defect.pit), defect);
    }
};

/// Means and extremes of the patches.
void sum_up(AsMachinedReport& result, const std::vector<RoughPatch>& patches) {
    double known_patches = 0;
    for (const RoughPatch& patch : patches) {
        result.unknown += patch.unknown / static_cast<double>(patches.size());
        if (patch.profile.length <= 0 || patch.area.cells == 0) continue;
        result.patches.push_back(patch);
        if (patch.profile.rz > result.patches[result.roughest].profile.rz) result.roughest = result.patches.size() - 1;
        ++known_patches;
        result.ra += patch.profile.ra;
        result.rz += patch.profile.rz;
        result.sa += patch.area.sa;
        result.sq += patch.area.sq;
        result.sz = std::max(result.sz, patch.area.sz);
    }
    if (result.patches.empty()) return;
    for (double* sum : {&result.ra, &result.rz, &result.sa, &result.sq}) *sum /= known_patches;
}

}  // namespace

AsMachinedReport measure_as_machined(const AsMachinedSurface& as_machined, const Signals& signals,
                                     const QualityReport& report) {
    AsMachinedReport result;
    result.marks.assign(report.defects.size(), AsMachinedMark{missing<double>, MarkNote::unknown_form});
    const double s = as_machined.surface().step_over;
    if (s <= 0) return result;
    result.cutoff = cutoff_for(s);
    result.scallop = usual_scallop(as_machined, signals);
    const PlaceMeter places{as_machined, signals, result.cutoff};
    const std::vector<PointIndex> points = spread_points(signals);
    std::vector<RoughPatch> patches(points.size());
    parallel_for(static_cast<std::int64_t>(points.size() + report.defects.size()), 1,
                 [&](std::int64_t begin, std::int64_t end) {
                     for (std::int64_t k = begin; k < end; ++k) {
                         const auto at = static_cast<std::size_t>(k);
                         if (at < points.size()) {
                             patches[at] = places.patch(points[at]);
                         } else {
                             const std::size_t mark = at - points.size();
                             result.marks[mark] = places.mark(report.defects[mark]);
                         }
                     }
                 });
    sum_up(result, patches);
    return result;
}

}  // namespace clsurf
