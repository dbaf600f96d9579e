#include "simulation/plan/limit_rows.h"

#include <algorithm>
#include <cmath>

#include "core/vectorised.h"

namespace clsurf {
namespace {

double greatest_of(const double* lanes) { return std::max(std::max(lanes[0], lanes[1]), std::max(lanes[2], lanes[3])); }
double sum_of(const double* lanes) { return lanes[0] + lanes[1] + lanes[2] + lanes[3]; }

}  // namespace

/// Loops over all groups. The gradients of the sides are fall v ∓ w. The contributions of a cell's groups to the Newton
/// system are summed per lane, and across the lanes once.
struct LimitRows::Kernels {
    using Thirds = std::array<Four, 3>;

    /// Loads the values of the three coefficients of a cell into every lane.
    static Thirds spread(const double* of, std::uint32_t cell) {
        return {Four{} + of[cell], Four{} + of[cell + 1], Four{} + of[cell + 2]};
    }
    static void multiply(const Thirds& a, const Thirds& b, Four& product) {
        product = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    }
    static double across(const Four& lanes) { return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]); }
    static void add_across(double* to, const Thirds& sums) {
        for (std::size_t q = 0; q < 3; ++q) to[q] += across(sums[q]);
    }

    /// Values of the rows, and their bounds, which depend on m.
    static void follow(Group& g, const double* value, Four& at, Four& root, Four& bound) {
        const Thirds about = spread(value, g.cell);
        multiply(g.w, about, at);
        multiply(g.v, about, root);
        root += g.unit;
        root = Four{std::sqrt(root[0]), std::sqrt(root[1]), std::sqrt(root[2]), std::sqrt(root[3])};
        bound = 1 / root;
        g.fall = -0.5 * bound * bound * bound;
    }

    CLSURF_VECTORISED static void assemble(Group* groups, std::size_t count, const double* value, NewtonSystem& newton,
                                           double* gap, double* broken) {
        Four sum{}, most{};
        for (std::size_t k = 0; k < count;) {
            const std::uint32_t cell = groups[k].cell;
            Thirds diagonal{}, pull{};
            Four next[2]{}, second{};
            for (; k < count && groups[k].cell == cell; ++k) {
                Group& g = groups[k];
                Four at{}, root{}, bound{};
                follow(g, value, at, root, bound);
                Four weight[2], force[2];
                for (std::size_t side = 0; side < 2; ++side) {
                    const Four left = side == 0 ? bound - at : g.low * bound + at;
                    g.slack[side] = g.slack[side] > left ? g.slack[side] : left;
                    g.inverse[side] = 1 / g.slack[side];
                    weight[side] = g.multiplier[side] * g.inverse[side];
                    sum += g.multiplier[side] * g.slack[side];
                    g.missing[side] = g.slack[side] - left;
                    const Four part = g.missing[side] * root;
                    most = most > part ? most : part;
                    force[side] = weight[side] * g.missing[side];
                }
                const Four of_w = force[1] - force[0], both = weight[0] + weight[1];
                const Four of_b = g.fall * (force[0] + force[1]), mixed = g.fall * (weight[1] - weight[0]),
                           square = g.fall * g.fall * both;
                Four u[3], t[3];
                for (std::size_t q = 0; q < 3; ++q) {
                    u[q] = both * g.w[q] + mixed * g.v[q];
                    t[q] = mixed * g.w[q] + square * g.v[q];
                    pull[q] += of_w * g.w[q] + of_b * g.v[q];
                    diagonal[q] += u[q] * g.w[q] + t[q] * g.v[q];
                }
                next[0] += u[0] * g.w[1] + t[0] * g.v[1];
                next[1] += u[1] * g.w[2] + t[1] * g.v[2];
                second += u[0] * g.w[2] + t[0] * g.v[2];
            }
            add_across(&newton.d0[cell], diagonal);
            add_across(&newton.pull[cell], pull);
            newton.d1[cell] += across(next[0]);
            newton.d1[cell + 1] += across(next[1]);
            newton.d2[cell] += across(second);
        }
        for (std::size_t l = 0; l < width; ++l) gap[l] = sum[l], broken[l] = most[l];
    }

    CLSURF_VECTORISED static void predict(Group* groups, std::size_t count, const double* step, NewtonSystem& newton,
                                          double* sums) {
        Four primal{}, dual{}, by_primal{}, by_dual{}, by_both{};
        for (std::size_t k = 0; k < count;) {
            const std::uint32_t cell = groups[k].cell;
            const Thirds about = spread(step, cell);
            Thirds centring{}, corrections{};
            for (; k < count && groups[k].cell == cell; ++k) {
                Group& g = groups[k];
                Four sideways, along;
                multiply(g.w, about, sideways);
                multiply(g.v, about, along);
                along *= g.fall;
                Four weighted[2];
                for (std::size_t side = 0; side < 2; ++side) {
                    const Four slack_step = (side == 0 ? along - sideways : along + sideways) - g.missing[side];
                    const Four part = slack_step * g.inverse[side];
                    const Four multiplier_step = -g.multiplier[side] * (part + 1);
                    primal = primal > -part ? primal : -part;
                    dual = dual > part + 1 ? dual : part + 1;
                    by_primal += slack_step * g.multiplier[side];
                    by_dual += g.slack[side] * multiplier_step;
                    g.product[side] = slack_step * multiplier_step;
                    by_both += g.product[side];
                    weighted[side] = g.product[side] * g.inverse[side];
                }
                const Four centre_w = g.inverse[1] - g.inverse[0], centre_v = g.fall * (g.inverse[0] + g.inverse[1]);
                const Four product_w = weighted[1] - weighted[0], product_v = g.fall * (weighted[0] + weighted[1]);
                for (std::size_t q = 0; q < 3; ++q) {
                    centring[q] += centre_w * g.w[q] + centre_v * g.v[q];
                    corrections[q] += product_w * g.w[q] + product_v * g.v[q];
                }
            }
            add_across(&newton.centring[cell], centring);
            add_across(&newton.products[cell], corrections);
        }
        for (std::size_t l = 0; l < width; ++l) {
            sums[l] = primal[l];
            sums[width + l] = dual[l];
            sums[2 * width + l] = by_primal[l];
            sums[3 * width + l] = by_dual[l];
            sums[4 * width + l] = by_both[l];
        }
    }

    CLSURF_VECTORISED static void correct(Group* groups, std::size_t count, const double* step, double centre,
                                          double* sums) {
        Four primal{}, dual{};
        for (std::size_t k = 0; k < count; ++k) {
            Group& g = groups[k];
            const Thirds about = spread(step, g.cell);
            Four sideways, along;
            multiply(g.w, about, sideways);
            multiply(g.v, about, along);
            along *= g.fall;
            for (std::size_t side = 0; side < 2; ++side) {
                const Four slack_step = (side == 0 ? along - sideways : along + sideways) - g.missing[side];
                const Four multiplier_step =
                    (centre - g.product[side] - g.multiplier[side] * slack_step) * g.inverse[side] - g.multiplier[side];
                const Four shrinking = -slack_step * g.inverse[side], falling = -multiplier_step / g.multiplier[side];
                primal = primal > shrinking ? primal : shrinking;
                dual = dual > falling ? dual : falling;
                g.slack_step[side] = slack_step;
                g.multiplier_step[side] = multiplier_step;
            }
        }
        for (std::size_t l = 0; l < width; ++l) sums[l] = primal[l], sums[width + l] = dual[l];
    }

    CLSURF_VECTORISED static void advance(Group* groups, std::size_t count, double primal, double dual) {
        for (std::size_t k = 0; k < count; ++k) {
            Group& g = groups[k];
            for (std::size_t side = 0; side < 2; ++side) {
                g.slack[side] += primal * g.slack_step[side];
                g.multiplier[side] += dual * g.multiplier_step[side];
            }
        }
    }
};

