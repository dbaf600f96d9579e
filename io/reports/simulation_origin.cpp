#include "io/reports/simulation_origin.h"

#include <fmt/format.h>

#include "core/printable_text.h"
#include "io/files/json_value.h"
#include "io/reports/fidelity_report.h"

namespace clsurf::io {

std::string with_simulation(const std::string& metadata, const Machine& machine) {
    Json json = parse_bounded(metadata);
    if (!json.is_object()) json = Json::object();
    json["simulation"] = Json{{"machine", machine.name}, {"fidelity", fidelity_json(machine.fidelity)}};
    return dump_compact(json);
}

std::optional<SimulationOrigin> simulation_origin(const Log& log) {
    const Json json = parse_bounded(log.metadata);
    if (!json.is_object() || !json.contains("simulation") || !json["simulation"].is_object()) return std::nullopt;
    const Json& simulation = json["simulation"];
    SimulationOrigin origin;
    if (simulation.contains("machine") && simulation["machine"].is_string())
        origin.machine = simulation["machine"].get<std::string>();
    if (simulation.contains("fidelity")) origin.fidelity = read_fidelity(simulation["fidelity"]);
    return origin;
}

std::string origin_text(const std::optional<SimulationOrigin>& origin) {
    if (!origin) return {};
    return fmt::format("This log was simulated for the machine \"{}\".\n", printable(origin->machine)) +
           fidelity_line(origin->fidelity);
}

}  // namespace clsurf::io
