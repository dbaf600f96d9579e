// Feeds of a LineEditor: F words on lines and on the blocks of splines.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/units.h"
#include "program/text/lexer.h"
#include "program/text/nc_text.h"
#include "repair/line_edit.h"
#include "repair/spline_lines.h"

namespace clsurf {
namespace {

constexpr double feed_steps = 10;  ///< per unit and minute of a feed word; one decimal changes F100 by at most 0.05 %

}  // namespace

/// A motion whose feed may be set, and where its F word goes.
struct LineEditor::FedMotion {
    std::string programmed, wanted;  ///< F words
    LineNumber line = 0;             ///< of the word
    LineNumber restoring = 0;        ///< the line that restores the programmed feed; 0: a new one after `line`
    LineNumber next = 0;             ///< the line of the next motion if nothing is between them
};

std::string LineEditor::feed_word(double feed) const {
    const double unit = unit_ == 1 ? 1 : unit_ * rules_->inch_feed;
    return fmt::format("F{}", std::round(feed * seconds_per_minute / unit * feed_steps) / feed_steps);
}

/// In the order of the program. A section of a spline is one entry if it has a single feed.
std::vector<LineEditor::FedMotion> LineEditor::fed_motions(const std::vector<float>& feeds,
                                                           const std::vector<std::uint8_t>& spans) const {
    const Motions& motions = program_->motions;
    const auto before = static_cast<LineNumber>(blocks_before_spans(splines_)),
               behind = static_cast<LineNumber>(blocks_behind_spans(splines_));
    const auto is_span = [&](std::int64_t i) {
        const auto k = static_cast<std::size_t>(i);
        return knows_unit_ && k < spans.size() && spans[k] != 0 && spans_[k] != 0;
    };
    const auto line = [&](std::int64_t i) { return motions.line[static_cast<std::size_t>(i)]; };
    const auto lowered = [&](std::int64_t i) {
        const auto k = static_cast<std::size_t>(i);
        return feeds[k] > 0 && feeds[k] < motions.feed[k] ? feeds[k] : motions.feed[k];
    };
    std::vector<FedMotion> fed;
    const auto add = [&](std::int64_t i, float feed) -> FedMotion& {
        fed.push_back({feed_word(motions.feed[static_cast<std::size_t>(i)]), feed_word(feed), line(i), 0, line(i) + 1});
        return fed.back();
    };
    for (std::int64_t i = 0; i < motions.size(); ++i) {
        if (editable(i)) add(i, lowered(i));
        if (!is_span(i)) continue;
        std::int64_t last = i;
        while (is_span(last + 1) && line(last + 1) == line(last) + 1) ++last;
        const std::size_t first_fed = fed.size();
        if (splines_ == SplineForm::knotted) {
            float lowest = lowered(i);
            for (std::int64_t k = i; k <= last; ++k) lowest = std::min(lowest, lowered(k));
            add(i, lowest);
        } else {
            for (std::int64_t k = i; k <= last; ++k) add(k, lowered(k));
        }
        fed[first_fed].line -= before;
        fed.back().restoring = behind > 0 ? line(last) + behind : 0;
        fed.back().next = line(last) + behind + 1;
        i = last;
    }
    return fed;
}

/// Appends words to a line, and a line after it; both may be empty.
void LineEditor::append(LineNumber line, const std::string& words, const std::string& line_behind) {
    const std::string_view end_of_line = line_end_of(program_->main().text());
    std::string_view text = program_->main().line(line);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    Edit edit{line, line, std::string(text)};
    // In the style of the line: "X1Y2F3", but "G1 F3".
    const bool close = text.find(' ') == std::string_view::npos && read_plain_line(text, rules_->straight_word);
    if (!words.empty()) edit.text += (close ? "" : " ") + words;
    edit.text += end_of_line;
    if (!line_behind.empty()) edit.text += line_behind + std::string(end_of_line);
    edits_.push_back(std::move(edit));
    ++changed_;
}

void LineEditor::set_feeds(const std::vector<float>& feeds, const std::vector<std::uint8_t>& spans) {
    const std::string statement = rules_->straight_word.empty() ? "" : std::string(rules_->straight_word) + " ";
    const std::vector<FedMotion> fed = fed_motions(feeds, spans);
    std::string modal;  // the present feed of the controller if it is not the programmed one
    for (std::size_t k = 0; k < fed.size(); ++k) {
        const FedMotion& motion = fed[k];
        if (modal.empty()) modal = motion.programmed;
        const bool more = k + 1 < fed.size() && fed[k + 1].line == motion.next;
        const bool restores = !more && motion.wanted != motion.programmed;
        const std::string word = motion.wanted != modal ? motion.wanted : std::string();
        const bool own_line = restores && motion.restoring == 0;
        if (!word.empty() || own_line)
            append(motion.line, word, own_line ? statement + motion.programmed : std::string());
        if (restores && motion.restoring > 0) append(motion.restoring, motion.programmed, {});
        modal = more ? motion.wanted : std::string();
    }
}

}  // namespace clsurf
