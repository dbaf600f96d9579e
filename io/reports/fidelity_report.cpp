#include "io/reports/fidelity_report.h"

#include <cmath>

#include <fmt/format.h>

#include "core/units.h"

namespace clsurf::io {
namespace {

constexpr double um = 1000;  // in a mm

Json optional_number(const std::optional<double>& value, double factor, int decimals) {
    return value ? number(*value * factor, decimals) : Json(nullptr);
}

}  // namespace

Json fidelity_json(const std::optional<Fidelity>& f) {
    if (!f) return nullptr;
    return Json{{"basis", std::string(name_of(f->basis))},
                {"runs", f->runs},
                {"time_error_percent", number(f->time_error * 100, 3)},
                {"speed_error_p50_mm_min", number(f->speed_error_p50 * seconds_per_minute, 2)},
                {"speed_error_p95_mm_min", number(f->speed_error_p95 * seconds_per_minute, 2)},
                {"speed_error_p95_percent", number(f->speed_error_p95_ratio * 100, 3)},
                {"following_error_p95_um", optional_number(f->following_error_p95, um, 3)},
                {"following_error_p95_percent", optional_number(f->following_error_ratio, 100, 3)},
                {"defects_recall", optional_number(f->defects_recall, 1, 3)},
                {"defects_precision", optional_number(f->defects_precision, 1, 3)}};
}

std::string fidelity_line(const std::optional<Fidelity>& f) {
    if (!f) return "Fidelity of this machine file: not measured (clsurf identify --test).\n";
    const char* of = f->basis == FidelityBasis::test               ? "runs not used for the fit"
                     : f->basis == FidelityBasis::cross_validation ? "runs, each left out of the fit"
                                                                   : "the fitted runs";
    std::string text = fmt::format(
        "Fidelity of this machine file ({}: {}): time {:+.2f} %, speed within {:.0f} mm/min over 95 % of the path", of,
        f->runs, std::abs(f->time_error) < 5e-5 ? 0.0 : f->time_error * 100, f->speed_error_p95 * seconds_per_minute);
    if (f->following_error_p95) text += fmt::format(", following error within {:.1f} µm", *f->following_error_p95 * um);
    if (f->defects_recall) text += fmt::format(", {:.0f} % of the defects found", *f->defects_recall * 100);
    if (f->defects_precision)
        text += fmt::format(", {:.0f} % of those predicted are real", *f->defects_precision * 100);
    return text + ".\n";
}

}  // namespace clsurf::io
