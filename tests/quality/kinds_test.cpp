// The predictor on logs of kinds that it was not developed on (data/tools/kinds.h): a log with faults and a clean one of
// each. `clsurf_planted kinds` runs as many as one likes.
#include "kinds.h"

#include <gtest/gtest.h>

#include "planted_score.h"

namespace clsurf {
namespace {

planted::Score score_of(const planted::LogKind& kind, std::uint64_t seed, bool clean, double& coverage) {
    const planted::PlantedLog log = planted::make_log_of_kind(kind, seed, clean);
    const QualityReport report = planted::judge(log);
    coverage = report.coverage();
    return planted::score(log, report);
}

TEST(Kinds, FaultsAreFoundAndNothingElse) {
    planted::Score all;
    for (const planted::LogKind& kind : planted::log_kinds()) {
        double coverage = 0;
        const planted::Score one = score_of(kind, 1, false, coverage);
        EXPECT_GT(coverage, 0.4) << kind.name;
        EXPECT_GE(one.found + 1, one.planted) << kind.name;
        all += one;
    }
    EXPECT_GT(all.planted, 50);
    EXPECT_GE(all.recall(), 0.97);
    EXPECT_GE(all.precision(), 0.97);
    EXPECT_GE(all.signed_right, 0.97 * all.planted);
}

TEST(Kinds, CleanLogsAreClean) {
    for (const planted::LogKind& kind : planted::log_kinds()) {
        double coverage = 0;
        const planted::Score one = score_of(kind, 4, true, coverage);
        // Where loops round islands meet in a crease, passes differ by more than the plan of the nearest one tells.
        const int tolerated = kind.layout == planted::Layout::islands ? 6 : 0;
        EXPECT_LE(one.reported - one.natural, tolerated) << kind.name;
    }
}

}  // namespace
}  // namespace clsurf
