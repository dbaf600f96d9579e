#include "field/patches.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <unordered_map>
#include <vector>

namespace clsurf {
namespace {

/// Sets of points that grow and merge (union by size, path halving).
class DisjointSets {
public:
    explicit DisjointSets(std::size_t count) : parent_(count), size_(count, 1) {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    }
    std::size_t root(std::size_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    /// Merges the sets of both; returns the new size.
    std::size_t join(std::size_t a, std::size_t b) {
        a = root(a);
        b = root(b);
        if (a == b) return size_[a];
        if (size_[a] < size_[b]) std::swap(a, b);
        parent_[b] = a;
        return size_[a] += size_[b];
    }

private:
    std::vector<std::size_t> parent_, size_;
};

/// Whether a point is one of at least `size` connected points of a kind. `size` is small.
template <typename IsOfKind>
bool is_of_section(PointIndex point, const Pass& pass, const Adjacency* neighbours, std::size_t size,
                   const IsOfKind& is_of_kind) {
    std::vector<PointIndex> found{point};
    const auto visit = [&](PointIndex i) {
        if (std::find(found.begin(), found.end(), i) == found.end() && is_of_kind(i)) found.push_back(i);
    };
    for (std::size_t k = 0; k < found.size() && found.size() < size; ++k) {
        const PointIndex i = found[k];
        if (i != pass.first) visit(i - 1);
        if (i != pass.last) visit(i + 1);
        if (neighbours == nullptr) continue;
        for (const Side side : {Side::left, Side::right}) {
            if (neighbours->has(side, i)) visit(neighbours->neighbour(side, i));
        }
    }
    return found.size() >= size;
}

}  // namespace

float end_without_patches(const Field& field, const Passes& passes, const Adjacency* neighbours,
                          const ShownPoints& shown, float end, bool above, std::size_t size) {
    const auto value = [&](PointIndex i) { return field.values[static_cast<std::size_t>(i)]; };
    std::vector<PointIndex> beyond;
    for (const Pass& pass : passes) {
        if (pass.kind != PassKind::cut) continue;
        for (PointIndex i = pass.first; i <= pass.last; ++i) {
            if ((above ? value(i) > end : value(i) < end) && (!shown || shown(i))) beyond.push_back(i);
        }
    }
    std::sort(beyond.begin(), beyond.end(), [&](PointIndex a, PointIndex b) {
        if (value(a) != value(b)) return above ? value(a) > value(b) : value(a) < value(b);
        return a < b;
    });
    std::unordered_map<PointIndex, std::size_t> rank_of;
    rank_of.reserve(beyond.size());
    for (std::size_t k = 0; k < beyond.size(); ++k) rank_of.emplace(beyond[k], k);
    // Adjacency is a relation of points to nearest points, so it need not be symmetric.
    std::vector<std::vector<std::size_t>> connected(beyond.size());
    const auto connect = [&](std::size_t k, PointIndex other) {
        const auto found = rank_of.find(other);
        if (found != rank_of.end()) connected[std::max(k, found->second)].push_back(std::min(k, found->second));
    };
    for (std::size_t k = 0; k < beyond.size(); ++k) {
        const PointIndex i = beyond[k];
        connect(k, i + 1);
        if (neighbours == nullptr) continue;
        for (const Side side : {Side::left, Side::right}) {
            if (neighbours->has(side, i)) connect(k, neighbours->neighbour(side, i));
        }
    }
    // From the farthest value inwards: the first patch that is large enough ends at this value.
    DisjointSets sets(beyond.size());
    for (std::size_t k = 0; k < beyond.size(); ++k) {
        for (const std::size_t farther : connected[k]) {
            if (sets.join(k, farther) >= size) return value(beyond[k]);
        }
    }
    return end;
}

float end_with_sections(const Field& field, const Passes& passes, const Adjacency* neighbours, const ShownPoints& shown,
                        float end, bool above, float threshold, std::size_t size) {
    const auto last = static_cast<PointIndex>(field.values.size()) - 1;
    const auto size_of = [&](PointIndex i) {
        const float value = field.values[static_cast<std::size_t>(i)];
        return above ? value : -value;
    };
    const auto exceeds = [&](PointIndex i) { return i >= 0 && i <= last && size_of(i) > threshold; };
    float farthest = above ? end : -end;
    for (const Pass& pass : passes) {
        if (pass.kind != PassKind::cut) continue;
        for (PointIndex i = pass.first; i <= pass.last; ++i) {
            // Few points exceed all before them.
            if (!(size_of(i) > farthest) || !exceeds(i) || size_of(i) > std::numeric_limits<float>::max()) continue;
            if ((!shown || shown(i)) && is_of_section(i, pass, neighbours, size, exceeds)) farthest = size_of(i);
        }
    }
    return above ? farthest : -farthest;
}

}  // namespace clsurf
