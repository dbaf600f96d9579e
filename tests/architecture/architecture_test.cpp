// The rules of docs/design/rooms.md, read from the sources: who may include whom, which third party
// is used where, what is listed in CMake, how long a file may be. Each rule is a function from a
// source text to complaints, tried first on a text that breaks it.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Complaints = std::vector<std::string>;

constexpr std::size_t longest_file = 600;  // lines; the house rule is 500, this is the fence

// Room → rooms whose headers it may include besides its own.
const std::map<std::string, std::set<std::string>> rooms{
    {"core", {}},
    {"curve", {"core"}},
    {"program", {"core"}},
    {"machine", {"core"}},
    {"log", {"core"}},
    {"path", {"core", "program", "machine", "log"}},
    {"surface", {"core", "machine", "path"}},
    {"field", {"core", "machine", "log", "path", "surface"}},
    {"motion", {"core", "curve", "program", "machine", "log"}},
    {"quality", {"core", "program", "log", "path", "surface", "field"}},
    {"report", {"core", "log", "path", "surface", "field", "quality"}},
    {"pipeline", {"core", "program", "machine", "log", "path", "surface", "motion", "quality"}},
    {"optimize",
     {"core", "curve", "program", "machine", "log", "path", "surface", "field", "quality", "motion", "pipeline"}},
    {"io",
     {"core", "program", "machine", "log", "path", "surface", "field", "motion", "quality", "report", "pipeline",
      "optimize"}},
    {"viz", {"core", "path", "surface", "field", "quality"}},
    {"cli",
     {"core", "program", "machine", "log", "path", "surface", "field", "motion", "quality", "report", "pipeline",
      "optimize", "io", "viz"}},
};

// How the headers of a third party begin → paths that may include them.
struct ThirdParty {
    std::string_view header;
    std::vector<std::string_view> where;
};
const std::vector<ThirdParty> third_parties{
    {"tbb/", {"src/core/parallel."}},
    {"oneapi/", {"src/core/parallel."}},
    {"Eigen/", {"src/", "viz/"}},
    {"vtk", {"viz/"}},
    {"GL/", {"viz/"}},
    {"EGL/", {"viz/"}},
    {"OpenImageIO/", {"viz/"}},
    {"nlohmann/", {"io/"}},
    {"toml++/", {"io/"}},
    {"zlib.h", {"io/"}},
    {"zstd.h", {"io/"}},
    {"lzma.h", {"io/"}},
    {"expat.h", {"io/"}},
    {"boost/", {"src/cli/"}},
};

struct SourceFile {
    std::string path;  // from the project's root, "src/core/place.h"
    std::string text;
};

