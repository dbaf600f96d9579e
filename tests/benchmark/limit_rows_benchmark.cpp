// Compares rebuilding the rows of a speed problem only for changed cells with a step over all rows: a window of cells
// with twelve rows each; one cell in fifty gets another row, as in the planner for dense
// programs. The argument is the number of cells.
#include <cstdint>
#include <vector>

#include <benchmark/benchmark.h>

#include "simulation/plan/limit_rows.h"

namespace clsurf {
namespace {

constexpr std::uint32_t rows_of_a_cell = 12, one_in = 50;

/// Half of them limit acceleration, half jerk. All have coefficients of 1.
void add_rows(LimitRows& rows, std::uint32_t cell, std::uint32_t count) {
    for (std::uint32_t number = 0; number < count; ++number) {
        LimitRow row;
        row.w = {0.1 + 0.01 * number, 0.2, 0.1};
        row.cell = cell;
        row.number = number;
        if (number % 2 == 1) {
            row.v = {0.25, 0.5, 0.25};
            row.unit = 0;
            row.kind = Row::axis_jerk;
        }
        rows.add(row);
    }
}

struct Window {
    explicit Window(std::uint32_t cells) : count(cells), value(cells + 2, 1.0) {
        for (std::uint32_t cell = 0; cell < cells; ++cell) add_rows(rows, cell, rows_of_a_cell);
        rows.begin(value.data(), 1e-3, 1.0);
    }
    std::uint32_t count;
    std::vector<double> value;
    LimitRows rows;
};

void a_row_more_in_some_cells(benchmark::State& state, bool keep) {
    const Window window(static_cast<std::uint32_t>(state.range(0)));
    LimitRows rows;
    for (auto _ : state) {
        rows.clear();
        for (std::uint32_t cell = 0; cell < window.count; ++cell) {
            const bool changed = cell % one_in == 0;
            if (keep && !changed)
                rows.keep(window.rows, cell);
            else
                add_rows(rows, cell, rows_of_a_cell + (changed ? 1 : 0));
        }
        rows.begin(window.value.data(), 1e-3, 0.05, &window.rows);
        benchmark::DoNotOptimize(rows.sides());
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK_CAPTURE(a_row_more_in_some_cells, all_made_anew, false)->Arg(250);
BENCHMARK_CAPTURE(a_row_more_in_some_cells, others_kept, true)->Arg(250);

void a_step_over_all_rows(benchmark::State& state) {
    Window window(static_cast<std::uint32_t>(state.range(0)));
    const std::vector<double> step(window.value.size(), 1e-6);
    NewtonSystem newton;
    for (auto _ : state) {
        for (std::vector<double>* part :
             {&newton.d0, &newton.d1, &newton.d2, &newton.pull, &newton.centring, &newton.products})
            part->assign(window.value.size(), 0);
        benchmark::DoNotOptimize(window.rows.assemble(window.value.data(), newton).sum);
        benchmark::DoNotOptimize(window.rows.predict(step.data(), newton).primal);
        benchmark::DoNotOptimize(window.rows.correct(step.data(), 1e-3).primal);
        window.rows.advance(0, 0);
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(a_step_over_all_rows)->Arg(250);

}  // namespace
}  // namespace clsurf
