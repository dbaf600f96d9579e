#include "mapping/program_lines.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace clsurf {
namespace {

std::string list_names(const Log& log) {
    constexpr std::size_t most = 5;
    std::string names;
    for (std::size_t i = 0; i < std::min(most, log.programs.size()); ++i)
        names += (i > 0 ? ", " : "") + log.programs[i].name;
    return log.programs.size() > most ? names + ", …" : names;
}

}  // namespace

std::string plain_program_name(std::string_view path) {
    const std::size_t slash = path.find_last_of("/\\");
    if (slash != std::string_view::npos) path.remove_prefix(slash + 1);
    std::string name(path);
    std::transform(name.begin(), name.end(), name.begin(),
                   [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
    if (name.starts_with("_N_"))
        name.erase(0, 3);
    else if (name.starts_with('_'))
        name.erase(0, 1);
    for (const std::string_view ending : {"_MPF", "_SPF"}) {
        if (name.ends_with(ending)) name.resize(name.size() - ending.size());
    }
    if (const std::size_t dot = name.rfind('.'); dot != std::string::npos && dot > 0) name.resize(dot);
    return name;
}

ProgramLines lines_of_program(const Log& log, const Program& program, Diagnostics& diagnostics) {
    const Channel* line = log.find("line");
    const Channel* index = log.find("program");
    if (line == nullptr || index == nullptr || log.programs.size() < 2) return {};
    const std::string wanted = plain_program_name(program.main().name());
    std::vector<char> is_wanted(log.programs.size(), 0);
    for (std::size_t i = 0; i < log.programs.size(); ++i)
        is_wanted[i] = plain_program_name(log.programs[i].name) == wanted ? 1 : 0;
    if (std::find(is_wanted.begin(), is_wanted.end(), 1) == is_wanted.end()) {
        diagnostics.add({Severity::warning, "map.program", Place::of_file(log.name),
                         fmt::format("the log names {}; none of them is {}, so its lines are found by geometry",
                                     list_names(log), program.main().name()),
                         "give the program the name that it has on the control"});
        return {nullptr, false};
    }
    auto lines = std::make_shared<Column<LineNumber>>(static_cast<std::size_t>(log.records));
    std::array<LineNumber, 4096> numbers;
    std::array<std::uint32_t, 4096> programs;
    constexpr std::uint32_t none = 0xffffffffu;
    LineNumber last = 0;
    for (PointIndex begin = 0; begin < log.records; begin += static_cast<PointIndex>(numbers.size())) {
        const auto n = static_cast<std::size_t>(
            std::min<PointIndex>(static_cast<PointIndex>(numbers.size()), log.records - begin));
        copy_block(line->values, begin, {numbers.data(), n}, 0);
        copy_block(index->values, begin, {programs.data(), n}, none);
        for (std::size_t i = 0; i < n; ++i) {
            if (programs[i] < is_wanted.size() && is_wanted[programs[i]] != 0) last = numbers[i];
            (*lines)[static_cast<std::size_t>(begin) + i] = last;
        }
    }
    return {lines, true};
}

}  // namespace clsurf
