#include "cli/diff_options.h"

#include "cli/difference_map.h"
#include "io/readers/budget_file.h"

namespace clsurf::cli {

void declare_diff(po::options_description& options) {
    // clang-format off
    options.add_options()
        ("budget", po::value<std::string>()->value_name("FILE"), "limits (TOML); exit code 1 if one is exceeded")
        ("output,o", po::value<std::string>()->value_name("FILE"), "a map of the differences: .png, .jpg, .tif, .webp, .svg or .pdf")
        ("color", po::value<std::string>()->value_name("speed|acceleration|lag|height"), "which difference the map shows (default: speed)");
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
    options.json = read_json_beside_output(values);
    return options;
}

}  // namespace clsurf::cli
