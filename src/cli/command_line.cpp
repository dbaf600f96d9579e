#include "cli/command_line.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <set>
#include <string_view>
#include <typeinfo>

#include "cli/options.h"
#include "cli/vocabulary.h"
#include "core/spelling.h"

namespace clsurf::cli {
namespace {

constexpr std::string_view repeats = "…";

std::string without_dashes(std::string name) {
    while (name.starts_with('-')) name.erase(0, 1);
    return name;
}

std::string quoted(std::string_view text) { return "'" + std::string(text) + "'"; }

template <typename Number>
bool is_number(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if constexpr (std::is_floating_point_v<Number>) {
        if (!std::isfinite(number)) return false;
    }
    return error == std::errc() && end == text.data() + text.size();
}

bool is_list(const std::type_info& type) {
    return type == typeid(std::vector<std::string>) || type == typeid(std::vector<double>) ||
           type == typeid(std::vector<int>) || type == typeid(std::vector<long>) ||
           type == typeid(std::vector<long long>);
}

// Checked here, so that the message does not speak of C++ and -1 never wraps into an unsigned.
void check_number(const std::string& option, const std::type_info& type, const std::string& text) {
    const bool whole = type == typeid(int) || type == typeid(long) || type == typeid(long long) ||
                       type == typeid(std::vector<int>) || type == typeid(std::vector<long>) ||
                       type == typeid(std::vector<long long>);
    const bool counted =
        type == typeid(unsigned) || type == typeid(unsigned long) || type == typeid(unsigned long long);
    const bool real = type == typeid(double) || type == typeid(float) || type == typeid(std::vector<double>);
    const bool good =
        (!whole || is_number<std::int64_t>(text)) && (type != typeid(int) || is_number<std::int32_t>(text)) &&
        (!counted || is_number<std::uint64_t>(text)) && (type != typeid(unsigned) || is_number<std::uint32_t>(text)) &&
        (!real || is_number<double>(text));
    if (good) return;
    throw UsageError("--" + option + ": " + quoted(text) +
                     (real      ? " is not a number"
                      : counted ? " is not a whole number from 0 on that fits"
                                : " is not a whole number that fits"));
}

void check_word(const std::string& option, const std::string& value_name, const std::string& text) {
    if (!lists_all_words(value_name)) return;
    const std::vector<std::string> words = words_of(value_name);
    std::string list;
    for (const std::string& word : words) {
        if (word == text) return;
        list += (list.empty() ? "" : ", ") + word;
    }
    const std::vector<std::string_view> views(words.begin(), words.end());
    throw UsageError("--" + option + ": " + quoted(text) + " is not one of " + list, did_you_mean(text, views));
}

// "--output --json" is a forgotten file name, not a file called --json. Numbers may be negative.
void check_taken(const po::option& option) {
    if (option.original_tokens.size() != 2) return;
    const std::string& value = option.original_tokens.back();
    if (value.size() < 2 || value[0] != '-') return;
    const bool number = (value[1] >= '0' && value[1] <= '9') || value[1] == '.';
    if (number) return;
    throw UsageError("--" + option.string_key + " needs a value, found " + quoted(value),
                     "if that is the value, write --" + option.string_key + "=" + value);
}

class Checker {
public:
    explicit Checker(const po::options_description& options) : options_(options) {}

    void check(const po::option& option) {
        if (option.unregistered) throw unknown(option);
        const std::string& name = option.string_key;
        const po::option_description& description = options_.find(name, false);
        const auto* typed = dynamic_cast<const po::typed_value_base*>(description.semantic().get());
        const bool may_repeat = typed != nullptr && is_list(typed->value_type());
        if (!seen_.insert(name).second && !may_repeat) { throw UsageError("--" + name + " is given more than once"); }
        if (typed == nullptr || option.value.empty()) return;
        check_taken(option);
        for (const std::string& text : option.value) {
            check_number(name, typed->value_type(), text);
            check_word(name, description.format_parameter(), text);
        }
    }

private:
    [[nodiscard]] UsageError unknown(const po::option& option) const {
        const std::string& token = option.original_tokens.front();
        const std::string name = token.substr(0, token.find('='));
        std::vector<std::string_view> known;
        for (const auto& other : options_.options()) known.push_back(other->long_name());
        const std::string_view nearest = nearest_word(without_dashes(name), known);
        return UsageError("unknown option " + quoted(name),
                          nearest.empty() ? "" : "did you mean --" + std::string(nearest) + "?");
    }

    const po::options_description& options_;
    std::set<std::string> seen_;
};

// Gives the words that are not options the names of the subcommand's arguments.
void name_arguments(const Subcommand& subcommand, std::vector<po::option>& words) {
    std::size_t next = 0;
    for (po::option& word : words) {
        if (word.position_key < 0) continue;
        if (next >= subcommand.positional.size()) {
            throw UsageError(
                "unexpected argument " + quoted(word.original_tokens.front()),
                "usage: clsurf " + std::string(subcommand.name) + " [options] " + std::string(subcommand.arguments));
        }
        std::string name = subcommand.positional[next];
        if (name.ends_with(repeats)) {
            name.erase(name.size() - repeats.size());
        } else {
            ++next;
        }
        word.string_key = name;
    }
}

void declare_arguments(const Subcommand& subcommand, po::options_description& options) {
    for (const std::string& name : subcommand.positional) {
        if (name.ends_with(repeats)) {
            options.add_options()(name.substr(0, name.size() - repeats.size()).c_str(),
                                  po::value<std::vector<std::string>>());
        } else {
            options.add_options()(name.c_str(), po::value<std::string>());
        }
    }
}

}  // namespace

ShownOptions shown_options(const Subcommand& subcommand) {
    ShownOptions shown;
    subcommand.declare(shown.own);
    declare_common(shown.common);
    return shown;
}

po::variables_map parse_words(const Subcommand& subcommand, const std::vector<std::string>& words) {
    const ShownOptions shown = shown_options(subcommand);
    po::options_description options;
    options.add(shown.own).add(shown.common);

    // Guessing from prefixes is off: a later option must not change what a script means.
    const int style = po::command_line_style::default_style & ~po::command_line_style::allow_guessing;
    po::parsed_options parsed = po::command_line_parser(words).options(options).style(style).allow_unregistered().run();
    Checker checker(options);
    for (const po::option& option : parsed.options) {
        if (option.position_key < 0) checker.check(option);
    }
    name_arguments(subcommand, parsed.options);

    po::options_description all;
    all.add(options);
    declare_arguments(subcommand, all);
    parsed.description = &all;
    po::variables_map values;
    po::store(parsed, values);
    po::notify(values);
    return values;
}

UsageError to_usage_error(const po::error& error) {
    const auto* syntax = dynamic_cast<const po::invalid_syntax*>(&error);
    if (syntax == nullptr) return UsageError(error.what());
    const std::string option = syntax->get_option_name();
    switch (syntax->kind()) {
        case po::invalid_syntax::missing_parameter:
        case po::invalid_syntax::empty_adjacent_parameter: return UsageError(option + " needs a value");
        case po::invalid_syntax::extra_parameter: return UsageError(option + " takes no value");
        default: return UsageError(error.what());
    }
}

}  // namespace clsurf::cli
