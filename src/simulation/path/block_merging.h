#pragma once
// BlockMerging: lines whose points lie within a tolerance of one line become that line (G64 Q; the naive CAM detector
// of LinuxCNC; compressors of other controls).

#include <cstdint>
#include <vector>

#include "simulation/path/block_stream.h"

namespace clsurf {

class BlockMerging final : public ElementSource {
public:
    /// Must outlive it.
    explicit BlockMerging(ElementSource& source) : source_(&source) {}

    /// A line that stands for several blocks keeps the line number of the last, and its greatest distance from the
    /// blocks as deviation. Blocks are numbered anew: a look-ahead counts those that remain.
    [[nodiscard]] bool next(PathElement& element) override;

private:
    [[nodiscard]] bool joins(const PathElement& element, double& deviation) const;

    ElementSource* source_;
    std::int64_t blocks_ = 0;
    bool waiting_ = false;
    PathElement waiting_element_, merged_;
    std::vector<Vec3> passed_;  ///< ends of the blocks that the merged line stands for
};

/// The lines of a program that are left after merging, by their numbers. Throws what BlockStream throws. O(motions).
[[nodiscard]] std::vector<LineNumber> merged_lines(const Program& program, const Machine& machine);

/// Per motion, whether it becomes one block with the motion behind it: a change of feed between them would part them. Throws what
/// BlockStream throws. O(motions).
[[nodiscard]] std::vector<std::uint8_t> merged_with_next(const Program& program, const Machine& machine);

}  // namespace clsurf
