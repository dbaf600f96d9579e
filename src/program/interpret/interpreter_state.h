#pragma once
// Interpreter: the state that the parts of the interpreter share, and what all of them need: the current line, events,
// errors with their place, motions. The meaning of words is in functions over it, one header per topic (codes.h,
// axis_words.h, motions.h, curves.h, cycles.h, flow.h …). What only one dialect has is in its files. Not for other
// rooms.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "program/frame_placement.h"
#include "program/interpret/block_state.h"
#include "program/interpret/call_stack.h"
#include "program/interpret/dialect_rules.h"
#include "program/interpret/frames.h"
#include "program/interpret/modal_state.h"
#include "program/interpret/tool_state.h"
#include "program/interpreter.h"
#include "program/text/block.h"
#include "program/text/variables.h"

namespace clsurf {

class Interpreter {
public:
    /// The dialect of the options is not null. `guessed_from`: the reason for the dialect if it was detected. Throws
    /// InputError (UTF-16).
    Interpreter(SourceText text, const InterpreterOptions& options, std::string guessed_from = {});
    /// Interprets the whole program.
    Program run();

    /// Runs lines until this many motions of program() are settled, or to the end. Returns how many are settled:
    /// later lines neither change nor read them.
    [[nodiscard]] std::int64_t read_on(std::int64_t motions);
    /// Removes the first settled motions, and events before them, from program().
    void forget(std::int64_t motions);
    [[nodiscard]] bool ended() const { return ended_; }
    [[nodiscard]] const Program& program() const { return program_; }
    /// Brings the settled motions into machine coordinates, with unknown work offsets taken as zero. At most once for
    /// each, before they are removed. Returns how many motions result.
    [[nodiscard]] std::int64_t place_settled(std::int64_t motions);

    // interpreter.cpp: lines, output
    void run_line();
    [[nodiscard]] std::string_view next_line();
    void go_to(std::size_t file, LineNumber line);  ///< the next line read is `line`
    [[noreturn]] void fail(const std::string& what, std::size_t column = 0, const std::string& hint = {}) const;
    void note(Severity severity, const char* code, const std::string& text, std::size_t column = 0);
    void event(const std::string& name, const std::string& value, EventMeaning meaning = {});

    // codes.cpp
    void execute(Block& block);

    // push.cpp: motions from the current position
    void push(MotionKind kind, const Vec3& end, const Vec3& rotary, float feed);
    void straight(MotionKind kind, const Vec3& end, const Vec3& rotary);
    void push_arc(Arc arc, bool clockwise, const Vec3& begin, const Vec3& end, const Vec3& rotary);
    void dwell(double seconds);

    // The state is public: the topics' functions and the dialects' handlers (dialect_rules.h) work on it.

    InterpreterOptions options_;
    const DialectRules* rules_ = nullptr;
    std::vector<CodeRule> code_rules_;  ///< the dialect's, by code
    Program program_;
    std::uint64_t most_motions_ = 0, forgotten_ = 0;
    std::vector<Vec3>
        forgotten_tangents_;      ///< last tangent of the removed motions, and the last one not parallel to it [mm]
    bool tangents_kept_ = false;  ///< the tangents of the settled motions have been kept, in work coordinates
    FramePlacer placer_{{}, Coordinates::machine};

    ReadingPlace place_;
    KnownTexts texts_;
    CallStack calls_;
    ModalCall modal_call_;  ///< G66, MCALL
    Variables variables_;
    Block block_;
    Words plain_;  ///< words of the current line if it is plain
    BlockFlags this_block_;

    ModalState state_;
    PolarState polar_;
    FiveAxisModes five_axis_;
    KnownWorkFrames work_frames_;
    ToolState tools_;
    CompensationState compensation_;
    CycleState cycle_;
    ArcState arcs_;
    CurveState curves_;
    std::unique_ptr<DialectState> dialect_state_;  ///< nullptr: the dialect keeps nothing

    bool feed_missed_ = false;  ///< a cutting motion without feed has been reported
    bool tape_began_ = false;
    bool ended_ = false;

private:
    [[nodiscard]] std::int64_t settled() const;
    void run_block(std::string_view line);
    bool run_plain(const Words& words);
    void note_unknown_parameters();
};

}  // namespace clsurf
