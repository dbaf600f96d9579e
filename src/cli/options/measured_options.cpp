#include "cli/options/measured_options.h"

#include <cmath>

#include <fmt/format.h>

#include "cli/options/options.h"
#include "core/units.h"

namespace clsurf::cli {

void declare_measured_file(po::options_description& options) {
    options.add_options()(
        "measured", po::value<std::string>()->value_name("FILE"),
        "the measurement of the part: a profile or points (delimited text), or an areal map (.sdf); needs the tool");
}

void declare_measured(po::options_description& options) {
    // clang-format off
    options.add_options()
        ("measured-at", po::value<std::string>()->value_name("X,Y[,ANGLE]"), "where the origin of the measurement is on the part [mm], and the angle from the part's X axis to its own [deg]; a profile and an areal map need it (default for points: 0,0,0)")
        ("measured-columns", po::value<std::string>()->value_name("NAMES"), "columns of x and z, or of x, y and z, by name or number from 0 (default: by their names)")
        ("measured-free", po::value<std::string>()->value_name("NAMES"), "what is fitted of the pose: x, y and z (shifts), a, b and c (rotations about them), in the axes of the measurement; the others stay as stated (default: all; of a profile x,z,b)")
        ("measured-search", po::value<double>()->value_name("MM"), "how far around the start other poses are tried (default: 1 mm, or three step-overs if that is more)");
    // clang-format on
}

void warn_of_misfit(const MeasuredData& data, const Alignment& alignment, Diagnostics& diagnostics) {
    if (const std::optional<std::string> misfit = misfit_of(alignment))
        diagnostics.add({Severity::warning, "measured.misfit", Place::of_file(data.name), *misfit, {}});
}

const char* given_measured_option(const po::variables_map& values) {
    for (const char* name : {"measured-at", "measured-columns", "measured-free", "measured-search"}) {
        if (given(values, name)) return name;
    }
    return nullptr;
}

MeasuredOptions read_measured_options(const po::variables_map& values) {
    MeasuredOptions options;
    if (values.count("measured-at") > 0) {
        const std::vector<double> place = parse_numbers(values["measured-at"].as<std::string>(), "--measured-at", 0);
        if (place.size() != 2 && place.size() != 3)
            throw UsageError("--measured-at needs two or three numbers",
                             "--measured-at 12.5,3 or --measured-at 12.5,3,90");
        options.rules.start = MeasuredPlace{Vec2(place[0], place[1]), place.size() == 3 ? place[2] * rad_per_deg : 0.0};
    }
    if (values.count("measured-columns") > 0) {
        options.columns = split_names(values["measured-columns"].as<std::string>());
        if (options.columns.size() != 2 && options.columns.size() != 3)
            throw UsageError("--measured-columns needs two or three columns: x,z or x,y,z");
    }
    if (values.count("measured-free") > 0) {
        options.rules.free.emplace();
        options.rules.free->fill(false);
        for (const std::string& name : split_names(values["measured-free"].as<std::string>())) {
            constexpr std::string_view axes = "xyzabc";
            const std::size_t axis = name.size() == 1 ? axes.find(name[0]) : std::string_view::npos;
            if (axis == std::string_view::npos)
                throw UsageError(fmt::format("--measured-free: '{}' is none of x, y, z, a, b and c", name));
            (*options.rules.free)[axis] = true;
        }
    }
    if (values.count("measured-search") > 0) {
        options.rules.search = values["measured-search"].as<double>();
        constexpr double most = 50;  // mm: some 10^6 poses
        if (!(options.rules.search > 0 && options.rules.search <= most))
            throw UsageError(fmt::format("--measured-search must be above 0 and at most {:g} mm", most));
    }
    return options;
}

Measurement read_measurement(const po::variables_map& values) {
    const MeasuredOptions options = read_measured_options(values);
    return {io::read_measured(values["measured"].as<std::string>(), options.columns), options.rules};
}

}  // namespace clsurf::cli
