#include "cli/pictures/profile_picture.h"

#include <fmt/format.h>

#include "core/file_name.h"
#include "core/units.h"
#include "viz/chart.h"

namespace clsurf::cli {

void draw_fit(const io::CutReport& report, const ScanCut& cut, PictureOutput& output) {
    const io::ScanResiduals fit = io::residuals_of(report, cut);
    // Deviations are in micrometres, heights in millimetres.
    const bool deviations = report.corrected.has_value();
    const double scale = deviations ? um_per_mm : 1;
    std::vector<double> measured, fitted, residuals;
    for (std::size_t i = 0; i < fit.scan.x.size(); ++i) {
        measured.push_back(fit.scan.z[i] * scale);
        fitted.push_back((fit.scan.z[i] - fit.residuals.values[i]) * scale);
        residuals.push_back(fit.residuals.values[i] * um_per_mm);
    }
    std::vector<viz::Curve> curves;
    curves.push_back({deviations ? "Fitted deviation (µm)" : "Fit (mm)",
                      std::move(fitted),
                      {},
                      std::move(measured),
                      deviations ? "measured" : "scanned"});
    curves.push_back({deviations ? "Measured less fitted (µm)" : "Scanned less fit (µm)", std::move(residuals)});
    viz::ChartLook look;
    look.keep_drawing = output.wants_drawing();
    look.title = fmt::format("Residual {:.3g} µm rms, {:.3g} µm at most", fit.residuals.rms * um_per_mm,
                             fit.residuals.worst * um_per_mm);
    look.subtitle = fmt::format("{} · degree {} · windows of {} points · join {}", file_name(report.scan),
                                report.rules.fit.degree, report.rules.fit.window, io::name_of(report.rules.fit.join));
    look.x_label = "X (mm)";
    look.footnote =
        fmt::format("{} {}, {} rejected as outliers; {} {} within {:.2g} mm", report.read,
                    deviations ? "deviations measured" : "points scanned", fit.scan.rejected.size(),
                    report.written.motions, report.splines ? "spline blocks" : "lines", report.written.deviation);
    output.write(viz::draw_chart(fit.scan.x, curves, {}, look), look.title);
}

}  // namespace clsurf::cli
