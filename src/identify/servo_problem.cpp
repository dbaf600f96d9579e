#include "identify/servo_problem.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "simulation/run/servo.h"

namespace clsurf {
namespace {

constexpr PointIndex most_fit_records = 1'000'000;
/// Size of the groups whose sums of scores give the covariance: residuals of an inexact model are correlated over some
/// records (docs/design/identify.md#servo-loops).
constexpr PointIndex group_size = 512;

/// The change of a parameter over which its derivative is taken. An axis sticks and comes loose at the end of a period.
/// With friction the changes are therefore large enough to move some of these instants; likewise for backlash.
double size_of_step(const ServoParameters& p, ServoTerm term, double width) {
    const double smooth = p[ServoTerm::friction] > 0 ? std::max(3e-3 * width, 1e-5) : 1e-5;
    constexpr double least = 1e-5;
    const double share = std::max(1e-2 * width, 1e-4);
    switch (term) {
        case ServoTerm::friction:
        case ServoTerm::integral_step:
        case ServoTerm::backlash: return std::max(share * p[term], least);
        case ServoTerm::dead_time: return std::max(1e-3 * width, 1e-5);
        default: return smooth;
    }
}

/// The same with the sign of `width`, unless no loop has such a value: faster than ideal, or with a friction, backlash or
/// dead time below 0.
double difference_step(const ServoParameters& p, ServoTerm term, double width) {
    const double step = std::copysign(size_of_step(p, term, std::abs(width)), width);
    switch (term) {
        case ServoTerm::velocity_step: return p[term] + step > 1 ? -step : step;
        case ServoTerm::friction:
        case ServoTerm::backlash:
        case ServoTerm::integral_step:
        case ServoTerm::dead_time: return p[term] + step < 0 ? -step : step;
        default: return step;
    }
}

/// Loops that run in parallel: one with the parameters, and one per parameter with a small change, unless `width` is 0.
class LoopBundle {
public:
    LoopBundle(const ServoParameters& parameters, double period, double width, double start)
        : base_(model_of(parameters, period), period, start, 0), offset_(parameters[ServoTerm::offset]) {
        if (width == 0) return;
        for (std::size_t k = 0; k < index_of(ServoTerm::offset); ++k) {
            const auto term = static_cast<ServoTerm>(k);
            if (!parameters.has(term)) continue;
            const double step = difference_step(parameters, term, width);
            ServoParameters changed = parameters;
            changed[term] += step;
            changed_.push_back({ServoLoop(model_of(changed, period), period, start, 0), 1 / step, k});
        }
    }

