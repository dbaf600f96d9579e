#include "cli/runs/run_recorder.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "cli/options/option_rows.h"
#include "core/version.h"
#include "history/record_of.h"
#include "io/files/mapped_file.h"
#include "io/files/sha256.h"
#include "io/files/utc.h"
#include "io/formats/run_parameters.h"
#include "io/history/parameter_file.h"
#include "io/readers/log_tool.h"
#include "io/readers/machine_file.h"

namespace clsurf::cli {

std::string hash_of(const std::string& path) {
    std::error_code none;
    if (!std::filesystem::is_regular_file(path, none)) return {};
    return io::sha256(io::map_file(path).bytes);
}

std::string settings_of(const po::variables_map& values) {
    po::options_description judging;
    declare_judging(judging);
    std::string text = std::string("clsurf ") + version;
    for (const auto& option : judging.options()) {
        po::options_description alone;
        alone.add(option);
        for (const std::string& word : words_of(alone, values)) {
            text += " " + word;
            if (word.starts_with("--") || !names_a_file(option->format_parameter())) continue;
            if (const std::string hash = hash_of(word); !hash.empty()) text += "@" + hash.substr(0, 12);
        }
    }
    return text;
}

void require_files(const std::string& program, const std::vector<std::string>& logs) {
    if (program == "-" || std::ranges::find(logs, "-") != logs.end())
        throw UsageError("a run from standard input cannot be recorded", "name its files: their hashes are kept");
}

void declare_recording(po::options_description& options) {
    // clang-format off
    options.add_options()
        ("param", po::value<std::vector<std::string>>()->value_name("NAME=VALUE"), "a parameter of the run, such as tool=D6R3; may be repeated")
        ("time", po::value<std::string>()->value_name("TIME"), "when the run was cut, such as 2026-11-24T07:30:00+01:00 (default: when the log was written)")
        ("parameters", po::value<std::string>()->value_name("FILE"), "rules for the parameters of runs (TOML); the history keeps them");
    // clang-format on
}

RunRecorder::RunRecorder(std::string database, const po::variables_map& values)
    : database_(std::move(database)), settings_(settings_of(values)) {
    if (values.count("time") > 0) time_ = io::parse_utc(values["time"].as<std::string>(), "--time");
    if (values.count("param") > 0) {
        for (const std::string& text : values["param"].as<std::vector<std::string>>())
            parameters_.push_back(parse_parameter(text));
    }
    if (values.count("parameters") > 0) rules_ = io::read_parameter_rules(values["parameters"].as<std::string>());
    ParameterRules known;
    if (std::filesystem::exists(database_)) known = io::HistoryDatabase(database_).parameter_rules();
    in_force_ = rules_ ? *rules_ : known;
    parameters_ = in_force_.checked(std::move(parameters_), false);
}

std::optional<RunRecorder> read_recorder(const po::variables_map& values, const std::string& program,
                                         const std::vector<std::string>& logs) {
    if (values.count("record") == 0) {
        for (const char* name : {"param", "time", "parameters"}) {
            if (given(values, name)) throw UsageError(fmt::format("--{} needs --record", name), "add --record shop.db");
        }
        return std::nullopt;
    }
    require_files(program, logs);
    return RunRecorder(values["record"].as<std::string>(), values);
}

std::vector<RunParameter> RunRecorder::parameters_with(std::vector<RunParameter> of_log) const {
    std::vector<RunParameter> all = parameters_;
    for (RunParameter& parameter : of_log) {
        if (std::ranges::find(parameters_, parameter.name, &RunParameter::name) == parameters_.end())
            all.push_back(std::move(parameter));
    }
    return in_force_.checked(std::move(all));
}

io::AddedRun RunRecorder::add(const PartOptions& options, const CheckedRun& run) const {
    RunRecord record = record_of(run.part, run.quality, run.within_budget());
    record.program = options.program;
    record.log = options.log;
    record.program_sha256 = hash_of(options.program);
    record.log_sha256 = hash_of(options.log);
    record.time = time_.empty() ? io::utc_of_file(options.log) : time_;
    record.machine = options.machine.empty() ? io::machine_of_metadata(run.part.log.metadata)
                                             : io::read_machine(options.machine).name;
    record.version = version;
    record.settings = settings_;
    record.parameters = parameters_with(io::parameters_of_metadata(run.part.log.metadata));
    io::HistoryWriter history(database_);
    if (rules_) history.set_parameter_rules(*rules_);
    return history.add(record);
}

std::string RunRecorder::text_of(const io::AddedRun& added) const {
    return fmt::format("run {} of {}{}", added.id, database_,
                       added.replaced ? ", replaces an earlier record of the same program, log and parameters" : "");
}

}  // namespace clsurf::cli
