#include "cli/programs/profile_options.h"

#include <cmath>

#include <fmt/format.h>

#include "cli/options/options.h"
#include "program/dialect.h"
#include "scan/cut_program.h"

namespace clsurf::cli {
namespace {

double number_of(const po::variables_map& values, const char* name, double least, double most) {
    const double value = values[name].as<double>();
    if (!(value >= least && value <= most))
        throw UsageError(fmt::format("--{} must be from {:g} to {:g}", name, least, most));
    return value;
}

void read_fit(const po::variables_map& values, FitRules& fit) {
    const std::string join = values.count("join") > 0 ? values["join"].as<std::string>() : "c1";
    fit.join = join == "c1" ? WindowJoin::c1 : join == "blend" ? WindowJoin::blend : WindowJoin::none;
    fit.degree = values["degree"].as<int>();
    const int least = fit.join == WindowJoin::c1 ? 2 : 1;
    if (fit.degree < least || fit.degree > most_fit_degree)
        throw UsageError(fmt::format("--degree of --join {} must be from {} to {}", join, least, most_fit_degree));
    const int window = values["window"].as<int>();
    if (window < fit.degree + 1)
        throw UsageError(fmt::format("--window must be at least {} points for degree {}", fit.degree + 1, fit.degree));
    fit.window = static_cast<std::size_t>(window);
}

}  // namespace

void declare_profile_options(po::options_description& options) {
    // clang-format off
    options.add_options()
        ("x", po::value<std::string>()->value_name("COLUMN"), "column of x, by name or number from 0 (default: x, the other one of two, or the first without names)")
        ("z", po::value<std::string>()->value_name("COLUMN"), "column of z, or of distances (default: z, height, or the second without names)")
        ("distance", po::value<double>()->value_name("REFERENCE"), "the column of z has distances, measured down from this height [mm]: z = REFERENCE - distance")
        ("sensor-offset", po::value<double>()->value_name("MM")->default_value(0, "0"), "how far along X the sensor is ahead of the place that is recorded [mm]; it is added to x")
        ("outliers", po::value<double>()->value_name("FACTOR")->default_value(5, "5"), "points that are more than FACTOR times the scatter away from the running median of nine places are rejected; 0: none is")
        ("degree", po::value<int>()->value_name("N")->default_value(3), "degree of the polynomials, 1 to 9")
        ("window", po::value<int>()->value_name("POINTS")->default_value(10), "scanned points of a window")
        ("join", po::value<std::string>()->value_name("c1|blend|none"), "how windows meet (default: c1): c1, one fit with continuous slope; blend, windows that overlap by half and pass into each other; none, each window by itself, with jumps")
        ("tool-offset", po::value<double>()->value_name("RADIUS")->default_value(0, "0"), "radius of a ball-end tool that cuts the fitted profile [mm]: its tip is programmed; without it the tip follows the fit")
        ("compensate", po::value<std::string>()->value_name("PROGRAM"), "SCAN has deviations along this finished pass, measured height less wanted height: the pass is corrected by them; --tool-offset is then the radius of the ball that made it")
        ("tolerance", po::value<double>()->value_name("MM")->default_value(0.01, "0.01"), "distance between program and path [mm], at most")
        ("blocks", po::value<std::string>()->value_name("lines|splines"), "what is written (default: lines): G1 (L), or cubic splines: POLY of siemens, SPL of klartext, G06.2 of fanuc")
        ("dialect", po::value<std::string>()->value_name("DIALECT"), "language of the program (default: linuxcnc)")
        ("feed", po::value<double>()->value_name("MM/MIN")->default_value(1000, "1000"), "feed of the cut")
        ("clearance", po::value<double>()->value_name("MM")->default_value(5, "5"), "height of approach and retract above the highest point");
    // clang-format on
}

ProfileOptions read_profile_options(const po::variables_map& values) {
    constexpr double longest = 1e5;  // mm
    ProfileOptions options;
    if (values.count("x") > 0 || values.count("z") > 0) {
        options.columns = {values.count("x") > 0 ? values["x"].as<std::string>() : "x",
                           values.count("z") > 0 ? values["z"].as<std::string>() : "z"};
    }
    if (values.count("distance") > 0) options.mount.reference = number_of(values, "distance", -longest, longest);
    options.mount.ahead = number_of(values, "sensor-offset", -longest, longest);
    options.cut.outliers = number_of(values, "outliers", 0, longest);
    read_fit(values, options.cut.fit);
    options.cut.radius = number_of(values, "tool-offset", 0, longest);
    if (options.cut.radius > 0 && options.cut.fit.join == WindowJoin::none)
        throw UsageError("--tool-offset needs a profile without jumps", "--join c1 or --join blend");
    if (values.count("compensate") > 0) options.pass = values["compensate"].as<std::string>();
    if (!options.pass.empty() && options.mount.reference)
        throw UsageError("--distance does not apply to --compensate: deviations are heights, not distances");
    constexpr double finest = 0.0005, coarsest = 10;  // mm: coordinates have four decimals
    options.cut.tolerance = number_of(values, "tolerance", finest, coarsest);
    options.splines = values.count("blocks") > 0 && values["blocks"].as<std::string>() == "splines";
    if (values.count("dialect") > 0) options.dialect = values["dialect"].as<std::string>();
    if (find_dialect(options.dialect) == nullptr)
        throw UsageError(fmt::format("unknown dialect '{}'", options.dialect), "`clsurf help dialects` lists them");
    if (options.splines && !writes_spans(options.dialect))
        throw UsageError(
            fmt::format("--blocks splines does not apply to {}, only to siemens, klartext and fanuc{}", options.dialect,
                        options.dialect == "linuxcnc" ? ": its G5 lies in the XY plane, and a profile in XZ" : ""));
    constexpr double slowest = 1;  // mm/min
    options.feed = number_of(values, "feed", slowest, longest);
    options.clearance = number_of(values, "clearance", 0, longest);
    return options;
}

}  // namespace clsurf::cli