void LimitRows::clear() { groups_.clear(); }

void LimitRows::add(const LimitRow& row) {
    if (groups_.empty() || groups_.back().cell != row.cell || groups_.back().rows == width) {
        Group& group = groups_.emplace_back();
        group.unit += 1;
        group.low += 1;
        group.cell = row.cell;
    }
    Group& g = groups_.back();
    const std::size_t l = g.rows++;
    for (std::size_t q = 0; q < 3; ++q) g.w[q][l] = row.w[q], g.v[q][l] = row.v[q];
    g.unit[l] = row.unit;
    g.low[l] = row.low;
    g.number[l] = row.number;
    g.kind[l] = row.kind;
}

void LimitRows::keep(const LimitRows& before, std::uint32_t cell) {
    const auto first = std::lower_bound(before.groups_.begin(), before.groups_.end(), cell,
                                        [](const Group& group, std::uint32_t at) { return group.cell < at; });
    auto last = first;
    while (last != before.groups_.end() && last->cell == cell) ++last;
    groups_.insert(groups_.end(), first, last);
}

void LimitRows::begin(const double* value, double centre, double slack, const LimitRows* before) {
    // Finds the next row in `before`; both are in the order of cells and numbers.
    std::size_t old = 0, lane = 0;
    for (Group& g : groups_) {
        if (g.begun) continue;
        g.begun = true;
        for (; before != nullptr && old < before->groups_.size() && before->groups_[old].cell < g.cell; ++old) lane = 0;
        Four at{}, root{}, bound{};
        Kernels::follow(g, value, at, root, bound);
        for (std::size_t l = 0; l < width; ++l) {
            const bool row = l < g.rows;
            if (row && before != nullptr && old < before->groups_.size()) {
                const Group& from = before->groups_[old];
                if (from.cell == g.cell && from.number[lane] == g.number[l]) {
                    for (std::size_t side = 0; side < 2; ++side) {
                        g.slack[side][l] = from.slack[side][lane];
                        g.multiplier[side][l] = from.multiplier[side][lane];
                    }
                    if (++lane == from.rows) ++old, lane = 0;
                    continue;
                }
            }
            const double above = bound[l] - at[l], below = g.low[l] * bound[l] + at[l];
            g.slack[0][l] = std::max(above, slack * bound[l]);
            g.slack[1][l] = g.kind[l] == Row::cap && row ? below : std::max(below, slack * bound[l]);
            for (std::size_t side = 0; side < 2; ++side) g.multiplier[side][l] = centre / g.slack[side][l];
        }
    }
}

