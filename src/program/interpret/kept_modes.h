#pragma once
// Modes that are saved and restored.

#include "program/interpret/modal_state.h"

namespace clsurf {

class Interpreter;

/// M70 … M73 of LinuxCNC: save and restore modes; M73 restores them when the subprogram returns.
void keep_modes(Interpreter& in, int code);
/// Restores the saved modes, with the events of the change.
void restore_modes(Interpreter& in, const ModalState& kept);

}  // namespace clsurf
