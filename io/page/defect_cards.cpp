#include "io/page/defect_cards.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "core/file_name.h"
#include "io/page/html_text.h"
#include "io/page/page_pack.h"
#include "io/reports/quality_words.h"

namespace clsurf::io {
namespace {

// The same number as on the page: viz/page/src/defect_print.ts.
constexpr LineNumber most_lines = 14;
constexpr LineNumber lines_at_the_end = 3;  ///< if not all lines are shown
constexpr std::size_t widest_line = 100;

/// The file of a section, and its lines there.
struct Excerpt {
    const SourceText* text = nullptr;
    LineNumber first = 0, last = 0;
};

Excerpt excerpt_of(const Program& program, const DefectSection& section) {
    if (section.file.empty()) return {&program.main(), section.first_line, section.last_line};
    for (const SourceText& text : program.files) {
        if (file_name(text.name()) == section.file) return {&text, section.file_first_line, section.file_last_line};
    }
    return {};
}

std::string code_line(const SourceText& text, LineNumber number) {
    const std::string_view line = text.line(number);
    return fmt::format("<span class=\"number\">{:>6}</span> {}{}\n", number, html(line.substr(0, widest_line)),
                       line.size() > widest_line ? "…" : "");
}

/// The lines of a section; of many the first and the last.
std::string code_html(const Program& program, const DefectSection& section) {
    const Excerpt excerpt = excerpt_of(program, section);
    if (excerpt.text == nullptr || excerpt.first == 0) return {};
    const bool all = excerpt.last - excerpt.first < most_lines;
    const LineNumber shown = all ? excerpt.last : excerpt.first + (most_lines - lines_at_the_end - 1) - 1;
    std::string text = "<pre>";
    for (LineNumber n = excerpt.first; n <= shown; ++n) text += code_line(*excerpt.text, n);
    if (!all) {
        text += fmt::format("<span class=\"number\">     …</span> {} more lines\n",
                            excerpt.last - lines_at_the_end - shown);
        for (LineNumber n = excerpt.last - lines_at_the_end + 1; n <= excerpt.last; ++n)
            text += code_line(*excerpt.text, n);
    }
    return text + "</pre>\n";
}

std::string list_of_lines(const std::vector<DefectSection>& sections) {
    constexpr std::size_t most_listed_sections = 6;
    return list_of_sections(sections, most_listed_sections, [](const DefectSection& section) {
        return fmt::format("{} (pass {})", lines_text(section), section.pass);
    });
}

}  // namespace

std::string picture_html(const PagePicture& picture) {
    return fmt::format(
        "<figure><div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"picture: {0}\"><img alt=\"{0}\" "
        "src=\"data:image/png;base64,{1}\"></div><figcaption><b>{0}</b> {2}</figcaption></figure>\n",
        html(picture.title), to_base64(picture.png), html(picture.text));
}

std::string lines_text(const DefectSection& section) {
    if (section.first_line == 0) return "–";
    return section.first_line == section.last_line ? fmt::format("{}", section.first_line)
                                                   : fmt::format("{}–{}", section.first_line, section.last_line);
}

std::string list_of_sections(std::span<const DefectSection> sections, std::size_t most,
                             std::string (*text_of)(const DefectSection&)) {
    std::string text;
    for (std::size_t k = 0; k < std::min(most, sections.size()); ++k)
        text += (k > 0 ? ", " : "") + text_of(sections[k]);
    if (sections.size() > most) text += fmt::format(" and {} more", sections.size() - most);
    return text;
}

std::string defect_card_html(const ReportPage& page, std::size_t defect) {
    const Defect& d = page.quality.report->defects[defect];
    const std::vector<DefectSection> sections = strongest_first(d);
    std::string text = "<article class=\"defect-card\">\n" + picture_html(*page.defects[defect].picture);
    text += fmt::format("<p>Lines {}", html(list_of_lines(sections)));
    if (!d.neighbours.empty()) text += fmt::format("; adjacent: {}", html(list_of_lines(d.neighbours)));
    text += ".</p>\n";
    if (!page.defects[defect].slow.empty()) text += "<p>Slow: " + html(page.defects[defect].slow) + ".</p>\n";
    if (!sections.empty()) text += code_html(*page.quality.program, sections.front());
    return text + "</article>\n";
}

}  // namespace clsurf::io
