#include "cli/report/report_options.h"

#include <fmt/format.h>

#include "cli/options/follow.h"
#include "core/error.h"

namespace clsurf::cli {
namespace {

/// The options that `render` needs to read the same, as words of a command line. The page itself adds the shown positions.
std::vector<std::string> reading_options_of(const po::variables_map& values) {
    po::options_description reading;
    declare_part(reading);
    return words_of(reading, values, {"surface"});
}

}  // namespace

void declare_report(po::options_description& options) {
    // clang-format off
    options.add_options()
        ("output,o", po::value<std::string>()->value_name("FILE"), "the page (HTML)")
        ("before", po::value<std::string>()->value_name("LOG"), "another log of the program, shown on the same scale")
        ("accepted", po::value<std::string>()->value_name("FILE"), "accepted defects (JSON) that an earlier page saved; the new page shows them as accepted")
        ("fields", po::value<std::string>()->value_name("FIELD,…"), "fields for colouring and plotting (default: motion, also of each axis, errors, differences to adjacent passes, the log's own channels)")
        ("color", po::value<std::string>()->value_name("FIELD"), "field that is shown first (default: the first of the fields)")
        ("max-size", po::value<double>()->value_name("MB"), "largest size of the file; points are left out if necessary (default: 30)")
        ("gl", po::value<std::string>()->value_name("osmesa|egl"), "renderer of the pictures: osmesa uses the processor, egl a graphics card (default: osmesa)");
    // clang-format on
    declare_tool(options);
    declare_part(options);
    declare_derivative(options);
    declare_measured_file(options);
    declare_measured(options);
    declare_follow(options,
                   "the log is still being written: write the page again every few seconds until the log ends");
}

ReportOptions read_report_options(const po::variables_map& values) {
    ReportOptions options;
    options.part = read_part_options(values);
    options.measured = take_measured_role(options.part);
    options.output = required(values, "output");
    if (values.count("before") > 0) options.before = values["before"].as<std::string>();
    if (values.count("accepted") > 0) options.accepted = io::read_accepted(values["accepted"].as<std::string>());
    options.gl = values.count("gl") > 0 ? values["gl"].as<std::string>() : "osmesa";
    if (values.count("fields") > 0) {
        options.fields = split_names(values["fields"].as<std::string>());
        if (options.fields.empty() || options.fields.size() > 32)
            throw UsageError("--fields: 1 to 32 names separated by commas");
    }
    if (values.count("color") > 0) options.first_field = values["color"].as<std::string>();
    const double megabytes = values.count("max-size") > 0 ? values["max-size"].as<double>() : 30.0;
    if (!(megabytes >= 2 && megabytes <= 2000)) throw UsageError("--max-size must be 2 … 2000 MB");
    options.most_bytes = static_cast<std::uint64_t>(megabytes * 1e6);
    if (values.count("measured") > 0) {
        if (given(values, "follow"))
            throw UsageError("--measured does not apply to --follow: the part can be measured when it is finished");
        options.measurement = read_measurement(values);
    } else if (const char* alone = given_measured_option(values)) {
        throw UsageError(fmt::format("--{} needs --measured", alone));
    }
    options.reading_options = reading_options_of(values);
    return options;
}

}  // namespace clsurf::cli
