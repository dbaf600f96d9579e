// A log judged in shards: the verdict is the same, and each shard reads only its own part.

#include "pipeline/shards.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <limits>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

#include "core/column_file.h"
#include "core/error.h"
#include "io/formats/biip.h"
#include "io/formats/shard_file.h"
#include "io/formats/survey_file.h"
#include "io/readers/part_file.h"
#include "pipeline/simulated_log.h"
#include "repair/parts.h"
#include "support/temporary_folder.h"

namespace clsurf::shards_test {
namespace {

/// Three hundred passes, some with sections of short blocks, and a machine that is slow on these.
class Shards : public testing::Test {
public:
    static const io::SurveyOrigin origin;

protected:
    static void SetUpTestSuite() {
        folder = new test::TemporaryFolder();
        std::tie(program, log) = write_run("part.nc", "run.biip", 300);
        kept = *folder / "run.survey";
        io::write_survey(kept, make_survey(whole()), origin);
    }
    static void TearDownTestSuite() { delete folder; }

    /// Writes a program with this number of passes, and the log of its run.
    static std::pair<std::string, std::string> write_run(const char* program_name, const char* log_name, int passes) {
        const std::string text = wavy_zigzag(
            passes, 24, [](int pass, double x) { return pass % 40 == 3 && x > 6 && x < 8 ? 0.02 : 0.31; }, 0.8);
        const std::string program_file = folder->write(program_name, text), log_file = *folder / log_name;
        Machine machine;
        machine.controller.block_time = 0.002;
        const Log run = simulate_to_log(read_text(text), machine).log;
        io::write_biip(log_file, run.channels, run.records, run.period, run.metadata);
        return {program_file, log_file};
    }

    struct Surveyed {
        Survey survey;
        Part part;
        ClSurface surface;
        PartSignals read;
        explicit Surveyed(const std::string& log_file)
            : survey(io::read_survey(kept, origin)),
              part(io::read_surveyed_part({program, log_file, {}, {}, true}, {}, survey)),
              surface(surveyed_surface(part, survey)),
              read(surveyed_signals(part, surface, survey)) {
            part.tool = parse_tool("ball:6");
        }
        [[nodiscard]] ShardFindings judge(const ShardNumber& shard) const {
            return judge_shard(part, surface, read, survey, points_of_shard(surface.passes, survey.points, shard));
        }
    };

    static Part whole() {
        Part part = io::read_part(program, log);
        part.tool = parse_tool("ball:6");
        return part;
    }

