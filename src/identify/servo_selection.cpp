#include "identify/servo_selection.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>

namespace clsurf {
namespace {

constexpr double needless = 10;  ///< a term of no certain value must lower the criterion by more
constexpr std::array optional_terms{ServoTerm::friction, ServoTerm::backlash, ServoTerm::dead_time};
constexpr unsigned all_terms = (1U << optional_terms.size()) - 1;

constexpr PointIndex search_records = 12'000;
constexpr PointIndex search_piece = 3000;
constexpr ServoEffort rough{.most_steps = 30, .enough = 1e-4, .fine = false};
constexpr ServoEffort thorough{};

unsigned bit_of(std::size_t k) { return 1U << k; }

ServoParameters with_terms(ServoParameters p, unsigned set) {
    for (std::size_t k = 0; k < optional_terms.size(); ++k) {
        const bool has = (set & bit_of(k)) != 0;
        p.active[index_of(optional_terms[k])] = has;
        if (!has) p[optional_terms[k]] = 0;
    }
    return p;
}

/// Values that a term may begin with, next to a loop that leaves a residual of `apart` rms.
std::vector<double> first_values(ServoTerm term, const ServoParameters& loop, double apart) {
    if (term == ServoTerm::dead_time) return {0.3, 1, 2, 4};
    const double scale = term == ServoTerm::friction ? std::exp(loop[ServoTerm::log_gain]) * apart : 2 * apart;
    return {0.1 * scale, 0.3 * scale, scale, 3 * scale};
}

bool is_certain(const ServoSolution& solution, ServoTerm term) {
    return solution.parameters[term] > certain_errors * standard_errors(solution)[index_of(term)];
}

/// Searches the combinations of terms on a part of the records.
class RoughSearch {
public:
    RoughSearch(const ServoProblem& problem, std::span<const ServoStart> regressions, double rounding)
        : problem_(problem), regressions_(regressions), rounding_(rounding) {
        for (const int count : {0, 1, 2, 3}) {
            for (unsigned set = 0; set <= all_terms; ++set) {
                if (std::popcount(set) != count) continue;
                found_[set] = search(set);
                if (found_[set]) found_[set]->rounding = rounding;
            }
            // Noise that one loop leaves no other one explains.
            if (explained()) break;
        }
    }

    /// The combinations that were searched, the best first.
    [[nodiscard]] std::vector<unsigned> ranked() const {
        std::vector<unsigned> sets;
        for (unsigned set = 0; set <= all_terms; ++set)
            if (found_[set]) sets.push_back(set);
        std::stable_sort(sets.begin(), sets.end(),
                         [&](unsigned a, unsigned b) { return found_[a]->criterion() < found_[b]->criterion(); });
        return sets;
    }
    [[nodiscard]] const std::optional<ServoSolution>& of(unsigned set) const { return found_[set]; }

private:
    [[nodiscard]] bool explained() const {
        constexpr double nearly = 1.02;
        return std::any_of(found_.begin(), found_.end(),
                           [&](const auto& each) { return each && each->sums.mean_square() <= nearly * rounding_; });
    }

    [[nodiscard]] std::optional<ServoSolution> search(unsigned set) const {
        std::vector<std::pair<double, ServoParameters>> sorted;
        for (const ServoParameters& start : starts(set)) {
            if (settles(start, problem_.period())) sorted.emplace_back(problem_.evaluate(start).squares, start);
        }
        std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        constexpr std::size_t most = 3;
        std::optional<ServoSolution> best;
        for (std::size_t k = 0; k < std::min(most, sorted.size()); ++k) {
            ServoSolution solution = minimise(problem_, sorted[k].second, rough);
            if (!best || solution.sums.squares < best->sums.squares) best = std::move(solution);
        }
        return best;
    }

    /// From the regression, from a usual loop, and from the combinations with one term less.
    [[nodiscard]] std::vector<ServoParameters> starts(unsigned set) const {
        std::vector<ServoParameters> all;
        const bool delays = (set & bit_of(2)) != 0;
        std::size_t taken = 0;
        for (const ServoStart& regression : regressions_) {
            ServoParameters p = with_terms(regression.parameters, set);
            const bool late = regression.parameters[ServoTerm::dead_time] > 0;
            if ((late && !delays) || taken >= 2) continue;
            ++taken;
            if (p.has(ServoTerm::friction)) p[ServoTerm::friction] = regression.friction;
            if (delays && !late) p[ServoTerm::dead_time] = 0.3;
            add_with_backlash(p, all);
        }
        const ServoParameters usual = parameters_of(ServoModel{}, problem_.period());
        if (set == 0) all.push_back(with_terms(usual, set));
        for (std::size_t k = 0; k < optional_terms.size(); ++k) {
            const std::optional<ServoSolution>& less = found_[set & ~bit_of(k)];
            if ((set & bit_of(k)) == 0 || !less) continue;
            const double apart = std::sqrt(less->sums.mean_square());
            for (const ServoParameters& loop : {less->parameters, usual}) {
                for (const double value : first_values(optional_terms[k], loop, apart)) {
                    ServoParameters p = less->parameters;
                    for (const ServoTerm of : {ServoTerm::log_gain, ServoTerm::feedforward, ServoTerm::velocity_step})
                        p[of] = loop[of];
                    p = with_terms(p, set);
                    p[optional_terms[k]] = value;
                    all.push_back(p);
                }
            }
        }
        return all;
    }

