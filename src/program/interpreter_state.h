#pragma once
// What the parts of the interpreter share (interpreter.cpp: lines and calls; codes.cpp: what words
// mean; cycles.cpp: canned cycles; flow.cpp: control statements). Not for other rooms.

#include <map>
#include <string>
#include <vector>

#include "program/arc.h"
#include "program/block.h"
#include "program/control.h"
#include "program/cutter_compensation.h"
#include "program/interpreter.h"
#include "program/modal_state.h"
#include "program/tool_table.h"

namespace clsurf {

/// A call that is running: where it goes on afterwards.
struct Frame {
    std::size_t file = 0;
    LineNumber line = 0;          ///< the calling line
    std::size_t start_file = 0;   ///< of the subprogram, for repeats
    LineNumber start_line = 0;
    int repeats = 0;              ///< still to do after this one
    bool locals = false;          ///< a set of local variables was pushed
    std::map<LineNumber, double> counters;  ///< of the repeat and for loops of the caller
};

struct CycleState {
    double r = 0, z = 0, q = 0;  ///< sticky words, as programmed
    Vec3 ijk = Vec3::Zero();     ///< of G87: the way aside, and the height to bore to, as programmed
    double p = 0;                ///< dwell [s]
    double initial = std::numeric_limits<double>::quiet_NaN();  ///< level where the cycle began [mm]
};

class Interpreter {
public:
    Interpreter(SourceText text, const InterpreterOptions& options);
    Program run();

private:
    // interpreter.cpp: lines, calls, output
    void run_lines();
    void run_line();
    void run_block(std::string_view line);
    bool run_plain(const Words& words);
    [[nodiscard]] std::string_view next_line();
    void go_to(std::size_t file, LineNumber line);  ///< the next line read is `line`
    [[noreturn]] void fail(const std::string& what, std::size_t column = 0, const std::string& hint = {}) const;
    void note(Severity severity, const char* code, const std::string& text, std::size_t column = 0);
    void event(const std::string& name, const std::string& value);

    // parameters.cpp: of the control; NaN: an ordinary variable
    [[nodiscard]] double parameter(int number) const;
    [[nodiscard]] double named_parameter(const std::string& name) const;

    // codes.cpp: what words mean
    void execute(Block& block);
    void settle_codes(Block& block);
    void apply_code(int code, Block& block, std::size_t column);
    void apply_common(int code, Block& block, std::size_t column);
    bool apply_of_dialect(int code, Block& block, std::size_t column);
    void apply_m(int code, const Block& block);
    void apply_keyword(const Keyword& keyword, Block& block);
    void dwell(const Block& block);
    void report_unused(const Block& block);

    // offsets.cpp: work systems, tools, reference points
    void set_offsets(const Block& block);       ///< G10
    void set_tool(int level, const Block& block);  ///< G10 L1, L10, L11
    void shift_position(const Block& block);    ///< G92
    void restore_shift(int code);               ///< G92.1 … G92.3
    void keep_modes(int code);                  ///< M70 … M73
    void restore_modes(const ModalState& kept);
    void keep_reference(int code);              ///< G28.1, G30.1
    void select_work_system(int number);
    void change_tool(const Block& block);       ///< T, M6, M61
    void part_from_machine(const Vec3& by);
    void read_machine_position(const Block& block);
    [[nodiscard]] Tool tool_of(int number, std::size_t column);
    void tool_length(int code, const Block& block);
    void reference(int code, const Block& block);  ///< G28, G30

    // compensated_motions.cpp: G40 … G42
    void start_compensation(int code, const Block& block, std::size_t column);
    void stop_compensation();
    void refuse_in_compensation(int code, const Block& block, std::size_t column) const;
    [[nodiscard]] Vec3 tool_position() const;   ///< where the motions end: not as programmed under G41 and G42
    void compensated_straight(MotionKind kind, const Vec3& end, const Vec3& rotary);
    void compensated_arc(const Arc& arc, bool clockwise, const Vec3& end, const Vec3& rotary);
    void push_compensated(const CompensatedStep& step, MotionKind kind, const Vec3& end, const Vec3& rotary, Arc arc = {});

