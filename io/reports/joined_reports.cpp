#include "io/reports/joined_reports.h"

#include <algorithm>

#include "io/files/json_value.h"

namespace clsurf::io {
std::string csv_field(std::string_view text) {
    if (text.find_first_of(",\"\n\r") == std::string_view::npos) return std::string(text);
    std::string quoted = "\"";
    for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
    return quoted + "\"";
}

std::string joined_junit(const std::vector<std::string>& texts) {
    constexpr std::string_view begin = "<testsuites>\n";
    constexpr std::string_view end = "</testsuites>\n";
    std::string all = texts.front().substr(0, texts.front().find(begin) + begin.size());
    for (const std::string& text : texts) {
        const std::size_t first = text.find(begin) + begin.size();
        all += text.substr(first, text.rfind(end) - first);
    }
    return all.append(end);
}

std::string joined_sarif(const std::vector<std::string>& names, const std::vector<std::string>& texts) {
    Json all;
    Json runs = Json::array();
    for (std::size_t i = 0; i < texts.size(); ++i) {
        all = Json::parse(texts[i]);
        runs.push_back(all["runs"].front());
        runs.back()["automationDetails"] = {{"id", "clsurf/" + names[i] + "/"}};
    }
    all["runs"] = std::move(runs);
    return dump_foreign(all);
}

std::string csv_with_column(std::string_view title, std::string_view value, std::string_view text, bool titled) {
    std::string all;
    bool first = true;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
        if (!first || titled) all.append(csv_field(first ? title : value)).append(",").append(text.substr(0, end));
        text.remove_prefix(end);
        first = false;
    }
    return all;
}

}  // namespace clsurf::io
