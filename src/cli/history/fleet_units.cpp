#include "cli/history/fleet_units.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include <fmt/format.h>

#include "cli/child_process.h"
#include "cli/options/config.h"
#include "cli/options/option_rows.h"
#include "cli/options/option_value.h"
#include "cli/runs/checked_run.h"
#include "cli/runs/run_recorder.h"
#include "core/spelling.h"
#include "io/readers/fleet_file.h"

namespace clsurf::cli {
namespace {

namespace fs = std::filesystem;

void put(std::map<std::string, std::vector<std::string>>& options, const po::option_description& option,
         const std::vector<std::string>& values) {
    std::vector<std::string>& words = options[option.long_name()];
    words.clear();
    for (const std::string& value : values) words.insert(words.end(), {"--" + option.long_name(), value});
    if (option.semantic()->max_tokens() == 0) words = {"--" + option.long_name()};
}

using OptionWords = std::map<std::string, std::vector<std::string>>;

/// Options of a table, with file names made relative to the working folder.
void add_entries(const std::vector<io::ConfigEntry>& entries, const po::options_description& known,
                 const std::string& folder, OptionWords& options) {
    for (const io::ConfigEntry& entry : entries) {
        const po::option_description* description = known.find_nothrow(entry.key, false);
        if (description == nullptr) {
            std::vector<std::string_view> names;
            for (const auto& option : known.options()) names.push_back(option->long_name());
            throw InputError(entry.where,
                             "unknown key '" + entry.key +
                                 "': keys of a run are program, log, time, parameters and names of options",
                             did_you_mean(entry.key, names));
        }
        const po::option option = option_of(entry, *description, folder);
        try {
            check_option(option, *description);
        } catch (const UsageError& wrong) {  // reported with the line instead
            throw InputError(entry.where, wrong.what(), wrong.hint());
        }
        if (entry.is_flag && !entry.on)
            options.erase(entry.key);
        else
            put(options, *description, option.value);
    }
}

FleetUnit unit_of(const std::string& program, const std::string& log, const OptionWords& options) {
    FleetUnit unit{program, log, {}, 0};
    for (const auto& [name, words] : options) unit.words.insert(unit.words.end(), words.begin(), words.end());
    std::error_code missing;
    const auto size = fs::file_size(log, missing);
    if (!missing) unit.bytes = size;
    return unit;
}

/// The options of the command line only: each unit finds the configuration of its part itself.
OptionWords given_options(const po::options_description& known, const po::variables_map& values) {
    OptionWords options;
    for (const auto& option : known.options()) {
        if (!given(values, option->long_name().c_str())) continue;
        po::options_description alone;
        alone.add(option);
        options[option->long_name()] = words_of(alone, values);
    }
    return options;
}

std::vector<FleetUnit> units_of(const io::FleetFile& fleet, const std::string& folder,
                                const po::options_description& known, const OptionWords& command_line) {
    std::vector<FleetUnit> units;
    for (const io::FleetRun& run : fleet.runs) {
        OptionWords options;
        add_entries(fleet.options, known, folder, options);
        add_entries(run.options, known, folder, options);
        for (const auto& [name, words] : command_line) options[name] = words;
        if (!run.parameters.empty()) {
            std::vector<std::string>& words = options["param"];
            for (const std::string& parameter : run.parameters) words.insert(words.end(), {"--param", parameter});
        }
        if (!run.time.empty()) options["time"] = {"--time", run.time};
        units.push_back(unit_of(run.program, run.log, options));
    }
    return units;
}

}  // namespace

void declare_unit(po::options_description& options) {
    declare_recording(options);
    declare_judging(options);
}

std::vector<FleetUnit> read_fleet_units(const po::variables_map& values) {
    po::options_description known;
    declare_unit(known);
    const OptionWords command_line = given_options(known, values);
    const bool one = values.count("program") > 0 || values.count("log") > 0;
    if (one + (values.count("RUNS") > 0 ? 1 : 0) != 1)
        throw UsageError("one of RUNS.toml, FOLDER, and --program with --log is needed",
                         "usage: clsurf fleet RUNS.toml|FOLDER -o DB");
    if (one) {
        if (values.count("program") == 0 || values.count("log") == 0)
            throw UsageError("--program and --log belong together");
        return {unit_of(values["program"].as<std::string>(), values["log"].as<std::string>(), command_line)};
    }
    const auto& runs = values["RUNS"].as<std::vector<std::string>>();
    if (runs.size() > 1)
        throw UsageError("unexpected argument '" + runs[1] + "'",
                         "one list or folder at a time; several are for --merge");
    if (fs::is_directory(runs.front())) return units_of(io::find_fleet_runs(runs.front()), "", known, command_line);
    return units_of(io::read_fleet_file(runs.front()), fs::path(runs.front()).parent_path().string(), known,
                    command_line);
}

std::vector<std::string> words_of_unit(const FleetUnit& unit, const std::string& database) {
    std::vector<std::string> words = unit.words;
    words.insert(words.end(), {"--", database, "add", unit.program, unit.log});
    return words;
}

std::string task_lines(const std::vector<FleetUnit>& units, const std::string& folder) {
    po::options_description known;
    declare_unit(known);
    const auto whole_path = [](const std::string& name) {
        return name.empty() ? name : fs::absolute(name).lexically_normal().string();
    };
    std::string text;
    for (std::size_t i = 0; i < units.size(); ++i) {
        const std::string database = (fs::path(whole_path(folder)) / fmt::format("{:05}.db", i + 1)).string();
        text += fmt::format("mkdir -p {} && clsurf fleet -o {} --program {} --log {}", shell_word(whole_path(folder)),
                            shell_word(database), shell_word(whole_path(units[i].program)),
                            shell_word(whole_path(units[i].log)));
        std::string option;
        for (const std::string& word : units[i].words) {
            const bool value = !option.empty() && known.find(option, false).semantic()->max_tokens() > 0;
            const bool file = value && names_a_file(known.find(option, false).format_parameter());
            text += " " + shell_word(file ? whole_path(word) : word);
            option = !value && word.starts_with("--") ? word.substr(2) : "";
        }
        text += "\n";
    }
    return text;
}

}  // namespace clsurf::cli
