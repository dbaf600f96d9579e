#include "cli/quality.h"

#include <algorithm>
#include <limits>

#include "path/pieces.h"
#include "quality/scallop.h"

namespace clsurf::cli {
namespace {

constexpr double end_zone_step_overs = 2;
constexpr double least_end_zone = 1.0;  ///< [mm]

}  // namespace

std::optional<Trajectory> measured_of(const Part& part, std::optional<Role> wanted) {
    if (part.path.role != Role::commanded || wanted == Role::commanded) return std::nullopt;
    if (wanted) return reconstruct(part.log, *wanted, part.path.offset);
    for (const Role role : {Role::actual, Role::feedback}) {
        if (part.log.has(role)) return reconstruct(part.log, role, part.path.offset);
    }
    return std::nullopt;
}

void declare_quality(po::options_description& options) {
    // clang-format off
    options.add_options()
        ("tool", po::value<std::string>()->value_name("ball:D|bull:D,R|flat:D"), "the tool, diameter and corner radius in mm; tells scallop, roughness and how deep marks are once the neighbours have cut");
    // clang-format on
}

QualityOptions read_quality_options(const po::variables_map& values) {
    QualityOptions options;
    options.tool_given = values.count("tool") > 0;
    if (options.tool_given) options.tool = parse_tool(values["tool"].as<std::string>());
    return options;
}

std::optional<Role> take_measured_role(PartOptions& options) {
    if (!options.role_given) return std::nullopt;
    const Role role = options.role;
    options.role = Role::commanded;
    options.role_given = false;
    return role;
}

Signals signals_of(const Part& part, const ClSurface& surface, std::optional<Role> wanted, const QualityRules& rules) {
    const std::optional<Trajectory> measured = measured_of(part, wanted);
    const double end_zone = rules.end_zone > 0 ? rules.end_zone : std::max(least_end_zone, end_zone_step_overs * surface.step_over);
    return derive_signals(surface, part.path, measured ? &*measured : nullptr, smooth_pieces(part.log, surface.passes), end_zone);
}

Quality judge(Part& part, const ClSurface& surface, std::optional<Role> wanted, const QualityOptions& options, StageClock& clock) {
    Quality quality;
    clock.begin("derive the signals");
    quality.signals = signals_of(part, surface, wanted, options.rules);
    clock.begin("find the defects");
    quality.report = find_defects(surface, quality.signals, *part.lines, part.program, part.log.period, options.rules);
    if (surface.step_over <= 0) {
        part.diagnostics.add({Severity::note, "quality.single-pass", Place::of_file(part.log.name), "no pass has another beside it: there is nothing to compare", {}});
    }
    if (options.tool_given && options.tool.kind == ToolKind::ball && surface.step_over > 0 && surface.step_over < 2 * options.tool.radius) {
        quality.scallop = scallop_height(options.tool.radius, surface.step_over, std::numeric_limits<double>::infinity());
    }
    if (options.tool_given && surface.step_over > 0) {
        clock.begin("measure the formed surface");
        const std::optional<Trajectory> measured = measured_of(part, wanted);
        const std::vector<PointRange> pieces = smooth_pieces(part.log, surface.passes);
        const FormedSurface formed(surface, quality.signals, part.path.role, measured ? *measured : part.path, pieces, options.tool);
        quality.formed = measure_formed(formed, quality.signals, quality.report);
    }
    return quality;
}

}  // namespace clsurf::cli
