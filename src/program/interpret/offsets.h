#pragma once
// Work systems, G92 and reference points.

#include "program/interpret/block_state.h"
#include "program/interpret/modal_state.h"
#include "program/text/block.h"

namespace clsurf {

class Interpreter;

/// G10: a work offset; with another level a row of the tool table.
void set_offsets(Interpreter& in, const Block& block);
/// G92 and G52.
void shift_position(Interpreter& in, const Block& block);
/// G92.1 deletes the shift, G92.2 keeps it for G92.3.
void restore_shift(ModalState& state, int code);
void select_work_system(Interpreter& in, int number);
/// G28.1, G30.1: the current machine position becomes the reference point.
void keep_reference(ModalState& state, BlockFlags& flags, int code);
/// G28, G30: through the point that the words give.
void approach_reference(Interpreter& in, int code, const Block& block);

}  // namespace clsurf
