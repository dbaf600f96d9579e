#include "machined/tool.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "core/error.h"
#include "core/letter_case.h"

namespace clsurf {
namespace {

std::vector<double> numbers_of(std::string_view text) {
    std::vector<double> numbers;
    while (true) {
        const std::size_t comma = text.find(',');
        const std::string_view word = text.substr(0, comma);
        double value = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (error != std::errc() || end != word.data() + word.size()) return {};
        numbers.push_back(value);
        if (comma == std::string_view::npos) return numbers;
        text.remove_prefix(comma + 1);
    }
}

}  // namespace

CuttingTool parse_tool(std::string_view text) {
    const std::size_t colon = text.find(':');
    const std::string_view kind = text.substr(0, colon);
    const std::vector<double> numbers =
        colon == std::string_view::npos ? std::vector<double>{} : numbers_of(text.substr(colon + 1));
    const auto fail = [&](const std::string& why) -> CuttingTool {
        throw UsageError(fmt::format("tool '{}': {}", text, why),
                         "ball:D, bull:D,R or flat:D in mm, for example ball:6");
    };
    if (kind != "ball" && kind != "bull" && kind != "flat") return fail("not a ball, bull or flat tool");
    if (numbers.size() != (kind == "bull" ? 2U : 1U))
        return fail(kind == "bull" ? "needs a diameter and a corner radius" : "needs a diameter");
    const double radius = 0.5 * numbers[0];
    if (!(radius > 0) || !std::isfinite(radius)) return fail("the diameter must be positive");
    if (kind == "ball") return {ToolKind::ball, radius, radius};
    if (kind == "flat") return {ToolKind::flat, radius, 0};
    if (!(numbers[1] > 0 && numbers[1] < radius))
        return fail("the corner radius must lie between 0 and half the diameter");
    return {ToolKind::bull, radius, numbers[1]};
}

std::optional<CuttingTool> tool_of_remark(std::string_view remark, double diameter) {
    std::optional<CuttingTool> by_word;
    while (!remark.empty()) {
        const std::size_t end = std::min(remark.find_first_of(" \t\r()"), remark.size());
        const std::string word = lower_case(remark.substr(0, end));
        remark.remove_prefix(std::min(end + 1, remark.size()));
        const auto is_any = [&](std::initializer_list<std::string_view> words) {
            return std::find(words.begin(), words.end(), word) != words.end();
        };
        const std::string kind = word.substr(0, word.find(':'));
        if (word.size() > kind.size() && (kind == "ball" || kind == "bull" || kind == "flat")) return parse_tool(word);
        if (!(diameter > 0)) continue;
        if (is_any({"ball", "ballnose", "ball-nose", "ball-end"}))
            by_word = CuttingTool{ToolKind::ball, 0.5 * diameter, 0.5 * diameter};
        if (is_any({"flat", "endmill"}) && !by_word) by_word = CuttingTool{ToolKind::flat, 0.5 * diameter, 0};
    }
    return by_word;
}

std::string to_text(const CuttingTool& tool) {
    switch (tool.kind) {
        case ToolKind::ball: return fmt::format("ball:{:g}", 2 * tool.radius);
        case ToolKind::bull: return fmt::format("bull:{:g},{:g}", 2 * tool.radius, tool.corner);
        case ToolKind::flat: return fmt::format("flat:{:g}", 2 * tool.radius);
    }
    return {};
}

}  // namespace clsurf
