#include "simulation/plan/limit_rows.h"

#include <algorithm>
#include <cmath>

#include "core/vectorised.h"

namespace clsurf {
namespace {

double greatest_of(const double* lanes) { return std::max(std::max(lanes[0], lanes[1]), std::max(lanes[2], lanes[3])); }
double sum_of(const double* lanes) { return lanes[0] + lanes[1] + lanes[2] + lanes[3]; }

}  // namespace

/// What runs over all groups. The sides' gradients are fall v ∓ w.
struct LimitRows::Kernels {
    /// Rows come in the order of cells, so that the four of a group are often of one.
    static bool is_of_one_cell(const Group& g) { return g.cell[0] == g.cell[width - 1]; }

    /// Adds the lanes to `sum`, one after the other.
    static void add_lanes(double& sum, const Four& lanes) {
        double all = sum;
        for (std::size_t l = 0; l < width; ++l) all += lanes[l];
        sum = all;
    }

    /// What belongs to the three coefficients about the cells of a group.
    static void gather(Group& g, const double* of) {
        if (is_of_one_cell(g)) {
            const double* const about = of + g.cell[0];
            for (std::size_t q = 0; q < 3; ++q) g.about[q] = Four{about[q], about[q], about[q], about[q]};
            return;
        }
        for (std::size_t q = 0; q < 3; ++q)
            g.about[q] = Four{of[g.cell[0] + q], of[g.cell[1] + q], of[g.cell[2] + q], of[g.cell[3] + q]};
    }

    /// Value of the rows, and their bounds by m.
    static void follow(Group& g, const double* value, Four& at) {
        gather(g, value);
        at = g.w[0] * g.about[0] + g.w[1] * g.about[1] + g.w[2] * g.about[2];
        const Four m = g.unit + g.v[0] * g.about[0] + g.v[1] * g.about[1] + g.v[2] * g.about[2];
        Four root;
        for (std::size_t l = 0; l < width; ++l) root[l] = std::sqrt(m[l]);
        g.root = root;
        g.bound = 1 / root;
        g.fall = -0.5 * g.bound * g.bound * g.bound;
    }

    CLSURF_VECTORISED static void assemble(Group* groups, std::size_t count, const double* value, NewtonSystem& newton,
                                           double* gap, double* broken) {
        Four sum{}, most{};
        double *const d0 = newton.d0.data(), *const d1 = newton.d1.data(), *const d2 = newton.d2.data(),
                      *const pull = newton.pull.data();
        for (std::size_t k = 0; k < count; ++k) {
            Group& g = groups[k];
            Four at;
            follow(g, value, at);
            Four weight[2], force[2];
            for (std::size_t side = 0; side < 2; ++side) {
                const Four left = side == 0 ? g.bound - at : g.low * g.bound + at;
                g.slack[side] = g.slack[side] > left ? g.slack[side] : left;
                g.inverse[side] = 1 / g.slack[side];
                weight[side] = g.multiplier[side] * g.inverse[side];
                sum += g.multiplier[side] * g.slack[side];
                g.missing[side] = g.slack[side] - left;
                const Four part = g.missing[side] * g.root;
                most = most > part ? most : part;
                force[side] = weight[side] * g.missing[side];
            }
            const Four of_w = force[1] - force[0], both = weight[0] + weight[1];
            const Four of_b = g.fall * (force[0] + force[1]), mixed = g.fall * (weight[1] - weight[0]),
                       square = g.fall * g.fall * both;
            Four u[3], t[3], p[3];
            for (std::size_t q = 0; q < 3; ++q) {
                u[q] = both * g.w[q] + mixed * g.v[q];
                t[q] = mixed * g.w[q] + square * g.v[q];
                p[q] = of_w * g.w[q] + of_b * g.v[q];
            }
            const Four d00 = u[0] * g.w[0] + t[0] * g.v[0], d11 = u[1] * g.w[1] + t[1] * g.v[1],
                       d22 = u[2] * g.w[2] + t[2] * g.v[2];
            const Four d01 = u[0] * g.w[1] + t[0] * g.v[1], d12 = u[1] * g.w[2] + t[1] * g.v[2],
                       d02 = u[0] * g.w[2] + t[0] * g.v[2];
            if (is_of_one_cell(g)) {
                const std::size_t c = g.cell[0];
                add_lanes(d0[c], d00);
                add_lanes(d0[c + 1], d11);
                add_lanes(d0[c + 2], d22);
                add_lanes(d1[c], d01);
                add_lanes(d1[c + 1], d12);
                add_lanes(d2[c], d02);
                for (std::size_t q = 0; q < 3; ++q) add_lanes(pull[c + q], p[q]);
                continue;
            }
            for (std::size_t l = 0; l < width; ++l) {
                const std::size_t c = g.cell[l];
                d0[c] += d00[l];
                d0[c + 1] += d11[l];
                d0[c + 2] += d22[l];
                d1[c] += d01[l];
                d1[c + 1] += d12[l];
                d2[c] += d02[l];
                for (std::size_t q = 0; q < 3; ++q) pull[c + q] += p[q][l];
            }
        }
        for (std::size_t l = 0; l < width; ++l) gap[l] = sum[l], broken[l] = most[l];
    }

