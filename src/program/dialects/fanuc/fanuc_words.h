#pragma once
// The meaning of words of Fanuc and HNC: frames, macro calls, offsets, system variables. Handlers in fanuc.cpp call
// them.

#include <array>

#include "program/interpret/interpreter_state.h"

namespace clsurf::fanuc {

/// Nested frames: local zero, then rotation, then scaling, then mirroring.
struct NestedFrame {
    ProgramFrame local, rotation, scaling, mirror;
    double angle = 0;  ///< of the rotation [deg]

    [[nodiscard]] ProgramFrame all() const { return local.around(rotation.around(scaling.around(mirror))); }
};

struct State final : DialectState {
    NestedFrame frame;
    Vec3 local_zero = Vec3::Zero(), mirror_at = Vec3::Zero();  ///< G52, G51.1 [mm]
    std::array<bool, 3> mirrored{};
    bool data_entry = false;  ///< G10 L50 … G11: lines are parameters of the control
};
[[nodiscard]] inline State& state_of(Interpreter& in) { return static_cast<State&>(*in.dialect_state_); }

/// G68. Throws like Interpreter::fail(); so do the next ones.
void rotate_frame(Interpreter& in, const Block& block, std::size_t column);
void scale_frame(Interpreter& in, const Block& block);             ///< G51
void mirror_frame(Interpreter& in, int code, const Block& block);  ///< G50.1, G51.1
void count_from_local_zero(Interpreter& in, const Block& block);   ///< G52
/// G68.2 X Y Z I J K: the plane's zero and its Euler angles, about Z, the new X and the new Z; with P1 Q the angles
/// are those about X, Y and Z of the work system, in the order given by Q.
void tilt_plane(Interpreter& in, const Block& block, std::size_t column);

/// The number of the program that a block calls (P). Throws like Interpreter::fail().
[[nodiscard]] long macro_program(const Interpreter& in, const Block& block, int code, std::size_t column);
/// #1 … #33 of a macro call; NaN: not given.
[[nodiscard]] std::vector<double> macro_arguments(const Block& block);
void macro_call(Interpreter& in, const Block& block);  ///< G65

bool set_offsets(Interpreter& in, int level, const Block& block);     ///< G10; true: a work offset
[[nodiscard]] bool is_data_end(Interpreter& in, const Block& block);  ///< G11
bool write_parameter(Interpreter& in, int number, double value);      ///< true: a variable of the control
[[nodiscard]] double parameter(Interpreter& in, int number);          ///< NaN: an ordinary variable

}  // namespace clsurf::fanuc
