#pragma once
// The libraries that pictures need.

#include <future>

namespace clsurf::viz {

struct ImageLibrary;
struct VtkLibrary;

/// Begins to load VTK and OpenImageIO in the background, and ends when they are loaded. A program must not end while a library is
/// being loaded: the constructors of its static objects would run beside the destructors that exit() calls.
class PictureLibrariesPreload {
public:
    PictureLibrariesPreload();

private:
    // Nobody reads these. A library that cannot be loaded is an error in the code that draws.
    std::future<const ImageLibrary&> image_;
    std::future<const VtkLibrary&> vtk_;
};

}  // namespace clsurf::viz
