#pragma once
// LimitRows: the limits of a SpeedProblem as rows of its interior-point method, four of a cell side by side.
//
// A row is −low/√m ≤ w · c ≤ 1/√m, where c are the three coefficients of b around its cell. For a jerk limit m
// is b at this place, otherwise 1. Each side is g ≥ 0 with a slack s > 0 and a multiplier. The slack equals g
// once an infeasible start has been corrected. The contribution of a row to the Newton matrix affects the
// three coefficients of its cell.

#include <array>
#include <cstdint>
#include <vector>

namespace clsurf {

/// What may rule in a cell.
enum class Row : std::uint8_t {
    cap,
    bend,  ///< the speed where the path bends: normal acceleration or chord error
    tangential_acceleration,
    axis_acceleration,
    tangential_jerk,
    axis_jerk,
    bend_jerk,  ///< that the bend of the path alone takes of an axis, at constant speed
};

struct LimitRow {
    std::array<double, 3> w{}, v{};  ///< m = unit + v · c
    double unit = 1, low = 1;
    std::uint32_t cell = 0, number = 0;  ///< number: of its place and what it limits, in the cell
    Row kind = Row::cap;
};

/// The Newton matrix by its diagonals, and its right side but for the barrier; a place for each coefficient.
struct NewtonSystem {
    std::vector<double> d0, d1, d2, pull;
    std::vector<double> centring, products;  ///< right sides of the corrector: by the centre, and of products of steps
};

class LimitRows {
public:
    /// Greatest steps of slacks and multipliers to their limits, as 1/step; and sums over the sides.
    struct Steps {
        double primal = 0, dual = 0;
        double by_primal = 0, by_dual = 0, by_both = 0;  ///< how the gap changes with the steps taken
    };
    struct Gap {
        double sum = 0;     ///< of slack times multiplier
        double broken = 0;  ///< greatest part of a bound that a limit is broken by
    };

    void clear();
    /// After the last one, in the order of cells and numbers.
    void add(const LimitRow& row);
    /// The rows of a cell as they are in the middle of there, after the last one.
    void keep(const LimitRows& before, std::uint32_t cell);
    /// Sides of all rows, and of those that fill the last four of a cell up: 0 · c, which limit nothing.
    [[nodiscard]] double sides() const { return static_cast<double>(2 * width * groups_.size()); }

    /// Slacks of at least a part of the bound, and multipliers for a product of `centre`. Rows that are in
    /// `before` go on with what they are in the middle of there. Rows that were kept stay as they are.
    void begin(const double* value, double centre, double slack, const LimitRows* before = nullptr);

    /// Adds the rows to the matrix and right side. A bound that is convex leaves more than its tangent did.
    Gap assemble(const double* value, NewtonSystem& newton);
    /// Steps of slacks and multipliers without a barrier for a step of the coefficients; what the corrector needs of them.
    Steps predict(const double* step, NewtonSystem& newton);
    /// Steps towards `centre`, corrected by the products of those before (Mehrotra 1992).
    Steps correct(const double* step, double centre);
    /// Takes parts of the steps.
    void advance(double primal, double dual);

    /// The kind of the row that each cell is nearest to; a cell without rows stays as it is.
    void judge(const double* value, std::vector<Row>& nearest) const;

private:
    static constexpr std::size_t width = 4;
    typedef double Four [[gnu::vector_size(32)]];
    /// Rows of one cell. As AVX loads them; where it may not be there, the compiler aligns them to 16.
    struct alignas(sizeof(Four)) Group {
        std::array<Four, 3> w{}, v{};
        Four unit{}, low{};
        Four fall{};  ///< derivative of 1/√m by m
        // Of the side above, then of that below; the product of the steps without a barrier.
        std::array<Four, 2> slack{}, multiplier{}, inverse{}, missing{}, product{}, slack_step{}, multiplier_step{};
        std::uint32_t cell = 0, rows = 0;  ///< rows: how many; the others limit nothing
        bool begun = false;                ///< it has slacks and multipliers
        std::array<std::uint32_t, width> number{};
        std::array<Row, width> kind{};
    };
    struct Kernels;

    std::vector<Group> groups_;
};

}  // namespace clsurf
