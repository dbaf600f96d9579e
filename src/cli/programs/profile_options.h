#pragma once
// Options of `profile`: the scan, the fit, the program.

#include "cli/subcommand.h"
#include "io/readers/measured_file.h"
#include "scan/scan_cut.h"

namespace clsurf::cli {

void declare_profile_options(po::options_description& options);

struct ProfileOptions {
    io::MeasuredColumns columns;
    SensorMount mount;
    ScanCutRules cut;
    std::string dialect = "linuxcnc";
    std::string pass;  ///< program of a finished pass; the scan then has its deviations; empty: the scan is the profile
    bool splines = false;
    double feed = 0;       ///< [mm/min]
    double clearance = 0;  ///< [mm] height above the highest point of the path
};
/// Throws UsageError.
[[nodiscard]] ProfileOptions read_profile_options(const po::variables_map& values);

}  // namespace clsurf::cli
