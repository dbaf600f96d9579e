#include "program/program_reader.h"

#include <utility>

#include "program/interpret/interpreter_state.h"
#include "program/make_interpreter.h"

namespace clsurf {

ProgramReader::ProgramReader(const SourceText& text, const InterpreterOptions& options, std::int64_t piece)
    : interpreter_(make_interpreter(text, options)), piece_(piece) {
    read_piece();
    if (interpreter_->ended()) {
        first_is_read_ = true;
        return;
    }
    while (size_ > 0) read_piece();
    InterpreterOptions again = options;
    again.dialect = program().dialect;
    interpreter_ = make_interpreter(text, again);
}

ProgramReader::~ProgramReader() = default;

void ProgramReader::read_piece() {
    interpreter_->forget(size_);
    size_ = interpreter_->place_settled(interpreter_->read_on(piece_));
    outline_.motions += size_;
    outline_.curved = outline_.curved || !program().motions.arcs.empty() || !program().motions.curves.empty();
}

bool ProgramReader::next_piece() {
    if (!std::exchange(first_is_read_, false)) {
        interpreter_->forget(size_);
        size_ = interpreter_->place_settled(interpreter_->read_on(piece_));
    }
    return size_ > 0;
}

const Program& ProgramReader::program() const { return interpreter_->program(); }

}  // namespace clsurf
