#pragma once
// What the parts of the interpreter share (interpreter.cpp: lines and calls; codes.cpp: what words mean; cycles.cpp:
// canned cycles; flow.cpp: control statements). What only one dialect has is in its files. Not for other rooms.

#include <array>
#include <map>
#include <string>
#include <vector>

#include "program/dialects/dialect_rules.h"
#include "program/dialects/klartext_words.h"
#include "program/frame_placement.h"
#include "program/interpret/arc.h"
#include "program/interpret/block_state.h"
#include "program/interpret/call_stack.h"
#include "program/interpret/frames.h"
#include "program/interpret/modal_state.h"
#include "program/interpret/tool_state.h"
#include "program/interpreter.h"
#include "program/text/block.h"
#include "program/text/control.h"
#include "program/tool_table.h"

namespace clsurf {

struct CycleState {
    static constexpr double not_yet = std::numeric_limits<double>::quiet_NaN();
    double r = not_yet, z = not_yet, q = 0;  ///< sticky words, as programmed
    /// R and bottom where they were programmed [mm]. RS274 counts the words again in each block instead.
    double r_height = not_yet, bottom = not_yet;
    Vec3 ijk = Vec3::Zero();   ///< of G87: the way aside, and the height to bore to, as programmed
    double p = 0;              ///< dwell [s]
    double initial = not_yet;  ///< level where the cycle began [mm]
};

/// What a cycle does between R and its bottom.
struct Stroke {
    bool dwells = false, feeds_out = false, pecks = false, breaks_chips = false;
};

/// What Klartext keeps from block to block.
struct KlartextState {
    double tool_feed = 0;  ///< F of TOOL CALL, which F AUTO takes
    KlartextSide side = KlartextSide::none;
};

// lathe_cycles.cpp
struct LatheCycle;
struct LatheFrame;
struct RoughingStart;

class Interpreter {
public:
    /// Throws InputError (UTF-16).
    Interpreter(SourceText text, const InterpreterOptions& options);
    /// All of the program.
    Program run();

    /// Runs lines until so many motions of program() are settled, or to the end. How many are: what comes
    /// later neither changes them nor looks back at them.
    [[nodiscard]] std::int64_t read_on(std::int64_t motions);
    /// Takes the first settled motions, and events before them, out of program().
    void forget(std::int64_t motions);
    [[nodiscard]] bool ended() const { return ended_; }
    [[nodiscard]] const Program& program() const { return program_; }
    /// The settled motions in machine coordinates, the unknown work offsets taken as zero. At most once for each,
    /// before they are forgotten. How many motions that makes.
    [[nodiscard]] std::int64_t place_settled(std::int64_t motions);

    // All of it is open: the dialects' handlers (dialect_rules.h) are written in these words.

    // interpreter.cpp: lines, calls, output
    [[nodiscard]] std::int64_t settled() const;
    void run_line();
    void run_block(std::string_view line);
    bool run_plain(const Words& words);
    void note_unknown_parameters();
    [[nodiscard]] std::string_view next_line();
    void go_to(std::size_t file, LineNumber line);  ///< the next line read is `line`
    [[noreturn]] void fail(const std::string& what, std::size_t column = 0, const std::string& hint = {}) const;
    void note(Severity severity, const char* code, const std::string& text, std::size_t column = 0);
    void event(const std::string& name, const std::string& value);

    // parameters.cpp: of the control; NaN: an ordinary variable
    [[nodiscard]] double parameter(int number);
    [[nodiscard]] double named_parameter(const std::string& name);
    bool write_parameter(int number, double value);

    // codes.cpp: what words mean
    void execute(Block& block);
    void settle_codes(Block& block);
    void apply_code(int code, Block& block, std::size_t column);
    void index_codes();
    [[nodiscard]] const CodeRule* rule_of(int code) const;
    void apply_common(int code, Block& block, std::size_t column);
    void apply_m(int code, const Block& block);
    void dwell(double seconds);
    [[noreturn]] void refuse_motion(const std::string& word, const Block& block, std::size_t column,
                                    const std::string& hint = {}) const;
    void report_unused(const Block& block);
    void report_idle(const Block& block);

