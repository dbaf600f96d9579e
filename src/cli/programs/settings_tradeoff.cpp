#include "cli/programs/settings_tradeoff.h"

#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "cli/options/options.h"
#include "cli/options/output_format.h"
#include "cli/options/work_frames.h"
#include "cli/programs/written_run.h"
#include "cli/progress_bar.h"
#include "core/error.h"
#include "core/file_name.h"
#include "io/files/compressed.h"
#include "io/readers/machine_file.h"
#include "io/readers/program_file.h"
#include "io/reports/settings_text.h"
#include "io/reports/tradeoff_report.h"
#include "pipeline/simulated_log.h"
#include "tradeoff/settings_search.h"

namespace clsurf::cli {
namespace {

SettingsRules read_settings_rules(const po::variables_map& values) {
    SettingsRules rules;
    if (values.count("more-time") > 0) rules.more_time = values["more-time"].as<double>() / 100;
    if (!(rules.more_time > 0) || rules.more_time > 10) throw UsageError("--more-time must be above 0, at most 1000 %");
    if (values.count("runs") > 0) rules.runs = values["runs"].as<int>();
    if (rules.runs < 2 || rules.runs > 10000) throw UsageError("--runs must be 2 to 10000");
    rules.start = read_start(values);
    return rules;
}

/// The output files of a choice.
struct ChoiceOutputs {
    std::string log;                           ///< empty: none
    std::unique_ptr<io::AtomicFile> settings;  ///< nullptr: none

    explicit ChoiceOutputs(const po::variables_map& values, bool chooses) {
        for (const char* name : {"output", "settings"}) {
            if (values.count(name) > 0 && !chooses)
                throw UsageError(fmt::format("--{} with --tradeoff writes the settings that are chosen", name),
                                 "give --weight, 0 (time alone) to 1 (surface alone)");
        }
        if (values.count("output") > 0) {
            log = values["output"].as<std::string>();
            (void)output_format(log, log_formats());
        }
        if (values.count("settings") > 0) {
            const std::string path = values["settings"].as<std::string>();
            if (is_standard_output(path)) throw UsageError("--settings writes a file, not standard output");
            (void)output_format(path, toml_formats(), {}, "--settings");
            settings = std::make_unique<io::AtomicFile>(path);
        }
    }
};

}  // namespace

void declare_settings_tradeoff(po::options_description& options) {
    declare_front(
        options,
        "simulates the program at many settings of the machine, and writes the Pareto front of time, speed difference between adjacent passes, and jerk: a picture (.png, .jpg, .tif, .webp, .svg or .pdf) or a table (.csv or .json)",
        "chooses from the front: 0 time alone … 1 surface alone; -o and --settings write the choice");
    // clang-format off
    options.add_options()
        ("settings", po::value<std::string>()->value_name("FILE"), "machine file with the settings that --weight chooses")
        ("more-time", po::value<double>()->value_name("PERCENT"), "settings that take longer than this are left out of the front (default: 50)")
        ("runs", po::value<int>()->value_name("N"), "largest number of settings that are simulated for the front (default: 48)");
    // clang-format on
}

void refuse_settings_options(const po::variables_map& values) {
    for (const char* name : {"settings", "more-time", "runs"}) {
        if (given(values, name)) throw UsageError(fmt::format("--{} needs --tradeoff or --weight", name));
    }
}

ExitCode trade_off_settings(const po::variables_map& values) {
    if (values.count("controller") > 0)
        throw UsageError("--tradeoff simulates: it cannot be combined with --controller");
    const bool json = read_json_with_output(values);
    const std::optional<double> weight = read_weight(values);
    const SettingsRules rules = read_settings_rules(values);
    const ChoiceOutputs outputs(values, weight.has_value());
    FrontOutput front_output(values);
    const Machine machine =
        values.count("machine") > 0 ? io::read_machine(values["machine"].as<std::string>()) : Machine{};
    io::ProgramOptions as_programmed = read_program_options(values);
    as_programmed.coordinates.reset();
    const Program program = io::read_program(io::open_source(required(values, "PROGRAM")), as_programmed);
    PartRules judging;
    if (machine.kinematics.has_rotary()) {
        if (!runs_on_five_axes(program, machine))
            throw UsageError("--tradeoff: the program moves no rotary axis, but the machine has them",
                             "give a machine file of three axes");
        judging.kinematics = std::make_shared<const Kinematics>(machine.kinematics);
        judging.poses = read_work_offset(values);
    }
    const std::string name = file_name(program.main().name());
    const MachineOfSettings machine_of = io::machines_as_read(machine);
    ProgressBar bar(read_common(values));
    SettingsTradeoff found = search_settings(program, machine, machine_of, judging, rules, bar.callback());
    bar.clear();
    Diagnostics diagnostics = program.diagnostics;
    if (weight) {
        found.front.weight = weight;
        found.front.chosen = front_by_weight(found.front.rows, *weight).front();
        const PlanSettings& chosen = found.settings[*found.front.chosen];
        if (outputs.settings) {
            outputs.settings->write(io::chosen_settings_text(machine, chosen, *weight));
            outputs.settings->commit();
        }
        if (!outputs.log.empty()) diagnostics = write_run(machine_of(chosen), outputs.log, values).diagnostics;
    }
    front_output.write(found.front, found.settings, fmt::format("Time against surface: {} on {}", name, machine.name),
                       diagnostics);
    if (json) {
        write_to_stdout(io::tradeoff_json(found.front, found.settings, diagnostics));
    } else {
        print(diagnostics, values);
        write_answer(io::tradeoff_text(found.front), values);
    }
    return ExitCode::done;
}

}  // namespace clsurf::cli
