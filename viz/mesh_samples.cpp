#include "viz/mesh_samples.h"

#include <algorithm>

#include "viz/byte_reader.h"

namespace clsurf::viz {
namespace {

constexpr float nothing = 1;  ///< the depth of empty samples
constexpr std::uint32_t most_side = 1U << 16U;

/// Two numbers: width and height, or the first sample of a run and the number of samples.
using Pair = std::array<std::uint32_t, 2>;

void append_pair(std::string& bytes, std::size_t a, std::size_t b) {
    const Pair pair{static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)};
    append_bytes(bytes, std::span<const std::uint32_t>(pair));
}

}  // namespace

MeshSamples::Layer& MeshSamples::layer_of(std::size_t kind) {
    Layer& layer = layers_[kind];
    if (layer.depth.empty() && count() > 0) {
        layer.rgb = Column<std::uint8_t>(3 * count());
        layer.depth = Column<float>(count(), nothing);
    }
    return layer;
}

void MeshSamples::add(CellKind kind, const DrawnSamples& drawn) {
    if (std::ranges::all_of(drawn.depth, [](float depth) { return !(depth < nothing); })) return;
    Layer& layer = layer_of(static_cast<std::size_t>(kind));
    for (int row = 0; row < drawn.rect.height; ++row) {
        std::size_t from = static_cast<std::size_t>(row) * static_cast<std::size_t>(drawn.rect.width);
        std::size_t to = static_cast<std::size_t>(drawn.rect.y + row) * static_cast<std::size_t>(width_) +
                         static_cast<std::size_t>(drawn.rect.x);
        for (int column = 0; column < drawn.rect.width; ++column, ++from, ++to) {
            const float depth = drawn.depth[from];
            if (!(depth < layer.depth[to])) continue;
            layer.depth[to] = depth;
            std::copy_n(drawn.rgb.data() + 3 * from, 3, layer.rgb.data() + 3 * to);
        }
    }
}

void MeshSamples::add(const MeshSamples& later) {
    for (std::size_t kind = 0; kind < cell_kinds; ++kind) {
        const Layer& layer = later.layers_[kind];
        if (layer.depth.empty()) continue;
        add(static_cast<CellKind>(kind), {{0, 0, width_, height_},
                                          std::span(layer.rgb.data(), layer.rgb.size()),
                                          std::span(layer.depth.data(), layer.depth.size())});
    }
}

Column<std::uint8_t> MeshSamples::over(const Rgb& background) const {
    Column<std::uint8_t> rgb(3 * count());
    Column<float> nearest(count(), nothing);
    for (std::size_t i = 0; i < count(); ++i) std::copy(background.begin(), background.end(), rgb.data() + 3 * i);
    for (const Layer& layer : layers_) {
        for (std::size_t i = 0; i < layer.depth.size(); ++i) {
            if (!(layer.depth[i] < nearest[i])) continue;
            nearest[i] = layer.depth[i];
            std::copy_n(layer.rgb.data() + 3 * i, 3, rgb.data() + 3 * i);
        }
    }
    return rgb;
}

std::string MeshSamples::bytes() const {
    std::string bytes;
    const auto columns = static_cast<std::size_t>(width_);
    append_pair(bytes, columns, static_cast<std::size_t>(height_));
    for (const Layer& layer : layers_) {
        bytes += layer.depth.empty() ? '\0' : '\1';
        for (std::size_t row = 0; row * columns < layer.depth.size(); ++row) {
            const float* const depth = layer.depth.data() + row * columns;
            const auto covered = [](float d) { return d < nothing; };
            const auto first = static_cast<std::size_t>(std::find_if(depth, depth + columns, covered) - depth);
            std::size_t end = columns;
            while (end > first && !covered(depth[end - 1])) --end;
            append_pair(bytes, first, end - first);
            append_bytes(bytes, std::span(layer.rgb).subspan(3 * (row * columns + first), 3 * (end - first)));
            append_bytes(bytes, std::span<const float>(depth + first, end - first));
        }
    }
    return bytes;
}

std::optional<MeshSamples> MeshSamples::read(std::string_view& bytes) {
    Pair size{};
    if (!take_bytes(bytes, std::span(size)) || size[0] > most_side || size[1] > most_side) return std::nullopt;
    MeshSamples samples(static_cast<int>(size[0]), static_cast<int>(size[1]));
    const std::size_t columns = size[0], rows = size[1];
    for (std::size_t kind = 0; kind < cell_kinds; ++kind) {
        std::array<char, 1> there{};
        if (!take_bytes(bytes, std::span(there))) return std::nullopt;
        if (there[0] == 0) continue;
        if (bytes.size() / sizeof(Pair) < rows) return std::nullopt;  // checked before memory is allocated
        Layer& layer = samples.layer_of(kind);
        for (std::size_t row = 0; row < rows; ++row) {
            Pair run{};
            if (!take_bytes(bytes, std::span(run)) || run[0] > columns || run[1] > columns - run[0])
                return std::nullopt;
            const std::size_t at = row * columns + run[0];
            if (!take_bytes(bytes, std::span(layer.rgb).subspan(3 * at, 3 * std::size_t{run[1]})) ||
                !take_bytes(bytes, std::span(layer.depth).subspan(at, run[1])))
                return std::nullopt;
        }
    }
    return samples;
}

}  // namespace clsurf::viz
