#pragma once
// Modes that are kept and come back.

#include "program/interpret/modal_state.h"

namespace clsurf {

class Interpreter;

/// M70 … M73 of LinuxCNC: modes are kept and come back; after M73 when the subprogram returns.
void keep_modes(Interpreter& in, int code);
/// The modes that were kept, and the events that they make.
void restore_modes(Interpreter& in, const ModalState& kept);

}  // namespace clsurf
