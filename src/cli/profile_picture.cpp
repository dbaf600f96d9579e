#include "cli/profile_picture.h"

#include <fmt/format.h>

#include "core/file_name.h"
#include "core/units.h"
#include "viz/chart.h"

namespace clsurf::cli {

void draw_fit(const io::CutReport& report, const ScanCut& cut, PictureOutput& output) {
    std::vector<double> fitted, residuals;
    for (std::size_t i = 0; i < cut.scan.x.size(); ++i) {
        fitted.push_back(cut.scan.z[i] - cut.residuals[i]);
        residuals.push_back(cut.residuals[i] * um_per_mm);
    }
    std::vector<viz::Curve> curves;
    curves.push_back({"Fit (mm)", std::move(fitted), {}, cut.scan.z, "scanned"});
    curves.push_back({"Scanned less fit (µm)", std::move(residuals)});
    viz::ChartLook look;
    look.keep_drawing = output.wants_drawing();
    look.title = fmt::format("Residual {:.3g} µm rms, {:.3g} µm at most", cut.rms * um_per_mm, cut.worst * um_per_mm);
    look.subtitle = fmt::format("{} · degree {} · windows of {} points · join {}", file_name(report.scan),
                                report.rules.fit.degree, report.rules.fit.window, io::name_of(report.rules.fit.join));
    look.x_label = "X (mm)";
    look.footnote = fmt::format("{} points scanned, {} rejected as outliers; {} {} within {:.2g} mm", report.read,
                                cut.scan.rejected.size(), report.written.motions,
                                report.splines ? "spline blocks" : "lines", report.written.deviation);
    output.write(viz::draw_chart(cut.scan.x, curves, {}, look), look.title);
}

}  // namespace clsurf::cli
