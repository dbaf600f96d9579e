#include "program/motion.h"

#include <algorithm>

namespace clsurf {
namespace {

template <typename F>
void for_each_column(Motions& m, F&& f) {
    f(m.kind);
    f(m.end);
    f(m.feed);
    f(m.line);
    f(m.rotary);
    f(m.tool_axis);
    f(m.file);
    f(m.call);
    f(m.frame);
}

}  // namespace

const Arc* Motions::arc_of(std::int64_t i) const {
    const auto found =
        std::lower_bound(arcs.begin(), arcs.end(), i, [](const Arc& arc, std::int64_t m) { return arc.motion < m; });
    return found != arcs.end() && found->motion == i ? &*found : nullptr;
}

const Curve* Motions::curve_of(std::int64_t i) const {
    const auto found = std::lower_bound(curves.begin(), curves.end(), i,
                                        [](const Curve& curve, std::int64_t m) { return curve.motion < m; });
    return found != curves.end() && found->motion == i ? &*found : nullptr;
}

void Motions::drop_front(std::int64_t count) {
    if (count == 0) return;
    const auto n = static_cast<std::size_t>(count);
    start = end[n - 1];
    for_each_column(*this, [n](auto& column) {
        if (!column.empty()) column.drop_front(n);
    });
    for (std::int64_t& from : programmed_from) from = std::max<std::int64_t>(0, from - count);
    arcs.erase(arcs.begin(),
               std::find_if(arcs.begin(), arcs.end(), [count](const Arc& arc) { return arc.motion >= count; }));
    for (Arc& arc : arcs) arc.motion -= count;
    curves.erase(curves.begin(), std::find_if(curves.begin(), curves.end(),
                                              [count](const Curve& curve) { return curve.motion >= count; }));
    for (Curve& curve : curves) curve.motion -= count;
}

void Motions::truncate(std::int64_t count) {
    const auto n = static_cast<std::size_t>(count);
    for_each_column(*this, [n](auto& column) {
        if (!column.empty()) column.resize(n);
    });
    for (std::int64_t& from : programmed_from) from = std::min(from, count);
    while (!arcs.empty() && arcs.back().motion >= count) arcs.pop_back();
    while (!curves.empty() && curves.back().motion >= count) curves.pop_back();
}

}  // namespace clsurf
