#include "cli/pictures/defect_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "io/reports/defect_names.h"
#include "program/frame_placement.h"
#include "viz/map_texts.h"

namespace clsurf::cli {
namespace {

constexpr double darkest_score = 16;  ///< multiples of the threshold from which a mark has its full colour

// Vermilion, orange, blue and bluish green are distinct for colour-blind readers (Okabe and Ito 2008). The
// strokes also differ.
viz::DefectKind kind_of(Quantity quantity) {
    switch (quantity) {
        case Quantity::speed: return {"speed", {200, 70, 0}, viz::StrokeStyle::solid};
        case Quantity::acceleration: return {"acceleration", {190, 125, 0}, viz::StrokeStyle::dashed};
        case Quantity::normal_deviation: return {"axis lag", {0, 105, 170}, viz::StrokeStyle::double_line};
        case Quantity::relief: return {"relief", {0, 130, 95}, viz::StrokeStyle::dotted};
    }
    return {};
}

/// The strongest point, on the section that io::lines_label() names.
PointIndex named_point(const Defect& d) {
    const DefectSection* section = strongest_section(d);
    if (section == nullptr) return d.point;
    return std::clamp(d.point, section->points.first, section->points.last) == d.point ? d.point
                                                                                       : section->points.first;
}

}  // namespace

viz::DefectMap defect_map_of(const QualityReport& report) {
    viz::DefectMap map;
    constexpr std::array quantities{Quantity::speed, Quantity::acceleration, Quantity::normal_deviation,
                                    Quantity::relief};
    std::array<std::size_t, quantities.size()> index{};
    for (std::size_t q = 0; q < quantities.size(); ++q) {
        const bool occurs = std::any_of(report.defects.begin(), report.defects.end(),
                                        [&](const Defect& d) { return d.quantity == quantities[q]; });
        index[q] = map.kinds.size();
        if (occurs) map.kinds.push_back(kind_of(quantities[q]));
    }
    for (std::size_t i = 0; i < report.defects.size(); ++i) {
        const Defect& d = report.defects[i];
        const auto q =
            static_cast<std::size_t>(std::find(quantities.begin(), quantities.end(), d.quantity) - quantities.begin());
        viz::DefectMark mark;
        for (const DefectSection& section : d.sections) mark.sections.push_back(section.points);
        mark.point = named_point(d);
        mark.kind = index[q];
        mark.strength = std::clamp(std::log2(std::max(1.0, double{d.score})) / std::log2(darkest_score), 0.0, 1.0);
        mark.region = d.systematic;
        mark.number = fmt::format("{}", i + 1);
        mark.label = io::label_of(d);
        mark.lines = io::lines_label(d);
        mark.place = io::place_label(d);
        mark.cause = io::cause_label(d);
        map.marks.push_back(std::move(mark));
    }
    return map;
}

viz::MapTexts defect_map_texts(const QualityReport& report, const Part& part, std::string_view subtitle) {
    const std::size_t found = report.defects.size();
    const bool is_judged = report.judgement.judged();
    viz::MapTexts texts;
    texts.frame = common_work_system(part.program.motions);
    texts.title = io::headline_of(report);
    if (!is_judged && found > 0) texts.title = "Not judged: " + texts.title;
    // "0 defects" would suggest that a part was good although it was not judged.
    if (is_judged || found > 0) texts.subtitle = found == 1 ? "1 defect · " : fmt::format("{} defects · ", found);
    texts.subtitle += subtitle;
    if (found > 0) {
        texts.notes = {"defects are drawn in colour", "darker means farther above the threshold",
                       "defect 1 has the highest score"};
    }
    if (part.tool) texts.notes.emplace_back(viz::tool_tip_note);
    note_judgement(report, "", texts.notes);
    return texts;
}

void note_judgement(const QualityReport& report, std::string_view which, std::vector<std::string>& notes) {
    if (!report.judgement.judged())
        notes.insert(notes.begin(), fmt::format("{}not judged: clsurf check says why", which));
}

}  // namespace clsurf::cli
