#include "io/history/parameter_file.h"

#include <array>

#include "core/error.h"
#include "core/spelling.h"
#include "io/files/toml_table.h"

namespace clsurf::io {
namespace {

ParameterKind read_kind(const TomlFile& file, const toml::table& table) {
    constexpr std::array kinds{ParameterKind::text, ParameterKind::number, ParameterKind::integer};
    const std::optional<std::string> word = file.text(table, "kind");
    std::vector<std::string_view> known;
    for (const ParameterKind kind : kinds) {
        if (!word || *word == name_of(kind)) return kind;
        known.push_back(name_of(kind));
    }
    file.fail(*table.get("kind"), "'" + *word + "' is not text, number or integer", did_you_mean(*word, known));
}

void read_range(const TomlFile& file, const toml::table& table, ParameterRule& rule) {
    const toml::node* node = table.get("range");
    if (node == nullptr) return;
    const toml::array* pair = node->as_array();
    const bool good = pair != nullptr && pair->size() == 2 && (*pair)[0].is_number() && (*pair)[1].is_number();
    if (!good) file.fail(*node, "a range is two numbers: [0, 0.2]");
    rule.low = (*pair)[0].value<double>();
    rule.high = (*pair)[1].value<double>();
    if (!(*rule.low <= *rule.high)) file.fail(*node, "the range ends before it begins");
}

void read_values(const TomlFile& file, const toml::table& table, ParameterRule& rule) {
    const toml::node* node = table.get("values");
    if (node == nullptr) return;
    const toml::array* list = node->as_array();
    if (list == nullptr || list->empty()) file.fail(*node, "values are a list of texts");
    for (const toml::node& element : *list) {
        const auto text = element.value<std::string>();
        if (!element.is_string()) file.fail(element, "values are a list of texts");
        rule.values.push_back(*text);
    }
}

}  // namespace

ParameterRules read_parameter_rules(const std::string& path) {
    const TomlFile file(path);
    ParameterRules rules;
    for (const auto& [key, node] : file.root()) {
        const toml::table* table = node.as_table();
        if (table == nullptr) file.fail(node, "a parameter is a table: [" + std::string(key.str()) + "]");
        file.allow(*table, {"kind", "unit", "range", "values", "required"});
        ParameterRule rule;
        rule.name = std::string(key.str());
        rule.kind = read_kind(file, *table);
        rule.unit = file.text(*table, "unit").value_or("");
        rule.required = file.boolean(*table, "required").value_or(false);
        read_range(file, *table, rule);
        read_values(file, *table, rule);
        const bool text = rule.kind == ParameterKind::text;
        for (const char* of_numbers : {"unit", "range"}) {
            if (text && table->get(of_numbers) != nullptr)
                file.fail(*table->get(of_numbers), "is for numbers, not for texts");
        }
        if (!text && table->get("values") != nullptr) file.fail(*table->get("values"), "is for texts, not for numbers");
        rules.rules.push_back(std::move(rule));
    }
    if (rules.rules.empty()) file.fail("names no parameter");
    return rules;
}

}  // namespace clsurf::io
