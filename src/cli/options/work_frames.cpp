#include "cli/options/work_frames.h"

#include <cmath>

#include <fmt/format.h>

#include "cli/options/options.h"
#include "core/units.h"
#include "mapping/work_offset.h"

namespace clsurf::cli {
namespace {

/// The number of a work system: 1 of G54, 7 of G59.1 and of G54.1 P1. Throws UsageError.
int system_of(const std::string& name) {
    constexpr int most = 300;
    for (int number = 1; number <= most; ++number) {
        for (const Dialect& dialect : dialects()) {
            std::string known = name_of_work_system(number, &dialect);
            std::erase(known, ' ');
            if (known == name) return number;
        }
    }
    throw UsageError("--work-offset: '" + name + "' is not a work system: G54 … G59, G59.1 … G59.3, G54.1P1, G505");
}

Eigen::Isometry3d pose_from(const std::string& text) {
    const std::vector<double> numbers = parse_numbers(text, "--work-offset", 0);
    if (numbers.size() != 3 && numbers.size() != 4)
        throw UsageError("--work-offset: '" + text + "' is not 3 or 4 numbers: X,Y,Z or X,Y,Z,R");
    return clsurf::pose_of(Vec3(numbers[0], numbers[1], numbers[2]), numbers.size() > 3 ? numbers[3] : 0.0);
}

}  // namespace

void declare_work_offset(po::options_description& options, bool with_log) {
    const std::string text = fmt::format(
        "machine position of the program's zero [mm], and its rotation about Z [deg] (default: {}); G55:X,Y,Z,R sets one work offset; repeat the option for others",
        with_log ? "from the log, else from the program" : "from the program");
    options.add_options()("work-offset", po::value<std::vector<std::string>>()->composing()->value_name("X,Y,Z[,R]"),
                          text.c_str());
}

FramePoses read_work_offset(const po::variables_map& values) {
    FramePoses poses;
    if (values.count("work-offset") == 0) return poses;
    poses.zero_is_default = !given(values, "work-offset");
    for (const std::string& text : values["work-offset"].as<std::vector<std::string>>()) {
        const std::size_t colon = text.find(':');
        if (colon != std::string::npos) {
            poses.systems[system_of(text.substr(0, colon))] = pose_from(text.substr(colon + 1));
            continue;
        }
        if (poses.zero) throw UsageError("--work-offset is given twice; that of a work system is G55:X,Y,Z");
        poses.zero = pose_from(text);
    }
    return poses;
}

std::string pose_metadata(const std::optional<Eigen::Isometry3d>& pose) {
    if (!pose) return "{}";
    const Vec3 t = pose->translation();
    const double turn = std::atan2(pose->linear()(1, 0), pose->linear()(0, 0)) * deg_per_rad;
    return fmt::format("{{\"work_offset\": [{}, {}, {}{}]}}", t.x(), t.y(), t.z(),
                       turn == 0 ? "" : fmt::format(", {}", turn));
}

}  // namespace clsurf::cli
