#include "cli/options.h"

#include <cstdio>

namespace clsurf::cli {

void declare_common(po::options_description& options) {
    // clang-format off
    options.add_options()
        ("help,h", "show this help")
        ("quiet,q", "print errors only")
        ("verbose,v", "print notes and what was done")
        ("threads", po::value<int>()->value_name("N"), "threads to use (default: all cores)")
        ("progress", po::value<std::string>()->value_name("WHEN"), "auto, always or never (default: auto, on a terminal)");
    // clang-format on
}

CommonOptions read_common(const po::variables_map& values) {
    CommonOptions common;
    common.quiet = values.count("quiet") > 0;
    common.verbose = values.count("verbose") > 0;
    if (values.count("threads") > 0) {
        common.threads = values["threads"].as<int>();
        if (common.threads < 1) throw UsageError("--threads must be at least 1");
    }
    if (values.count("progress") > 0) common.progress = values["progress"].as<std::string>();
    if (common.progress != "auto" && common.progress != "always" && common.progress != "never") {
        throw UsageError("--progress: '" + common.progress + "' is not auto, always or never");
    }
    return common;
}

void declare_program_options(po::options_description& options) {
    // clang-format off
    options.add_options()
        ("dialect", po::value<std::string>()->value_name("NAME"), "language of the program (default: detected; see `clsurf help dialects`)")
        ("block-delete", po::value<std::string>()->value_name("ON|OFF"), "skip blocks that begin with / (default: on)");
    // clang-format on
}

bool read_block_delete(const po::variables_map& values) {
    if (values.count("block-delete") == 0) return true;
    const std::string word = values["block-delete"].as<std::string>();
    if (word != "on" && word != "off") throw UsageError("--block-delete: '" + word + "' is not on or off");
    return word == "on";
}

std::string read_dialect(const po::variables_map& values) {
    return values.count("dialect") > 0 ? values["dialect"].as<std::string>() : std::string();
}

void declare_log_options(po::options_description& options) {
    // clang-format off
    options.add_options()
        ("layout", po::value<std::string>()->value_name("FILE"), "layout of a foreign fixed-record log (TOML)")
        ("mapping", po::value<std::string>()->value_name("FILE"), "names, units and roles of the columns of a text log (TOML)")
        ("period", po::value<double>()->value_name("S"), "sampling period of a log that does not tell [s]");
    // clang-format on
}

io::LogOptions read_log_options(const po::variables_map& values) {
    io::LogOptions options;
    if (values.count("layout") > 0) options.layout = values["layout"].as<std::string>();
    if (values.count("mapping") > 0) options.mapping = values["mapping"].as<std::string>();
    if (values.count("period") > 0) {
        options.period = values["period"].as<double>();
        if (!(*options.period > 0)) throw UsageError("--period must be greater than 0");
    }
    return options;
}

std::string required(const po::variables_map& values, const char* name) {
    if (values.count(name) == 0 || values[name].as<std::string>().empty()) {
        throw UsageError(std::string("missing argument: ") + name);
    }
    return values[name].as<std::string>();
}

void print(const Diagnostics& diagnostics, const po::variables_map& values) {
    const CommonOptions common = read_common(values);
    for (const Diagnostic& diagnostic : diagnostics.summary()) {
        const bool shown = diagnostic.severity == Severity::error ||
                           (diagnostic.severity == Severity::warning && !common.quiet) ||
                           (diagnostic.severity == Severity::note && common.verbose);
        if (shown) std::fputs(to_text(diagnostic).c_str(), stderr);
    }
}

}  // namespace clsurf::cli
