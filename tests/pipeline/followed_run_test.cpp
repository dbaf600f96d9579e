// Runs that are still being recorded: each defect is reported once, with its pass, before the log is complete; at the end the
// findings are those of the complete log.

#include "pipeline/followed_run.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <fstream>
#include <set>
#include <thread>

#include "io/files/compressed.h"
#include "io/formats/growing_log.h"
#include "io/readers/part_file.h"
#include "support/temporary_folder.h"

namespace clsurf::followed_run_test {
namespace {

std::string log_of(const std::string& name) { return std::string(SAMPLE_LOGS) + "/" + name + ".biip"; }
std::string program_file(const std::string& name) { return std::string(SAMPLE_DATA) + "/programs/" + name + ".nc"; }

Program programmed(const std::string& name) {
    io::ProgramOptions as_programmed;
    as_programmed.coordinates.reset();
    return io::read_program(io::open_source(program_file(name)), as_programmed);
}

QualityReport complete_report(const std::string& name) {
    const Part part = io::read_part(program_file(name), log_of(name));
    return judge(part, stitch(part)).report;
}

/// Reads a growing log, `most` records at a time, and judges it each time.
class Listener {
public:
    Listener(const std::string& name, const std::string& path, FollowRules rules = {})
        : rules_(std::move(rules)), log_(path, options_), program_(programmed(name)) {}

