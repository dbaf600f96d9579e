#include "measured/compare_measured.h"

#include <algorithm>
#include <cmath>

#include "core/not_finite.h"
#include "core/parallel.h"
#include "core/statistics.h"
#include "machined/form.h"

namespace clsurf {
namespace {

constexpr double steps_of_pass = 1000;  ///< most steps of a profile per step-over: more have no effect
// See docs/howto/measured.md#the-comparison.
constexpr int map_profiles = 11;
constexpr double map_share = 0.9;          ///< share of the extent of a map over which its profiles are distributed
constexpr double steps_of_short_wave = 2;  ///< steps that a filter of a short wave needs; two for each wave: Nyquist

/// The deviations of heights along a row [mm] from a form.
std::vector<double> over_form(std::vector<double> heights, const Form& form, const MapFrame& frame, double level) {
    std::vector<float> z(heights.size());
    for (std::size_t k = 0; k < z.size(); ++k) z[k] = static_cast<float>(heights[k] - level);
    (void)form.subtract(frame, 0, level, z);
    return {z.begin(), z.end()};
}

/// Removes waves shorter than `cutoff`; NaN stays NaN.
void take_off_short_waves(std::vector<double>& z, std::span<const double> along, double cutoff) {
    for (std::size_t first = 0; first < z.size();) {
        std::size_t end = first;
        while (end < z.size() && std::isfinite(z[end])) ++end;
        if (end > first) {
            const std::vector<double> smooth =
                gaussian_mean_line(std::span(z).subspan(first, end - first), along.subspan(first, end - first), cutoff);
            std::copy(smooth.begin(), smooth.end(), z.begin() + static_cast<std::ptrdiff_t>(first));
        }
        first = end + 1;
    }
}

void find_longest_section(ComparedProfile& profile) {
    std::size_t run = 0;
    for (std::size_t k = 0; k < profile.measured.size(); ++k) {
        run = std::isfinite(profile.measured[k]) && std::isfinite(profile.predicted[k]) ? run + 1 : 0;
        if (run <= profile.count) continue;
        profile.count = run;
        profile.first = k + 1 - run;
    }
}

std::vector<double> roughness_profile(std::span<const double> z, std::span<const double> along, double cutoff) {
    std::vector<double> rough = gaussian_mean_line(z, along, cutoff);
    for (std::size_t k = 0; k < rough.size(); ++k) rough[k] = z[k] - rough[k];
    return rough;
}

/// Correlation of the middle `used` values.
double correlation_of(std::span<const double> a, std::span<const double> b, std::size_t used) {
    const std::size_t first = (a.size() - std::min(used, a.size())) / 2;
    const auto n = static_cast<double>(used);
    double mean_a = 0;
    double mean_b = 0;
    for (std::size_t k = first; k < first + used; ++k) {
        mean_a += a[k] / n;
        mean_b += b[k] / n;
    }
    double both = 0;
    double squares_a = 0;
    double squares_b = 0;
    for (std::size_t k = first; k < first + used; ++k) {
        both += (a[k] - mean_a) * (b[k] - mean_b);
        squares_a += (a[k] - mean_a) * (a[k] - mean_a);
        squares_b += (b[k] - mean_b) * (b[k] - mean_b);
    }
    const double product = std::sqrt(squares_a * squares_b);
    return product > 0 ? both / product : 0;
}

void evaluate(ComparedProfile& profile, double cutoff, double short_cutoff) {
    if (short_cutoff > 0) {
        take_off_short_waves(profile.measured, profile.along, short_cutoff);
        take_off_short_waves(profile.predicted, profile.along, short_cutoff);
    }
    find_longest_section(profile);
    if (profile.count < 2) return;
    const auto measured = std::span(profile.measured).subspan(profile.first, profile.count);
    const auto predicted = std::span(profile.predicted).subspan(profile.first, profile.count);
    const auto along = std::span<const double>(profile.along).subspan(profile.first, profile.count);
    profile.of_measured = roughness_of(measured, along, cutoff);
    profile.of_predicted = roughness_of(predicted, along, cutoff);
    profile.measured_rough = roughness_profile(measured, along, cutoff);
    profile.predicted_rough = roughness_profile(predicted, along, cutoff);
    const double step = (along.back() - along.front()) / static_cast<double>(profile.count - 1);
    const auto used = std::min(profile.count, static_cast<std::size_t>(std::lround(profile.of_measured.length / step)));
    profile.correlation = correlation_of(profile.measured_rough, profile.predicted_rough, used);
}

/// The direction across the feed at the point of a cut pass whose contact is nearest to a place.
AcrossFeed nearest_across(const AsMachinedSurface& as_machined, const Signals& signals, const Vec2& place) {
    AcrossFeed nearest;
    double least = infinite;
    const Box2 box(place, place);
    for (const PointRange& range : as_machined.points_near(box, as_machined.tool().radius)) {
        for (PointIndex i = range.first; i <= range.last; ++i) {
            const Vec3 contact = as_machined.contact(i);
            const double distance = (contact.head<2>() - place).norm();
            if (!(distance < least)) continue;
            const AcrossFeed across = across_feed(as_machined, signals, i);
            if (!across.known) continue;
            least = distance;
            nearest = across;
        }
    }
    return nearest;
}

/// Rows across the feed through a map, each from edge to edge.
std::vector<ProfileRow> rows_of_map(const MeasuredData& data, const AlignedHeights& measured, const AcrossFeed& across,
                                    double least_step) {
    const double step = std::max(measured.spacing(), least_step);
    const Vec2 extent =
        data.spacing.cwiseProduct(Vec2(static_cast<double>(data.columns), static_cast<double>(data.rows)));
    const Vec2 feed(across.direction.y(), -across.direction.x());
    const auto half = static_cast<std::int64_t>(0.5 * extent.norm() / step) + 1;
    std::vector<ProfileRow> rows;
    for (int line = 0; line < map_profiles; ++line) {
        const double off = ((line + 0.5) / map_profiles - 0.5) * map_share * extent.minCoeff();
        const Vec2 middle = measured.middle() + off * feed;
        std::int64_t first = -half;
        std::int64_t last = half;
        const auto known = [&](std::int64_t k) {
            return std::isfinite(measured.at(middle + static_cast<double>(k) * step * across.direction));
        };
        while (first < last && !known(first)) ++first;
        while (last > first && !known(last)) --last;
        if (last - first < 2) continue;
        rows.push_back(
            {middle + static_cast<double>(first) * step * across.direction, across.direction, step, last - first + 1});
    }
    return rows;
}

void sum_up(MeasuredComparison& result) {
    std::vector<double> off;
    double known = 0;
    for (const ComparedProfile& profile : result.profiles) {
        if (profile.of_measured.length <= 0) continue;
        ++known;
        const auto add = [](Roughness& sum, const Roughness& one) {
            sum.ra += one.ra;
            sum.rq += one.rq;
            sum.rz += one.rz;
            sum.length = one.length;
            sum.sampling_lengths = one.sampling_lengths;
            sum.cutoff = one.cutoff;
        };
        add(result.measured, profile.of_measured);
        add(result.predicted, profile.of_predicted);
        result.correlation += profile.correlation;
        for (std::size_t k = 0; k < profile.count; ++k)
            off.push_back(profile.measured_rough[k] - profile.predicted_rough[k]);
    }
    if (known == 0) return;
    for (Roughness* sum : {&result.measured, &result.predicted}) {
        sum->ra /= known;
        sum->rq /= known;
        sum->rz /= known;
    }
    result.correlation /= known;
    result.noise = robust_spread(off).deviation;
}

}  // namespace

double short_cutoff_for(double cutoff) {
    // λs for a cut-off λc of 0.8, 2.5 and 8 mm: ISO 3274, table 1.
    constexpr double usual = 0.8;
    constexpr double wide = 2.5;
    return cutoff > wide ? 0.025 : cutoff > usual ? 0.008 : 0.0025;
}

ComparedProfile deviations_of_both(const AlignedHeights& measured, const AsMachinedSurface& as_machined,
                                   const ProfileRow& row, Form::Of of, double tolerance) {
    ComparedProfile profile;
    profile.row = row;
    const MapFrame frame = row.frame();
    const Form form(as_machined, frame.bounds(0, 0, row.count, 1), of, tolerance);
    std::vector<double> heights(static_cast<std::size_t>(row.count));
    for (std::int64_t k = 0; k < row.count; ++k)
        heights[static_cast<std::size_t>(k)] = measured.at(frame.at(static_cast<double>(k), 0));
    profile.measured = over_form(std::move(heights), form, frame, as_machined.level());
    RowDeviations predicted = deviations_along(as_machined, form, row);
    profile.predicted = std::move(predicted.deviation);
    profile.along = std::move(predicted.along);
    return profile;
}

MeasuredComparison compare_roughness(const MeasuredData& data, const AlignedHeights& measured,
                                     const AsMachinedSurface& as_machined, const Signals& signals) {
    MeasuredComparison result;
    const double step_over = as_machined.surface().step_over;
    const double cutoff = cutoff_for(step_over);
    const double least_step = step_over / steps_of_pass;
    std::vector<ProfileRow> rows;
    if (data.kind == MeasuredKind::profile) {
        rows.push_back(measured.own_row(least_step));
    } else if (data.kind == MeasuredKind::areal) {
        const AcrossFeed across = nearest_across(as_machined, signals, measured.middle());
        if (across.known) rows = rows_of_map(data, measured, across, least_step);
    } else {
        result.reason = "single points have no roughness: they were aligned only";
        return result;
    }
    result.profiles.resize(rows.size());
    parallel_for(static_cast<std::int64_t>(rows.size()), 1, [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t k = first; k < last; ++k) {
            const auto at = static_cast<std::size_t>(k);
            result.profiles[at] = deviations_of_both(measured, as_machined, rows[at]);
        }
    });
    const double longest = rows.empty() ? 0 : rows.front().step;
    if (longest > 0 && steps_of_short_wave * longest <= short_cutoff_for(cutoff))
        result.short_cutoff = short_cutoff_for(cutoff);
    for (ComparedProfile& profile : result.profiles) evaluate(profile, cutoff, result.short_cutoff);
    sum_up(result);
    if (result.measured.length <= 0)
        result.reason = "the form of the part is not known where it was measured: a crease, a border, or too short";
    return result;
}

}  // namespace clsurf
