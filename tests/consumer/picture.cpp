// A picture in another program: VTK and OpenImageIO are loaded from the folder where clsurf is installed.

#include <fstream>
#include <iostream>

#include <clsurf/viz/canvas.h>
#include <clsurf/viz/image.h>

int main(int count, char** arguments) {
    if (count != 2) {
        std::cerr << "usage: picture FILE.png\n";
        return 2;
    }
    clsurf::viz::Sheet sheet;
    sheet.width = 200;
    sheet.height = 40;
    sheet.texts.push_back({100, 20, "clsurf", 14, clsurf::viz::Align::centre, true, {0, 0, 0}});
    const clsurf::viz::Image image = clsurf::viz::draw(sheet, "osmesa", 2);
    std::ofstream(arguments[1], std::ios::binary) << clsurf::viz::encode_image(image, "a word", "png");
    std::size_t dark = 0;
    for (const auto value : image.rgb) dark += value < 64 ? 1 : 0;
    std::cout << "text drawn with " << dark << " dark values\n";
}
