#include "cli/options/config.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "cli/options/option_rows.h"
#include "cli/options/option_value.h"
#include "core/spelling.h"
#include "io/readers/config_file.h"

namespace clsurf::cli {
namespace {

namespace fs = std::filesystem;

/// The names of all options of all subcommands.
std::set<std::string> all_option_names() {
    std::set<std::string> names;
    for (const Subcommand& subcommand : subcommands()) {
        const ShownOptions shown = shown_options(subcommand);
        for (const auto& option : shown.own.options()) names.insert(option->long_name());
        for (const auto& option : shown.common.options()) names.insert(option->long_name());
    }
    return names;
}

void require_known(const io::ConfigEntry& entry, const std::set<std::string>& names) {
    if (names.count(entry.key) > 0) return;
    const std::vector<std::string_view> known(names.begin(), names.end());
    throw InputError(entry.where, "unknown key '" + entry.key + "': keys are names of options",
                     did_you_mean(entry.key, known));
}

}  // namespace

po::option option_of(const io::ConfigEntry& entry, const po::option_description& description,
                     const std::string& folder) {
    const auto* typed = dynamic_cast<const po::typed_value_base*>(description.semantic().get());
    const bool takes_value = description.semantic()->max_tokens() > 0;
    if (takes_value == entry.is_flag)
        throw InputError(entry.where, "'" + entry.key + "' " + (takes_value ? "needs a value" : "is true or false"));
    po::option option;
    option.string_key = entry.key;
    option.position_key = -1;
    option.value = entry.values;
    if (names_a_file(description.format_parameter())) {
        for (std::string& value : option.value) {
            if (value != "-") value = (fs::path(folder) / value).lexically_normal().string();
        }
    }
    // [312.5, 48, -101] is one "X,Y,Z", even if the option may be repeated.
    const bool one_value = description.format_parameter().find(',') != std::string::npos &&
                           std::all_of(option.value.begin(), option.value.end(), is_a_number);
    if (option.value.size() > 1 && (one_value || typed == nullptr || !takes_a_list(*typed))) {
        std::string joined;
        for (const std::string& value : option.value) joined += (joined.empty() ? "" : ",") + value;
        option.value = {joined};
    }
    return option;
}

std::string find_config(const std::vector<std::string>& arguments, const po::variables_map& values) {
    std::error_code error;
    fs::path folder = fs::current_path(error);
    if (error) return {};
    const std::string database = values.count("DB") > 0 ? values["DB"].as<std::string>() : "";
    for (const std::string& argument : arguments) {
        if (argument == database) continue;  // a database belongs to many parts, not to one
        if (argument == "-" || !fs::is_regular_file(argument, error)) continue;
        folder = fs::absolute(argument, error).parent_path();
        break;
    }
    for (folder = folder.lexically_normal();; folder = folder.parent_path()) {
        if (fs::is_regular_file(folder / config_name, error)) return (folder / config_name).string();
        if (folder == folder.parent_path()) return {};
    }
}

UsedConfig store_config(const std::string& path, const po::options_description& options, po::variables_map& values) {
    UsedConfig used{path, {}};
    const std::set<std::string> known = all_option_names();
    const fs::path folder = fs::path(path).parent_path();
    po::parsed_options parsed(&options);
    for (const io::ConfigEntry& entry : io::read_config(path)) {
        require_known(entry, known);
        const po::option_description* description = options.find_nothrow(entry.key, false);
        if (description == nullptr || values.count(entry.key) > 0) continue;
        const po::option option = option_of(entry, *description, folder.string());
        try {
            check_option(option, *description);
        } catch (const UsageError& wrong) {  // reported with the line instead
            throw InputError(entry.where, wrong.what(), wrong.hint());
        }
        if (entry.is_flag && !entry.on) continue;
        parsed.options.push_back(option);
        used.places.insert_or_assign(entry.key, entry.where);
    }
    po::variables_map read;
    po::store(parsed, read);
    for (const auto& [name, value] : read) values.insert({name, po::variable_value(value.value(), true)});
    return used;
}

}  // namespace clsurf::cli
