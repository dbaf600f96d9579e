#pragma once
// Where a report goes, and in which form: --format, --json, --output of `check`, `lint`, `intervals`, `moves`.

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "cli/options/output_format.h"
#include "cli/subcommand.h"
#include "io/files/atomic_file.h"

namespace clsurf::cli {

/// --format with the words of `words` ("text|json|csv"), --json, --output.
void declare_report_output(po::options_description& options, const char* words);

/// The file of --output, or standard output. A name that cannot be written fails before the work.
class ReportOutput {
public:
    /// `words`: those of --format. Throws UsageError (two forms asked for, an ending that is none of them),
    /// SystemError.
    ReportOutput(const po::variables_map& values, std::string_view words);

    /// "text" where nothing asks for another one.
    [[nodiscard]] const std::string& format() const { return format_; }
    /// The whole report. With -q a text for people goes into a file only. Throws SystemError.
    void write(std::string_view text);

private:
    std::string format_;
    bool quiet_ = false;
    std::unique_ptr<io::AtomicFile> file_;
};

/// The reports of several logs as one. `format`: as ReportOutput has it.
[[nodiscard]] std::string joined_reports(const std::vector<std::string>& logs, const std::vector<std::string>& texts,
                                         const std::string& format);

}  // namespace clsurf::cli
