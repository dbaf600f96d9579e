#include "program/text/variables.h"

#include <cmath>

namespace clsurf {

double Variables::get(int number) const { return this->number(number).value_or(0.0); }

std::optional<double> Variables::number(int number) const {
    if (!is_local(number) && system_) {
        const double value = system_(number);
        if (value == value) return value;
    }
    const auto& numbers = is_local(number) ? locals_.back().numbers : numbers_;
    const auto found = numbers.find(number);
    return found == numbers.end() ? std::nullopt : std::optional(found->second);
}

void Variables::forget(int number) { (is_local(number) ? locals_.back().numbers : numbers_).erase(number); }

void Variables::set(int number, double value) {
    if (!is_local(number) && writer_ && writer_(number, value)) return;
    (is_local(number) ? locals_.back().numbers : numbers_)[number] = value;
}

bool Variables::has(int number) const {
    return is_local(number) ? locals_.back().numbers.contains(number) : numbers_.contains(number);
}

const double* Variables::find(const std::string& name) const {
    const auto& names = name.starts_with('_') ? names_ : locals_.back().names;
    const auto found = names.find(name);
    if (found != names.end()) return &found->second;
    // Names declared in a main program are visible in its subprograms if the dialect has it so.
    const auto global = names_.find(name);
    return global == names_.end() ? nullptr : &global->second;
}

std::optional<double> Variables::read(const std::string& name) const {
    if (const double* found = find(name)) return *found;
    if (!named_system_) return std::nullopt;
    const double value = named_system_(name);
    return std::isnan(value) ? std::nullopt : std::optional(value);
}

void Variables::set(const std::string& name, double value) {
    (name.starts_with('_') ? names_ : locals_.back().names)[name] = value;
}

void Variables::push_locals() { locals_.emplace_back(); }
void Variables::pop_locals() { locals_.pop_back(); }

}  // namespace clsurf
