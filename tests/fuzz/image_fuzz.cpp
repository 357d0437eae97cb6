// Conversions of decoded images: masks, normal maps, mip chains of any size.
#include "fuzz.hpp"
#include "scenes/image.hpp"

#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace macula::scene;
    if (size < 4)
        return 0;
    Image image;
    image.width = data[0] + 1u;
    image.height = data[1] + 1u;
    image.rgba.resize(std::size_t{image.width} * image.height * 4);
    for (std::size_t i = 0; i < image.rgba.size(); ++i)
        image.rgba[i] = data[3 + i % (size - 3)];
    image.has_alpha = data[2] % 2 != 0;
    flip_vertically(image);
    if (data[2] & 2)
        to_mask(image);
    if (data[2] & 4 && !looks_like_normal_map(image))
        bump_to_normal(image, static_cast<float>(data[2]));
    const std::vector<MipLevel> levels = build_mips(std::move(image), (data[2] & 8) != 0);
    if (levels.back().width != 1 || levels.back().height != 1)
        std::abort();
    return 0;
}
