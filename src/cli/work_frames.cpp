#include "cli/work_frames.h"

#include <cmath>

#include <fmt/format.h>

#include "cli/options.h"
#include "core/units.h"

namespace clsurf::cli {
namespace {

/// The number of a work system: 1 of G54, 7 of G59.1 and of G54.1 P1. Throws UsageError.
int system_of(const std::string& name) {
    constexpr int most = 300;
    for (int number = 1; number <= most; ++number) {
        for (const DialectId id : {DialectId::linuxcnc, DialectId::fanuc, DialectId::siemens}) {
            const Dialect dialect{id, {}, {}};
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

/// To a micrometre or a thousandth of a degree, as offsets are entered: "12.5", "-3".
std::string decimals(double value) {
    std::string text = fmt::format("{:.3f}", value);
    text.resize(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text == "-0" ? "0" : text;
}

}  // namespace

void declare_work_offset(po::options_description& options) {
    options.add_options()("work-offset", po::value<std::vector<std::string>>()->composing()->value_name("X,Y,Z[,R]"),
                          "machine position of the program's zero [mm], and its rotation about Z [deg] (default: what "
                          "the log tells, else the program); G55:X,Y,Z,R is of one work system, given once for each");
}

FramePoses read_work_offset(const po::variables_map& values) {
    FramePoses poses;
    if (values.count("work-offset") == 0) return poses;
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

std::optional<Eigen::Isometry3d> pose_of(const Log& log) {
    if (!log.work_offset) return std::nullopt;
    return clsurf::pose_of(*log.work_offset, log.work_rotation);
}

Eigen::Isometry3d place_with(Program& program, const Log& log, FramePoses given, const Kinematics* kinematics,
                             Diagnostics& diagnostics) {
    if (!given.zero) given.zero = pose_of(log);
    given.tool_by_kinematics = kinematics != nullptr;
    const std::vector<int> unknown = unknown_systems(program.motions);
    if (unknown.size() > 1) {
        std::string names;
        bool missing = false;
        for (const int system : unknown) {
            const std::string name = name_of_work_system(system, program.dialect);
            names += (names.empty() ? "" : system == unknown.back() ? " and " : ", ") + name;
            missing = missing || (system != unknown.front() && !given.systems.contains(system));
        }
        if (missing) {
            diagnostics.add({Severity::note, "program.work-offset", Place::of_file(program.main().name()),
                             fmt::format("cuts in {}, and sets none of them: they are taken to lie where {} lies",
                                         names, name_of_work_system(unknown.front(), program.dialect)),
                             "--work-offset G55:X,Y,Z says where one of them lies"});
        }
    }
    return place_motions(program, given);
}

std::string work_offset_text(const Eigen::Isometry3d& pose) {
    const Vec3 t = pose.translation();
    std::string text = fmt::format("{},{},{}", decimals(t.x()), decimals(t.y()), decimals(t.z()));
    const double turn = std::atan2(pose.linear()(1, 0), pose.linear()(0, 0)) * deg_per_rad;
    if (decimals(turn) != "0") text += "," + decimals(turn);
    return text;
}

}  // namespace clsurf::cli
