#pragma once
// StageClock: where the time of a run goes, said with -v.

#include <chrono>
#include <cstdio>

#include <fmt/format.h>

namespace clsurf::cli {

class StageClock {
public:
    explicit StageClock(bool speaks) : speaks_(speaks) {}
    /// Ends a stage and says how long it took.
    void lap(const char* stage) {
        const auto now = std::chrono::steady_clock::now();
        if (speaks_) fmt::print(stderr, "{:<24} {:8.3f} s\n", stage, std::chrono::duration<double>(now - last_).count());
        last_ = now;
    }

private:
    bool speaks_;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace clsurf::cli
