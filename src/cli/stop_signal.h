#pragma once
// Ctrl-C and its like, which end what goes on until then.

namespace clsurf::cli {

/// From now on the first SIGINT, SIGTERM or SIGHUP makes stop_asked() true; a second one ends the program.
void catch_stop_signals();
[[nodiscard]] bool stop_asked();

}  // namespace clsurf::cli