    static test::TemporaryFolder* folder;
    static std::string program, log, kept;  ///< files; the last one is the survey
};
test::TemporaryFolder* Shards::folder = nullptr;
std::string Shards::program, Shards::log, Shards::kept;
const io::SurveyOrigin Shards::origin{"log", "program", ""};

void expect_same(const Quality& a, const Quality& b) {
    ASSERT_EQ(a.report.defects.size(), b.report.defects.size());
    EXPECT_GT(a.report.defects.size(), 3U);
    for (std::size_t k = 0; k < a.report.defects.size(); ++k) {
        const Defect &x = a.report.defects[k], &y = b.report.defects[k];
        EXPECT_EQ(x.point, y.point);
        EXPECT_EQ(x.score, y.score);
        EXPECT_EQ(x.depth, y.depth);
        EXPECT_EQ(x.area, y.area);
        EXPECT_EQ(x.cause, y.cause);
        EXPECT_EQ(x.place.contact->x(), y.place.contact->x());
        ASSERT_EQ(x.sections.size(), y.sections.size());
        for (std::size_t r = 0; r < x.sections.size(); ++r) {
            EXPECT_EQ(x.sections[r].points, y.sections[r].points);
            EXPECT_EQ(x.sections[r].pass, y.sections[r].pass);
            EXPECT_EQ(x.sections[r].first_line, y.sections[r].first_line);
        }
        EXPECT_EQ(a.as_machined->marks[k].note, b.as_machined->marks[k].note);
    }
    EXPECT_EQ(a.report.expected.size(), b.report.expected.size());
    EXPECT_EQ(a.report.compared, b.report.compared);
    EXPECT_EQ(a.report.thresholds.of, b.report.thresholds.of);
    EXPECT_EQ(a.scallop, b.scallop);
    EXPECT_EQ(a.as_machined->roughness.ra, b.as_machined->roughness.ra);
    EXPECT_EQ(a.as_machined->roughness.sz, b.as_machined->roughness.sz);
}

TEST_F(Shards, TogetherTheyGiveTheVerdictOnTheWholeLog) {
    const Part part = whole();
    const Quality at_once = judge(part, stitch(part));
    for (const int count : {1, 7}) {
        Surveyed log_in_parts(log);
        std::vector<ShardFindings> found;
        for (int number = count; number >= 1; --number) {
            // Each from the beginning, as in separate processes.
            found.push_back(Surveyed(log).judge({number, count}));
        }
        QualityRules rules = rules_of_shards(found, log_in_parts.survey);
        // The same if data are forgotten whenever possible, and derived again.
        const bool forgets = count > 1;
        if (forgets)
            rules.found->forget = forget_when_many(log_in_parts.surface.positions, log_in_parts.read.signals, 0);
        expect_same(at_once, judge(log_in_parts.part, log_in_parts.surface, log_in_parts.read, std::nullopt, rules));
        EXPECT_EQ(log_in_parts.read.signals.motion->filled() > 2 * part.path.count, forgets);
    }
}

TEST_F(Shards, HaveEveryPointOnce) {
    const Survey survey = io::read_survey(kept, origin);
    PointIndex next = 0;
    for (int number = 1; number <= 9; ++number) {
        const PointRange points = points_of_shard(survey.passes, survey.points, {number, 9});
        EXPECT_EQ(points.first, next);
        EXPECT_NEAR(static_cast<double>(points.size()), static_cast<double>(survey.points) / 9, 1000);
        EXPECT_TRUE(number == 1 || std::any_of(survey.passes.begin(), survey.passes.end(),
                                               [&](const Pass& p) { return p.first == points.first; }));
        next = points.last + 1;
    }
    EXPECT_EQ(next, survey.points);
    // More shards than passes: some are empty, and nothing is lost.
    next = 0;
    for (int number = 1; number <= 5000; ++number) {
        const PointRange points = points_of_shard(survey.passes, survey.points, {number, 5000});
        EXPECT_EQ(points.first, next);
        next = points.last + 1;
    }
    EXPECT_EQ(next, survey.points);
}

TEST_F(Shards, AShardThatIsMissingOrThereTwiceIsAnError) {
    const Surveyed one(log);
    const ShardFindings first = one.judge({1, 3}), second = one.judge({2, 3}), third = one.judge({3, 3});
    EXPECT_NO_THROW((void)rules_of_shards({third, first, second}, one.survey));
    EXPECT_THROW((void)rules_of_shards({first, third}, one.survey), UsageError);
    EXPECT_THROW((void)rules_of_shards({first, second}, one.survey), UsageError);
    EXPECT_THROW((void)rules_of_shards({second, third}, one.survey), UsageError);
    EXPECT_THROW((void)rules_of_shards({first, second, second, third}, one.survey), UsageError);
}

/// Bytes of a file that are resident through a mapping of this process.
std::size_t resident_bytes(const std::string& file) {
    std::ifstream maps("/proc/self/smaps");
    std::string line;
    bool mine = false;
    std::size_t kilobytes = 0;
    while (std::getline(maps, line)) {
        if (line.find('-') != std::string::npos && line.find(' ') > line.find('-') &&
            line.find(':') != std::string::npos && line.find("kB") == std::string::npos)
            mine = line.ends_with(file);
        if (mine && line.starts_with("Rss:")) kilobytes += std::stoul(line.substr(4));
    }
    return 1024 * kilobytes;
}

TEST_F(Shards, AShardReadsItsOwnPartOfTheLogAndThePassesBesideIt) {
    const std::size_t bytes = io::map_file(log).bytes.size();
    for (const int number : {1, 10, 20}) {
        const Surveyed fresh(log);
        const ShardFindings found = fresh.judge({number, 20});
        EXPECT_GT(found.compared.compared, 0);
        // A twentieth, plus in whole blocks on either side the passes with which it is compared, and those next to them.
        EXPECT_LE(fresh.surface.positions.fill->filled(), fresh.survey.points / 20 + 8 * block_points);
        const std::size_t touched = resident_bytes(log);
        EXPECT_GT(touched, bytes / 40);
        EXPECT_LT(touched, bytes / 2) << "of " << bytes;
    }
}

TEST_F(Shards, WhatLiesElsewhereInTheLogDoesNotMatter) {
    const Surveyed good(log);
    const PointRange points = points_of_shard(good.survey.passes, good.survey.points, {10, 20});
    // Every record more than four blocks away is overwritten.
    std::string bytes;
    {
        const io::Source source = io::map_file(log);
        bytes = source.text();
        const ChannelView& x = good.part.path.axes[0];
        const std::size_t records_at = bytes.size() - x.stride * static_cast<std::size_t>(good.survey.points);
        for (PointIndex i = 0; i < good.survey.points; ++i) {
            if (i > points.first - 4 * block_points && i < points.last + 4 * block_points) continue;
            std::memset(bytes.data() + records_at + static_cast<std::size_t>(i) * x.stride, 0x5a, x.stride);
        }
    }
    const Surveyed damaged(folder->write("damaged.biip", bytes));
    const ShardFindings a = good.judge({10, 20}), b = damaged.judge({10, 20});
    EXPECT_FALSE(a.starts.empty() && a.compared.compared == 0);
    EXPECT_EQ(a.compared.compared, b.compared.compared);
    EXPECT_EQ(a.compared.away_from_ends, b.compared.away_from_ends);
    EXPECT_EQ(a.starts, b.starts);
    EXPECT_EQ(a.scallops, b.scallops);
}

TEST_F(Shards, ASurveyComesBackFromItsFile) {
    const Survey survey = make_survey(whole());
    const Survey again = io::read_survey(kept, origin);
    EXPECT_EQ(again.points, survey.points);
    EXPECT_EQ(again.offset, survey.offset);
    EXPECT_EQ(again.turn, survey.turn);
    EXPECT_EQ(again.origin, survey.origin);
    EXPECT_EQ(again.step_over, survey.step_over);
    EXPECT_EQ(again.cut_length, survey.cut_length);
    EXPECT_EQ(again.not_finishing, survey.not_finishing);
    EXPECT_EQ(again.facts.usual_speed, survey.facts.usual_speed);
    EXPECT_EQ(again.facts.scatter, survey.facts.scatter);
    EXPECT_EQ(again.facts.unfit, survey.facts.unfit);
    EXPECT_EQ(again.thresholds.of, survey.thresholds.of);
    EXPECT_EQ(again.low_links, survey.low_links);
    EXPECT_EQ(again.pieces, survey.pieces);
    ASSERT_EQ(again.passes.size(), survey.passes.size());
    EXPECT_TRUE(std::equal(again.neighbours.left.begin(), again.neighbours.left.end(), survey.neighbours.left.begin()));
    EXPECT_TRUE(std::equal(again.arc_lengths.begin(), again.arc_lengths.end(), survey.arc_lengths.begin()));
    for (std::size_t k = 0; k < survey.boxes.size(); ++k) EXPECT_TRUE(again.boxes[k].isApprox(survey.boxes[k], 0));
    for (std::size_t k = 0; k < survey.surface_boxes.size(); ++k) {
        EXPECT_TRUE(again.surface_boxes[k].isApprox(survey.surface_boxes[k], 0));
        EXPECT_TRUE(survey.boxes[k].contains(survey.surface_boxes[k]));
    }
}

/// Changes a byte of a file that may be mapped, and changes it back.
class FlippedByte {
public:
    FlippedByte(std::string file, std::size_t at) : file_(std::move(file)), at_(at) { flip(); }
    FlippedByte(const FlippedByte&) = delete;
    FlippedByte& operator=(const FlippedByte&) = delete;
    ~FlippedByte() { flip(); }

private:
    void flip() {
        std::fstream stream(file_, std::ios::in | std::ios::out | std::ios::binary);
        stream.seekg(static_cast<std::streamoff>(at_));
        const int byte = stream.get() ^ (1 << at_ % 8);
        stream.seekp(static_cast<std::streamoff>(at_));
        stream.put(static_cast<char>(byte));
    }

