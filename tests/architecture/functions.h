#pragma once
// Where the functions of a C++ text begin and end, by its braces: the text before an opening brace outside of any
// function decides whether it opens a namespace, a type, a value or a function.

#include <string>
#include <vector>

#include "architecture/sources.h"

namespace clsurf::test {

struct FunctionPlace {
    std::string name;  // the word before the first parenthesis: "push"
    std::size_t first_line = 0, last_line = 0;
    [[nodiscard]] std::size_t lines() const { return last_line - first_line + 1; }
};

class FunctionFinder {
public:
    explicit FunctionFinder(const std::string& text) : code_(part(text).code) {}

    std::vector<FunctionPlace> find() {
        for (at_ = 0; at_ < code_.size(); ++at_) step(code_[at_]);
        return std::move(found_);
    }

private:
    enum class Scope { open, function, value };

    void step(char c) {
        if (c == '\n') {
            ++line_;
            if (inside() == Scope::open && statement_.find_first_not_of(' ') == 0 && statement_[0] == '#') {
                if (at_ == 0 || code_[at_ - 1] != '\\') end_statement();
            } else if (!statement_.empty()) {
                statement_ += ' ';
            }
            return;
        }
        if (c == '{') return open();
        if (c == '}') return close();
        if (inside() != Scope::open) return;
        if (c == '(') ++parentheses_;
        if (c == ')') --parentheses_;
        if (c == ';' && parentheses_ == 0) return end_statement();
        if (statement_.empty()) {
            if (std::isspace(static_cast<unsigned char>(c)) != 0) return;
            begin_ = line_;
        }
        statement_ += c;
    }

    void open() {
        if (inside() == Scope::function || inside() == Scope::value) {
            scopes_.push_back(Scope::value);
            return;
        }
        const Scope scope = kind();
        if (scope == Scope::function) found_.push_back({name(), begin_, 0});
        scopes_.push_back(scope);
        if (scope == Scope::open) end_statement();
    }

    void close() {
        if (scopes_.empty()) return;
        const Scope scope = scopes_.back();
        scopes_.pop_back();
        if (scope == Scope::function) {
            found_.back().last_line = line_;
            end_statement();
        } else if (inside() == Scope::open) {
            scope == Scope::open ? end_statement() : void(statement_ += '}');
        }
    }

    [[nodiscard]] Scope inside() const { return scopes_.empty() ? Scope::open : scopes_.back(); }

    void end_statement() {
        statement_.clear();
        parentheses_ = 0;
    }

    [[nodiscard]] bool has_word(const std::string& word) const {
        const std::string text = " " + statement_.substr(0, statement_.find('(')) + " ";
        return text.find(" " + word + " ") != std::string::npos;
    }

    [[nodiscard]] Scope kind() const {
        if (parentheses_ > 0 || statement_.starts_with('#')) return Scope::value;
        const bool called = statement_.find('(') != std::string::npos;
        const bool type = has_word("class") || has_word("struct") || has_word("union") || has_word("enum");
        if (has_word("namespace") || statement_.starts_with("extern")) return called ? Scope::function : Scope::open;
        const std::size_t assigned = assignment();
        if (assigned != std::string::npos) {  // a lambda, or a value
            const std::size_t value = statement_.find_first_not_of(' ', assigned + 1);
            return value != std::string::npos && statement_[value] == '[' ? Scope::function : Scope::value;
        }
        if (!called) return type ? Scope::open : Scope::value;
        if (type && statement_.find(')') == std::string::npos) return Scope::open;
        // A member's initial value: a(…), b{…} after the colon of a constructor.
        const std::size_t colon = statement_.find(") :");
        const std::size_t last = statement_.find_last_not_of(' ');
        const bool member = std::isalnum(static_cast<unsigned char>(statement_[last])) != 0 ||
                            statement_[last] == '_' || statement_[last] == '>';
        return colon != std::string::npos && member ? Scope::value : Scope::function;
    }

    /// The position of an assignment outside parentheses, except in the name of an operator.
    [[nodiscard]] std::size_t assignment() const {
        if (statement_.find("operator") != std::string::npos) return std::string::npos;
        int depth = 0;
        int angles = 0;
        for (std::size_t i = 0; i < statement_.size(); ++i) {
            const char c = statement_[i];
            depth += c == '(' ? 1 : c == ')' ? -1 : 0;
            angles += c == '<' ? 1 : c == '>' ? -1 : 0;
            if (c == '=' && depth == 0 && angles == 0) return i;
        }
        return std::string::npos;
    }

    [[nodiscard]] std::string name() const {
        const std::size_t open = statement_.find('(');
        const std::size_t last = statement_.find_last_not_of(' ', open == std::string::npos ? open : open - 1);
        const auto is_name = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
        std::size_t first = last;
        while (first > 0 && is_name(statement_[first - 1])) --first;
        std::string found = statement_.substr(first, last - first + 1);
        if (found.starts_with("TEST")) found = statement_.substr(open, statement_.find(')') - open + 1);
        return found;
    }

    std::string code_;
    std::size_t at_ = 0, line_ = 1, begin_ = 1;
    int parentheses_ = 0;
    std::string statement_;
    std::vector<Scope> scopes_;
    std::vector<FunctionPlace> found_;
};

inline std::vector<FunctionPlace> functions_of(const std::string& text) { return FunctionFinder(text).find(); }

}  // namespace clsurf::test
