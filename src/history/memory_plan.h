#pragma once
// MemoryPlan: which of many runs may be judged at the same time, within a number of jobs and a memory budget.
//
// Each run has a reserve, its expected peak memory. The reserves of concurrent runs never exceed
// the budget. A run that needed more than its reserve is repeated alone, with the whole budget.

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

namespace clsurf {

struct PlannedRun {
    std::size_t number = 0;     ///< the caller's number of the run
    std::uint64_t reserve = 0;  ///< [bytes]
    bool alone = false;         ///< it has the whole budget: a second attempt, or a run that is expected to need it
};

class MemoryPlan {
public:
    /// `budget` [bytes], 0: no limit; jobs ≥ 1.
    MemoryPlan(std::size_t jobs, std::uint64_t budget) : jobs_(jobs), budget_(budget) {}

    /// Adds a run that is expected to need this much memory [bytes].
    void add(std::size_t number, std::uint64_t expected);
    /// The next run that may begin now; nullopt: none may, or all have begun.
    [[nodiscard]] std::optional<PlannedRun> start();
    /// Marks a run as ended. `too_little`: for lack of memory. Returns whether it will be repeated.
    bool finish(const PlannedRun& run, bool too_little);

    [[nodiscard]] std::size_t running() const { return running_; }
    [[nodiscard]] bool done() const { return running_ == 0 && waiting_.empty() && again_.empty(); }

private:
    std::size_t jobs_;
    std::uint64_t budget_;
    std::uint64_t used_ = 0;
    std::size_t running_ = 0;
    bool one_alone_ = false;
    std::deque<PlannedRun> waiting_;
    std::deque<PlannedRun> again_;  ///< alone, after all others have ended
};

/// Expected peak memory for judging a log of that size [bytes], twice the measured one.
[[nodiscard]] std::uint64_t expected_memory(std::uint64_t log_bytes, bool compressed);

/// "8G", "500M", "1.5GiB" → bytes. Throws UsageError, naming `option`.
[[nodiscard]] std::uint64_t parse_memory(const std::string& text, const std::string& option);

}  // namespace clsurf
