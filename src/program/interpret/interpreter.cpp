#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "core/not_finite.h"
#include "core/printable_text.h"
#include "program/interpret/codes.h"
#include "program/interpret/control_statements.h"
#include "program/interpret/curves.h"
#include "program/interpret/feeds.h"
#include "program/interpret/flow.h"
#include "program/interpret/interpreter_state.h"
#include "program/interpret/tangential_arc.h"
#include "program/interpreter.h"

namespace clsurf {
namespace {

constexpr std::size_t shown_line_bytes = 4000;  ///< greatest length of a source line in a message
constexpr std::size_t shown_text_bytes = 400;   ///< greatest length of a message, which may name a word of any length

}  // namespace

Interpreter::Interpreter(SourceText text, const InterpreterOptions& options, std::string guessed_from)
    : options_(options),
      variables_(
          [this](int number) {
              return rules_->parameter == nullptr ? missing<double> : rules_->parameter(*this, number);
          },
          [this](const std::string& name) {
              return rules_->named_parameter == nullptr ? missing<double> : rules_->named_parameter(*this, name);
          },
          [this](int number, double value) {
              return rules_->write_parameter != nullptr && rules_->write_parameter(*this, number, value);
          }) {
    program_.dialect = options.dialect;
    program_.dialect_guessed_from = std::move(guessed_from);
    rules_ = program_.dialect->rules;
    code_rules_ = by_code(rules_->codes);
    program_.files.push_back(std::move(text));
    // A line makes a span of a spline and a few motions; an arc in a tilted frame is chords.
    constexpr std::uint64_t most_of_a_line = 200;
    constexpr std::uint64_t most_numbers = 0xfffffff0u;
    most_motions_ = std::min(most_numbers, options_.most_repeated + most_of_a_line * program_.main().line_count());
    texts_.indexes.resize(1);
    texts_.indexed.resize(1);
    if (options.tools) tools_.table = *options.tools;
    if (rules_->make_state != nullptr) dialect_state_ = rules_->make_state();
    if (rules_->begin != nullptr) rules_->begin(*this);
    const std::string_view bytes = program_.main().text();
    if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff")) {
        throw InputError(Place::of_file(program_.main().name()), "is UTF-16 text, expected ASCII or UTF-8",
                         "convert it first, as with iconv -f UTF-16 -t UTF-8");
    }
}

