#pragma once
// Reads the project's sources for the architecture tests.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace clsurf::test {

namespace fs = std::filesystem;
using Complaints = std::vector<std::string>;

struct SourceFile {
    std::string path;  // from the project's root, "src/core/place.h"
    std::string text;
};

inline std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

/// A C++ text in two layers: its code with comments, strings and characters as blanks, or its comments with
/// everything else as blanks. Line ends stay, so that positions are those of the text.
struct Parted {
    std::string code, comments;
};

inline Parted part(const std::string& text) {
    Parted parted{text, text};
    const auto blank = [&](std::string& in, std::size_t from, std::size_t to) {
        for (std::size_t k = from; k < to; ++k) {
            if (in[k] != '\n') in[k] = ' ';
        }
    };
    std::size_t i = 0;
    while (i < text.size()) {
        const std::string_view rest = std::string_view(text).substr(i);
        const bool after_name = i > 0 && (std::isalnum(static_cast<unsigned char>(text[i - 1])) != 0);
        std::size_t end = i + 1;
        if (rest.starts_with("//") || rest.starts_with("/*")) {
            end = std::min(rest[1] == '/' ? text.find('\n', i) : text.find("*/", i) + 2, text.size());
            blank(parted.code, i, end);
            i = end;
            continue;
        }
        if (rest.starts_with("R\"")) {
            const std::size_t open = text.find('(', i);
            const std::string close = ")" + text.substr(i + 2, open - i - 2) + "\"";
            end = std::min(text.find(close, open) + close.size(), text.size());
            blank(parted.code, i, end);
        } else if (rest[0] == '"' || (rest[0] == '\'' && !after_name)) {  // not 1'000
            while (end < text.size() && text[end] != rest[0]) end += text[end] == '\\' ? 2 : 1;
            end = std::min(end + 1, text.size());
            blank(parted.code, i, end);
        }
        blank(parted.comments, i, end);
        i = end;
    }
    return parted;
}

inline std::string read(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

/// The files of folders with one of the extensions, sorted by path.
inline std::vector<SourceFile> sources_in(const std::vector<std::string>& folders,
                                          const std::vector<std::string>& endings = {".cpp", ".h"}) {
    std::vector<SourceFile> files;
    const fs::path root(PROJECT_ROOT);
    for (const std::string& folder : folders) {
        for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
            const std::string path = fs::relative(entry.path(), root).generic_string();
            const bool wanted = std::any_of(endings.begin(), endings.end(),
                                            [&](const std::string& ending) { return path.ends_with(ending); });
            // Klartext programs end in ".h" too.
            if (wanted && entry.is_regular_file() && !(path.starts_with("data/programs/") && path.ends_with(".h")))
                files.push_back({path, read(entry.path())});
        }
    }
    std::sort(files.begin(), files.end(), [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
    return files;
}

struct Include {
    std::string header;
    bool own = false;  // "…", not <…>
};

inline std::vector<Include> includes_of(const SourceFile& file) {
    std::vector<Include> includes;
    for (const std::string& line : lines_of(file.text)) {
        const std::size_t hash = line.find_first_not_of(" \t");
        if (hash == std::string::npos || line[hash] != '#') continue;
        const std::size_t word = line.find("include", hash);
        if (word == std::string::npos) continue;
        const std::size_t open = line.find_first_of("<\"", word);
        if (open == std::string::npos) continue;
        const bool own = line[open] == '"';
        const std::size_t close = line.find(own ? '"' : '>', open + 1);
        includes.push_back({line.substr(open + 1, close - open - 1), own});
    }
    return includes;
}

inline void expect_none(const Complaints& complaints) {
    for (const std::string& complaint : complaints) ADD_FAILURE() << complaint;
}

}  // namespace clsurf::test
