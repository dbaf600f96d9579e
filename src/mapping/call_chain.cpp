#include "mapping/call_chain.h"

#include <algorithm>
#include <cstdint>

#include "mapping/program_lines.h"

namespace clsurf {

std::vector<PointRange> points_of(const Program& program, const LineMap& lines, std::size_t file, LineNumber line) {
    const Motions& motions = program.motions;
    std::vector<PointRange> ranges;
    for (PointIndex point = 0; point < lines.count(); ++point) {
        const std::int64_t motion = lines.motion_at(point);
        if (motion < 0) continue;
        const auto m = static_cast<std::size_t>(motion);
        if (motions.line[m] != line || (motions.file.empty() ? 0 : motions.file[m]) != file) continue;
        if (!ranges.empty() && ranges.back().last == point - 1)
            ranges.back().last = point;
        else
            ranges.push_back({point, point});
    }
    return ranges;
}

ProgramPlace CallChains::place(std::size_t file, LineNumber line) const {
    const SourceText& text = program_->files[file];
    return {text.name(), line, std::string(text.line(line))};
}

CallChain CallChains::of(PointIndex point) const {
    CallChain chain;
    const Motions& motions = program_->motions;
    if (!motions.call.empty()) {
        if (const std::int64_t motion = lines_->motion_at(point); motion >= 0) {
            const auto at = static_cast<std::size_t>(motion);
            for (std::uint32_t call = motions.call[at]; call != 0; call = motions.calls[call - 1].caller) {
                chain.calls.push_back(place(motions.calls[call - 1].file, motions.calls[call - 1].line));
            }
            std::reverse(chain.calls.begin(), chain.calls.end());
            if (!chain.calls.empty())
                chain.subprogram = place(motions.file.empty() ? 0 : motions.file[at], motions.line[at]);
        }
    }
    const Channel* index = log_->find("program");
    const Channel* line = log_->find("line");
    if (index == nullptr || line == nullptr || log_->programs.size() < 2) return chain;
    constexpr std::uint32_t none = 0xffffffffu;
    std::uint32_t number = none;
    std::uint32_t own_line = 0;
    copy_block(index->values, point, {&number, 1}, none);
    copy_block(line->values, point, {&own_line, 1}, 0);
    if (number >= log_->programs.size()) return chain;
    const std::string& name = log_->programs[number].name;
    if (plain_program_name(name) == plain_program_name(program_->main().name())) return {};
    ProgramPlace own{name, own_line, {}};
    for (const SourceText& file : program_->files) {
        if (plain_program_name(file.name()) == plain_program_name(name))
            own = {file.name(), own_line, std::string(file.line(own_line))};
    }
    chain.subprogram = std::move(own);
    if (const LineNumber caller = lines_->line_at(point); chain.calls.empty() && caller > 0)
        chain.calls.push_back(place(0, caller));
    return chain;
}

}  // namespace clsurf
