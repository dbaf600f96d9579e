// The project's own stages of `render`, on a zigzag made in memory: bytes or points per second.
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>
#include <nanoflann.hpp>

#include "core/block.h"
#include "program/interpreter.h"
#include "support/made_path.h"
#include "surface/adjacency.h"
#include "surface/step_over.h"

namespace clsurf {
namespace {

/// Plain finishing lines, X Y Z with three decimals.
std::string plain_program(std::size_t lines) {
    std::string text = "G21 G90 G17\nG1 F3000\n";
    for (std::size_t i = 0; i < lines; ++i) {
        const auto number = [](double v) {
            std::string s = std::to_string(v);
            s.resize(s.find('.') + 4);
            return s;
        };
        const double x = static_cast<double>(i % 1000) * 0.344 - 11;
        text += "X" + number(x) + " Y" + number(static_cast<double>(i / 1000) * 0.4) + " Z" + number(x * x * 0.01 - 3) +
                "\n";
    }
    return text;
}

void parse_plain_lines(benchmark::State& state) {
    const auto text = std::make_shared<std::string>(plain_program(static_cast<std::size_t>(state.range(0))));
    InterpreterOptions options;
    options.dialect = find_dialect("fanuc");
    for (auto _ : state)
        benchmark::DoNotOptimize(parse_program(SourceText("made.nc", *text, text), options).motions.size());
    state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * text->size()));
}
BENCHMARK(parse_plain_lines)->Arg(1'000'000)->Unit(benchmark::kMillisecond);

const Positions& made_zigzag() {
    static const Positions p = test::zigzag(200, 500, 0.25, 0.05);
    return p;
}

void measure_arc_length(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(ArcLength(made_zigzag()));
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * made_zigzag().size());
}
BENCHMARK(measure_arc_length)->Unit(benchmark::kMillisecond)->UseRealTime();

void estimate_the_step_over(benchmark::State& state) {
    const Positions& p = made_zigzag();
    const ArcLength arc_length(p);
    const Passes runs = test::one_run(p);
    for (auto _ : state) benchmark::DoNotOptimize(estimate_step_over(p, runs, arc_length));
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * p.size());
}
BENCHMARK(estimate_the_step_over)->Unit(benchmark::kMillisecond)->UseRealTime();

void cut_into_passes(benchmark::State& state) {
    const Positions& p = made_zigzag();
    const ArcLength arc_length(p);
    const Passes runs = test::one_run(p);
    for (auto _ : state) benchmark::DoNotOptimize(find_passes(p, arc_length, runs, 0.25).size());
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * p.size());
}
BENCHMARK(cut_into_passes)->Unit(benchmark::kMillisecond)->UseRealTime();

void walk_both_neighbours(benchmark::State& state) {
    const Positions& p = made_zigzag();
    const ArcLength arc_length(p);
    const Passes passes = find_passes(p, arc_length, test::one_run(p), 0.25);
    for (auto _ : state) benchmark::DoNotOptimize(find_neighbours(p, passes, arc_length, 0.25).left.size());
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * p.size());
}
BENCHMARK(walk_both_neighbours)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Positions in the form that nanoflann needs.
struct Cloud {
    const Positions& p;
    [[nodiscard]] std::size_t kdtree_get_point_count() const { return static_cast<std::size_t>(p.size()); }
    [[nodiscard]] float kdtree_get_pt(std::size_t i, std::size_t axis) const {
        return axis == 0 ? p.x[i] : axis == 1 ? p.y[i] : p.z[i];
    }
    template <typename Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};

/// The same query with a k-d tree, in its usual form: of the points within 1.6 step-overs, the nearest
/// on the left and on the right that is not on the same pass. Both threads.
void ask_a_tree_for_both_neighbours(benchmark::State& state) {
    using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Cloud>, Cloud, 3>;
    const Positions& p = made_zigzag();
    const Cloud cloud{p};
    constexpr float step_over = 0.25F;
    constexpr float reach = 1.6F * step_over;
    for (auto _ : state) {
        const Tree tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(16));
        Adjacency found;
        found.left.resize(static_cast<std::size_t>(p.size()));
        found.right.resize(static_cast<std::size_t>(p.size()));
        for_each_block(p.size(), [&](PointIndex first, PointIndex last) {
            std::vector<std::pair<std::uint32_t, float>> near;
            for (PointIndex i = first; i < last; ++i) {
                const Eigen::Vector3f here = p[i];
                tree.radiusSearch(here.data(), reach * reach, near, nanoflann::SearchParams(0, 0.0F, true));
                const Eigen::Vector3f feed = p[std::min(i + 1, p.size() - 1)] - p[std::max<PointIndex>(i - 1, 0)];
                std::int32_t sides[2] = {Adjacency::none, Adjacency::none};
                for (const auto& item : near) {
                    const auto n = static_cast<PointIndex>(item.first);
                    const Eigen::Vector3f d = p[n] - here;
                    const float across = feed.x() * d.y() - feed.y() * d.x();
                    if (std::abs(across) < 0.5F * step_over * feed.norm()) continue;  // the own pass
                    std::int32_t& side = sides[across > 0 ? 0 : 1];
                    if (side == Adjacency::none) side = static_cast<std::int32_t>(n - i);
                }
                found.left[static_cast<std::size_t>(i)] = sides[0];
                found.right[static_cast<std::size_t>(i)] = sides[1];
            }
        });
        benchmark::DoNotOptimize(found);
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * p.size());
}
BENCHMARK(ask_a_tree_for_both_neighbours)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace clsurf
