#include "io/reports/acceptance.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "io/reports/defect_fingerprint.h"
#include "predictor/severity.h"

namespace clsurf::io {

std::size_t Acceptance::count() const {
    return static_cast<std::size_t>(
        std::count_if(of_defect.begin(), of_defect.end(), [](const Entry& entry) { return entry.accepted; }));
}

Acceptance accept(const QualityReport& report, const AcceptedFile& file) {
    Acceptance acceptance;
    acceptance.file = file.name;
    acceptance.of_defect.resize(report.defects.size());
    std::map<std::string, std::size_t> index;
    const std::vector<std::string> fingerprints = fingerprints_of(report.defects);
    for (std::size_t i = 0; i < fingerprints.size(); ++i) index.emplace(fingerprints[i], i);
    for (const AcceptedDefect& named : file.defects) {
        const auto found = index.find(named.fingerprint);
        if (found == index.end()) {
            acceptance.unknown.push_back(named);
            continue;
        }
        Acceptance::Entry& entry = acceptance.of_defect[found->second];
        entry.listed = true;
        entry.comment = named.comment;
        entry.severity = named.severity;
        entry.worse = named.accepted && named.severity > 0 && report.defects[found->second].severity > named.severity;
        entry.accepted = named.accepted && !entry.worse;
    }
    return acceptance;
}

void note_changes(const Acceptance& acceptance, const QualityReport& report, Diagnostics& diagnostics) {
    const Place place = Place::of_file(acceptance.file);
    for (std::size_t i = 0; i < acceptance.of_defect.size(); ++i) {
        const Acceptance::Entry& entry = acceptance.of_defect[i];
        if (!entry.worse) continue;
        diagnostics.add({Severity::warning, "quality.accepted-worse", place,
                         fmt::format("defect {} was accepted as {} and is {} now: it counts", i + 1,
                                     name_of_severity(entry.severity), name_of_severity(report.defects[i].severity)),
                         "look at it, and accept it again"});
    }
    for (const AcceptedDefect& named : acceptance.unknown) {
        diagnostics.add({Severity::warning, "quality.accepted-unknown", place,
                         fmt::format("no defect has the fingerprint {}{}", named.fingerprint,
                                     named.finding.empty() ? "" : fmt::format(" ({})", named.finding)),
                         "it is gone, or it is somewhere else now: take it off the list"});
    }
}

QualityReport without_accepted(const QualityReport& report, const Acceptance& acceptance) {
    QualityReport counted = report;
    counted.defects.clear();
    for (std::size_t i = 0; i < report.defects.size(); ++i) {
        if (!acceptance.accepts(i)) counted.defects.push_back(report.defects[i]);
    }
    return counted;
}

std::string accepted_text(const Acceptance& acceptance) {
    std::string text;
    for (std::size_t i = 0; i < acceptance.of_defect.size(); ++i) {
        const Acceptance::Entry& entry = acceptance.of_defect[i];
        if (!entry.accepted) continue;
        text += fmt::format("{}{}{}", text.empty() ? "accepted: " : ", ", i + 1,
                            entry.comment.empty() ? "" : fmt::format(" ({})", entry.comment));
    }
    return text;
}

}  // namespace clsurf::io
