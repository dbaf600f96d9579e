// The stages of `render` that are ours, on a zigzag made in memory: bytes or points per second.
#include <string>

#include <benchmark/benchmark.h>

#include "path/step_over.h"
#include "program/interpreter.h"
#include "support/made_path.h"
#include "surface/adjacency.h"

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
        text += "X" + number(x) + " Y" + number(static_cast<double>(i / 1000) * 0.4) + " Z" + number(x * x * 0.01 - 3) + "\n";
    }
    return text;
}

void parse_plain_lines(benchmark::State& state) {
    const auto text = std::make_shared<std::string>(plain_program(static_cast<std::size_t>(state.range(0))));
    InterpreterOptions options;
    options.dialect = find_dialect("fanuc");
    for (auto _ : state) benchmark::DoNotOptimize(parse_program(SourceText("made.nc", *text, text), options).motions.size());
    state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * text->size()));
}
BENCHMARK(parse_plain_lines)->Arg(1'000'000)->Unit(benchmark::kMillisecond);

const Positions& made_zigzag() {
    static const Positions p = test::zigzag(200, 500, 0.25, 0.05);
    return p;
}

void measure_way(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(Way(made_zigzag()));
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * made_zigzag().size());
}
BENCHMARK(measure_way)->Unit(benchmark::kMillisecond)->UseRealTime();

void estimate_the_step_over(benchmark::State& state) {
    const Positions& p = made_zigzag();
    const Way way(p);
    const Passes runs = test::one_run(p);
    for (auto _ : state) benchmark::DoNotOptimize(estimate_step_over(p, runs, way));
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * p.size());
}
BENCHMARK(estimate_the_step_over)->Unit(benchmark::kMillisecond)->UseRealTime();

void cut_into_passes(benchmark::State& state) {
    const Positions& p = made_zigzag();
    const Way way(p);
    const Passes runs = test::one_run(p);
    for (auto _ : state) benchmark::DoNotOptimize(find_passes(p, way, runs, 0.25).size());
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * p.size());
}
BENCHMARK(cut_into_passes)->Unit(benchmark::kMillisecond)->UseRealTime();

void walk_both_neighbours(benchmark::State& state) {
    const Positions& p = made_zigzag();
    const Way way(p);
    const Passes passes = find_passes(p, way, test::one_run(p), 0.25);
    for (auto _ : state) benchmark::DoNotOptimize(find_neighbours(p, passes, way, 0.25).left.size());
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * p.size());
}
BENCHMARK(walk_both_neighbours)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace clsurf
