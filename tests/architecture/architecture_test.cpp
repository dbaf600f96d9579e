// Which room may include which, which third party is used where, what is listed in CMake, the form of a file. Each rule
// is a function from source text to complaints, tested first on a text that breaks it. The table of rooms is that of
// CMake (src/clsurf_room.cmake writes it to arrows.txt).

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "architecture/sources.h"

namespace clsurf::test::architecture_test {
namespace {

// Room → other rooms whose headers it may include.
using Arrows = std::map<std::string, std::set<std::string>>;

Arrows read_arrows() {
    Arrows arrows;
    for (const std::string& line : lines_of(read(ARROWS))) {
        const std::size_t colon = line.find(':');
        std::set<std::string>& needs = arrows[line.substr(0, colon)];
        std::istringstream words(line.substr(colon + 1));
        for (std::string word; words >> word;) needs.insert(word);
    }
    return arrows;
}

// Prefixes of a third party's headers → paths that may include them.
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
    {"openssl/", {"io/"}},
    {"sqlite3.h", {"io/history/"}},
    {"modbus/modbus", {"io/modbus/modbus_link."}},
    {"boost/crc", {"io/"}},
    {"boost/program_options", {"src/cli/"}},
};

std::string room_of(const std::string& path) {
    const fs::path parts(path);
    auto part = parts.begin();
    if (*part == "src") ++part;
    return part->string();
}

Complaints check_rooms(const SourceFile& file, const Arrows& arrows) {
    Complaints complaints;
    const std::string room = room_of(file.path);
    const auto allowed = arrows.find(room);
    if (allowed == arrows.end()) return {file.path + ": no such room in the table"};
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

// Arrows without an include.
Complaints check_unused(const std::vector<SourceFile>& files, Arrows arrows) {
    for (const SourceFile& file : files) {
        const auto needs = arrows.find(room_of(file.path));
        if (needs == arrows.end()) continue;
        for (const Include& include : includes_of(file)) {
            if (include.own) needs->second.erase(room_of(include.header));
        }
    }
    Complaints complaints;
    for (const auto& [room, unused] : arrows) {
        for (const std::string& other : unused)
            complaints.push_back(room + " NEEDS " + other + ", but includes nothing of it");
    }
    return complaints;
}

// The table of rooms in docs/design/map.md: "| src/toolpath | … | core log |".
Complaints check_map(const std::string& map, const Arrows& arrows) {
    Complaints complaints;
    for (const auto& [room, needs] : arrows) {
        const std::string folder = room == "io" || room == "viz" ? room : "src/" + room;
        std::string expected;
        for (const std::string& need : needs) expected += (expected.empty() ? "" : " ") + need;
        if (expected.empty()) expected = "nothing of ours";
        std::string found;
        for (const std::string& line : lines_of(map)) {
            if (!line.starts_with("| " + folder + " |")) continue;
            const std::size_t last = line.rfind(" |");
            const std::size_t bar = line.rfind("| ", last - 1);
            found = line.substr(bar + 2, last - bar - 2);
        }
        if (found != expected)
            complaints.push_back("docs/design/map.md: " + folder + " may include " + expected + ", not " + found);
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

Complaints check_form(const SourceFile& file) {
    Complaints complaints;
    if (file.path.ends_with(".h") && !file.text.starts_with("#pragma once\n")) {
        complaints.push_back(file.path + " does not begin with #pragma once");
    }
    if (!file.text.ends_with('\n')) complaints.push_back(file.path + ": no end of line at its end");
    const std::string code = part(file.text).code;
    for (const char c : code) {
        if (static_cast<unsigned char>(c) >= 0x80) {
            complaints.push_back(file.path + ": a name that is not ASCII");
            break;
        }
    }
    return complaints;
}

// A source includes its own header first, so that compiling each source by itself (tests/separate) also compiles the header
// by itself. src/ is the folder to which includes are relative.
Complaints check_own_header_first(const SourceFile& source, bool has_header) {
    if (!has_header || !source.path.ends_with(".cpp")) return {};
    const std::string from_root = fs::path(source.path).replace_extension(".h").generic_string();
    const std::string own = from_root.starts_with("src/") ? from_root.substr(4) : from_root;
    const std::vector<Include> includes = includes_of(source);
    if (!includes.empty() && includes.front().own && includes.front().header == own) return {};
    return {source.path + " does not include " + own + " first"};
}

// A file is built if the CMakeLists.txt of its folder, or the closest one above, names it.
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

TEST(Rooms, AnIncludeAgainstTheArrowsIsFound) {
    const Arrows arrows{{"core", {}}, {"path", {"core"}}, {"io", {"path"}}, {"viz", {}}};
    EXPECT_EQ(check_rooms({"src/path/x.cpp", "#include \"surface/cl_surface.h\"\n"}, arrows).size(), 1U);
    EXPECT_EQ(check_rooms({"viz/x.cpp", "#  include \"io/biip.h\"\n"}, arrows).size(), 1U);
    EXPECT_EQ(check_rooms({"src/io2/x.cpp", ""}, arrows).size(), 1U);
    EXPECT_TRUE(check_rooms({"io/x.cpp", "#include \"path/passes.h\"\n"}, arrows).empty());
}

TEST(Rooms, IncludeOnlyWhatTheyNeed) {
    const Arrows arrows = read_arrows();
    EXPECT_TRUE(arrows.contains("core") && arrows.contains("cli"));
    for (const SourceFile& file : sources_in({"src", "io", "viz"})) expect_none(check_rooms(file, arrows));
}

TEST(Rooms, AnArrowThatNothingFollowsIsFound) {
    const Arrows arrows{{"path", {"core", "log"}}};
    const std::vector<SourceFile> files{{"src/path/x.cpp", "#include \"core/place.h\"\n"}};
    EXPECT_EQ(check_unused(files, arrows), Complaints{"path NEEDS log, but includes nothing of it"});
}

TEST(Rooms, NeedNothingThatTheyDoNotInclude) {
    expect_none(check_unused(sources_in({"src", "io", "viz"}), read_arrows()));
}

TEST(Rooms, StandInTheMapAsInCMake) {
    const Arrows arrows{{"core", {}}, {"path", {"core", "log"}}};
    EXPECT_TRUE(check_map("| src/core | x | nothing of ours |\n| src/path | y | core log |\n", arrows).empty());
    EXPECT_EQ(check_map("| src/core | x | nothing of ours |\n| src/path | y | core |\n", arrows).size(), 1U);
    EXPECT_EQ(check_map("", arrows).size(), 2U);
    expect_none(check_map(read(fs::path(PROJECT_ROOT) / "docs/design/map.md"), read_arrows()));
}

TEST(ThirdParties, OneInTheWrongRoomIsFound) {
    EXPECT_EQ(check_third_parties({"src/path/x.cpp", "#include <tbb/parallel_for.h>\n"}).size(), 1U);
    EXPECT_EQ(check_third_parties({"src/cli/x.cpp", "#include <vtkActor.h>\n"}).size(), 1U);
    EXPECT_TRUE(check_third_parties({"viz/x.cpp", "#include <vtkActor.h>\n"}).empty());
}

TEST(ThirdParties, AreUsedInTheirRoomOnly) {
    for (const SourceFile& file : sources_in({"src", "io", "viz"})) { expect_none(check_third_parties(file)); }
}

TEST(Form, AForeignLetterAndAMissingPragmaAreFound) {
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

TEST(OwnHeader, ThatIsNotFirstIsFound) {
    EXPECT_TRUE(
        check_own_header_first({"src/core/b.cpp", "// b\n#include \"core/b.h\"\n#include <cmath>\n"}, true).empty());
    EXPECT_TRUE(check_own_header_first({"io/b.cpp", "#include \"io/b.h\"\n"}, true).empty());
    EXPECT_EQ(check_own_header_first({"src/core/b.cpp", "#include <cmath>\n#include \"core/b.h\"\n"}, true).size(), 1U);
    EXPECT_EQ(check_own_header_first({"src/core/b.cpp", "int b = 0;\n"}, true).size(), 1U);
    EXPECT_TRUE(check_own_header_first({"src/core/b.cpp", "int b = 0;\n"}, false).empty());
}

TEST(OwnHeader, IsIncludedFirst) {
    for (const SourceFile& file : sources_in({"src", "io", "viz"})) {
        const fs::path header = (fs::path(PROJECT_ROOT) / file.path).replace_extension(".h");
        expect_none(check_own_header_first(file, fs::exists(header)));
    }
}

TEST(Listing, AFileThatNobodyBuildsIsFound) {
    EXPECT_EQ(check_listed({"src/core/b.cpp", ""}, "src/core", "SOURCES ab.cpp b.cpp2").size(), 1U);
    EXPECT_TRUE(check_listed({"src/core/b.cpp", ""}, "src/core", "SOURCES b.cpp)").empty());
}

/// The text of a CMakeLists.txt and of the lists (.def) that it reads.
std::string listed_in(const fs::path& folder) {
    std::string text = read(folder / "CMakeLists.txt");
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const bool is_list = entry.path().extension() == ".def";
        if (is_list && text.find(entry.path().filename().string()) != std::string::npos) text += read(entry.path());
    }
    return text;
}

TEST(Listing, EveryFileIsBuilt) {
    const fs::path root(PROJECT_ROOT);
    const Arrows rooms = read_arrows();
    std::map<std::string, std::string> texts;  // by folder
    for (const SourceFile& file : sources_in({"src", "io", "viz", "tests", "data"})) {
        // Headers are listed in the rooms: public ones as HEADERS, others among SOURCES.
        const bool in_room = rooms.contains(room_of(file.path)) && room_of(file.path) != "cli";
        if (file.path.ends_with(".h") && !in_room) continue;
        fs::path folder = fs::path(file.path).parent_path();
        while (!fs::exists(root / folder / "CMakeLists.txt")) folder = folder.parent_path();
        std::string& text = texts[folder.generic_string()];
        if (text.empty()) text = listed_in(root / folder);
        expect_none(check_listed(file, folder.generic_string(), text));
    }
}

/// The code blocks of a Markdown text with the language C++.
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
}  // namespace clsurf::test::architecture_test
