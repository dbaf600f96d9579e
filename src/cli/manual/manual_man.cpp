#include "cli/manual/manual_man.h"

#include <string_view>

#include <fmt/format.h>

#include "cli/manual/help_text.h"
#include "cli/options/option_rows.h"
#include "cli/text.h"
#include "core/version.h"

namespace clsurf::cli {
namespace {

/// Escapes text so that troff prints it literally: no escapes, no requests, hyphens that can be copied.
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
        "Rebuilds the surface from the path that a machine tool actually followed, line by line of\n"
        "its NC program, and shows what happened there.\n.SH SUBCOMMANDS\n";
    std::string see_also;
    for (const Subcommand* subcommand : shown_subcommands()) {
        const std::string page = fmt::format("clsurf-{}", subcommand->name);
        text += man_tagged(page + "(1)", subcommand->summary);
        see_also += fmt::format("{}.BR {} (1)", see_also.empty() ? "" : ",\n", troff(page));
    }
    return text + man_exit_codes() + ".SH SEE ALSO\n" + see_also + "\n";
}

}  // namespace

std::vector<ManualFile> man_pages() {
    std::vector<ManualFile> pages{{"clsurf.1", man_overview()}};
    for (const Subcommand* subcommand : shown_subcommands())
        pages.push_back({fmt::format("clsurf-{}.1", subcommand->name), man_page(*subcommand)});
    return pages;
}

}  // namespace clsurf::cli
