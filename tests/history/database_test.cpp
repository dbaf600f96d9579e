// The database of a history: written runs are read back, also by other programs; older and newer versions; several writers;
// writers that are killed.

#include "io/history/history_database.h"

#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

#include <fmt/format.h>

#include "core/error.h"
#include "io/files/utc.h"

namespace clsurf::io::database_test {
namespace {

namespace fs = std::filesystem;

class HistoryFile {
public:
    explicit HistoryFile(const std::string& name)
        : folder_(fs::temp_directory_path() / fmt::format("clsurf_{}_{}", name, ::getpid())) {
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    HistoryFile(const HistoryFile&) = delete;
    HistoryFile& operator=(const HistoryFile&) = delete;
    ~HistoryFile() { fs::remove_all(folder_); }
    [[nodiscard]] std::string path() const { return (folder_ / "shop.db").string(); }

private:
    fs::path folder_;
};

/// All its numbers depend on `number`, so that a row mixed from two runs is detected.
RunRecord numbered_run(int number) {
    RunRecord run;
    run.time = "2026-11-24T07:30:00Z";
    run.program = fmt::format("part{}.nc", number);
    run.log = "run.biip";
    run.program_sha256 = "p";
    run.log_sha256 = fmt::format("log {}", number);
    run.judged = true;
    run.duration_s = number;
    run.worst_score = 2.0 * number;
    run.parameters = {{"number", fmt::format("{}", number)}, {"tool", "D6R3"}};
    run.defects = 1 + number % 7;
    for (std::int64_t i = 0; i < run.defects; ++i) {
        RecordedDefect defect;
        defect.cause = "feed_drop";
        defect.quantity = "speed";
        defect.score = number + 0.25 * static_cast<double>(i);
        for (std::int64_t k = 0; k <= i; ++k) defect.sections.push_back({number + k, 10, 20});
        run.found.push_back(defect);
    }
    return run;
}

void expect_whole(const RunRecord& run) {
    ASSERT_NE(run.parameter("number"), nullptr) << "run " << run.id;
    const int number = std::stoi(*run.parameter("number"));
    const RunRecord expected = numbered_run(number);
    EXPECT_EQ(run.program, expected.program);
    EXPECT_EQ(run.duration_s, expected.duration_s);
    EXPECT_EQ(run.parameters, expected.parameters);
    ASSERT_EQ(run.found.size(), expected.found.size());
    for (std::size_t i = 0; i < run.found.size(); ++i) {
        EXPECT_EQ(run.found[i].score, expected.found[i].score);
        EXPECT_EQ(run.found[i].sections, expected.found[i].sections);
    }
}

/// SQL through SQLite alone.
void execute(const std::string& path, const std::string& sql) {
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
    char* error = nullptr;
    EXPECT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, &error), SQLITE_OK)
        << (error == nullptr ? "" : error);
    sqlite3_free(error);
    sqlite3_close(database);
}

std::string answer(const std::string& path, const std::string& sql) {
    sqlite3* database = nullptr;
    EXPECT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
    std::string text;
    sqlite3_exec(
        database, sql.c_str(),
        [](void* out, int count, char** values, char**) {
            for (int k = 0; k < count; ++k)
                *static_cast<std::string*>(out) += values[k] == nullptr ? "NULL " : std::string(values[k]) + " ";
            return 0;
        },
        &text, nullptr);
    sqlite3_close(database);
    return text;
}

void expect_every_row_whole(const std::string& path) {
    EXPECT_EQ(answer(path, "PRAGMA integrity_check"), "ok ");
    EXPECT_EQ(answer(path, "PRAGMA foreign_key_check"), "");
    EXPECT_EQ(answer(path, "SELECT count(*) FROM runs WHERE defects <> (SELECT count(*) FROM defects WHERE run = id)"),
              "0 ");
    const HistoryDatabase history(path);
    std::vector<RunRecord> runs = history.runs();
    history.read_defects(runs);
    for (const RunRecord& run : runs) expect_whole(run);
}

TEST(History, GivesBackWhatWasAdded) {
    const HistoryFile file("round");
    RunRecord run = numbered_run(3);
    run.tool = "ball:6";
    run.machine = "mill \"3\"; DROP TABLE runs";
    run.speed_percent = {0.5, 12.5};
    run.not_judged_reasons = "Ärger.";
    run.found[0].tip = Vec3(1, 2, 3);
    run.found[0].position = Vec3(4, 5, 6);
    run.found[0].pit = true;
    EXPECT_EQ(HistoryWriter(file.path()).add(run).id, 1);
    const HistoryDatabase history(file.path());
    std::vector<RunRecord> runs = history.runs();
    ASSERT_EQ(runs.size(), 1U);
    history.read_defects(runs);
    const RunRecord& read = runs[0];
    expect_whole(read);
    EXPECT_EQ(read.machine, run.machine);
    EXPECT_EQ(read.tool, run.tool);
    EXPECT_EQ(read.speed_percent.p99, 12.5);
    EXPECT_TRUE(std::isnan(read.lag_um.median));
    EXPECT_EQ(read.not_judged_reasons, "Ärger.");
    EXPECT_EQ(read.found[0].tip, Vec3(1, 2, 3));
    EXPECT_EQ(read.found[0].position, Vec3(4, 5, 6));
    EXPECT_TRUE(read.found[0].pit);
    EXPECT_FALSE(read.found[1].pit);
    EXPECT_EQ(answer(file.path(), "PRAGMA journal_mode"), "wal ");
    EXPECT_EQ(answer(file.path(), "SELECT machine, lag_p50_um FROM runs"), run.machine + " NULL ");
}

TEST(History, TheSameRunIsReplacedAndKeepsItsNumber) {
    const HistoryFile file("same");
    HistoryWriter history(file.path());
    EXPECT_FALSE(history.add(numbered_run(3)).replaced);
    EXPECT_EQ(history.add(numbered_run(4)).id, 2);
    RunRecord again = numbered_run(3);
    again.found.resize(1);
    again.worst_score = 99;
    const AddedRun added = history.add(again);
    EXPECT_TRUE(added.replaced);
    EXPECT_EQ(added.id, 1);
    EXPECT_EQ(answer(file.path(), "SELECT count(*), max(worst_score) FROM runs"), "2 99.0 ");
    EXPECT_EQ(answer(file.path(), "SELECT count(*) FROM defects WHERE run = 1"), "1 ") << "old defects are gone";
}

TEST(History, FiltersRuns) {
    const HistoryFile file("filter");
    HistoryWriter history(file.path());
    for (int k = 1; k <= 5; ++k) {
        RunRecord run = numbered_run(k);
        run.time = fmt::format("2026-11-2{}T00:00:00Z", 6 - k);  // the last one first
        run.program = k < 3 ? "parts/a.nc" : "b.nc";
        history.add(run);
    }
    const auto ids = [&](const RunFilter& filter) {
        std::string text;
        for (const RunRecord& run : history.runs(filter)) text += fmt::format("{} ", run.id);
        return text;
    };
    EXPECT_EQ(ids({}), "5 4 3 2 1 ");
    EXPECT_EQ(ids({.program = "a.nc"}), "2 1 ");
    EXPECT_EQ(ids({.program = "parts/a.nc"}), "2 1 ");
    EXPECT_EQ(ids({.program = "%"}), "");
    EXPECT_EQ(ids({.parameters = {{"number", "4"}}}), "4 ");
    EXPECT_EQ(ids({.since = "2026-11-24T00:00:00Z"}), "2 1 ");
    EXPECT_EQ(ids({.last = 2}), "2 1 ");
    EXPECT_EQ(ids({.id = 3}), "3 ");
}

TEST(History, ReadsTheDefectsThatMatch) {
    const HistoryFile file("defects");
    HistoryWriter history(file.path());
    history.add(numbered_run(6));  // seven defects on the passes 6, 6 to 7, …, 6 to 12
    DefectFilter filter;
    filter.pass = 11;
    std::vector<RunRecord> runs = history.runs();
    history.read_defects(runs, filter);
    EXPECT_EQ(runs[0].found.size(), 2U);
    EXPECT_EQ(runs[0].found[1].sections.size(), 7U) << "with all their sections";
}

TEST(History, KeepsTheRulesOfParameters) {
    const HistoryFile file("rules");
    HistoryWriter history(file.path());
    history.set_parameter_rules({{{"wear", ParameterKind::number, "mm", 0.0, 0.2, {}, true},
                                  {"tool", ParameterKind::text, "", {}, {}, {"b", "a"}, false}}});
    const ParameterRules rules = HistoryDatabase(file.path()).parameter_rules();
    ASSERT_EQ(rules.rules.size(), 2U);
    EXPECT_EQ(rules.rules[0].high, 0.2);
    EXPECT_EQ(rules.rules[0].unit, "mm");
    EXPECT_TRUE(rules.rules[0].required);
    EXPECT_EQ(rules.rules[1].values, (std::vector<std::string>{"b", "a"}));
    EXPECT_FALSE(rules.rules[1].low);
}

// ---- files that are not histories ----

template <typename Error>
std::string refusal(const std::string& path) {
    try {
        const HistoryDatabase history(path);
    } catch (const Error& error) { return error.what(); }
    return "none";
}

TEST(History, RefusesWhatIsNone) {
    const HistoryFile file("none");
    EXPECT_NE(refusal<InputError>(file.path()).find("cannot open"), std::string::npos);
    std::ofstream(file.path()) << std::string(5000, 'x');
    EXPECT_NE(refusal<InputError>(file.path()).find("is not a history of clsurf"), std::string::npos);
    EXPECT_THROW(HistoryWriter{file.path()}, InputError);
    EXPECT_EQ(fs::file_size(file.path()), 5000U) << "and leaves it as it is";
    fs::remove(file.path());
    execute(file.path(), "CREATE TABLE runs (id)");
    EXPECT_NE(refusal<InputError>(file.path()).find("of another program"), std::string::npos);
    EXPECT_THROW(HistoryWriter{file.path()}, InputError);
}

TEST(History, RefusesANewerVersion) {
    const HistoryFile file("newer");
    HistoryWriter(file.path()).add(numbered_run(1));
    execute(file.path(), "PRAGMA user_version = 1000");
    EXPECT_NE(refusal<InputError>(file.path()).find("is a history of version 1000"), std::string::npos);
    EXPECT_THROW(HistoryWriter{file.path()}, InputError);
    EXPECT_EQ(answer(file.path(), "PRAGMA user_version"), "1000 ");
}

TEST(History, ReadsVersion1AndBringsItUpToDateWhereItWrites) {
    const HistoryFile file("version_1");
    std::ifstream sql(std::string(TEST_SOURCES) + "/history/version_1.sql");
    execute(file.path(), {std::istreambuf_iterator<char>(sql), {}});
    {
        const HistoryDatabase history(file.path());
        std::vector<RunRecord> runs = history.runs();
        history.read_defects(runs);
        ASSERT_EQ(runs.size(), 2U);
        EXPECT_EQ(runs[0].machine, "mill 3");
        EXPECT_EQ(runs[0].ra_um, 0.31);
        EXPECT_EQ(runs[0].speed_percent.p99, 12.25);
        ASSERT_EQ(runs[0].found.size(), 1U);
        EXPECT_EQ(runs[0].found[0].sections, (std::vector<RecordedSection>{{7, 500, 512}}));
        EXPECT_EQ(runs[1].not_judged_reasons, "Too little was compared.");
        EXPECT_TRUE(runs[1].failure.empty());
        EXPECT_EQ(history.parameter_rules().rules[0].values, std::vector<std::string>{"D6R3"});
    }
    EXPECT_EQ(answer(file.path(), "PRAGMA user_version"), "1 ") << "readers leave it as it is";
    HistoryWriter(file.path()).add(numbered_run(1));
    EXPECT_EQ(answer(file.path(), "PRAGMA user_version"), "2 ");
    EXPECT_EQ(answer(file.path(), "SELECT count(*), sum(failure = '') FROM runs"), "3 3 ");
    EXPECT_EQ(answer(file.path(), "PRAGMA integrity_check"), "ok ");
}

RunRecord failed_run(int number) {
    RunRecord run = numbered_run(number);
    run.judged = false;
    run.failure = "killed";
    run.found.clear();
    run.defects = 0;
    return run;
}

/// Merges the runs of one database into another one.
std::size_t merged(const HistoryFile& from, const HistoryFile& into) {
    const std::vector<std::string> paths{from.path()};
    const std::vector<HistoryDatabase> opened(paths.begin(), paths.end());
    return HistoryWriter(into.path()).merge(opened);
}

TEST(History, MergesWhatIsNewAndWhatIsBetter) {
    const HistoryFile a("merge_a");
    const HistoryFile b("merge_b");
    HistoryWriter into(a.path());
    HistoryWriter from(b.path());
    for (int k = 1; k <= 4; ++k) from.add(numbered_run(k));
    into.add(numbered_run(1));  // after that of `from`: the later one counts
    into.add(failed_run(2));
    EXPECT_EQ(merged(b, a), 3U) << "2, which had failed, 3 and 4";
    EXPECT_EQ(merged(b, a), 0U);
    expect_every_row_whole(a.path());
    EXPECT_EQ(into.runs().size(), 4U);
    from.add(failed_run(2));
    EXPECT_EQ(merged(b, a), 0U) << "a failure replaces no verdict";
}

TEST(History, AMergedRunIsAsOldAsItWas) {
    const HistoryFile older("merge_older");
    const HistoryFile newer("merge_newer");
    const HistoryFile into("merge_into");
    RunRecord run = numbered_run(1);
    HistoryWriter(older.path()).add(run);
    execute(older.path(), "UPDATE runs SET recorded = '2026-11-01T00:00:00Z'");
    run.worst_score = 77;
    HistoryWriter(newer.path()).add(run);
    execute(newer.path(), "UPDATE runs SET recorded = '2026-11-02T00:00:00Z'");
    EXPECT_EQ(merged(older, into), 1U);
    EXPECT_EQ(answer(into.path(), "SELECT recorded FROM runs"), "2026-11-01T00:00:00Z ");
    EXPECT_EQ(merged(newer, into), 1U) << "judged later, though both before the merge";
    EXPECT_EQ(answer(into.path(), "SELECT recorded, worst_score FROM runs"), "2026-11-02T00:00:00Z 77.0 ");
    EXPECT_EQ(merged(older, into), 0U);
}

TEST(History, MergesRulesOfParametersOrRefusesOthers) {
    const HistoryFile plain("rules_plain");
    const HistoryFile ruled("rules_ruled");
    const HistoryFile other("rules_other");
    const HistoryFile into("rules_into");
    const ParameterRules rules{{{"number", ParameterKind::number, "", {}, {}, {}, true},
                                {"tool", ParameterKind::text, "", {}, {}, {"D6R3", "D8"}, false}}};
    HistoryWriter(plain.path()).add(numbered_run(1));
    HistoryWriter(ruled.path()).add(numbered_run(2));
    HistoryWriter(ruled.path()).set_parameter_rules(rules);
    merged(plain, into);
    merged(ruled, into);
    merged(ruled, into);
    EXPECT_EQ(first_difference(HistoryDatabase(into.path()).parameter_rules(), rules), "");
    ParameterRules changed = rules;
    changed.rules[1].values.pop_back();
    HistoryWriter(other.path()).add(numbered_run(3));
    HistoryWriter(other.path()).set_parameter_rules(changed);
    try {
        merged(other, into);
        ADD_FAILURE();
    } catch (const InputError& error) {
        EXPECT_EQ(error.diagnostic().text,
                  fmt::format("has another rule for the parameter 'tool' than {}", into.path()));
    }
    EXPECT_EQ(answer(into.path(), "SELECT count(*) FROM runs"), "2 ") << "nothing is taken";
    EXPECT_EQ(first_difference(rules, {{rules.rules[0]}}), "tool");
    EXPECT_EQ(first_difference({{rules.rules[1]}}, rules), "number");
}

TEST(History, AVerdictReplacesTheFailureOfItsRun) {
    const HistoryFile file("superseded");
    HistoryWriter history(file.path());
    RunRecord unread = failed_run(1);  // the log was not there: no hash, and its parameters are not known
    unread.log_sha256.clear();
    unread.parameters = {{"tool", "D6R3"}};
    RunRecord other_tool = failed_run(1);
    other_tool.parameters = {{"tool", "D8"}};
    history.add(unread);
    history.add(other_tool);
    history.add(failed_run(2));
    const AddedRun added = history.add(numbered_run(1));
    EXPECT_EQ(added.id, 1);
    EXPECT_FALSE(added.replaced) << "no verdict was there";
    EXPECT_EQ(answer(file.path(), "SELECT id, length(failure) > 0 FROM runs ORDER BY id"), "1 0 2 1 3 1 ");
    // Failures of another history are not merged if there is a verdict, and a verdict replaces those here.
    const HistoryFile failures("superseded_failures");
    HistoryWriter(failures.path()).add(unread);
    EXPECT_EQ(merged(failures, file), 0U);
    EXPECT_EQ(merged(file, failures), 3U);
    EXPECT_EQ(answer(failures.path(), "SELECT count(*), sum(length(failure) > 0) FROM runs"), "3 2 ");
}

TEST(History, AnEmptyFileHasNoRuns) {
    const HistoryFile file("empty");
    std::ofstream(file.path()).close();
    EXPECT_TRUE(HistoryDatabase(file.path()).runs().empty());
    EXPECT_EQ(fs::file_size(file.path()), 0U);
    HistoryWriter(file.path()).add(numbered_run(1));
    EXPECT_EQ(HistoryDatabase(file.path()).runs().size(), 1U);
}

TEST(History, ACutFileIsDamaged) {
    const HistoryFile file("cut");
    {
        HistoryWriter history(file.path());
        for (int k = 0; k < 200; ++k) history.add(numbered_run(k));
    }
    fs::resize_file(file.path(), fs::file_size(file.path()) / 2);
    EXPECT_THROW(
        {
            const HistoryDatabase history(file.path());
            std::vector<RunRecord> runs = history.runs();
            history.read_defects(runs);
        },
        InputError);
}

// ---- several writers, and killed ones ----

/// A child that adds runs beginning with `first` until it has `count` of them, or is killed.
pid_t start_writer(const std::string& path, int first, int count) {
    const pid_t child = ::fork();
    if (child != 0) return child;
    int code = 0;
    try {
        HistoryWriter history(path);
        for (int k = 0; k < count; ++k) history.add(numbered_run(first + k));
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        code = 1;
    }
    ::_exit(code);
}

TEST(History, TwoWritersAddAllTheirRuns) {
    const HistoryFile file("writers");
    const pid_t writers[] = {start_writer(file.path(), 0, 60), start_writer(file.path(), 1000, 60)};
    for (const pid_t writer : writers) {
        int status = 0;
        ::waitpid(writer, &status, 0);
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    }
    EXPECT_EQ(HistoryDatabase(file.path()).runs().size(), 120U);
    expect_every_row_whole(file.path());
}

/// How often a writer is killed: CLSURF_KILLS, 50 in the suite.
int kills() {
    const char* text = std::getenv("CLSURF_KILLS");
    return text != nullptr ? std::atoi(text) : 50;
}

TEST(History, AKilledWriterLeavesWholeRowsOnly) {
    std::minstd_rand random(26);
    std::uniform_int_distribution<int> wait(0, 40'000);  // [µs]: from before the tables exist to many rows
    std::int64_t rows = 0;
    int empty = 0;
    for (int round = 0; round < kills();) {
        const HistoryFile file("killed");
        // Ten kills per file: each writer continues with the file that the killed one left. Another writer runs at the same
        // time.
        for (int k = 0; k < 10 && round < kills(); ++k, ++round) {
            const pid_t victim = start_writer(file.path(), 100'000 * k, 1'000'000);
            const pid_t survivor = start_writer(file.path(), 50'000'000 + 100 * k, 3);
            ::usleep(static_cast<useconds_t>(wait(random)));
            ::kill(victim, SIGKILL);
            int status = 0;
            ::waitpid(victim, &status, 0);
            EXPECT_TRUE(WIFSIGNALED(status));
            ::waitpid(survivor, &status, 0);
            EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << "the other writer";
        }
        expect_every_row_whole(file.path());
        const std::vector<RunRecord> runs = HistoryDatabase(file.path()).runs();
        rows += static_cast<std::int64_t>(runs.size());
        empty += runs.empty() ? 1 : 0;
    }
    EXPECT_GT(rows, 0);
    fmt::print("{} kills, {} whole rows, {} files without a row\n", kills(), rows, empty);
}

TEST(Utc, ReadsZones) {
    EXPECT_EQ(parse_utc("2026-11-24", "--time"), "2026-11-24T00:00:00Z");
    EXPECT_EQ(parse_utc("2026-11-24T07:30", "--time"), "2026-11-24T07:30:00Z");
    EXPECT_EQ(parse_utc("2026-11-24 07:30:05Z", "--time"), "2026-11-24T07:30:05Z");
    EXPECT_EQ(parse_utc("2026-01-01T00:30:00+01:00", "--time"), "2025-12-31T23:30:00Z");
    EXPECT_EQ(parse_utc("2024-02-28T23:00:00-02:30", "--time"), "2024-02-29T01:30:00Z");
    for (const char* bad : {"", "today", "2026-13-01", "2026-02-30", "2026-11-24T25:00", "2026-11-24T07",
                            "2026-11-24T07:30:00+1", "24.11.2026", "2026-11-24x"})
        EXPECT_THROW(static_cast<void>(parse_utc(bad, "--time")), UsageError) << bad;
}

}  // namespace
}  // namespace clsurf::io::database_test
