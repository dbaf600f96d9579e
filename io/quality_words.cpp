#include "io/quality_words.h"

#include <cmath>

#include <fmt/format.h>

#include "core/units.h"

namespace clsurf::io {

std::string thresholds_text(const QualityReport& report) {
    std::string text;
    const auto add = [&](Quantity quantity, std::string_view name, double factor, int digits, std::string_view unit) {
        const double value = factor * static_cast<double>(report.thresholds.of[index_of(quantity)]);
        if (!std::isfinite(value)) return;
        text += fmt::format("{}{} {:.{}f} {}", text.empty() ? "" : ", ", name, value, digits, unit);
    };
    add(Quantity::speed, "speed", 100, 1, "%");
    add(Quantity::acceleration, "acceleration", 1, 0, "mm/s²");
    if (report.has_lag) add(Quantity::lag, "lag", um_per_mm, 1, "µm");
    add(Quantity::relief, "relief of the passes", um_per_mm, 1, "µm");
    return text;
}

}  // namespace clsurf::io
