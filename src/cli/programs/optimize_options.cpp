#include "cli/programs/optimize_options.h"

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "cli/options/known_tool.h"
#include "cli/options/part.h"
#include "cli/options/work_frames.h"
#include "cli/programs/controller_command.h"
#include "cli/programs/front_output.h"
#include "core/error.h"
#include "core/file_name.h"
#include "core/version.h"
#include "io/files/compressed.h"
#include "io/formats/log_format.h"

namespace clsurf::cli {

void declare_optimize(po::options_description& options) {
    // clang-format off
    options.add_options()
        ("output,o", po::value<std::string>()->value_name("FILE"), "the new program")
        ("picture", po::value<std::string>()->value_name("FILE"), "picture of the speeds, and of the differences between adjacent passes, before and after (.png, .jpg, .tif, .webp, .svg or .pdf), also if the new program is rejected")
        ("tolerance", po::value<double>()->value_name("MM"), "largest distance of the new path from the programmed path (default: 0.005)")
        ("feeds", po::value<std::string>()->value_name("searched|intervals"), "feeds of the new program: searched, so that adjacent passes run at equal speeds, or intervals, the planned speed of each constant-speed interval, as clsurf intervals lists them (default: searched)")
        ("splines", "write repaired sections as the splines of the dialect (fanuc G06.2, siemens BSPLINE, klartext SPL, linuxcnc G5 in planes of constant Z) where they need fewer blocks than the lines; three axes")
        ("machines", po::value<int>()->value_name("N"), "other machines that the new program must be better on, drawn from what the machine file says of its uncertainty (default: 4; 0: none)")
        ("more-time", po::value<double>()->value_name("PERCENT"), "additional machining time that is allowed for fewer defects (default: 0)")
        ("decimals", po::value<int>()->value_name("N"), "smallest number of decimals of new coordinates, if the controller reads them (default: as in the program)");
    // clang-format on
    options.add_options()(
        "log", po::value<std::string>()->value_name("LOG"),
        "a recorded run of the program: only places that differ from adjacent passes there are repaired; the result is still verified by simulation");
    options.add_options()(
        "round", po::value<std::vector<std::string>>()->multitoken()->value_name("PROGRAM LOG"),
        "an earlier repaired version of the program, and the log of its run; repeat the option for others. The machine is fitted to all logs, and the new program must be better than each version");
    declare_tool(
        options,
        "the tool, diameter and corner radius in mm: the new program must not leave a rougher surface (default: from the metadata of --log or from --tools)");
    declare_controller(options);
    options.add_options()(
        "runs", po::value<int>()->value_name("N"),
        "number of runs on the controller, including the program itself if it has no --log (default: 3)");
    declare_front(
        options,
        "the Pareto front of the candidates of the search by time, speed difference between adjacent passes, and jerk: a picture (.png, .jpg, .tif, .webp, .svg or .pdf) or a table (.csv or .json)",
        "chooses the new program from this front: 0 time alone … 1 surface alone (default: by the objective)");
    declare_log_options(options);
    declare_work_offset(options);
    declare_derivative(options);
    declare_simulation(options);
    declare_json(options);
    declare_program_options(options);
}

OptimizeRules read_optimize_rules(const po::variables_map& values) {
    OptimizeRules rules;
    if (values.count("tolerance") > 0) rules.tolerance = values["tolerance"].as<double>();
    if (!(rules.tolerance > 0) || !std::isfinite(rules.tolerance)) throw UsageError("--tolerance must be above 0 mm");
    if (values.count("decimals") > 0) rules.least_decimals = values["decimals"].as<int>();
    if (rules.least_decimals < 0 || rules.least_decimals > 9) throw UsageError("--decimals must be 0 to 9");
    if (values.count("more-time") > 0) rules.more_time = values["more-time"].as<double>() / 100;
    if (!(rules.more_time >= 0) || rules.more_time > 1) throw UsageError("--more-time must be 0 to 100 %");
    if (values.count("machines") > 0) rules.machines = values["machines"].as<int>();
    if (rules.machines < 0 || rules.machines > 100) throw UsageError("--machines must be 0 to 100");
    if (values.count("feeds") > 0 && values["feeds"].as<std::string>() == "intervals")
        rules.feeds = FeedChoice::intervals;
    rules.keeps_front = trades_off(values);
    rules.weight = read_weight(values);
    if (rules.keeps_front && values.count("controller") + values.count("round") > 0)
        throw UsageError(
            "--tradeoff and --weight choose by simulation: they cannot be combined with --controller or --round");
    rules.derivative = read_derivative(values);
    rules.splines = values.count("splines") > 0;
    if (rules.splines && rules.feeds == FeedChoice::intervals)
        throw UsageError("--feeds intervals writes feeds on lines, not on splines", "leave out --splines");
    rules.start = read_start(values);
    rules.header = fmt::format("clsurf {} optimize, tolerance {} mm", version, rules.tolerance);
    return rules;
}

int read_runs(const po::variables_map& values) {
    if (values.count("runs") == 0) return 3;
    if (values.count("controller") == 0) throw UsageError("--runs needs --controller");
    const int runs = values["runs"].as<int>();
    if (runs < 2 || runs > 1000) throw UsageError("--runs must be 2 to 1000");
    return runs;
}

std::vector<EarlierRound> read_rounds(const po::variables_map& values) {
    std::vector<EarlierRound> rounds;
    if (values.count("round") == 0) return rounds;
    const auto names = values["round"].as<std::vector<std::string>>();
    if (names.size() % 2 != 0)
        throw UsageError("--round takes two files, a program and the log of its run", "--round better.nc run.biip");
    if (values.count("log") == 0 && values.count("controller") == 0)
        throw UsageError("--round needs the log of the program itself: give --log");
    for (std::size_t k = 0; k < names.size(); k += 2) {
        const io::Source program = io::open_source(names[k]);
        rounds.push_back(
            {file_name(names[k]), {std::string(program.text()), io::open_log(names[k + 1], read_log_options(values))}});
    }
    return rounds;
}

std::optional<Log> read_measured(const po::variables_map& values, bool five_axes) {
    if (values.count("log") == 0) {
        for (const char* name : {"layout", "mapping", "period"}) {
            if (given(values, name)) throw UsageError(std::string("--") + name + " needs --log");
        }
        if (given(values, "work-offset") && !five_axes)
            throw UsageError("--work-offset needs --log, or a program that moves rotary axes");
        return std::nullopt;
    }
    return io::open_log(values["log"].as<std::string>(), read_log_options(values));
}

}  // namespace clsurf::cli
