#include "cli/help.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <sstream>

#include <fmt/format.h>

#include "cli/options.h"
#include "core/spelling.h"
#include "core/version.h"
#include "field/field_set.h"
#include "io/json_text.h"
#include "io/log_format.h"
#include "program/dialect.h"
#include "viz/colour_map.h"

namespace clsurf::cli {
namespace {

constexpr const char* topics[] = {"fields", "formats", "dialects", "colormaps"};

void print_overview() {
    fmt::print("clsurf {}: quality maps of machined surfaces from NC programs and controller logs\n\nusage: clsurf SUBCOMMAND …\n\n", version);
    for (const Subcommand& s : subcommands()) fmt::print("  {:<10} {}\n", s.name, s.summary);
    fmt::print("\n`clsurf SUBCOMMAND --help` shows the options of one; `clsurf help fields|formats|dialects|colormaps`\nlists what options take. Exit codes: 0 done, 1 a check failed, 2 usage, 3 bad input, 4 the machine failed.\n");
}

/// The rows of a topic; nullopt: there is no such topic.
std::optional<std::vector<io::HelpRow>> rows_of(const std::string& topic) {
    std::vector<io::HelpRow> rows;
    if (topic == "fields") {
        for (const FieldInfo& f : known_fields(nullptr)) rows.push_back({f.name, f.label, std::string(f.unit.name)});
    } else if (topic == "formats") {
        for (const io::LogFormat& f : io::log_formats()) rows.push_back({std::string(f.name), std::string(f.summary), {}});
    } else if (topic == "dialects") {
        for (const Dialect& d : dialects()) rows.push_back({std::string(d.name), std::string(d.summary), {}});
    } else if (topic == "colormaps") {
        for (const viz::ColourMapInfo& m : viz::colour_maps()) rows.push_back({std::string(m.name), std::string(m.summary), {}});
    } else {
        return std::nullopt;
    }
    return rows;
}

void print_rows(const std::string& topic, const std::vector<io::HelpRow>& rows) {
    std::size_t width = 0;
    for (const io::HelpRow& row : rows) width = std::max(width, row.name.size());
    for (const io::HelpRow& row : rows) {
        fmt::print("  {:<{}}  {}{}\n", row.name, width, row.summary, row.unit.empty() ? "" : " [" + row.unit + "]");
    }
    if (topic == "fields") fmt::print("\nEvery channel of the log is a field too; one that has a field's name is `log.NAME`.\n");
    if (topic == "colormaps") fmt::print("\nOwn maps: stops from low to high, evenly spaced, #RRGGBB,#RRGGBB,…\n");
}

}  // namespace

po::options_description visible_options(const Subcommand& subcommand) {
    po::options_description options("options", 100);
    subcommand.declare(options);
    po::options_description common("everywhere", 100);
    declare_common(common);
    options.add(common);
    return options;
}

const Subcommand& find_subcommand(const std::string& name) {
    std::vector<std::string_view> names;
    for (const Subcommand& s : subcommands()) {
        if (s.name == name) return s;
        names.push_back(s.name);
    }
    throw UsageError("unknown subcommand '" + name + "'", did_you_mean(name, names));
}

void print_help(const Subcommand& subcommand) {
    std::ostringstream options;
    options << visible_options(subcommand);
    fmt::print("usage: clsurf {} {}\n\n{}\n\n{}", subcommand.name, subcommand.arguments, subcommand.description, options.str());
}

ExitCode help(const std::vector<std::string>& words) {
    const bool json = std::find(words.begin(), words.end(), "--json") != words.end();
    std::vector<std::string> names;
    std::copy_if(words.begin(), words.end(), std::back_inserter(names), [](const std::string& w) { return w != "--json"; });
    if (names.empty()) {
        print_overview();
        return ExitCode::done;
    }
    const std::string& topic = names.front();
    if (const std::optional<std::vector<io::HelpRow>> rows = rows_of(topic)) {
        if (json) std::fputs(io::help_json(*rows).c_str(), stdout);
        else print_rows(topic, *rows);
        return ExitCode::done;
    }
    std::vector<std::string_view> known(std::begin(topics), std::end(topics));
    for (const Subcommand& s : subcommands()) known.push_back(s.name);
    if (std::find(known.begin(), known.end(), topic) == known.end()) {
        throw UsageError("no help on '" + topic + "'", did_you_mean(topic, known));
    }
    print_help(find_subcommand(topic));
    return ExitCode::done;
}

}  // namespace clsurf::cli
