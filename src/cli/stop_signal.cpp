#include "cli/stop_signal.h"

#include <csignal>
#include <initializer_list>

namespace clsurf::cli {
namespace {

volatile std::sig_atomic_t asked = 0;

}  // namespace

void catch_stop_signals() {
    struct sigaction action {};
    action.sa_handler = [](int) { asked = 1; };
    action.sa_flags = SA_RESETHAND;
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) ::sigaction(number, &action, nullptr);
}

bool stop_asked() { return asked != 0; }

}  // namespace clsurf::cli
