#include "io/page/report_page.h"

#include <fmt/format.h>

#include "io/page/html_text.h"
#include "io/page/page_bundle.h"
#include "io/page/page_data.h"
#include "io/page/page_policy.h"
#include "io/page/page_sections.h"

namespace clsurf::io {
namespace {

/// Nothing is loaded; only the page's own script and style are allowed.
std::string policy() {
    return fmt::format(
        "default-src 'none'; script-src {}; style-src {}; img-src data: blob:; base-uri 'none'; form-action 'none'",
        source_hash(page_script()), source_hash(page_style()));
}

}  // namespace

std::string write_page(const ReportPage& page) {
    const PageData data = page_data(page);
    std::string text;
    std::size_t size = 0;
    for (const std::string& block : data.blocks) size += block.size();
    text.reserve(size + (std::size_t{4} << 20));
    text += fmt::format(
        "<!doctype html>\n<html lang=\"en\"{}>\n<head>\n<meta charset=\"utf-8\">\n<meta http-equiv=\"Content-Security-Policy\" content=\"{}\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<meta name=\"referrer\" content=\"no-referrer\">\n<title>{}</title>\n<style>",
        page.quality.report->judgement.judged() ? "" : " data-judged=\"no\"", policy(), html(page_title(page)));
    text += page_style();
    text += "</style>\n</head>\n<body>\n";
    text += page_summary(page);
    text +=
        "<noscript><p class=\"note\">The interactive view needs JavaScript. Pictures, tables and summary do not.</p></noscript>\n<div id=\"app\" role=\"region\" aria-label=\"interactive view\" hidden></div>\n";
    text += page_sections(page);
    text += "<script type=\"application/json\" id=\"manifest\">" +
            json_for_html(data.manifest.dump(-1, ' ', true, Json::error_handler_t::replace)) + "</script>\n";
    for (std::size_t i = 0; i < data.blocks.size(); ++i) {
        text += fmt::format("<script type=\"application/octet-stream\" id=\"block-{}\">", i);
        text += data.blocks[i];
        text += "</script>\n";
    }
    text += "<script>";
    text += page_script();
    text += "</script>\n</body>\n</html>\n";
    return text;
}

}  // namespace clsurf::io
