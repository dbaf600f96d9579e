#include "cli/pictures/picture_output.h"

#include "cli/options/output_format.h"
#include "viz/vector_picture.h"

namespace clsurf::cli {

PictureOutput::PictureOutput(const std::string& path, std::string_view option, PictureKind kind)
    : format_(
          output_format(path, kind == PictureKind::drawing ? drawing_formats() : picture_formats(), {}, option).name),
      file_(path) {}

void PictureOutput::write(const viz::Image& image, const std::string& description) {
    if (format_ == "svg")
        file_.write(viz::svg_text(*image.drawing, description));
    else if (format_ == "pdf")
        file_.write(viz::pdf_bytes(*image.drawing, description));
    else
        file_.write(viz::encode_image(image, description, format_));
    file_.commit();
}

}  // namespace clsurf::cli
