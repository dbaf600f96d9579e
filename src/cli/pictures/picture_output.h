#pragma once
// Where a picture goes, in the form that the ending of its name stands for.

#include <string>
#include <string_view>

#include "io/files/atomic_file.h"
#include "viz/image.h"
#include "viz/picture_libraries.h"

namespace clsurf::cli {

/// Pixels alone, or what can be drawn as lines and texts, too.
enum class PictureKind { pixels, drawing };

class PictureOutput {
public:
    /// Opens the file: a name that cannot be written fails before the work. Begins to load the libraries that pictures need.
    /// `option` names it in messages. Throws UsageError (the ending, a terminal, an input), SystemError.
    explicit PictureOutput(const std::string& path, std::string_view option = "-o",
                           PictureKind kind = PictureKind::pixels);
    /// Whether write() needs the drawing of the picture: SVG, PDF.
    [[nodiscard]] bool wants_drawing() const { return format_ == "svg" || format_ == "pdf"; }
    /// The whole picture. Throws SystemError.
    void write(const viz::Image& image, const std::string& description);

private:
    std::string format_;
    io::AtomicFile file_;
    viz::PictureLibrariesPreload preload_;
};

}  // namespace clsurf::cli