std::string room_of(const std::string& path) {
    const fs::path parts(path);
    auto part = parts.begin();
    if (*part == "src") ++part;
    return part->string();
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

struct Include {
    std::string header;
    bool own = false;  // "…", not <…>
};

std::vector<Include> includes_of(const SourceFile& file) {
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

Complaints check_rooms(const SourceFile& file) {
    Complaints complaints;
    const std::string room = room_of(file.path);
    const auto allowed = rooms.find(room);
    if (allowed == rooms.end()) return {file.path + ": no such room in the table"};
    for (const Include& include : includes_of(file)) {
        if (!include.own) continue;
        const std::string other = room_of(include.header);
        if (other != room && !allowed->second.contains(other)) {
            complaints.push_back(file.path + " includes \"" + include.header + "\": " + room + " may not include " +
                                 other);
        }
    }
    return complaints;
}

Complaints check_third_parties(const SourceFile& file) {
    Complaints complaints;
    for (const Include& include : includes_of(file)) {
        for (const ThirdParty& party : third_parties) {
            if (!include.header.starts_with(party.header)) continue;
            const bool allowed = std::any_of(party.where.begin(), party.where.end(),
                                             [&](std::string_view where) { return file.path.starts_with(where); });
            if (!allowed) complaints.push_back(file.path + " includes <" + include.header + ">");
        }
    }
    return complaints;
}

// The text without comments, strings and characters: what is left are names and operators.
std::string code_of(const std::string& text) {
    std::string code;
    for (std::size_t i = 0; i < text.size();) {
        const std::string_view rest = std::string_view(text).substr(i);
        if (rest.starts_with("//")) {
            i = std::min(text.find('\n', i), text.size());
        } else if (rest.starts_with("/*")) {
            i = std::min(text.find("*/", i), text.size() - 2) + 2;
        } else if (rest.starts_with("R\"")) {
            const std::size_t open = text.find('(', i);
            const std::string close = ")" + text.substr(i + 2, open - i - 2) + "\"";
            i = text.find(close, open) + close.size();
        } else if (rest[0] == '"' ||
                   (rest[0] == '\'' &&
                    (i == 0 || std::isalnum(static_cast<unsigned char>(text[i - 1])) == 0))) {  // not 1'000
            const char quote = rest[0];
            for (++i; i < text.size() && text[i] != quote; ++i) {
                if (text[i] == '\\') ++i;
            }
            ++i;
            code += ' ';
        } else {
            code += text[i++];
        }
    }
    return code;
}

Complaints check_form(const SourceFile& file) {
    Complaints complaints;
    const std::size_t lines = lines_of(file.text).size();
    if (lines > longest_file) { complaints.push_back(file.path + " has " + std::to_string(lines) + " lines"); }
    if (file.path.ends_with(".h") && !file.text.starts_with("#pragma once\n")) {
        complaints.push_back(file.path + " does not begin with #pragma once");
    }
    if (!file.text.ends_with('\n')) complaints.push_back(file.path + ": no end of line at its end");
    const std::string code = code_of(file.text);
    for (const char c : code) {
        if (static_cast<unsigned char>(c) >= 0x80) {
            complaints.push_back(file.path + ": a name that is not ASCII");
            break;
        }
    }
    return complaints;
}

// A file is built when the CMakeLists.txt of its folder, or the nearest above, names it.
Complaints check_listed(const SourceFile& file, const std::string& cmake_folder, const std::string& cmake_text) {
    const std::string name = fs::relative(file.path, cmake_folder).generic_string();
    const std::string plain = fs::path(file.path).filename().string();
    const auto is_name = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.';
    };
    for (const std::string& wanted : {name, plain}) {
        for (std::size_t at = cmake_text.find(wanted); at != std::string::npos; at = cmake_text.find(wanted, at + 1)) {
            const bool starts = at == 0 || !is_name(cmake_text[at - 1]);
            const std::size_t end = at + wanted.size();
            if (starts && (end == cmake_text.size() || !is_name(cmake_text[end]))) return {};
        }
    }
    return {file.path + " is not listed in " + cmake_folder + "/CMakeLists.txt"};
}

std::string read(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

std::vector<SourceFile> sources_in(const std::vector<std::string>& folders) {
    std::vector<SourceFile> files;
    const fs::path root(PROJECT_ROOT);
    for (const std::string& folder : folders) {
        for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
            const std::string extension = entry.path().extension().string();
            if (extension != ".cpp" && extension != ".h") continue;
            files.push_back({fs::relative(entry.path(), root).generic_string(), read(entry.path())});
        }
    }
    std::sort(files.begin(), files.end(), [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
    return files;
}

void expect_none(const Complaints& complaints) {
    for (const std::string& complaint : complaints) ADD_FAILURE() << complaint;
}

TEST(Rooms, AnIncludeAgainstTheArrowsIsFound) {
    EXPECT_EQ(check_rooms({"src/path/x.cpp", "#include \"surface/cl_surface.h\"\n"}).size(), 1U);
    EXPECT_EQ(check_rooms({"viz/x.cpp", "#  include \"io/biip.h\"\n"}).size(), 1U);
    EXPECT_EQ(check_rooms({"src/io2/x.cpp", ""}).size(), 1U);
    EXPECT_TRUE(check_rooms({"io/x.cpp", "#include \"path/passes.h\"\n"}).empty());
}

TEST(Rooms, IncludeOnlyWhatTheTableAllows) {
    for (const SourceFile& file : sources_in({"src", "io", "viz"})) expect_none(check_rooms(file));
}

TEST(ThirdParties, OneInTheWrongRoomIsFound) {
    EXPECT_EQ(check_third_parties({"src/path/x.cpp", "#include <tbb/parallel_for.h>\n"}).size(), 1U);
    EXPECT_EQ(check_third_parties({"src/cli/x.cpp", "#include <vtkActor.h>\n"}).size(), 1U);
    EXPECT_TRUE(check_third_parties({"viz/x.cpp", "#include <vtkActor.h>\n"}).empty());
}

TEST(ThirdParties, AreUsedInTheirRoomOnly) {
    for (const SourceFile& file : sources_in({"src", "io", "viz"})) { expect_none(check_third_parties(file)); }
}

TEST(Form, ALongFileAForeignLetterAndAMissingPragmaAreFound) {
    EXPECT_EQ(check_form({"a.cpp", std::string(longest_file + 1, '\n')}).size(), 1U);
    EXPECT_EQ(check_form({"a.cpp", "int l\u00e4nge = 0;\n"}).size(), 1U);
    EXPECT_EQ(check_form({"a.h", "int a;\n"}).size(), 1U);
    EXPECT_EQ(check_form({"a.cpp", "int a;"}).size(), 1U);
    EXPECT_TRUE(check_form({"a.cpp", "// \u00b5m\nauto a = \"\\\"\u00b5m\"; /* \u00b5 */\n"}).empty());
    EXPECT_TRUE(check_form({"a.cpp", "int a = 1'000; // it's\nchar b = '\"';\n"}).empty());
}

TEST(Form, IsKeptByEveryFile) {
    // Programs in data/programs may end in .h too: HEIDENHAIN's Klartext.
    for (const SourceFile& file : sources_in({"src", "io", "viz", "tests", "data/tools"}))
        expect_none(check_form(file));
}

TEST(Listing, AFileThatNobodyBuildsIsFound) {
    EXPECT_EQ(check_listed({"src/core/b.cpp", ""}, "src/core", "SOURCES ab.cpp b.cpp2").size(), 1U);
    EXPECT_TRUE(check_listed({"src/core/b.cpp", ""}, "src/core", "SOURCES b.cpp)").empty());
}

TEST(Listing, EveryFileIsBuilt) {
    const fs::path root(PROJECT_ROOT);
    for (const SourceFile& file : sources_in({"src", "io", "viz", "tests", "data/tools"})) {
        // Headers are listed in the rooms: public ones as HEADERS, others among SOURCES.
        const bool in_room = rooms.contains(room_of(file.path)) && room_of(file.path) != "cli";
        if (file.path.ends_with(".h") && !in_room) continue;
        fs::path folder = fs::path(file.path).parent_path();
        while (!fs::exists(root / folder / "CMakeLists.txt")) folder = folder.parent_path();
        expect_none(check_listed(file, folder.generic_string(), read(root / folder / "CMakeLists.txt")));
    }
}

/// The code blocks of a Markdown text that are marked as C++.
std::vector<std::string> cpp_blocks(const std::string& text) {
    std::vector<std::string> blocks;
    const std::string fence = "```cpp\n";
    for (std::size_t at = text.find(fence); at != std::string::npos; at = text.find(fence, at)) {
        at += fence.size();
        blocks.push_back(text.substr(at, text.find("```", at) - at));
    }
    return blocks;
}

std::string whole_text(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

// The program that tests/consumer builds against the installed package.
TEST(Documentation, ReadmeShowsTheProgramThatTheConsumerTestRuns) {
    const std::string program = whole_text(fs::path(PROJECT_ROOT) / "tests/consumer/consumer.cpp");
    ASSERT_FALSE(program.empty());
    const std::vector<std::string> shown = cpp_blocks(whole_text(fs::path(PROJECT_ROOT) / "README.md"));
    ASSERT_EQ(shown.size(), 1U);
    EXPECT_EQ(shown.front(), program);
}

}  // namespace
