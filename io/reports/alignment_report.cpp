#include "io/reports/alignment_report.h"

#include <cmath>

#include <fmt/format.h>

#include "core/decimal_text.h"
#include "core/units.h"
#include "io/reports/measured_json.h"
#include "io/reports/quality_words.h"

namespace clsurf::io {

std::string alignment_text(const MeasuredData& data, const Alignment& alignment) {
    std::string text = fmt::format("{}: {} of {} places", data.name, name_of(data.kind), alignment.points);
    if (data.missing > 0) text += fmt::format(", {} more without a height", data.missing);
    if (!alignment.parameters.empty()) {
        text += fmt::format("; {:.3f} µm rms from the predicted surface, {:.3f} µm at most, {} places used{}",
                            alignment.rms * um_per_mm, std::abs(alignment.worst) * um_per_mm, alignment.used,
                            alignment.left_out > 0 ? fmt::format(", {} left out", alignment.left_out) : "");
    }
    text += "\n";
    for (const std::string& reason : alignment.reasons) text += fmt::format("  not determined: {}\n", reason);
    if (!alignment.determined()) return text;
    const Vec3 turns = turns_of(alignment.pose.turn) * deg_per_rad;
    text += fmt::format("  its origin is at {} mm, turned by A {} B {} C {}°\n", axes_text(alignment.pose.shift, 4),
                        fixed_text(turns.x(), 4), fixed_text(turns.y(), 4), fixed_text(turns.z(), 4));
    for (const PoseParameter& p : alignment.parameters) {
        const bool rotation = p.axis >= PoseAxis::a;
        const double factor = rotation ? deg_per_rad : 1;
        const std::string_view unit = rotation ? "°" : " mm";
        if (p.fitted)
            text += fmt::format("  {} {}{} ± {:.2g}{}\n", name_of(p.axis), signed_text(p.value * factor, 5), unit,
                                p.standard_error * factor, unit);
        else
            text += fmt::format("  {} as stated\n", name_of(p.axis));
    }
    return text;
}

std::string alignment_json(const MeasuredData& data, const Alignment& alignment, const CuttingTool& tool,
                           const Diagnostics& diagnostics) {
    Json json = alignment_keys(data, alignment);
    json["tool"] = to_text(tool);
    json["diagnostics"] = list(diagnostics);
    return dump(json);
}

}  // namespace clsurf::io
