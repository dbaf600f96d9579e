#include "history/memory_plan.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/error.h"

namespace clsurf {

void MemoryPlan::add(std::size_t number, std::uint64_t expected) {
    const bool alone = budget_ > 0 && expected >= budget_;
    (alone ? again_ : waiting_).push_back({number, alone ? budget_ : expected, alone});
}

std::optional<PlannedRun> MemoryPlan::start() {
    if (running_ >= jobs_ || one_alone_) return std::nullopt;
    // The first one that fits: a large run does not delay small ones; it runs when they are done.
    const auto next = std::ranges::find_if(
        waiting_, [&](const PlannedRun& run) { return budget_ == 0 || used_ + run.reserve <= budget_; });
    PlannedRun run;
    if (next != waiting_.end()) {
        run = *next;
        waiting_.erase(next);
    } else if (waiting_.empty() && running_ == 0 && !again_.empty()) {
        run = again_.front();
        again_.pop_front();
        one_alone_ = true;
    } else {
        return std::nullopt;
    }
    used_ += run.reserve;
    ++running_;
    return run;
}

bool MemoryPlan::finish(const PlannedRun& run, bool too_little) {
    used_ -= run.reserve;
    --running_;
    if (run.alone) one_alone_ = false;
    if (!too_little || run.alone || budget_ == 0) return false;
    again_.push_back({run.number, budget_, true});
    return true;
}

std::uint64_t expected_memory(std::uint64_t log_bytes, bool compressed) {
    // Measured: 92 MB for a log of 1.9 MB, 113 MB for one of 7.2 MB, that is 85 MB plus four times the log. Twice as much
    // is reserved.
    constexpr double least = 170e6;
    constexpr double per_byte = 8;
    constexpr double unpacked = 8;  // a compressed log, at most
    return static_cast<std::uint64_t>(least + per_byte * (compressed ? unpacked : 1) * static_cast<double>(log_bytes));
}

std::uint64_t parse_memory(const std::string& text, const std::string& option) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
    double factor = 0;
    for (const auto& [name, bytes] : {std::pair<std::string_view, double>{"M", 1 << 20},
                                      {"MiB", 1 << 20},
                                      {"MB", 1e6},
                                      {"G", 1 << 30},
                                      {"GiB", 1 << 30},
                                      {"GB", 1e9}}) {
        if (unit == name) factor = bytes;
    }
    if (error != std::errc() || factor == 0 || !(value > 0) || !std::isfinite(value) || value * factor > 1e15)
        throw UsageError(option + ": '" + text + "' is not a size of memory with its unit, such as 8G or 500M");
    return static_cast<std::uint64_t>(value * factor);
}

}  // namespace clsurf
