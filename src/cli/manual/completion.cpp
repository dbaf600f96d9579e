#include "cli/manual/completion.h"

#include <fmt/format.h>

#include "cli/options/option_rows.h"
#include "cli/options/vocabulary.h"
#include "core/version.h"

namespace clsurf::cli {
namespace {

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
}

/// The completions of an option: words, file names, or nothing.
std::string bash_value_case(const std::string& subcommand, const OptionRow& row) {
    std::string patterns = fmt::format("{}:{}", subcommand, row.long_name);
    if (!row.short_name.empty()) patterns += fmt::format("|{}:{}", subcommand, row.short_name);
    const std::vector<std::string> words = words_of(row.value_name);
    if (!words.empty()) return fmt::format("        {}) words=\"{}\" ;;\n", patterns, joined(words));
    return fmt::format("        {}) {} ;;\n", patterns, names_a_file(row.value_name) ? "files=1" : "return");
}

/// The arguments of `clsurf help`.
std::vector<std::string> help_topics() {
    std::vector<std::string> topics;
    for (const Subcommand* subcommand : shown_subcommands()) topics.emplace_back(subcommand->name);
    for (const Vocabulary& vocabulary : vocabularies()) topics.emplace_back(vocabulary.name);
    return topics;
}

/// Text in single quotes, without characters that are special to the shell.
std::string in_quotes(std::string_view text, std::string_view removed) {
    std::string quoted = "'";
    for (const char c : text) {
        if (c != '\'' && removed.find(c) == std::string_view::npos) quoted += c;
    }
    return quoted + "'";
}

/// One option in the syntax of `_arguments`.
std::string zsh_option(const OptionRow& row) {
    const std::string what = in_quotes(row.description, "[]:");
    const std::string description = "[" + what.substr(1, what.size() - 2) + "]";
    std::string value;
    if (!row.value_name.empty()) {
        const std::vector<std::string> words = words_of(row.value_name);
        value = ":value:" + (!words.empty()                 ? "(" + joined(words) + ")"
                             : names_a_file(row.value_name) ? "_files"
                                                            : " ");
    }
    const char* const equals = value.empty() ? "" : "=";
    if (row.short_name.empty()) return fmt::format("'{}{}{}{}'", row.long_name, equals, description, value);
    return fmt::format("'({0} {1})'{{{0},{1}{2}}}'{3}{4}'", row.short_name, row.long_name, equals, description, value);
}

}  // namespace

std::string bash_completion() {
    std::string names;
    std::string values;
    std::string options;
    for (const Subcommand* subcommand : shown_subcommands()) {
        const std::string name(subcommand->name);
        names += (names.empty() ? "" : " ") + name;
        std::string all;
        for (const OptionRow& row : all_rows(*subcommand)) {
            all += (all.empty() ? "" : " ") + row.long_name;
            if (!row.value_name.empty()) values += bash_value_case(name, row);
        }
        options += fmt::format("        {}) words=\"{}\" ;;\n", name, all);
    }
    std::string topics = names;
    for (const Vocabulary& vocabulary : vocabularies()) topics += fmt::format(" {}", vocabulary.name);
    return fmt::format(R"(# bash completion for clsurf {version}; written by `clsurf manual bash`
_clsurf() {{
    local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}}
    local subcommand=${{COMP_WORDS[1]}} words="" files=""
    COMPREPLY=()
    # Bash parts --option=value into three words.
    if [[ $current == "=" ]]; then current=""
    elif [[ $previous == "=" ]]; then previous=${{COMP_WORDS[COMP_CWORD-2]}}
    fi
    if [[ $COMP_CWORD -eq 1 ]]; then
        COMPREPLY=($(compgen -W "{names} --help --version" -- "$current"))
        return
    fi
    case $subcommand:$previous in
{values}    esac
    if [[ -z $words$files ]]; then
        if [[ $current == -* ]]; then
            case $subcommand in
{options}            esac
        elif [[ $subcommand == help ]]; then words="{topics}"
        else files=1
        fi
    fi
    if [[ -n $files ]]; then
        compopt -o filenames
        local IFS=$'\n'
        COMPREPLY=($(compgen -f -- "$current"))
    else
        COMPREPLY=($(compgen -W "$words" -- "$current"))
    fi
}}
complete -F _clsurf clsurf
)",
                       fmt::arg("version", version), fmt::arg("names", names), fmt::arg("values", values),
                       fmt::arg("options", options), fmt::arg("topics", topics));
}

std::string zsh_completion() {
    std::string names;
    std::string cases;
    for (const Subcommand* subcommand : shown_subcommands()) {
        names +=
            fmt::format("        {}\n", in_quotes(fmt::format("{}:{}", subcommand->name, subcommand->summary), ""));
        cases += fmt::format("        {})\n            _arguments -S", subcommand->name);
        for (const OptionRow& row : all_rows(*subcommand)) cases += " \\\n                " + zsh_option(row);
        cases += subcommand->name == "help"
                     ? fmt::format(" \\\n                '*:topic:({})' ;;\n", joined(help_topics()))
                     : std::string(" \\\n                '*:file:_files' ;;\n");
    }
    return fmt::format(R"(#compdef clsurf
# zsh completion for clsurf {version}; written by `clsurf manual zsh`
_clsurf() {{
    local -a subcommands
    subcommands=(
{names}    )
    if (( CURRENT == 2 )); then
        _describe subcommand subcommands
        _arguments '--help[show the subcommands]' '--version[show the version]'
        return
    fi
    local subcommand=$words[2]
    shift words
    (( CURRENT-- ))
    case $subcommand in
{cases}    esac
}}
if [[ $funcstack[1] == _clsurf ]]; then _clsurf "$@"; else compdef _clsurf clsurf; fi
)",
                       fmt::arg("version", version), fmt::arg("names", names), fmt::arg("cases", cases));
}

std::string fish_completion() {
    std::string text = fmt::format("# fish completion for clsurf {}; written by `clsurf manual fish`\n", version);
    text += "complete -c clsurf -n __fish_use_subcommand -f -l help -d 'show the subcommands'\n";
    text += "complete -c clsurf -n __fish_use_subcommand -f -l version -d 'show the version'\n";
    for (const Subcommand* subcommand : shown_subcommands()) {
        text += fmt::format("complete -c clsurf -n __fish_use_subcommand -f -a {} -d {}\n", subcommand->name,
                            in_quotes(subcommand->summary, "\\"));
        const std::string here =
            fmt::format("complete -c clsurf -n '__fish_seen_subcommand_from {}'", subcommand->name);
        for (const OptionRow& row : all_rows(*subcommand)) {
            text += fmt::format("{} -l {}", here, row.long_name.substr(2));
            if (!row.short_name.empty()) text += fmt::format(" -s {}", row.short_name.substr(1));
            const std::vector<std::string> words = words_of(row.value_name);
            if (!words.empty()) {
                text += fmt::format(" -x -a '{}'", joined(words));
            } else if (!row.value_name.empty()) {
                text += names_a_file(row.value_name) ? " -r -F" : " -x";
            }
            text += fmt::format(" -d {}\n", in_quotes(row.description, "\\"));
        }
    }
    text += fmt::format("complete -c clsurf -n '__fish_seen_subcommand_from help' -f -a '{}'\n", joined(help_topics()));
    return text;
}

}  // namespace clsurf::cli
