#include "identify/servo_parameters.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "core/parallel.h"
#include "core/units.h"
#include "identify/servo_fit.h"

namespace clsurf {
namespace {

/// Records of one axis in runs of one period.
struct PeriodRecords {
    double period = 0;  ///< [s]
    std::vector<AxisRecord> records;
};

/// An axis with its records in the runs that have both of its positions.
struct AxisData {
    char letter = 'x';
    bool commanded = false, feedback = false;  ///< recorded in some run
    std::vector<PeriodRecords> records;        ///< the shortest period first
    double period = 0;                         ///< of the records of the fit [s]
    ServoFit fit;

    [[nodiscard]] std::string name() const { return {letter}; }
    [[nodiscard]] bool rotary() const { return letter < 'x'; }
    [[nodiscard]] std::string unit(const char* per = "") const { return (rotary() ? "deg" : "mm") + std::string(per); }
};

std::vector<AxisData> gather_axes(std::span<const Log* const> runs) {
    std::vector<AxisData> axes;
    for (const char letter : {'x', 'y', 'z', 'a', 'b', 'c'}) {
        AxisData axis;
        axis.letter = letter;
        for (const Log* log : runs) {
            const Channel* commanded = log->find("cmd." + axis.name());
            const Channel* feedback = log->find("fb." + axis.name());
            if (feedback == nullptr) feedback = log->find("act." + axis.name());
            axis.commanded |= commanded != nullptr;
            axis.feedback |= feedback != nullptr;
            if (commanded == nullptr || feedback == nullptr) continue;
            const std::array views{commanded->values, feedback->values};
            row_of_period(axis.records, log->period)
                .records.push_back({views[0], views[1], find_sections(*log, views)});
        }
        std::sort(axis.records.begin(), axis.records.end(),
                  [](const PeriodRecords& a, const PeriodRecords& b) { return a.period < b.period; });
        if (axis.commanded || axis.feedback) axes.push_back(std::move(axis));
    }
    return axes;
}

constexpr std::array loop_keys{
    "position_gain", "velocity_feedforward", "velocity_time_constant", "velocity_integral_time", "friction", "backlash",
    "dead_time"};

/// Lists every value of a loop as unidentified, for one reason.
void miss_loop(const AxisData& axis, const std::string& reason, Identification& result) {
    for (const char* key : loop_keys) result.unidentified.push_back({key, axis.name(), reason});
}

class LoopReport {
public:
    LoopReport(const AxisData& axis, Identification& result)
        : axis_(axis), result_(result), model_(model_of(axis.fit.parameters, axis.period)) {}

    void report(ServoModel& target) {
        const ServoFit& fit = axis_.fit;
        const bool gain = fit.knows(ServoTerm::log_gain);
        const std::string separate =
            fmt::format("only the lag at constant speed is known, {:.4g} ± {:.1g} s", fit.lag, fit.lag_error);
        const std::string no_dynamics =
            another_form() ? fmt::format("the model explains the axis only to {:.2g} {} rms: its loop has another form",
                                         fit.residual, axis_.unit())
                           : "too few or too gentle changes of speed";
        const bool lag = !gain && fit.lag_error < 0.1 * std::abs(fit.lag);
        put("position_gain", gain, error(ServoTerm::log_gain) * model_.position_gain, model_.position_gain, "1/s",
            target.position_gain, 1, lag ? separate : no_dynamics);
        put("velocity_feedforward", gain && fit.knows(ServoTerm::feedforward), error(ServoTerm::feedforward),
            std::max(0.0, model_.velocity_feedforward), "", target.velocity_feedforward, 1,
            lag ? separate : no_dynamics);
        put("velocity_time_constant", gain && fit.knows(ServoTerm::velocity_step),
            fit.time_constant_error(axis_.period), model_.velocity_time_constant, "s", target.velocity_time_constant, 1,
            no_dynamics);
        put_term(ServoTerm::integral_step, "velocity_integral_time", "s", target.velocity_integral_time, 1);
        if (lag || gain)
            result_.parameters.push_back({"lag",
                                          axis_.name(),
                                          rounded_to(fit.lag, fit.lag_error),
                                          "s",
                                          fit.lag_error,
                                          {},
                                          "of the position at constant speed, per speed"});
        const double angle = axis_.rotary() ? rad_per_deg : 1;
        // Together, the values of the fit give the lag and the residual; each alone is not known well enough.
        if (gain && !fit.knows(ServoTerm::feedforward))
            target.velocity_feedforward = rounded_to(std::max(0.0, model_.velocity_feedforward), 1e-6);
        put_term(ServoTerm::friction, "friction", axis_.unit("/min"), target.friction, angle / seconds_per_minute);
        put_term(ServoTerm::backlash, "backlash", axis_.unit(), target.backlash, angle);
        put_term(ServoTerm::dead_time, "dead_time", "s", target.dead_time, 1);
        put_resolution(target, angle);
    }

private:
    [[nodiscard]] double error(ServoTerm term) const { return axis_.fit.standard_error[index_of(term)]; }

