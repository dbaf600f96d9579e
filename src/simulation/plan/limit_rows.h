#pragma once
// LimitRows: the limits of a SpeedProblem as rows of its interior-point method. Four rows of a cell are computed at once.
//
// A row is −low/√m ≤ w · c ≤ 1/√m, where c are the three coefficients of b around its cell. For a jerk limit m
// is b at this place, otherwise 1. Each side is g ≥ 0 with a slack s > 0 and a multiplier. The slack equals g
// once an infeasible start has been corrected. The contribution of a row to the Newton matrix affects the
// three coefficients of its cell.

#include <array>
#include <cstdint>
#include <vector>

namespace clsurf {

/// The limits that may determine the speed in a cell.
enum class Row : std::uint8_t {
    cap,
    bend,  ///< speed limit of a bend: normal acceleration or chord error
    tangential_acceleration,
    axis_acceleration,
    tangential_jerk,
    axis_jerk,
    bend_jerk,  ///< axis jerk that the bend of the path causes at constant speed
};

struct LimitRow {
    std::array<double, 3> w{}, v{};  ///< m = unit + v · c
    double unit = 1, low = 1;
    std::uint32_t cell = 0, number = 0;  ///< number: identifies the place and the limit within the cell
    Row kind = Row::cap;
};

/// The diagonals of the Newton matrix, and its right side without the barrier; one entry for each coefficient.
struct NewtonSystem {
    std::vector<double> d0, d1, d2, pull;
    std::vector<double> centring, products;  ///< right sides of the corrector: centring, and products of steps
};

class LimitRows {
public:
    /// Greatest relative reductions of slacks and multipliers, as 1/(step length to the bound), and sums over the sides.
    struct Steps {
        double primal = 0, dual = 0;
        double by_primal = 0, by_dual = 0, by_both = 0;  ///< how the gap changes with the steps
    };
    struct Gap {
        double sum = 0;     ///< sum of slack times multiplier
        double broken = 0;  ///< greatest violation of a limit, as a share of its bound
    };

    void clear();
    /// Appends a row; rows come in the order of cells and numbers.
    void add(const LimitRow& row);
    /// Appends the rows of a cell from `before`, with their present slacks and multipliers.
    void keep(const LimitRows& before, std::uint32_t cell);
    /// Sides of all rows, including the padding rows 0 · c, which fill up the last group of a cell and limit nothing.
    [[nodiscard]] double sides() const { return static_cast<double>(2 * width * groups_.size()); }

    /// Sets slacks to at least a share of the bound, and multipliers so that their product with the slack is `centre`. Rows
    /// that are also in `before` take their slacks and multipliers from there. Rows that were kept remain as they are.
    void begin(const double* value, double centre, double slack, const LimitRows* before = nullptr);

    /// Adds the rows to the matrix and right side. A convex bound lies above its tangent: slacks grow to the true distance.
    Gap assemble(const double* value, NewtonSystem& newton);
    /// Affine steps (without barrier) of slacks and multipliers for a step of the coefficients, and the data for the
    /// corrector.
    Steps predict(const double* step, NewtonSystem& newton);
    /// Steps towards `centre`, corrected by the products of the affine steps (Mehrotra 1992).
    Steps correct(const double* step, double centre);
    /// Takes shares of the steps.
    void advance(double primal, double dual);

    /// Finds the kind of row that each cell is nearest to. A cell without rows keeps its value.
    void judge(const double* value, std::vector<Row>& nearest) const;

private:
    static constexpr std::size_t width = 4;
    typedef double Four [[gnu::vector_size(32)]];
    /// Rows of one cell, aligned for AVX loads. On processors without AVX the compiler aligns vectors to 16.
    struct alignas(sizeof(Four)) Group {
        std::array<Four, 3> w{}, v{};
        Four unit{}, low{};
        Four fall{};  ///< derivative of 1/√m by m
        // Index 0: the upper side, 1: the lower side. `product`: of the affine steps.
        std::array<Four, 2> slack{}, multiplier{}, inverse{}, missing{}, product{}, slack_step{}, multiplier_step{};
        std::uint32_t cell = 0, rows = 0;  ///< rows: number of rows; the rest is padding
        bool begun = false;                ///< it has slacks and multipliers
        std::array<std::uint32_t, width> number{};
        std::array<Row, width> kind{};
    };
    struct Kernels;

    std::vector<Group> groups_;
};

}  // namespace clsurf
