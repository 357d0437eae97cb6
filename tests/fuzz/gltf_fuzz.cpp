// glTF, text or binary as the first byte says, through tinygltf, our checks and validation.
#include "fuzz.hpp"
#include "scenes/formats.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace macula::scene;
    const bool binary = size > 0 && data[0] == 'g';
    LoadOptions options;
    options.textures = false;
    try {
        Scene scene =
            load_gltf(fuzz::text_of(data, size), "/nonexistent/fuzz.gltf", binary, options);
        fuzz::validate_with_view(scene);
    } catch (const SceneError&) {
    }
    return 0;
}
