#include "cli/options/report_output.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "cli/options/options.h"
#include "cli/options/vocabulary.h"
#include "io/reports/joined_reports.h"
#include "io/reports/json_text.h"

namespace clsurf::cli {
namespace {

std::string asked_format(const po::variables_map& values) {
    if (given(values, "json") && given(values, "format")) throw UsageError("use either --json or --format");
    const bool json = values.count("json") > 0;
    if (values.count("format") == 0 || (json && !given(values, "format"))) return json ? "json" : "";
    return values["format"].as<std::string>();
}

}  // namespace

void declare_report_output(po::options_description& options, const char* words) {
    // clang-format off
    options.add_options()
        ("format", po::value<std::string>()->value_name(words), "format of the report (default: from the file ending, else text)")
        ("json", "the same as --format json")
        ("output,o", po::value<std::string>()->value_name("FILE"), "output file (default: standard output); its ending chooses the format");
    // clang-format on
}

ReportOutput::ReportOutput(const po::variables_map& values, std::string_view words)
    : format_(asked_format(values)), quiet_(read_common(values).quiet) {
    const std::vector<std::string> known = words_of(words);
    std::vector<OutputFormat> formats;
    for (const OutputFormat& format : report_formats()) {
        if (std::find(known.begin(), known.end(), format.name) != known.end()) formats.push_back(format);
    }
    if (values.count("output") > 0) {
        const std::string path = required(values, "output");
        format_ = output_format(path, formats, format_).name;
        file_ = std::make_unique<io::AtomicFile>(path);
        quiet_ = false;
    }
    if (format_.empty()) format_ = formats.front().name;
}

void ReportOutput::write(std::string_view text) {
    if (file_) {
        file_->write(text);
        file_->commit();
    } else if (!quiet_ || format_ != "text") {
        write_to_stdout(text);
    }
}

std::string joined_reports(const std::vector<std::string>& logs, const std::vector<std::string>& texts,
                           const std::string& format) {
    if (format == "json") return io::list_json("logs", texts);
    if (texts.size() == 1) return texts.front();
    if (format == "junit") return io::joined_junit(texts);
    if (format == "sarif") return io::joined_sarif(logs, texts);
    std::string all;
    for (std::size_t i = 0; i < texts.size(); ++i) {
        if (format == "csv")
            all += io::csv_with_column("log", logs[i], texts[i], i == 0);
        else
            all += fmt::format("{}{}:\n{}", i == 0 ? "" : "\n", logs[i], texts[i]);
    }
    return all;
}

}  // namespace clsurf::cli
