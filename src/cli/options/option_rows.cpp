#include "cli/options/option_rows.h"

#include <utility>

#include <fmt/format.h>

#include "cli/options/options.h"

namespace clsurf::cli {

ShownOptions shown_options(const Subcommand& subcommand) {
    ShownOptions shown;
    subcommand.declare(shown.own);
    declare_common(shown.common);
    return shown;
}

std::string OptionRow::names() const {
    return fmt::format("{}{}{}{}", short_name.empty() ? "" : short_name + ", ", long_name,
                       value_name.empty() ? "" : " ", value_name);
}

std::string OptionRow::text() const {
    return default_value.empty() ? description : fmt::format("{} (default: {})", description, default_value);
}

std::vector<OptionRow> rows_of(const po::options_description& options) {
    std::vector<OptionRow> rows;
    for (const auto& option : options.options()) {
        OptionRow row;
        row.long_name = "--" + option->long_name();
        const std::string name = option->canonical_display_name(po::command_line_style::allow_dash_for_short);
        if (name.size() == 2 && name[0] == '-') row.short_name = name;
        // Boost appends the default to the value's name: "N (=3)".
        row.value_name = option->format_parameter();
        if (const std::size_t at = row.value_name.find(" (="); at != std::string::npos) {
            row.default_value = row.value_name.substr(at + 3, row.value_name.size() - at - 4);
            row.value_name.resize(at);
        }
        row.description = option->description();
        rows.push_back(std::move(row));
    }
    return rows;
}

std::vector<OptionRow> all_rows(const Subcommand& subcommand) {
    const ShownOptions shown = shown_options(subcommand);
    std::vector<OptionRow> rows = rows_of(shown.own);
    for (OptionRow& row : rows_of(shown.common)) rows.push_back(std::move(row));
    return rows;
}

bool names_a_file(std::string_view value_name) {
    return value_name.ends_with("FILE") || value_name.ends_with("FOLDER") ||
           value_name.find('.') != std::string_view::npos || value_name == "LOG" || value_name == "PROGRAM";
}

}  // namespace clsurf::cli
