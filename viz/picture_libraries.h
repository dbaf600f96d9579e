#pragma once
// The libraries that pictures need.

#include <future>

namespace clsurf::viz {

struct ImageLibrary;
struct VtkLibrary;

/// Loads VTK and OpenImageIO in the background; the destructor waits until they are loaded. A program must not end while a
/// library is being loaded: the constructors of its static objects would run at the same time as the destructors that exit()
/// calls.
class PictureLibrariesPreload {
public:
    PictureLibrariesPreload();

private:
    // The results are not used: if a library cannot be loaded, the code that draws reports it.
    std::future<const ImageLibrary&> image_;
    std::future<const VtkLibrary&> vtk_;
};

}  // namespace clsurf::viz
