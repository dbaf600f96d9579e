#pragma once
// SplineSections: converts spans of splines into pairs of arcs with a common tangent (biarcs), as the trapezoidal planner
// of LinuxCNC runs them. A span that is in no principal plane becomes lines.

#include <deque>

#include "simulation/path/block_stream.h"

namespace clsurf {

class SplineSections final : public ElementSource {
public:
    // See docs/simulate.md#special-cases, splines.
    static constexpr double error = 1e-4;  ///< [mm] greatest distance of a section from its span

    /// Must outlive the object.
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