    CLSURF_VECTORISED static void predict(Group* groups, std::size_t count, const double* step, NewtonSystem& newton,
                                          double* sums) {
        Four primal{}, dual{}, by_primal{}, by_dual{}, by_both{};
        double *const centring = newton.centring.data(), *const products = newton.products.data();
        for (std::size_t k = 0; k < count; ++k) {
            Group& g = groups[k];
            gather(g, step);
            const Four across = g.w[0] * g.about[0] + g.w[1] * g.about[1] + g.w[2] * g.about[2];
            const Four along = g.fall * (g.v[0] * g.about[0] + g.v[1] * g.about[1] + g.v[2] * g.about[2]);
            Four weighted[2];
            for (std::size_t side = 0; side < 2; ++side) {
                const Four slack_step = (side == 0 ? along - across : along + across) - g.missing[side];
                const Four part = slack_step * g.inverse[side];
                const Four multiplier_step = -g.multiplier[side] * (part + 1);
                primal = primal > -part ? primal : -part;
                dual = dual > part + 1 ? dual : part + 1;
                by_primal += slack_step * g.multiplier[side];
                by_dual += g.slack[side] * multiplier_step;
                const Four product = slack_step * multiplier_step;
                by_both += product;
                weighted[side] = product * g.inverse[side];
                g.slack_step[side] = slack_step;
                g.multiplier_step[side] = multiplier_step;
            }
            const Four centre_w = g.inverse[1] - g.inverse[0], centre_v = g.fall * (g.inverse[0] + g.inverse[1]);
            const Four product_w = weighted[1] - weighted[0], product_v = g.fall * (weighted[0] + weighted[1]);
            for (std::size_t q = 0; q < 3; ++q) {
                const Four centres = centre_w * g.w[q] + centre_v * g.v[q];
                const Four corrections = product_w * g.w[q] + product_v * g.v[q];
                if (is_of_one_cell(g)) {
                    add_lanes(centring[g.cell[0] + q], centres);
                    add_lanes(products[g.cell[0] + q], corrections);
                    continue;
                }
                for (std::size_t l = 0; l < width; ++l) {
                    centring[g.cell[l] + q] += centres[l];
                    products[g.cell[l] + q] += corrections[l];
                }
            }
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
            gather(g, step);
            const Four across = g.w[0] * g.about[0] + g.w[1] * g.about[1] + g.w[2] * g.about[2];
            const Four along = g.fall * (g.v[0] * g.about[0] + g.v[1] * g.about[1] + g.v[2] * g.about[2]);
            for (std::size_t side = 0; side < 2; ++side) {
                const Four product = g.slack_step[side] * g.multiplier_step[side];
                const Four slack_step = (side == 0 ? along - across : along + across) - g.missing[side];
                const Four multiplier_step =
                    (centre - product - g.multiplier[side] * slack_step) * g.inverse[side] - g.multiplier[side];
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

void LimitRows::clear() {
    groups_.clear();
    count_ = 0;
}

void LimitRows::add(const LimitRow& row) {
    const std::size_t l = count_ % width;
    if (l == 0) {
        groups_.emplace_back();
        groups_.back().unit += 1;
        groups_.back().low += 1;
    }
    Group& g = groups_.back();
    for (std::size_t q = 0; q < 3; ++q) g.w[q][l] = row.w[q], g.v[q][l] = row.v[q];
    g.unit[l] = row.unit;
    g.low[l] = row.low;
    // The cell of those that fill the group up.
    for (std::size_t k = l; k < width; ++k) g.cell[k] = row.cell;
    g.number[l] = row.number;
    g.kind[l] = row.kind;
    ++count_;
}

void LimitRows::begin(const double* value, double centre, double slack, const LimitRows* before) {
    std::size_t old = 0;
    for (std::size_t k = 0; k < groups_.size(); ++k) {
        Group& g = groups_[k];
        Four at;
        Kernels::follow(g, value, at);
        for (std::size_t l = 0; l < width; ++l) {
            const bool row = k * width + l < count_;
            if (row && before != nullptr && old < before->count_) {
                const Group& from = before->groups_[old / width];
                const std::size_t there = old % width;
                if (from.cell[there] == g.cell[l] && from.number[there] == g.number[l]) {
                    for (std::size_t side = 0; side < 2; ++side) {
                        g.slack[side][l] = from.slack[side][there];
                        g.multiplier[side][l] = from.multiplier[side][there];
                    }
                    ++old;
                    continue;
                }
            }
            const double above = g.bound[l] - at[l], below = g.low[l] * g.bound[l] + at[l];
            g.slack[0][l] = std::max(above, slack * g.bound[l]);
            g.slack[1][l] = g.kind[l] == Row::cap && row ? below : std::max(below, slack * g.bound[l]);
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
    for (std::size_t k = 0; k < count_; ++k) {
        const Group& g = groups_[k / width];
        const std::size_t l = k % width;
        const double* c = value + g.cell[l];
        const double at = g.w[0][l] * c[0] + g.w[1][l] * c[1] + g.w[2][l] * c[2];
        const double m = g.unit[l] + g.v[0][l] * c[0] + g.v[1][l] * c[1] + g.v[2][l] * c[2];
        const double part = std::abs(at) * std::sqrt(m);
        if (part > greatest[g.cell[l]]) greatest[g.cell[l]] = part, nearest[g.cell[l]] = g.kind[l];
    }
}

}  // namespace clsurf