    /// False: no new records.
    bool listen(PointIndex most) {
        const bool came = log_.read(most) > 0;
        if (!came || log_.end() < 1000) return came;
        Log window = log_.window();
        longest_window_ = std::max(longest_window_, window.records);
        if (!run_) run_.emplace(std::move(program_), window, rules_);
        for (ProvisionalDefect& defect : run_->judge(std::move(window), log_.first()))
            found_.push_back(std::move(defect));
        log_.forget(run_->kept_from());
        return true;
    }
    [[nodiscard]] bool ended() const { return log_.ended(); }
    [[nodiscard]] const FollowedRun& run() const { return *run_; }
    [[nodiscard]] const std::vector<ProvisionalDefect>& found() const { return found_; }
    [[nodiscard]] PointIndex longest_window() const { return longest_window_; }

private:
    io::LogOptions options_;
    FollowRules rules_;
    io::GrowingLog log_;
    Program program_;
    std::optional<FollowedRun> run_;
    std::vector<ProvisionalDefect> found_;
    PointIndex longest_window_ = 0;
};

bool has_pass(const ProvisionalDefect& found, std::int64_t pass) {
    for (const DefectSection& section : found.defect.sections) {
        if (section.pass == pass) return true;
    }
    return false;
}

// The planted defects are in data/logs/README.md. Passes 12 and 13 are too deep, 31 and 32 too high, 31 is also slower.
TEST(FollowedRun, FindsEachPlantedDefectOnceAndBeforeTheLogIsComplete) {
    Listener listener("planted_zigzag", log_of("planted_zigzag"));
    while (listener.listen(250)) {}
    ASSERT_EQ(listener.found().size(), 3);
    const ProvisionalDefect& deep = listener.found()[0];
    EXPECT_TRUE(has_pass(deep, 12) && has_pass(deep, 13));
    EXPECT_NEAR(deep.defect.depth, 0.0094, 0.0003);
    EXPECT_TRUE(deep.defect.pit);
    const ProvisionalDefect& slow = listener.found()[1];
    EXPECT_TRUE(has_pass(slow, 31));
    EXPECT_NEAR(slow.defect.speed_mismatch, -0.24, 0.01);
    EXPECT_TRUE(has_pass(listener.found()[2], 31));
    for (std::size_t k = 0; k < 3; ++k) {
        const ProvisionalDefect& found = listener.found()[k];
        EXPECT_EQ(found.number, static_cast<std::int64_t>(k) + 1);
        EXPECT_LE(found.needed, found.recorded);
        EXPECT_LT(found.recorded, 30'774) << "the log has more records";
        // Each is reported with the piece that contains the last point needed for it.
        EXPECT_LE(found.recorded - found.needed, 500);
    }
    const QualityReport complete = complete_report("planted_zigzag");
    const ResolvedFindings resolved = listener.run().resolve(complete);
    EXPECT_EQ(resolved.withdrawn(), 0);
    EXPECT_TRUE(resolved.late.empty());
    EXPECT_EQ(resolved.defects[1], std::vector<std::size_t>{0}) << "the slow section is the first of the report";
}

// Loops 7 and 8 are too deep, 14 and 16 are slower, and so are 15 and 17.
TEST(FollowedRun, FindsDefectsOfLoops) {
    Listener listener("planted_loops", log_of("planted_loops"));
    while (listener.listen(1000)) {}
    ASSERT_EQ(listener.found().size(), 3);
    EXPECT_TRUE(has_pass(listener.found()[0], 7) && has_pass(listener.found()[0], 8));
    EXPECT_TRUE(has_pass(listener.found()[1], 14));
    EXPECT_TRUE(has_pass(listener.found()[2], 15));
    const ResolvedFindings resolved = listener.run().resolve(complete_report("planted_loops"));
    EXPECT_EQ(resolved.withdrawn(), 0);
    EXPECT_TRUE(resolved.late.empty());
}

TEST(FollowedRun, KeepsAWindowOfPasses) {
    FollowRules rules;
    rules.passes = 14;
    Listener listener("planted_zigzag", log_of("planted_zigzag"), rules);
    while (listener.listen(250)) {}
    // A pass has some 770 records: 14 complete ones, the incomplete one, and the piece.
    EXPECT_LT(listener.longest_window(), 16 * 800);
    EXPECT_EQ(listener.found().size(), 3);
    EXPECT_EQ(listener.run().resolve(complete_report("planted_zigzag")).withdrawn(), 0);
}

TEST(FollowedRun, FindsWhatAWriterWritesMeanwhile) {
    const test::TemporaryFolder folder;
    std::string bytes = test::read_file(log_of("planted_zigzag"));
    std::memset(bytes.data() + 24, 0, 8);  // not closed
    const std::string path = folder.write("run.biip", "");
    std::atomic<bool> written = false;
    std::thread writer([&] {
        std::ofstream file(path, std::ios::binary);
        for (std::size_t at = 0; at < bytes.size(); at += 7001)
            file.write(bytes.data() + at, static_cast<std::streamsize>(std::min<std::size_t>(7001, bytes.size() - at)))
                .flush();
        written = true;
    });
    Listener listener("planted_zigzag", path);
    while (true) {
        const bool all = written;
        if (!listener.listen(500) && all) break;
    }
    writer.join();
    EXPECT_EQ(listener.found().size(), 3);
    const ResolvedFindings resolved = listener.run().resolve(complete_report("planted_zigzag"));
    EXPECT_EQ(resolved.withdrawn(), 0);
    EXPECT_TRUE(resolved.late.empty());
}

TEST(FollowedRun, ASystematicLagHidesNoOtherFinding) {
    Listener listener("bottle_uneven", log_of("bottle_uneven"));
    while (listener.listen(500)) {}
    int systematic = 0;
    std::set<std::int64_t> crowded;  // passes whose points are 0.02 mm apart (README.md): 7, 14, 21, 28, 35
    for (const ProvisionalDefect& found : listener.found()) {
        systematic += found.defect.systematic ? 1 : 0;
        if (found.defect.cause == Cause::point_spacing && found.defect.speed_mismatch < -0.5)
            crowded.insert(found.defect.sections.front().pass);
    }
    EXPECT_EQ(systematic, 1);
    EXPECT_EQ(crowded, (std::set<std::int64_t>{7, 14, 21, 28, 35}));
}

TEST(FollowedRun, WhatTheCompleteLogDoesNotShowIsWithdrawn) {
    Listener listener("planted_zigzag", log_of("planted_zigzag"));
    while (listener.listen(2000)) {}
    const auto findings = static_cast<std::size_t>(listener.run().findings());
    QualityReport other;
    EXPECT_EQ(listener.run().resolve(other).withdrawn(), findings);
    other.defects.emplace_back();
    other.defects[0].sections.push_back({1, {10, 20}, 5, 5});  // where nothing was found
    const ResolvedFindings resolved = listener.run().resolve(other);
    EXPECT_EQ(resolved.withdrawn(), findings);
    EXPECT_EQ(resolved.late, std::vector<std::size_t>{0});
}

TEST(FollowedRun, ALogOfAnotherProgramHasNoFindings) {
    Listener listener("planted_loops", log_of("planted_zigzag"));
    while (listener.listen(3000)) {}
    EXPECT_TRUE(listener.found().empty());
    EXPECT_FALSE(listener.run().foreign().empty());
}

}  // namespace
}  // namespace clsurf::followed_run_test
