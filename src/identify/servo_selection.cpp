#include "identify/servo_selection.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>

namespace clsurf {
namespace {

// The same evidence as `decisive` (rule_search.h).
constexpr double needless = 10;  ///< decrease of the criterion that an uncertain term must exceed
// The integral is last: it is tried only if no loop without it explains the records.
constexpr std::array optional_terms{ServoTerm::friction, ServoTerm::backlash, ServoTerm::dead_time,
                                    ServoTerm::integral_step};
constexpr unsigned all_terms = (1U << optional_terms.size()) - 1;

constexpr PointIndex search_records = 12'000;
constexpr PointIndex search_piece = 3000;
constexpr ServoEffort rough{.most_steps = 30, .enough = 1e-4, .fine = false};
constexpr ServoEffort thorough{};
constexpr ServoEffort physical{.free_feedforward = false};

unsigned bit_of(std::size_t k) { return 1U << k; }

/// Whether a combination has an optional term.
bool includes(unsigned set, ServoTerm term) {
    const auto* const found = std::find(optional_terms.begin(), optional_terms.end(), term);
    return (set & bit_of(static_cast<std::size_t>(found - optional_terms.begin()))) != 0;
}

ServoParameters with_terms(ServoParameters p, unsigned set) {
    for (std::size_t k = 0; k < optional_terms.size(); ++k) {
        const bool has = (set & bit_of(k)) != 0;
        p.active[index_of(optional_terms[k])] = has;
        if (!has) p[optional_terms[k]] = 0;
    }
    return p;
}

/// First values of a term, for a loop with a residual of `apart` rms.
std::vector<double> first_values(ServoTerm term, const ServoParameters& loop, double apart) {
    if (term == ServoTerm::dead_time) return {0.3, 1, 2, 4};
    if (term == ServoTerm::integral_step) return {0.03, 0.1, 0.3};
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
        : problem_(problem), regressions_(regressions), rounding_(rounding), lags_(lags_of(problem)) {
        search_all();
        if (is_white()) return;
        considered_ = optional_terms.size();
        search_all();
    }

    /// The terms of which any combination may consist.
    [[nodiscard]] std::span<const ServoTerm> considered() const {
        return std::span<const ServoTerm>(optional_terms).first(considered_);
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
    /// Searches the remaining combinations of the considered terms, those with few terms first.
    void search_all() {
        for (std::size_t count = 0; count <= considered_; ++count) {
            for (unsigned set = 0; set < bit_of(considered_); ++set) {
                if (found_[set] || static_cast<std::size_t>(std::popcount(set)) != count) continue;
                found_[set] = search(set);
                if (found_[set]) found_[set]->rounding = rounding_;
            }
            // If the residual of one loop is noise, no other loop explains it.
            if (explained()) break;
        }
    }

    /// Whether some loop leaves independent residuals: those of quantum and noise.
    [[nodiscard]] bool is_white() const {
        // As in docs/design/identify.md#servo-loops.
        constexpr double nearly = 1.1;  // factor; the excess is below a third of the noise
        return std::any_of(found_.begin(), found_.end(), [&](const auto& each) {
            return each && each->sums.mean_square() <= nearly * each->unexplainable();
        });
    }

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
        constexpr std::size_t most = 5;
        std::optional<ServoSolution> best;
        std::vector<ServoParameters> tried;
        for (const auto& [squares, start] : sorted) {
            if (tried.size() == most) break;
            if (std::any_of(tried.begin(), tried.end(), [&, &s = start](const auto& t) { return are_near(s, t); }))
                continue;
            tried.push_back(start);
            ServoSolution solution = minimise(problem_, start, rough);
            if (!best || solution.sums.squares < best->sums.squares) best = std::move(solution);
        }
        return best;
    }

    /// Whether searches from both starts would have the same result.
    [[nodiscard]] static bool are_near(const ServoParameters& one, const ServoParameters& other) {
        constexpr double of_gain = 0.3, of_dead_time = 0.8;
        return std::abs(one[ServoTerm::log_gain] - other[ServoTerm::log_gain]) < of_gain &&
               std::abs(one[ServoTerm::dead_time] - other[ServoTerm::dead_time]) < of_dead_time;
    }

    [[nodiscard]] std::vector<double> usual_gains() const {
        constexpr double ratio = 1.4, least = 5;
        std::vector<double> gains;
        for (double gain = least; gain * problem_.period() < 0.9; gain *= ratio) gains.push_back(gain);
        return gains;
    }

    [[nodiscard]] static bool has_usual_feedforward(const ServoParameters& p) {
        return p[ServoTerm::feedforward] > -0.1 && p[ServoTerm::feedforward] < 1.5;
    }

    /// Adds loops with usual gains that have the lags of the records.
    void add_with_lags(unsigned set, std::vector<ServoParameters>& all) const {
        const bool sticks = includes(set, ServoTerm::friction), plays = includes(set, ServoTerm::backlash),
                   delays = includes(set, ServoTerm::dead_time);
        for (const double gain : usual_gains()) {
            for (double dead = 0; dead <= (delays ? 8.0 : 0.0); dead += 0.5) {
                // Friction and backlash share the delay at reversals in an unknown ratio.
                for (const double share : {0.2, 0.8}) {
                    if (!(sticks && plays) && share > 0.5) continue;
                    ServoParameters p = with_terms(lags_, set);
                    p[ServoTerm::log_gain] = std::log(gain);
                    if (delays) p[ServoTerm::dead_time] = dead;
                    if (plays) p[ServoTerm::backlash] = 2 * (sticks ? share : 1.0) * lags_[ServoTerm::friction];
                    if (sticks) p[ServoTerm::friction] = lags_[ServoTerm::friction];
                    p = loop_of_lags(p, problem_.period());
                    if (has_usual_feedforward(p)) all.push_back(p);
                }
            }
        }
    }

    /// The same with an integrating velocity loop, whose lag at constant speed determines only the feed-forward: usual time
    /// constants and integral times.
    void add_integrating(unsigned set, std::vector<ServoParameters>& all) const {
        const bool delays = includes(set, ServoTerm::dead_time);
        for (const double gain : usual_gains()) {
            for (const double dead : {0.0, 1.0, 2.0, 4.0}) {
                if (!delays && dead > 0) break;
                ServoParameters p = with_terms(lags_, set);
                p[ServoTerm::log_gain] = std::log(gain);
                p[ServoTerm::feedforward] = 1 - (lags_[ServoTerm::feedforward] - dead * problem_.period()) * gain;
                if (!has_usual_feedforward(p)) continue;
                if (delays) p[ServoTerm::dead_time] = dead;
                if (p.has(ServoTerm::friction)) p[ServoTerm::friction] = lags_[ServoTerm::friction] * gain;
                if (p.has(ServoTerm::backlash)) p[ServoTerm::backlash] = lags_[ServoTerm::friction];
                for (const double step : {0.1, 0.2, 0.4, 0.7}) {
                    for (const double integral : first_values(ServoTerm::integral_step, p, 0)) {
                        p[ServoTerm::velocity_step] = step;
                        p[ServoTerm::integral_step] = integral;
                        all.push_back(p);
                    }
                }
            }
        }
    }

    /// Starts from the regression, from a usual loop, and from the combinations with one term fewer.
    [[nodiscard]] std::vector<ServoParameters> starts(unsigned set) const {
        std::vector<ServoParameters> all;
        const bool delays = includes(set, ServoTerm::dead_time);
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
        if (includes(set, ServoTerm::integral_step))
            add_integrating(set, all);
        else
            add_with_lags(set, all);
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
    ServoParameters lags_;
    std::size_t considered_ = optional_terms.size() - 1;  ///< of optional_terms
    std::array<std::optional<ServoSolution>, all_terms + 1> found_;
};

/// Compares combinations of terms on all records.
class Selection {
public:
    Selection(const ServoProblem& problem, const RoughSearch& search, double rounding)
        : problem_(problem), search_(search), terms_(search.considered()), rounding_(rounding) {}

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
        std::vector<ServoSolution> delayed = delayed_otherwise(solution_of(now));
        for (ServoSolution& other : delayed)
            if (other.sums.squares < found_[now]->sums.squares) std::swap(*found_[now], other);
        SelectedLoop selected{solution_of(now), {}, standard_errors(solution_of(now))};
        for (const ServoSolution& other : delayed) widen(solution_of(now), other, selected.standard_error);
        for (std::size_t k = 0; k < terms_.size(); ++k) {
            const unsigned other = now ^ bit_of(k);
            const bool kept = (now & bit_of(k)) != 0;
            const ServoSolution &with = solution_of(kept ? now : other), &without = solution_of(kept ? other : now);
            selected.evidence.push_back(
                {terms_[k], with.parameters[terms_[k]], without.criterion() - with.criterion()});
            widen(solution_of(now), solution_of(other), selected.standard_error);
        }
        return selected;
    }

private:
    /// Widens the errors by the difference to another loop, because it is not known which of the loops the axis has. The
    /// weight follows from the odds of the criterion, as in model averaging (Burnham and Anderson, Model Selection and
    /// Multimodel Inference, 2nd ed., ch. 4.3). But the value is not averaged, and of several other loops the one that widens
    /// most counts, not their sum.
    static void widen(const ServoSolution& now, const ServoSolution& other,
                      std::array<double, servo_terms>& standard_error) {
        const double ratio = std::exp(std::min(0.0, now.criterion() - other.criterion()) / 2),
                     weight = ratio / (1 + ratio);
        const std::array<double, servo_terms> own = standard_errors(other);
        for (std::size_t k = 0; k < servo_terms; ++k) {
            if (!now.parameters.active[k] || !other.parameters.active[k] || !std::isfinite(own[k])) continue;
            const double apart = std::hypot(own[k], other.parameters.value[k] - now.parameters.value[k]);
            standard_error[k] = std::max(standard_error[k], std::sqrt(weight) * apart);
        }
    }

    /// A better combination with one term more or fewer; `now`: there is none.
    unsigned better_than(unsigned now) {
        for (std::size_t k = 0; k < terms_.size(); ++k) {
            if ((now & bit_of(k)) == 0) continue;
            const double rise = solution_of(now ^ bit_of(k)).criterion() - solution_of(now).criterion();
            if (rise <= (is_certain(solution_of(now), terms_[k]) ? 0 : needless)) return now ^ bit_of(k);
        }
        std::optional<unsigned> best;
        bool any_certain = false;
        for (std::size_t k = 0; k < terms_.size(); ++k) {
            if ((now & bit_of(k)) != 0) continue;
            const unsigned with = now | bit_of(k);
            if (!(solution_of(with).criterion() < solution_of(now).criterion() - needless)) continue;
            // An uncertain term that explains more than every other term is added, too: without it another term would take
            // its place.
            any_certain |= is_certain(solution_of(with), terms_[k]);
            if (!best || solution_of(with).criterion() < solution_of(*best).criterion()) best = with;
        }
        return best && any_certain ? *best : now;
    }

    /// Starts from the results of the rough search, and from the solutions on all records with one term more or fewer.
    const ServoSolution& solution_of(unsigned set) {
        if (found_[set]) return *found_[set];
        std::vector<ServoParameters> starts;
        if (search_.of(set)) starts.push_back(search_.of(set)->parameters);
        for (std::size_t k = 0; k < terms_.size(); ++k) {
            const std::optional<ServoSolution>& beside = found_[set ^ bit_of(k)];
            if (!beside) continue;
            ServoParameters p = with_terms(beside->parameters, set);
            if (p.has(terms_[k])) {
                const double apart = std::sqrt(beside->sums.mean_square());
                p[terms_[k]] = first_values(terms_[k], p, apart).front();
            }
            if (settles(p, problem_.period())) starts.push_back(p);
        }
        std::vector<std::pair<double, ServoParameters>> sorted;
        for (const ServoParameters& start : starts) sorted.emplace_back(problem_.evaluate(start).squares, start);
        std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        for (const auto& [squares, start] : sorted) {
            // More terms never explain less than fewer terms: a search that ends above that value has not found the
            // minimum.
            if (found_[set] && found_[set]->sums.squares <= (1 + thorough.enough) * least_of_fewer(set)) break;
            ServoSolution solution = solved(start);
            if (!found_[set] || solution.sums.squares < found_[set]->sums.squares) found_[set] = std::move(solution);
        }
        return *found_[set];
    }

    /// The nearest minimum with a feed-forward of at least 0.
    [[nodiscard]] ServoSolution solved(const ServoParameters& start) const {
        ServoSolution solution = minimise(problem_, start, thorough);
        if (solution.parameters[ServoTerm::feedforward] < 0) {
            ServoParameters without = solution.parameters;
            without[ServoTerm::feedforward] = 0;
            if (settles(without, problem_.period())) solution = minimise(problem_, without, physical);
        }
        solution.rounding = rounding_;
        return solution;
    }

    /// Minima at other dead times than that of `now`. The fractional part of a dead time smooths the command as well.
    /// Therefore there is a minimum in nearly every period, in which feed-forward and gain compensate for the rest of the
    /// delay.
    [[nodiscard]] std::vector<ServoSolution> delayed_otherwise(const ServoSolution& now) const {
        std::vector<ServoSolution> found;
        if (!now.parameters.has(ServoTerm::dead_time)) return found;
        const ServoParameters known = lags_of_loop(now.parameters, problem_.period());
        for (const double more : {-1.0, -0.5, -0.2, 0.2, 0.5, 1.0}) {
            ServoParameters lags = known;
            lags[ServoTerm::dead_time] = std::max(0.0, lags[ServoTerm::dead_time] + more);
            const ServoParameters start = loop_of_lags(lags, problem_.period());
            if (start[ServoTerm::friction] >= 0 && settles(start, problem_.period())) found.push_back(solved(start));
        }
        return found;
    }

    /// The least squares of the solved combinations with one term fewer.
    [[nodiscard]] double least_of_fewer(unsigned set) const {
        double least = INFINITY;
        for (std::size_t k = 0; k < terms_.size(); ++k) {
            const std::optional<ServoSolution>& fewer = found_[set & ~bit_of(k)];
            if ((set & bit_of(k)) != 0 && fewer) least = std::min(least, fewer->sums.squares);
        }
        return least;
    }

    const ServoProblem& problem_;
    const RoughSearch& search_;
    std::span<const ServoTerm> terms_;
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
