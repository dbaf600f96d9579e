#pragma once
// Program: the text of an NC program, its lines and its motions. A value: built by parse_program(), not changed
// afterwards.

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

#include "core/column.h"
#include "core/diagnostic.h"
#include "core/point.h"
#include "program/dialect.h"
#include "program/motion.h"

namespace clsurf {

/// A source text and its lines.
class SourceText {
public:
    SourceText() = default;
    /// `keep_alive` owns the bytes that `text` views. Cost: one pass over the text.
    SourceText(std::string name, std::string_view text, std::shared_ptr<const void> keep_alive);

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] std::string_view text() const { return text_; }
    [[nodiscard]] LineNumber line_count() const { return line_count_; }
    /// The text of a line (from 1) without its end; empty if there is no such line. O(1).
    [[nodiscard]] std::string_view line(LineNumber number) const;

private:
    std::string name_;
    std::string_view text_;
    std::shared_ptr<const void> keep_alive_;
    Column<std::uint64_t> every_64th_;  ///< byte at which line 1, 65, 129 … begins
    LineNumber line_count_ = 0;
};

/// How the tool passes from one block to the next.
enum class BlockEnd : std::uint8_t {
    rounded,     ///< corners may be cut within a tolerance: G64, G642, CYCLE832
    exact_path,  ///< through every corner, without a stop if the path is tangent-continuous: G61 of linuxcnc
    exact_stop,  ///< at rest at the end of every block: G60, G9, G61.1, G61 of fanuc
};

struct PathMode {
    BlockEnd block_end = BlockEnd::rounded;
    /// Tolerance of rounded corners [mm]. NaN: the machine's own; infinite: limited by the speed only (G64 without P).
    double tolerance = std::numeric_limits<double>::quiet_NaN();
    double merging_tolerance = 0;  ///< [mm] for merging short blocks before corners are rounded (Q of G64)
};

/// What F counts: lengths per minute or per revolution of the spindle, or the inverse of the duration of a motion.
enum class FeedMode : std::uint8_t { per_minute, per_revolution, inverse_time };

/// Whether positions are those of the tool's tip in the workpiece (G43.4, TRAORI, M128, a tilted plane) or of the
/// machine's axes.
struct ToolCentrePointControl {
    bool on = false;
};

/// The tool that a program calls or preselects: T5, T="DRILL".
struct ToolWord {
    std::optional<double> number;  ///< as programmed; nullopt: the tool has a name
    std::string name;

    friend bool operator<(const ToolWord& a, const ToolWord& b) {
        return std::tie(a.number, a.name) < std::tie(b.number, b.name);
    }
};

/// The effect of an event on the interpretation of motions; std::monostate: for display only.
using EventMeaning = std::variant<std::monostate, PathMode, FeedMode, ToolCentrePointControl, ToolWord>;

/// An instruction of the program other than motion, in order: modes, spindle, tool.
struct ProgramEvent {
    std::int64_t motion = 0;  ///< takes effect before this motion
    LineNumber line = 0;
    std::string name;   ///< "path-mode", "high-speed", "spindle", "tool", "end", …; for display only, as is `value`
    std::string value;  ///< "G64 P0.005 Q0", "CYCLE832(0.02,1,1)", "S12000 M3"
    EventMeaning meaning;

    /// nullptr if it sets no path mode.
    [[nodiscard]] const PathMode* path_mode() const { return std::get_if<PathMode>(&meaning); }
};

struct Program {
    std::vector<SourceText> files;  ///< files[0] is the main program
    const Dialect* dialect = nullptr;
    std::string dialect_guessed_from;  ///< "'#<' in line 11, the ending .ngc"; empty: the dialect was given
    Motions motions;
    std::vector<ProgramEvent> events;
    Diagnostics diagnostics;

    [[nodiscard]] const SourceText& main() const { return files.front(); }
};

}  // namespace clsurf
