#include "io/formats/growing_log.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string_view>

#include <fmt/format.h>

#include "core/error.h"
#include "io/files/compressed.h"
#include "io/formats/text_table.h"

namespace clsurf::io {
namespace {

constexpr std::size_t text_record_bytes = 100;              ///< approximate size, for one read
constexpr std::size_t longest_head = std::size_t{1} << 20;  ///< [bytes] length by which the format must be recognised
constexpr std::size_t lines_to_detect = 4;  ///< number of records from which the format of a text is detected

std::string_view text_of_bytes(const std::vector<std::byte>& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Bytes up to the end of the last whole line.
std::size_t whole_lines(const std::vector<std::byte>& bytes) {
    const std::size_t end = text_of_bytes(bytes).rfind('\n');
    return end == std::string_view::npos ? 0 : end + 1;
}

}  // namespace

GrowingLog::GrowingLog(const std::string& path, const LogOptions& options) : file_(path), options_(options) {}

std::size_t GrowingLog::read(PointIndex most) {
    const std::size_t record = format_ != nullptr && frame_.record_bytes > 0 ? frame_.record_bytes : text_record_bytes;
    const std::size_t got = file_.read(static_cast<std::size_t>(most) * record, kept_);
    if (format_ == nullptr) {
        find_frame();
    } else {
        check_head();
    }
    if (format_ == nullptr) return got;
    if (frame_.record_bytes > 0) {
        take_records();
    } else {
        take_lines();
    }
    return got;
}

/// Recognises the format as soon as the head and some records are available.
void GrowingLog::find_frame() {
    if (is_compressed(kept_))
        throw InputError(Place::of_file(file_.name()), "is compressed: such a log cannot be followed",
                         "judge it when it is complete, without --follow");
    const bool text = is_text(std::span(kept_).first(std::min(kept_.size(), longest_head)));
    const std::size_t there = text ? whole_lines(kept_) : kept_.size();
    Source beginning{file_.name(), std::span<const std::byte>(kept_).first(there), nullptr};
    const LogFormat* format = there > 0 ? recognise_log(beginning, options_) : nullptr;
    if (format != nullptr && format->frame == nullptr) {
        throw InputError(
            Place::of_file(file_.name()),
            fmt::format("a log of the format {} is written as a whole: it cannot be followed", format->name),
            "judge it when it is complete, without --follow");
    }
    if (format == nullptr) {
        if (kept_.size() > longest_head) (void)open_log(beginning, options_);  // throws the specific error
        return;
    }
    try {
        frame_ = format->frame(beginning, options_);
    } catch (const InputError&) {
        // The head is incomplete or wrong: more bytes will show which.
        if (kept_.size() > longest_head) throw;
        return;
    }
    const std::string_view records = text_of_bytes(kept_).substr(std::min(there, frame_.head_bytes), there);
    const bool enough =
        frame_.record_bytes > 0
            ? kept_.size() >= frame_.head_bytes
            : static_cast<std::size_t>(std::count(records.begin(), records.end(), '\n')) >= lines_to_detect;
    if (!enough) return;
    format_ = format;
    const auto end_of_head = kept_.begin() + static_cast<std::ptrdiff_t>(frame_.head_bytes);
    head_.assign(kept_.begin(), end_of_head);
    kept_.erase(kept_.begin(), end_of_head);
}

/// A file that was rewritten from its beginning usually has another head.
void GrowingLog::check_head() const {
    std::vector<std::byte> now = file_.read_again(0, std::min(head_.size(), longest_head));
    std::vector<std::byte> then(head_.begin(), head_.begin() + static_cast<std::ptrdiff_t>(now.size()));
    if (frame_.count_at && *frame_.count_at + sizeof(std::uint64_t) <= now.size()) {
        std::memset(now.data() + *frame_.count_at, 0, sizeof(std::uint64_t));
        std::memset(then.data() + *frame_.count_at, 0, sizeof(std::uint64_t));
    }
    if (now != then) throw InputError(Place::of_file(file_.name()), "was rewritten while it was followed");
}

void GrowingLog::take_records() {
    const std::size_t records = kept_.size() / frame_.record_bytes;
    whole_bytes_ = records * frame_.record_bytes;
    end_ = first_ + static_cast<PointIndex>(records);
}

void GrowingLog::take_lines() {
    const std::string_view text = text_of_bytes(kept_);
    while (true) {
        const std::size_t end = text.find('\n', whole_bytes_);
        if (end == std::string_view::npos) return;
        std::string_view rest = text.substr(whole_bytes_, end + 1 - whole_bytes_);
        const std::string_view line = first_line(rest);
        if (!is_comment(line) && !(frame_.overruns && line.starts_with("overrun"))) {
            starts_.push_back(whole_bytes_);
            ++end_;
        }
        whole_bytes_ = end + 1;
    }
}

bool GrowingLog::ended() const {
    if (file_.ended()) return true;
    if (!frame_.count_at || format_ == nullptr) return false;
    const std::vector<std::byte> stored = file_.read_again(*frame_.count_at, sizeof(std::uint64_t));
    std::uint64_t count = 0;
    if (stored.size() == sizeof count) std::memcpy(&count, stored.data(), sizeof count);
    return count > 0 && end_ >= static_cast<PointIndex>(count);
}

Log GrowingLog::window() const {
    const auto bytes = std::make_shared<std::vector<std::byte>>();
    bytes->reserve(head_.size() + whole_bytes_);
    bytes->insert(bytes->end(), head_.begin(), head_.end());
    bytes->insert(bytes->end(), kept_.begin(), kept_.begin() + static_cast<std::ptrdiff_t>(whole_bytes_));
    return open_log_as(*format_, {file_.name(), *bytes, bytes}, options_);
}

void GrowingLog::forget(PointIndex before) {
    const PointIndex count = std::clamp<PointIndex>(before - first_, 0, end_ - first_);
    if (count == 0) return;
    std::size_t cut = static_cast<std::size_t>(count) * frame_.record_bytes;
    if (frame_.record_bytes == 0) {
        const auto left = starts_.begin() + static_cast<std::ptrdiff_t>(count);
        cut = left == starts_.end() ? whole_bytes_ : *left;
        starts_.erase(starts_.begin(), left);
        for (std::size_t& start : starts_) start -= cut;
    }
    kept_.erase(kept_.begin(), kept_.begin() + static_cast<std::ptrdiff_t>(cut));
    whole_bytes_ -= cut;
    forgotten_bytes_ += cut;
    first_ += count;
}

Source GrowingLog::whole_records() const {
    Source source = whole();
    source.bytes = source.bytes.first(std::min(source.bytes.size(), head_.size() + forgotten_bytes_ + whole_bytes_));
    return source;
}

}  // namespace clsurf::io
