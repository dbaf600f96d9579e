#include "io/budget_file.h"

#include <cmath>

#include "io/toml_table.h"

namespace clsurf::io {

Budget read_budget(const std::string& path) {
    const TomlFile file(path);
    std::vector<std::string_view> names;
    for (const BudgetLimit& limit : budget_limits()) names.push_back(limit.name);
    file.allow(file.root(), names);
    Budget budget;
    for (const BudgetLimit& limit : budget_limits()) {
        const std::optional<double> value = file.number(file.root(), limit.name);
        if (value && !(*value >= 0)) file.fail(*file.root().get(limit.name), "must not be negative");
        budget.*limit.limit = value;
    }
    return budget;
}

}  // namespace clsurf::io
