#pragma once
// MemoryPlan: which of many runs may be judged at the same time, within a number of jobs and a budget of memory.
//
// Each run has a reserve, what it is expected to need at most. Reserves of runs that work at the same time never exceed
// the budget. A run that needed more than its reserve is tried again alone, with the whole budget.

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

namespace clsurf {

struct PlannedRun {
    std::size_t number = 0;     ///< of the caller
    std::uint64_t reserve = 0;  ///< [bytes]
    bool alone = false;         ///< it has the whole budget: the second attempt, or it needs as much
};

class MemoryPlan {
public:
    /// `budget` [bytes], 0: no limit; jobs ≥ 1.
    MemoryPlan(std::size_t jobs, std::uint64_t budget) : jobs_(jobs), budget_(budget) {}

    /// A run that is to be judged, expected to need so much [bytes].
    void add(std::size_t number, std::uint64_t expected);
    /// The next one that may begin now; nothing: none may, or none is left.
    [[nodiscard]] std::optional<PlannedRun> start();
    /// It has ended. `too_little`: for lack of memory. Returns whether it will be tried again.
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
    std::deque<PlannedRun> again_;  ///< alone, when all others are done
};

/// What judging a log of that size is expected to need at most [bytes], twice what was measured.
[[nodiscard]] std::uint64_t expected_memory(std::uint64_t log_bytes, bool compressed);

/// "8G", "500M", "1.5GiB" → bytes. Throws UsageError, naming `option`.
[[nodiscard]] std::uint64_t parse_memory(const std::string& text, const std::string& option);

}  // namespace clsurf