    std::string file_;
    std::size_t at_;
};

/// Reads a survey with all its values per point.
void read_all_of(const std::string& file) {
    const Survey survey = io::read_survey(file, Shards::origin);
    for (PointIndex first = 0; first < survey.points; first += block_points) {
        const PointIndex last = std::min(survey.points, first + block_points);
        if (survey.check_neighbours) survey.check_neighbours(first, last);
        if (survey.check_lines) survey.check_lines(first, last);
    }
}

TEST_F(Shards, EveryDamagedByteOfASurveyIsFound) {
    // A small log, because the file is read once per damage.
    const auto [small_program, small_log] = write_run("small.nc", "small.biip", 80);
    io::PartFiles files{small_program, small_log, {}, {}, true};
    PartRules by_geometry;
    by_geometry.use_line_channel = false;
    Part at_once = io::read_part(small_program, small_log);
    at_once.tool = parse_tool("ball:6");
    ASSERT_GT(at_once.path.count, block_points);
    for (const Part& part : {at_once, io::read_part(files, by_geometry)}) {
        const std::string file = *folder / "flipped.survey";
        io::write_survey(file, make_survey(part), origin);
        EXPECT_NO_THROW(read_all_of(file));
        const std::size_t size = io::map_file(file).bytes.size();
        int found = 0, flipped = 0;
        for (std::size_t at = 0; at < size; at += at < 700 || at + 200 > size ? 1 : at < 5000 ? 11 : 1997) {
            const FlippedByte damage(file, at);
            ++flipped;
            try {
                read_all_of(file);
                ADD_FAILURE() << "byte " << at << " of " << size;
            } catch (const InputError& error) {
                EXPECT_NE(std::string(error.what()).find("flipped.survey"), std::string::npos) << error.what();
                ++found;
            }
        }
        EXPECT_EQ(found, flipped);
        EXPECT_NO_THROW(read_all_of(file));
    }
}

TEST_F(Shards, AShardThatReadsADamagedBlockSaysSo) {
    const Surveyed good(log);
    // The neighbours of a point in the middle of the second of three shards, at their place in the file.
    const PointRange points = points_of_shard(good.survey.passes, good.survey.points, {2, 3});
    const io::Source source = io::map_file(kept);
    const auto* const at =
        reinterpret_cast<const std::byte*>(good.survey.neighbours.left.data() + (points.first + points.last) / 2);
    const std::string_view block(reinterpret_cast<const char*>(at), 400);
    const std::size_t place = source.text().find(block);
    ASSERT_NE(place, std::string_view::npos);
    const FlippedByte damage(kept, place);
    EXPECT_THROW((void)Surveyed(log).judge({2, 3}), InputError);
}

TEST_F(Shards, NeighboursOutsideTheLogAreFound) {
    Survey survey = make_survey(whole());
    survey.neighbours.left[5] = static_cast<std::int32_t>(survey.points);
    const std::string file = *folder / "outside.survey";
    io::write_survey(file, survey, origin);
    EXPECT_THROW(read_all_of(file), InputError);
    survey.neighbours.left[5] = -6;
    io::write_survey(file, survey, origin);
    EXPECT_THROW(read_all_of(file), InputError);
    survey.neighbours.left[5] = -5;
    io::write_survey(file, survey, origin);
    EXPECT_NO_THROW(read_all_of(file));
}

TEST_F(Shards, EveryDamagedByteOfFindingsIsFound) {
    const std::string text = io::shard_json(Surveyed(log).judge({2, 3}), {2, 3}, origin, "--tool ball:6");
    const std::string file = folder->write("shard.json", text);
    EXPECT_NO_THROW((void)io::read_shard(file, origin, "--tool ball:6"));
    for (std::size_t at = 0; at < text.size(); at += at < 500 || at + 200 > text.size() ? 1 : 499) {
        const FlippedByte damage(file, at);
        EXPECT_THROW((void)io::read_shard(file, origin, "--tool ball:6"), InputError) << at;
    }
    for (const std::size_t cut : {std::size_t{0}, text.size() / 2, text.size() - 1})
        EXPECT_THROW((void)io::read_shard(folder->write("cut.json", text.substr(0, cut)), origin, "--tool ball:6"),
                     InputError);
}

void expect_within_the_bound(double merged, double whole) {
    EXPECT_GT(whole, 0);
    EXPECT_NEAR(merged, whole, whole * Distribution::quantile_error);
}

TEST_F(Shards, TheMotionOfAllPointsIsThatOfTheWholeLog) {
    const Part part = whole();
    const MotionQuality at_once = *judge(part, stitch(part), std::nullopt, {}, {}, true).motion;
    for (const int count : {1, 4, 23}) {
        const Surveyed surveyed(log);
        MotionSizes sizes;
        for (int number = 1; number <= count; ++number) {
            const std::string file = folder->write(
                "motion.json", io::shard_json(surveyed.judge({number, count}), {number, count}, origin, ""));
            sizes.add(io::read_shard(file, origin, "").motion);
        }
        const MotionQuality merged = motion_quality(sizes, surveyed.surface, part.log.period);
        EXPECT_EQ(merged.duration, at_once.duration);
        EXPECT_EQ(merged.mismatch_rms, at_once.mismatch_rms);
        EXPECT_EQ(merged.jerk_rms, at_once.jerk_rms);
        expect_within_the_bound(merged.mismatch, at_once.mismatch);
        expect_within_the_bound(merged.jerk, at_once.jerk);
    }
}

TEST_F(Shards, ASurveyWhoseColumnsAreInFilesIsTheSame) {
    keep_columns_in(*folder / "", 1000);
    const Survey survey = make_survey(whole());
    const std::string file = *folder / "scratch.survey";
    io::write_survey(file, survey, origin);
    keep_columns_in("");
    EXPECT_EQ(io::map_file(kept).text(), io::map_file(file).text());
}

TEST_F(Shards, ASurveyOfSomethingElseIsAnError) {
    EXPECT_THROW((void)io::read_survey(kept, {"another", "program", ""}), InputError);
    EXPECT_THROW((void)io::read_survey(kept, {"log", "another", ""}), InputError);
    EXPECT_THROW((void)io::read_survey(kept, {"log", "program", "--force"}), InputError);
    std::string bytes(io::map_file(kept).text());
    for (const std::size_t cut :
         {std::size_t{0}, std::size_t{7}, std::size_t{100}, std::size_t{5000}, bytes.size() / 2}) {
        const std::string file = folder->write("cut.survey", bytes.substr(0, cut));
        EXPECT_THROW((void)io::read_survey(file, origin), InputError) << cut;
    }
    bytes[30] ^= 1;
    EXPECT_THROW((void)io::read_survey(folder->write("bad.survey", bytes), origin), InputError);
    EXPECT_THROW((void)io::read_survey(log, origin), InputError);
}

}  // namespace
}  // namespace clsurf::shards_test
