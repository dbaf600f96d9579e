#include "cli/options/vocabulary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "cli/command_line.h"
#include "cli/options/option_rows.h"
#include "field/field_table.h"
#include "io/formats/log_format.h"
#include "predictor/quality_fields.h"

namespace clsurf::cli::vocabulary_test {
namespace {

TEST(Vocabulary, ListsEveryRowOfTheTables) {
    const std::size_t others = 4 + 4;  // feed_share, cause, interval, scallop; four of the program
    const std::size_t limits = 3 * 7;  // speed, acceleration, jerk; of six axes and of the worst one
    EXPECT_EQ(words_of("FIELD").size(), field_table().size() + quality_field_table().size() + others + limits);
    EXPECT_EQ(words_of("FORMAT").size(), io::log_formats().size());
}

TEST(Vocabulary, TakesLowerCaseAlternativesAsWords) {
    EXPECT_EQ(words_of("iso|top|AZ,EL"), (std::vector<std::string>{"iso", "top"}));
    EXPECT_TRUE(words_of("FILE").empty());
    EXPECT_TRUE(words_of("N").empty());
    EXPECT_EQ(words_of("FIELD,\u2026"), words_of("FIELD"));
}

TEST(Vocabulary, KnowsWhenAllWordsAreListed) {
    EXPECT_TRUE(lists_all_words("auto|always|never"));
    EXPECT_FALSE(lists_all_words("iso|top|AZ,EL"));
    EXPECT_FALSE(lists_all_words("FILE"));
}

// The help promises these for every subcommand, including new ones.
TEST(Subcommands, AreDescribedInFull) {
    std::set<std::string_view> names;
    for (const Subcommand& subcommand : subcommands()) {
        SCOPED_TRACE(subcommand.name);
        EXPECT_TRUE(names.insert(subcommand.name).second);
        EXPECT_FALSE(subcommand.summary.empty());
        EXPECT_FALSE(subcommand.summary.ends_with('.'));
        EXPECT_FALSE(subcommand.description.empty());
        const ShownOptions shown = shown_options(subcommand);
        std::set<std::string> options;
        for (const auto* group : {&shown.own, &shown.common}) {
            for (const OptionRow& row : rows_of(*group)) {
                EXPECT_TRUE(options.insert(row.long_name).second) << row.long_name;
                EXPECT_FALSE(row.description.empty()) << row.long_name;
                EXPECT_NE(row.value_name, "arg") << row.long_name << " has no value_name()";
            }
        }
    }
}

po::variables_map parse(const std::vector<std::string>& words) { return parse_words(find_subcommand("moves"), words); }

TEST(CommandLine, GivesWordsTheNamesOfArguments) {
    const po::variables_map values = parse({"a.nc", "--dialect", "fanuc", "-q"});
    EXPECT_EQ(values["PROGRAM"].as<std::string>(), "a.nc");
    EXPECT_EQ(values["dialect"].as<std::string>(), "fanuc");
    EXPECT_EQ(values.count("quiet"), 1U);
}

TEST(CommandLine, TakesAnythingForAnArgumentBehindTwoDashes) {
    EXPECT_EQ(parse({"-q", "--", "--dialect"})["PROGRAM"].as<std::string>(), "--dialect");
}

TEST(CommandLine, RefusesAnOptionWhereAValueIsMissing) {
    EXPECT_THROW((void)parse({"--dialect", "--json"}), UsageError);
    EXPECT_EQ(parse({"--dialect=--json"})["dialect"].as<std::string>(), "--json");
    EXPECT_EQ(parse({"--dialect", "-1,2"})["dialect"].as<std::string>(), "-1,2");
}

}  // namespace
}  // namespace clsurf::cli::vocabulary_test
