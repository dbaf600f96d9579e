#include "io/readers/budget_file.h"

#include <cmath>

#include "io/files/toml_table.h"

namespace clsurf::io {
namespace {

template <typename Limits, typename Rows>
Limits read_limits(const std::string& path, const Rows& rows) {
    const TomlFile file(path);
    std::vector<std::string_view> names;
    for (const auto& row : rows) names.push_back(row.name);
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

QualityBudget read_budget(const std::string& path) { return read_limits<QualityBudget>(path, budget_limits()); }

RunBudget read_run_budget(const std::string& path) { return read_limits<RunBudget>(path, run_budget_limits()); }

}  // namespace clsurf::io
