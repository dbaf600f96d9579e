#include "mapping/line_shifts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>

namespace clsurf {
namespace {

/// Records by which a line may lead the positions (a planner is ahead of its axes, and measured positions lag), or
/// follow them (negative). The shortest of each sign comes first.
constexpr std::array<std::int64_t, 19> leads{0, 1, -1, 2, -2, 3, -3, 4, -4, 5, 6, 8, -6, -8, 11, 15, 20, 26, 32};
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t lines_for_lead = 4096;
constexpr double shorter_lead = 1.0;       ///< additional cost that a longer lead must save
constexpr double lead_changes = 1.0;       ///< records
constexpr double slightly_off = 4.0;       ///< records that cost 1
constexpr double most_cost = 3.0;          ///< greatest cost of a line
constexpr double records_off = 28.0;       ///< records that have the highest cost: slightly_off · (2^most_cost − 1)
constexpr double near_cost = 1.0;          ///< cost of a line whose shift is tested
constexpr double explained_cost = 0.5;     ///< greatest cost of the lines of a section
constexpr double shift_cost = 5.0;         ///< cost of a shift: as much as two long lines that are clearly off
constexpr double most_doubt = 9.0;         ///< greatest doubt about a line end: three times its uncertainty, squared
constexpr std::size_t most_ends = 8;       ///< number of ends of one line that are evaluated
constexpr std::ptrdiff_t most_tries = 64;  ///< shifts suggested by one line end

/// The records at which the tool came to the ends of lines near a record.
class Arrivals {
public:
    Arrivals(const LineEnd& end, const Column<LineNumber>& found, std::int64_t lead)
        : blend_(end.blend),
          early_(static_cast<double>(lead) - lead_changes),
          late_(static_cast<double>(lead) + lead_changes + end.blend) {
        const auto count = static_cast<std::int64_t>(found.size());
        const auto at = [&](std::int64_t i) { return found[static_cast<std::size_t>(i)]; };
        const auto reach = [&](double records) { return end.record + static_cast<std::int64_t>(records); };
        const std::int64_t first = std::max<std::int64_t>(0, reach(std::min(0.0, std::floor(early_ - records_off))));
        const std::int64_t last = std::min(count - 1, reach(std::max(0.0, std::ceil(late_ + records_off))));
        std::int64_t known = std::min(end.record, count - 1);
        while (known >= first && at(known) == 0) --known;
        if (known < first) {
            known = end.record;
            while (known <= last && at(known) == 0) ++known;
        }
        if (known < first || known > last) return;
        std::int64_t behind = known;  // where the previous line was found
        for (std::int64_t i = known - 1; i >= first; --i) {
            if (at(i) == 0) continue;
            if (at(i) < at(behind)) {
                steps_.push_back(
                    {at(i), static_cast<double>(i + 1 - end.record), static_cast<double>(behind - end.record)});
            } else if (at(i) > at(behind)) {
                continue;
            }
            behind = i;
        }
        // Lower lines may have ended anywhere on a section off the path.
        if (at(first) == 0) steps_.push_back({0, -infinity, static_cast<double>(behind - end.record)});
        std::reverse(steps_.begin(), steps_.end());
        behind = known;
        for (std::int64_t i = known + 1; i <= last; ++i) {
            if (at(i) == 0 || at(i) < at(behind)) continue;
            if (at(i) > at(behind)) {
                steps_.push_back(
                    {at(behind), static_cast<double>(behind + 1 - end.record), static_cast<double>(i - end.record)});
            }
            behind = i;
        }
        end_ = at(behind);
        if (last + 1 < count && at(last) != 0) return;
        steps_.push_back({end_, static_cast<double>(behind + 1 - end.record), infinity});
        end_ = at(last) != 0 ? end_ + 1 : std::numeric_limits<LineNumber>::max();
    }

    [[nodiscard]] bool known() const { return end_ != 0; }

    /// The cost of the assumption that the reported line is this one, 0 … most_cost.
    [[nodiscard]] double cost(std::int64_t line) const {
        const Step* step = step_of(line);
        return step != nullptr ? cost_of(*step) : most_cost;
    }