    void add_with_backlash(const ServoParameters& p, std::vector<ServoParameters>& all) const {
        if (!p.has(ServoTerm::backlash)) {
            all.push_back(p);
            return;
        }
        const std::optional<ServoSolution>& plain = found_[0];
        const double apart = plain ? std::sqrt(plain->sums.mean_square()) : 1e-3;
        for (const double value : first_values(ServoTerm::backlash, p, apart)) {
            all.push_back(p);
            all.back()[ServoTerm::backlash] = value;
        }
    }

    const ServoProblem& problem_;
    std::span<const ServoStart> regressions_;
    double rounding_;
    std::array<std::optional<ServoSolution>, all_terms + 1> found_;
};

/// Compares combinations of terms on all records.
class Selection {
public:
    Selection(const ServoProblem& problem, const RoughSearch& search, double rounding)
        : problem_(problem), search_(search), rounding_(rounding) {}

    SelectedLoop run() {
        constexpr std::size_t compared = 2;
        unsigned now = 0;
        const std::vector<unsigned> ranked = search_.ranked();
        for (std::size_t k = 0; k < std::min(compared, ranked.size()); ++k) {
            const ServoSolution& other = solution_of(ranked[k]);
            if (k == 0 || other.criterion() < solution_of(now).criterion()) now = ranked[k];
        }
        for (int round = 0; round < 6; ++round) {
            const unsigned next = better_than(now);
            if (next == now) break;
            now = next;
        }
        SelectedLoop selected{solution_of(now), {}};
        for (std::size_t k = 0; k < optional_terms.size(); ++k) {
            const unsigned other = now ^ bit_of(k);
            const bool kept = (now & bit_of(k)) != 0;
            const ServoSolution &with = solution_of(kept ? now : other), &without = solution_of(kept ? other : now);
            selected.evidence.push_back({optional_terms[k], with.parameters[optional_terms[k]],
                                         without.criterion() - with.criterion(),
                                         kept && is_certain(with, optional_terms[k])});
        }
        return selected;
    }

private:
    /// A combination with a term more or less that is better; `now`: none is.
    unsigned better_than(unsigned now) {
        for (std::size_t k = 0; k < optional_terms.size(); ++k) {
            if ((now & bit_of(k)) == 0) continue;
            const double rise = solution_of(now ^ bit_of(k)).criterion() - solution_of(now).criterion();
            if (rise <= (is_certain(solution_of(now), optional_terms[k]) ? 0 : needless)) return now ^ bit_of(k);
        }
        std::optional<unsigned> best;
        bool any_certain = false;
        for (std::size_t k = 0; k < optional_terms.size(); ++k) {
            if ((now & bit_of(k)) != 0) continue;
            const unsigned with = now | bit_of(k);
            if (!(solution_of(with).criterion() < solution_of(now).criterion() - needless)) continue;
            // A term of no certain value that explains more than every other one is added, too: without it another would
            // stand for it.
            any_certain |= is_certain(solution_of(with), optional_terms[k]);
            if (!best || solution_of(with).criterion() < solution_of(*best).criterion()) best = with;
        }
        return best && any_certain ? *best : now;
    }

    /// From what the rough search found, and from the solutions of all records with a term more or less.
    const ServoSolution& solution_of(unsigned set) {
        if (found_[set]) return *found_[set];
        std::vector<ServoParameters> starts;
        if (search_.of(set)) starts.push_back(search_.of(set)->parameters);
        for (std::size_t k = 0; k < optional_terms.size(); ++k) {
            const std::optional<ServoSolution>& beside = found_[set ^ bit_of(k)];
            if (!beside) continue;
            ServoParameters p = with_terms(beside->parameters, set);
            if (p.has(optional_terms[k])) {
                const double apart = std::sqrt(beside->sums.mean_square());
                p[optional_terms[k]] = first_values(optional_terms[k], p, apart).front();
            }
            if (settles(p, problem_.period())) starts.push_back(p);
        }
        const auto best = std::min_element(starts.begin(), starts.end(), [&](const auto& a, const auto& b) {
            return problem_.evaluate(a).squares < problem_.evaluate(b).squares;
        });
        found_[set] = minimise(problem_, *best, thorough);
        found_[set]->rounding = rounding_;
        return *found_[set];
    }

    const ServoProblem& problem_;
    const RoughSearch& search_;
    double rounding_;
    std::array<std::optional<ServoSolution>, all_terms + 1> found_;
};

}  // namespace

SelectedLoop select_loop(const ServoProblem& problem, std::span<const ServoStart> regressions, double rounding) {
    const PointIndex piece = std::max(search_piece, 4 * problem.settling());
    const ServoProblem part(problem, std::max(search_records, 2 * piece), piece);
    const RoughSearch search(part, regressions, rounding);
    return Selection(problem, search, rounding).run();
}

}  // namespace clsurf
