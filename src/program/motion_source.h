#pragma once
// MotionSource: the motions of a program piece by piece, for who goes through them once. A program in memory is
// a single piece; one that is read while it is gone through (program_reader.h) never stands in memory whole.

#include <cstdint>
#include <utility>

#include "program/program.h"

namespace clsurf {

/// What is known of a program as a whole before its first motion.
struct ProgramOutline {
    std::int64_t motions = 0;
    bool curved = false;  ///< it has arcs or splines
};

class MotionSource {
public:
    MotionSource() = default;
    MotionSource(const MotionSource&) = delete;
    MotionSource& operator=(const MotionSource&) = delete;
    virtual ~MotionSource() = default;

    [[nodiscard]] virtual const ProgramOutline& outline() const = 0;
    /// Goes to the next piece, at first to the first; motions and events of the one before are gone.
    /// False: there is none. Throws InputError.
    [[nodiscard]] virtual bool next_piece() = 0;
    /// The program with the piece at hand: events, arcs and curves name motions by their places in it. The reference holds
    /// for all pieces.
    [[nodiscard]] virtual const Program& program() const = 0;
    /// Motions of the piece, 0 before the first; what the program holds behind them belongs to the next one, and may still change.
    [[nodiscard]] virtual std::int64_t piece_size() const = 0;
};

/// A program in memory.
class WholeProgram final : public MotionSource {
public:
    /// It must outlive this.
    explicit WholeProgram(const Program& program)
        : program_(&program),
          outline_{program.motions.size(), !program.motions.arcs.empty() || !program.motions.curves.empty()} {}

    [[nodiscard]] const ProgramOutline& outline() const override { return outline_; }
    [[nodiscard]] bool next_piece() override { return !std::exchange(given_, true); }
    [[nodiscard]] const Program& program() const override { return *program_; }
    [[nodiscard]] std::int64_t piece_size() const override { return given_ ? outline_.motions : 0; }

private:
    const Program* program_;
    ProgramOutline outline_;
    bool given_ = false;
};

}  // namespace clsurf
