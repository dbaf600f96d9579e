#include "machined/part_roughness.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/block_portions.h"
#include "core/not_finite.h"
#include "machined/as_machined_profile.h"
#include "machined/form.h"
#include "machined/pass_ends.h"

namespace clsurf {
namespace {

// patches_wanted, patch_cutoffs, lines_across: docs/formed.md#definitions.
constexpr std::size_t patches_wanted = 24;
constexpr double profile_cutoffs = 6;  ///< five sampling lengths, and half of one at each end
constexpr double patch_cutoffs = 2;    ///< side of a patch
constexpr int lines_across = 6;        ///< profiles through a patch
constexpr int rows_in_two = 41;        ///< rows of a patch's cells in two step-overs

/// The section of the surface that is evaluated around a place. It is two cut-offs long along the feed. Across the feed it has
/// the even number of step-overs nearest to that length; even, because forward and backward passes may differ. If a window
/// ended inside a scallop, its mean and Sa would depend on where it ends. Its weights therefore rise over one step-over at each
/// edge. This is the mean over all windows that begin within one step-over, and an error of the step-over changes it in second
/// order only.
class PatchWindow {
public:
    PatchWindow(const RoughnessPlace& place, double cutoff)
        : middle_(place.across.at),
          across_(place.across.direction),
          apart_(place.apart > 0 ? place.apart : place.across.step_over),
          half_along_(0.5 * patch_cutoffs * cutoff),
          half_across_(apart_ * std::max(1.0, std::round(half_along_ / apart_))) {}

    [[nodiscard]] const Vec2& across() const { return across_; }
    /// Extent [mm] along the feed.
    [[nodiscard]] double length() const { return 2 * half_along_; }
    /// Extent [mm] across the feed with a weight of at least a half.
    [[nodiscard]] double width() const { return 2 * half_across_; }
    [[nodiscard]] Vec2 at(double along, double across) const {
        return middle_ + along * Vec2(across_.y(), -across_.x()) + across * across_;
    }
    /// Rows along the feed, as far as the weights reach, with the place in the middle. Two step-overs have 41 rows, so that the
    /// rows of one scallop are offset against those of the next one, and do not all miss the tips of the cusps.
    [[nodiscard]] MapFrame frame() const {
        const double cell = 2 * apart_ / rows_in_two;
        const auto columns = static_cast<std::int64_t>(half_along_ / cell);
        const auto rows = static_cast<std::int64_t>(reach_across() / cell);
        return {at(-static_cast<double>(columns) * cell, -static_cast<double>(rows) * cell),
                Vec2(across_.y(), -across_.x()), cell, 2 * columns + 1, 2 * rows + 1};
    }
    /// Distance [mm] between contacts of adjacent passes, seen from above.
    [[nodiscard]] double apart() const { return apart_; }
    /// Weights of the cells of such a frame: 0 for cells that the passes do not cut completely before they end.
    [[nodiscard]] std::vector<float> weights(const MapFrame& frame, const BeforePassEnds& before_ends) const {
        std::vector<float> result;
        for (std::int64_t row = 0; row < frame.rows; ++row) {
            const double aside =
                frame.cell * std::abs(static_cast<double>(row) - 0.5 * static_cast<double>(frame.rows - 1));
            const auto weight = static_cast<float>(std::clamp((half_across_ - aside) / apart_ + 0.5, 0.0, 1.0));
            for (std::int64_t column = 0; column < frame.columns; ++column) {
                const Vec2 place = frame.at(static_cast<double>(column), static_cast<double>(row));
                result.push_back(weight > 0 && before_ends.has(place) ? weight : 0);
            }
        }
        return result;
    }
    [[nodiscard]] Box2 bounds() const {
        Box2 box;
        for (const double along : {-half_along_, half_along_})
            for (const double across : {-reach_across(), reach_across()}) box.extend(at(along, across));
        return box;
    }

private:
    /// Distance [mm] from the middle to the edge of the window, where the weight is 0.
    [[nodiscard]] double reach_across() const { return half_across_ + 0.5 * apart_; }

