// clsurf fleet: many runs into a history.

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "cli/history/fleet_runner.h"
#include "core/counted.h"
#include "core/parallel.h"
#include "history/memory_plan.h"
#include "io/history/history_database.h"
#include "io/reports/fleet_report.h"

namespace clsurf::cli {
namespace {

namespace fs = std::filesystem;

ExitCode merge(const po::variables_map& values, const std::string& database) {
    if (values.count("RUNS") == 0) throw UsageError("--merge needs the databases that are merged, or their folder");
    std::vector<std::string> parts;
    for (const std::string& name : values["RUNS"].as<std::vector<std::string>>()) {
        if (!fs::is_directory(name)) {
            parts.push_back(name);
            continue;
        }
        for (const auto& entry : fs::directory_iterator(name)) {
            if (entry.path().extension() == ".db") parts.push_back(entry.path().string());
        }
    }
    if (parts.empty()) throw UsageError("--merge: no database (.db) in the folder");
    std::ranges::sort(parts);
    // All databases are opened before anything is written.
    std::vector<io::HistoryDatabase> opened;
    for (const std::string& part : parts) opened.emplace_back(part);
    static_cast<void>(io::common_rules(nullptr, opened));
    io::HistoryWriter history(database);
    const std::size_t taken = history.merge(opened);
    const std::size_t runs = history.runs().size();
    if (read_json(values))
        write_to_stdout(io::merge_json({parts.size(), taken, runs}));
    else
        write_answer(fmt::format("{} of {} taken into {}, which has {} now\n", counted(taken, "run"),
                                 counted(parts.size(), "database"), database, runs),
                     values);
    return ExitCode::done;
}

FleetRules read_rules(const po::variables_map& values, const std::string& database) {
    FleetRules rules;
    rules.database = database;
    rules.jobs = static_cast<std::size_t>(thread_count());
    if (values.count("jobs") > 0) {
        const int jobs = values["jobs"].as<int>();
        if (jobs < 1) throw UsageError("--jobs must be at least 1");
        rules.jobs = static_cast<std::size_t>(jobs);
    }
    if (values.count("memory") > 0) rules.memory = parse_memory(values["memory"].as<std::string>(), "--memory");
    rules.retry_failed = values.count("retry-failed") > 0;
    return rules;
}

ExitCode run_fleet_command(const po::variables_map& values) {
    const std::string database = required(values, "output");
    const bool tasks = values.count("tasks") > 0;
    const bool merges = values.count("merge") > 0;
    if (tasks && merges) throw UsageError("--tasks and --merge cannot be combined");
    for (const char* name : {"jobs", "memory", "retry-failed"}) {
        if ((tasks || merges) && given(values, name))
            throw UsageError(fmt::format("--{} does not apply to --tasks and --merge, which judge no runs", name));
    }
    if (merges) return merge(values, database);
    const std::vector<FleetUnit> units = read_fleet_units(values);
    if (tasks) {
        if (read_json(values)) throw UsageError("--tasks prints commands, not --json");
        write_to_stdout(task_lines(units, database + ".parts"));
        return ExitCode::done;
    }
    const FleetResult result = run_fleet(units, read_rules(values, database), read_common(values));
    io::FleetReport report{database,      result.runs,        result.repeated,   result.skipped,
                           result.judged, result.over_budget, result.not_judged, {}};
    for (const FailedUnit& failed : result.failed)
        report.failed.push_back({units[failed.unit].program, units[failed.unit].log, failed.cause});
    if (read_json(values))
        write_to_stdout(io::fleet_json(report));
    else
        write_answer(io::fleet_text(report), values);
    if (!result.failed.empty() || result.over_budget > 0) return ExitCode::check_failed;
    return result.not_judged > 0 ? ExitCode::not_judged : ExitCode::done;
}

}  // namespace

Subcommand fleet_subcommand() {
    return {
        .name = "fleet",
        .arguments = "RUNS.toml|FOLDER -o DB",
        .summary = "judges many runs into a history, on one machine or on many",
        .description =
            "RUNS.toml lists the runs; in a FOLDER each log is judged with the program whose name its own name begins with. Each run is\n"
            "judged in a process of its own, and recorded as `clsurf history DB add` does. A run that fails is\n"
            "recorded with its cause. Runs that DB has already, of the same content and judged by the same\n"
            "options, are not judged again: a stopped fleet resumes where it was.\n"
            "--tasks prints a command for each run, for GNU parallel, Slurm, Dask or snakemake; each makes a\n"
            "database in DB.parts, and --merge takes them into DB.\n"
            "The exit code is 1 if a run failed or exceeds its limits, 5 if one was not judged\n"
            "(docs/howto/fleet.md).\n\n"
            "  clsurf fleet november/ -o shop.db --tool ball:6 --memory 8G\n"
            "  clsurf fleet november.toml -o shop.db --tasks | parallel\n"
            "  clsurf fleet --merge shop.db.parts -o shop.db",
        .declare =
            [](po::options_description& options) {
                // clang-format off
                options.add_options()
                    ("output,o", po::value<std::string>()->value_name("DB"), "the history")
                    ("jobs", po::value<int>()->value_name("N"), "runs that are judged at the same time (default: as many as cores)")
                    ("memory", po::value<std::string>()->value_name("SIZE"), "memory for all of them together, such as 8G (default: no limit)")
                    ("retry-failed", "repeat runs that failed before")
                    ("tasks", "print a command for each run and judge nothing")
                    ("merge", "take the runs of other histories into DB")
                    ("program", po::value<std::string>()->value_name("FILE"), "program of a single run, with --log")
                    ("log", po::value<std::string>()->value_name("FILE"), "log of a single run, with --program");
                // clang-format on
                declare_json(options);
                declare_unit(options);
            },
        .positional = {"RUNS…"},
        .run = run_fleet_command,
    };
}

}  // namespace clsurf::cli
