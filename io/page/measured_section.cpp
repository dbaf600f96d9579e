#include "io/page/measured_section.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/decimal_text.h"
#include "core/file_name.h"
#include "core/units.h"
#include "io/page/defect_cards.h"
#include "io/page/html_text.h"

namespace clsurf::io {
namespace {

/// Ra, Rq and Rz of measurement and prediction, and the similarity of the profiles.
std::string roughness_html(const MeasuredComparison& c) {
    if (!c.reason.empty()) return fmt::format("<p>Not compared: {}.</p>\n", html(c.reason));
    std::string rows;
    const auto row = [&](std::string_view name, double measured, double predicted) {
        rows +=
            fmt::format("<tr><td>{}</td><td>{:.3f}</td><td>{:.3f}</td><td>{}</td><td>{}</td></tr>\n", name,
                        measured * um_per_mm, predicted * um_per_mm, signed_text((measured - predicted) * um_per_mm, 3),
                        predicted > 0 ? signed_text(100 * (measured / predicted - 1), 1) + " %" : "–");
    };
    row("Ra", c.measured.ra, c.predicted.ra);
    row("Rq", c.measured.rq, c.predicted.rq);
    row("Rz", c.measured.rz, c.predicted.rz);
    return wide_table("roughness measured and predicted",
                      "<th>Roughness [µm]</th><th>measured</th><th>predicted</th><th>difference</th><th></th>", rows) +
           fmt::format(
               "<p>Correlation of the roughness profiles {:.3f}; {} of {:.3g} mm, cut-off {:g} mm{}.</p>\n",
               c.correlation, c.profiles.size() == 1 ? "a profile" : fmt::format("{} profiles", c.profiles.size()),
               c.measured.length, c.measured.cutoff,
               c.short_cutoff > 0 ? fmt::format(", short waves below {:g} µm taken off", c.short_cutoff * um_per_mm)
                                  : "");
}

std::string state_text(const ComparedMark& mark) {
    switch (mark.state) {
        case MarkState::found: return "found";
        case MarkState::missing: return "missing";
        case MarkState::not_judged: return "not judged: " + mark.reason;
    }
    return {};
}

/// The predicted marks that the measurement crosses, and whether each was found.
std::string marks_html(const std::vector<ComparedMark>& marks) {
    if (marks.empty()) return "<p>The measurement crosses none of the predicted marks.</p>\n";
    std::string rows;
    const auto depth = [](const ComparedMark& mark, double mm) {
        return mark.state == MarkState::not_judged || !std::isfinite(mm)
                   ? std::string("–")
                   : fmt::format("{:.2f} {}", mm * um_per_mm, deep_or_high(mark.pit));
    };
    for (const ComparedMark& mark : marks)
        rows += fmt::format(
            "<tr data-defect=\"{0}\"><td>{0}</td><td>{1}</td><td>{2}</td><td>{3}</td><td>{4:.2f} {5:.2f} {6:.2f}</td></tr>\n",
            mark.defect + 1, html(state_text(mark)), depth(mark, mark.measured), depth(mark, mark.predicted),
            mark.place.x(), mark.place.y(), mark.place.z());
    return wide_table(
        "predicted marks",
        "<th>Defect</th><th>On the part</th><th>Measured [µm]</th><th>Predicted [µm]</th><th>X Y Z [mm]</th>", rows);
}

/// "Of 3 predicted marks that it crosses, 2 are found and 1 is missing."
std::string verdict_html(const std::vector<ComparedMark>& marks) {
    const auto count = [&](MarkState state) {
        return std::count_if(marks.begin(), marks.end(), [&](const ComparedMark& m) { return m.state == state; });
    };
    const auto found = count(MarkState::found), missing = count(MarkState::missing);
    if (found + missing == 0) return {};
    return fmt::format("<p><b>Of {} predicted mark{} that could be judged, {} {} found and {} {} missing.</b></p>\n",
                       found + missing, found + missing == 1 ? "" : "s", found, found == 1 ? "is" : "are", missing,
                       missing == 1 ? "is" : "are");
}

}  // namespace

std::string measured_section(const ReportPage& page) {
    if (!page.measured) return {};
    const ReportedMeasurement& measured = page.measured->measurement;
    const Alignment& alignment = measured.result.alignment;
    std::string text = "<section id=\"measured\"><h2>Measured and predicted</h2>\n" +
                       verdict_html(measured.result.marks) +
                       fmt::format("<p>{}, {} of {} places", html(file_name(measured.data.name)),
                                   name_of(measured.data.kind), alignment.points);
    if (!alignment.parameters.empty())
        text += fmt::format("; {:.3f} µm rms from the predicted surface", alignment.rms * um_per_mm);
    text += ".</p>\n";
    if (const std::optional<std::string> misfit = misfit_of(alignment))
        text += fmt::format("<p><b>Its place on the part is in doubt.</b> {}.</p>\n", html(*misfit));
    for (const std::string& reason : alignment.reasons)
        text += fmt::format("<p><b>Its place on the part is not determined.</b> {}.</p>\n", html(reason));
    if (alignment.determined()) {
        text += roughness_html(measured.result.comparison) + marks_html(measured.result.marks);
        if (page.measured->picture)
            text += "<div class=\"pictures\">\n" + picture_html(*page.measured->picture) + "</div>\n";
    }
    return text + "</section>\n";
}

}  // namespace clsurf::io
