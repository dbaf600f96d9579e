#include "compare/run_report.h"

#include <algorithm>
#include <cmath>

#include "core/statistics.h"

namespace clsurf {
namespace {

constexpr double joined_arc_length = 1.0;          ///< [mm] largest distance between joined sections
constexpr double least_seconds = 0.005;            ///< least duration of a section …
constexpr PointIndex least_points = 3;             ///< … and its least number of points
constexpr double sampled_by_arc_length = 200'000;  ///< places along the path, for percentiles
constexpr std::size_t most_kept = 1000;            ///< number of kept sections of a quantity
constexpr double end_share = 0.1;                  ///< share of the path for the estimate of a drift

bool worse(const RunDifferenceSection& x, const RunDifferenceSection& y) { return x.score > y.score; }

/// Sorts sections, the worst first, and keeps at most `most_kept`, so that memory is bounded for runs that differ everywhere.
void keep_worst(std::vector<RunDifferenceSection>& sections) {
    std::stable_sort(sections.begin(), sections.end(), worse);
    if (sections.size() > most_kept) sections.resize(most_kept);
}

class Reporter {
public:
    Reporter(const ComparedRun& a, const ClSurface& surface, const LineMap* lines, const ComparedRun& b,
             const RunDifferences& differences)
        : a_(a), b_(b), lines_(lines), differences_(differences), arc_length_(surface.positions) {}

    [[nodiscard]] RunQuantitySummary summarise(RunQuantity q) const {
        RunQuantitySummary summary;
        summary.quantity = q;
        summary.threshold = differences_.threshold[index_of(q)];
        const Column<float>& values = differences_.of[index_of(q)];
        double sum = 0;
        double squares = 0;
        std::vector<float> sampled;
        const double every = arc_length_.to(static_cast<PointIndex>(values.size()) - 1) / sampled_by_arc_length;
        double since = every;
        for (const PointRange& section : differences_.alignment.sections) {
            for (PointIndex i = section.first; i <= section.last; ++i) {
                const float value = values[static_cast<std::size_t>(i)];
                if (!(value == value)) continue;
                const double step = i < section.last ? arc_length_.step(i) : 0;
                summary.lowest = std::min<double>(summary.lowest, value);
                summary.highest = std::max<double>(summary.highest, value);
                if (q == RunQuantity::speed)
                    summary.relative_most =
                        std::max<double>(summary.relative_most, std::abs(value) / differences_.speed_base(i));
                if (std::abs(value) > differences_.threshold_at(q, i)) summary.over += step;
                summary.arc_length += step;
                sum += step * value;
                squares += step * value * value;
                since += step;
                if (since < every || !(step > 0)) continue;
                since = 0;
                sampled.push_back(value);
            }
        }
        if (!(summary.arc_length > 0)) return summary;
        summary.mean = sum / summary.arc_length;
        summary.rms = std::sqrt(squares / summary.arc_length);
        summary.over /= summary.arc_length;
        const auto tenth = static_cast<std::ptrdiff_t>(end_share * static_cast<double>(sampled.size())) + 1;
        if (tenth <= static_cast<std::ptrdiff_t>(sampled.size())) {
            std::vector<float> begin(sampled.begin(), sampled.begin() + tenth);
            std::vector<float> end(sampled.end() - tenth, sampled.end());
            summary.begin = median(begin);
            summary.end = median(end);
        }
        if (sampled.empty()) return summary;
        for (float& value : sampled) value = std::abs(value);
        summary.p95 = nearest_quantile(sampled, 0.95);
        return summary;
    }

    /// Adds the worst sections to `report`. Returns the number of all sections.
    [[nodiscard]] PointIndex find_sections(RunQuantity q, RunReport& report) const {
        std::vector<RunDifferenceSection> found;
        PointIndex count = 0;
        const Column<float>& values = differences_.of[index_of(q)];
        const auto sign_of = [&](PointIndex i) {
            const float value = values[static_cast<std::size_t>(i)];
            if (!(std::abs(value) > differences_.threshold_at(q, i))) return 0;
            return value > 0 ? 1 : -1;
        };
        const PointIndex least =
            std::max<PointIndex>(least_points, std::lround(std::min(least_seconds / a_.log->period, 1e6)));
        for (const PointRange& section : differences_.alignment.sections) {
            PointRange open;
            int sign = 0;
            PointIndex over = 0;
            const auto close = [&] {
                if (over >= least) {
                    found.push_back(measure(q, open));
                    ++count;
                    if (found.size() >= 10 * most_kept) keep_worst(found);
                }
                over = 0;
                sign = 0;
            };
            for (PointIndex i = section.first; i <= section.last; ++i) {
                const int here = sign_of(i);
                if (here == 0) continue;
                if (sign != 0 && (here != sign || arc_length_.at_least(open.last, i, joined_arc_length))) close();
                if (sign == 0) open.first = i;
                sign = here;
                open.last = i;
                ++over;
            }
            close();
        }
        keep_worst(found);
        report.sections.insert(report.sections.end(), found.begin(), found.end());
        return count;
    }

