#include "cli/command_line.h"

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

#include "cli/options/config.h"
#include "cli/options/option_rows.h"
#include "cli/options/option_value.h"
#include "cli/options/used_config.h"
#include "core/spelling.h"

namespace clsurf::cli {
namespace {

constexpr std::string_view repeats = "…";

std::string without_dashes(std::string name) {
    while (name.starts_with('-')) name.erase(0, 1);
    return name;
}

std::string quoted(std::string_view text) { return "'" + std::string(text) + "'"; }

// "--output --json" is a forgotten file name, not a file with the name --json. Numbers may be negative.
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
        const bool may_repeat = typed != nullptr && takes_a_list(*typed);
        if (!seen_.insert(name).second && !may_repeat) { throw UsageError("--" + name + " is given more than once"); }
        if (typed == nullptr || option.value.empty()) return;
        check_taken(option);
        check_option(option, description);
    }

private:
    [[nodiscard]] UsageError unknown(const po::option& option) const {
        const std::string& token = option.original_tokens.front();
        const std::string name = token.substr(0, token.find('='));
        if (is_a_number(token))
            return UsageError("a value " + quoted(token) + " without its option",
                              "the numbers of one value are separated by commas: --at 2,-5.6,4.7");
        std::vector<std::string_view> known;
        for (const auto& other : options_.options()) known.push_back(other->long_name());
        const std::string_view nearest = nearest_word(without_dashes(name), known);
        return UsageError("unknown option " + quoted(name),
                          nearest.empty() ? "" : "did you mean --" + std::string(nearest) + "?");
    }

    const po::options_description& options_;
    std::set<std::string> seen_;
};

// Names that users try, and the options that they mean, if the subcommand has no option of that name.
constexpr std::pair<std::string_view, std::string_view> other_names[] = {
    {"field", "color"},   {"field", "fields"},       {"fields", "columns"},      {"colour", "color"},
    {"cmap", "colormap"}, {"color-map", "colormap"}, {"colour-map", "colormap"}, {"colourmap", "colormap"},
    {"out", "output"},    {"outfile", "output"},     {"resolution", "size"},     {"offset", "work-offset"},
};

// "cmap" of "--cmap=gray"; empty: the word is not a long option.
std::string name_of_long_option(const std::string& word) {
    if (!word.starts_with("--")) return {};
    return {word.begin() + 2, std::find(word.begin() + 2, word.end(), '=')};
}

// "--cmap=gray" becomes "--colormap=gray".
std::vector<std::string> with_known_names(std::vector<std::string> words, const po::options_description& options) {
    const auto has = [&](std::string_view name) { return options.find_nothrow(std::string(name), false) != nullptr; };
    for (std::string& word : words) {
        if (word == "--") break;
        const std::string name = name_of_long_option(word);
        if (name.empty() || has(name)) continue;
        for (const auto& [other, known] : other_names) {
            if (other != name || !has(known)) continue;
            word = "--" + std::string(known) + word.substr(2 + name.size());
            break;
        }
    }
    return words;
}

// "--at 2 -5.6 4.7" becomes "--at 2,-5.6,4.7": as many numbers as "X,Y,Z" has.
std::vector<std::string> join_numbers(const std::vector<std::string>& words, const po::options_description& options) {
    std::vector<std::string> joined;
    for (std::size_t i = 0; i < words.size(); ++i) {
        joined.push_back(words[i]);
        if (words[i] == "--") {
            joined.insert(joined.end(), words.begin() + static_cast<std::ptrdiff_t>(i) + 1, words.end());
            break;
        }
        const std::string name = name_of_long_option(words[i]);
        const bool alone = !name.empty() && words[i].size() == name.size() + 2;
        const po::option_description* option = alone ? options.find_nothrow(name, false) : nullptr;
        if (option == nullptr || option->semantic()->max_tokens() == 0) continue;
        const std::string value_name = option->format_parameter();
        const auto commas = std::count(value_name.begin(), value_name.end(), ',');
        std::string value;
        for (std::ptrdiff_t k = 0; k <= commas && i + 1 < words.size() && is_a_number(words[i + 1]); ++k, ++i)
            value += (value.empty() ? "" : ",") + words[i + 1];
        if (!value.empty()) joined.push_back(value);
    }
    return joined;
}

bool is_subcommand(const std::string& word) {
    return std::any_of(subcommands().begin(), subcommands().end(),
                       [&](const Subcommand& subcommand) { return subcommand.name == word; });
}

// Gives words that are not options the names of the subcommand's arguments.
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

// The words that are not options, in order.
std::vector<std::string> argument_values(const Subcommand& subcommand, const po::variables_map& values) {
    std::vector<std::string> all;
    for (std::string name : subcommand.positional) {
        const bool several = name.ends_with(repeats);
        if (several) name.erase(name.size() - repeats.size());
        if (values.count(name) == 0) continue;
        if (several) {
            const auto& list = values[name].as<std::vector<std::string>>();
            all.insert(all.end(), list.begin(), list.end());
        } else {
            all.push_back(values[name].as<std::string>());
        }
    }
    return all;
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

std::vector<std::string> subcommand_first(std::vector<std::string> words) {
    if (!words.front().starts_with('-')) return words;
    const auto found = std::find_if(words.begin(), words.end(), is_subcommand);
    if (found == words.end())
        throw UsageError("expected a subcommand, found '" + words.front() + "'", "see clsurf --help");
    std::rotate(words.begin(), found, found + 1);
    return words;
}

po::variables_map parse_words(const Subcommand& subcommand, const std::vector<std::string>& given_words) {
    const ShownOptions shown = shown_options(subcommand);
    po::options_description options;
    options.add(shown.own).add(shown.common);
    const std::vector<std::string> words = join_numbers(with_known_names(given_words, options), options);

    // Abbreviations are off: an option that is added later must not change the meaning of a script.
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
    if (values.count("no-config") == 0 && values.count("help") == 0) {
        const std::string config = find_config(argument_values(subcommand, values), values);
        if (!config.empty()) used_config() = store_config(config, options, values);
    }
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
