#pragma once
// --survey of `report`: the page of a long log, judged and drawn shard by shard.

#include "cli/report/report_options.h"

namespace clsurf::cli {

/// The options of `report`, with --survey, --shards, --merge and --scratch.
void declare_report_with_shards(po::options_description& options);

/// Sets `shards` and `merged` if --survey is given; large columns are then kept in files. Throws UsageError: an
/// option that needs the whole log; InputError as read_survey() does.
void read_report_shards(const po::variables_map& values, ReportOptions& options);

}  // namespace clsurf::cli
