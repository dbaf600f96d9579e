#pragma once
// Where a report goes, and in which form: --format, --json, --output of `check`, `lint`, `intervals`.

#include <memory>
#include <string>
#include <string_view>

#include "cli/subcommand.h"
#include "io/atomic_file.h"

namespace clsurf::cli {

/// "text" where neither --format nor --json is given. Throws UsageError where both are.
[[nodiscard]] std::string report_format(const po::variables_map& values);

/// The file of --output, or standard output. A name that cannot be written fails before the work.
class ReportOutput {
public:
    /// Throws SystemError.
    explicit ReportOutput(const po::variables_map& values);
    /// The whole report. Throws SystemError.
    void write(std::string_view text);

private:
    std::unique_ptr<io::AtomicFile> file_;
};

}  // namespace clsurf::cli