    // motions.cpp
    [[nodiscard]] Vec3 target(const Block& block, bool machine) const;
    void put_polar(const Block& block, Vec3& end) const;
    [[nodiscard]] Vec3 rotary_target(const Block& block) const;
    void move(const Block& block);
    void straight(MotionKind kind, const Vec3& end, const Vec3& rotary);
    void arc(const Block& block, bool clockwise);
    void push_arc(Arc arc, bool clockwise, const Vec3& begin, const Vec3& end, const Vec3& rotary);
    void probe(const Vec3& end, const Vec3& rotary);
    void spline(const Block& block);
    void nurbs_point(const Block& block);
    void nurbs_end();
    void flatten_bezier(const std::vector<Vec2>& control);
    void push(MotionKind kind, const Vec3& end, const Vec3& rotary, float feed);
    [[nodiscard]] float feed_for(double length);
    void cycle(const Block& block);
    void thread_cycle(const Block& block);   ///< G76
    void tap(const Vec3& end, const Vec3& rotary);  ///< G33.1
    void lathe_cycle(int code, const Block& words, std::size_t column);  ///< G70 … G72
    [[nodiscard]] Vec2 record_profile(const std::string& name, std::vector<CompensatedMove>& profile);
    void follow(const std::vector<CompensatedMove>& moves);  ///< with feed, in the XZ plane
    void bore_back(double r, double bottom, double clear, const Vec3& rotary);

    // flow.cpp: control statements; true: the line was one
    bool control(const Statement& statement);
    [[nodiscard]] bool branch_taken(const Control& branch) const;
    void siemens_definition(const std::string& statement);
    void call(const std::string& name, int repeats, bool locals, const std::vector<double>& arguments);
    void call_from_words(const Block& block);   ///< M98, G65, L…
    void leave(bool from_end_of_text);
    void count_jump();
    [[nodiscard]] const ControlIndex& index(std::size_t file);

    InterpreterOptions options_;
    Program program_;
    DialectId dialect_;
    std::vector<ControlIndex> indexes_;
    std::vector<bool> indexed_;
    ModalState state_;
    Variables variables_;
    CycleState cycle_;
    Block block_;
    Words plain_;               ///< of the line that runs, where it is plain
    ToolTable tools_;
    int next_tool_ = 0;         ///< of the T word
    Tool tool_;                 ///< in the spindle
    CutterCompensation compensation_;
    std::size_t open_motions_ = 0;      ///< the first motion whose end an inside corner may still move
    std::int64_t compensation_ended_ = -1;  ///< motions before G40: the next one is a straight one
    std::int64_t unread_since_ = -1;        ///< motions before the position and the machine parted
    Vec3 unread_ = Vec3::Zero();            ///< from the position as it reads to the last motion's end [mm]

    // Where it reads.
    std::size_t file_ = 0;
    LineNumber line_ = 0;       ///< of the block that runs
    LineNumber next_line_ = 1;
    std::size_t next_byte_ = 0;
    std::string_view current_;  ///< text of the line that runs
    std::vector<Frame> frames_;
    std::vector<std::optional<ModalState>> kept_modes_{1};  ///< by level of calls: what M70 and M73 kept
    std::vector<bool> restores_modes_{false};               ///< M73: they come back on return
    std::map<LineNumber, double> counters_;
    std::uint64_t jumps_ = 0;
    bool ended_ = false;
    bool tape_began_ = false;

    // Per block.
    bool machine_coordinates_ = false;  ///< G53, SUPA
    bool motion_suppressed_ = false;    ///< the axis words belong to G10, G92, G28 …
    int call_program_ = -1;
    std::string modal_call_;            ///< MCALL
    std::vector<Vec3> nurbs_;           ///< x, y, weight
    int nurbs_order_ = 3;
    Vec2 spline_out_ = Vec2::Zero();    ///< P Q of the cubic spline before
};

}  // namespace clsurf
