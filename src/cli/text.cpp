#include "cli/text.h"

#include <algorithm>

namespace clsurf::cli {

std::size_t columns_of(std::string_view text) {
    // Continuation bytes of UTF-8 are 10xxxxxx.
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::vector<std::string> wrap(std::string_view text, std::size_t width) {
    std::vector<std::string> lines;
    std::string line;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t begin = text.find_first_not_of(" \n", at);
        if (begin == std::string_view::npos) break;
        const std::size_t end = std::min(text.find_first_of(" \n", begin), text.size());
        const std::string_view word = text.substr(begin, end - begin);
        if (!line.empty() && columns_of(line) + 1 + columns_of(word) > width) {
            lines.push_back(line);
            line.clear();
        }
        if (!line.empty()) line += ' ';
        line += word;
        at = end;
    }
    if (!line.empty()) lines.push_back(line);
    return lines;
}

std::string join_words(const std::vector<std::string_view>& words, std::string_view conjunction) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0 && i + 1 == words.size()) {
            text.append(" ").append(conjunction).append(" ");
        } else if (i > 0) {
            text.append(", ");
        }
        text.append(words[i]);
    }
    return text;
}

std::vector<Paragraph> paragraphs_of(std::string_view description) {
    std::vector<Paragraph> paragraphs;
    bool open = false;
    while (!description.empty()) {
        const std::size_t end = std::min(description.find('\n'), description.size());
        const std::string_view line = description.substr(0, end);
        description.remove_prefix(std::min(end + 1, description.size()));
        if (line.find_first_not_of(' ') == std::string_view::npos) {
            open = false;
            continue;
        }
        const bool literal = line.front() == ' ';
        if (!open || paragraphs.back().literal != literal) paragraphs.push_back({literal, {}});
        open = true;
        std::string& text = paragraphs.back().text;
        if (literal) {
            text.append(line).append("\n");
        } else {
            text.append(text.empty() ? "" : " ").append(line);
        }
    }
    return paragraphs;
}

}  // namespace clsurf::cli
