#pragma once
// What writes a report of `check`, by the word of --format.

#include <functional>
#include <map>
#include <string>

#include "io/reports/quality_report.h"

namespace clsurf::cli {

using QualityWriter = std::string (*)(const io::ReportedQuality&);

/// Domain: a word of --format.
[[nodiscard]] inline QualityWriter quality_writer(const std::string& format) {
    static const std::map<std::string, QualityWriter, std::less<>> writers{{"text", io::quality_text},
                                                                           {"json", io::quality_json},
                                                                           {"csv", io::quality_csv},
                                                                           {"sarif", io::quality_sarif},
                                                                           {"junit", io::quality_junit}};
    return writers.at(format);
}

}  // namespace clsurf::cli
