#include "io/reports/fidelity_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/decimal_text.h"
#include "core/units.h"

namespace clsurf::io {
namespace {

constexpr double um = 1000;  // micrometres per mm

Json optional_number(const std::optional<double>& value, double factor, int decimals) {
    return value ? number(*value * factor, decimals) : Json(nullptr);
}

/// "0.016", "4", "31".
std::string two_digits(double value) {
    return value < 10 ? fmt::format("{:.2g}", value) : fmt::format("{:.0f}", value);
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

std::optional<Fidelity> read_fidelity(const Json& json) {
    if (!json.is_object()) return std::nullopt;
    const auto value = [&](const char* key) -> std::optional<double> {
        const auto found = json.find(key);
        return found != json.end() && found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
    };
    const auto scaled = [&](const char* key, double factor) {
        const std::optional<double> given = value(key);
        return given ? std::optional(*given / factor) : std::nullopt;
    };
    Fidelity f;
    const auto basis = json.find("basis");
    if (basis == json.end() || !basis->is_string()) return std::nullopt;
    const auto name = std::find(fidelity_basis_names.begin(), fidelity_basis_names.end(), basis->get<std::string>());
    const std::optional<double> runs = value("runs"), time = scaled("time_error_percent", 100),
                                p95 = scaled("speed_error_p95_mm_min", seconds_per_minute);
    if (name == fidelity_basis_names.end() || !runs || !time || !p95 || !(*runs >= 0) || !(*runs < 1e6))
        return std::nullopt;
    f.basis = static_cast<FidelityBasis>(name - fidelity_basis_names.begin());
    f.runs = static_cast<int>(*runs);
    f.time_error = *time;
    f.speed_error_p50 = scaled("speed_error_p50_mm_min", seconds_per_minute).value_or(0);
    f.speed_error_p95 = *p95;
    f.speed_error_p95_ratio = scaled("speed_error_p95_percent", 100).value_or(0);
    f.following_error_p95 = scaled("following_error_p95_um", um);
    f.following_error_ratio = scaled("following_error_p95_percent", 100);
    f.defects_recall = value("defects_recall");
    f.defects_precision = value("defects_precision");
    return f;
}

std::string fidelity_line(const std::optional<Fidelity>& f) {
    if (!f) return "Fidelity of this machine file: not measured (clsurf identify --test).\n";
    const char* of = f->basis == FidelityBasis::test               ? "runs not used for the fit"
                     : f->basis == FidelityBasis::cross_validation ? "runs, each left out of the fit"
                                                                   : "the fitted runs";
    std::string text = fmt::format(
        "Fidelity of this machine file ({}: {}): time {} %, speed within {} mm/min over 95 % of the path", of, f->runs,
        signed_text(f->time_error * 100, 2), two_digits(f->speed_error_p95 * seconds_per_minute));
    if (f->following_error_p95)
        text += fmt::format(", following error within {} µm", two_digits(*f->following_error_p95 * um));
    if (f->defects_recall) text += fmt::format(", {:.0f} % of the defects found", *f->defects_recall * 100);
    if (f->defects_precision)
        text += fmt::format(", {:.0f} % of those predicted are real", *f->defects_precision * 100);
    return text + ".\n";
}

}  // namespace clsurf::io