    /// The distance of this line's end from its expected record with a lead, squared, in units of its uncertainty.
    [[nodiscard]] double doubt(std::int64_t line, double lead) const {
        const Step* step = step_of(line);
        if (step == nullptr) return most_doubt;
        const double middle = lead + blend_ / 2;
        const double off = (std::clamp(middle, step->first, step->last) - middle) / (lead_changes + blend_ / 2);
        return std::min(most_doubt, off * off);
    }

    /// Calls body(first, last) for the ranges of lines that the reported one may be.
    template <typename Body>
    void for_likely(const Body& body) const {
        for (std::size_t k = 0; k < steps_.size(); ++k) {
            if (steps_[k].line == 0 || cost_of(steps_[k]) > near_cost) continue;
            body(steps_[k].line, k + 1 < steps_.size() ? steps_[k + 1].line - 1 : end_ - 1);
        }
    }

private:
    /// The tool came to the end of this line, and of those up to the next step, between two records, relative to the
    /// end of the report. The records differ if it was off the path.
    struct Step {
        LineNumber line = 0;
        double first = 0, last = 0;
    };

    [[nodiscard]] const Step* step_of(std::int64_t line) const {
        if (steps_.empty() || line < steps_.front().line || line >= end_) return nullptr;
        const auto next = std::upper_bound(steps_.begin(), steps_.end(), line,
                                           [](std::int64_t l, const Step& s) { return l < std::int64_t{s.line}; });
        return &*std::prev(next);
    }
    [[nodiscard]] double cost_of(const Step& step) const {
        const double off = std::max({0.0, early_ - step.last, step.first - late_});
        return std::min(most_cost, std::log2(1 + off / slightly_off));
    }

    double blend_, early_, late_;
    std::vector<Step> steps_;
    LineNumber end_ = 0;  ///< beyond the last step, lines from here on are unknown
};

class ShiftSearch {
public:
    ShiftSearch(std::span<const LineEnd> ends, const Column<LineNumber>& found, std::span<const LineNumber> with_motion)
        : ends_(ends), found_(found), with_motion_(with_motion) {
        for (std::size_t i = 0; i < ends.size(); ++i) {
            if (i == 0 || ends[i].line != ends[i - 1].line) begins_.push_back(i);
        }
    }

    LineShifts find() {
        LineShifts best;
        if (begins_.empty()) return best;
        double least = infinity;
        for (const std::int64_t lead : leads) {
            const double cost = walk(lead, std::min(begins_.size(), lines_for_lead));
            if (cost > least - shorter_lead) continue;
            least = cost;
            best.lead = lead;
        }
        walk(best.lead, begins_.size());
        std::vector<Section> sections = sections_of_walk();
        join_deleted(sections, best.lead);
        for (std::size_t k = 1; k < sections.size(); ++k) place(sections, k, best.lead);
        for (const Section& s : sections) {
            if (&s != &sections.front()) best.sections.push_back({line_of(s.begin), s.shift});
        }
        best.lines = begins_.size();
        best.unexplained = unexplained(sections, best.lead);
        return best;
    }

private:
    /// The best shift that explains the lines up to this one.
    struct State {
        std::int64_t shift = 0;
        double cost = 0;
        std::size_t since = 0;
    };
    /// Lines with a common shift; indices count the reported lines.
    struct Section {
        std::size_t begin = 0;
        std::int64_t shift = 0;
    };

    [[nodiscard]] LineNumber line_of(std::size_t k) const { return ends_[begins_[k]].line; }

    [[nodiscard]] std::vector<Arrivals> arrivals_of(std::size_t k, std::int64_t lead) const {
        const std::size_t end = k + 1 < begins_.size() ? begins_[k + 1] : ends_.size();
        std::vector<Arrivals> all;
        for (std::size_t i = begins_[k]; i < std::min(end, begins_[k] + most_ends); ++i) {
            Arrivals arrivals(ends_[i], found_, lead);
            if (arrivals.known()) all.push_back(std::move(arrivals));
        }
        return all;
    }

