// Compares the reader of expressions with independently evaluated trees: random expressions with no more brackets than
// operator precedence requires, in the notation of RS274 and in that of Fanuc's macros.
#include <cmath>
#include <memory>
#include <random>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "program/interpreter.h"

namespace clsurf::random_expressions_test {
namespace {

struct Tree {
    std::string text;
    double value = 0;
    int binding = 4;  ///< of its outermost operator: 4 none, 3 power, 2 product, 1 sum
};

class Grower {
public:
    Grower(std::uint64_t seed, bool power) : random_(seed), power_(power) {}

    Tree grow(int depth) {
        if (depth == 0 || chance(0.2)) return leaf();
        if (chance(0.2)) return function(depth);
        const Tree a = grow(depth - 1), b = grow(depth - 1);
        switch (whole(power_ ? 5 : 4)) {
            case 0: return join(a, "+", b, 1, a.value + b.value);
            case 1: return join(a, "-", b, 1, a.value - b.value);
            case 2: return join(a, "*", b, 2, a.value * b.value);
            case 3: return b.value == 0 ? a : join(a, "/", b, 2, a.value / b.value);
            default: return power(a);
        }
    }

private:
    Tree leaf() {
        const double value = static_cast<double>(whole(2000)) / 100;
        return {fmt::format("{:.2f}", value), value, 4};
    }
    Tree function(int depth) {
        const Tree of = grow(depth - 1);
        const double degrees = std::acos(-1.0) / 180;
        switch (whole(4)) {
            case 0: return {"ABS[" + of.text + "]", std::abs(of.value), 4};
            case 1: return {"SQRT[ABS[" + of.text + "]]", std::sqrt(std::abs(of.value)), 4};
            case 2: return {"SIN[" + of.text + "]", std::sin(of.value * degrees), 4};
            default: return {"COS[" + of.text + "]", std::cos(of.value * degrees), 4};
        }
    }
    Tree power(const Tree& a) {
        const int exponent = whole(3);
        const Tree b{fmt::format("{}", exponent), static_cast<double>(exponent), 4};
        return join(a, "**", b, 3, std::pow(a.value, exponent));
    }
    /// All operators are left-associative: an equal one on the right needs brackets.
    static Tree join(const Tree& a, const char* op, const Tree& b, int binding, double value) {
        const auto bracketed = [](const Tree& t, bool needed) { return needed ? "[" + t.text + "]" : t.text; };
        return {bracketed(a, a.binding < binding) + " " + op + " " + bracketed(b, b.binding <= binding), value,
                binding};
    }
    int whole(int below) { return std::uniform_int_distribution<int>(0, below - 1)(random_); }
    bool chance(double part) { return std::uniform_real_distribution<double>(0, 1)(random_) < part; }

    std::mt19937_64 random_;
    bool power_;
};

TEST(RandomExpressions, AreWhatTheirTreesAre) {
    for (const char* dialect : {"linuxcnc", "fanuc"}) {
        constexpr int count = 10000;
        Grower grower(20260722, std::string(dialect) == "linuxcnc");
        std::string text = std::string(dialect) == "fanuc" ? "%\nO1\nG21 G90\n" : "G21 G90\n";
        std::vector<Tree> trees;
        while (trees.size() < count) {
            Tree tree = grower.grow(4);
            // Values in the range of an axis: positions in mm.
            if (!(std::abs(tree.value) < 9000) || tree.text.size() > 200) continue;
            text += "G1 F600 X[" + tree.text + "]\n";
            trees.push_back(std::move(tree));
        }
        text += "M30\n";
        const auto kept = std::make_shared<std::string>(text);
        InterpreterOptions options;
        options.dialect = find_dialect(dialect);
        const Program program = parse_program(SourceText("made.nc", *kept, kept), options);
        const LineNumber first = std::string(dialect) == "fanuc" ? 4 : 2;
        ASSERT_FALSE(program.diagnostics.has_errors()) << dialect;
        // A motion of zero length may be omitted: each is looked up by its line.
        std::size_t found = 0;
        for (std::size_t m = 0; m < program.motions.kind.size(); ++m) {
            const auto k = static_cast<std::size_t>(program.motions.line[m] - first);
            ASSERT_LT(k, trees.size());
            const double x = program.motions.end[m].x;
            ASSERT_NEAR(x, trees[k].value, 1e-9 * std::max(1.0, std::abs(trees[k].value)))
                << dialect << ": " << trees[k].text;
            ++found;
        }
        EXPECT_GT(found, trees.size() * 9 / 10);
    }
}

}  // namespace
}  // namespace clsurf::random_expressions_test
