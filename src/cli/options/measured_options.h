#pragma once
// Options for reading a measurement and for its pose on the part.

#include "cli/subcommand.h"
#include "io/readers/measured_file.h"
#include "measured/align.h"

namespace clsurf::cli {

/// --measured.
void declare_measured_file(po::options_description& options);
/// --measured-at, --measured-columns, --measured-free, --measured-search.
void declare_measured(po::options_description& options);

struct MeasuredOptions {
    io::MeasuredColumns columns;
    AlignRules rules;
};
/// Throws UsageError.
[[nodiscard]] MeasuredOptions read_measured_options(const po::variables_map& values);
/// A measurement of a part, and its alignment rules.
struct Measurement {
    MeasuredData data;
    AlignRules rules;
};
/// Reads the file of --measured. Throws UsageError; InputError: the file cannot be read.
[[nodiscard]] Measurement read_measurement(const po::variables_map& values);
/// Warns if the residuals of the pose are larger than the scatter of the data.
void warn_of_misfit(const MeasuredData& data, const Alignment& alignment, Diagnostics& diagnostics);
/// The first of these options on the command line; nullptr: none.
[[nodiscard]] const char* given_measured_option(const po::variables_map& values);

}  // namespace clsurf::cli
