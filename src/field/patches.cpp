#include "field/patches.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>
#include <vector>

namespace clsurf {
namespace {

/// Sets of points that grow and meet (union by size, path halving).
class DisjointSets {
public:
    explicit DisjointSets(std::size_t count) : parent_(count), size_(count, 1) {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    }
    std::size_t root(std::size_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    /// The size of the set that both are in from now on.
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
    // Adjacency is a relation of points to nearest points: each of two may know the other alone.
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

}  // namespace clsurf
