#include "path/pieces.h"

#include <algorithm>

#include "core/block.h"

namespace clsurf {
namespace {

constexpr double gap = 1.5;  ///< periods between records that end a piece

}  // namespace

std::vector<PointRange> smooth_pieces(const Log& log, const Passes& passes) {
    std::vector<PointRange> pieces;
    PassKind before = PassKind::rapid;
    for (const Pass& pass : passes) {
        if (!pieces.empty() && pass.kind == PassKind::cut && before == PassKind::cut) {
            pieces.back().last = pass.last;
        } else {
            pieces.push_back({pass.first, pass.last});
        }
        before = pass.kind;
    }
    const Channel* time = log.find("time");
    if (time == nullptr) return pieces;
    std::vector<PointRange> whole;
    std::vector<double> t;
    for (PointRange piece : pieces) {
        for (PointIndex begin = piece.first; begin < piece.last; begin += block_points) {
            const PointIndex end = std::min(piece.last, begin + block_points);
            t.resize(static_cast<std::size_t>(end - begin + 1));
            copy_block(time->values, begin, t);
            for (std::size_t i = 1; i < t.size(); ++i) {
                if (t[i] - t[i - 1] <= gap * log.period) continue;
                const PointIndex cut = begin + static_cast<PointIndex>(i);
                whole.push_back({piece.first, cut - 1});
                piece.first = cut;
            }
        }
        whole.push_back(piece);
    }
    return whole;
}

}  // namespace clsurf
