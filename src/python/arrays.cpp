#include "python/arrays.h"

#include <array>
#include <string>

namespace clsurf::python {

pybind11::array raw_array(const ChannelView& view, std::shared_ptr<const void> owner) {
    constexpr std::array<const char*, 11> codes{"", "i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f4", "f8"};
    const pybind11::dtype type(std::string(view.big_endian ? ">" : "<") + codes[static_cast<std::size_t>(view.type)]);
    pybind11::array array(type, {static_cast<pybind11::ssize_t>(view.count)},
                          {static_cast<pybind11::ssize_t>(view.stride)}, view.first, owner_of(std::move(owner)));
    array.attr("setflags")(pybind11::arg("write") = false);
    return array;
}

}  // namespace clsurf::python
