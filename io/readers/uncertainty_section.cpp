#include "io/readers/uncertainty_section.h"

#include <fmt/format.h>

#include "machine/planning_value.h"

namespace clsurf::io {
namespace {

double read_size(const TomlFile& file, const toml::table& table, std::string_view key) {
    const std::optional<double> given = file.number(table, key);
    if (given && !(*given > 0))
        file.fail(*table.get(key), fmt::format("'{}' is {}, expected more than 0", key, *given));
    return given.value_or(0);
}

std::vector<double> read_values(const TomlFile& file, const toml::table& table) {
    std::vector<double> values;
    const toml::node* node = table.get("values");
    if (node == nullptr) return values;
    const toml::array* array = node->as_array();
    if (array == nullptr || array->size() < 2) file.fail(*node, "'values' must be two numbers or more");
    for (const toml::node& each : *array) {
        const std::optional<double> value = each.value<double>();
        if (!each.is_number() || !(*value >= 0)) file.fail(each, "'values' must be numbers, 0 or more");
        values.push_back(*value);
    }
    return values;
}

}  // namespace

std::vector<ParameterUncertainty> read_uncertainty(const TomlFile& file, const toml::array& rows) {
    std::vector<ParameterUncertainty> result;
    for (const toml::node& node : rows) {
        const toml::table& table = *node.as_table();
        file.allow(table, {"key", "of", "relative_error", "lower_bound", "values"});
        ParameterUncertainty row;
        row.key = file.text(table, "key").value_or("");
        row.of = file.text(table, "of").value_or("");
        const bool of_an_axis = row.of.size() == 1 && is_planning_value(row.key, "x");  // or of a rotary one
        if (!is_planning_value(row.key, row.of) && !of_an_axis)
            file.fail(table, fmt::format("no uncertainty is known of '{}' of '{}'", row.key, row.of),
                      "key and of name a limit or a value of the controller: key = \"max_jerk\", of = \"x\"");
        row.relative_error = read_size(file, table, "relative_error");
        row.lower_bound = read_size(file, table, "lower_bound");
        row.alternatives = read_values(file, table);
        if ((row.relative_error > 0) + (row.lower_bound > 0) + !row.alternatives.empty() != 1)
            file.fail(table, "an uncertainty has one of 'relative_error', 'lower_bound' and 'values'");
        result.push_back(std::move(row));
    }
    return result;
}

std::string uncertainty_text(const std::vector<ParameterUncertainty>& rows) {
    std::string text;
    for (const ParameterUncertainty& row : rows) {
        text += fmt::format("\n[[uncertainty]]\nkey = \"{}\"\nof = \"{}\"\n", row.key, row.of);
        if (row.relative_error > 0) text += fmt::format("relative_error = {:.2g}\n", row.relative_error);
        if (row.lower_bound > 0) text += fmt::format("lower_bound = {}\n", twelve_digits(row.lower_bound));
        if (!row.alternatives.empty()) text += fmt::format("values = [{}]\n", fmt::join(row.alternatives, ", "));
    }
    return text;
}

}  // namespace clsurf::io