    /// `to_machine`: factor from the reported unit to that of Machine.
    void put(const char* name, bool known, double standard_error, double value, const std::string& unit, double& target,
             double to_machine, const std::string& reason, const std::string& note = {}) {
        if (!known) {
            result_.unidentified.push_back({name, axis_.name(), reason});
            return;
        }
        const double settled = rounded_to(value, standard_error);
        target = settled * to_machine;
        result_.parameters.push_back({name, axis_.name(), settled, unit, standard_error, {}, note});
    }

    /// The value of an optional term in its reported unit.
    [[nodiscard]] double reported(ServoTerm term, double value) const {
        switch (term) {
            case ServoTerm::friction: return value * seconds_per_minute;
            case ServoTerm::dead_time: return value * axis_.period;
            case ServoTerm::integral_step: return axis_.period / value;
            default: return value;
        }
    }

    /// Its standard error in this unit.
    [[nodiscard]] double reported_error(ServoTerm term) const {
        const double value = axis_.fit.parameters[term];
        return term == ServoTerm::integral_step ? axis_.period * error(term) / (value * value)
                                                : reported(term, error(term));
    }

    /// Reports a term that is in the loop only if there is evidence.
    void put_term(ServoTerm term, const char* name, const std::string& unit, double& target, double to_machine) {
        const ServoFit& fit = axis_.fit;
        const auto found = std::find_if(fit.evidence.begin(), fit.evidence.end(),
                                        [&](const TermEvidence& e) { return e.term == term; });
        const bool tried = found != fit.evidence.end();
        // What a loop has that does not fit says nothing of the axis.
        if (!fit.knows(ServoTerm::log_gain)) {
            result_.unidentified.push_back({name, axis_.name(), "the loop is not identified"});
            return;
        }
        if (fit.parameters.has(term) && !fit.knows(term)) {
            result_.unidentified.push_back(
                {name, axis_.name(), "the motion shows that there is some, but not how much"});
            const double value = reported(term, fit.parameters[term]);
            target = rounded_to(value, 1e-5 * value) * to_machine;
            return;
        }
        if (fit.parameters.has(term)) {
            const std::string note = tried ? fmt::format("BIC falls by {:.0f}", found->gain) : "";
            put(name, true, reported_error(term), reported(term, fit.parameters[term]), unit, target, to_machine, {},
                note);
            return;
        }
        target = 0;
        const double value = tried ? reported(term, found->value) : 0;
        const std::string note =
            tried && std::isfinite(value)
                ? fmt::format("no evidence: {:.2g} {} changes BIC by {:+.0f}", value, unit, -found->gain)
                : "no evidence";
        result_.parameters.push_back({name, axis_.name(), 0, unit, std::nullopt, {}, note});
    }

    void put_resolution(ServoModel& target, double angle) {
        const ServoFit& fit = axis_.fit;
        if (!fit.knows(ServoTerm::log_gain)) {
            for (const char* key : {"quantum", "noise"})
                result_.unidentified.push_back({key, axis_.name(), "the loop is not identified"});
            return;
        }
        // The quantum is a difference of doubles.
        const double quantum = rounded_to(fit.quantum, 1e-5 * fit.quantum);
        target.quantum = quantum * angle;
        result_.parameters.push_back(
            {"quantum",
             axis_.name(),
             quantum,
             axis_.unit(),
             {},
             {},
             fit.quantum > 0 ? "step of the fed-back positions" : "the fed-back positions have no step above 5 nm"});
        // Noise below the rounding of a file has no meaning.
        constexpr double least_noise = 2e-6;
        const double noise =
            fit.noise > std::max(least_noise, 0.2 * fit.quantum) ? rounded_to(fit.noise, 0.01 * fit.noise) : 0;
        target.noise = noise * angle;
        result_.parameters.push_back({"noise",
                                      axis_.name(),
                                      noise,
                                      axis_.unit(),
                                      {},
                                      {},
                                      fmt::format("residual {:.2g} {} rms", fit.residual, axis_.unit())});
        state_residual();
    }