    /// The response to a commanded position.
    double follow(double commanded, ServoVector& derivatives) {
        const double position = base_.follow(commanded);
        for (Changed& c : changed_)
            derivatives[static_cast<Eigen::Index>(c.term)] = (c.loop.follow(commanded) - position) * c.per_step;
        return position + offset_;
    }

private:
    struct Changed {
        ServoLoop loop;
        double per_step;
        std::size_t term;
    };
    ServoLoop base_;
    std::vector<Changed> changed_;
    double offset_;
};

void add_scores(ServoSums& sums, ServoVector& scores) {
    sums.scatter += scores * scores.transpose();
    sums.gradient += scores;
    scores.setZero();
}

void add_piece(std::span<const double> commanded, std::span<const double> feedback, PointIndex settling, double period,
               const ServoParameters& parameters, double width, ServoSums& sums) {
    LoopBundle loops(parameters, period, width, commanded.front());
    ServoVector derivatives = ServoVector::Zero(), scores = ServoVector::Zero();
    if (parameters.has(ServoTerm::offset)) derivatives[index_of(ServoTerm::offset)] = 1;
    double before = NAN;
    for (std::size_t i = 1; i < commanded.size(); ++i) {
        const double residual = feedback[i] - loops.follow(commanded[i], derivatives);
        if (static_cast<PointIndex>(i) <= settling) continue;
        sums.squares += residual * residual;
        ++sums.count;
        if (!std::isnan(before)) {
            sums.squared_changes += (residual - before) * (residual - before);
            ++sums.changes;
        }
        before = residual;
        if (width == 0) continue;
        sums.normal += derivatives * derivatives.transpose();
        scores += residual * derivatives;
        if (sums.count % group_size == 0) add_scores(sums, scores);
    }
    add_scores(sums, scores);
}

}  // namespace

int ServoParameters::count() const { return static_cast<int>(std::count(active.begin(), active.end(), true)); }

ServoModel model_of(const ServoParameters& parameters, double period) {
    ServoModel model;
    model.position_gain = std::exp(parameters[ServoTerm::log_gain]);
    model.velocity_feedforward = parameters[ServoTerm::feedforward];
    const double step = parameters[ServoTerm::velocity_step];
    model.velocity_time_constant = step < 1 ? -period / std::log1p(-step) : 0;
    const double integral = parameters[ServoTerm::integral_step];
    model.velocity_integral_time = integral > 0 ? period / integral : 0;
    model.friction = parameters[ServoTerm::friction];
    model.backlash = parameters[ServoTerm::backlash];
    model.dead_time = parameters[ServoTerm::dead_time] * period;
    model.quantum = 0;
    model.noise = 0;
    return model;
}

ServoParameters parameters_of(const ServoModel& model, double period) {
    ServoParameters p;
    p[ServoTerm::log_gain] = std::log(model.position_gain);
    p[ServoTerm::feedforward] = model.velocity_feedforward;
    p[ServoTerm::velocity_step] =
        model.velocity_time_constant > 0 ? -std::expm1(-period / model.velocity_time_constant) : 1.0;
    p[ServoTerm::integral_step] = model.velocity_integral_time > 0 ? period / model.velocity_integral_time : 0;
    p[ServoTerm::friction] = model.friction;
    p[ServoTerm::backlash] = model.backlash;
    p[ServoTerm::dead_time] = model.dead_time / period;
    return p;
}

ServoProblem::ServoProblem(const ServoProblem& of, PointIndex most, PointIndex piece)
    : records_(of.records_), period_(of.period_), settling_(of.settling_) {
    std::vector<std::pair<double, Piece>> ranked;
    std::vector<double> commanded, feedback;
    for (const Piece& whole : of.pieces_) {
        const AxisRecord* record = &records_[static_cast<std::size_t>(whole.record - of.records_.data())];
        for (PointIndex first = whole.range.first; first + settling_ < whole.range.last; first += piece) {
            const Piece part{record, {first, std::min(whole.range.last, first + piece - 1)}};
            gather(part, commanded, feedback);
            double changes = 0;  // of speed
            for (std::size_t i = 2; i < commanded.size(); ++i)
                changes += std::abs(commanded[i] - 2 * commanded[i - 1] + commanded[i - 2]);
            ranked.emplace_back(changes, part);
        }
    }
    std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    PointIndex total = 0;
    for (const auto& [changes, part] : ranked) {
        if (total >= most) break;
        pieces_.push_back(part);
        total += part.range.size();
    }
    set_settling(settling_);
}

ServoProblem::ServoProblem(std::span<const AxisRecord> records, double period, PointIndex settling)
    : records_(records.begin(), records.end()), period_(period), settling_(settling) {
    PointIndex total = 0;
    for (const AxisRecord& record : records_) {
        for (const PointRange& section : record.sections) total += section.size();
    }
    for (const AxisRecord& record : records_) {
        PointIndex own = 0;
        for (const PointRange& section : record.sections) own += section.size();
        const double share = static_cast<double>(own) / static_cast<double>(std::max<PointIndex>(total, 1));
        const auto most = static_cast<PointIndex>(share * static_cast<double>(most_fit_records));
        for (const PointRange& range : sample_pieces(record.sections, most)) pieces_.push_back({&record, range});
    }
    set_settling(settling);
}

void ServoProblem::set_settling(PointIndex settling) {
    settling_ = settling;
    count_ = 0;
    for (const Piece& piece : pieces_) count_ += std::max<PointIndex>(piece.range.size() - 1 - settling, 0);
}

void ServoProblem::gather(const Piece& piece, std::vector<double>& commanded, std::vector<double>& feedback) {
    const auto n = static_cast<std::size_t>(piece.range.size());
    commanded.resize(n);
    feedback.resize(n);
    copy_block(piece.record->commanded, piece.range.first, commanded);
    copy_block(piece.record->feedback, piece.range.first, feedback);
    const double start = commanded.front();
    for (double& value : commanded) value -= start;
    for (double& value : feedback) value -= start;
}

ServoSums ServoProblem::linearise(const ServoParameters& parameters, double width) const {
    ServoSums sums;
    for_each_piece([&](std::span<const double> commanded, std::span<const double> feedback) {
        add_piece(commanded, feedback, settling_, period_, parameters, width, sums);
    });
    return sums;
}

ServoSums ServoProblem::evaluate(const ServoParameters& parameters) const {
    ServoSums sums;
    for_each_piece([&](std::span<const double> commanded, std::span<const double> feedback) {
        add_piece(commanded, feedback, settling_, period_, parameters, 0, sums);
    });
    return sums;
}

}  // namespace clsurf
