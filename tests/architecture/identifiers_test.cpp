// Names of types and functions in comments and documents: each exists in the code. (Names of files: structure_test.cpp.)

#include <gtest/gtest.h>

#include <set>

#include "architecture/sources.h"

namespace clsurf::test::identifiers_test {
namespace {

/// Proper names, and names in the code of others.
const std::set<std::string> of_others{"NumPy",         "SciPy", "DecompressionStream", "PolyData", "is_discarded",
                                      "KeyboardEvent", "GitLab"};
/// Documents for authors; other documents also format parameters of controls as code.
const std::vector<std::string> documents{"docs/contributing.md", "docs/api.md", "docs/design/", "docs/howto/"};

bool in_identifier(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_upper(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }
bool is_lower(char c) { return std::islower(static_cast<unsigned char>(c)) != 0; }

/// Calls f(word, its end) for the identifiers of a text, except parts of longer words ("ö", "a-b.c").
template <typename F>
void for_each_identifier(const std::string& text, F&& f) {
    for (std::size_t i = 0; i < text.size();) {
        if (!in_identifier(text[i])) {
            ++i;
            continue;
        }
        std::size_t end = i;
        while (end < text.size() && in_identifier(text[end])) ++end;
        if (std::isdigit(static_cast<unsigned char>(text[i])) == 0) f(text.substr(i, end - i), end);
        i = end;
    }
}

/// "PathLocation": at least two words, each with at least one upper-case and one lower-case letter.
bool names_a_type(const std::string& word) {
    if (word.size() < 4 || !is_upper(word[0]) || !is_lower(word[1])) return false;
    for (std::size_t i = 2; i + 1 < word.size(); ++i) {
        if (is_upper(word[i]) && is_lower(word[i + 1]) && is_lower(word[i - 1])) return true;
    }
    return false;
}

/// The identifiers of the code itself, without comments.
std::set<std::string> identifiers_of(const std::vector<SourceFile>& files) {
    std::set<std::string> known;
    for (const SourceFile& file : files) {
        const std::string comments = part(file.text).comments;
        std::string rest = file.text;  // code with its strings, which name commands and columns
        for (std::size_t i = 0; i < rest.size(); ++i) {
            if (comments[i] != ' ' && comments[i] != '\n') rest[i] = ' ';
        }
        for_each_identifier(rest, [&](const std::string& word, std::size_t) { known.insert(word); });
    }
    return known;
}

/// Checks types ("PathLocation") and functions ("read_part()") in comments.
Complaints check_comments(const SourceFile& file, const std::set<std::string>& known) {
    Complaints complaints;
    const std::string comments = part(file.text).comments;
    for_each_identifier(comments, [&](const std::string& word, std::size_t end) {
        const bool call = comments.compare(end, 2, "()") == 0 && word.size() > 1;
        if ((call || names_a_type(word)) && !known.contains(word) && !of_others.contains(word))
            complaints.push_back(file.path + ": there is no " + word + " in the code");
    });
    return complaints;
}

/// Checks words in backquotes that are written like code: types, and words with an underscore.
Complaints check_document(const SourceFile& file, const std::set<std::string>& known) {
    Complaints complaints;
    for (const std::string& line : lines_of(file.text)) {
        for (std::size_t open = line.find('`'); open != std::string::npos;) {
            const std::size_t close = line.find('`', open + 1);
            if (close == std::string::npos) break;
            const std::string quoted = line.substr(open + 1, close - open - 1);
            open = line.find('`', close + 1);
            if (quoted.find_first_of(" /.<$") != std::string::npos) continue;  // commands, files, "what to write here"
            for_each_identifier(quoted, [&](const std::string& word, std::size_t) {
                const bool code = names_a_type(word) || (is_lower(word[0]) && word.find('_') != std::string::npos);
                if (code && !known.contains(word) && !of_others.contains(word))
                    complaints.push_back(file.path + ": there is no " + word + " in the code");
            });
        }
    }
    return complaints;
}

std::vector<SourceFile> all_code() {
    return sources_in({"src", "io", "viz", "tests", "data"}, {".cpp", ".h", ".h.in", ".ts", ".mjs"});
}

/// The identifiers of the code, and those of CMake: targets, options, variables.
std::set<std::string> known_identifiers(const std::vector<SourceFile>& code) {
    std::set<std::string> known = identifiers_of(code);
    std::vector<SourceFile> build = sources_in({"src", "io", "viz", "tests", "data"}, {"CMakeLists.txt", ".cmake"});
    build.push_back({"CMakeLists.txt", read(fs::path(PROJECT_ROOT) / "CMakeLists.txt")});
    for (const SourceFile& file : build)
        for_each_identifier(file.text, [&](const std::string& word, std::size_t) { known.insert(word); });
    return known;
}

TEST(Identifiers, OneThatIsNowhereIsFound) {
    const std::vector<SourceFile> code{{"a.h", "struct PathLocation {};  // of OldName\nvoid read_part();\n"}};
    const std::set<std::string> known = identifiers_of(code);
    EXPECT_TRUE(known.contains("read_part") && !known.contains("OldName"));
    EXPECT_EQ(check_comments(code.front(), known), Complaints{"a.h: there is no OldName in the code"});
    EXPECT_TRUE(check_comments({"b.h", "// PathLocation: see read_part(), in LinuxCNC and NumPy."}, known).empty());
    EXPECT_EQ(check_comments({"b.h", "// see read_all()\n"}, known).size(), 1U);
    EXPECT_TRUE(check_document({"a.md", "`PathLocation`, `read_part`, `clsurf old_name`, NoCode"}, known).empty());
    EXPECT_EQ(check_document({"a.md", "`PathLocation` or `old_name` or `OldName`"}, known).size(), 2U);
}

TEST(Identifiers, InCommentsExist) {
    const std::vector<SourceFile> code = all_code();
    const std::set<std::string> known = known_identifiers(code);
    for (const SourceFile& file : code) {
        if (!file.path.starts_with("viz/page/dist/") && file.path != "tests/architecture/identifiers_test.cpp")
            expect_none(check_comments(file, known));
    }
}

TEST(Identifiers, InDocumentsForAuthorsExist) {
    const std::set<std::string> known = known_identifiers(all_code());
    std::size_t checked = 0;
    for (const SourceFile& file : sources_in({"docs"}, {".md"})) {
        const bool wanted = std::any_of(documents.begin(), documents.end(),
                                        [&](const std::string& document) { return file.path.starts_with(document); });
        if (!wanted) continue;
        ++checked;
        expect_none(check_document(file, known));
    }
    EXPECT_GT(checked, documents.size());
}

}  // namespace
}  // namespace clsurf::test::identifiers_test
