#include "cli/picture_output.h"

#include "cli/output_format.h"

namespace clsurf::cli {

PictureOutput::PictureOutput(const std::string& path, std::string_view option)
    : format_(output_format(path, picture_formats(), {}, option).name), file_(path) {}

void PictureOutput::write(const viz::Image& image, const std::string& description) {
    file_.write(viz::encode_image(image, description, format_));
    file_.commit();
}

}  // namespace clsurf::cli
