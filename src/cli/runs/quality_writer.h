#pragma once
// The writers of the result of a log in `check`, selected by --format.

#include <functional>
#include <map>
#include <string>

#include "io/reports/quality_report.h"
#include "io/reports/unusable_log.h"

namespace clsurf::cli {

/// The functions that write one format of a report.
struct ResultWriter {
    std::string (*quality)(const io::ReportedQuality&);
    std::string (*unusable)(const io::UnusableLog&);
};

/// Domain: a value of --format.
[[nodiscard]] inline const ResultWriter& result_writer(const std::string& format) {
    static const std::map<std::string, ResultWriter, std::less<>> writers{
        {"text", {io::quality_text, io::unusable_text}},
        {"json", {io::quality_json, io::unusable_json}},
        {"csv", {io::quality_csv, io::unusable_csv}},
        {"sarif", {io::quality_sarif, io::unusable_sarif}},
        {"junit", {io::quality_junit, io::unusable_junit}}};
    return writers.at(format);
}

}  // namespace clsurf::cli