    Vec2 middle_, across_;
    double apart_;                     ///< [mm] step-over, seen from above
    double half_along_, half_across_;  ///< [mm]
};

/// Height from the lowest place to the highest [mm] on lines across the feed through a window. Cells of a map resolve the tip
/// of a cusp only within a tenth of its height, and these lines within a hundredth.
double height_across(const AsMachinedSurface& as_machined, const Form& form, const BeforePassEnds& before_ends,
                     const PatchWindow& window, double step) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (int line = 0; line < lines_across; ++line) {
        const double off = ((line + 0.5) / lines_across - 0.5) * window.length();
        const MapFrame frame{window.at(off, -0.5 * window.width()), window.across(), step,
                             static_cast<std::int64_t>(window.width() / step) + 1, 1};
        map_deviation(as_machined, form, frame, [&](std::int64_t, std::span<float> z) {
            for (std::size_t k = 0; k < z.size(); ++k) {
                if (!std::isfinite(z[k]) || !before_ends.has(frame.at(static_cast<double>(k), 0))) continue;
                low = std::min(low, static_cast<double>(z[k]));
                high = std::max(high, static_cast<double>(z[k]));
            }
        });
    }
    return high > low ? high - low : 0;
}

/// Area parameters of a window, from its heights.
AreaHeights window_heights(const AsMachinedSurface& as_machined, const Form& form, const BeforePassEnds& before_ends,
                           const PatchWindow& window, double step, std::span<const float> weights,
                           std::vector<float> cells, double& unknown) {
    const MapFrame frame = window.frame();
    const auto unknown_cells = static_cast<double>(form.subtract(frame, 0, as_machined.level(), cells));
    const double cut =
        static_cast<double>(std::count_if(cells.begin(), cells.end(), [](float z) { return std::isfinite(z); })) +
        unknown_cells;
    unknown = cut > 0 ? unknown_cells / cut : 1;
    AreaHeights heights = area_heights(cells, weights);
    if (heights.cells > 0)
        heights.sz = std::max(heights.sz, height_across(as_machined, form, before_ends, window, step));
    return heights;
}

/// Evenly spaced points of cut passes that can be compared.
std::vector<PointIndex> spread_points(const Signals& signals) {
    std::vector<PointIndex> found;
    const auto count = signals.size();
    const auto inner = [&](PointIndex i) { return signals[i].zone >= Zone::near_end && signals.normal(i).allFinite(); };
    for (std::size_t k = 0; k < patches_wanted; ++k) {
        const auto first =
            static_cast<PointIndex>(static_cast<double>(count) * static_cast<double>(k) / patches_wanted);
        const auto end =
            static_cast<PointIndex>(static_cast<double>(count) * static_cast<double>(k + 1) / patches_wanted);
        // The search starts in the middle of each share, so that patches do not accumulate at the beginning of a pass.
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

/// The slope of a height map at a cell, as 1 / cosine, from differences of adjacent cells.
double steepness(std::span<const float> z, const MapFrame& frame, std::int64_t column, std::int64_t row) {
    const auto at = [&](std::int64_t c, std::int64_t r) {
        return static_cast<double>(z[static_cast<std::size_t>(r * frame.columns + c)]);
    };
    const auto slope = [&](double before, double here, double after) {
        if (std::isfinite(before) && std::isfinite(after)) return (after - before) / (2 * frame.cell);
        if (std::isfinite(after)) return (after - here) / frame.cell;
        return std::isfinite(before) ? (here - before) / frame.cell : 0.0;
    };
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const double here = at(column, row);
    const double along =
        slope(column > 0 ? at(column - 1, row) : none, here, column + 1 < frame.columns ? at(column + 1, row) : none);
    const double aside =
        slope(row > 0 ? at(column, row - 1) : none, here, row + 1 < frame.rows ? at(column, row + 1) : none);
    return std::sqrt(1 + along * along + aside * aside);
}

std::vector<float> heights_of(const AsMachinedSurface& as_machined, const MapFrame& frame) {
    std::vector<float> cells;
    as_machined.map(frame, [&](std::int64_t, std::span<float> z) { cells.insert(cells.end(), z.begin(), z.end()); });
    return cells;
}

/// Heights above `measured_from` [mm] minus those of a map of `commanded`, along the normal of the latter.
std::vector<float> take_off(const AsMachinedSurface& commanded, double measured_from, std::vector<float> heights,
                            const MapFrame& frame) {
    const std::vector<float> from = heights_of(commanded, frame);
    const double shift = measured_from - commanded.level();
    for (std::int64_t k = 0; k < static_cast<std::int64_t>(heights.size()); ++k) {
        const auto cell = static_cast<std::size_t>(k);
        const double steep = steepness(from, frame, k % frame.columns, k / frame.columns);
        heights[cell] = static_cast<float>((heights[cell] + shift - from[cell]) / steep);
    }
    return heights;
}

/// Whether a run has contact points on all sides of a place.
bool surrounds(const AsMachinedSurface& as_machined, const Vec2& at) {
    const Vec2 margin = Vec2::Constant(as_machined.surface().step_over);
    return Form(as_machined, Box2(at - margin, at + margin), Form::Of::contacts).is_among_contacts(at);
}

/// Whether the measured run cut around a place as far as the run that defines the places. A log may contain only a section of
/// the program, and beyond its outermost pass there is only the flank of the tool. Tests places along the profile, and the
/// corners of the window.
bool covers(const RoughnessSurfaces& surfaces, const RoughnessPlace& place, double cutoff) {
    constexpr int parts = 6;  ///< of the profile
    std::vector<Vec2> places;
    for (int k = 0; k <= parts; ++k)
        places.push_back(place.across.at +
                         (static_cast<double>(k) / parts - 0.5) * profile_cutoffs * cutoff * place.across.direction);
    const PatchWindow window(place, cutoff);
    for (const double along : {-0.5, 0.5})
        for (const double aside : {-0.5, 0.5})
            places.push_back(window.at(along * window.length(), aside * window.width()));
    return std::all_of(places.begin(), places.end(), [&](const Vec2& at) {
        return surrounds(surfaces.measured, at) || !surrounds(surfaces.form_of, at);
    });
}

RoughPatch measure_patch(const RoughnessSurfaces& surfaces, const RoughnessPlace& place, double cutoff) {
    RoughPatch patch;
    patch.point = place.point;
    patch.contact = place.contact;
    const bool own_places = &surfaces.measured == &surfaces.form_of;
    if (!own_places && !covers(surfaces, place, cutoff)) {
        patch.unknown = 1;
        return patch;
    }
    const AcrossFeed& across = place.across;
    const Vec2 half = 0.5 * profile_cutoffs * cutoff * across.direction;
    patch.profile = measure_profile(surfaces.measured, surfaces.form_of, across.at - half, across.at + half).roughness;
    const PatchWindow window(place, cutoff);
    const Form form(surfaces.form_of, window.bounds());
    const AsMachinedSurface& measured = surfaces.measured;
    const MapFrame frame = window.frame();
    std::vector<float> heights = heights_of(measured, frame);
    const BeforePassEnds before_ends(form, measured.tool(), window.apart(), frame, heights);
    const std::vector<float> weights = window.weights(frame, before_ends);
    const double step = across.step_over / steps_per_pass;
    patch.area = window_heights(measured, form, before_ends, window, step, weights, heights, patch.unknown);
    if (surfaces.commanded == nullptr) return patch;
    patch.machine = area_heights(take_off(*surfaces.commanded, measured.level(), std::move(heights), frame), weights);
    return patch;
}

/// Computes means and extremes of the patches.
void sum_up(PartRoughness& result, const std::vector<RoughPatch>& patches) {
    double known_patches = 0, patches_of_machine = 0;
    for (const RoughPatch& patch : patches) {
        result.unknown += patch.unknown / static_cast<double>(patches.size());
        if (patch.machine.cells > 0) {
            ++patches_of_machine;
            result.machine.sa += patch.machine.sa;
            result.machine.sq += patch.machine.sq;
            result.machine.sz = std::max(result.machine.sz, patch.machine.sz);
            result.machine.cells += patch.machine.cells;
        }
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
    for (double* sum : {&result.machine.sa, &result.machine.sq}) *sum /= std::max(1.0, patches_of_machine);
    if (result.patches.empty()) return;
    for (double* sum : {&result.ra, &result.rz, &result.sa, &result.sq}) *sum /= known_patches;
}

/// Distance, seen from above, to the contacts of the neighbours on both sides [mm]; 0: there are none, or it differs too much
/// from the step-over.
double contact_spacing(const AsMachinedSurface& as_machined, PointIndex point, const AcrossFeed& across) {
    const Adjacency& neighbours = as_machined.surface().neighbours;
    double sum = 0;
    int sides = 0;
    for (const Side side : {Side::left, Side::right}) {
        if (!neighbours.has(side, point)) continue;
        const Vec2 beside = as_machined.contact(neighbours.neighbour(side, point)).head<2>();
        const double distance = std::abs((beside - across.at).dot(across.direction));
        if (!std::isfinite(distance)) continue;
        sum += distance;
        ++sides;
    }
    constexpr double usual = 2;
    const double apart = sides > 0 ? sum / sides : 0;
    return apart > across.step_over / usual && apart < across.step_over * usual ? apart : 0;
}

}  // namespace

std::vector<RoughnessPlace> roughness_places(const AsMachinedSurface& as_machined, const Signals& signals) {
    std::vector<RoughnessPlace> places;
    if (as_machined.surface().step_over <= 0) return places;
    for (const PointIndex point : spread_points(signals)) {
        const AcrossFeed across = across_feed(as_machined, signals, point);
        if (!across.known) continue;
        places.push_back({point, as_machined.contact(point), across, contact_spacing(as_machined, point, across)});
    }
    return places;
}

std::vector<float> deviation_from(const AsMachinedSurface& commanded, const AsMachinedSurface& measured,
                                  const MapFrame& frame) {
    return take_off(commanded, measured.level(), heights_of(measured, frame), frame);
}

PartRoughness measure_roughness(const RoughnessSurfaces& surfaces, std::span<const RoughnessPlace> places,
                                const ForgetBlocks& forget) {
    PartRoughness result;
    result.cutoff = cutoff_for(surfaces.form_of.surface().step_over);
    std::vector<RoughPatch> patches(places.size());
    for_each_at_once(places.size(), forget,
                     [&](std::size_t k) { patches[k] = measure_patch(surfaces, places[k], result.cutoff); });
    sum_up(result, patches);
    return result;
}

void keep_common_patches(PartRoughness& a, PartRoughness& b) {
    const auto among = [](const std::vector<RoughPatch>& patches, PointIndex point) {
        return std::any_of(patches.begin(), patches.end(), [&](const RoughPatch& p) { return p.point == point; });
    };
    const auto kept = [&](const PartRoughness& of, const PartRoughness& other) {
        PartRoughness result;
        result.cutoff = of.cutoff;
        std::vector<RoughPatch> patches;
        for (const RoughPatch& patch : of.patches)
            if (among(other.patches, patch.point)) patches.push_back(patch);
        sum_up(result, patches);
        return result;
    };
    const auto same = [](const RoughPatch& p, const RoughPatch& q) { return p.point == q.point; };
    if (std::equal(a.patches.begin(), a.patches.end(), b.patches.begin(), b.patches.end(), same)) return;
    PartRoughness of_a = kept(a, b);
    b = kept(b, a);
    a = std::move(of_a);
}

}  // namespace clsurf
