#include "io/reports/cut_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/counted.h"
#include "io/files/json_value.h"

namespace clsurf::io {
namespace {

/// Jumps between the heights of adjacent windows.
struct Jumps {
    std::size_t count = 0;
    double rms = 0, most = 0, most_x = 0, most_slope = 0;
};

Jumps jumps_of(const WindowedFit& fit) {
    Jumps jumps;
    for (const PieceStep& step : fit.steps()) {
        ++jumps.count;
        jumps.rms += step.z * step.z;
        jumps.most_slope = std::max(jumps.most_slope, std::abs(step.slope));
        if (std::abs(step.z) > jumps.most) {
            jumps.most = std::abs(step.z);
            jumps.most_x = step.x;
        }
    }
    if (jumps.count > 0) jumps.rms = std::sqrt(jumps.rms / static_cast<double>(jumps.count));
    return jumps;
}

std::string rejected_text(const CutReport& report, const ScanCut& cut) {
    if (report.rules.outliers <= 0) return "  outliers: not looked for\n";
    const std::vector<ScanPoint>& rejected = cut.scan.rejected;
    std::string text = fmt::format(
        "  {} {} rejected: more than {:g} times the scatter, {:.3g} mm, from the running median", rejected.size(),
        rejected.size() == 1 ? "point" : "points", report.rules.outliers, cut.scan.scatter);
    constexpr std::size_t named = 8;
    for (std::size_t k = 0; k < std::min(named, rejected.size()); ++k)
        text += fmt::format("{} X {:.6g}", k == 0 ? ":" : ",", rejected[k].x);
    if (rejected.size() > named) text += fmt::format(" and {} more", rejected.size() - named);
    return text + "\n";
}

Json points_json(const std::vector<ScanPoint>& points) {
    Json list = Json::array();
    for (const ScanPoint& point : points) list.push_back(Json::array({number(point.x), number(point.z)}));
    return list;
}

std::string correction_text(const CorrectedPass& corrected) {
    const Compensation& by = corrected.by;
    return fmt::format(
        "  deviations of {}: corrected by at most {:.4f} mm, at X {:.6g}; they scatter by {:.2g} mm rms about their fit, {} "
        "rejected\n",
        corrected.program, by.greatest, by.greatest_x, by.residuals.rms, by.deviations.rejected.size());
}

}  // namespace

std::string_view name_of(WindowJoin join) {
    constexpr std::string_view names[] = {"c1", "blend", "none"};
    return names[static_cast<std::size_t>(join)];
}

ScanResiduals residuals_of(const CutReport& report, const ScanCut& cut) {
    if (!report.corrected) return {cut.scan, cut.residuals};
    return {report.corrected->by.deviations, report.corrected->by.residuals};
}

std::string cut_text(const CutReport& report, const ScanCut& cut) {
    const ScanResiduals fit = residuals_of(report, cut);
    std::string text = fmt::format("{}: {} points, X {:.6g} to {:.6g} mm", report.scan, report.read, fit.scan.x.front(),
                                   fit.scan.x.back());
    if (report.missing > 0) text += fmt::format(", {} more without a height", report.missing);
    if (fit.scan.averaged > 0) text += fmt::format(", {} of the same x averaged", fit.scan.averaged);
    text += "\n" + (report.corrected ? correction_text(*report.corrected) : rejected_text(report, cut));
    text += fmt::format(
        "  fit of degree {}, windows of {} points, join {}: residual {:.4f} mm rms, {:.4f} mm at most, at X {:.6g}\n",
        report.rules.fit.degree, report.rules.fit.window, name_of(report.rules.fit.join), fit.residuals.rms,
        fit.residuals.worst, fit.residuals.worst_x);
    const Jumps jumps = jumps_of(cut.fit);
    if (report.rules.fit.join == WindowJoin::none && jumps.count > 0)
        text += fmt::format("  it jumps between windows at {} places: {:.4f} mm rms, {:.4f} mm at most, at X {:.6g}\n",
                            jumps.count, jumps.rms, jumps.most, jumps.most_x);
    text += fmt::format("  {}: {}, within {:.4f} mm of the {} (read back; tolerance {:g} mm)\n", report.output,
                        clsurf::counted(report.written.motions, report.splines ? "spline block" : "line"),
                        report.written.deviation,
                        report.rules.radius > 0 ? fmt::format("path of a ball of radius {:g} mm", report.rules.radius)
                                                : std::string("fit"),
                        report.rules.tolerance);
    text += fmt::format("  simulated on {}: within {:.4f} mm of it (tolerance and corners allow {:g} mm), {:.2f} s\n",
                        report.simulated.machine, report.simulated.deviation, report.simulated.allowed,
                        report.simulated.duration);
    return text;
}

std::string cut_json(const CutReport& report, const ScanCut& cut, const Diagnostics& diagnostics) {
    const Jumps jumps = jumps_of(cut.fit);
    Json json{{"file", report.scan},
              {"output", report.output},
              {"dialect", report.dialect},
              {"points", report.read},
              {"missing", report.missing},
              {"rejected", cut.scan.rejected.size()},
              {"rejected_mm", points_json(cut.scan.rejected)},
              {"averaged", cut.scan.averaged},
              {"scatter_mm", number(cut.scan.scatter)},
              {"outliers", number(report.rules.outliers)},
              {"degree", report.rules.fit.degree},
              {"window", report.rules.fit.window},
              {"join", name_of(report.rules.fit.join)},
              {"pieces", cut.fit.pieces.size()},
              {"x_mm", Json::array({number(cut.scan.x.front()), number(cut.scan.x.back())})},
              {"rms_residual_mm", number(cut.residuals.rms)},
              {"max_residual_mm", number(cut.residuals.worst)},
              {"max_residual_at_mm", number(cut.residuals.worst_x)},
              {"window_jumps",
               {{"count", jumps.count},
                {"rms_mm", number(jumps.rms)},
                {"max_mm", number(jumps.most)},
                {"max_at_mm", number(jumps.most_x)},
                {"max_slope", number(jumps.most_slope)}}},
              {"tool_offset_mm", number(report.rules.radius)},
              {"blocks", report.splines ? "splines" : "lines"},
              {"output_points", report.written.motions + 1},
              {"tolerance_mm", number(report.rules.tolerance)},
              {"chord_error_mm", number(report.written.deviation)},
              {"simulation",
               {{"machine", report.simulated.machine},
                {"deviation_mm", number(report.simulated.deviation)},
                {"allowed_mm", number(report.simulated.allowed)},
                {"time_s", number(report.simulated.duration)}}},
              {"diagnostics", list(diagnostics)}};
    if (report.corrected) {
        const Compensation& by = report.corrected->by;
        json["compensation"] = {{"program", report.corrected->program},
                                {"max_mm", number(by.greatest)},
                                {"max_at_mm", number(by.greatest_x)},
                                {"scatter_mm", number(by.residuals.rms)},
                                {"rejected_mm", points_json(by.deviations.rejected)}};
    }
    return dump(json);
}

}  // namespace clsurf::io
