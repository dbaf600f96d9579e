#include "python/tradeoff.h"

#include <memory>

#include "core/error.h"
#include "io/files/compressed.h"
#include "io/readers/machine_file.h"
#include "io/readers/program_file.h"
#include "io/reports/settings_text.h"
#include "io/reports/tradeoff_report.h"
#include "pipeline/simulated_log.h"
#include "tradeoff/settings_search.h"

namespace clsurf::python {
namespace {

SettingsRules rules_of(const TradeoffOptions& tradeoff) {
    constexpr int most_runs = 10'000;
    constexpr double most_time = 1000;
    if (!(tradeoff.more_time_percent > 0) || tradeoff.more_time_percent > most_time)
        throw UsageError("more_time_percent must be above 0, at most 1000");
    if (tradeoff.runs < 2 || tradeoff.runs > most_runs) throw UsageError("runs must be 2 to 10000");
    require_weight(tradeoff.weight);
    const auto& [x, y, z] = tradeoff.start;
    return {tradeoff.more_time_percent / 100, tradeoff.runs, Vec3(x, y, z)};
}

}  // namespace

void require_weight(const std::optional<double>& weight) {
    if (weight && !(*weight >= 0 && *weight <= 1))
        throw UsageError("weight must be 0 (time alone) to 1 (surface alone)");
}

std::pair<std::string, std::string> trade_off_settings(const PartOptions& options, const TradeoffOptions& tradeoff) {
    const SettingsRules rules = rules_of(tradeoff);
    const Machine machine = options.machine.empty() ? Machine{} : io::read_machine(options.machine);
    io::ProgramOptions as_programmed = program_options_of(options);
    as_programmed.coordinates.reset();
    const Program program = io::read_program(io::open_source(options.program), as_programmed);
    PartRules judging;
    if (machine.kinematics.has_rotary()) {
        if (!runs_on_five_axes(program, machine))
            throw UsageError("the program moves no rotary axis, but the machine has them",
                             "give a machine file of three axes");
        judging.kinematics = std::make_shared<const Kinematics>(machine.kinematics);
        judging.poses = poses_of(options);
    }
    SettingsTradeoff found = search_settings(program, machine, io::machines_as_read(machine), judging, rules, {});
    std::string chosen;
    if (tradeoff.weight) {
        TradeoffFront& front = found.front;
        front.weight = tradeoff.weight;
        front.chosen = front_by_weight(front.rows, *front.weight).front();
        chosen = io::chosen_settings_text(machine, found.settings[*front.chosen], *front.weight);
    }
    return {io::tradeoff_json(found.front, found.settings, program.diagnostics), std::move(chosen)};
}

}  // namespace clsurf::python
