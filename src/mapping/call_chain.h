#pragma once
// The place of a point in a subprogram, and the calls that led there.

#include <optional>
#include <string>
#include <vector>

#include "mapping/line_map.h"

namespace clsurf {

/// A line of a program or subprogram.
struct ProgramPlace {
    std::string file;  ///< name of its file; if the file was not read, its name in the log
    LineNumber line = 0;
    std::string text;  ///< of the line; empty if the file was not read
};

struct CallChain {
    std::optional<ProgramPlace> subprogram;  ///< nullopt: the point is not in a subprogram
    std::vector<ProgramPlace> calls;         ///< calls that led there, the main program's first
};

/// Every run of consecutive points that are on that line of a file of the program, in order. `file`: index into
/// Program::files. O(points).
[[nodiscard]] std::vector<PointRange> points_of(const Program& program, const LineMap& lines, std::size_t file,
                                                LineNumber line);

/// Finds the calls of points.
class CallChains {
public:
    /// All must outlive it.
    CallChains(const Log& log, const Program& program, const LineMap& lines)
        : log_(&log), program_(&program), lines_(&lines) {}

    /// By the motion of the point. If the log names its programs, the line in the subprogram is the log's.
    [[nodiscard]] CallChain of(PointIndex point) const;

private:
    [[nodiscard]] ProgramPlace place(std::size_t file, LineNumber line) const;

    const Log* log_;
    const Program* program_;
    const LineMap* lines_;
};

}  // namespace clsurf