    /// Whether the loop leaves a larger residual than quantum and noise explain.
    [[nodiscard]] bool another_form() const {
        // As in docs/identify.md#servo-loops.
        constexpr double most = 2;  // factor of what quantum and noise explain
        return axis_.fit.residual > most * axis_.fit.explained;
    }

    void state_residual() {
        const ServoFit& fit = axis_.fit;
        if (!fit.knows(ServoTerm::log_gain) || !another_form()) return;
        result_.unidentified.push_back(
            {"servo", axis_.name(),
             fmt::format(
                 "the loop leaves {:.2g} {} rms, of which quantum and noise explain {:.2g}: the axis has an "
                 "effect that the model does not include, and the values may be wrong by more than their standard errors",
                 fit.residual, axis_.unit(), fit.explained)});
    }

    const AxisData& axis_;
    Identification& result_;
    ServoModel model_;
};

void report_axis(const AxisData& axis, Identification& result) {
    if (axis.records.empty())
        return miss_loop(
            axis, axis.commanded ? "no log has fed-back positions of it" : "no log has commanded positions of it",
            result);
    if (!axis.fit.moves) return miss_loop(axis, "the axis does not move", result);
    if (axis.fit.records == 0) return miss_loop(axis, "too few records", result);
    ServoModel none;
    MachineAxis* const target = result.machine.axis(axis.letter);
    if (target == nullptr)
        result.diagnostics.add(
            {Severity::warning,
             "identify.axis",
             {},
             fmt::format("axis {} is not in the machine file: the kinematics are not known", axis.letter),
             "give a machine file with [kinematics] by --machine"});
    LoopReport(axis, result).report(target != nullptr ? target->servo : none);
}

/// Fits the loop to the records of the shortest period that show its gain, else in which the axis moves. The loop of the
/// model has the period of the records, so that records of several periods have no common fit.
void fit_axis(AxisData& axis) {
    for (const PeriodRecords& of : axis.records) {
        ServoFit fit = fit_servo(of.records, of.period);
        const bool known = fit.knows(ServoTerm::log_gain);
        if (known || !axis.fit.moves) {
            axis.period = of.period;
            axis.fit = std::move(fit);
        }
        if (known) return;
    }
}

/// Values of the known machine that were not identified may not suit the period or an identified gain, and a file with them
/// would not be read. They become half of what is allowed.
void keep_stable(const AxisData& axis, Identification& result) {
    MachineAxis* const in_file = result.machine.axis(axis.letter);
    if (in_file == nullptr) return;
    ServoModel& servo = in_file->servo;
    const auto lower = [&](const char* key, double& value, double allowed, const std::string& because) {
        if (value < allowed) return;
        const double kept = 0.5 * allowed;
        result.diagnostics.add({Severity::note,
                                "identify.servo",
                                {},
                                fmt::format("axis {}: {} = {:.4g} is too large for {}: the file has {:.4g}",
                                            axis.letter, key, value, because, kept),
                                {}});
        value = kept;
    };
    const double period = result.machine.controller.period;
    lower("position_gain", servo.position_gain, 1 / period, fmt::format("a period of {:.4g} s", period));
    lower("velocity_time_constant", servo.velocity_time_constant, 1 / servo.position_gain,
          fmt::format("a position_gain of {:.4g} 1/s", servo.position_gain));
}

}  // namespace

void identify_servos(std::span<const Log* const> runs, Identification& result) {
    std::vector<AxisData> axes = gather_axes(runs);
    parallel_for(static_cast<std::int64_t>(axes.size()), 1, [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t k = first; k < last; ++k) fit_axis(axes[static_cast<std::size_t>(k)]);
    });
    for (const AxisData& axis : axes) {
        report_axis(axis, result);
        keep_stable(axis, result);
    }
}

}  // namespace clsurf
