#include "io/readers/budget_file.h"

#include <cmath>

#include "io/files/toml_table.h"

namespace clsurf::io {
namespace {

/// `others`: keys of the same file that are read elsewhere.
template <typename Limits, typename Rows, typename Others>
Limits read_limits(const std::string& path, const Rows& rows, const Others& others) {
    const TomlFile file(path);
    std::vector<std::string_view> names;
    for (const auto& row : rows) names.push_back(row.name);
    for (const auto& row : others) names.push_back(row.name);
    file.allow(file.root(), names);
    Limits limits;
    for (const auto& row : rows) {
        const std::optional<double> value = file.number(file.root(), row.name);
        if (value && !(*value >= 0)) file.fail(*file.root().get(row.name), "must not be negative");
        limits.*row.limit = value;
    }
    return limits;
}

}  // namespace

QualityBudget read_budget(const std::string& path) {
    return read_limits<QualityBudget>(path, budget_limits(), limit_budget_limits());
}

LimitBudget read_limit_budget(const std::string& path) {
    return read_limits<LimitBudget>(path, limit_budget_limits(), budget_limits());
}

RunBudget read_run_budget(const std::string& path) {
    return read_limits<RunBudget>(path, run_budget_limits(), std::span<const QualityLimit>());
}

}  // namespace clsurf::io
