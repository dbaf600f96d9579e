#include "io/reports/unusable_log.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "core/printable_text.h"
#include "io/files/json_value.h"
#include "io/reports/joined_reports.h"
#include "io/reports/junit.h"
#include "io/reports/quality_report.h"
#include "io/reports/sarif.h"

namespace clsurf::io {
namespace {

std::string message_of(const UnusableLog& log) {
    return printable(fmt::format("{}: {}", log.error.where.text(), log.error.text));
}

}  // namespace

std::string unusable_text(const UnusableLog& log) { return fmt::format("ERROR: {}\n", message_of(log)); }

std::string unusable_json(const UnusableLog& log) {
    const std::string message = message_of(log);
    Diagnostics diagnostics;
    diagnostics.add(log.error);
    return dump(
        Json{{"error", message},
             {"summary", {{"judged", false}, {"not_judged_reasons", Json::array({message})}, {"within_budget", false}}},
             {"diagnostics", list(diagnostics)}});
}

std::string unusable_csv(const UnusableLog& log) {
    const std::string titles = quality_csv_titles();
    constexpr std::string_view to_cause = ",,";
    // The message is in the last column, which is for comments.
    const auto to_comment = static_cast<std::size_t>(std::ranges::count(titles, ',')) - to_cause.size();
    return fmt::format("{}{}error{}{}\n", titles, to_cause, std::string(to_comment, ','), csv_field(message_of(log)));
}

std::string unusable_sarif(const UnusableLog& log) {
    const Json message{{"text", message_of(log)}};
    Json rule{{"id", "unusable_log"},
              {"shortDescription", {{"text", "The log cannot be used."}}},
              {"help", {{"text", "Check that the log is complete and belongs to the program (clsurf info)."}}}};
    Json result{{"ruleId", "unusable_log"},
                {"ruleIndex", 0},
                {"level", "error"},
                {"message", message},
                {"locations", Json::array({sarif_location(sarif_uri(log.program), 0, 0, "")})},
                {"properties", {{"log", log.log}}}};
    return sarif_text(Json::array({std::move(rule)}), Json::array({std::move(result)}),
                      Json::array({Json{{"level", "error"}, {"message", message}}}), false);
}

std::string unusable_junit(const UnusableLog& log) {
    JunitSuite suite = check_suite(log.program, log.log);
    suite.cases.push_back({std::string(verdict_case), "", "", message_of(log)});
    suite.output = unusable_text(log);
    return junit_text({suite});
}

}  // namespace clsurf::io
