#pragma once
// ProgressBar: shows the progress of long stages on standard error. On a terminal one line is redrawn
// a few times per second and erased at the end; elsewhere (--progress always) each stage writes a line
// at every tenth of its progress.

#include <chrono>
#include <mutex>
#include <string>
#include <string_view>

#include "cli/options/options.h"
#include "core/progress.h"

namespace clsurf::cli {

/// "[##########          ]  50 % mapping points to lines"; at most `width` columns.
[[nodiscard]] std::string progress_line(std::string_view stage, double fraction, std::size_t width);

class ProgressBar {
public:
    explicit ProgressBar(const CommonOptions& options);
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;
    ~ProgressBar() { clear(); }

    /// The callback for the stages; empty if nothing is to be drawn. Must not outlive the bar.
    [[nodiscard]] Progress callback();
    /// Erases the line before other output to standard error.
    void clear();

private:
    enum class Form { none, redrawn, lines };

    void report(std::string_view stage, double fraction);

    Form form_ = Form::none;
    std::mutex mutex_;
    std::string stage_;
    int tenths_ = 0;
    bool drawn_ = false;
    std::chrono::steady_clock::time_point next_{};
};

}  // namespace clsurf::cli
