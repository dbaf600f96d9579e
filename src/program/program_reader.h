#pragma once
// ProgramReader: interprets a program while its motions are read, in the memory of a piece.
//
// Positions are those of the machine, with unknown work offsets taken as zero (frame_placement.h).
//
// Some memory still grows with the program: the positions of its lines (an eighth of a byte a line), of labels, loops and
// block numbers if it jumps, its variables, and the calling lines of subprograms. If a later line may still move the end
// of a motion (cutter compensation), the motion is held back until then, which takes a block or two.

#include <memory>

#include "program/interpreter.h"
#include "program/motion_source.h"

namespace clsurf {

class Interpreter;

class ProgramReader final : public MotionSource {
public:
    /// Motions of a piece; the last line may add more. A program that fits one piece is read once, a longer one
    /// twice: its outline first.
    static constexpr std::int64_t usual_piece = 1 << 18;

    /// Throws what parse_program() throws, because it reads the whole program. O(executed blocks).
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
    bool first_is_read_ = false;  ///< and not yet returned by next_piece()
    ProgramOutline outline_;
};

}  // namespace clsurf
