#include "cli/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <utility>

#include "cli/text.h"

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

constexpr std::size_t usual_columns = 80;

/// The number of columns of the terminal of standard output.
std::optional<std::size_t> terminal_columns() {
    constexpr std::size_t least = 40;
    winsize size{};
    if (::isatty(STDOUT_FILENO) != 1 || ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0)
        return std::nullopt;
    return std::max<std::size_t>(size.ws_col, least);
}

}  // namespace

std::size_t help_columns() { return std::min(terminal_columns().value_or(usual_columns), usual_columns); }

std::size_t table_columns() { return terminal_columns().value_or(usual_columns); }

std::string fit_terminal(std::string_view text) {
    const std::optional<std::size_t> columns = terminal_columns();
    if (!columns) return std::string(text);
    std::string fitted;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (columns_of(line) <= *columns) {
            fitted.append(line).append("\n");
        } else {
            for (const std::string& part : wrap(line, *columns)) fitted.append(part).append("\n");
        }
    }
    return fitted;
}

bool shows_colours(int descriptor) {
    if (!variable("NO_COLOR").empty()) return false;
    if (const std::string_view force = variable("CLICOLOR_FORCE"); !force.empty() && force != "0") return true;
    return ::isatty(descriptor) == 1 && variable("TERM") != "dumb";
}

std::string coloured_message(std::string_view text) {
    std::string out;
    bool shown = false;  // the keyword of this line is coloured
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
