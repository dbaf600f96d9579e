#pragma once
// Geometry: the cells to draw, already reduced to what pixels can show (made by detail.h, drawn by scene.h).

#include <cstdint>
#include <cstring>

#include "core/column.h"
#include "core/geometry.h"

namespace clsurf::viz {

/// Appends a column to another.
template <typename T>
void append(Column<T>& all, const Column<T>& part) {
    const std::size_t at = all.size();
    all.resize(at + part.size());
    if (!part.empty()) std::memcpy(all.data() + at, part.data(), part.size() * sizeof(T));
}

struct Geometry {
    Vec3 origin = Vec3::Zero();       ///< [mm]; vertices are relative to it, so that float is sufficient
    Column<float> xyz;                ///< 3 per vertex [mm]
    Column<std::uint8_t> rgb;         ///< 3 per vertex
    Column<float> normals;            ///< 3 per vertex, unit length; empty: not lit
    Column<std::uint32_t> triangles;  ///< 3 vertex numbers each
    Column<std::uint32_t> segments;   ///< 2 vertex numbers each, drawn as lines
    Column<std::uint32_t> points;     ///< 1 vertex number each, drawn as dots
};

}  // namespace clsurf::viz
