#include "viz/mesh_samples.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

namespace clsurf::viz {
namespace {

constexpr Rgb red{255, 0, 0}, green{0, 255, 0}, blue{0, 0, 255}, white{255, 255, 255};

/// One row of samples from x on, all in one colour.
void add_row(MeshSamples& samples, CellKind kind, int x, const std::vector<float>& depths, const Rgb& rgb) {
    std::vector<std::uint8_t> colours;
    for (std::size_t k = 0; k < depths.size(); ++k) colours.insert(colours.end(), rgb.begin(), rgb.end());
    samples.add(kind, {{x, 0, static_cast<int>(depths.size()), 1}, colours, depths});
}

/// A letter for the colour of each sample.
std::string letters(const MeshSamples& samples) {
    const Column<std::uint8_t> rgb = samples.over(white);
    std::string text;
    for (std::size_t k = 0; k + 2 < rgb.size(); k += 3) {
        const Rgb at{rgb[k], rgb[k + 1], rgb[k + 2]};
        text += at == red ? 'r' : at == green ? 'g' : at == blue ? 'b' : '.';
    }
    return text;
}

TEST(MeshSamples, TheNearerIsSeenAndOfTwoAtOneDepthTheEarlier) {
    MeshSamples samples(4, 1);
    add_row(samples, CellKind::triangles, 0, {0.5F, 0.5F, 0.5F}, red);
    add_row(samples, CellKind::triangles, 0, {0.4F, 0.5F, 0.6F, 1.0F}, green);
    EXPECT_EQ(letters(samples), "grr.");
}

TEST(MeshSamples, KindsCompeteWhenAllPartsAreThere) {
    // A line of the second part is as near as a triangle of the first one: in the whole mesh, lines are drawn first.
    MeshSamples first(2, 1), second(2, 1);
    add_row(first, CellKind::triangles, 0, {0.5F, 0.5F}, red);
    add_row(second, CellKind::lines_and_points, 0, {0.5F, 0.6F}, blue);
    first.add(second);
    EXPECT_EQ(letters(first), "br");
}

TEST(MeshSamples, BytesKeepEverySample) {
    MeshSamples samples(5, 3);
    add_row(samples, CellKind::triangles, 1, {0.5F, 1.0F, 0.25F}, red);
    add_row(samples, CellKind::bare_lines_and_points, 4, {0.75F}, blue);
    const std::string bytes = samples.bytes() + "rest";
    std::string_view left = bytes;
    const std::optional<MeshSamples> read = MeshSamples::read(left);
    ASSERT_TRUE(read);
    EXPECT_EQ(left, "rest");
    EXPECT_EQ(letters(*read), letters(samples));
    EXPECT_EQ(read->bytes() + "rest", bytes);
    for (std::size_t size = 0; size + 5 < bytes.size(); ++size) {
        std::string_view cut = std::string_view(bytes).substr(0, size);
        EXPECT_FALSE(MeshSamples::read(cut)) << size;
    }
}

TEST(MeshSamples, RunsThatLeaveTheRowAreRefused) {
    MeshSamples samples(2, 1);
    add_row(samples, CellKind::lines_and_points, 0, {0.5F, 0.5F}, red);
    std::string bytes = samples.bytes();
    bytes[9] = 1;  // the first sample of the run, which has two
    std::string_view left = bytes;
    EXPECT_FALSE(MeshSamples::read(left));
}

}  // namespace
}  // namespace clsurf::viz
