#pragma once
// ServoProblem: the difference between the feedback positions of an axis and the response of ServoLoop
// (simulation/run/servo.h) to the commanded positions, as a least-squares problem in the loop's parameters (output error;
// Ljung, System Identification, 2nd ed., ch. 7). Derivatives are differences between loops that run in parallel.

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "identify/axis_record.h"
#include "machine/machine.h"

namespace clsurf {

/// The unknowns. The gain is searched as its logarithm. The time constant of the velocity loop is searched as the step 1 −
/// exp(−T/T_v) of the loop without an integral, and the integral time as its inverse T/T_n.
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
    /// Number of parameters that are searched.
    [[nodiscard]] int count() const;
};

/// The loop with these parameters, without quantum and noise.
[[nodiscard]] ServoModel model_of(const ServoParameters& parameters, double period);
/// The parameters of a loop.
[[nodiscard]] ServoParameters parameters_of(const ServoModel& model, double period);

using ServoMatrix = Eigen::Matrix<double, servo_terms, servo_terms>;
using ServoVector = Eigen::Matrix<double, servo_terms, 1>;

/// Sums over the records; rows of inactive terms are zero.
struct ServoSums {
    double squares = 0;                         ///< of the residuals [unit²]
    double squared_changes = 0;                 ///< of the residuals, from one record to the next [unit²]
    PointIndex count = 0;                       ///< residuals
    PointIndex changes = 0;                     ///< pairs of successive residuals: a piece has one fewer than residuals
    ServoMatrix normal = ServoMatrix::Zero();   ///< Jᵀ J
    ServoMatrix scatter = ServoMatrix::Zero();  ///< Σ s sᵀ over groups of records, s = Jᵀ e of the group
    ServoVector gradient = ServoVector::Zero();  ///< Jᵀ e

    [[nodiscard]] double mean_square() const { return count > 0 ? squares / static_cast<double>(count) : 0; }
    /// Half the mean square of the residuals' changes: the variance if residuals were independent [unit²].
    [[nodiscard]] double variance_of_changes() const {
        return squared_changes / (2 * static_cast<double>(std::max<PointIndex>(changes, 1)));
    }
};

class ServoProblem {
public:
    /// The records are sampled in pieces, at most 10^6 of them. `settling`: number of records at the start of a piece that
    /// do not count, because the state before them is unknown. The views must outlive the object.
    ServoProblem(std::span<const AxisRecord> records, double period, PointIndex settling);
    /// Takes about `most` records of another problem, in pieces of `piece`: those with the greatest changes of speed.
    ServoProblem(const ServoProblem& of, PointIndex most, PointIndex piece);
    ServoProblem(const ServoProblem&) = delete;
    ServoProblem& operator=(const ServoProblem&) = delete;
    ~ServoProblem() = default;

    [[nodiscard]] double period() const { return period_; }
    [[nodiscard]] PointIndex count() const { return count_; }
    [[nodiscard]] PointIndex settling() const { return settling_; }
    void set_settling(PointIndex settling);

    /// Sums with derivatives. `width`: of the differences that replace the derivatives. With friction, 1 moves some of the
    /// instants at which the axis sticks, and less moves few; negative: backward. O(records · active terms).
    [[nodiscard]] ServoSums linearise(const ServoParameters& parameters, double width) const;
    /// The same sums without derivatives. O(records).
    [[nodiscard]] ServoSums evaluate(const ServoParameters& parameters) const;

    /// Calls body(commanded, feedback) for every piece; the spans are valid during the call.
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
    /// Positions relative to the first commanded one, because derivatives are small differences.
    static void gather(const Piece& piece, std::vector<double>& commanded, std::vector<double>& feedback);

    std::vector<AxisRecord> records_;
    std::vector<Piece> pieces_;
    double period_;
    PointIndex settling_;
    PointIndex count_ = 0;  ///< residuals
};

}  // namespace clsurf
