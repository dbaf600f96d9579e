#pragma once
// Where in a subprogram a point is, and which calls led there.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "path/line_map.h"
#include "path/trajectory.h"

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

/// Finds the calls of points; keeps an index of the motions.
class CallChains {
public:
    /// All must outlive it. O(motions log motions) where the program calls anything, else O(1).
    CallChains(const Trajectory& path, const Log& log, const Program& program, const LineMap& lines);

    /// An aligned map knows the motion. Where the log gives lines, the motion is the nearest of those that the
    /// line runs itself or calls; of equally near ones the first. Where it names its programs, too, the line in the
    /// subprogram is the log's. O(motions of the line).
    [[nodiscard]] CallChain of(PointIndex point) const;

private:
    [[nodiscard]] std::int64_t motion_of(PointIndex point) const;
    [[nodiscard]] ProgramPlace place(std::size_t file, LineNumber line) const;

    const Trajectory* path_;
    const Log* log_;
    const Program* program_;
    const LineMap* lines_;
    std::vector<std::pair<LineNumber, std::int64_t>>
        by_line_;  ///< motions by their own line, and by the main program's that led to them
};

}  // namespace clsurf