    /// Arc length of B that no section of A covers.
    void measure_b(RunReport& report) const {
        const ArcLength arc_length(gather(b_.path));
        std::vector<PointRange> covered;
        for (const PointRange& section : differences_.alignment.sections) {
            const auto& locations = differences_.alignment.locations;
            covered.push_back({locations[static_cast<std::size_t>(section.first)].nearest(),
                               locations[static_cast<std::size_t>(section.last)].nearest()});
        }
        std::sort(covered.begin(), covered.end(),
                  [](const PointRange& x, const PointRange& y) { return x.first < y.first; });
        covered.push_back({b_.path.count - 1, b_.path.count - 1});
        report.arc_length_of_b = arc_length.to(b_.path.count - 1);
        double left_out = 0, longest = 0;
        PointIndex end = 0;
        for (const PointRange& range : covered) {
            if (range.first > end) {
                const double gap = arc_length.to(range.first) - arc_length.to(end);
                left_out += gap;
                if (gap > longest) {
                    longest = gap;
                    report.left_out_of_b = {end, range.first};
                }
            }
            end = std::max(end, range.last);
        }
        report.aligned_of_b = report.arc_length_of_b - left_out;
    }

    void measure_time(RunReport& report) const {
        for (const PointRange& section : differences_.alignment.sections) {
            report.time += a_.log->time_of(section.last) - a_.log->time_of(section.first);
            report.time_of_b += time_of_b(section);
        }
    }

private:
    [[nodiscard]] double time_at_b(PointIndex i) const {
        const PathLocation& at = differences_.alignment.locations[static_cast<std::size_t>(i)];
        return interpolate([&](PointIndex point) { return b_.log->time_of(point); }, at);
    }
    [[nodiscard]] double time_of_b(const PointRange& points) const {
        return time_at_b(points.last) - time_at_b(points.first);
    }

    [[nodiscard]] RunDifferenceSection measure(RunQuantity q, const PointRange& points) const {
        RunDifferenceSection d;
        d.quantity = q;
        d.points = points;
        const auto& locations = differences_.alignment.locations;
        d.points_of_b = {locations[static_cast<std::size_t>(points.first)].nearest(),
                         locations[static_cast<std::size_t>(points.last)].nearest()};
        const Column<float>& values = differences_.of[index_of(q)];
        double weights = 0;
        for (PointIndex i = points.first; i <= points.last; ++i) {
            const double value = values[static_cast<std::size_t>(i)];
            const double step = i < points.last ? arc_length_.step(i) : 0;
            d.length += step;
            if (!(value == value)) continue;
            // A small weight for resting, so that a pause also has a mean.
            const double weight = step + 1e-9;
            weights += weight;
            d.mean += weight * value;
            if (q == RunQuantity::speed) d.relative_mean += weight * value / differences_.speed_base(i);
            const double score = std::abs(value) / differences_.threshold_at(q, i);
            if (score > d.score) {
                d.score = score;
                d.point = i;
            }
        }
        d.mean /= weights;
        d.relative_mean /= weights;
        d.peak = values[static_cast<std::size_t>(d.point)];
        if (q == RunQuantity::speed) d.relative_peak = d.peak / differences_.speed_base(d.point);
        d.place.tip = a_.path.at(d.point);
        d.time = time_of_b(points) - (a_.log->time_of(points.last) - a_.log->time_of(points.first));
        if (lines_ != nullptr) {
            d.first_line = lines_->line_at(points.first);
            d.last_line = std::max(d.first_line, lines_->line_at(points.last));
        }
        return d;
    }

    const ComparedRun& a_;
    const ComparedRun& b_;
    const LineMap* lines_;
    const RunDifferences& differences_;
    ArcLength arc_length_;
};

}  // namespace

const RunQuantitySummary* RunReport::find(RunQuantity q) const {
    const auto at = std::find_if(quantities.begin(), quantities.end(),
                                 [&](const RunQuantitySummary& s) { return s.quantity == q; });
    return at == quantities.end() ? nullptr : &*at;
}

RunReport report_run(const ComparedRun& a, const ClSurface& surface, const LineMap* lines, const ComparedRun& b,
                     const RunDifferences& differences) {
    RunReport report;
    report.aligned = differences.alignment.aligned;
    report.arc_length = differences.alignment.arc_length;
    const Reporter reporter(a, surface, lines, b, differences);
    for (const RunQuantityInfo& info : run_quantity_table()) {
        if (!differences.has(info.quantity)) continue;
        report.quantities.push_back(reporter.summarise(info.quantity));
        report.quantities.back().sections = reporter.find_sections(info.quantity, report);
    }
    reporter.measure_time(report);
    reporter.measure_b(report);
    std::stable_sort(report.sections.begin(), report.sections.end(), worse);
    return report;
}

}  // namespace clsurf
