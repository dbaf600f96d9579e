#pragma once
// Variables of NC programs: `#1`, `#<name>`, `R1`, `Q1`, declared names.

#include <functional>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace clsurf {

/// Values of variables. Local ones belong to a call of a subprogram.
class Variables {
public:
    /// `system(n)` gives parameters that the controller keeps (positions, offsets); NaN: none.
    using System = std::function<double(int number)>;

    /// The same for names: "_x", "_metric"; NaN: none.
    using NamedSystem = std::function<double(const std::string& name)>;

    /// Writes a parameter that the controller keeps; false: it is an ordinary variable.
    using Writer = std::function<bool(int number, double value)>;

    explicit Variables(System system, NamedSystem named_system = {}, Writer writer = {})
        : system_(std::move(system)), named_system_(std::move(named_system)), writer_(std::move(writer)) {
        push_locals();
    }

    /// A numbered variable; 0 if it was never set.
    [[nodiscard]] double get(int number) const;
    void set(int number, double value);
    [[nodiscard]] bool has(int number) const;
    /// Makes it vacant, as if never set.
    void forget(int number);
    /// nullopt if it was never set and the controller does not keep it.
    [[nodiscard]] std::optional<double> number(int number) const;

    /// A named variable ("_x" and other names that begin with an underscore are global in RS274).
    [[nodiscard]] const double* find(const std::string& name) const;
    /// The same, or a variable that the controller keeps under that name.
    [[nodiscard]] std::optional<double> read(const std::string& name) const;
    void set(const std::string& name, double value);

    /// A new set of local variables (#1 … #33 and local names) for a call.
    void push_locals();
    void pop_locals();
    [[nodiscard]] std::size_t depth() const { return locals_.size(); }

private:
    struct Locals {
        std::unordered_map<int, double> numbers;
        std::unordered_map<std::string, double> names;
    };
    static bool is_local(int number) { return number >= 1 && number <= 33; }

    System system_;
    NamedSystem named_system_;
    Writer writer_;
    std::vector<Locals> locals_;
    std::unordered_map<int, double> numbers_;
    std::unordered_map<std::string, double> names_;
};

}  // namespace clsurf
