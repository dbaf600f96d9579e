#pragma once
// Geometry: what is drawn, already cut to what pixels can show (detail.h makes it, scene.h draws it).

#include <cstdint>
#include <cstring>

#include "core/column.h"
#include "core/geometry.h"

namespace clsurf::viz {

/// Puts one column behind another.
template <typename T>
void append(Column<T>& all, const Column<T>& part) {
    const std::size_t at = all.size();
    all.resize(at + part.size());
    if (!part.empty()) std::memcpy(all.data() + at, part.data(), part.size() * sizeof(T));
}

struct Geometry {
    Vec3 origin = Vec3::Zero();       ///< [mm]; vertices are relative to it, so float is enough
    Column<float> xyz;                ///< 3 per vertex [mm]
    Column<std::uint8_t> rgb;         ///< 3 per vertex
    Column<float> normals;            ///< 3 per vertex, unit length; empty: not lit
    Column<std::uint32_t> triangles;  ///< 3 vertex numbers each
    Column<std::uint32_t> segments;   ///< 2 vertex numbers each, drawn as lines
    Column<std::uint32_t> points;     ///< 1 vertex number each, drawn as dots
};

}  // namespace clsurf::viz
