// A program is edited at random after its run: points keep the lines that they ran.
#include "mapping/line_edits.h"

#include <map>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "io/formats/log_format.h"
#include "io/readers/program_file.h"
#include "mapping/line_map.h"
#include "mapping/map_lines.h"
#include "program/motion_rows.h"

namespace clsurf::line_edits_test {
namespace {

struct TextLine {
    std::string text;
    LineNumber before = 0;  ///< number in the text that was run; 0: the line is new
};

class EditedProgram {
public:
    EditedProgram(const SourceText& text, std::uint64_t seed) : random_(seed) {
        for (LineNumber n = 1; n <= text.line_count(); ++n) lines_.push_back({std::string(text.line(n)), n});
    }

    void insert_comments(int count) {
        for (int k = 0; k < count; ++k) lines_.insert(lines_.begin() + place(), {"(another comment)", 0});
    }
    /// Deletes some consecutive motions, which changes the path there.
    void delete_lines(int count) {
        const auto at = lines_.begin() + place();
        lines_.erase(at, at + count);
    }
    /// Swaps two consecutive lines.
    void swap_lines() {
        const std::ptrdiff_t at = place();
        std::swap(lines_[static_cast<std::size_t>(at)], lines_[static_cast<std::size_t>(at) + 1]);
    }
    void change_feed() { lines_[static_cast<std::size_t>(place())].text += " F1234"; }
    void number_lines() {
        for (std::size_t k = 0; k < lines_.size(); ++k) {
            const std::string& text = lines_[k].text;
            if (!text.empty() && (text[0] == 'X' || text[0] == 'G'))
                lines_[k].text = fmt::format("N{} {}", 10 * k, text);
        }
    }
    void end_with_crlf() { line_end_ = "\r\n"; }

    [[nodiscard]] std::string text() const {
        std::string all;
        for (const TextLine& line : lines_) all += line.text + line_end_;
        return all;
    }
    /// By number in the text that was run; 0: deleted.
    [[nodiscard]] std::vector<LineNumber> now() const {
        std::vector<LineNumber> numbers;
        for (std::size_t k = 0; k < lines_.size(); ++k) {
            if (lines_[k].before >= numbers.size()) numbers.resize(std::size_t{lines_[k].before} + 1, 0);
            numbers[lines_[k].before] = static_cast<LineNumber>(k + 1);
        }
        return numbers;
    }

private:
    /// A place between the first motions and the last ones.
    std::ptrdiff_t place() {
        constexpr std::ptrdiff_t margin = 30;
        return std::uniform_int_distribution<std::ptrdiff_t>(
            margin, static_cast<std::ptrdiff_t>(lines_.size()) - margin)(random_);
    }

    std::vector<TextLine> lines_;
    std::mt19937_64 random_;
    std::string line_end_ = "\n";
};

struct Kept {
    std::int64_t right = 0, all = 0;
    [[nodiscard]] double share() const { return static_cast<double>(right) / static_cast<double>(all); }
};

/// The number of points whose line still exists, and the number of those that have that line.
Kept map_edited(const Trajectory& path, const Log& log, const EditedProgram& edited, const LineMap& original) {
    const Program program = parse(edited.text(), "linuxcnc");
    Diagnostics diagnostics;
    const LineMap map = map_lines(path, log, program, true, diagnostics, ProgramIdentity::edited);
    const std::vector<LineNumber> now = edited.now();
    Kept kept;
    for (PointIndex i = 0; i < path.count; ++i) {
        const LineNumber ran = original.line_at(i);
        if (ran == 0 || ran >= now.size() || now[ran] == 0) continue;
        ++kept.all;
        kept.right += map.line_at(i) == now[ran] ? 1 : 0;
    }
    return kept;
}

using Edit = void (*)(EditedProgram&);

TEST(LineEdits, AtRandomLeaveThePointsOnTheirLines) {
    const Program ran = io::read_program(SAMPLE_DATA "/programs/bottle_uneven.nc");
    const Log log = io::open_log(SAMPLE_LOGS "/bottle_uneven.biip", {});
    const Trajectory path = reconstruct(log, Role::commanded, Eigen::Isometry3d(Eigen::Isometry3d::Identity()));
    const LineMap original(log.find("line")->values, ran, log.keep_alive);
    const std::map<std::string, Edit> kinds{
        {"one comment", [](EditedProgram& e) { e.insert_comments(1); }},
        {"comments at eight places", [](EditedProgram& e) { e.insert_comments(8); }},
        {"lines deleted", [](EditedProgram& e) { e.delete_lines(3); }},
        {"lines deleted at three places",
         [](EditedProgram& e) {
             for (const int count : {1, 12, 2}) e.delete_lines(count);
         }},
        {"two lines swapped", [](EditedProgram& e) { e.swap_lines(); }},
        {"a feed changed", [](EditedProgram& e) { e.change_feed(); }},
        {"all lines numbered", [](EditedProgram& e) { e.number_lines(); }},
        {"CR LF", [](EditedProgram& e) { e.end_with_crlf(); }},
        {"some of all", [](EditedProgram& e) {
             e.insert_comments(3);
             e.delete_lines(2);
             e.swap_lines();
             e.change_feed();
             e.number_lines();
             e.end_with_crlf();
         }}};
    for (const auto& [kind, edit] : kinds) {
        for (std::uint64_t seed = 1; seed <= 2; ++seed) {
            EditedProgram edited(ran.main(), seed);
            edit(edited);
            const Kept kept = map_edited(path, log, edited, original);
            EXPECT_GE(kept.share(), 0.99) << kind << ", seed " << seed;
        }
    }
}

}  // namespace
}  // namespace clsurf::line_edits_test
