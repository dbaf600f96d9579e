#include <cstring>
#include <utility>

#include "program/program.h"

namespace clsurf {
namespace {

constexpr LineNumber kept_every = 64;

}  // namespace

SourceText::SourceText(std::string name, std::string_view text, std::shared_ptr<const void> keep_alive)
    : name_(std::move(name)), text_(text), keep_alive_(std::move(keep_alive)) {
    // Every line ends at a line feed; single carriage returns of old tapes do not end lines.
    std::size_t at = 0;
    while (at < text_.size()) {
        if (line_count_ % kept_every == 0) every_64th_.push_back(at);
        ++line_count_;
        const void* end = std::memchr(text_.data() + at, '\n', text_.size() - at);
        if (end == nullptr) break;
        at = static_cast<std::size_t>(static_cast<const char*>(end) - text_.data()) + 1;
    }
}

std::string_view SourceText::line(LineNumber number) const {
    if (number == 0 || number > line_count_) return {};
    std::size_t at = every_64th_[(number - 1) / kept_every];
    for (LineNumber skip = (number - 1) % kept_every; skip > 0; --skip) { at = text_.find('\n', at) + 1; }
    const std::size_t end = text_.find('\n', at);
    std::string_view line = text_.substr(at, end == std::string_view::npos ? end : end - at);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

}  // namespace clsurf
