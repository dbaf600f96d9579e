#include "history/history_quantity.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "core/error.h"
#include "core/spelling.h"

namespace clsurf {
namespace {

using Defects = std::span<const RecordedDefect>;

/// The greatest value of a member over defects, 0 if there are none.
template <auto member>
double greatest(Defects defects) {
    double most = 0;
    for (const RecordedDefect& defect : defects) most = std::max(most, static_cast<double>(defect.*member));
    return most;
}

double number_of(Defects defects) { return static_cast<double>(defects.size()); }

double total_area(Defects defects) {
    double area = 0;
    for (const RecordedDefect& defect : defects) area += defect.area_mm2;
    return area;
}

constexpr std::array table{
    HistoryQuantity{"worst_score", "Worst score", "times the threshold",
                    [](const RunRecord& r) { return r.worst_score; }, 0.1, greatest<&RecordedDefect::score>},
    HistoryQuantity{"defects", "Defects", "", [](const RunRecord& r) { return static_cast<double>(r.defects); }, 0.25,
                    number_of},
    HistoryQuantity{"worst_severity", "Worst severity (1 to 4)", "",
                    [](const RunRecord& r) { return static_cast<double>(r.worst_severity); }, 0.25,
                    greatest<&RecordedDefect::severity>},
    HistoryQuantity{"deepest_um", "Deepest defect", "µm", [](const RunRecord& r) { return r.deepest_um; }, 0.1,
                    greatest<&RecordedDefect::depth_um>},
    HistoryQuantity{"area_mm2", "Area of defects", "mm²", [](const RunRecord& r) { return r.area_mm2; }, 0.1,
                    total_area},
    HistoryQuantity{"ra_um", "Roughness Ra", "µm", [](const RunRecord& r) { return r.ra_um; }, 0.01, nullptr},
    HistoryQuantity{"rz_um", "Roughness Rz", "µm", [](const RunRecord& r) { return r.rz_um; }, 0.05, nullptr},
    HistoryQuantity{"speed_mismatch_p50_percent", "Speed mismatch, median", "%",
                    [](const RunRecord& r) { return r.speed_percent.median; }, 0.05, nullptr},
    HistoryQuantity{"speed_mismatch_p99_percent", "Speed mismatch, 99th percentile", "%",
                    [](const RunRecord& r) { return r.speed_percent.p99; }, 0.2, nullptr},
    HistoryQuantity{"acceleration_mismatch_p50_mm_s2", "Acceleration mismatch, median", "mm/s²",
                    [](const RunRecord& r) { return r.acceleration_mm_s2.median; }, 1, nullptr},
    HistoryQuantity{"acceleration_mismatch_p99_mm_s2", "Acceleration mismatch, 99th percentile", "mm/s²",
                    [](const RunRecord& r) { return r.acceleration_mm_s2.p99; }, 10, nullptr},
    HistoryQuantity{"lag_mismatch_p50_um", "Lag mismatch, median", "µm",
                    [](const RunRecord& r) { return r.lag_um.median; }, 0.02, nullptr},
    HistoryQuantity{"lag_mismatch_p99_um", "Lag mismatch, 99th percentile", "µm",
                    [](const RunRecord& r) { return r.lag_um.p99; }, 0.1, nullptr},
    HistoryQuantity{"coverage_percent", "Share of points that were compared", "%",
                    [](const RunRecord& r) { return r.coverage_percent; }, 0.5, nullptr},
    HistoryQuantity{"duration_s", "Duration", "s", [](const RunRecord& r) { return r.duration_s; }, 0.05, nullptr},
};

bool has_line(const RecordedSection& section, const std::pair<LineNumber, LineNumber>& lines) {
    return section.first_line != 0 && section.first_line <= lines.second && section.last_line >= lines.first;
}

}  // namespace

bool DefectFilter::matches(const RecordedDefect& defect) const {
    if (!cause.empty() && defect.cause != cause) return false;
    if (!pass && !lines) return true;
    return std::ranges::any_of(defect.sections, [&](const RecordedSection& section) {
        return (!pass || section.pass == *pass) && (!lines || has_line(section, *lines));
    });
}

double value_of(const HistoryQuantity& quantity, const RunRecord& run) {
    return run.failed() ? std::numeric_limits<double>::quiet_NaN() : quantity.of_run(run);
}

std::span<const HistoryQuantity> history_quantities() { return table; }

const HistoryQuantity& find_history_quantity(std::string_view name) {
    std::vector<std::string_view> names;
    for (const HistoryQuantity& quantity : table) {
        if (quantity.name == name) return quantity;
        names.push_back(quantity.name);
    }
    std::string hint = did_you_mean(name, names);
    if (hint.empty()) {
        hint = "one of";
        for (const std::string_view known : names) hint += (known == names.front() ? " " : ", ") + std::string(known);
    }
    throw UsageError("--quantity: the history has no quantity '" + std::string(name) + "'", hint);
}

}  // namespace clsurf
