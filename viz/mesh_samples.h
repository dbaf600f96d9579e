#pragma once
// MeshSamples: colours and depths of meshes, sample by sample, so that parts that were drawn separately give the picture of
// the whole (sort-last rendering with depth compositing: Molnar, Cox, Ellsworth, Fuchs, IEEE CG&A 14(4), 1994).

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/column.h"
#include "viz/colour_map.h"

namespace clsurf::viz {

/// Cells of a mesh, in drawing order: of two at the same depth the earlier one is visible.
enum class CellKind : std::uint8_t { lines_and_points, triangles, bare_triangles, bare_lines_and_points };
constexpr std::size_t cell_kinds = 4;

/// A rectangle of samples, from the lower left corner of the picture.
struct SampleRect {
    int x = 0, y = 0, width = 0, height = 0;
    [[nodiscard]] std::size_t count() const {
        return width > 0 && height > 0 ? static_cast<std::size_t>(width) * static_cast<std::size_t>(height) : 0;
    }
};

/// The samples of one kind of cells in a rectangle, in rows from the bottom.
struct DrawnSamples {
    SampleRect rect;
    std::span<const std::uint8_t> rgb;  ///< 3 per sample
    std::span<const float> depth;       ///< 0 … 1, as in OpenGL: less is nearer; 1: empty
};

class MeshSamples {
public:
    MeshSamples() = default;
    /// Without meshes.
    MeshSamples(int width, int height) : width_(width), height_(height) {}

    /// Nearer samples replace existing ones. O(samples of the rectangle). Domain: the rectangle is inside the picture.
    void add(CellKind kind, const DrawnSamples& drawn);
    /// Adds parts that are later in the whole mesh. Domain: the same size.
    void add(const MeshSamples& later);

    /// The colours, in rows from the bottom, over a background.
    [[nodiscard]] Column<std::uint8_t> over(const Rgb& background) const;

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

    /// The input of read(): of each row the samples from the first to the last one that a mesh covers. Little-endian.
    [[nodiscard]] std::string bytes() const;
    /// Takes its bytes from the front of `bytes`. Nothing: wrong or truncated bytes.
    [[nodiscard]] static std::optional<MeshSamples> read(std::string_view& bytes);

private:
    struct Layer {
        Column<std::uint8_t> rgb;  ///< empty: no cells of this kind
        Column<float> depth;
    };
    [[nodiscard]] std::size_t count() const { return SampleRect{0, 0, width_, height_}.count(); }
    Layer& layer_of(std::size_t kind);

    int width_ = 0, height_ = 0;
    std::array<Layer, cell_kinds> layers_;
};

}  // namespace clsurf::viz
