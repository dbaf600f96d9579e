// The table of subcommands. To add one: src/cli/subcommands/<name>.cpp, listed in src/cli/CMakeLists.txt, its
// declaration in subcommand.h, and a row here.

#include "cli/subcommand.h"
#include "core/spelling.h"

namespace clsurf::cli {

std::span<const Subcommand> subcommands() {
    static const std::vector<Subcommand> table{
        render_subcommand(),   check_subcommand(),     align_subcommand(),    report_subcommand(),
        query_subcommand(),    info_subcommand(),      moves_subcommand(),    plot_subcommand(),
        export_subcommand(),   convert_subcommand(),   record_subcommand(),   simulate_subcommand(),
        identify_subcommand(), diff_subcommand(),      optimize_subcommand(), profile_subcommand(),
        lint_subcommand(),     intervals_subcommand(), compare_subcommand(),  machine_subcommand(),
        history_subcommand(),  fleet_subcommand(),     survey_subcommand(),   help_subcommand(),
        manual_subcommand(),
    };
    return table;
}

const Subcommand& find_subcommand(std::string_view name) {
    std::vector<std::string_view> names;
    for (const Subcommand& s : subcommands()) {
        if (s.name == name) return s;
        if (!s.hidden) names.push_back(s.name);
    }
    throw UsageError("unknown subcommand '" + std::string(name) + "'", did_you_mean(name, names));
}

std::vector<const Subcommand*> shown_subcommands() {
    std::vector<const Subcommand*> shown;
    for (const Subcommand& subcommand : subcommands()) {
        if (!subcommand.hidden) shown.push_back(&subcommand);
    }
    return shown;
}

}  // namespace clsurf::cli
