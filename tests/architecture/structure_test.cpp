// The size of files and functions, the names of files in comments and documents, and the top level of the tree.

#include <gtest/gtest.h>

#include <set>

#include "architecture/functions.h"
#include "architecture/sources.h"

namespace clsurf::test::structure_test {
namespace {

constexpr std::size_t longest_file = 500;     // lines
constexpr std::size_t longest_function = 60;  // lines, from its first word to its closing brace
// A subcommand reads options and files, calls the library and formats the answer; anything else belongs elsewhere.
constexpr std::size_t longest_subcommand = 150;

Complaints check_lengths(const SourceFile& file) {
    Complaints complaints;
    const std::size_t lines = lines_of(file.text).size();
    if (lines > longest_file) { complaints.push_back(file.path + " has " + std::to_string(lines) + " lines"); }
    if (!file.path.ends_with(".cpp") && !file.path.ends_with(".h")) return complaints;
    const bool subcommand = file.path.starts_with("src/cli/") && file.text.find("_subcommand() {") != std::string::npos;
    if (subcommand && lines > longest_subcommand)
        complaints.push_back(file.path + " has " + std::to_string(lines) + " lines, a subcommand");
    for (const FunctionPlace& function : functions_of(file.text)) {
        if (function.last_line == 0) {
            complaints.push_back(file.path + ": " + function.name + " is not closed");
        } else if (function.lines() > longest_function) {
            complaints.push_back(file.path + ":" + std::to_string(function.first_line) + ": " + function.name +
                                 " has " + std::to_string(function.lines()) + " lines");
        }
    }
    return complaints;
}

// ---- names of files ----

// All files of the tree, by path and by the end of their paths: "src/core/place.h", "core/place.h", "place.h".
class Tree {
public:
    void add(const std::string& path) {
        for (std::size_t at = 0;; ++at) {
            names_.insert(path.substr(at));
            at = path.find('/', at);
            if (at == std::string::npos) return;
        }
    }
    void add_folder(const std::string& path) { folders_.insert(path); }
    [[nodiscard]] bool has(const std::string& name) const { return names_.contains(name) || folders_.contains(name); }

private:
    std::set<std::string> names_, folders_;
};

Tree read_tree() {
    Tree tree;
    const fs::path root(PROJECT_ROOT);
    for (const auto& top : fs::directory_iterator(root)) {
        if (!top.is_directory()) {
            tree.add(top.path().filename().string());
            continue;
        }
        const std::string folder = top.path().filename().string();
        if (folder == ".git" || folder.starts_with("build")) continue;
        tree.add_folder(folder);
        for (const auto& entry : fs::recursive_directory_iterator(top)) {
            const std::string path = fs::relative(entry.path(), root).generic_string();
            entry.is_directory() ? tree.add_folder(path) : tree.add(path);
        }
    }
    return tree;
}

bool in_name(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '.' || c == '/';
}

/// Whether a word names a file or folder of the tree: a source by its extension, or a path that begins with a known folder.
bool names_ours(const std::string& word) {
    static const std::set<std::string> folders{"src", "io", "viz", "tests", "data", "docs"};
    static const std::set<std::string> endings{".h", ".cpp", ".md", ".cmake", ".mjs", ".ts"};
    const std::size_t slash = word.find('/');
    if (slash == 0 || word.starts_with(".")) return false;
    if (slash != std::string::npos && folders.contains(word.substr(0, slash))) return slash + 1 < word.size();
    return endings.contains(fs::path(word).extension().string()) && fs::path(word).stem() != "" &&
           std::islower(static_cast<unsigned char>(word[0])) != 0;
}

Complaints check_names(const std::string& path, const std::string& text, const Tree& tree) {
    Complaints complaints;
    std::size_t line = 1;
    for (std::size_t i = 0; i < text.size();) {
        if (text[i] == '\n') ++line;
        if (!in_name(text[i])) {
            ++i;
            continue;
        }
        std::size_t end = i;
        while (end < text.size() && in_name(text[end])) ++end;
        std::string word = text.substr(i, end - i);
        // A pattern ("docs/*"), an address or a part of one is not a name; neither is a placeholder.
        const bool pattern = (end < text.size() && (std::string("*<{$:").find(text[end]) != std::string::npos ||
                                                    static_cast<unsigned char>(text[end]) >= 0x80)) ||
                             (i > 0 && std::string("*>}$:~@").find(text[i - 1]) != std::string::npos);
        i = end;
        while (!word.empty() && (word.back() == '.' || word.back() == '/')) word.pop_back();
        while (word.starts_with("../")) word = word.substr(3);
        if (word.starts_with("clsurf/")) word = word.substr(7);  // as used with the installed headers
        const bool stands_for_one =
            std::any_of(word.begin(), word.end(), [](unsigned char c) { return std::isupper(c) != 0; });
        if (pattern || (stands_for_one && !word.ends_with(".md")) || word.starts_with("room/") || !names_ours(word))
            continue;
        const std::string beside = (fs::path(path).parent_path() / word).lexically_normal().generic_string();
        if (!tree.has(word) && !tree.has(beside))
            complaints.push_back(path + ":" + std::to_string(line) + ": there is no " + word);
    }
    return complaints;
}

std::string comments_of(const SourceFile& file) {
    if (file.path.ends_with(".md")) return file.text;
    if (file.path.ends_with(".cpp") || file.path.ends_with(".h") || file.path.ends_with(".ts") ||
        file.path.ends_with(".mjs")) {
        return part(file.text).comments;
    }
    std::string comments;  // of a script or CMake
    for (const std::string& line : lines_of(file.text)) {
        const std::size_t hash = line.find_first_not_of(' ');
        if (hash != std::string::npos && line[hash] == '#') comments += line;
        comments += '\n';
    }
    return comments;
}

// ---- tests ----

TEST(Lengths, ALongFileAndALongFunctionAreFound) {
    EXPECT_EQ(check_lengths({"a.ts", std::string(longest_file + 1, '\n')}).size(), 1U);
    const auto body = [](std::size_t lines) { return std::string(lines, '\n'); };
    EXPECT_TRUE(check_lengths({"a.cpp", "int f() {" + body(59) + "}\n"}).empty());
    EXPECT_EQ(check_lengths({"a.cpp", "int f() {" + body(60) + "}\n"}), Complaints{"a.cpp:1: f has 61 lines"});
    EXPECT_EQ(check_lengths({"a.cpp", "int flow() {" + body(60)}), Complaints{"a.cpp: flow is not closed"});
    EXPECT_EQ(check_lengths({"a.cpp", "int control() {" + body(60) + "}\n"}).size(), 1U) << "of another room";
    const std::string subcommand = "Subcommand a_subcommand() {\n}\n";
    EXPECT_TRUE(check_lengths({"src/cli/subcommands/a.cpp", body(148) + subcommand}).empty());
    EXPECT_EQ(check_lengths({"src/cli/subcommands/a.cpp", body(149) + subcommand}),
              Complaints{"src/cli/subcommands/a.cpp has 151 lines, a subcommand"});
}

TEST(Lengths, FunctionsAreToldFromTypesAndValues) {
    const std::vector<FunctionPlace> found = functions_of(
        "#define TWICE(x) \\\n  { x; }\n"
        "namespace a { // {\n"
        "struct S : T<int> {\n"
        "    S(int n) : T<int>{n}, b_(2), c_{\"{\"} { if (n) { b_ = {1}; } }\n"
        "    bool operator==(const S& s) const = default;\n"
        "    int get() const noexcept { return '{'; }\n"
        "    int b_ = 0, c_[2]{1, 2};\n"
        "};\n"
        "const auto table = std::to_array<S>({{1}, {2}});\n"
        "const auto twice = [](int a) { return 2 * a; };\n"
        "template <class A, int n = 2>\n"
        "auto later(const A& a = {}) -> std::vector<A> {\n"
        "    return {a};\n"
        "}\n"
        "enum class E : int { one, two };\n"
        "TEST(Room, Case) {\n}\n"
        "}\n");
    std::vector<std::string> names;
    names.reserve(found.size());
    for (const FunctionPlace& function : found) names.push_back(function.name + ":" + std::to_string(function.lines()));
    EXPECT_EQ(names, (std::vector<std::string>{"S:1", "get:1", "]:1", "later:4", "(Room, Case):2"}));
}

TEST(Lengths, AreKeptByEveryFile) {
    for (const SourceFile& file :
         sources_in({"src", "io", "viz", "tests", "data"}, {".cpp", ".h", ".ts", ".mjs", ".css", ".cmake"})) {
        if (!file.path.starts_with("viz/page/node_modules/")) expect_none(check_lengths(file));
    }
}

TEST(Names, OneThatIsNowhereIsFound) {
    Tree tree;
    tree.add("src/core/place.h");
    tree.add_folder("src/core");
    EXPECT_TRUE(
        check_names("src/core/a.h", "see place.h, core/place.h, src/core, \"src/core/place.h\".", tree).empty());
    EXPECT_EQ(check_names("README.md", "one\n(docs/gone.md)", tree),
              Complaints{"README.md:2: there is no docs/gone.md"});
    EXPECT_EQ(check_names("io/a.cpp", "other/place.h", tree).size(), 1U);
    EXPECT_EQ(check_names("io/a.cpp", "way.h", tree).size(), 1U);
    EXPECT_TRUE(check_names("README.md", "docs/*.md io/<format>.cpp tests/cli/NAME.cmake part.nc", tree).empty());
}

TEST(Names, InCommentsAndDocumentsExist) {
    const Tree tree = read_tree();
    std::vector<SourceFile> files = sources_in({"src", "io", "viz", "tests", "data", "docs"},
                                               {".cpp", ".h", ".ts", ".mjs", ".cmake", "CMakeLists.txt", ".md"});
    for (const char* top : {"README.md", "CHANGELOG.md", "CMakeLists.txt", "tests/run", "tests/style", "tests/separate",
                            "tests/sanitize", "tests/odr"}) {
        files.push_back({top, read(fs::path(PROJECT_ROOT) / top)});
    }
    for (const SourceFile& file : files) {
        const bool foreign =
            file.path.starts_with("viz/page/dist/") || file.path == "tests/architecture/structure_test.cpp";
        if (!foreign) expect_none(check_names(file.path, comments_of(file), tree));
    }
}

TEST(Top, HoldsWhatARepositoryNeedsAndNothingElse) {
    const std::set<std::string> wanted{".ci",
                                       ".clang-format",
                                       ".clang-tidy",
                                       ".dockerignore",
                                       ".gitattributes",
                                       ".gitignore",
                                       "CHANGELOG.md",
                                       "CITATION.cff",
                                       "CMakeLists.txt",
                                       "CMakePresets.json",
                                       "LICENSE",
                                       "README.md",
                                       "action.yml",
                                       "data",
                                       "docs",
                                       "io",
                                       "src",
                                       "tests",
                                       "viz"};
    std::set<std::string> found;
    for (const auto& entry : fs::directory_iterator(PROJECT_ROOT)) {
        const std::string name = entry.path().filename().string();
        if (name == ".git" || name == "build" || name.starts_with("build-")) continue;
        EXPECT_TRUE(wanted.contains(name)) << name;
        found.insert(name);
    }
    EXPECT_EQ(found, wanted);
}

}  // namespace
}  // namespace clsurf::test::structure_test
