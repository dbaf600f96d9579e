// clsurf_planted: evaluates the predictor on logs with planted defects.
//
//   clsurf_planted score [CASES [SEED [hard]]]   a line per shape: recall, precision, places, lines, depths
//   clsurf_planted curve [CASES [SEED]]          recall against amplitude
//   clsurf_planted kinds [CASES [SEED [NAME]]]   a line per kind of log (kinds.h), one case in four clean
//   clsurf_planted write SHAPE SEED PREFIX [hard]       PREFIX.nc and PREFIX.biip, what is planted on stdout; SHAPE
//                                                or the name of a kind, with `hard` then a clean one

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/statistics.h"
#include "io/files/atomic_file.h"
#include "io/formats/biip.h"
#include "kinds.h"
#include "planted_score.h"

namespace clsurf::planted {
namespace {

constexpr Shape shapes[] = {Shape::zigzag, Shape::one_way, Shape::loops, Shape::spiral};

/// A percentile of the absolute values.
double percentile(std::vector<double> values, double share) {
    for (double& v : values) v = std::abs(v);
    return values.empty() ? 0 : quantile_below(values, share);
}

void print(std::string_view name, const Score& s, const Score& clean) {
    fmt::print(
        "{:<8} recall {:.3f} ({} of {})  precision {:.3f} ({} of {})  clean: {} false in {} points  place {}  lines {}  cause {}  depth error p50 {:.1f} % p95 {:.1f} %\n",
        name, s.recall(), s.found, s.planted, s.precision(), s.right, s.reported - s.natural,
        clean.reported - clean.natural, clean.points, s.placed, s.lined, s.named, 100 * percentile(s.depth_errors, 0.5),
        100 * percentile(s.depth_errors, 0.95));
}

int score_shapes(int cases, std::uint64_t seed, bool hard) {
    Score all;
    Score all_clean;
    for (const Shape shape : shapes) {
        Score planted;
        Score clean;
        for (int k = 0; k < cases; ++k) {
            const bool is_clean = k % 4 == 3;
            const PlantedLog log =
                make_planted_log(random_recipe(seed + static_cast<std::uint64_t>(k), shape, is_clean, hard));
            const Score one = score(log, judge(log));
            (is_clean ? clean : planted) += one;
            const bool odd = is_clean ? one.reported > 0 : one.found < one.planted || one.right < one.reported;
            if (odd)
                fmt::print("  {} seed {}: found {} of {}, right {} of {}\n", name_of(shape),
                           seed + static_cast<std::uint64_t>(k), one.found, one.planted, one.right, one.reported);
        }
        print(name_of(shape), planted, clean);
        all += planted;
        all_clean += clean;
    }
    print("all", all, all_clean);
    return all.recall() >= 0.95 && all.precision() >= 0.95 ? 0 : 1;
}

/// Plants one defect of a given kind and amplitude on each log.
int print_curve(int cases, std::uint64_t seed) {
    struct Row {
        Kind kind;
        std::vector<double> amplitudes;
        double shown;
        std::string_view unit;
    };
    const std::vector<Row> rows{{Kind::speed, {0.01, 0.02, 0.03, 0.04, 0.05, 0.07, 0.10}, 100, "%"},
                                {Kind::oscillation, {0.01, 0.02, 0.03, 0.04, 0.05, 0.07, 0.10}, 100, "%"},
                                {Kind::lag, {0.0005, 0.001, 0.0012, 0.0015, 0.002, 0.003, 0.005}, 1000, "µm"}};
    for (const Row& row : rows) {
        for (const double amplitude : row.amplitudes) {
            Score sum;
            for (int k = 0; k < cases; ++k) {
                const Shape shape = shapes[k % 4];
                Recipe recipe = random_recipe(seed + static_cast<std::uint64_t>(k), shape, false, true);
                recipe.defects.resize(1);
                recipe.defects[0].kind = row.kind;
                recipe.defects[0].amplitude = row.kind == Kind::lag && k % 8 >= 4 ? -amplitude : amplitude;
                const PlantedLog log = make_planted_log(recipe);
                sum += score(log, judge(log));
            }
            fmt::print("{:<12} {:5.2f} {:<2}  recall {:.3f}  precision {:.3f}  depth error p50 {:.1f} %\n",
                       name_of(row.kind), amplitude * row.shown, row.unit, sum.recall(), sum.precision(),
                       100 * percentile(sum.depth_errors, 0.5));
        }
    }
    return 0;
}

/// Scores of one kind: for logs with faults, and for clean ones.
struct KindScore {
    Score planted, clean;
    double coverage = 1;  ///< the least
};

KindScore score_kind(const LogKind& kind, int cases, std::uint64_t seed) {
    KindScore sum;
    for (int k = 0; k < cases; ++k) {
        const bool clean = k % 4 == 3;
        const std::uint64_t own = seed + static_cast<std::uint64_t>(k);
        const PlantedLog log = make_log_of_kind(kind, own, clean);
        const QualityReport report = judge(log);
        const Score one = score(log, report);
        (clean ? sum.clean : sum.planted) += one;
        sum.coverage = std::min(sum.coverage, report.coverage());
        if (one.found == one.planted && one.right + one.natural == one.reported && one.signed_right == one.found)
            continue;
        fmt::print("  {} seed {}{}: found {} of {}, sign {}, right {} of {}, natural {}, coverage {:.0f} %\n",
                   kind.name, own, clean ? " (clean)" : "", one.found, one.planted, one.signed_right, one.right,
                   one.reported, one.natural, 100 * report.coverage());
    }
    return sum;
}

int score_kinds(int cases, std::uint64_t seed, const std::string& wanted) {
    KindScore all;
    for (const LogKind& kind : log_kinds()) {
        if (!kind.name.starts_with(wanted)) continue;
        const KindScore one = score_kind(kind, cases, seed);
        fmt::print("| {} | {:.3f} ({} of {}) | {:.3f} ({} of {}) | {} | {} in {} | {} | {:.0f} % |\n", kind.name,
                   one.planted.recall(), one.planted.found, one.planted.planted, one.planted.precision(),
                   one.planted.right, one.planted.reported - one.planted.natural, one.planted.signed_right,
                   one.clean.reported - one.clean.natural, one.clean.points, one.planted.natural + one.clean.natural,
                   100 * one.coverage);
        std::fflush(stdout);
        all.planted += one.planted;
        all.clean += one.clean;
    }
    print("all", all.planted, all.clean);
    return all.planted.recall() >= 0.97 && all.planted.precision() >= 0.97 && all.clean.reported == all.clean.natural
               ? 0
               : 1;
}

PlantedLog log_to_write(const std::string& shape, std::uint64_t seed, bool hard) {
    for (const LogKind& kind : log_kinds()) {
        if (kind.name == shape) return make_log_of_kind(kind, seed, hard);
    }
    const auto* found =
        std::find_if(std::begin(shapes), std::end(shapes), [&](Shape s) { return name_of(s) == shape; });
    if (found == std::end(shapes))
        throw std::invalid_argument("SHAPE is zigzag, one-way, loops, spiral or the name of a kind");
    return make_planted_log(random_recipe(seed, *found, false, hard));
}

int write(const std::string& shape, std::uint64_t seed, const std::string& prefix, bool hard) {
    const PlantedLog log = log_to_write(shape, seed, hard);
    io::AtomicFile program(prefix + ".nc");
    program.write(log.program);
    program.commit();
    const Log view = as_log(log);
    io::write_biip(prefix + ".biip", view.channels, view.records, view.period, "{}");
    for (std::size_t d = 0; d < log.truth.size(); ++d) {
        const Defect& defect = log.recipe.defects[d];
        fmt::print("{} {:+g}: passes {} to {} every {}, points", name_of(defect.kind), defect.amplitude,
                   defect.first_pass + 1, defect.last_pass + 1, defect.every);
        const std::vector<PointIndex>& truth = log.truth[d];
        for (std::size_t k = 0; k < truth.size(); ++k) {
            if (k == 0 || truth[k] != truth[k - 1] + 1) fmt::print(" {}", truth[k]);
            if (k + 1 == truth.size() || truth[k + 1] != truth[k] + 1) fmt::print("-{}", truth[k]);
        }
        fmt::print("\n");
    }
    return 0;
}

int run(const std::vector<std::string>& words) {
    const auto count = [&](std::size_t k, int otherwise) { return words.size() > k ? std::stoi(words[k]) : otherwise; };
    if (!words.empty() && words[0] == "score")
        return score_shapes(count(1, 20), static_cast<std::uint64_t>(count(2, 1)),
                            !words.empty() && words.back() == "hard");
    if (!words.empty() && words[0] == "kinds")
        return score_kinds(count(1, 4), static_cast<std::uint64_t>(count(2, 1)), words.size() > 3 ? words[3] : "");
    if (!words.empty() && words[0] == "curve")
        return print_curve(count(1, 16), static_cast<std::uint64_t>(count(2, 1)));
    const bool hard = !words.empty() && words.back() == "hard";
    if (words.size() >= 4 && words[0] == "write")
        return write(words[1], static_cast<std::uint64_t>(count(2, 1)), words[3], hard);
    std::fputs(
        "usage: clsurf_planted score [CASES [SEED [hard]]] | curve [CASES [SEED]] | kinds [CASES [SEED [NAME]]] | write SHAPE SEED PREFIX [hard]\n",
        stderr);
    return 2;
}

}  // namespace
}  // namespace clsurf::planted

int main(int argc, char** argv) {
    try {
        return clsurf::planted::run({argv + 1, argv + argc});
    } catch (const std::exception& error) {
        fmt::print(stderr, "clsurf_planted: {}\n", error.what());
        return 1;
    }
}