    // path_modes.cpp
    void set_path_mode(const std::string& name, const std::string& value, const PathMode& mode, bool once = false);
    bool path_mode_word(const CodeWord& word, const PathMode& mode, bool once = false);  ///< a G code; always true
    bool rounded_corners(const CodeWord& word);                                          ///< G64 P Q

    // siemens_words.cpp: words that motions of any dialect may have
    [[nodiscard]] bool ends_by_angle(const Block& block) const;  ///< ANG=
    void end_by_angle(const Block& block, Vec3& end) const;
    [[nodiscard]] std::vector<std::optional<double>> arguments_of(const Keyword& keyword) const;

    // tangential_arc.cpp
    void arc_along_tangent(ArcWords& words) const;
    [[nodiscard]] Vec2 end_tangent(int u, int v) const;
    [[nodiscard]] Vec3 tangent_at_end(std::int64_t motion) const;
    void keep_tangents(std::int64_t motions);

    // tool_axis.cpp: five axes
    void control_tool_centre_point(bool on, const std::string& text);
    bool take_tool_axis(const Block& block);
    [[nodiscard]] bool tool_axis_is_vector() const {
        return (five_axis_.tool_centre_point || five_axis_.tilted) && !std::isnan(state_.tool_axis.x());
    }

    // tilted_plane.cpp: CYCLE800, G68.2
    void begin_tilted_plane(const std::string& text);
    void end_tilted_plane(const std::string& text);
    void turn_to_plane(const Vec3& axis, bool keeps_tip, const std::string& text);
    void swivel(const Keyword& keyword);                      ///< CYCLE800
    void tilt_plane(const Block& block, std::size_t column);  ///< G68.2

    // offsets.cpp: work systems, tools, reference points
    void set_offsets(const Block& block);          ///< G10
    void set_tool(int level, const Block& block);  ///< G10 L1, L10, L11
    void shift_position(const Block& block);       ///< G92
    void restore_shift(int code);                  ///< G92.1 … G92.3
    void keep_modes(int code);                     ///< M70 … M73
    void restore_modes(const ModalState& kept);
    void keep_reference(int code);  ///< G28.1, G30.1
    void select_work_system(int number);
    void select_feed_mode(FeedMode mode);
    void change_tool(const Block& block);  ///< T, M6, M61
    void part_from_machine(const Vec3& by);
    void read_machine_position(const Block& block);
    [[nodiscard]] Tool tool_of(int number, std::size_t column);
    void tool_length(int code, const Block& block);
    void reference(int code, const Block& block);  ///< G28, G30

    // compensated_motions.cpp: G40 … G42
    void start_compensation(int code, const Block& block, std::size_t column);
    void compensate_by_table(int code, const Block& block, std::size_t column);
    void enter_compensation(const Vec2& direction);
    void stop_compensation();
    void refuse_in_compensation(int code, const Block& block, std::size_t column) const;
    [[nodiscard]] Vec3 tool_position() const;  ///< where the motions end: not as programmed under G41 and G42
    void compensated_straight(MotionKind kind, const Vec3& end, const Vec3& rotary);
    void compensated_arc(const Arc& arc, bool clockwise, const Vec3& end, const Vec3& rotary);
    void push_compensated(const CompensatedStep& step, MotionKind kind, const Vec3& end, const Vec3& rotary,
                          Arc arc = {});

