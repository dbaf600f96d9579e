#pragma once
// Diagnostic: a problem that does not end the run but that the user should know, with a stable code and a place.
// Diagnostics: a list that keeps the first few of each code and counts the rest, so that a log with a million gaps
// gives a readable answer in bounded memory.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/place.h"

namespace clsurf {

enum class Severity : std::uint8_t { note, warning, error };

[[nodiscard]] std::string_view name_of(Severity severity);  ///< "note", "warning", "error"

struct Diagnostic {
    Severity severity = Severity::warning;
    std::string code;  ///< stable, "log.gap", "program.unknown-word"
    Place where;
    std::string text;  ///< one sentence, numbers with units
    std::string hint;  ///< what to do; may be empty
};

class Diagnostics {
public:
    static constexpr std::size_t kept_of_a_code = 20;

    void add(Diagnostic diagnostic);
    /// Appends another list, in its order; used to join the lists of parallel blocks.
    void append(const Diagnostics& other);

    [[nodiscard]] const std::vector<Diagnostic>& kept() const { return kept_; }
    /// For a part of a file that was read by itself: its line, point or byte 0 is number `by` of the file.
    void move_places(std::uint64_t by);
    /// How many times a code was added, including those not kept.
    [[nodiscard]] std::uint64_t count(std::string_view code) const;
    /// The same for a severity. Diagnostics that were not kept count with the highest severity of their code.
    [[nodiscard]] std::uint64_t count(Severity severity) const;
    [[nodiscard]] bool has_errors() const { return errors_ > 0; }
    [[nodiscard]] bool empty() const { return kept_.empty(); }
    /// The kept diagnostics. If some of a code were not kept, the last of that code gives the number left out.
    [[nodiscard]] std::vector<Diagnostic> summary() const;

private:
    struct CodeCount {
        std::string code;
        Severity severity;
        std::uint64_t count;
        std::size_t kept;
    };
    CodeCount& entry(const Diagnostic& diagnostic);

    std::vector<Diagnostic> kept_;
    std::vector<CodeCount> counts_;
    std::uint64_t errors_ = 0;
};

/// "part.nc:2316:14: error: text" + source line + caret + "hint: …", each on its own line.
[[nodiscard]] std::string to_text(const Diagnostic& diagnostic);

}  // namespace clsurf
