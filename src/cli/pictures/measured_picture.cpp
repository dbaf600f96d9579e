#include "cli/pictures/measured_picture.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "core/file_name.h"
#include "core/units.h"
#include "viz/chart.h"

namespace clsurf::cli {
namespace {

std::vector<double> in_um(std::span<const double> mm) {
    std::vector<double> um(mm.begin(), mm.end());
    for (double& value : um) value *= um_per_mm;
    return um;
}

/// The judged marks that a profile crosses.
std::vector<viz::ChartCursor> cursors_of(const io::ReportedMeasurement& measured, const ComparedProfile& profile) {
    std::vector<viz::ChartCursor> cursors;
    if (measured.data.kind != MeasuredKind::profile) return cursors;
    for (const ComparedMark& mark : measured.result.marks) {
        if (mark.state == MarkState::not_judged) continue;
        const double at = mark.along / profile.row.step - static_cast<double>(profile.first);
        if (!(at < static_cast<double>(profile.count))) continue;
        cursors.push_back({mark.along,
                           mark.state == MarkState::found
                               ? fmt::format("mark {}: {:.2f} µm {}", mark.defect + 1, mark.measured * um_per_mm,
                                             deep_or_high(mark.pit))
                               : fmt::format("mark {} missing", mark.defect + 1),
                           {}});
    }
    return cursors;
}

}  // namespace

MeasuredPicture draw_measured(const io::ReportedMeasurement& measured, const Part& part, const CuttingTool& tool,
                              bool keep_drawing) {
    const MeasuredComparison& c = measured.result.comparison;
    const ComparedProfile& profile = c.profiles[c.profiles.size() / 2];
    std::vector<double> x(profile.count);
    for (std::size_t k = 0; k < x.size(); ++k) x[k] = profile.row.step * static_cast<double>(profile.first + k);
    std::vector<double> residual(profile.count);
    for (std::size_t k = 0; k < residual.size(); ++k)
        residual[k] = profile.measured_rough[k] - profile.predicted_rough[k];
    const auto section = [&](const std::vector<double>& z) {
        return in_um(std::span(z).subspan(profile.first, profile.count));
    };
    std::vector<viz::Curve> curves;
    curves.push_back(
        {"Measured over its form (µm)", section(profile.measured), {}, section(profile.predicted), "predicted"});
    curves.push_back(
        {"Roughness measured (µm)", in_um(profile.measured_rough), {}, in_um(profile.predicted_rough), "predicted"});
    curves.push_back({"Roughness: measured less predicted (µm)", in_um(residual)});

    viz::ChartLook look;
    look.keep_drawing = keep_drawing;
    look.title = fmt::format("Measured and predicted: Ra {:.2f} and {:.2f} µm, Rz {:.2f} and {:.2f} µm",
                             c.measured.ra * um_per_mm, c.predicted.ra * um_per_mm, c.measured.rz * um_per_mm,
                             c.predicted.rz * um_per_mm);
    look.subtitle = fmt::format("{} on {} · {} · {}", file_name(measured.data.name),
                                file_name(part.program.main().name()), file_name(part.log.name), to_text(tool));
    look.x_label = "along the profile (mm)";
    look.footnote = fmt::format(
        "{}correlation {:.3f}; aligned within {:.3f} µm rms; cut-off {:g} mm{}",
        c.profiles.size() > 1 ? fmt::format("profile {} of {}; ", c.profiles.size() / 2 + 1, c.profiles.size()) : "",
        c.correlation, measured.result.alignment.rms * um_per_mm, c.measured.cutoff,
        c.short_cutoff > 0 ? fmt::format(", short waves below {:g} µm taken off", c.short_cutoff * um_per_mm) : "");
    return {viz::draw_chart(x, curves, cursors_of(measured, profile), look), look.title};
}

}  // namespace clsurf::cli
