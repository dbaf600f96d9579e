#include "cli/manual/manual_markdown.h"

#include <string_view>

#include <fmt/format.h>

#include "cli/manual/help_text.h"
#include "cli/options/option_rows.h"
#include "cli/options/vocabulary.h"
#include "cli/text.h"

namespace clsurf::cli {
namespace {

constexpr std::string_view written_by =
    "<!-- Written by `clsurf manual markdown -o docs/reference`: change the tables, not this file. "
    "-->\n\n";

std::string cell(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '|') out += '\\';
        out += c;
    }
    return out;
}

std::string markdown_options(const po::options_description& options) {
    std::string text = "| option | |\n|---|---|\n";
    for (const OptionRow& row : rows_of(options)) {
        text += fmt::format("| `{}` | {} |\n", cell(row.names()), cell(row.text()));
    }
    return text;
}

std::string markdown_page(const Subcommand& subcommand) {
    std::string text = fmt::format("# clsurf {}\n\n{}{}.\n\n```\n{}\n```\n", subcommand.name, written_by,
                                   subcommand.summary, usage_of(subcommand));
    for (const Paragraph& paragraph : paragraphs_of(subcommand.description)) {
        text +=
            paragraph.literal ? fmt::format("\n```\n{}```\n", paragraph.text) : fmt::format("\n{}\n", paragraph.text);
    }
    const ShownOptions shown = shown_options(subcommand);
    if (!shown.own.options().empty()) { text += fmt::format("\n## Options\n\n{}", markdown_options(shown.own)); }
    return text + fmt::format("\n## Everywhere\n\n{}", markdown_options(shown.common));
}

std::string markdown_vocabulary(const Vocabulary& vocabulary) {
    std::string text = fmt::format("# clsurf help {}\n\n{}The {}.\n\n| name | unit | |\n|---|---|---|\n",
                                   vocabulary.name, written_by, vocabulary.summary);
    for (const io::ListingRow& row : vocabulary.rows()) {
        text += fmt::format("| `{}` | {} | {} |\n", cell(row.name), cell(row.unit), cell(row.summary));
    }
    return text;
}

std::string markdown_overview() {
    std::string text = fmt::format("# The command line\n\n{}", written_by);
    text += "| subcommand | |\n|---|---|\n";
    for (const Subcommand* subcommand : shown_subcommands()) {
        text += fmt::format("| [{0}]({0}.md) | {1} |\n", subcommand->name, cell(subcommand->summary));
    }
    text += "\n| words that options take | |\n|---|---|\n";
    for (const Vocabulary& vocabulary : vocabularies()) {
        text += fmt::format("| [{0}]({0}.md) | {1} |\n", vocabulary.name, cell(vocabulary.summary));
    }
    text += "\n| exit code | |\n|---|---|\n";
    for (const ExitCodeRow& row : exit_codes()) {
        text += fmt::format("| {} | {} |\n", static_cast<int>(row.code), row.meaning);
    }
    return text;
}

}  // namespace

std::vector<ManualFile> reference_pages() {
    std::vector<ManualFile> pages{{"README.md", markdown_overview()}};
    for (const Subcommand* subcommand : shown_subcommands())
        pages.push_back({fmt::format("{}.md", subcommand->name), markdown_page(*subcommand)});
    for (const Vocabulary& vocabulary : vocabularies())
        pages.push_back({fmt::format("{}.md", vocabulary.name), markdown_vocabulary(vocabulary)});
    return pages;
}

}  // namespace clsurf::cli