    [[nodiscard]] bool moves(std::int64_t line) const {
        return line > 0 && std::binary_search(with_motion_.begin(), with_motion_.end(), line);
    }

    /// Mean over the executions of the line; 0 if nothing is known of them.
    template <typename Of>
    [[nodiscard]] double mean(const std::vector<Arrivals>& all, double without_motion, std::int64_t line,
                              const Of& of) const {
        if (all.empty()) return 0;
        if (!moves(line)) return without_motion;
        double sum = 0;
        for (const Arrivals& arrivals : all) sum += of(arrivals, line);
        return sum / static_cast<double>(all.size());
    }
    [[nodiscard]] double cost(const std::vector<Arrivals>& all, std::int64_t line) const {
        return mean(all, most_cost, line, [](const Arrivals& a, std::int64_t l) { return a.cost(l); });
    }

    /// The shifts of the first `count` lines with the least cost, line by line (Viterbi). Returns the cost; best_ gives
    /// the path back.
    double walk(std::int64_t lead, std::size_t count) {
        best_.assign(count, {});
        std::vector<State> states{State{}};
        State before;
        for (std::size_t k = 0; k < count; ++k) {
            const std::vector<Arrivals> arrivals = arrivals_of(k, lead);
            const std::int64_t line = line_of(k);
            for (State& s : states) s.cost += cost(arrivals, line + s.shift);
            for (const Arrivals& of_end : arrivals) {
                of_end.for_likely([&](LineNumber first, LineNumber last) {
                    const auto from = std::lower_bound(with_motion_.begin(), with_motion_.end(), first);
                    const auto to = std::upper_bound(from, with_motion_.end(), last);
                    for (auto at = from; at != to && at - from < most_tries; ++at) {
                        offer(states, {std::int64_t{*at} - line, before.cost + shift_cost + cost(arrivals, *at), k});
                    }
                });
            }
            before = *std::min_element(states.begin(), states.end(),
                                       [](const State& x, const State& y) { return x.cost < y.cost; });
            std::erase_if(states, [&](const State& s) { return s.cost > before.cost + shift_cost; });
            best_[k] = before;
        }
        return before.cost;
    }

    static void offer(std::vector<State>& states, const State& offered) {
        for (State& s : states) {
            if (s.shift != offered.shift) continue;
            if (offered.cost < s.cost) s = offered;
            return;
        }
        states.push_back(offered);
    }

    /// The first one is empty if the first lines are shifted.
    [[nodiscard]] std::vector<Section> sections_of_walk() const {
        std::vector<Section> sections;
        for (State state = best_.back();; state = best_[state.since - 1]) {
            sections.push_back({state.since, state.shift});
            if (state.since == 0) break;
        }
        if (sections.back().shift != 0) sections.push_back({0, 0});
        std::reverse(sections.begin(), sections.end());
        return sections;
    }

    /// Deleted lines may look like a separate section that fits badly. It is merged with the next one.
    void join_deleted(std::vector<Section>& sections, std::int64_t lead) const {
        for (std::size_t k = 1; k + 1 < sections.size();) {
            const Section& section = sections[k];
            const Section& next = sections[k + 1];
            const std::int64_t by = next.shift - sections[k - 1].shift;
            const bool deleted = section.shift < sections[k - 1].shift && next.shift < section.shift &&
                                 std::int64_t{line_of(section.begin)} >= std::int64_t{line_of(next.begin)} + by;
            double sum = 0;
            for (std::size_t i = section.begin; deleted && i < next.begin; ++i)
                sum += cost(arrivals_of(i, lead), std::int64_t{line_of(i)} + section.shift);
            if (deleted && sum > explained_cost * static_cast<double>(next.begin - section.begin))
                sections.erase(sections.begin() + static_cast<std::ptrdiff_t>(k));
            else
                ++k;
        }
    }

