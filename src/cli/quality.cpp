#include "cli/quality.h"

#include <algorithm>
#include <limits>

#include "path/pieces.h"
#include "quality/scallop.h"

namespace clsurf::cli {
namespace {

std::optional<Trajectory> measured_of(const Part& part, std::optional<Role> wanted) {
    if (part.path.role != Role::commanded || wanted == Role::commanded) return std::nullopt;
    if (wanted) return reconstruct_like(part.log, *wanted, part.path);
    for (const Role role : {Role::actual, Role::feedback}) {
        if (part.log.has(role)) return reconstruct_like(part.log, role, part.path);
    }
    return std::nullopt;
}

}  // namespace

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

PartSignals signals_of(const Part& part, const ClSurface& surface, std::optional<Role> wanted) {
    PartSignals result{measured_of(part, wanted), smooth_pieces(part.log, surface.passes), {}};
    result.signals = derive_signals(surface, part.path, result.measured ? &*result.measured : nullptr, result.pieces, usual_end_zone(surface.step_over));
    return result;
}

Quality judge(Part& part, const ClSurface& surface, std::optional<Role> wanted, const QualityOptions& options, StageClock& clock) {
    Quality quality;
    clock.begin("derive the signals");
    const PartSignals read = signals_of(part, surface, wanted);
    clock.begin("find the defects");
    quality.report = find_defects(surface, read.signals, *part.lines, part.program, part.log.period, options.rules);
    if (surface.step_over <= 0) {
        part.diagnostics.add({Severity::note, "quality.single-pass", Place::of_file(part.log.name), "no pass has another beside it: there is nothing to compare", {}});
    }
    if (options.tool_given && options.tool.kind == ToolKind::ball && surface.step_over > 0 && surface.step_over < 2 * options.tool.radius) {
        quality.scallop = scallop_height(options.tool.radius, surface.step_over, std::numeric_limits<double>::infinity());
    }
    if (options.tool_given && surface.step_over > 0) {
        clock.begin("measure the formed surface");
        const FormedSurface formed(surface, read.signals, part.path.role, read.swept(part), read.pieces, options.tool);
        quality.formed = measure_formed(formed, read.signals, quality.report);
    }
    return quality;
}

}  // namespace clsurf::cli
