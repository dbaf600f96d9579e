#pragma once
// ProgramReader: interprets a program while its motions are gone through, in the memory of a piece.
//
// Positions are those of the machine, unknown work offsets taken as zero (frame_placement.h).
//
// What grows with the program all the same: the places of its lines (an eighth of a byte a line), of labels,
// loops and block numbers where it jumps, its variables, and the places that call subprograms. The ends of motions that a
// later line may still move (cutter compensation) wait for it, which takes a block or two.

#include <memory>

#include "program/interpreter.h"
#include "program/motion_source.h"

namespace clsurf {

class Interpreter;

class ProgramReader final : public MotionSource {
public:
    /// Motions of a piece, and what the last of its lines makes besides. A program of no more is read
    /// once, a longer one twice: its outline first.
    static constexpr std::int64_t usual_piece = 1 << 18;

    /// Throws what parse_program() throws: all of the program has been read then. O(blocks carried out).
    ProgramReader(const SourceText& text, const InterpreterOptions& options, std::int64_t piece = usual_piece);
    ~ProgramReader() override;

    [[nodiscard]] const ProgramOutline& outline() const override { return outline_; }
    [[nodiscard]] bool next_piece() override;
    [[nodiscard]] const Program& program() const override;
    [[nodiscard]] std::int64_t piece_size() const override { return first_is_read_ ? 0 : size_; }

private:
    void read_piece();

    std::unique_ptr<Interpreter> interpreter_;
    std::int64_t piece_, size_ = 0;
    bool first_is_read_ = false;  ///< and not yet gone to
    ProgramOutline outline_;
};

}  // namespace clsurf
