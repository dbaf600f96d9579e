#include "io/reports/settings_text.h"

#include <fmt/format.h>

#include "core/version.h"
#include "io/readers/machine_file.h"

namespace clsurf::io {
namespace {

std::string settings_text(const Machine& machine, const PlanSettings& settings) {
    return machine_text(with_settings(machine, settings));
}

}  // namespace

std::string chosen_settings_text(const Machine& machine, const PlanSettings& settings, double weight) {
    return fmt::format("# clsurf {} simulate --weight {:g}: {}\n", version, weight, text_of(settings)) +
           settings_text(machine, settings);
}

MachineOfSettings machines_as_read(const Machine& machine) {
    return [&machine](const PlanSettings& settings) {
        return settings == PlanSettings{} ? machine : machine_of_text(settings_text(machine, settings), "settings");
    };
}

}  // namespace clsurf::io
