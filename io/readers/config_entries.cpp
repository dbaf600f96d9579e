#include "io/readers/config_entries.h"

#include <algorithm>

#include <fmt/format.h>

namespace clsurf::io {
namespace {

std::string text_of_value(const TomlFile& file, std::string_view key, const toml::node& node) {
    if (const auto text = node.value<std::string>(); node.is_string()) return *text;
    if (node.is_integer()) return fmt::format("{}", *node.value<std::int64_t>());
    if (node.is_floating_point()) return fmt::format("{}", *node.value<double>());
    file.fail(node, fmt::format("'{}' must be a text in quotes, a number, true, false or a list of those", key));
}

}  // namespace

std::vector<ConfigEntry> config_entries(const TomlFile& file, const std::string& path, const toml::table& table,
                                        const std::vector<std::string_view>& except) {
    std::vector<ConfigEntry> entries;
    for (const auto& [key, node] : table) {
        if (std::ranges::find(except, key.str()) != except.end()) continue;
        ConfigEntry entry;
        entry.key = std::string(key.str());
        const toml::source_position at = node.source().begin;
        entry.where = Place::of_line(path, at.line, static_cast<std::uint32_t>(at.column));
        if (node.is_boolean()) {
            entry.is_flag = true;
            entry.on = *node.value<bool>();
        } else if (const toml::array* array = node.as_array()) {
            for (const toml::node& element : *array) entry.values.push_back(text_of_value(file, key.str(), element));
        } else {
            entry.values.push_back(text_of_value(file, key.str(), node));
        }
        entries.push_back(std::move(entry));
    }
    std::sort(entries.begin(), entries.end(),
              [](const ConfigEntry& a, const ConfigEntry& b) { return a.where.number < b.where.number; });
    return entries;
}

}  // namespace clsurf::io
