#pragma once
// CurveBlocks: replaces consecutive short lines without a sharp corner by curves. An Akima curve passes through their
// points, one curve per constant-speed interval (numeric/speed_intervals.h). The whole interval is known when its curve is
// made, so both directions of travel give the same curve. Least-squares cubics pass near the points, over windows of ten
// blocks. Each block becomes its part of the curve, so lines, feeds and look-ahead remain those of the program.
//
// Curves may use half of the tolerance. A block whose curve would exceed it stays a line. The other half is for the
// roundings where curves and lines meet.

#include <deque>
#include <vector>

#include "numeric/cubic_span.h"
#include "simulation/path/block_stream.h"

namespace clsurf {

class CurveBlocks final : public ElementSource {
public:
    /// The source must outlive the object.
    CurveBlocks(ElementSource& source, CurveMode mode) : source_(&source), mode_(mode) {}

    [[nodiscard]] bool next(PathElement& element) override;

private:
    [[nodiscard]] bool joins(const PathElement& element) const;
    void add_run(bool goes_on);
    [[nodiscard]] std::size_t make_spans(bool goes_on);
    void add_akima(std::size_t first, std::size_t last);
    void add_fit(std::size_t first, std::size_t last, double allowed);

    ElementSource* source_;
    CurveMode mode_;
    std::vector<PathElement> run_;  ///< consecutive lines
    std::vector<Vec3> points_;      ///< their ends, scratch of make_spans()
    std::vector<CubicSpan> spans_;
    bool waiting_ = false;
    PathElement waiting_element_;  ///< the element after the run
    std::deque<PathElement> ready_;
};

}  // namespace clsurf