    // motions.cpp
    [[nodiscard]] Vec3 target(const Block& block, bool machine);
    [[nodiscard]] Vec3 read_axes(const Block& block, bool machine);
    void straight_to_pole_plane(const Block& block, const Vec3& from, Vec3& end) const;
    void put_at_pole(Vec3& end) const;
    void put_about_pole(std::optional<double> radius, std::optional<double> angle, bool radius_adds, bool angle_adds,
                        Vec3& end);
    void flatten_arc(const Arc& arc, bool clockwise, const Vec3& begin, const Vec3& end, const Vec3& rotary);
    void put_polar(const Block& block, Vec3& end) const;
    [[nodiscard]] Vec3 rotary_target(const Block& block);
    [[nodiscard]] static double whole_turns(const Block& block, std::uint32_t bit, double position, double from);
    void move(const Block& block);
    void straight(MotionKind kind, const Vec3& end, const Vec3& rotary);
    void arc(const Block& block, bool clockwise);
    void refuse_turns(const Block& block) const;
    void push_arc(Arc arc, bool clockwise, const Vec3& begin, const Vec3& end, const Vec3& rotary);
    void probe(const Vec3& end, const Vec3& rotary);
    void push(MotionKind kind, const Vec3& end, const Vec3& rotary, float feed);
    void settle_work_frame();
    void count_in(double unit);    ///< what lengths are counted in [mm], and feeds, if F does not keep its unit
    void take_feed(double value);  ///< F
    [[nodiscard]] float feed_for(double length, double unit);
    [[nodiscard]] float feed_for(double length) { return feed_for(length, state_.feed_unit_mm); }
    [[nodiscard]] double turn_to(const Vec3& rotary) const;
    void cycle(const Block& block);
    void read_cycle_words(const Block& block, const Stroke& stroke);
    [[nodiscard]] std::vector<double> peck_depths(double r, double bottom) const;
    void thread_cycle(const Block& block);                               ///< G76
    void tap(const Vec3& end, const Vec3& rotary);                       ///< G33.1
    void lathe_cycle(int code, const Block& words, std::size_t column);  ///< G70 … G72
    [[nodiscard]] Vec2 record_profile(const std::string& name, std::vector<CompensatedMove>& profile);
    void follow(const std::vector<CompensatedMove>& moves);  ///< with feed, in the XZ plane
    [[nodiscard]] LatheCycle lathe_words(const Block& words, int code, std::size_t column) const;
    void go_in_zx(const Vec2& to, MotionKind kind = MotionKind::rapid);
    void rough(const LatheCycle& cycle, const LatheFrame& frame, const RoughingStart& at,
               std::vector<CompensatedMove>& moves, std::size_t column);
    void go_to_level(MotionKind kind, double height, const Vec3& rotary);
    void drill(const Stroke& stroke, double r, double bottom, double clear, const std::vector<double>& depths,
               const Vec3& rotary);
    void tap_turned(double bottom, double clear, const Vec3& rotary);
    [[nodiscard]] Vec3 edge_shift() const;
    void step_aside(const Vec3& by, const Vec3& rotary);
    void bore_fine(double bottom, double clear, const Vec3& rotary);
    void bore_back_shifted(double r, double top, double clear, const Vec3& rotary);
    void bore_back(double r, double bottom, double clear, const Vec3& rotary);

    // curves.cpp: splines
    void refuse_beside_spline(const Block& block);
    void push_curve(BezierCurve curve, LineNumber line, double feed);
    void spline(const Block& block);         ///< G5, G5.1
    void nurbs_point(const Block& block);    ///< G5.2
    void nurbs_end();                        ///< G5.3
    void knotted_point(const Block& block);  ///< G6.2
    void spline_point(const Block& block);   ///< ASPLINE, BSPLINE, CSPLINE
    void polynomial(const Block& block);     ///< POLY
    [[nodiscard]] const PolynomialWord* polynomial_of(const Block& block, char axis) const;
    void begin_spline(SplineKind kind);
    void add_spline_point(const Vec3& at, double weight, double knot);
    void finish_nurbs(std::vector<double> knots);
    void finish_knotted();
    void finish_basis_spline();
    void finish_point_spline(const Vec3& end_tangent);
    void close_spline(const Vec3& end_tangent);
    void close_spline_before(const Vec3& next);  ///< a straight motion to a point
    void settle_spline(const Block& block);
    void move_events(const OpenSpline& open, std::int64_t first, std::size_t shaping);

