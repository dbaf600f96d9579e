#pragma once
// Target and format of a report: --format, --json, --output of `check`, `lint`, `intervals`, `moves`.

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "cli/options/output_format.h"
#include "cli/subcommand.h"
#include "io/files/atomic_file.h"

namespace clsurf::cli {

/// --format with the values `words` ("text|json|csv"), --json, --output.
void declare_report_output(po::options_description& options, const char* words);

/// The file of --output, or standard output. It is opened early, so that a name that cannot be written fails before the work.
class ReportOutput {
public:
    /// `words`: the values of --format. Throws UsageError (two formats requested, an unknown extension),
    /// SystemError.
    ReportOutput(const po::variables_map& values, std::string_view words);

    /// "text" if no other format is requested.
    [[nodiscard]] const std::string& format() const { return format_; }
    /// Writes the whole report. With -q a text report is only written to a file. Throws SystemError.
    void write(std::string_view text);

private:
    std::string format_;
    bool quiet_ = false;
    std::unique_ptr<io::AtomicFile> file_;
};

/// Combines the reports of several logs. `format`: as in ReportOutput.
[[nodiscard]] std::string joined_reports(const std::vector<std::string>& logs, const std::vector<std::string>& texts,
                                         const std::string& format);

}  // namespace clsurf::cli