std::int64_t Interpreter::read_on(std::int64_t motions) {
    if (!ended_) {
        while (!ended_ && settled() < motions) run_line();
        if (ended_ && curves_.is_open()) close_spline(*this, Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
        if (ended_ && rules_->at_end != nullptr) rules_->at_end(*this);
    }
    return settled();
}

std::int64_t Interpreter::settled() const {
    const std::int64_t all = program_.motions.size();
    if (ended_ || all == 0) return all;
    // The next motion begins at the end of the last one.
    return compensation_.path.on() ? std::min(all - 1, static_cast<std::int64_t>(compensation_.open_motions)) : all - 1;
}

std::int64_t Interpreter::place_settled(std::int64_t motions) {
    if (motions == 0) return 0;
    keep_tangents(forgotten_tangents_, program_.motions, motions);  // in programmed coordinates
    tangents_kept_ = true;
    const std::int64_t placed = placer_.place(program_.motions, program_.events, motions);
    const std::int64_t more = placed - motions;
    compensation_.open_motions += static_cast<std::size_t>(more);
    compensation_.ended_at += more;
    compensation_.unread_since += more;
    return placed;
}

void Interpreter::forget(std::int64_t motions) {
    if (!std::exchange(tangents_kept_, false)) keep_tangents(forgotten_tangents_, program_.motions, motions);
    program_.motions.drop_front(motions);
    std::vector<ProgramEvent>& events = program_.events;
    events.erase(events.begin(), std::find_if(events.begin(), events.end(),
                                              [motions](const ProgramEvent& e) { return e.motion >= motions; }));
    for (ProgramEvent& e : events) e.motion -= motions;
    forgotten_ += static_cast<std::uint64_t>(motions);
    compensation_.open_motions -= std::min(compensation_.open_motions, static_cast<std::size_t>(motions));
    compensation_.ended_at -= motions;
    compensation_.unread_since -= motions;
}

Program Interpreter::run() {
    (void)read_on(std::numeric_limits<std::int64_t>::max());
    Motions& m = program_.motions;
    m.kind.shrink_to_fit();
    m.end.shrink_to_fit();
    m.feed.shrink_to_fit();
    m.line.shrink_to_fit();
    m.rotary.shrink_to_fit();
    m.file.shrink_to_fit();
    m.call.shrink_to_fit();
    m.frame.shrink_to_fit();
    return std::move(program_);
}

std::string_view Interpreter::next_line() {
    const std::string_view text = program_.files[place_.file].text();
    const char* begin = text.data() + place_.next_byte;
    const std::size_t left = text.size() - place_.next_byte;
    const void* end = std::memchr(begin, '\n', left);
    const std::size_t size = end == nullptr ? left : static_cast<std::size_t>(static_cast<const char*>(end) - begin);
    place_.next_byte += size + (end == nullptr ? 0 : 1);
    place_.line = place_.next_line++;
    return {begin, size};
}

void Interpreter::go_to(std::size_t file, LineNumber line) {
    place_.file = file;
    place_.next_line = line;
    const SourceText& text = program_.files[file];
    place_.next_byte = line > text.line_count() ? text.text().size()
                                                : static_cast<std::size_t>(text.line(line).data() - text.text().data());
}

void Interpreter::run_line() {
    if (place_.next_line == calls_.behind_section) {
        next_of_section(*this);
        return;
    }
    if (place_.next_byte >= program_.files[place_.file].text().size()) {
        leave(*this, true);
        return;
    }
    place_.text = next_line();
    if (rules_->plain(place_.text, plain_) == PlainResult::plain) {
        if (run_plain(plain_)) return;
        if (rules_->motion.plain_blocks) {
            block_.clear();
            block_.words = plain_;
            execute(block_);
            return;
        }
    }
    run_block(place_.text);
}

/// G0, G1 or nothing, with axis words and feed: nearly every block of a finishing program.
bool Interpreter::run_plain(const Words& words) {
    constexpr std::uint32_t allowed = Words::xyz | Words::bit('F') | Words::bit('N');
    if ((words.has & ~allowed) != 0 || (words.has & Words::xyz) == 0 || words.m_count != 0) return false;
    MotionMode mode = state_.motion;
    if (words.g_count == 1) {
        if (words.g[0] != 0 && words.g[0] != 10) return false;
        mode = words.g[0] == 0 ? MotionMode::rapid : MotionMode::feed;
    } else if (words.g_count != 0) {
        return false;
    }
    const bool ordinary = (mode == MotionMode::rapid || mode == MotionMode::feed) && !state_.incremental &&
                          state_.feed_mode == FeedMode::per_minute && !modal_call_.active && !polar_.on &&
                          !state_.frame.active() && !curves_.is_open() && !state_.diameter &&
                          !compensation_.path.on() && (rules_->plain_moves == nullptr || rules_->plain_moves(*this));
    if (!ordinary) return false;
    state_.motion = mode;
    const double unit = state_.unit_mm;
    if (words.given('F')) take_feed(state_, rules_->motion, words.of('F'));
    const Vec3 before = state_.position;
    Vec3& p = state_.position;
    if (words.given('X')) p.x() = words.of('X') * unit;
    if (words.given('Y')) p.y() = words.of('Y') * unit;
    if (words.given('Z')) p.z() = words.of('Z') * unit;
    if ((state_.held | state_.absolute | state_.unplaced) != 0) state_.place(axes_named(words), false);
    const bool rapid = mode == MotionMode::rapid;
    push(rapid ? MotionKind::rapid : MotionKind::feed, p, state_.rotary,
         rapid ? std::numeric_limits<float>::quiet_NaN()
               : static_cast<float>(state_.feed * state_.feed_unit_mm / seconds_per_minute));
    arcs_.begin_of_last = before;
    return true;
}

void Interpreter::run_block(std::string_view line) {
    try {
        const Statement statement = clean_line(line, rules_->text);
        if (statement.open_comment) note(Severity::warning, "program.open-comment", "'(' is not closed");
        if (statement.tape_mark && !statement.title.empty() && rules_->title != nullptr) {
            rules_->title(*this, statement.title);
            return;
        }
        if (statement.tape_mark) {
            // The second % ends the tape; "%name" of other controls is a title.
            const bool alone = line.find_first_not_of("% \t\r") == std::string_view::npos;
            if (tape_began_ && alone && place_.file == 0) ended_ = true;
            tape_began_ = true;
            return;
        }
        if (statement.deleted && options_.block_delete) return;
        if (statement.text.empty()) return;
        const bool done = rules_->statement != nullptr && rules_->statement(*this, statement);
        if (!done && !control_statement(*this, statement)) {
            Cursor cursor{statement.text, 0};
            read_block(cursor, variables_, rules_->text, state_.least_increment(), block_);
            execute(block_);
        }
        note_unknown_parameters();
    } catch (const ReadError& error) { fail(error.what, error.column, error.hint); }
}

/// Reports parameters of the control that the block has read.
void Interpreter::note_unknown_parameters() {
    if (!this_block_.unknown_name.empty()) {
        note(Severity::warning, "program.variable",
             this_block_.unknown_name + " of the control is not known: read as 0");
        this_block_.unknown_name.clear();
    }
    if (this_block_.unknown_parameter != 0) {
        note(Severity::warning, "program.variable",
             fmt::format("#{} of the control is not known: read as vacant", this_block_.unknown_parameter));
        this_block_.unknown_parameter = 0;
    }
}

void Interpreter::fail(const std::string& what, std::size_t column, const std::string& hint) const {
    Place place = Place::of_line(program_.files[place_.file].name(), place_.line, static_cast<std::uint32_t>(column));
    place.source = std::string(place_.text.substr(0, shown_line_bytes));
    std::string advice = hint;
    if (!program_.dialect_guessed_from.empty()) {
        advice += fmt::format("{}read as {}, a guess ({}); choose another with --dialect", advice.empty() ? "" : "; ",
                              program_.dialect->name, program_.dialect_guessed_from);
    }
    throw InputError(std::move(place), printable(what.substr(0, shown_text_bytes)), printable(advice));
}

void Interpreter::note(Severity severity, const char* code, const std::string& text, std::size_t column) {
    Place place = Place::of_line(program_.files[place_.file].name(), place_.line, static_cast<std::uint32_t>(column));
    if (program_.diagnostics.count(code) < Diagnostics::kept_of_a_code) {
        place.source = std::string(place_.text.substr(0, shown_line_bytes));
    }
    program_.diagnostics.add({severity, code, std::move(place), printable(text.substr(0, shown_text_bytes)), {}});
}

void Interpreter::event(const std::string& name, const std::string& value, EventMeaning meaning) {
    if (curves_.is_open()) curves_.open.events.push_back(curves_.open.points.size());
    program_.events.push_back({program_.motions.size(), place_.line, name, value, std::move(meaning)});
}

}  // namespace clsurf
