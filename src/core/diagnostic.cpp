#include "core/diagnostic.h"

#include <algorithm>
#include <utility>

#include "core/printable_text.h"

namespace clsurf {
namespace {

constexpr std::size_t shown_source_bytes = 100;

/// The source line with escaped control characters, cut to the width of a terminal, and the caret under the column.
std::string source_and_caret(const Place& where) {
    std::string line;
    const std::size_t column = where.column > 0 ? where.column - 1 : 0;
    // A long line is shown around the place.
    const std::size_t from = column >= shown_source_bytes - 10 ? column - shown_source_bytes / 2 : std::size_t{0};
    std::size_t caret = 0;
    for (std::size_t i = from; i < where.source.size() && i < from + shown_source_bytes;) {
        const std::size_t size = printable_bytes(where.source, i);
        if (i <= column && column < i + std::max<std::size_t>(size, 1)) caret = line.size();
        if (size > 0)
            line += where.source.substr(i, size);
        else
            line += static_cast<unsigned char>(where.source[i]) < 0x20 ? ' ' : '?';
        i += std::max<std::size_t>(size, 1);
    }
    if (column >= from + line.size()) caret = line.size();
    std::string text = "    " + line + "\n";
    if (where.column > 0) text += "    " + std::string(caret, ' ') + "^\n";
    return text;
}

}  // namespace

std::string_view name_of(Severity severity) {
    switch (severity) {
        case Severity::note: return "note";
        case Severity::warning: return "warning";
        case Severity::error: return "error";
    }
    return "error";
}

Diagnostics::CodeCount& Diagnostics::entry(const Diagnostic& diagnostic) {
    const auto found =
        std::find_if(counts_.begin(), counts_.end(), [&](const CodeCount& c) { return c.code == diagnostic.code; });
    if (found != counts_.end()) return *found;
    counts_.push_back({diagnostic.code, diagnostic.severity, 0, 0});
    return counts_.back();
}

void Diagnostics::add(Diagnostic diagnostic) {
    if (diagnostic.severity == Severity::error) ++errors_;
    CodeCount& count = entry(diagnostic);
    count.severity = std::max(count.severity, diagnostic.severity);
    ++count.count;
    if (count.kept < kept_of_a_code) {
        ++count.kept;
        kept_.push_back(std::move(diagnostic));
    }
}

void Diagnostics::append(const Diagnostics& other) {
    for (const Diagnostic& diagnostic : other.kept_) add(diagnostic);
    for (const CodeCount& theirs : other.counts_) {
        if (theirs.count == theirs.kept) continue;
        for (CodeCount& ours : counts_) {
            if (ours.code == theirs.code) ours.count += theirs.count - theirs.kept;
        }
    }
    std::uint64_t kept_errors = 0;
    for (const Diagnostic& d : other.kept_) kept_errors += d.severity == Severity::error ? 1 : 0;
    errors_ += other.errors_ - kept_errors;
}

std::uint64_t Diagnostics::count(std::string_view code) const {
    for (const CodeCount& c : counts_) {
        if (c.code == code) return c.count;
    }
    return 0;
}

std::uint64_t Diagnostics::count(Severity severity) const {
    std::uint64_t sum = 0;
    for (const Diagnostic& d : kept_) sum += d.severity == severity ? 1 : 0;
    for (const CodeCount& c : counts_) sum += c.severity == severity ? c.count - c.kept : 0;
    return sum;
}

void Diagnostics::move_places(std::uint64_t by) {
    for (Diagnostic& d : kept_) d.where.number += by;
}

std::vector<Diagnostic> Diagnostics::summary() const {
    std::vector<Diagnostic> all = kept_;
    for (const CodeCount& c : counts_) {
        if (c.count == c.kept) continue;
        all.push_back(
            {c.severity,
             c.code,
             {},
             std::to_string(c.count - c.kept) + " more of '" + c.code + "', " + std::to_string(c.count) + " in all",
             {}});
    }
    return all;
}

std::string to_text(const Diagnostic& diagnostic) {
    std::string text;
    const std::string where = printable(diagnostic.where.text());
    if (!where.empty()) text += where + ": ";
    text += std::string(name_of(diagnostic.severity)) + ": " + printable(diagnostic.text) + "\n";
    if (!diagnostic.where.source.empty()) text += source_and_caret(diagnostic.where);
    if (!diagnostic.hint.empty()) text += "    hint: " + printable(diagnostic.hint) + "\n";
    return text;
}

}  // namespace clsurf
