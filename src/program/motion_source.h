#pragma once
// MotionSource: the motions of a program piece by piece, for a single pass over them. A program in memory is a single
// piece; one that is read during the pass (program_reader.h) is never in memory as a whole.

#include <cstdint>
#include <utility>

#include "program/program.h"

namespace clsurf {

/// Properties of a program as a whole, known before its first motion.
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
    /// Goes to the next piece (the first call: to the first); motions and events of the previous one are gone.
    /// Returns false if there is none. Throws InputError.
    [[nodiscard]] virtual bool next_piece() = 0;
    /// The program with the current piece: events, arcs and curves refer to motions by their index in it. The reference
    /// stays valid for all pieces.
    [[nodiscard]] virtual const Program& program() const = 0;
    /// Motions of the piece, 0 before the first; later motions of the program belong to the next piece and may still change.
    [[nodiscard]] virtual std::int64_t piece_size() const = 0;
};

/// A program in memory.
class WholeProgram final : public MotionSource {
public:
    /// The program must outlive this.
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
