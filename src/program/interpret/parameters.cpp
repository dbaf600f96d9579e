// Parameters that the controller keeps: positions, offsets, modes, by number and by name. Which there are, the
// dialect knows.

#include "core/not_finite.h"
#include "program/interpret/interpreter_state.h"

namespace clsurf {

double Interpreter::parameter(int number) {
    return rules_->parameter == nullptr ? missing<double> : rules_->parameter(*this, number);
}

double Interpreter::named_parameter(const std::string& name) {
    return rules_->named_parameter == nullptr ? missing<double> : rules_->named_parameter(*this, name);
}

bool Interpreter::write_parameter(int number, double value) {
    return rules_->write_parameter != nullptr && rules_->write_parameter(*this, number, value);
}

}  // namespace clsurf
