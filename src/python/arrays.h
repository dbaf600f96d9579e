#pragma once
// Columns as NumPy arrays that share their memory: read-only, and valid as long as any array refers to them.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <utility>
#include <vector>

#include "core/channel_view.h"
#include "core/column.h"

namespace clsurf::python {

/// What an array refers to, for as long as it lives.
[[nodiscard]] inline pybind11::capsule owner_of(std::shared_ptr<const void> owner) {
    return {new std::shared_ptr<const void>(std::move(owner)),
            [](void* kept) { delete static_cast<std::shared_ptr<const void>*>(kept); }};
}

/// `shape`: as many values as the column has.
template <typename T>
pybind11::array shared_array(const std::shared_ptr<const Column<T>>& column, std::vector<pybind11::ssize_t> shape) {
    pybind11::array array(pybind11::dtype::of<T>(), std::move(shape), column->data(), owner_of(column));
    array.attr("setflags")(pybind11::arg("write") = false);
    return array;
}

template <typename T>
pybind11::array shared_array(const std::shared_ptr<const Column<T>>& column) {
    return shared_array(column, {static_cast<pybind11::ssize_t>(column->size())});
}

/// The stored values of a channel where they lie in its file, before scale and bias.
[[nodiscard]] pybind11::array raw_array(const ChannelView& view, std::shared_ptr<const void> owner);

}  // namespace clsurf::python
