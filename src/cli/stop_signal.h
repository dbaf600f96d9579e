#pragma once
// Ctrl-C and similar signals, which end long operations.

namespace clsurf::cli {

/// After this call the first SIGINT, SIGTERM or SIGHUP makes stop_asked() true; a second one ends the program.
void catch_stop_signals();
[[nodiscard]] bool stop_asked();

}  // namespace clsurf::cli
