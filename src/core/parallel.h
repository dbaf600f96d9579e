#pragma once
// The only access to parallelism. All other code sees ranges of indices.

#include <cstdint>
#include <functional>

namespace clsurf {

/// Sets how many threads may work; 0: as many as the machine has cores. Called once, by main().
void set_thread_count(int threads);
[[nodiscard]] int thread_count();

/// Calls body(first, last) for [0, count) cut into pieces of `grain` indices (the last may be shorter), in parallel
/// if there is more than one piece and more than one thread. The cut does not depend on the number of threads, so
/// neither do results joined by piece.
void parallel_for(std::int64_t count, std::int64_t grain,
                  const std::function<void(std::int64_t first, std::int64_t last)>& body);

/// Runs both, at the same time if there are two threads.
void parallel_invoke(const std::function<void()>& first, const std::function<void()>& second);

}  // namespace clsurf
