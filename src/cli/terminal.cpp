#include "cli/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace clsurf::cli {
namespace {

/// Set and not empty.
std::string_view variable(const char* name) {
    const char* const value = std::getenv(name);
    return value == nullptr ? std::string_view() : std::string_view(value);
}

constexpr std::pair<std::string_view, std::string_view> painted[] = {
    {"error: ", "\033[1;31m"}, {"warning: ", "\033[1;33m"}, {"note: ", "\033[1;36m"}, {"hint: ", "\033[32m"}};
constexpr std::string_view plain = "\033[0m";

}  // namespace

std::size_t help_columns() {
    constexpr std::size_t usual = 80, least = 40;
    winsize size{};
    if (::isatty(STDOUT_FILENO) != 1 || ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0)
        return usual;
    return std::clamp<std::size_t>(size.ws_col, least, usual);
}

bool shows_colours(int descriptor) {
    if (!variable("NO_COLOR").empty()) return false;
    if (const std::string_view force = variable("CLICOLOR_FORCE"); !force.empty() && force != "0") return true;
    return ::isatty(descriptor) == 1 && variable("TERM") != "dumb";
}

std::string coloured_message(std::string_view text) {
    std::string out;
    bool shown = false;  // the word of this line is painted
    while (!text.empty()) {
        const auto* const word = shown ? std::end(painted)
                                       : std::find_if(std::begin(painted), std::end(painted),
                                                      [&](const auto& p) { return text.starts_with(p.first); });
        if (word != std::end(painted)) {
            const std::string_view name = word->first.substr(0, word->first.size() - 1);
            out.append(word->second).append(name).append(plain);
            text.remove_prefix(name.size());
            shown = true;
        }
        if (text.front() == '\n') shown = false;
        out += text.front();
        text.remove_prefix(1);
    }
    return out;
}

void write_message(std::string_view text) {
    const std::string coloured = shows_colours(STDERR_FILENO) ? coloured_message(text) : std::string(text);
    std::fwrite(coloured.data(), 1, coloured.size(), stderr);
}

}  // namespace clsurf::cli
