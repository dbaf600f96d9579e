#include "io/readers/fleet_file.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "core/error.h"
#include "core/file_name.h"
#include "core/letter_case.h"
#include "io/files/mapped_file.h"
#include "io/files/toml_table.h"
#include "io/formats/log_format.h"
#include "io/readers/config_entries.h"
#include "io/readers/program_file.h"

namespace clsurf::io {
namespace {

namespace fs = std::filesystem;

std::string required_file(const TomlFile& file, const toml::table& run, std::string_view key, const fs::path& folder) {
    const std::optional<std::string> name = file.text(run, key);
    if (!name || name->empty()) file.fail(run, "a run needs a " + std::string(key));
    return (folder / *name).lexically_normal().string();
}

std::vector<std::string> read_parameters(const TomlFile& file, const std::string& path, const toml::table& run) {
    std::vector<std::string> parameters;
    const toml::table* table = file.section(run, "parameters");
    if (table == nullptr) return parameters;
    for (const ConfigEntry& entry : config_entries(file, path, *table)) {
        if (entry.is_flag || entry.values.size() != 1)
            throw InputError(entry.where, "a parameter is a text or a number");
        parameters.push_back(entry.key + "=" + entry.values.front());
    }
    return parameters;
}

bool has_ending(const std::string& name, std::string_view ending) { return name.ends_with(ending); }

/// "run.biip" of "run.biip.xz".
std::string without_compression(const std::string& name) {
    for (const std::string_view ending : {".gz", ".xz", ".zst"}) {
        if (has_ending(name, ending)) return name.substr(0, name.size() - ending.size());
    }
    return name;
}

/// Judged by name: a folder also has pictures, reports and notes, which no log format should try to read.
bool is_named_like_a_log(const std::string& name) {
    const std::string plain = without_compression(name);
    return std::ranges::any_of(
        std::initializer_list<std::string_view>{".biip", ".csv", ".xml", ".halscope", ".halsampler"},
        [&](std::string_view ending) { return has_ending(plain, ending); });
}

bool is_named_like_a_program(const std::string& name) {
    const std::string ending = lower_case(fs::path(name).extension().string());
    return std::ranges::any_of(
        std::initializer_list<std::string_view>{".nc", ".ngc", ".mpf", ".h", ".i", ".tap", ".cnc", ".iso", ".gcode"},
        [&](std::string_view known) { return ending == known; });
}

struct FolderContent {
    std::vector<fs::path> programs, logs;
};

FolderContent read_folder(const std::string& folder) {
    FolderContent content;
    std::error_code error;
    fs::recursive_directory_iterator at(folder, fs::directory_options::follow_directory_symlink, error);
    if (error) throw InputError(Place::of_file(folder), "cannot be read: " + error.message());
    std::set<fs::path> folders{
        fs::canonical(folder)};  // by canonical names: links lead to some files twice, or in a circle
    for (; at != fs::recursive_directory_iterator(); at.increment(error)) {
        std::error_code unknown;
        if (at->is_directory(unknown) && !folders.insert(fs::canonical(at->path(), unknown)).second)
            at.disable_recursion_pending();
        const std::string name = at->path().filename().string();
        if (name.starts_with(".") || !at->is_regular_file(unknown)) continue;
        if (is_named_like_a_log(name))
            content.logs.push_back(at->path());
        else if (is_named_like_a_program(name) && looks_like_program(map_file(at->path().string())))
            content.programs.push_back(at->path());
    }
    // A folder that cannot be read ends the traversal.
    if (error) throw InputError(Place::of_file(folder), "cannot be read in full: " + error.message());
    std::ranges::sort(content.programs);
    std::ranges::sort(content.logs);
    return content;
}

/// How well a program fits: the length of the common name, then whether it is in the log's folder. 0: not at all.
std::size_t fit_of(const fs::path& program, const fs::path& log) {
    const std::string stem = program.stem().string();
    if (!log.filename().string().starts_with(stem)) return 0;
    return 2 * stem.size() + (program.parent_path() == log.parent_path() ? 1 : 0);
}

std::string program_for(const fs::path& log, const std::vector<fs::path>& programs) {
    const fs::path* best = nullptr;
    std::size_t most = 0;
    std::vector<const fs::path*> beside;
    for (const fs::path& program : programs) {
        if (program.parent_path() == log.parent_path()) beside.push_back(&program);
        const std::size_t fit = fit_of(program, log);
        if (fit <= most) continue;
        most = fit;
        best = &program;
    }
    if (best == nullptr && beside.size() == 1) best = beside.front();
    return best == nullptr ? "" : best->string();
}

}  // namespace

FleetFile read_fleet_file(const std::string& path) {
    const TomlFile file(path);
    const fs::path folder = fs::path(path).parent_path();
    FleetFile fleet;
    fleet.options = config_entries(file, path, file.root(), {"run"});
    const toml::array* runs = file.tables(file.root(), "run");
    if (runs == nullptr || runs->empty()) file.fail("lists no runs: [[run]] with program and log");
    for (const toml::node& node : *runs) {
        const toml::table& table = *node.as_table();
        FleetRun run;
        run.program = required_file(file, table, "program", folder);
        run.log = required_file(file, table, "log", folder);
        run.time = file.text(table, "time").value_or("");
        run.parameters = read_parameters(file, path, table);
        run.options = config_entries(file, path, table, {"program", "log", "time", "parameters"});
        fleet.runs.push_back(std::move(run));
    }
    return fleet;
}

FleetFile find_fleet_runs(const std::string& folder) {
    const FolderContent content = read_folder(folder);
    if (content.logs.empty())
        throw InputError(Place::of_file(folder), "holds no log: .biip, .csv, .xml, .halscope or .halsampler");
    FleetFile fleet;
    for (const fs::path& log : content.logs) {
        FleetRun run;
        run.program = program_for(log, content.programs);
        run.log = log.string();
        fleet.runs.push_back(std::move(run));
    }
    return fleet;
}

}  // namespace clsurf::io
