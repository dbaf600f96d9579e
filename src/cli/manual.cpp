// clsurf manual: man pages, completion and docs/reference, written from the tables that the
// program itself uses. A test compares docs/reference with what this writes.

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "cli/command_line.h"
#include "cli/completion.h"
#include "cli/help.h"
#include "cli/options.h"
#include "cli/text.h"
#include "cli/vocabulary.h"
#include "core/version.h"
#include "io/files/atomic_file.h"

namespace clsurf::cli {
namespace {

constexpr std::string_view manual_forms = "man|bash|zsh|fish|markdown";

void write_file(const std::filesystem::path& path, const std::string& text) {
    io::AtomicFile file(path.string());
    file.write(text);
    file.commit();
}

// ---- man pages ----

/// Text as troff takes it literally: no escapes, no requests, hyphens that can be copied.
std::string troff(std::string_view text) {
    std::string out;
    bool line_start = true;
    for (const char c : text) {
        if (line_start && (c == '.' || c == '\'')) out += "\\&";
        if (c == '\\') {
            out += "\\e";
        } else if (c == '-') {
            out += "\\-";
        } else {
            out += c;
        }
        line_start = c == '\n';
    }
    return out;
}

std::string man_header(std::string_view page, std::string_view summary) {
    return fmt::format(".TH \"{}\" 1 \"\" \"clsurf {}\" \"clsurf\"\n.SH NAME\n{} \\- {}\n", troff(page), version,
                       troff(page), troff(summary));
}

std::string man_tagged(std::string_view tag, std::string_view text) {
    return fmt::format(".TP\n\\fB{}\\fR\n{}\n", troff(tag), troff(text));
}

std::string man_exit_codes() {
    std::string text = ".SH EXIT STATUS\n";
    for (const ExitCodeRow& row : exit_codes()) {
        text += man_tagged(std::to_string(static_cast<int>(row.code)), row.meaning);
    }
    return text;
}

std::string man_page(const Subcommand& subcommand) {
    std::string text = man_header(fmt::format("clsurf-{}", subcommand.name), subcommand.summary);
    text += fmt::format(".SH SYNOPSIS\n\\fB{}\\fR\n.SH DESCRIPTION\n", troff(usage_of(subcommand)));
    for (const Paragraph& paragraph : paragraphs_of(subcommand.description)) {
        text += paragraph.literal ? fmt::format(".PP\n.nf\n{}.fi\n", troff(paragraph.text))
                                  : fmt::format(".PP\n{}\n", troff(paragraph.text));
    }
    text += ".SH OPTIONS\n";
    for (const OptionRow& row : all_rows(subcommand)) text += man_tagged(row.names(), row.text());
    return text + man_exit_codes() + ".SH SEE ALSO\n.BR clsurf (1)\n";
}

std::string man_overview() {
    std::string text = man_header("clsurf", motto);
    text +=
        ".SH SYNOPSIS\n\\fBclsurf\\fR \\fISUBCOMMAND\\fR [options] ...\n.SH DESCRIPTION\n"
        "Puts the path that a machine tool really ran back together as a surface, line by line of\n"
        "its NC program, and shows what happened there.\n.SH SUBCOMMANDS\n";
    std::string see_also;
    for (const Subcommand* subcommand : shown_subcommands()) {
        const std::string page = fmt::format("clsurf-{}", subcommand->name);
        text += man_tagged(page + "(1)", subcommand->summary);
        see_also += fmt::format("{}.BR {} (1)", see_also.empty() ? "" : ",\n", troff(page));
    }
    return text + man_exit_codes() + ".SH SEE ALSO\n" + see_also + "\n";
}

void write_man(const std::filesystem::path& folder) {
    write_file(folder / "clsurf.1", man_overview());
    for (const Subcommand* subcommand : shown_subcommands()) {
        write_file(folder / fmt::format("clsurf-{}.1", subcommand->name), man_page(*subcommand));
    }
}

// ---- docs/reference ----

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

void write_markdown(const std::filesystem::path& folder) {
    write_file(folder / "README.md", markdown_overview());
    for (const Subcommand* subcommand : shown_subcommands()) {
        write_file(folder / fmt::format("{}.md", subcommand->name), markdown_page(*subcommand));
    }
    for (const Vocabulary& vocabulary : vocabularies()) {
        write_file(folder / fmt::format("{}.md", vocabulary.name), markdown_vocabulary(vocabulary));
    }
}

ExitCode run_manual(const po::variables_map& values) {
    const std::string form = required(values, "FORM");
    const std::filesystem::path folder = required(values, "output");
    const std::vector<std::string> forms = words_of(manual_forms);
    if (std::find(forms.begin(), forms.end(), form) == forms.end())
        throw UsageError("'" + form + "' is not one of " + std::string(manual_forms));
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw SystemError("cannot make folder '" + folder.string() + "': " + error.message());
    if (form == "man") write_man(folder);
    if (form == "bash") write_file(folder / "clsurf", bash_completion());
    if (form == "zsh") write_file(folder / "_clsurf", zsh_completion());
    if (form == "fish") write_file(folder / "clsurf.fish", fish_completion());
    if (form == "markdown") write_markdown(folder);
    return ExitCode::done;
}

}  // namespace

Subcommand manual_subcommand() {
    return {
        .name = "manual",
        .arguments = manual_forms,
        .summary = "man pages, completion or docs/reference, written from the option tables",
        .description = "A tool of the build. Files that a folder holds already are replaced.",
        .declare =
            [](po::options_description& options) {
                options.add_options()("output,o", po::value<std::string>()->value_name("FOLDER"),
                                      "where to write; made when it is not there");
            },
        .positional = {"FORM"},
        .run = run_manual,
        .hidden = true,
    };
}

}  // namespace clsurf::cli
