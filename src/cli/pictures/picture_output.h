#pragma once
// The file of a picture; the extension of its name selects the format.

#include <string>
#include <string_view>

#include "io/files/atomic_file.h"
#include "viz/image.h"
#include "viz/picture_libraries.h"

namespace clsurf::cli {

/// Pixels only, or also lines and texts as vectors.
enum class PictureKind { pixels, drawing };

class PictureOutput {
public:
    /// Opens the file early: a name that cannot be written fails before the work. Starts loading the libraries for pictures.
    /// `option` is the name for messages. Throws UsageError (the extension, a terminal, an input), SystemError.
    explicit PictureOutput(const std::string& path, std::string_view option = "-o",
                           PictureKind kind = PictureKind::pixels);
    /// Whether write() needs the drawing of the picture: SVG, PDF.
    [[nodiscard]] bool wants_drawing() const { return format_ == "svg" || format_ == "pdf"; }
    /// Writes the whole picture. Throws SystemError.
    void write(const viz::Image& image, const std::string& description);

private:
    std::string format_;
    io::AtomicFile file_;
    viz::PictureLibrariesPreload preload_;
};

}  // namespace clsurf::cli
