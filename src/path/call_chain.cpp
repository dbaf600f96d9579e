#include "path/call_chain.h"

#include <algorithm>
#include <cstdint>

#include "path/program_lines.h"
#include "path/toolpath.h"

namespace clsurf {

CallChains::CallChains(const Trajectory& path, const Log& log, const Program& program, const LineMap& lines)
    : path_(&path), log_(&log), program_(&program), lines_(&lines) {
    const Motions& motions = program.motions;
    if (motions.call.empty() || !lines.from_log()) return;
    std::vector<LineNumber> outermost(motions.calls.size() + 1, 0);
    for (std::size_t k = 0; k < motions.calls.size(); ++k) {
        const Call& call = motions.calls[k];
        outermost[k + 1] = call.caller == 0 ? call.line : outermost[call.caller];
    }
    by_line_.reserve(2 * motions.kind.size());
    for (std::size_t i = 0; i < motions.kind.size(); ++i) {
        by_line_.emplace_back(motions.line[i], static_cast<std::int64_t>(i));
        const LineNumber outer = outermost[motions.call[i]];
        if (outer != 0 && outer != motions.line[i]) by_line_.emplace_back(outer, static_cast<std::int64_t>(i));
    }
    std::sort(by_line_.begin(), by_line_.end());
}

std::int64_t CallChains::motion_of(PointIndex point) const {
    if (!lines_->from_log()) return lines_->motion_at(point);
    const LineNumber line = lines_->line_at(point);
    const Toolpath toolpath(program_->motions, path_->at(0));
    const Vec3 position = path_->at(point);
    std::int64_t nearest = -1;
    double least = 0;
    for (auto at = std::lower_bound(by_line_.begin(), by_line_.end(), std::pair(line, std::int64_t{0}));
         at != by_line_.end() && at->first == line; ++at) {
        const double distance = toolpath.foot(at->second, position).distance;
        if (nearest >= 0 && !(distance < least)) continue;
        nearest = at->second;
        least = distance;
    }
    return nearest;
}

ProgramPlace CallChains::place(std::size_t file, LineNumber line) const {
    const SourceText& text = program_->files[file];
    return {text.name(), line, std::string(text.line(line))};
}

CallChain CallChains::of(PointIndex point) const {
    CallChain chain;
    const Motions& motions = program_->motions;
    if (!motions.call.empty()) {
        if (const std::int64_t motion = motion_of(point); motion >= 0) {
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
