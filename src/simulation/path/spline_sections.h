#pragma once
// SplineSections: spans of splines as pairs of arcs that meet in a common tangent (biarcs), in which the trapezoidal
// planner drives them, as LinuxCNC does. A span that lies in no principal plane becomes lines.

#include <deque>

#include "simulation/path/block_stream.h"

namespace clsurf {

class SplineSections final : public ElementSource {
public:
    static constexpr double error = 1e-4;  ///< [mm] of a section from its span

    /// Must outlive it.
    explicit SplineSections(ElementSource& source) : source_(&source) {}

    [[nodiscard]] bool next(PathElement& element) override;

private:
    void divide(const PathElement& span);
    void add_lines(const PathElement& span);
    void add_arcs(const PathElement& span, int axis, double from, double to, int depth);

    ElementSource* source_;
    std::deque<PathElement> ready_;
};

}  // namespace clsurf
