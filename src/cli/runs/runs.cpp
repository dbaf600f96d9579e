#include "cli/runs/runs.h"

#include <utility>

#include "cli/options/part.h"
#include "io/files/compressed.h"
#include "io/readers/program_file.h"

namespace clsurf::cli {

PlacedRun load_run(const std::string& path, const RunOptions& options) {
    const io::Source source = io::open_source(path);
    if (source.bytes.empty()) throw InputError(Place::of_file(source.name), "is empty, expected a program or a log");
    if (is_log(source, options.log_options))
        return placed_run(path, io::open_log(source, options.log_options), options.placing);
    return simulate_run(path, io::read_program(source, options.program_options), options.machine, options.start,
                        options.placing);
}

ComparisonRules comparison_rules(const RunOptions& options) {
    ComparisonRules rules;
    rules.placing = options.placing;
    rules.role = options.role;
    rules.tool_of = [choice = options.tool](const Log& log, const Program* program, Diagnostics& diagnostics) {
        return find_tool(choice, &log, program, diagnostics);
    };
    rules.with_roughness = true;
    rules.other_roles_hint = "--surface names one that all have";
    rules.other_path_hint =
        "another part, or another work offset? --work-offset holds for all runs; `clsurf info` shows what a log states";
    return rules;
}

}  // namespace clsurf::cli