    // flow.cpp: control statements; true: the line was one
    bool control_statement(const Statement& statement);
    [[nodiscard]] double value_at(std::string_view text, std::size_t at) const;
    [[nodiscard]] const Control& own_control();
    [[nodiscard]] const Control& partner_of(const Control& control, const char* what);
    void go_after(LineNumber line);
    void run_rest(std::string_view text, std::size_t at);
    struct ControlRow;  ///< a kind of statement and its handler, one of these
    void pass(const Control&, const Statement&);
    void pass_sub(const Control&, const Statement&);
    void return_from_sub(const Control& control, const Statement& statement);
    void call_sub(const Control& control, const Statement& statement);
    void begin_while(const Control& control, const Statement& statement);
    void end_loop(const Control&, const Statement&);
    void end_do(const Control& control, const Statement& statement);
    void begin_if(const Control& control, const Statement& statement);
    void pass_else_if(const Control&, const Statement&);
    void pass_else(const Control&, const Statement&);
    void begin_repeat(const Control& control, const Statement& statement);
    void end_repeat(const Control&, const Statement&);
    void begin_for(const Control& control, const Statement& statement);
    void end_for(const Control&, const Statement&);
    void leave_loop(const Control& control, const Statement&);
    void go_to_label(const Control& control, const Statement& statement);
    void run_if(const Control& control, const Statement& statement);
    void pass_label(const Control& control, const Statement& statement);
    void repeat(const Control& control, const Statement& statement);
    void choose_branch(const Control& control, const Statement& statement);
    [[nodiscard]] bool branch_taken(const Control& branch) const;
    void call_by_number(const Block& block, int least_repeats, bool counted);  ///< M98 P L
    void return_to_block(const Block& block);                                  ///< M99 P
    void call(const std::string& name, int repeats, bool locals, const std::vector<double>& arguments);
    void call_file(const std::string& name);  ///< whatever labels the program has
    void enter(std::size_t file, LineNumber line, int repeats, bool locals);
    void repeat_from(LineNumber begin, double times);
    void jump_to(const std::string& label, int direction, bool may_miss);
    void choose(const std::string& text, std::size_t begin);  ///< CASE
    void repeat_lines(const Control& repeat, const std::string& text);
    void next_of_section();
    void watch_section();
    void leave(bool from_end_of_text);
    void count_jump();
    [[nodiscard]] std::uint32_t call_from_here();
    [[nodiscard]] const ControlIndex& index(std::size_t file);
    [[nodiscard]] LineNumber find_block(double number, LineNumber line, int direction);
    [[nodiscard]] bool load(const std::string& name);  ///< false: no such file

    InterpreterOptions options_;
    const DialectRules* rules_ = nullptr;
    std::vector<CodeRule> code_rules_;  ///< the dialect's, by code
    Program program_;
    std::uint64_t most_motions_ = 0, forgotten_ = 0;
    std::vector<Vec3>
        forgotten_tangents_;      ///< of the motions forgotten the last, and the last that is not parallel to it [mm]
    bool tangents_kept_ = false;  ///< of the settled motions, in work coordinates
    FramePlacer placer_{{}, Coordinates::machine};

    ReadingPlace place_;
    KnownTexts texts_;
    CallStack calls_;
    ModalCall modal_call_;  ///< G66, MCALL
    Variables variables_;
    Block block_;
    Words plain_;  ///< of the line that runs, where it is plain
    BlockFlags this_block_;

    ModalState state_;
    double contour_tolerance_ = std::numeric_limits<double>::quiet_NaN();  ///< CTOL, CYCLE832 [mm]; NaN: the machine's
    Frames frames_;
    FiveAxisModes five_axis_;
    KnownWorkFrames work_frames_;
    ToolState tools_;
    CompensationState compensation_;
    CycleState cycle_;
    ArcState arcs_;
    CurveState curves_;
    Corner corner_;
    KlartextState klartext_;

    bool feed_missed_ = false;  ///< a cutting motion without feed has been reported
    bool data_entry_ = false;   ///< G10 L50 … G11: lines are parameters of the control
    bool tape_began_ = false;
    bool ended_ = false;
};

/// Handlers that several dialects have: all numbers are inches, or millimetres (codes.cpp).
bool count_in_inches(Interpreter& in, const CodeWord& w);
bool count_in_mm(Interpreter& in, const CodeWord& w);

}  // namespace clsurf
