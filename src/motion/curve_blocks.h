#pragma once
// CurveBlocks: puts curves in the place of short lines that follow each other without a sharp corner. Akima's
// curve goes through their points, one for each constant-speed interval (curve/speed_intervals.h), which is
// known as a whole when its curve is made: a path that is run back is the same curve. Cubics of least
// squares go beside the points, over windows of ten blocks.
// Each block becomes the part of the curve that it stands for, so that lines, feeds and look-ahead stay
// those of the program.
//
// Curves may take half of the tolerance: a block that would leave it stays a line. The rest
// is for the roundings where curves and lines meet.

#include <deque>
#include <vector>

#include "curve/cubic_span.h"
#include "motion/block_stream.h"

namespace clsurf {

class CurveBlocks final : public ElementSource {
public:
    /// The source must outlive it.
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
    std::vector<PathElement> run_;  ///< lines that follow each other
    std::vector<Vec3> points_;      ///< their ends, scratch of make_spans()
    std::vector<CubicSpan> spans_;
    bool waiting_ = false;
    PathElement waiting_element_;  ///< the element after the run
    std::deque<PathElement> ready_;
};

}  // namespace clsurf