LimitRows::Gap LimitRows::assemble(const double* value, NewtonSystem& newton) {
    double gap[width], broken[width];
    Kernels::assemble(groups_.data(), groups_.size(), value, newton, gap, broken);
    return {sum_of(gap), greatest_of(broken)};
}

LimitRows::Steps LimitRows::predict(const double* step, NewtonSystem& newton) {
    double sums[5 * width];
    Kernels::predict(groups_.data(), groups_.size(), step, newton, sums);
    return {greatest_of(sums), greatest_of(sums + width), sum_of(sums + 2 * width), sum_of(sums + 3 * width),
            sum_of(sums + 4 * width)};
}

LimitRows::Steps LimitRows::correct(const double* step, double centre) {
    double sums[2 * width];
    Kernels::correct(groups_.data(), groups_.size(), step, centre, sums);
    return {greatest_of(sums), greatest_of(sums + width)};
}

void LimitRows::advance(double primal, double dual) { Kernels::advance(groups_.data(), groups_.size(), primal, dual); }

void LimitRows::judge(const double* value, std::vector<Row>& nearest) const {
    std::vector<double> greatest(nearest.size(), 0);
    for (const Group& g : groups_) {
        const double* c = value + g.cell;
        for (std::size_t l = 0; l < g.rows; ++l) {
            const double at = g.w[0][l] * c[0] + g.w[1][l] * c[1] + g.w[2][l] * c[2];
            const double m = g.unit[l] + g.v[0][l] * c[0] + g.v[1][l] * c[1] + g.v[2][l] * c[2];
            const double part = std::abs(at) * std::sqrt(m);
            if (part > greatest[g.cell]) greatest[g.cell] = part, nearest[g.cell] = g.kind[l];
        }
    }
}

}  // namespace clsurf
