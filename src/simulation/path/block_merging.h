#pragma once
// BlockMerging: replaces lines whose points are within a tolerance of one line by that line (G64 Q; the naive CAM detector
// of LinuxCNC; compressors of other controls).

#include <cstdint>
#include <vector>

#include "simulation/path/block_stream.h"

namespace clsurf {

class BlockMerging final : public ElementSource {
public:
    /// Must outlive it.
    explicit BlockMerging(ElementSource& source) : source_(&source) {}

    /// A line that replaces several blocks has the line number of the last one; its deviation is the greatest distance to
    /// the blocks. Blocks are renumbered, so that a look-ahead counts the remaining ones.
    [[nodiscard]] bool next(PathElement& element) override;

private:
    [[nodiscard]] bool joins(const PathElement& element, double& deviation) const;

    ElementSource* source_;
    std::int64_t blocks_ = 0;
    bool waiting_ = false;
    PathElement waiting_element_, merged_;
    std::vector<Vec3> passed_;  ///< ends of the blocks that the merged line replaces
};

/// The lines of a program that remain after merging, by their numbers. Throws what BlockStream throws. O(motions).
[[nodiscard]] std::vector<LineNumber> merged_lines(const Program& program, const Machine& machine);

/// For each motion, whether it is merged with the next motion into one block; a change of feed between them would prevent
/// that. Throws what BlockStream throws. O(motions).
[[nodiscard]] std::vector<std::uint8_t> merged_with_next(const Program& program, const Machine& machine);

}  // namespace clsurf
