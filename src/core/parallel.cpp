#include "core/parallel.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <thread>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

namespace clsurf {
namespace {

int wanted_threads = 0;
std::unique_ptr<tbb::global_control> control;

}  // namespace

void set_thread_count(int threads) {
    wanted_threads = threads;
    control = threads > 0 ? std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                                  static_cast<std::size_t>(threads))
                          : nullptr;
}

int thread_count() {
    const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    return wanted_threads > 0 ? wanted_threads : cores;
}

void parallel_for(std::int64_t count, std::int64_t grain, const std::function<void(std::int64_t, std::int64_t)>& body) {
    if (count <= 0) return;
    const std::int64_t pieces = (count + grain - 1) / grain;
    const auto piece = [&](std::int64_t i) { body(i * grain, std::min(count, (i + 1) * grain)); };
    if (pieces == 1 || thread_count() == 1) {
        for (std::int64_t i = 0; i < pieces; ++i) piece(i);
        return;
    }
#if defined(__SANITIZE_THREAD__)
    // The thread sanitizer does not see how TBB's library synchronises and would report all of it; our own bodies are
    // checked on plain threads.
    std::atomic<std::int64_t> next{0};
    std::vector<std::jthread> threads;
    for (int t = 0; t < thread_count(); ++t) {
        threads.emplace_back([&] {
            for (std::int64_t i = next++; i < pieces; i = next++) piece(i);
        });
    }
#else
    tbb::parallel_for(tbb::blocked_range<std::int64_t>(0, pieces, 1),
                      [&](const tbb::blocked_range<std::int64_t>& range) {
                          for (std::int64_t i = range.begin(); i != range.end(); ++i) piece(i);
                      });
#endif
}

void parallel_invoke(const std::function<void()>& first, const std::function<void()>& second) {
    if (thread_count() == 1) {
        first();
        second();
        return;
    }
#if defined(__SANITIZE_THREAD__)
    const std::jthread thread(first);
    second();
#else
    tbb::parallel_invoke(first, second);
#endif
}

}  // namespace clsurf
