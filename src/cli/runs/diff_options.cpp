#include "cli/runs/diff_options.h"

#include <algorithm>
#include <filesystem>

#include "cli/options/part.h"
#include "cli/pictures/difference_map.h"
#include "io/files/compressed.h"
#include "io/readers/budget_file.h"

namespace clsurf::cli {
namespace {

/// Whether a compared file may be a program. A pipe may be one, and cannot be read twice.
bool may_simulate(const DiffOptions& options) {
    return std::any_of(options.files.begin(), options.files.end(), [&](const std::string& file) {
        return !std::filesystem::is_regular_file(file) || !is_log(io::open_source(file), options.runs.log_options);
    });
}

/// Refuses options without effect.
void refuse_unused(const po::variables_map& values, const DiffOptions& options) {
    if (options.output.empty()) {
        po::options_description of_map;
        declare_look(of_map);
        of_map.add_options()("color", "");
        refuse_given(values, of_map, "a map of the differences", "-o FILE draws it");
    }
    if (may_simulate(options)) return;
    if (given(values, "start")) throw UsageError("--start needs a program that is simulated, as A or B");
    if (options.runs.program.empty()) refuse_program_options(values, "--program FILE names the program of the logs");
}

}  // namespace

void declare_diff(po::options_description& options) {
    // clang-format off
    options.add_options()
        ("budget", po::value<std::string>()->value_name("FILE"), "limits (TOML); exit code 1 if one is exceeded")
        ("output,o", po::value<std::string>()->value_name("FILE"), "a map of the differences: .png, .jpg, .tif, .webp, .svg or .pdf")
        ("color", po::value<std::string>()->value_name("speed|acceleration|lag|height|jerk"), "which difference the map shows (default: speed)");
    // clang-format on
    declare_json(options);
    declare_runs(options);
    declare_look(options);
}

DiffOptions read_diff_options(const po::variables_map& values) {
    DiffOptions options;
    options.files.push_back(required(values, "A"));
    if (values.count("B") == 0) throw UsageError("missing argument: B");
    for (const std::string& file : values["B"].as<std::vector<std::string>>()) options.files.push_back(file);
    options.runs = read_run_options(values);
    if (values.count("budget") > 0) options.budget = io::read_run_budget(values["budget"].as<std::string>());
    options.output = text_of(values, "output", "");
    options.shown = parse_quantity(text_of(values, "color", "speed"));
    options.look = read_look_options(values);
    options.json = read_json_with_output(values);
    refuse_unused(values, options);
    return options;
}

}  // namespace clsurf::cli