    /// Moves the beginning of a section to where the lines around it fit best. The lead is the one with which these lines fit
    /// best, because it changes with the speed. On both sides, lines are added until they clearly distinguish the two shifts.
    void place(std::vector<Section>& sections, std::size_t k, std::int64_t lead) const {
        const std::int64_t before = sections[k - 1].shift, after = sections[k].shift;
        const std::size_t least_first = sections[k - 1].begin + (k > 1 ? 1 : 0);
        const std::size_t last_end = k + 1 < sections.size() ? sections[k + 1].begin : begins_.size();
        std::deque<std::vector<Arrivals>> arrivals;
        std::size_t first = sections[k].begin, end = first;
        const auto evidence = [&](const std::vector<Arrivals>& of_line, std::size_t i) {
            return cost(of_line, std::int64_t{line_of(i)} + before) - cost(of_line, std::int64_t{line_of(i)} + after);
        };
        for (double sum = 0; first > least_first && sum > -shift_cost;) {
            arrivals.push_front(arrivals_of(--first, lead));
            sum += evidence(arrivals.front(), first);
        }
        for (double sum = 0; end < last_end && sum < shift_cost; ++end) {
            arrivals.push_back(arrivals_of(end, lead));
            sum += evidence(arrivals.back(), end);
        }
        double least = infinity;
        for (int half_records = -4; half_records <= 4; ++half_records) {
            place(sections, k, first, arrivals, static_cast<double>(lead) + half_records / 2.0, least);
        }
    }

    /// The same with one lead. Lines that were deleted before a section fit neither it nor the previous one, and their
    /// records may be off the path.
    void place(std::vector<Section>& sections, std::size_t k, std::size_t first,
               const std::deque<std::vector<Arrivals>>& arrivals, double lead, double& least) const {
        const std::int64_t by = sections[k].shift - sections[k - 1].shift;
        std::vector<double> before{0}, after{0};  // sums
        double usual = 0;
        for (std::size_t i = 0; i < arrivals.size(); ++i) {
            const auto doubt = [&](std::int64_t shift) {
                return mean(arrivals[i], most_doubt, std::int64_t{line_of(first + i)} + shift,
                            [&](const Arrivals& a, std::int64_t l) { return a.doubt(l, lead); });
            };
            const double as_before = doubt(sections[k - 1].shift), as_after = doubt(sections[k].shift);
            const double off = most_doubt * ends_[begins_[first + i]].off_path;
            before.push_back(before.back() + as_before + off);
            after.push_back(after.back() + as_after + off);
            usual += std::min(as_before, as_after);
        }
        usual /= static_cast<double>(arrivals.size());
        std::size_t deleted = 0;  // the first deleted line
        for (std::size_t at = 0; at < arrivals.size(); ++at) {
            while (deleted < at && std::int64_t{line_of(first + deleted)} < std::int64_t{line_of(first + at)} + by)
                ++deleted;
            if (by > 0) deleted = at;
            const double cost = before[deleted] + usual * static_cast<double>(at - deleted) + after.back() - after[at];
            if (cost >= least) continue;
            least = cost;
            sections[k].begin = first + at;
        }
    }

    [[nodiscard]] double unexplained(const std::vector<Section>& sections, std::int64_t lead) const {
        double sum = 0;
        std::size_t known = 0;
        for (std::size_t k = 0; k < sections.size(); ++k) {
            const std::size_t end = k + 1 < sections.size() ? sections[k + 1].begin : begins_.size();
            for (std::size_t i = sections[k].begin; i < end; ++i) {
                const std::vector<Arrivals> arrivals = arrivals_of(i, lead);
                if (arrivals.empty()) continue;
                ++known;
                sum += std::min(1.0, cost(arrivals, line_of(i) + sections[k].shift));
            }
        }
        return known > 0 ? sum / static_cast<double>(known) : 1.0;
    }

    std::span<const LineEnd> ends_;
    const Column<LineNumber>& found_;
    std::span<const LineNumber> with_motion_;
    std::vector<std::size_t> begins_;  ///< index in ends_ of each line's first end
    std::vector<State> best_;          ///< after each line
};

}  // namespace

LineShifts find_line_shifts(std::span<const LineEnd> ends, const Column<LineNumber>& found,
                            std::span<const LineNumber> with_motion) {
    return ShiftSearch(ends, found, with_motion).find();
}

}  // namespace clsurf
