#pragma once
// What writes the result of a log in `check`, by the word of --format.

#include <functional>
#include <map>
#include <string>

#include "io/reports/quality_report.h"
#include "io/reports/unusable_log.h"

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

using UnusableWriter = std::string (*)(const io::UnusableLog&);

/// Domain: a word of --format.
[[nodiscard]] inline UnusableWriter unusable_writer(const std::string& format) {
    static const std::map<std::string, UnusableWriter, std::less<>> writers{{"text", io::unusable_text},
                                                                            {"json", io::unusable_json},
                                                                            {"csv", io::unusable_csv},
                                                                            {"sarif", io::unusable_sarif},
                                                                            {"junit", io::unusable_junit}};
    return writers.at(format);
}

}  // namespace clsurf::cli
