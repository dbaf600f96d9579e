#pragma once
// Where in a subprogram a point is, and which calls led there.

#include <optional>
#include <string>
#include <vector>

#include "mapping/line_map.h"

namespace clsurf {

/// A line of a program or subprogram.
struct ProgramPlace {
    std::string file;  ///< name of its file; what the log calls it where the file was not read
    LineNumber line = 0;
    std::string text;  ///< of the line; empty where the file was not read
};

struct CallChain {
    std::optional<ProgramPlace> subprogram;  ///< nullopt: the point is none of a subprogram
    std::vector<ProgramPlace> calls;         ///< that led there, the main program's first
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

    /// By the motion of the point. Where the log names its programs, the line in the subprogram is the log's.
    [[nodiscard]] CallChain of(PointIndex point) const;

private:
    [[nodiscard]] ProgramPlace place(std::size_t file, LineNumber line) const;

    const Log* log_;
    const Program* program_;
    const LineMap* lines_;
};

}  // namespace clsurf
