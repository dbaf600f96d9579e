#pragma once
// ServoProblem: the difference between the fed-back positions of an axis and what ServoLoop (simulation/run/servo.h) makes of
// the commanded ones, as a least-squares problem in the loop's parameters (output error; Ljung, System Identification,
// 2nd ed., ch. 7). Derivatives are differences between loops that run side by side.

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "identify/axis_record.h"
#include "machine/machine.h"

namespace clsurf {

/// The unknowns. The gain is searched as its logarithm, the velocity loop's time constant as the step 1 − exp(−T/T_v) that the
/// loop would make without an integral, the integral time as its inverse T/T_n.
enum class ServoTerm : unsigned char {
    log_gain,
    feedforward,
    velocity_step,
    friction,
    backlash,
    dead_time,
    integral_step,
    offset
};
inline constexpr std::size_t servo_terms = 8;
[[nodiscard]] constexpr std::size_t index_of(ServoTerm term) { return static_cast<std::size_t>(term); }

/// Friction [unit/s], backlash and offset [unit], dead time [periods].
struct ServoParameters {
    std::array<double, servo_terms> value{};
    std::array<bool, servo_terms> active{true, true, true, false, false, false, false, true};

    double& operator[](ServoTerm term) { return value[index_of(term)]; }
    double operator[](ServoTerm term) const { return value[index_of(term)]; }
    [[nodiscard]] bool has(ServoTerm term) const { return active[index_of(term)]; }
    /// How many are searched.
    [[nodiscard]] int count() const;
};

/// The loop of these parameters; no quantum, no noise.
[[nodiscard]] ServoModel model_of(const ServoParameters& parameters, double period);
/// The parameters of a loop.
[[nodiscard]] ServoParameters parameters_of(const ServoModel& model, double period);

using ServoMatrix = Eigen::Matrix<double, servo_terms, servo_terms>;
using ServoVector = Eigen::Matrix<double, servo_terms, 1>;

/// Sums over the records; rows of inactive terms are zero.
struct ServoSums {
    double squares = 0;                          ///< of the residuals [unit²]
    double squared_changes = 0;                  ///< of the residuals, from one record to the next [unit²]
    PointIndex count = 0;                        ///< residuals
    double along = 0;                            ///< Σ residual · sign of the commanded speed [unit]
    PointIndex moving = 0;                       ///< terms of it
    ServoMatrix normal = ServoMatrix::Zero();    ///< Jᵀ J
    ServoMatrix scatter = ServoMatrix::Zero();   ///< Σ over groups of records of s sᵀ, s = Jᵀ e of the group
    ServoVector gradient = ServoVector::Zero();  ///< Jᵀ e

    [[nodiscard]] double mean_square() const { return count > 0 ? squares / static_cast<double>(count) : 0; }
    /// Half the mean square of the residuals' changes: the variance of residuals that were independent [unit²].
    [[nodiscard]] double variance_of_changes() const {
        return squared_changes / (2 * static_cast<double>(std::max<PointIndex>(count - 1, 1)));
    }
};

class ServoProblem {
public:
    /// Pieces of the records are sampled to at most 10^6. `settling`: records at the start of a piece that do not
    /// count, because the state before them is not known. The views must outlive it.
    ServoProblem(std::span<const AxisRecord> records, double period, PointIndex settling);
    /// About `most` records of another problem, in pieces of `piece`: those with the most changes of speed.
    ServoProblem(const ServoProblem& of, PointIndex most, PointIndex piece);
    ServoProblem(const ServoProblem&) = delete;
    ServoProblem& operator=(const ServoProblem&) = delete;
    ~ServoProblem() = default;

    [[nodiscard]] double period() const { return period_; }
    [[nodiscard]] PointIndex count() const { return count_; }
    [[nodiscard]] PointIndex settling() const { return settling_; }
    void set_settling(PointIndex settling);

    /// Sums with derivatives. `width` of the differences that these are taken over: with friction, 1 moves some of the instants at
    /// which the axis sticks, less moves few; below 0: backward. O(records · active terms).
    [[nodiscard]] ServoSums linearise(const ServoParameters& parameters, double width) const;
    /// The same without derivatives. O(records).
    [[nodiscard]] ServoSums evaluate(const ServoParameters& parameters) const;

    /// body(commanded, feedback) of every piece; the spans live as long as the call.
    template <typename Body>
    void for_each_piece(Body&& body) const {
        std::vector<double> commanded, feedback;
        for (const Piece& piece : pieces_) {
            gather(piece, commanded, feedback);
            body(std::span<const double>(commanded), std::span<const double>(feedback));
        }
    }

private:
    struct Piece {
        const AxisRecord* record;
        PointRange range;
    };
    /// Positions relative to the first commanded one: derivatives are small differences.
    static void gather(const Piece& piece, std::vector<double>& commanded, std::vector<double>& feedback);

    std::vector<AxisRecord> records_;
    std::vector<Piece> pieces_;
    double period_;
    PointIndex settling_;
    PointIndex count_ = 0;  ///< residuals
};

}  // namespace clsurf
