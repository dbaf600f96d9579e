#include "surface/path_grid.h"

#include <bit>

namespace clsurf {

PathGrid::PathGrid(const Positions& positions, const Passes& passes, const ArcLength& arc_length, double cell)
    : grid_(cell) {
    Column<Entry> found;
    Column<CellGrid::Key> cells;
    for (std::size_t pass = 0; pass < passes.size(); ++pass) {
        if (passes[pass].kind != PassKind::cut) continue;
        double since = cell;
        for (PointIndex i = passes[pass].first; i <= passes[pass].last; ++i) {
            if (i > passes[pass].first) since += arc_length.step(i - 1);
            if (since < cell && i != passes[pass].last) continue;
            since = 0;
            found.push_back({i, static_cast<std::int32_t>(pass)});
            cells.push_back(grid_.key(positions[i].cast<double>()));
        }
    }
    // Counting sort by hash slot; about two entries a slot.
    const std::size_t slots = std::bit_ceil(found.size() / 2 + 2);
    shift_ = 64u - static_cast<unsigned>(std::countr_zero(slots));
    slot_start_ = Column<std::uint32_t>(slots + 1, 0);
    for (const std::uint64_t c : cells) ++slot_start_[(c * hash_factor >> shift_) + 1];
    for (std::size_t s = 0; s < slots; ++s) slot_start_[s + 1] += slot_start_[s];
    Column<std::uint32_t> next = slot_start_;
    entries_.resize(found.size());
    cells_.resize(found.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
        const std::uint32_t at = next[cells[k] * hash_factor >> shift_]++;
        entries_[at] = found[k];
        cells_[at] = cells[k];
    }
}

}  // namespace clsurf
