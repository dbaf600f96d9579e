#pragma once
// Times as the project's files store them: UTC, ISO 8601, "2026-11-24T07:30:00Z". Sorted as text, they are in order of time.

#include <chrono>
#include <string>

namespace clsurf::io {

/// UTC now, "2026-11-24T07:30:00Z".
[[nodiscard]] std::string utc_now();
/// UTC with milliseconds, "2026-11-24T07:30:00.125Z".
[[nodiscard]] std::string utc_with_milliseconds(std::chrono::system_clock::time_point time);
/// The modification time of a file in the same form. Throws InputError.
[[nodiscard]] std::string utc_of_file(const std::string& path);
/// "2026-11-24", "2026-11-24T07:30", "2026-11-24T07:30:00Z" or with "+01:00" at the end → UTC. A time without a zone is UTC.
/// Throws UsageError, naming `option`.
[[nodiscard]] std::string parse_utc(const std::string& text, const std::string& option);

}  // namespace clsurf::io
