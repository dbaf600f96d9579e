#pragma once
// Drafts: the program with new points where it needs repair, before feeds are set.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "machine/machine.h"
#include "program/program.h"
#include "repair/optimize_rules.h"
#include "repair/points/line_rules.h"
#include "repair/points/orientation.h"
#include "surface/programmed_surface.h"

namespace clsurf {

/// Reads a text in the dialect of the program, with the same options.
using ReadProgram = std::function<Program(const std::string& text)>;

/// Limits of the lines of a draft [mm].
struct DraftLines {
    double chord_error = 0;    ///< largest distance of a line from the smooth curve
    double shortest_line = 0;  ///< shorter lines are used only to keep the tolerance
    EndLines ends{};           ///< of all passes, also where they need no repair
};

struct Draft {
    Program program;
    std::string text;
    std::size_t segments = 0, splines = 0, changed_lines = 0;  ///< splines: number of segments written as splines
    DraftLines lines{};
    std::vector<std::uint8_t> needed{};    ///< per motion of the old program: 0 if its points did not change
    std::vector<std::uint8_t> may_slow{};  ///< per motion of the draft, whether it may get a feed; empty: all may
    std::vector<std::uint8_t> merged{};    ///< per motion of the draft: merged_with_next(); empty: none is merged
};

class Drafter {
public:
    /// `slows_anywhere`: feeds may also change outside the selected sections. `orientation`: of a program that is run on five
    /// axes. All must outlive it. O(points).
    Drafter(const Program& program, const ReadProgram& read, const Machine& machine, const OptimizeRules& rules,
            bool slows_anywhere, const Orientation* orientation = nullptr);

    /// New points for the motions that need repair (one entry per motion).
    [[nodiscard]] Draft draft(const DraftLines& lines, std::vector<std::uint8_t> needed) const;
    /// The median length of the lines of the cut passes [mm].
    [[nodiscard]] double usual_spacing() const;
    /// The program without changes.
    [[nodiscard]] Draft unchanged() const;

private:
    /// Which motions of a draft the controller merges. On five axes it merges none.
    [[nodiscard]] std::vector<std::uint8_t> merged(const Program& program) const;

    const Program& program_;
    const ReadProgram& read_;
    const Machine& machine_;
    const OptimizeRules& rules_;
    bool slows_anywhere_;
    const Orientation* orientation_;
    ProgrammedSurface programmed_;
};

}  // namespace clsurf
