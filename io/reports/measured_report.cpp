#include "io/reports/measured_report.h"

#include <fmt/format.h>

#include "core/decimal_text.h"
#include "core/units.h"
#include "io/reports/alignment_report.h"

namespace clsurf::io {
namespace {

double to_um(double mm) { return mm * um_per_mm; }

std::string marks_text(const ReportedMeasurement& measured, MarkState state, std::string_view title) {
    std::string text;
    for (const ComparedMark& mark : measured.result.marks) {
        if (mark.state != state) continue;
        text += text.empty() ? fmt::format("  marks {}: ", title) : ", ";
        text += state == MarkState::not_judged
                    ? fmt::format("{} ({})", mark.defect + 1, mark.reason)
                    : fmt::format("{} ({:.2f} µm {}, predicted {:.2f} µm)", mark.defect + 1, to_um(mark.measured),
                                  deep_or_high(mark.pit), to_um(mark.predicted));
    }
    return text.empty() ? text : text + "\n";
}

std::string against(double measured, double predicted) {
    return predicted > 0 ? fmt::format("{:.3f} µm measured, {:.3f} µm predicted ({} %)", to_um(measured),
                                       to_um(predicted), signed_text(100 * (measured / predicted - 1), 1))
                         : fmt::format("{:.3f} µm measured, {:.3f} µm predicted", to_um(measured), to_um(predicted));
}

std::string comparison_text(const MeasuredComparison& c) {
    if (!c.reason.empty()) return fmt::format("  not compared: {}\n", c.reason);
    std::string text = fmt::format("  Ra {}\n  Rq {}\n  Rz {}\n", against(c.measured.ra, c.predicted.ra),
                                   against(c.measured.rq, c.predicted.rq), against(c.measured.rz, c.predicted.rz));
    text += fmt::format("  correlation {:.3f}; {} of {:.3g} mm, λc {:g} mm{}\n", c.correlation,
                        c.profiles.size() == 1 ? "a profile" : fmt::format("{} profiles", c.profiles.size()),
                        c.measured.length, c.measured.cutoff,
                        c.short_cutoff > 0 ? fmt::format(", λs {:g} µm", to_um(c.short_cutoff)) : "");
    return text;
}

}  // namespace

std::string measured_text(const ReportedMeasurement& measured) {
    std::string text = "measured " + alignment_text(measured.data, measured.result.alignment);
    if (measured.result.alignment.determined()) text += comparison_text(measured.result.comparison);
    text += marks_text(measured, MarkState::found, "found");
    text += marks_text(measured, MarkState::missing, "missing");
    text += marks_text(measured, MarkState::not_judged, "not judged");
    return text;
}

}  // namespace clsurf::io
