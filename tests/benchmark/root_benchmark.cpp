// Compares numeric/root_between.h with Boost.Math on the root that S-curves need. The counter is the number of
// function calls.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>

#include <benchmark/benchmark.h>
#include <boost/math/tools/toms748_solve.hpp>

#include "numeric/root_between.h"

namespace clsurf {
namespace {

/// The distance that jerk-limited ramps between two speeds and a speed in between need beyond the available one.
struct Excess {
    double from, to, acceleration, jerk, arc_length;
    [[nodiscard]] double ramp(double a, double b) const {
        const double change = std::abs(b - a);
        const double time = change * jerk > acceleration * acceleration ? change / acceleration + acceleration / jerk
                                                                        : 2 * std::sqrt(change / jerk);
        return 0.5 * (a + b) * time;
    }
    double operator()(double speed) const { return ramp(from, speed) + ramp(speed, to) - arc_length; }
};

std::array<Excess, 256> problems() {
    std::mt19937_64 random(5);
    const auto spread = [&](double low, double high) {
        return std::exp(std::uniform_real_distribution<double>(std::log(low), std::log(high))(random));
    };
    std::array<Excess, 256> all{};
    for (Excess& e : all) {
        e = {spread(1, 50), spread(1, 50), spread(500, 5000), spread(1e4, 1e6), 0};
        e.arc_length = e(std::max(e.from, e.to)) + spread(0.01, 20);  // a faster speed is reached between
    }
    return all;
}

template <typename Solve>
void solve_all(benchmark::State& state, const Solve& solve) {
    const auto all = problems();
    std::uint64_t asked = 0;
    for (auto _ : state) {
        for (const Excess& e : all) {
            const double low = std::max(e.from, e.to), high = 1000;
            const auto f = [&](double v) { return ++asked, e(v); };
            benchmark::DoNotOptimize(solve(f, low, e(low), high, e(high), e.arc_length));
        }
    }
    const auto roots = static_cast<double>(state.iterations() * all.size());
    state.counters["asked"] = static_cast<double>(asked) / roots;
    state.SetItemsProcessed(static_cast<std::int64_t>(roots));
}

void root_between_of_ours(benchmark::State& state) {
    solve_all(state, [](const auto& f, double low, double at_low, double high, double at_high, double arc_length) {
        return root_between(low, at_low, high, at_high, 1e-15, 1e-15 * arc_length, f);
    });
}
BENCHMARK(root_between_of_ours);

void root_by_toms748(benchmark::State& state) {
    solve_all(state, [](const auto& f, double low, double at_low, double high, double at_high, double arc_length) {
        std::uintmax_t most = 200;
        const auto close = [](double a, double b) { return b - a <= 1e-15 * b; };
        (void)arc_length;
        return boost::math::tools::toms748_solve(f, low, high, at_low, at_high, close, most).first;
    });
}
BENCHMARK(root_by_toms748);

}  // namespace
}  // namespace clsurf
