#include "io/readers/fidelity_section.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/spelling.h"
#include "core/units.h"

namespace clsurf::io {
namespace {

constexpr double per_hundred = 0.01;
constexpr double micrometre = 0.001;  // mm

std::optional<double> share(const TomlFile& file, const toml::table& table, std::string_view key, double high,
                            double low = 0) {
    const std::optional<double> given = file.number(table, key);
    if (given && !(*given >= low && *given <= high))
        file.fail(*table.get(key), fmt::format("'{}' is {}, which is not possible", key, *given));
    return given;
}

FidelityBasis read_basis(const TomlFile& file, const toml::table& table) {
    const std::optional<std::string> word = file.text(table, "basis");
    if (!word) return FidelityBasis::test;
    const auto found = std::find(fidelity_basis_names.begin(), fidelity_basis_names.end(), *word);
    if (found == fidelity_basis_names.end())
        file.fail(*table.get("basis"), fmt::format("'basis' is '{}', which is not known", *word),
                  "one of: fit, cross-validation, test");
    return static_cast<FidelityBasis>(found - fidelity_basis_names.begin());
}

}  // namespace

Fidelity read_fidelity(const TomlFile& file, const toml::table& table) {
    constexpr double any = std::numeric_limits<double>::max();
    file.allow(table, {"basis", "runs", "time_error_percent", "speed_error_p50_mm_min", "speed_error_p95_mm_min",
                       "speed_error_p95_percent", "following_error_p95_um", "following_error_p95_percent",
                       "defects_recall", "defects_precision"});
    Fidelity f;
    f.basis = read_basis(file, table);
    f.runs = static_cast<int>(file.integer(table, "runs", 1, 1000000).value_or(1));
    f.time_error = share(file, table, "time_error_percent", any, -100).value_or(0) * per_hundred;
    f.speed_error_p50 = share(file, table, "speed_error_p50_mm_min", any).value_or(0) / seconds_per_minute;
    f.speed_error_p95 = share(file, table, "speed_error_p95_mm_min", any).value_or(0) / seconds_per_minute;
    f.speed_error_p95_ratio = share(file, table, "speed_error_p95_percent", any).value_or(0) * per_hundred;
    if (const auto error = share(file, table, "following_error_p95_um", any))
        f.following_error_p95 = *error * micrometre;
    if (const auto error = share(file, table, "following_error_p95_percent", any))
        f.following_error_ratio = *error * per_hundred;
    f.defects_recall = share(file, table, "defects_recall", 1);
    f.defects_precision = share(file, table, "defects_precision", 1);
    return f;
}

std::string fidelity_text(const Fidelity& f) {
    const auto rounded = [](double value, double unit) { return std::round(value / unit) * unit; };
    std::string text = fmt::format("\n[fidelity]\nbasis = \"{}\"\nruns = {}\n", name_of(f.basis), f.runs);
    const auto add = [&](const char* key, double value, double unit) {
        text += fmt::format("{} = {}\n", key, twelve_digits(rounded(value, unit)));
    };
    add("time_error_percent", f.time_error / per_hundred, 0.001);
    add("speed_error_p50_mm_min", f.speed_error_p50 * seconds_per_minute, 0.01);
    add("speed_error_p95_mm_min", f.speed_error_p95 * seconds_per_minute, 0.01);
    add("speed_error_p95_percent", f.speed_error_p95_ratio / per_hundred, 0.001);
    if (f.following_error_p95) add("following_error_p95_um", *f.following_error_p95 / micrometre, 0.001);
    if (f.following_error_ratio) add("following_error_p95_percent", *f.following_error_ratio / per_hundred, 0.001);
    if (f.defects_recall) add("defects_recall", *f.defects_recall, 0.001);
    if (f.defects_precision) add("defects_precision", *f.defects_precision, 0.001);
    return text;
}

}  // namespace clsurf::io
