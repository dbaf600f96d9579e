#pragma once
// StageClock: keeps track of the stages of a run. It moves the progress bar, and with -v prints the time of each
// stage.

#include <chrono>
#include <cstdio>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "cli/progress_bar.h"
#include "pipeline/stages.h"

namespace clsurf::cli {

class StageClock {
public:
    /// `stages`: the number of stages.
    StageClock(const CommonOptions& options, int stages)
        : speaks_(options.verbose), stages_(stages), bar_(options), progress_(bar_.callback()) {}
    StageClock(const StageClock&) = delete;
    StageClock& operator=(const StageClock&) = delete;
    ~StageClock() { end(); }

    /// Ends the previous stage and begins a new one.
    void begin(std::string_view stage) {
        end();
        stage_ = std::string(stage);
        start_ = std::chrono::steady_clock::now();
        if (progress_) progress_(stage, static_cast<double>(begun_) / stages_);
        ++begun_;
    }

    /// Begins the stages of a computation; refers to this clock.
    [[nodiscard]] Stages stages() {
        return [this](std::string_view stage) { begin(stage); };
    }

    /// Ends the stage and erases the bar, before other output.
    void end() {
        bar_.clear();
        if (speaks_ && !stage_.empty()) {
            const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start_;
            fmt::print(stderr, "{:<24} {:8.3f} s\n", stage_, took.count());
        }
        stage_.clear();
    }

private:
    bool speaks_;
    int stages_;
    int begun_ = 0;
    ProgressBar bar_;
    Progress progress_;
    std::string stage_;
    std::chrono::steady_clock::time_point start_;
};

}  // namespace clsurf::cli
