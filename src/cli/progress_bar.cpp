#include "cli/progress_bar.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>

#include "cli/text.h"

namespace clsurf::cli {
namespace {

constexpr auto redraw_period = std::chrono::milliseconds(100);
constexpr std::size_t bar_columns = 20;
constexpr std::size_t usual_width = 80;  // if the terminal does not report its width

std::size_t terminal_width() {
    winsize size{};
    const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return known ? size.ws_col : usual_width;
}

}  // namespace

std::string progress_line(std::string_view stage, double fraction, std::size_t width) {
    const double done = std::isfinite(fraction) ? std::clamp(fraction, 0.0, 1.0) : 0.0;
    const auto filled = static_cast<std::size_t>(done * static_cast<double>(bar_columns));
    std::string line = fmt::format("[{}{}] {:3} % {}", std::string(filled, '#'), std::string(bar_columns - filled, ' '),
                                   static_cast<int>(done * 100.0), stage);
    while (columns_of(line) > width) {
        // Removes one code point: its continuation bytes, then its first byte.
        while ((static_cast<unsigned char>(line.back()) & 0xC0) == 0x80) line.pop_back();
        line.pop_back();
    }
    return line;
}

ProgressBar::ProgressBar(const CommonOptions& options) {
    const bool terminal = isatty(STDERR_FILENO) == 1;
    if (options.progress == "always") {
        form_ = terminal ? Form::redrawn : Form::lines;
    } else if (options.progress == "auto" && terminal && !options.quiet) {
        form_ = Form::redrawn;
    }
}

Progress ProgressBar::callback() {
    if (form_ == Form::none) return {};
    return [this](std::string_view stage, double fraction) { report(stage, fraction); };
}

void ProgressBar::report(std::string_view stage, double fraction) {
    const std::lock_guard lock(mutex_);
    const bool new_stage = stage != stage_;
    if (new_stage) {
        stage_ = stage;
        tenths_ = -1;
    }
    if (form_ == Form::lines) {
        const int tenths = std::isfinite(fraction) ? static_cast<int>(fraction * 10.0) : 0;
        if (tenths <= tenths_) return;
        tenths_ = tenths;
        std::fprintf(stderr, "%s\n", progress_line(stage, fraction, usual_width).c_str());
        return;
    }
    const auto now = std::chrono::steady_clock::now();
    if (!new_stage && now < next_) return;
    next_ = now + redraw_period;
    // The last column stays empty: some terminals wrap when it is written.
    std::fprintf(stderr, "\r\033[K%s", progress_line(stage, fraction, terminal_width() - 1).c_str());
    drawn_ = true;
}

void ProgressBar::clear() {
    const std::lock_guard lock(mutex_);
    if (drawn_) std::fputs("\r\033[K", stderr);
    drawn_ = false;
}

}  // namespace clsurf::cli
