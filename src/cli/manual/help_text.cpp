#include "cli/manual/help_text.h"

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>

#include "cli/options/option_rows.h"
#include "cli/options/vocabulary.h"
#include "cli/terminal.h"
#include "cli/text.h"
#include "core/version.h"

namespace clsurf::cli {
namespace {

constexpr std::size_t least_right = 24;   // columns of a description on a narrow terminal
constexpr std::size_t widest_names = 30;  // wider ones are in a line of their own

struct Entry {
    std::string left, right;
};

/// Two columns; the text of the right one is filled.
std::string two_columns(const std::vector<Entry>& entries) {
    std::size_t left = 0;
    const std::size_t widest = std::min(widest_names, help_columns() / 3 + 4);
    for (const Entry& entry : entries) {
        if (columns_of(entry.left) <= widest) left = std::max(left, columns_of(entry.left));
    }
    const std::string indent(left + 4, ' ');
    std::string text;
    for (const Entry& entry : entries) {
        text += "  " + entry.left;
        std::string gap =
            columns_of(entry.left) > left ? "\n" + indent : std::string(left + 2 - columns_of(entry.left), ' ');
        for (const std::string& line :
             wrap(entry.right, std::max(help_columns(), indent.size() + least_right) - indent.size())) {
            text += gap + line;
            gap = "\n" + indent;
        }
        text += "\n";
    }
    return text;
}

std::string options_text(std::string_view title, const po::options_description& options) {
    std::vector<Entry> entries;
    for (const OptionRow& row : rows_of(options)) entries.push_back({row.names(), row.text()});
    return entries.empty() ? std::string() : fmt::format("\n{}:\n{}", title, two_columns(entries));
}

}  // namespace

std::string listing_text(std::span<const io::ListingRow> rows) {
    std::vector<Entry> entries;
    for (const io::ListingRow& row : rows)
        entries.push_back({row.name, row.unit.empty() ? row.summary : fmt::format("{} [{}]", row.summary, row.unit)});
    return two_columns(entries);
}

std::string usage_of(const Subcommand& subcommand) {
    return fmt::format("clsurf {} [options]{}{}", subcommand.name, subcommand.arguments.empty() ? "" : " ",
                       subcommand.arguments);
}

std::span<const ExitCodeRow> exit_codes() {
    static constexpr std::array table{
        ExitCodeRow{ExitCode::done, "done"},
        ExitCodeRow{ExitCode::check_failed, "done, but a check or a comparison failed"},
        ExitCodeRow{ExitCode::usage, "wrong options or arguments"},
        ExitCodeRow{ExitCode::bad_input, "an input that cannot be used"},
        ExitCodeRow{ExitCode::system, "system failure: disk, memory, graphics"},
        ExitCodeRow{ExitCode::not_judged, "done, but not judged: the data do not allow a verdict"},
    };
    return table;
}

std::string overview_text() {
    std::vector<Entry> commands;
    for (const Subcommand* subcommand : shown_subcommands())
        commands.push_back({std::string(subcommand->name), std::string(subcommand->summary)});
    std::vector<Entry> lists;
    for (const Vocabulary& vocabulary : vocabularies()) {
        lists.push_back({fmt::format("help {}", vocabulary.name), std::string(vocabulary.summary)});
    }
    std::vector<Entry> codes;
    for (const ExitCodeRow& row : exit_codes()) {
        codes.push_back({std::to_string(static_cast<int>(row.code)), std::string(row.meaning)});
    }
    return fmt::format(
        "clsurf {}: {}\n\nusage: clsurf SUBCOMMAND [options] …\n\nsubcommands:\n{}\nlists:\n{}\n"
        "exit codes:\n{}\n`clsurf SUBCOMMAND --help` shows the options of one.\n",
        version, motto, two_columns(commands), two_columns(lists), two_columns(codes));
}

std::string help_text(const Subcommand& subcommand) {
    std::string text = fmt::format("usage: {}\n", usage_of(subcommand));
    for (const Paragraph& paragraph : paragraphs_of(subcommand.description)) {
        text += "\n";
        if (paragraph.literal) {
            text += paragraph.text;
        } else {
            for (const std::string& line : wrap(paragraph.text, help_columns())) text += line + "\n";
        }
    }
    const ShownOptions shown = shown_options(subcommand);
    return text + options_text("options", shown.own) + options_text("everywhere", shown.common);
}

}  // namespace clsurf::cli
